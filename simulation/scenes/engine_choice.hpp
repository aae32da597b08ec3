#pragma once

#include <optional>
#include <string>
#include <vector>

#include "simulation/engines/run_engines.hpp"
#include "simulation/scenes/disturbed_scene.hpp"
#include "simulation/scenes/scene_file.hpp"

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
  /// absent where not measured.
  std::optional<double> step_seconds = {};

  bool has(EngineShape::Kind kind) const;
};

struct EngineChoiceOptions {
  unsigned workers = 1;  ///< processes; the runs do not depend on them
  Trials trials = {};
};

/// The cheapest setting of an engine that meets the needs of a scene, and all that were tried.
struct EngineChoice {
  SceneFile file;                     ///< with the needs that can be judged in an engine
  std::vector<std::string> left_out;  ///< texts of those that cannot: normals
  EngineDescription engine;
  std::vector<CylinderSize> sizes;
  std::vector<EngineSetting> settings = {};  ///< the engine's default first, then with our routines
  Trials trials = {};
  std::optional<std::size_t> answer = {};  ///< index of a setting; absent: none holds

  const EngineSetting& default_setting() const { return settings[0]; }
  const EngineSetting& exact_setting() const { return settings[1]; }
};

/// Runs the scene in an engine's own world with each shape that it offers for all cylinders, under
/// disturbances, each run in a process of its own; times those that hold; then searches by size.
/// Relative needs compare with the engine with our routines. The answer is the cheapest setting of
/// the engine's own; its default, unless that fails or another is cheaper by more than noise; our
/// routines where nothing else holds. Throws InvalidInput if the engine is not there or cannot do
/// what the scene asks for, if no need can be judged or no cylinder moves or touches.
EngineChoice choose_in_engine(const SceneFile& file, const std::string& engine,
                              const EngineChoiceOptions& options);

/// Runs the scene with a setting in this process, which the engine may end.
Trajectory run_in_engine(const EngineChoice& choice, const EngineSetting& setting,
                         const DisturbedScene& scene, bool with_depths);

/// Lines of C++ (Bullet, ODE) or XML (MuJoCo) that give the cylinders of a size their shape.
std::string engine_lines(const std::string& engine, const EngineShape& shape,
                         const Cylinder& cylinder);

}  // namespace touchstone
