#pragma once

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

/// An engine's name with our contact routines installed in it: "bullet+touchstone".
std::string cured_name(const std::string& engine);

struct EngineDescription {
  std::string name, version, settings;
};

/// Outcomes of the experiments in the engines' own worlds. The candidates are the engines, each
/// without and with our contact routines.
struct EngineResults {
  std::vector<EngineDescription> engines;
  ExperimentResults runs;
};

/// Runs every experiment in every engine, without and with our contact routines, each run in a
/// process of its own. Times aside the results depend on the options alone. Progress goes to
/// standard error. After an interruption (interruption.hpp) the results of what was not done are
/// missing. Throws InvalidInput (field "--engine") where there is no such engine.
EngineResults run_engines(const EngineOptions& options);

/// The motion of one run, as a page shows it.
struct Motion {
  Scene scene;
  double interval = 0;  ///< s, between frames
  /// Position and orientation (w, x, y, z) of every moving body, frame by frame; the frames end
  /// where the run did.
  std::vector<float> poses;
};

/// Runs an experiment that is a single run once more, and keeps its motion.
Motion record_motion(const Experiment& experiment, const std::string& engine, bool cured,
                     double step);

/// Table for a terminal of 80 columns.
std::string engines_table(const EngineResults& results);

/// The member `engines` of report.json (docs/inside-the-engines.md).
nlohmann::json to_json(const EngineResults& results);

}  // namespace touchstone
