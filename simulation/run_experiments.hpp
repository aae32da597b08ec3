#pragma once

#include <vector>

#include "candidates/host/candidate_process.hpp"
#include "simulation/experiment.hpp"
#include "simulation/experiment_results.hpp"

namespace touchstone {

/// Which experiments to run, with which candidates, at which steps.
struct ExperimentOptions {
  std::vector<const Experiment*> experiments;
  std::vector<const Candidate*> candidates;
  std::vector<double> steps = {1.0 / 240};  ///< s
  unsigned workers = 1;                     ///< processes; the results do not depend on them
  Limits limits;
};

/// Runs every experiment with every candidate at every step. Times aside the results depend on the
/// options alone. Progress goes to standard error. After an interruption (interruption.hpp) the
/// results of what was not done are missing.
ExperimentResults run_experiments(const ExperimentOptions& options);

}  // namespace touchstone
