#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "simulation/engines/run_engines.hpp"
#include "simulation/scenes/disturbed_scene.hpp"
#include "simulation/scenes/scene_file.hpp"
#include "simulation/scenes/spread.hpp"

// Which shape stands best for a cylinder inside one engine.

namespace touchstone {

/// Cylinders of one size, which get the same shape.
struct CylinderSize {
  std::string name;         ///< "cylinder ⌀0.1×0.3"
  std::vector<int> bodies;  ///< of the scene
};

/// A shape for each size of cylinder, and whole runs of the scene with them in the engine.
struct EngineSetting : RepeatedRun {
  explicit EngineSetting(std::vector<EngineShape> by_size) : shapes(std::move(by_size)) {}

  std::vector<EngineShape> shapes;  ///< by size
  /// Time of a step of the engine: of each step the least of interleaved runs, then the mean;
  /// absent where not measured. Those of the finalists were measured together.
  std::optional<double> step_seconds = {};

  bool has(EngineShape::Kind kind) const;
};

/// Makes one run of a scene with shapes by body of it, in a process that it may end.
using EngineRun =
    std::function<Trajectory(const std::string& engine, const std::vector<EngineShape>& shapes,
                             const Scene& scene, bool with_depths)>;

/// In the engine's own world.
Trajectory run_in_world(const std::string& engine, const std::vector<EngineShape>& shapes,
                        const Scene& scene, bool with_depths);

struct EngineChoiceOptions {
  unsigned workers = 1;  ///< processes; the runs do not depend on them
  Trials trials = {};
  EngineRun run = run_in_world;
};

/// The cheapest setting of an engine that meets the needs of a scene, and all that were tried.
struct EngineChoice {
  SceneFile file;                     ///< with the needs that can be judged in an engine
  std::vector<std::string> left_out;  ///< texts of those that cannot: normals
  EngineDescription engine;
  std::vector<CylinderSize> sizes;
  /// Why the engine ended a run with our routines: "Segmentation fault, disturbance 3". Then there
  /// is nothing to compare with, and needs relative to exact contacts are not judged.
  std::string exact_end = {};
  std::vector<std::string> not_judged = {};  ///< texts of these
  Spreads spreads = {};        ///< of runs with our routines, unless the engine ended one
  Straying exact_spread = {};  ///< of the same, as Choice has it
  std::vector<EngineSetting> settings = {};  ///< the engine's default first, then with our routines
  Trials trials = {};
  std::optional<std::size_t> answer = {};  ///< index of a setting; absent: none holds

  /// Index of the setting that comes nearest to what the needs ask for: which held in the most
  /// runs, and of these breaks the fewest needs, by least.
  std::size_t nearest() const;
  const EngineSetting& default_setting() const { return settings[0]; }
  const EngineSetting& exact_setting() const { return settings[1]; }
};

/// Says that a cylinder may touch a convex body: our routines know none inside the engines, so that
/// these contacts stay the engine's own in all settings. Empty if none may.
std::string hulls_text(const std::string& engine, const Scene& scene);

/// Runs the scene in an engine's own world with each shape that it offers for all cylinders, under
/// disturbances, each run in a process of its own; times those that hold; then searches by size,
/// from the best settings that fail if none holds. Relative needs compare with the engine with our
/// routines; where it ends such a run, they are not judged. The finalists are timed together, and
/// times of other batches follow those of the default and our routines in each. The answer is the
/// simplest of the engine's own settings that take much the same as the cheapest, the default
/// first; our routines where nothing else holds. Throws InvalidInput if the engine is not there or
/// cannot do what the scene asks for, if no need can be judged or no cylinder moves or touches.
EngineChoice choose_in_engine(const SceneFile& file, const std::string& engine,
                              const EngineChoiceOptions& options);

/// Runs the scene with a setting in this process, which the engine may end.
Trajectory run_in_engine(const EngineChoice& choice, const EngineSetting& setting,
                         const DisturbedScene& scene, bool with_depths);

/// Lines that give the cylinders of a size their shape: of C++, with `shape` in Bullet, and in ODE
/// geoms of `body` in `space`; of MuJoCo's XML.
std::string engine_lines(const std::string& engine, const EngineShape& shape,
                         const Cylinder& cylinder);

}  // namespace touchstone
