#pragma once

#include "simulation/scenes/scene_run.hpp"

namespace touchstone {

/// Looks, up to the moment at which the run's first need broke, through what its models were asked,
/// of the need's own bodies if they were, for the answer that is worst against the oracle. Absent
/// when nothing but the exact candidate was asked.
std::optional<Evidence> find_evidence(const SceneRun& run, const SceneFile& file,
                                      const Trajectory& went, const PairKinds& kinds,
                                      const Candidate& exact, Processes& processes);

// Verdicts and evidence on their way between two processes of this program.
std::string to_bytes(const SceneRun& run);
void from_bytes(const std::string& bytes, SceneRun& run);

}  // namespace touchstone
