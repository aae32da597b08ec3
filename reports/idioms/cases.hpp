#pragma once

#include <functional>
#include <string>
#include <vector>

#include "oracle/judge/score.hpp"
#include "oracle/truth.hpp"
#include "properties/identity.hpp"

namespace touchstone {

// The cases of a file of tests for an engine: few, of small numbers, and each of another kind.

/// A cylinder and another body, with what is true and what the engine makes of it.
struct IdiomCase {
  Identity identity;            ///< from which it was made by rounding
  Configuration configuration;  ///< its orientations are unit quaternions
  oracle::Truth truth;
  /// Of distances and clearances, metres. The second also excuses what rounding the numbers to
  /// float does.
  double tolerance, float_tolerance;
  std::string verdict;  ///< "right", or what is wrong, as outcomes are called
};

/// What the judge in such a file says of an answer; the same as in candidates/reproducers/tests.*,
/// in our own words for it (Outcome), "right" for agree.
std::string idiom_verdict(const Configuration& configuration, double true_distance,
                          double tolerance, const Answer& answer);

struct IdiomQuestion {
  std::vector<Pair> pairs;
  std::uint64_t seed, limit;
  Bar bar;
  bool is_single;  ///< does the engine compute in float?
  /// Do the bodies stand elsewhere in the file? Then no verdict may hang on how that is rounded.
  bool is_moved = false;
  /// What the engine answers to a case; null where it cannot be asked: nothing is known of it then.
  std::function<Answer(const Configuration&)> ask;
};

/// Of every arrangement of the pairs one case, those first that the engine gets wrong, then by the
/// size of their numbers, until there are so many; sorted by pair again. No case is near the limit
/// between right and wrong, or judged otherwise than a report judges it.
std::vector<IdiomCase> idiom_cases(const IdiomQuestion& question);

}  // namespace touchstone
