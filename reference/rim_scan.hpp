#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "largest_gap.hpp"
#include "rims.hpp"

namespace touchstone {

/// Searches one pair of rims for every normal at which they meet, and offers them to `best`.
///
/// At a largest gap where these rims meet, their distance along rim 1, to the nearest point of rim
/// 2, has a local minimum. Arcs of rim 1 are bisected until one of five bounds proves of each arc
/// that it holds none that matters, or that it holds at most one, which is then found (proofs.md,
/// "The search of rims"). An arc for which all bounds fail down to `min_half_width` counts as
/// unproven.
///
/// `limit` is an upper bound of the bodies' distance, and is lowered on the way; `least_depth` a
/// lower bound of their depth, not positive where nothing is known.
class RimScan {
 public:
  RimScan(const FoldedCylinders& pair, const Rims& rims, double& limit, double least_depth,
          LargestGap& best)
      : pair_(pair),
        rims_(rims),
        limit_(limit),
        least_depth_(least_depth),
        best_(best),
        noise_(8 * rims.noise()) {}

  void scan(const Range& cosines) {
    // The ends of the range are rounded, and a minimum may lie at one of them.
    constexpr double beyond = 0.01;
    const double from = std::acos(cosines.hi) - beyond, to = std::acos(cosines.lo) + beyond;
    arc((from + to) / 2, (to - from) / 2);
  }

  /// By how much the largest gap where these rims meet may exceed the best one, but for rounding;
  /// zero where the search is proven complete.
  double unproven() const { return unproven_; }

 private:
  static constexpr double min_half_width = 1e-8;  // rad
  static constexpr double small_step = 1e-9;      // rad; its square is below rounding
  static constexpr int max_samples = 20000;

  RimSample at(double angle) {
    ++samples_;
    RimSample sample = rims_.at(angle);
    limit_ = std::min(limit_, sample.distance);
    return sample;
  }

  /// Distances that a largest gap can have: its bodies overlap by less than the best depth or are
  /// no further apart than `limit_`, and lie deeper than `least_depth_`.
  bool matters(double min_distance, double max_distance) const {
    return (min_distance - noise_ <= limit_ || min_distance + noise_ < -best_.gap) &&
           max_distance + noise_ >= least_depth_;
  }

  /// May the rims meet on such an arc, overlapping or, where the bodies may be, apart?
  bool may_meet(const RimSample& middle, double half_width, const Passage& passage) const {
    return rims_.may_meet(middle, -1, half_width, passage) ||
           (least_depth_ <= 0 && rims_.may_meet(middle, 1, half_width, passage));
  }

  void arc(double angle, double half_width) {
    const RimSample middle = at(angle);
    const double reach = rims_.radius1() * half_width;
    if (!matters(middle.distance - reach, middle.distance + reach)) return;
    const Passage passage = rims_.passage(middle, half_width);
    double bend = never;
    if (passage.min_radial > 0) {
      bend = rims_.max_bend(middle, half_width, passage) * half_width +
             noise_ * rims_.conditioning(passage.min_radial);
      const double change = (std::abs(middle.curvature) + bend) * half_width;
      if (std::abs(middle.slope) > change + noise_) return;  // no stationary distance
    }
    undecided(middle, half_width, passage, bend);
  }

  /// An arc that may have a stationary distance; the curvature differs by `bend` from the middle's.
  void undecided(const RimSample& middle, double half_width, const Passage& passage, double bend) {
    if (!may_meet(middle, half_width, passage)) return;
    if (rims_.has_only_maxima_beside_axis(middle, half_width, passage)) return;
    double reach = rims_.radius1() * half_width;
    if (bend < never) {
      const double slope = std::abs(middle.slope);
      const double change = (std::abs(middle.curvature) + bend) * half_width;
      reach = std::min(reach, reach_of_squares(middle.distance, (slope + change / 2) * reach));
      if (!matters(middle.distance - reach, middle.distance + reach)) return;
      if (slope + change <= noise_ && reach <= noise_) {  // one distance
        return leave(middle, reach, half_width);
      }
      if (middle.curvature + bend < 0) return;  // only maxima
      if (least_depth_ > 0 && rims_.points_inward(middle, half_width, passage)) return;
      const double min_curvature = middle.curvature - bend;
      if (min_curvature > 0) return steady(middle, half_width, min_curvature);
    }
    if (half_width <= min_half_width || samples_ > max_samples) {
      return leave(middle, reach, half_width);
    }
    arc(middle.angle - half_width / 2, half_width / 2);
    arc(middle.angle + half_width / 2, half_width / 2);
  }

