#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "candidates/host/candidate_process.hpp"
#include "candidates/host/exchange.hpp"

namespace touchstone {

/// One question to a candidate.
struct Asked {
  const Configuration* configuration;
  double threshold;             ///< metres
  const Vec3* previous_normal;  ///< the hint; null: there was no contact before
};

/// The same as candidates of the C interface get it.
Question question_of(const Asked& asked);

/// Why a question has no answer.
struct NoAnswer {
  ts_status status;  ///< TS_CRASHED or TS_TIMED_OUT
  std::string reason;
  bool is_of_first = false;  ///< the first question without an answer was the one in hand
  bool is_certain = false;   ///< and is certainly the cause
};

/// Carries questions to a candidate and brings its answers back. CandidateProcess decides what is
/// asked again after a failure.
class Respondent {
 public:
  virtual ~Respondent() = default;
  /// Fills the answers to these questions, at most batch_size, in their order, all of them unless
  /// it fails. `release`: shapes are released once they are not needed, instead of being kept for
  /// later questions.
  virtual std::optional<NoAnswer> ask(std::span<const Asked> asked, bool release,
                                      std::span<std::optional<Answer>> answers) = 0;
  /// Learns that a failure stands for the answer to its question.
  virtual void judge(const NoAnswer& /*failure*/) {}
  /// Forgets what it has learnt from failures: a run's answers depend on that run alone.
  virtual void forget() {}
  /// Ends the session. The next question begins a new one.
  virtual void end_session() = 0;
  virtual void release_shapes() { end_session(); }
  virtual bool prepare_timing(std::span<const Asked> /*asked*/) { return false; }
  virtual std::optional<QueryCost> cost_per_query() { return std::nullopt; }
};

}  // namespace touchstone
