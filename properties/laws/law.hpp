#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "oracle/judge/score.hpp"

namespace touchstone {

/// How one law was broken.
struct Violation {
  /// Named after the symptom, as in reports: "missed", "wrong-normal", "not-invariant", "jump", …
  std::string failure;
  double amount = 0;   ///< By how much, relative to the smaller size.
  std::string detail;  ///< One sentence with the numbers.
};

/// What is asked with a hint, or as if there were none.
struct Frame {
  Configuration configuration;
  std::optional<Vec3> previous_normal;
};

/// What every correct contact routine satisfies, whatever its method. A law is a pure function: it
/// asks a fixed list of questions about a configuration, and judges the answers.
struct Law {
  std::string name;
  std::string statement;  ///< One sentence, with the tolerance it is judged at.

  bool (*applies)(const Configuration& configuration);

  /// What to ask besides the configuration itself, in one session and in this order.
  std::vector<Configuration> (*questions)(const Configuration& configuration, const Bar& bar);

  /// `answers` belong to the configuration, then to the questions, then to the frames. Never called
  /// with answers that are neither a contact nor none, or not finite: that is the law "answers".
  std::optional<Violation> (*judge)(const Configuration& configuration,
                                    std::span<const Answer> answers, const Bar& bar);

  /// What to ask last, which may depend on the answer to the configuration itself; null: nothing.
  std::vector<Frame> (*frames)(const Configuration& configuration, const Answer& first,
                               const Bar& bar) = nullptr;

  /// In metres, where the law asks within another threshold than the bar's; null: the bar's.
  double (*threshold)(const Configuration& configuration, const Bar& bar) = nullptr;
};

/// All laws, the law "answers" first.
const std::vector<Law>& all_laws();

/// Throws InvalidInput (field "--law") naming those there are.
const Law& find_law(std::string_view name);

/// Every failure that a law or a score can report.
const std::vector<std::string>& all_failures();

/// Asks one candidate and judges. Nothing where the law does not apply or the candidate has no
/// routine for the pair.
std::optional<Violation> broken(const Law& law, const Configuration& configuration,
                                CandidateProcess& candidate, const Bar& bar);

}  // namespace touchstone
