#include "simulation/engines/run_engines.hpp"

#include <algorithm>
#include <cmath>
#include <dlfcn.h>
#include <filesystem>
#include <fmt/format.h>
#include <numbers>
#include <stdexcept>

#include "candidates/candidates.hpp"
#include "candidates/host/contained.hpp"
#include "candidates/host/progress.hpp"
#include "candidates/host/worker_processes.hpp"
#include "properties/files/bytes.hpp"
#include "reference/invalid_input.hpp"
#include "simulation/assembly.hpp"
#include "simulation/engines/engine_world.hpp"
#include "simulation/experiment.hpp"
#include "simulation/kinematic_tree.hpp"

namespace touchstone {
namespace {

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

ExperimentResult run(const Experiment& experiment, const std::string& engine,
                     const EngineSetup& setup, double step) {
  const std::string name = setup.cured ? engine + "+touchstone" : engine;
  const Contained ran = run_contained(
      [&] {
        const Measurement measured = experiment.run(in_engine(engine, setup), step);
        return to_bytes(result_of(experiment, name, step, measured));
      },
      max_engine_seconds);
  if (ran.end == Contained::End::returned) return from_bytes<ExperimentResult>(ran.text);
  ExperimentResult failed;
  failed.experiment = experiment.name;
  failed.candidate = name;
  failed.step = step;
  failed.outcome = ran.end == Contained::End::crashed ? ExperimentResult::Outcome::crashed
                                                      : ExperimentResult::Outcome::timed_out;
  failed.reason = ran.text;
  return failed;
}

EngineResult run(const Experiment& experiment, const std::string& engine, double step) {
  EngineResult r{experiment.name,
                 engine,
                 Cure::open,
                 run(experiment, engine, {}, step),
                 run(experiment, engine, {.cured = true}, step),
                 {}};
  r.cure = cure_of(r.own, r.cured, r.best);
  if (r.cure == Cure::held || r.cure == Cure::nearer) return r;
  for (const double tried : {step, step / 2}) {
    r.best = run(experiment, engine, {.cured = true, .best_solver = true}, tried);
    if (r.best->exact) break;
  }
  r.cure = cure_of(r.own, r.cured, r.best);
  return r;
}

/// Largest angle that a drive turns a body by in a step. Between waypoints it is half a turn at
/// most.
struct AngleOfAStep {
  double step;  // s

  double operator()(const SteadyMotion& m) const { return step * m.angular_velocity.norm(); }
  double operator()(const Oscillation& o) const {
    constexpr double from_end_to_end = 2;
    const double share = 2 * std::numbers::pi * o.frequency * step;
    return std::min(share, from_end_to_end) * o.turn.norm();
  }
  double operator()(const Waypoints&) const { return 0; }
};

}  // namespace

std::string engine_shape_name(const EngineShape& shape) {
  constexpr const char* names[] = {
      "cylinder", "cylinder, margin 0",   "cylinder, many points", "capsule", "box", "spheres",
      "hull",     "cylinder + touchstone"};
  const std::string name = names[static_cast<int>(shape.kind)];
  return shape.count > 0 ? name + ':' + std::to_string(shape.count) : name;
}

void check_engine_scene(const std::string& engine, const Scene& scene) {
  check_scene(scene);
  const auto refuse = [&](const std::string& field, const std::string& what,
                          const std::string& without) {
    throw InvalidInput(
        field, what,
        "must not be there with --engine: the world of " + engine + " has " + without + " here");
  };
  for (std::size_t i = 0; engine.starts_with("bullet") && i < scene.bodies.size(); ++i) {
    const auto& drive = scene.bodies[i].drive;
    const double angle = drive ? std::visit(AngleOfAStep{scene.step}, *drive) : 0;
    if (angle < std::numbers::pi) continue;
    refuse(fmt::format("bodies[{}].drive", i), fmt::format("{:.3g} rad in a step", angle),
           "driven bodies that turn by less than half a turn in a step");
  }
  if (engine != "mujoco") return;
  if (const auto loop = loop_closing_joint(scene)) {
    refuse(fmt::format("joints[{}]", *loop), '"' + scene.joints[*loop].name + '"',
           "trees of joints, and this one closes a loop");
  }
  for (const Assembly& assembly : assemblies(scene)) {
    constexpr double smallest = 1e-15;  // mjMINVAL
    const double moment = assembly.inertia.principal.minCoeff();
    if (!assembly.is_free() || std::min(assembly.inertia.mass, moment) >= smallest) continue;
    refuse(fmt::format("bodies[{}]", assembly.bodies.front()),
           fmt::format("of {:.2g} kg and {:.2g} kg m²", assembly.inertia.mass, moment),
           "masses and moments of inertia from 1e-15 on");
  }
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    const std::string path = fmt::format("bodies[{}]", i);
    constexpr double smallest_volume = 1e-15;  // mjMINVAL
    if (std::holds_alternative<Convex>(body.shape) &&
        !(inertia(body.shape, 1).inertia.mass > smallest_volume)) {
      refuse(path + ".shape", "flat, or too small",
             "convex bodies with a volume of more than 1e-15 m³");
    }
    if (!body.surface_velocity.isZero(0)) {
      refuse(path + ".surface_velocity", "not zero", "no moving surfaces");
    }
    if (body.material.restitution > 0) {
      refuse(path + ".restitution", fmt::format("{}", body.material.restitution), "no restitution");
    }
  }
}

