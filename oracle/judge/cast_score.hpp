#pragma once

#include <array>
#include <optional>

#include "oracle/first_touch.hpp"
#include "oracle/judge/score.hpp"
#include "reference/cast.hpp"

namespace touchstone {

/// The configuration once A has gone the part t of its sweep, rounded to doubles.
Configuration swept(const Configuration& configuration, const Sweep& sweep, double t);

/// The true signed distance while A moves, metres, to 1e-15 of the larger size.
class DistanceInTime {
 public:
  /// Both have to live as long.
  DistanceInTime(const Configuration& c, const Sweep& sweep) : c_(c), sweep_(sweep) {}
  DistanceInTime(Configuration&&, const Sweep&) = delete;
  DistanceInTime(const Configuration&, Sweep&&) = delete;

  double at(double t) const;
  struct Moment {
    double t, distance;
  };
  /// When it is smallest within [first, last], by a search that takes it for convex, as it is
  /// unless A turns.
  Moment nearest(double first, double last) const;

 private:
  const Configuration& c_;
  const Sweep& sweep_;
};

/// Judgement of one answered cast, named after the symptom.
enum class CastOutcome {
  agree,         ///< within the bar
  late,          ///< passes through: the bodies overlap before the answered touch, or there
  early,         ///< stops short: they are apart there
  missed,        ///< no touch where A would overlap B
  made_up,       ///< a touch where there is none, and the bodies are apart there
  wrong_normal,  ///< the touch is right, its normal is not
  failed         ///< the candidate gave no answer
};
inline constexpr std::array all_cast_outcomes = {
    CastOutcome::agree,   CastOutcome::late,         CastOutcome::early, CastOutcome::missed,
    CastOutcome::made_up, CastOutcome::wrong_normal, CastOutcome::failed};
/// "agree", "late", "early", "missed", "made-up", "wrong-normal", "failed".
const char* outcome_name(CastOutcome outcome);
/// "touch", "never", "from-start".
const char* status_name(CastStatus status);
/// The same, and "undecided".
const char* status_name(oracle::FirstTouch::Status status);

/// A cast compared with the truth. Not by time, of which grazing bodies leave much open, but by
/// what it comes to in distance.
struct CastScore {
  CastOutcome outcome = CastOutcome::agree;
  /// Signed distance at the answered fraction, relative to error_size; negative: A went too far.
  /// Of an answered never where A would touch, how deep it goes at most, likewise negative.
  std::optional<double> distance;
  /// σ − g(n) of the answered normal where the touch is right, likewise relative; absent of a
  /// normal that is zero, which is none.
  std::optional<double> normal_regret;
};

CastScore score_cast(const Configuration& configuration, const Sweep& sweep,
                     const oracle::FirstTouch& truth, const Cast& answer, const Bar& bar);

}  // namespace touchstone
