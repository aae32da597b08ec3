#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "candidates/host/candidate_process.hpp"
#include "simulation/experiment.hpp"

namespace touchstone {

/// Which experiments are run, with whose contacts, and how finely.
struct ExperimentOptions {
  std::vector<const Experiment*> experiments;
  std::vector<const Candidate*> candidates;
  std::vector<double> steps = {1.0 / 240};  ///< s
  unsigned workers = 1;                     ///< processes; they do not change the result
  Limits limits;
};

/// Runs every experiment with every candidate at every step; docs/simulation.md has the result's
/// members. Times aside it depends on the options alone. Progress goes to standard error.
nlohmann::json run_experiments(const ExperimentOptions& options);

/// For a terminal of 80 columns.
std::string experiments_table(const nlohmann::json& result);

}  // namespace touchstone
