#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "candidates/host/candidate_process.hpp"
#include "oracle/judge/score.hpp"
#include "properties/identity.hpp"
#include "reports/campaign.hpp"
#include "reports/report.hpp"

namespace touchstone {

/// Is `a` the worse failure? Those without an answer are, then those of larger severity; any
/// failure is worse than agreement.
bool is_worse(const Score& a, const Score& b);

/// The score of one candidate on one configuration.
struct Case {
  std::size_t cell;     ///< pair × class, in report order
  std::uint64_t index;  ///< of the configuration in its class
  Score score;

  /// The worse one first (is_worse); equal ones in report order.
  bool operator<(const Case& other) const;
};

/// Selects from the cases of one class the two worst and the worst of each outcome, worst first.
/// Cases that a candidate does not support are left out. The worst of two sets together are the
/// worst of the worst of each.
std::vector<Case> worst_of_class(std::vector<Case> cases);

/// Selects from what worst_of_class gave of all classes under a heading (pair × group) the worst of
/// each outcome, and what else is worst up to four, worst first.
std::vector<Case> worst_of_heading(std::vector<Case> cases);

/// Examines one configuration, as in a report's worst cases and `replay`: each candidate answers in
/// a new session. `width`: of the truth, relative to the larger size.
Examination examine(const Subject& subject, std::span<CandidateProcess* const> candidates,
                    const Bar& bar, double width = truth_width);

/// Quotes a word for a shell; left alone where it needs no quotes.
std::string shell_quoted(const std::string& text);

/// "./touchstone", with all options that added candidates.
std::string program_name();
/// "./touchstone", with those that added these.
std::string program_name(const std::vector<std::string>& candidates);

/// "./touchstone replay cylinder-box/rim-face/1/17", which these candidates have to answer.
std::string replay_command(const std::string& name, const std::vector<std::string>& candidates);
/// The command for a configuration that has no identity: "echo '{…}' | ./touchstone replay -".
std::string replay_command(const Configuration& configuration,
                           const std::vector<std::string>& candidates);

}  // namespace touchstone
