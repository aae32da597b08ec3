#include "simulation/scenes/exact_motion.hpp"

#include <algorithm>
#include <functional>
#include <stdexcept>

#include "candidates/host/contained.hpp"
#include "simulation/scenes/choose.hpp"
#include "simulation/scenes/engine_choice.hpp"

namespace touchstone {
namespace {

/// Of all runs; `run` makes one, as bytes, in one of the worker processes.
ExactMotion motion_of_all(const Scene& scene, const Trials& trials, unsigned workers,
                          const std::string& name,
                          const std::function<std::string(const DisturbedScene&)>& run) {
  const auto runs = exact_runs(scene, trials.seed, trials.disturbances, workers, name, run);
  auto all = from_bytes<ExactMotion>(runs.front());
  for (const std::string& bytes : runs) {
    const auto one = from_bytes<ExactMotion>(bytes);
    for (std::size_t i = 0; i < all.depths.size(); ++i) {
      all.depths[i] = std::max(all.depths[i], one.depths[i]);
    }
  }
  return all;
}

}  // namespace

bool ExactMotion::has_contacts() const {
  return std::ranges::any_of(depths, [](double depth) { return depth > 0; });
}

ExactMotion motion_of(const Scene& scene, const Trajectory& run) {
  const std::size_t count = scene.bodies.size();
  ExactMotion motion{std::vector<double>(count), std::vector<double>(count)};
  for (const JudgedAnswer& answer : run.answers) {
    for (const int b : {answer.a, answer.b}) {
      motion.depths[b] = std::max(motion.depths[b], answer.depth);
    }
  }
  for (std::size_t f = 1; f < run.frames.size(); ++f) {
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 step = run.frames[f][i].pose.position() - run.frames[f - 1][i].pose.position();
      motion.ways[i] += step.norm();
    }
  }
  return motion;
}

ExactMotion exact_motion(const Scene& scene, const Trials& trials, unsigned workers,
                         const Limits& limits, const std::string& name) {
  Processes processes(limits);  // each worker process starts its own
  return motion_of_all(scene, trials, workers, name, [&](const DisturbedScene& disturbed) {
    CandidateModel model(processes.of(*exact_first({}).front()));
    return to_bytes(motion_of(scene, disturbed.turned_back(run_scene(disturbed.scene, model))));
  });
}

ExactMotion exact_motion_in(const std::string& engine, const Scene& scene, const Trials& trials,
                            unsigned workers, const std::string& name) {
  const std::vector<EngineShape> ours(scene.bodies.size(), {EngineShape::Kind::exact});
  return motion_of_all(scene, trials, workers, name, [&](const DisturbedScene& disturbed) {
    const Contained ran = run_contained(
        [&] {
          const Trajectory run = run_in_world(engine, ours, disturbed.scene, true);
          return to_bytes(motion_of(scene, disturbed.turned_back(run)));
        },
        max_engine_seconds);
    if (ran.end == Contained::End::returned) return ran.text;
    throw std::runtime_error("the engine ended a run with our routines: " + ran.text);
  });
}

}  // namespace touchstone
