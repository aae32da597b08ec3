#include "simulation/engines/run_engines.hpp"

#include <algorithm>
#include <cstring>
#include <dlfcn.h>
#include <filesystem>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "candidates/candidates.hpp"
#include "candidates/host/contained.hpp"
#include "candidates/host/progress.hpp"
#include "candidates/host/worker_processes.hpp"
#include "reference/invalid_input.hpp"
#include "simulation/engines/engine_world.hpp"
#include "simulation/experiment.hpp"

namespace touchstone {
namespace {

/// Processor time of one run, after which it is ended. The longest take about a second.
constexpr double max_seconds = 60;

std::filesystem::path module_file(const std::string& engine) {
  return standard_folder() / ("touchstone-world-" + engine + ".so");
}

/// Loads an engine's module; for a contained process only.
const EngineModule& load(const std::string& engine) {
  void* const handle = dlopen(module_file(engine).c_str(), RTLD_NOW | RTLD_LOCAL);
  void* const entry = handle ? dlsym(handle, "touchstone_engine") : nullptr;
  if (!entry) throw std::runtime_error(dlerror());
  return *reinterpret_cast<const EngineModule* (*)()>(entry)();
}

Simulator in_engine(const EngineModule& engine, bool cured) {
  return [&engine, cured](const Scene& scene) {
    check_scene(scene);
    return engine.begin(scene, cured);
  };
}

struct Trial {
  const Experiment* experiment;
  std::string engine;
  bool cured;
  std::string candidate() const { return cured ? cured_name(engine) : engine; }
};

/// Ordered by experiment, then engine.
std::vector<Trial> trials(const EngineOptions& options) {
  std::vector<Trial> result;
  for (const Experiment* e : options.experiments) {
    for (const std::string& engine : options.engines) {
      for (const bool cured : {false, true}) result.push_back({e, engine, cured});
    }
  }
  return result;
}

std::string run(const Trial& trial, double step) {
  const Contained ran = run_contained(
      [&] {
        const Simulator simulator = in_engine(load(trial.engine), trial.cured);
        const Measurement measured = trial.experiment->run(simulator, step);
        return to_text(result_of(*trial.experiment, trial.candidate(), step, measured));
      },
      max_seconds);
  if (ran.end == Contained::End::returned) return ran.text;
  ExperimentResult failed;
  failed.experiment = trial.experiment->name;
  failed.candidate = trial.candidate();
  failed.step = step;
  failed.outcome = ran.end == Contained::End::crashed ? ExperimentResult::Outcome::crashed
                                                      : ExperimentResult::Outcome::timed_out;
  failed.reason = ran.text;
  return to_text(failed);
}

EngineDescription describe(const std::string& engine) {
  const Contained told = run_contained(
      [&] {
        const EngineModule& module = load(engine);
        return nlohmann::json{module.version, module.settings}.dump();
      },
      max_seconds);
  if (told.end != Contained::End::returned) {
    throw InvalidInput("--engine", '"' + engine + '"', "cannot be loaded: " + told.text);
  }
  const auto text = nlohmann::json::parse(told.text);
  return {engine, text[0], text[1]};
}

/// Ends a run before its first step, having shown its scene.
class Glimpse : public Simulation {
 public:
  explicit Glimpse(const Scene& scene) {
    for (const Body& b : scene.bodies) states_.push_back({b.pose, b.velocity, b.angular_velocity});
  }
  void step() override {}
  const std::vector<BodyState>& states() const override { return states_; }
  Contacts contacts() const override { return {}; }
  bool sound() const override { return false; }

 private:
  std::vector<BodyState> states_;
};

Scene scene_of(const Experiment& experiment, double step) {
  std::optional<Scene> scene;
  experiment.run(
      [&](const Scene& begun) {
        if (!scene) scene = begun;
        return std::make_unique<Glimpse>(begun);
      },
      step);
  return *scene;
}

/// Another simulation, with every `every`-th frame kept.
class Recorded : public Simulation {
 public:
  Recorded(const Scene& scene, std::unique_ptr<Simulation> other, int every,
           std::vector<float>& poses)
      : scene_(scene), other_(std::move(other)), every_(every), poses_(poses) {
    keep();
  }
  void step() override {
    other_->step();
    if (++steps_ % every_ == 0 && sound()) keep();
  }
  const std::vector<BodyState>& states() const override { return other_->states(); }
  Contacts contacts() const override { return other_->contacts(); }
  bool sound() const override { return other_->sound(); }

 private:
  void keep() {
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
      if (scene_.bodies[i].fixed) continue;
      const Vec3& p = states()[i].pose.position();
      const Eigen::Quaterniond q = states()[i].pose.unit_orientation();
      for (const double x : {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()}) {
        poses_.push_back(static_cast<float>(x));
      }
    }
  }

  const Scene& scene_;
  std::unique_ptr<Simulation> other_;
  int every_, steps_ = 0;
  std::vector<float>& poses_;
};

}  // namespace

std::vector<std::string> all_engines() {
  std::vector<std::string> result;
  for (const char* engine : {"bullet", "bullet-float", "ode", "mujoco"}) {
    if (std::filesystem::exists(module_file(engine))) result.emplace_back(engine);
  }
  return result;
}

std::string cured_name(const std::string& engine) { return engine + "+touchstone"; }

EngineResults run_engines(const EngineOptions& options) {
  EngineResults results;
  for (const std::string& engine : options.engines) results.engines.push_back(describe(engine));
  const std::vector<Trial> all = trials(options);
  Progress progress("experiments in engines", all.size());
  const auto texts = run_in_processes(
      all.size(), options.workers, [&](std::size_t i) { return run(all[i], options.step); },
      [&](std::size_t i) { return all[i].experiment->name + " in " + all[i].candidate(); },
      [&](std::size_t done) { progress.update(done); });
  results.runs.steps = {options.step};
  for (const Experiment* e : options.experiments) {
    results.runs.experiments.push_back(describe(*e, results.runs.steps));
  }
  for (const std::string& text : texts) {
    if (!text.empty()) results.runs.results.push_back(result_from_text(text));
  }
  return results;
}

Motion record_motion(const Experiment& experiment, const std::string& engine, bool cured,
                     double step) {
  constexpr double frames_per_second = 60;
  Motion motion{scene_of(experiment, step), 0, {}};
  const int every =
      std::max(1, static_cast<int>(1 / (frames_per_second * motion.scene.step) + 0.5));
  motion.interval = every * motion.scene.step;
  const Contained ran = run_contained(
      [&] {
        std::vector<float> poses;
        const Simulator simulator = in_engine(load(engine), cured);
        experiment.run(
            [&](const Scene& scene) {
              return std::make_unique<Recorded>(scene, simulator(scene), every, poses);
            },
            step);
        return std::string(reinterpret_cast<const char*>(poses.data()),
                           poses.size() * sizeof(float));
      },
      max_seconds);
  if (ran.end != Contained::End::returned) {
    throw std::runtime_error(experiment.name + " in " + engine + ": " + ran.text);
  }
  motion.poses.resize(ran.text.size() / sizeof(float));
  std::memcpy(motion.poses.data(), ran.text.data(), ran.text.size());
  return motion;
}

}  // namespace touchstone
