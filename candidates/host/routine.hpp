#pragma once

#include <cfenv>
#include <cstdint>
#include <vector>

#include "candidates/host/exchange.hpp"

namespace touchstone {

/// The functions of one candidate, called in this process. Keeps the shapes of the last questions
/// prepared for the next pose of the same bodies, as a world does.
class Routine {
 public:
  /// Every question begins with the floating-point environment of now.
  Routine(const ts_candidate& candidate, Roundings roundings, double parameter);

  const ts_candidate& candidate() const { return candidate_; }
  /// Null if the candidate does not support the pair. To be released by its caller.
  ts_prepared* prepare(const Question& question) const;
  /// Fills the answer; TS_UNSUPPORTED where there is no routine for the pair. Returns what is known
  /// of the model.
  Modelled ask(const Question& question, ts_answer& answer);
  /// Releases the shapes that none of these slots needs.
  void release_all_but_of(const Questions& questions, std::uint32_t first, std::uint32_t end);
  void release_all();

 private:
  /// Two prepared shapes, for one pose after another.
  struct PreparedPair {
    ts_shape a;
    OwnedShape b;
    double threshold;
    ts_prepared* prepared;  ///< null if the pair is not supported

    bool is_for(const Question& question) const;
  };

  /// Prepares the shapes, or returns them if an earlier question had the same ones.
  ts_prepared* ready(const Question& question);

  const ts_candidate& candidate_;
  Roundings roundings_;
  double parameter_;
  std::fenv_t environment_;
  std::vector<PreparedPair> ready_;  ///< the last pairs of shapes queried, oldest first
};

}  // namespace touchstone
