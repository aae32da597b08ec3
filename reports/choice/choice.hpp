#pragma once

#include <string>

#include "reports/choice/shape_pairs.hpp"
#include "simulation/scenes/choose.hpp"

// Outputs of `touchstone choose`. `folder` holds the configurations of failures, one file each,
// for `touchstone replay`; `command` is the command line that a person would repeat.
namespace touchstone {

/// Text for a terminal of 80 columns: the answer, what fails first with cheaper models, and the run
/// of each candidate.
std::string choice_text(const Choice& choice, const std::string& folder);
std::string pairs_text(const PairsChoice& choice, const std::string& folder);

/// choose.json (docs/scenes.md); on one line, or indented.
std::string choice_json(const Choice& choice, const std::string& command, const std::string& folder,
                        int indent = -1);
std::string pairs_json(const PairsChoice& choice, const std::string& command,
                       const std::string& folder, int indent = -1);

/// One self-contained page with the exact run and others in motion; runs the scene again for them.
std::string choice_page(const Choice& choice, const std::string& command, const std::string& folder,
                        const Limits& limits);

/// Writes the configurations of failures. Throws InvalidInput (field "--out") where that fails.
void write_evidence(const Choice& choice, const std::string& folder);
void write_evidence(const PairsChoice& choice, const std::string& folder);

/// File of the evidence of a run, by its index; of a candidate on a pair of shapes.
std::string evidence_file(const Choice& choice, std::size_t run, const std::string& folder);
std::string evidence_file(const PairsChoice& choice, std::size_t pair,
                          const PairCandidate& candidate, const std::string& folder);
/// Command that shows the evidence.
std::string replay_command(const std::string& file, const std::string& candidate);

}  // namespace touchstone