  /// Of such an arc that stays off axis 2; negative infinity elsewhere.
  double least_curvature(const RimSample& middle, double half_width, const Passage& p) const {
    if (!(p.min_radial > 0)) return -std::numeric_limits<double>::infinity();
    return middle.curvature - rims_.max_bend(middle, half_width, p) * half_width -
           noise_ * rims_.conditioning(p.min_radial);
  }

  /// The distance is convex on the arc: Newton's method finds the one minimum or leaves the arc.
  void steady(const RimSample& middle, double half_width, double min_curvature) {
    const double fall = rims_.radius1() * middle.slope * middle.slope / min_curvature;
    const double squared = middle.distance * middle.distance - fall;
    if (squared > 0 && !matters(std::sqrt(squared), middle.distance)) return;
    double lo = middle.angle - half_width, hi = middle.angle + half_width;
    RimSample x = middle;
    double previous = 4 * half_width;
    constexpr int max_steps = 60;
    for (int i = 0; i < max_steps; ++i) {
      (x.slope < 0 ? lo : hi) = x.angle;
      double next = std::clamp(x.angle - x.slope / x.curvature, lo, hi);
      if (std::abs(next - x.angle) > previous / 2) next = (lo + hi) / 2;
      previous = std::abs(next - x.angle);
      x = at(next);
      if (previous <= small_step) break;
    }
    // Beyond an end of the arc the minimum is the neighbouring arc's.
    if (!(lo < hi) && std::abs(x.slope) > noise_) return;
    // The minimum is as near as the least curvature between it and x tells.
    const double slope = std::abs(x.slope) + noise_;
    double curvature = min_curvature;
    if (const double most = slope / min_curvature; most < half_width) {
      curvature = std::max(curvature, least_curvature(x, most, rims_.passage(x, most)));
    }
    const double change = rims_.radius1() * slope * slope / (2 * curvature);
    leave(x, reach_of_squares(x.distance, change), slope / curvature);
  }

  /// Offers the normal of an arc whose distances are within `reach` of this one and whose ends are
  /// within the angle `turn`, and counts what it may have missed.
  void leave(const RimSample& x, double reach, double turn) {
    const double nearest = std::max({x.distance - reach, least_depth_, 0.0});
    // No better than the best one, whether the bodies overlap by that distance or are that far
    // apart.
    const double enough = best_.gap + noise_;
    if (-nearest <= enough && (least_depth_ > 0 || limit_ <= enough)) return;
    offer(x);
    const Passage passage = rims_.passage(x, turn);
    if (rims_.may_meet(x, -1, turn, passage)) count_unproven(-nearest);
    if (least_depth_ <= 0 && rims_.may_meet(x, 1, turn, passage)) count_unproven(limit_);
  }
  void count_unproven(double gap) { unproven_ = std::max(unproven_, gap - best_.gap - noise_); }
  /// How far distances lie from one of them if half their squares lie within `change` of its.
  static double reach_of_squares(double distance, double change) {
    const double least = std::max(0.0, distance * distance - 2 * change);
    return 2 * change / (distance + std::sqrt(least));
  }

  /// Where the rims nearly touch their difference is noise, where tangents are parallel their
  /// product.
  void offer(const RimSample& x) {
    for (Vec3 n : {x.apart, rims_.across_tangents(x.cos1, x.sin1, x.cos2, x.sin2)}) {
      const double length = n.norm();
      if (!(length > 0)) continue;
      // Of ±n the one towards A has the larger gap, and of mirror images the one on A's side of
      // the plane of the axes. Rims that overlap by a hair show the other.
      n *= (n.dot(pair_.axes.d()) < 0 ? -1 : 1) / length;
      n.z() = std::abs(n.z());
      best_.offer(pair_.gap(n), n);
      const Vec3 better = rims_.polished(n).normal;
      best_.offer(pair_.gap(better), better);
      const double distance = rims_.distance_at(better);
      if (distance < limit_) limit_ = distance;
    }
  }

  const FoldedCylinders& pair_;
  const Rims& rims_;
  double& limit_;
  double least_depth_;
  LargestGap& best_;
  double noise_;
  int samples_ = 0;
  double unproven_ = 0;
};

}  // namespace touchstone
