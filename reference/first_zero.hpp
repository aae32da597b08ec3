#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "contact.hpp"
#include "largest_gap.hpp"

namespace touchstone {

// When the signed distance of a moving body first reaches zero. It is the largest of functions that
// are linear in t, so it is convex, and each tangent lies below it (proofs.md, "The first touch").

/// The distance at one moment of a sweep, t in 0…1, and its tangent. Heights and slopes are in
/// quarters of metres, whose sums are finite.
struct Moment {
  double t;
  SignedDistance found;
  double height, slope;
  double lengths;  ///< All lengths together, metres: what rounding is relative to.

  bool approaches() const { return slope < 0; }
  /// What rounding may make of the height.
  double rounding() const { return rounding_part / 4 * lengths; }
  double zero_of_tangent() const { return t - height / slope; }
  /// Is it where a distance that was positive before is zero, but for rounding?
  bool is_at_zero() const { return approaches() && std::abs(height) <= proof_part / 4 * lengths; }
};

/// The end of a search.
struct FirstZero {
  bool is_reached;
  Moment at;  ///< The first zero; if there is none, the last moment that still approached it.
};

/// Keeps the first zero between a moment before it and one that is after it, or after the lowest
/// distance.
class FirstZeroSearch {
 public:
  /// Precondition: the distance is positive at the start, t = 0.
  explicit FirstZeroSearch(const Moment& start) : left_(start) {}

  /// Of the next moments, asks at(t) until the first zero is known or none is proven.
  template <class At>
  FirstZero find(At at) {
    // 114 bring sweeps of 1e6 sizes within rounding (proofs.md); 47 have been needed.
    constexpr int max_moments = 200;
    for (int i = 0; i < max_moments; ++i) {
      if (is_proven_positive()) return {false, left_};
      if (right_ && is_left_lowest(*right_)) return {true, left_};
      const double t = away_from_ends(next());
      if (!(t > left_.t)) return {true, left_};
      if (right_ && !(t < right_->t)) return {true, *right_};
      const Moment there = at(t);
      if (is_zero(there)) return {true, there};
      if (is_left_lowest(there)) return {true, left_};
      add(there);
    }
    return {true, left_};
  }

 private:
  struct Crossing {
    double t, height;
  };
  /// Where the left one's tangent meets that of one that no longer approaches, below the lowest
  /// distance.
  Crossing crossing(const Moment& right) const {
    const double fall = left_.height - right.height + right.slope * (right.t - left_.t);
    const double way = fall / (right.slope - left_.slope);
    return {left_.t + way, left_.height + left_.slope * way};
  }
  /// What rounding may make of their crossing's height.
  double rounding(const Moment& right) const {
    return std::max(left_.rounding(), right.rounding());
  }

  /// Do the tangents stay above zero?
  bool is_proven_positive() const {
    if (!left_.approaches()) return true;
    if (!right_) return left_.height + left_.slope * (1 - left_.t) > left_.rounding();
    return right_->height > 0 && crossing(*right_).height > rounding(*right_);
  }

  /// The tangent at the left one leads to a moment that is not behind the zero; a parabola leads
  /// next to it, and may lead past it. One that still is much too short, as next to a zero of an
  /// even higher order, is stretched.
  double next() {
    double first = left_.zero_of_tangent(), last = 1;
    if (right_ && right_->height > 0) {
      last = right_->slope > 0 ? right_->zero_of_tangent() : right_->t;
      if (!(first < last)) first = last = crossing(*right_).t;
    } else if (right_) {
      // The chord lies above the distance.
      const double part = left_.height / (left_.height - right_->height);
      last = left_.t + part * (right_->t - left_.t);
      if (right_->approaches()) first = std::max(first, right_->zero_of_tangent());
    }
    double t = first;
    const bool takes_parabola = before_left_ && !went_too_far_;
    if (takes_parabola) {
      constexpr double slow = 1.0 / 16;
      const bool is_slow = took_parabola_ && left_.height > slow * before_left_->height;
      stretch_ = is_slow ? 2 * stretch_ : 1;
      t = left_.t + stretch_ * way_to_zero_of_parabola(*before_left_);
    }
    took_parabola_ = takes_parabola;
    t = std::clamp(t, std::min(first, last), last);
    // A chord to a height that is nothing but rounding ends at the right one, which then may be
    // where the body leaves again: only tangents prove that no zero comes before.
    return right_ && t >= right_->t ? first : t;
  }
  /// Between two moments above zero, one of which may be so far away that rounding puts their
  /// crossing onto the other one: as far from either as that may be wrong, and ever farther where
  /// the distance hardly changes.
  double away_from_ends(double t) {
    if (!right_ || !(right_->height > right_->rounding())) return t;
    const double noise = margin_ * rounding(*right_);
    const double lo = left_.t + noise / right_->slope, hi = right_->t + noise / left_.slope;
    double between = t;
    if (lo < right_->t) between = std::max(between, lo);
    if (hi > left_.t) between = std::min(between, hi);
    margin_ = between == t ? 2 : 4 * margin_;
    return between;
  }
  /// From the left one, of the parabola that touches its tangent and has the curvature that both
  /// slopes tell; of one without zeros, to where it is lowest.
  double way_to_zero_of_parabola(const Moment& before) const {
    const double of_tangent = left_.height / -left_.slope;
    const double curvature = (left_.slope - before.slope) / (left_.t - before.t);
    const double bend = curvature / left_.slope * (left_.height / left_.slope);
    return bend < 0.5 ? of_tangent * 2 / (1 + std::sqrt(1 - 2 * bend)) : of_tangent / bend;
  }

  bool is_zero(const Moment& there) const {
    if (there.approaches()) return there.is_at_zero();
    return std::abs(there.height) <= there.rounding() && crossing(there).height >= -rounding(there);
  }
  /// Is there nothing but rounding between the left one and the lowest distance?
  bool is_left_lowest(const Moment& there) const {
    if (!(there.height > 0 && left_.height <= left_.rounding())) return false;
    if (there.approaches()) return there.height >= left_.height;
    return std::abs(crossing(there).height) <= rounding(there);
  }

  void add(const Moment& there) {
    went_too_far_ = !(there.height > 0 && there.approaches());
    if (went_too_far_) {
      right_ = there;
    } else {
      before_left_ = left_;
      left_ = there;
    }
  }

  Moment left_;
  std::optional<Moment> before_left_, right_;
  bool went_too_far_ = false, took_parabola_ = false;
  double stretch_ = 1, margin_ = 2;
};

}  // namespace touchstone
