#pragma once

#include <string>
#include <vector>

#include "reports/campaign.hpp"
#include "reports/report.hpp"

namespace touchstone {

/// The worst configurations of every pair × candidate, each with truth, the candidate's answer and
/// that of the campaign's first, and the command that replays it: one of each kind of failure
/// first, then failures before mere errors, by severity, at most two of one class.
std::vector<WorstCase> worst_cases(const Campaign& campaign, const std::vector<CellScores>& scores);

/// One configuration with its truth and the candidates' answers, as in worst_cases and `replay`.
Examination examine(const Subject& subject, const std::vector<CandidateProcess*>& candidates,
                    const Bar& bar, double width = 1e-15);

/// For a shell; left alone where it needs no quotes.
std::string shell_quoted(const std::string& text);

/// "./touchstone", with the plug-ins that were added to it.
std::string program_name();

/// "./touchstone replay cylinder-box/rim-face/1/17".
std::string replay_command(const std::string& name);

}  // namespace touchstone
