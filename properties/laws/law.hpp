#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "candidates/host/candidate_process.hpp"
#include "oracle/judge/score.hpp"

namespace touchstone {

/// The violation of one law.
struct Violation {
  /// Named after the symptom, as in reports: "missed", "wrong-normal", "not-invariant", "jump", …
  std::string failure;
  double amount = 0;   ///< size of the violation, relative to the smaller size
  std::string detail;  ///< one sentence with the numbers
};
/// A question with or without a hint.
struct HintedQuestion {
  Configuration configuration;
  std::optional<Vec3> previous_normal;
};

/// A property of every correct contact routine, whatever its method. A law is a pure function: it
/// asks a fixed list of questions about a configuration and judges the answers.
struct Law {
  std::string name;
  std::string statement;  ///< one sentence, with its tolerance

  bool (*applies)(const Configuration& configuration);

  /// The questions besides the configuration itself, asked in one session and in this order.
  std::vector<Configuration> (*questions)(const Configuration& configuration, const Bar& bar);

  /// `answers` belong to the configuration, then to the questions, then to the hinted questions.
  /// Precondition: all are a contact or none, and finite (other answers break the law "answers").
  std::optional<Violation> (*judge)(const Configuration& configuration,
                                    std::span<const Answer> answers, const Bar& bar);

  /// The last questions, which may depend on the answer to the configuration itself; null: none.
  std::vector<HintedQuestion> (*hinted_questions)(const Configuration& configuration,
                                                  const Answer& first, const Bar& bar) = nullptr;

  /// The threshold at which the law asks, metres; null: the bar's.
  double (*threshold)(const Configuration& configuration, const Bar& bar) = nullptr;
};

/// All laws, the law "answers" first.
const std::vector<Law>& all_laws();

/// The laws "hint" (hint_law.cpp) and "hull" (hull_law.cpp), two of all_laws.
Law hint_law(bool (*applies)(const Configuration& configuration));
Law hull_law(bool (*applies)(const Configuration& configuration));

/// How far the hull of the contact points moves at the steps of the law "hull", beyond what the
/// normal's turn carries it, relative to the larger size. A step does not count that chooses
/// another normal or leaves no overlap. `answers`: to the configuration, then to the law's
/// questions.
double hull_jump(const Configuration& configuration, std::span<const Answer> answers,
                 const Bar& bar);

/// Throws InvalidInput (field "--law") that lists the existing laws.
const Law& find_law(std::string_view name);

/// All failures that a law or a score can report.
const std::vector<std::string>& all_failures();

/// Asks one candidate in a session of its own and judges its answers. None if the law holds, does
/// not apply, or the candidate has no routine for the pair.
std::optional<Violation> broken(const Law& law, const Configuration& configuration,
                                CandidateProcess& candidate, const Bar& bar);

/// What each law finds, in their order; empty where the candidate has no routine for the pair.
using Violations = std::vector<std::optional<Violation>>;

/// Judges several laws about several configurations, at a fraction of the cost: the questions of
/// all of them are asked together in the candidate's present session, so that what was asked before
/// may matter: first the configurations, then what the laws ask about those that were answered,
/// then the last questions. An exchange of messages costs more than most answers. Returns what is
/// found about each configuration.
std::vector<Violations> broken_in_session(std::span<const Law* const> laws,
                                          std::span<const Configuration> configurations,
                                          CandidateProcess& candidate, const Bar& bar);
Violations broken_in_session(std::span<const Law* const> laws, const Configuration& configuration,
                             CandidateProcess& candidate, const Bar& bar);

/// The truth of a configuration. The last ones are remembered, on each thread: laws ask for the
/// same ones.
const oracle::Truth& truth_of(const Configuration& configuration);

/// The score of an answer. The last one of each remembered configuration is remembered, too.
const Score& score_of(const Configuration& configuration, const Answer& answer, const Bar& bar);

}  // namespace touchstone
