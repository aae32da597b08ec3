#include "oracle/turning_touch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace touchstone::oracle {
namespace {

// Of a body that turns the signed distance is not convex in time, but along a fixed direction n the
// gap is known in closed form, and never more than the signed distance. It changes by at most
// −n·w + min(|ω × n|, |ω × u|) ρ per time, with A's axis u and its largest distance ρ from its
// centre: so it is followed in steps that cannot go too far (conservative advancement, Mirtich,
// "Impulse-based Dynamic Simulation", 1996, ch. 2) until it is next to zero, and there the truth
// gives the next direction.

constexpr double turning_roundoff = std::numeric_limits<double>::epsilon() / 2;
constexpr int max_directions = 100, max_advances = 300, max_widenings = 40;

class Turning {
 public:
  Turning(const Configuration& c, const Sweep& sweep)
      : c_(c),
        sweep_(sweep),
        reach_(std::hypot(c.a.radius(), c.a.half_length())),
        axis_turns_(sweep.spin().cross(c.pose_a.axis()).stableNorm()),
        // A turn, an axis and a product of quaternions are rounded by a few units, an angle by its
        // own; so are the terms of a gap.
        margin_(turning_roundoff * (64 + 4 * sweep.spin().stableNorm()) *
                (reach_ + larger_size(c) + sweep.translation().stableNorm())) {}

  /// The truth at t, of the orientation rounded to doubles, which is off by less than the margin.
  Truth truth_of_pose(double t) const {
    const Pose turned(c_.pose_a.position(), sweep_.moved(c_.pose_a, t).orientation());
    const Configuration moved{c_.a, turned, c_.b, c_.pose_b};
    return truth_at(t > 0 ? moved : c_, sweep_.translation(), mpq_class(t), truth_width);
  }

  /// A time until which the gap along n is positive, that is `distance` at t.
  double apart_until(double t, double distance, const Vec3& n) const {
    const double rate = fastest(n), start = height(t, n);
    if (!(rate > 0)) return beyond_the_end;
    double until = t, gap = distance - margin_;
    for (int i = 0; i < max_advances && gap > margin_; ++i) {
      const double next = until + gap / rate * almost_one;
      if (!(next > until)) break;
      if (next > 1) return beyond_the_end;
      until = next;
      gap = distance + height(until, n) - start - margin_;
    }
    return until;
  }

  /// By how much the gap along n falls in the whole sweep at most.
  double fastest(const Vec3& n) const {
    const double turns = std::min(sweep_.spin().cross(n).stableNorm(), axis_turns_);
    return std::max(0.0, reach_ * turns - n.dot(sweep_.translation()));
  }
  double margin() const { return margin_; }

  static constexpr double beyond_the_end = 2;

 private:
  static constexpr double truth_width = 1e-20, almost_one = 1 - 0x1p-40;

  /// The smallest a·n of A's points at t, from where A starts.
  double height(double t, const Vec3& n) const {
    const Vec3 axis = sweep_.moved(Pose(Vec3::Zero(), c_.pose_a.orientation()), t).axis();
    return t * sweep_.translation().dot(n) - c_.a.half_length() * std::abs(axis.dot(n)) -
           c_.a.radius() * axis.cross(n).norm();
  }

  const Configuration& c_;
  const Sweep& sweep_;
  double reach_;
  double axis_turns_;  ///< how fast A's axis turns: always as fast, for it keeps its angle to ω
  double margin_;
};

/// The first time after `apart` at which the bodies are proven to touch; far away, undecided.
FirstTouch between(const Turning& turning, double apart, double rate) {
  using Status = FirstTouch::Status;
  double ahead = std::max(8 * turning.margin() / rate, turning_roundoff);
  for (int i = 0; i < max_widenings; ++i, ahead *= 2) {
    const double t = std::min(1.0, apart + ahead);
    const Truth there = turning.truth_of_pose(t);
    if (there.signed_distance.hi + mpq_class(turning.margin()) <= 0) {
      return {Status::touch, {apart, t}, there};
    }
    const bool is_apart = there.signed_distance.lo > mpq_class(16 * turning.margin());
    if (is_apart || t == 1) break;
  }
  return {Status::undecided, {apart, 1}, {}};
}

}  // namespace

FirstTouch touch_of_turning(const Configuration& c, const Sweep& sweep) {
  using Status = FirstTouch::Status;
  const Turning turning(c, sweep);
  double t = 0, rate = 0;
  for (int i = 0; i < max_directions; ++i) {
    const Truth truth = turning.truth_of_pose(t);
    if (t == 0 && truth.signed_distance.lo <= 0) {
      const bool is_decided = truth.signed_distance.hi <= 0;
      return {is_decided ? Status::from_start : Status::undecided, {0, 0}, truth};
    }
    // Rounded down, as doubles of rationals are.
    const double distance = truth.signed_distance.lo.get_d();
    double until = t;
    for (const OptimalNormal& normal : truth.normals) {
      rate = std::max(rate, turning.fastest(normal.n));
      until = std::max(until, turning.apart_until(t, distance, normal.n));
    }
    if (until > 1) return {Status::never, {1, 1}, {}};
    const bool is_close = distance <= 16 * turning.margin() || !(until > t);
    t = until;
    if (is_close) return between(turning, t, rate);
  }
  return {Status::undecided, {t, 1}, {}};
}

}  // namespace touchstone::oracle