Simulator in_engine(const std::string& engine, const EngineSetup& setup) {
  return [&module = load(engine), engine, setup](const Scene& scene) {
    check_engine_scene(engine, scene);
    Scene begun = scene;
    if (setup.is_cured()) {
      for (Body& body : begun.bodies) body.squares = 0;  // our routines know the box itself
    }
    return module.begin(begun, setup);
  };
}

EngineDescription describe_engine(const std::string& engine) {
  if (!std::filesystem::exists(module_file(engine))) {
    std::string names;
    for (const std::string& name : all_engines()) names += (names.empty() ? "" : ", ") + name;
    throw InvalidInput("--engine", '"' + engine + '"', "must be one of " + names);
  }
  const Contained told = run_contained(
      [&] {
        const EngineModule& module = load(engine);
        return to_bytes(std::string(module.version), std::string(module.settings),
                        std::string(module.best_settings));
      },
      max_engine_seconds);
  if (told.end != Contained::End::returned) {
    throw InvalidInput("--engine", '"' + engine + '"',
                       "must be an engine that can be loaded: " + told.text);
  }
  EngineDescription result{engine, {}, {}, {}};
  BytesIn{told.text}(result.version, result.settings, result.best_settings);
  return result;
}

namespace {

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

/// The scenes that an experiment begins.
std::vector<Scene> scenes_of(const Experiment& experiment, double step) {
  std::vector<Scene> scenes;
  experiment.run(
      [&](const Scene& scene) {
        scenes.push_back(scene);
        return std::make_unique<Glimpse>(scene);
      },
      step);
  return scenes;
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
  void keep() { append_poses(scene_, states(), poses_); }

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

const char* cure_name(Cure cure) {
  constexpr const char* names[] = {"held", "nearer", "solver", "alike", "open"};
  return names[static_cast<int>(cure)];
}

Cure cure_of(const ExperimentResult& own, const ExperimentResult& cured,
             const std::optional<ExperimentResult>& best) {
  using Outcome = ExperimentResult::Outcome;
  constexpr double much_nearer = 10, equally_near = 1.5;
  constexpr double lost = 1;  // a radius, or all of what is measured: no nearness counts
  const auto is_measured = [](const ExperimentResult& r) { return r.outcome == Outcome::measured; };
  if (cured.exact) return Cure::held;
  if (!is_measured(cured)) return Cure::open;
  const bool is_nearer = !is_measured(own) || !(own.error < much_nearer * cured.error);
  if (is_nearer && cured.error < lost) return Cure::nearer;
  if (best && best->exact) return Cure::solver;
  const double ratio = cured.error / own.error;
  if (ratio < equally_near && ratio > 1 / equally_near) return Cure::alike;
  return Cure::open;
}

EngineResults run_engines(const EngineOptions& options) {
  EngineResults results{options.step, {}, {}, {}};
  for (const std::string& engine : options.engines)
    results.engines.push_back(describe_engine(engine));
  for (const Experiment* e : options.experiments) {
    results.experiments.push_back(touchstone::describe(*e, {options.step}));
  }
  const std::size_t engines = options.engines.size();
  const auto experiment_of = [&](std::size_t i) { return options.experiments[i / engines]; };
  const auto engine_of = [&](std::size_t i) { return options.engines[i % engines]; };
  Progress progress("experiments in engines", options.experiments.size() * engines);
  const auto texts = run_in_processes(
      options.experiments.size() * engines, options.workers,
      [&](std::size_t i) { return to_bytes(run(*experiment_of(i), engine_of(i), options.step)); },
      [&](std::size_t i) { return experiment_of(i)->name + " in " + engine_of(i); },
      [&](std::size_t done) { progress.update(done); });
  for (const std::string& text : texts) {
    if (!text.empty()) results.results.push_back(from_bytes<EngineResult>(text));
  }
  return results;
}

void append_poses(const Scene& scene, const std::vector<BodyState>& states,
                  std::vector<float>& poses) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (scene.bodies[i].fixed) continue;
    const Vec3& p = states[i].pose.position();
    const Eigen::Quaterniond q = states[i].pose.unit_orientation();
    for (const double x : {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()}) {
      poses.push_back(static_cast<float>(x));
    }
  }
}

bool is_one_run(const Experiment& experiment, double step) {
  return scenes_of(experiment, step).size() == 1;
}

EngineMotion record_motion(const Experiment& experiment, const std::string& engine,
                           const EngineSetup& setup, double step) {
  constexpr double frames_per_second = 60;
  EngineMotion motion{scenes_of(experiment, step).front(), 0, {}};
  const int every =
      std::max(1, static_cast<int>(std::lround(1 / (frames_per_second * motion.scene.step))));
  motion.interval = every * motion.scene.step;
  const Contained ran = run_contained(
      [&] {
        std::vector<float> poses;
        const Simulator simulator = in_engine(engine, setup);
        experiment.run(
            [&](const Scene& scene) {
              return std::make_unique<Recorded>(scene, simulator(scene), every, poses);
            },
            step);
        return to_bytes(poses);
      },
      max_engine_seconds);
  if (ran.end != Contained::End::returned) {
    throw std::runtime_error(experiment.name + " in " + engine + ": " + ran.text);
  }
  motion.poses = from_bytes<std::vector<float>>(ran.text);
  return motion;
}

}  // namespace touchstone
