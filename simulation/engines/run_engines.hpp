#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "simulation/run_experiments.hpp"
#include "simulation/scene.hpp"

namespace touchstone {

/// Which experiments to run in which engines' own worlds.
struct EngineOptions {
  std::vector<const Experiment*> experiments;
  std::vector<std::string> engines;
  double step = 1.0 / 240;  ///< s
  unsigned workers = 1;     ///< processes; the results do not depend on them
};

/// Engines whose worlds there are here, in report order.
std::vector<std::string> all_engines();

/// What stands for a cylinder in an engine's world.
struct EngineShape {
  enum class Kind {  // in the order of the names in engine_shape_name
    cylinder,        ///< the engine's own, as it is by default
    no_margin,       ///< Bullet's with margin 0
    multipoint,      ///< the engine's own, with its option for several points of a pair
    capsule,         ///< the largest of the cylinder's length inside it
    box,             ///< the smallest around it
    spheres,         ///< inside it: in a row, or in a ring when it is flat
    hull,            ///< a regular prism with its corners on the rims
    exact,           ///< the engine's own, with our routines installed
  };
  Kind kind = Kind::cylinder;
  int count = 0;  ///< of spheres; sides of a hull

  bool operator==(const EngineShape&) const = default;
};

/// "cylinder", "cylinder, margin 0", "spheres:8", "hull:16", "cylinder + touchstone", …
std::string engine_shape_name(const EngineShape& shape);

/// How an engine's world is set up.
struct EngineSetup {
  bool cured = false;                    ///< with our contact routines installed in it
  bool best_solver = false;              ///< with its solver at its best, whatever that costs
  std::vector<EngineShape> shapes = {};  ///< by body, of cylinders; empty: the engine's own

  EngineShape shape_of(std::size_t body) const {
    return shapes.empty() ? EngineShape{} : shapes[body];
  }
  /// Is there a body with this kind? Some settings are of a whole world.
  bool has(EngineShape::Kind kind) const {
    return std::any_of(shapes.begin(), shapes.end(),
                       [&](const EngineShape& s) { return s.kind == kind; });
  }
  /// Do our routines find the contacts of cylinders, of some at least?
  bool is_cured() const { return cured || has(EngineShape::Kind::exact); }
};

struct EngineDescription {
  std::string name, version;
  std::string settings, best_settings;  ///< of its solver: as usual, at its best
};
namespace rule {
inline constexpr Rule engine{.one_of = [] {
  return std::vector<std::string>{"bullet", "bullet-float", "ode", "mujoco"};
}};
}  // namespace rule
template <class Archive>
void members(Archive& a, EngineDescription& e) {
  a.named("name", e.name, rule::engine);
  a.named("version", e.version);
  a.named("settings", e.settings);
  a.named("best_settings", e.best_settings);
}

/// What our contacts do to an experiment in an engine. In the order of the names in cure_name.
enum class Cure {
  held,    ///< the answer on paper, within what the experiment resolves
  nearer,  ///< at least ten times nearer to it than the engine's own contacts, and not lost
  solver,  ///< held with the engine's solver at its best: its defaults are what limits
  alike,   ///< as near as the engine's own contacts, also with the solver at its best
  open,    ///< none of these
};
const char* cure_name(Cure cure);
inline constexpr std::array all_cures = {Cure::held, Cure::nearer, Cure::solver, Cure::alike,
                                         Cure::open};
inline const auto& values_of(Cure) { return all_cures; }
inline const char* name_of(Cure cure) { return cure_name(cure); }

/// One experiment in one engine's own world.
struct EngineResult {
  std::string experiment, engine;
  Cure cure;
  ExperimentResult own;    ///< with the engine's contacts
  ExperimentResult cured;  ///< with ours
  /// With ours and the solver at its best, and half the step where that alone is not held; absent
  /// where the usual solver already holds the experiment or is ten times nearer.
  std::optional<ExperimentResult> best;
};
template <class Archive>
void members(Archive& a, EngineResult& r) {
  a.named("experiment", r.experiment);
  a.named("engine", r.engine, rule::engine);
  a.named("cure", r.cure);
  a.named("own", r.own);
  a.named("cured", r.cured);
  a.named("best", r.best);
}

struct EngineResults {
  double step = 0;  ///< s
  std::vector<EngineDescription> engines;
  std::vector<ExperimentDescription> experiments;
  std::vector<EngineResult> results;  ///< by experiment, then engine
};
template <class Archive>
void members(Archive& a, EngineResults& r) {
  a.named("step", r.step, rule::positive);
  a.named("engines", r.engines);
  a.named("experiments", r.experiments);
  a.named("results", r.results);
}

/// An engine's version and settings. Throws InvalidInput (field "--engine") where its world is not
/// there.
EngineDescription describe_engine(const std::string& engine);

/// Begins scenes in an engine's own world, and throws as check_engine_scene does. Loads the engine:
/// for a process of its own alone (run_contained), which may crash or hang.
Simulator in_engine(const std::string& engine, const EngineSetup& setup);

/// Throws InvalidInput with the path of the field unless the engine's world can do all that the
/// scene asks for.
void check_engine_scene(const std::string& engine, const Scene& scene);

/// Processor time of one run in an engine, seconds, after which it is ended. The longest take about
/// a second.
inline constexpr double max_engine_seconds = 60;

/// Runs every experiment in every engine, each run in a process of its own. Times aside the results
/// depend on the options alone. Progress goes to standard error. After an interruption
/// (interruption.hpp) the results of what was not done are missing. Throws InvalidInput (field
/// "--engine") where an engine's world is not there.
EngineResults run_engines(const EngineOptions& options);

/// Judges the runs of an experiment.
Cure cure_of(const ExperimentResult& own, const ExperimentResult& cured,
             const std::optional<ExperimentResult>& best);

/// The motion of one run, as a page shows it.
struct EngineMotion {
  Scene scene;
  double interval = 0;       ///< s, between frames
  std::vector<float> poses;  ///< of all frames (append_poses); they end where the run did
};

/// Appends position and orientation (w, x, y, z) of every moving body.
void append_poses(const Scene& scene, const std::vector<BodyState>& states,
                  std::vector<float>& poses);

/// Whether an experiment is a single run of one scene, which can be shown.
bool is_one_run(const Experiment& experiment, double step);

/// Runs such an experiment once more, and keeps its motion. Throws std::runtime_error if the engine
/// ends it.
EngineMotion record_motion(const Experiment& experiment, const std::string& engine,
                           const EngineSetup& setup, double step);

/// The member `engines` of report.json (docs/engines.schema.json).
nlohmann::json to_json(const EngineResults& results);

}  // namespace touchstone
