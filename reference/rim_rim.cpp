#include <algorithm>
#include <cmath>
#include <optional>

#include "deep_normals.hpp"
#include "rims.hpp"

namespace touchstone {
namespace {

/// Radius and half length.
struct Size {
  double r, h;
};

/// Vector from B's to A's point of two that are near each other, by so many rounds of alternating
/// projections, in the folded frame.
Vec3 facing_points(const FoldedAxes& f, const Size& a, const Size& b, int rounds = 2) {
  const auto nearest = [](const Size& s, const Vec3& x) -> Vec3 {
    const double squared = x.y() * x.y() + x.z() * x.z();
    const double scale = squared > s.r * s.r ? s.r / std::sqrt(squared) : 1;
    return {std::clamp(x.x(), -s.h, s.h), scale * x.y(), scale * x.z()};
  };
  const auto to_b = [&](const Vec3& x) -> Vec3 { return {f.along_u2(x), f.along_k2(x), x.z()}; };
  const auto from_b = [&](const Vec3& x) -> Vec3 {
    return {f.c * x.x() - f.s * x.y(), f.s * x.x() + f.c * x.y(), x.z()};
  };
  const Vec3 d = f.d();
  Vec3 on_a = d, on_b = Vec3::Zero();
  for (int i = 0; i < rounds; ++i) {
    on_b = from_b(nearest(b, to_b(on_a)));
    on_a = d + nearest(a, on_b - d);
  }
  return on_a - on_b;
}

/// Overlap of two largest balls within the cylinders that are near each other, negative if they
/// are apart: the bodies overlap by no less. A largest ball is as wide as its cylinder; the centres
/// of all of them fill a segment or a disc.
double overlap_of_balls(const FoldedCylinders& pair) {
  const auto centres = [](double r, double h) {
    return Size{std::max(r - h, 0.0), std::max(h - r, 0.0)};
  };
  return std::min(pair.r1, pair.h1) + std::min(pair.r2, pair.h2) -
         facing_points(pair.axes, centres(pair.r1, pair.h1), centres(pair.r2, pair.h2)).norm();
}

/// Offers the normal of the rim of the sum of two cylinders with parallel axes, which is a
/// cylinder.
void offer_parallel_rim_normal(const FoldedCylinders& pair, LargestGap& best) {
  const FoldedAxes& f = pair.axes;
  const double beyond_cap = std::abs(f.d1) - pair.h1 - pair.h2;
  const double radial = std::sqrt(f.d2 * f.d2 + f.d3 * f.d3);
  const double beyond_side = radial - pair.r1 - pair.r2;
  if (!(beyond_cap > 0 && beyond_side > 0)) return;
  const Vec3 n = Vec3(std::copysign(beyond_cap, f.d1), beyond_side * f.d2 / radial,
                      beyond_side * f.d3 / radial)
                     .normalized();
  best.offer(pair.gap(n), n);
}

/// Whether a maximum of bodies that overlap, stationary to rounding, is the largest gap.
///
/// At depth δ, g + δ |n| is concave as a function of the ray along n where the sum of the bodies is
/// rounder than a ball of that radius: at n3 >= κ (the Hessian at `Rims::polished`; ρ1 ρ2 is at
/// most (ρ1² + ρ2²) / 2). So no other normal there has more, but for what the slope leaves. With a
/// smaller n3 the gap is at most that of the bodies' shadows in the plane of the axes, which are
/// rectangles, and n3 d3.
bool is_largest_where_round(const FoldedCylinders& pair, const LargestGap& maximum) {
  const FoldedAxes& f = pair.axes;
  const double delta = -maximum.gap, r1 = pair.r1, r2 = pair.r2;
  const double round = (1 - delta / r1) * (1 - delta / r2);
  if (!(delta < r1)) return false;
  const double kappa = std::sqrt(1 - round) / f.s * (1 + f.c) / (1 + std::sqrt(round));
  if (!(kappa < 1 && maximum.normal.z() > kappa)) return false;
  return f.d3 * kappa + delta < -pair.gap_of_shadows() * std::sqrt(1 - kappa * kappa);
}

/// Whether `bends_away` proves a stationary normal of two rims the best.
bool is_largest_at_shallow_depth(const FoldedCylinders& pair, const Stationary& found, double gap) {
  const Vec3& n = found.normal;
  const double c = pair.axes.c, s = pair.axes.s, m = pair.axes.along_k2(n);
  const double across1 = std::sqrt(n.y() * n.y() + n.z() * n.z());
  const double across2 = std::sqrt(m * m + n.z() * n.z());
  const double sine = s * n.z() / (across1 * across2);
  const Rim a{pair.r1, pair.h1}, b{pair.r2, pair.h2};
  const double delta = std::max(0.0, -gap), slope = found.slope;
  if (bends_away(a, b, sine * sine, delta, slope)) return true;
  const Vec3 d = pair.axes.d();
  const double along = pair.axes.along_u2(d), across = pair.axes.along_k2(d);
  return pair.axes.along_u2(n) * along >= 0 &&
         bends_away_near_axis(a, b, std::max(across1, across2), sine * sine, delta, slope,
                              {pair.r2, pair.h2, pair.r1, pair.h1, c, s, std::abs(along),
                               std::sqrt(across * across + d.z() * d.z())});
}

/// Whether the maximum at which two rims meet is the largest gap, but for rounding.
bool is_largest(const FoldedCylinders& pair, const Stationary& found, const LargestGap& there) {
  const double rounding = pair.proof_rounding();
  return is_met_by_points(there.gap, found.slope, rounding) ||
         is_largest_at_shallow_depth(pair, found, there.gap) ||
         (there.gap <= 0 && found.slope <= rounding && is_largest_where_round(pair, there));
}

/// Ends whose rims meet: +1 or −1 along each axis, as the normal points.
struct Ends {
  double one, two;
};

/// The ends that a normal points to. Along an axis that it is across, the end beyond which the
/// bodies meet.
Ends likely_ends(const FoldedCylinders& pair, const Vec3& n) {
  const FoldedAxes& f = pair.axes;
  constexpr double across = 1e-15;
  const double along1 = n.x(), along2 = f.along_u2(n);
  Ends ends{std::copysign(1, along1), std::copysign(1, along2)};
  if (std::abs(along1) <= across && std::abs(along2) <= across) {  // the sides cross
    const auto [t1, t2] = f.crossing();
    ends = {std::copysign(1, t1), std::copysign(1, t2)};
  } else if (std::abs(along1) <= across) {
    ends.one = -std::copysign(1, pair.from_axis1(n).along);
  } else if (std::abs(along2) <= across) {
    ends.two = std::copysign(1, pair.from_axis2(n).along);
  }
  return ends;
}

/// Offers the normal at which these rims meet. True if it is the largest gap of all or exceeds
/// `stop_above`.
bool offer_where_likely(const FoldedCylinders& pair, const Rims& rims, double stop_above,
                        LargestGap& best) {
  // As deep in each other as this, bodies hardly ever come free where rims meet, but for caps that
  // lean to each other by a hair.
  constexpr double deep = 0.3, hair = 0.11;
  if (pair.axes.s > hair &&
      -best.gap > deep * (std::min(pair.r1, pair.h1) + std::min(pair.r2, pair.h2)))
    return false;
  Vec3 start;
  if (const auto crossing = rims.crossing_normal()) {
    start = *crossing;
  } else {
    start = facing_points(pair.axes, {pair.r1, pair.h1}, {pair.r2, pair.h2});
  }
  if (!(start.squaredNorm() > 0)) return false;
  if (stop_above < no_early_exit) {
    // Bodies that are clearly apart are so along it, too.
    const Vec3 n = start.normalized();
    const double gap = pair.gap(n);
    if (gap > stop_above + pair.clear_gap()) {
      best.offer(gap, n);
      return true;
    }
  }
  const double before = best.gap;
  constexpr int few_steps = 8;
  const Stationary found = rims.polished(start, few_steps);
  if (!(found.normal.z() >= 0)) return false;
  const LargestGap there{pair.gap(found.normal), found.normal};
  best.offer(there.gap, there.normal);
  // Along axes that are parallel but for rounding the best one may be as good.
  return best.gap > stop_above ||
         (found.maximum && there.gap >= before - tie_part * pair.lengths() &&
          is_largest(pair, found, there));
}

/// Searches one pair of rims for every normal at which they meet, and offers them to `best`.
///
/// At a largest gap where these rims meet, their distance along rim 1, to the nearest point of rim
/// 2, has a local minimum. Arcs of rim 1 are bisected until a bound proves of each arc that it
/// holds none that matters, or that it holds at most one, which is then found (proofs.md, "The
/// search of rims"). An arc for which all bounds fail down to `min_half_width` counts as unproven.
///
/// `limit` is an upper bound of the bodies' distance, and is lowered on the way; `least_depth` a
/// lower bound of their depth, not positive where nothing is known. A depth that is less than the
/// best one by no more than what is `negligible` is not looked for.
class RimScan {
 public:
  RimScan(const FoldedCylinders& pair, const Rims& rims, double& limit, double least_depth,
          double negligible, LargestGap& best)
      : pair_(pair),
        rims_(rims),
        limit_(limit),
        least_depth_(least_depth),
        best_(best),
        noise_(rims.margin() + clearance_part * pair.lengths()),
        negligible_(std::max(noise_, negligible)) {}

  void scan(const Range& cosines) {
    // The ends of the range are rounded, and a minimum may lie at one of them.
    constexpr double beyond = 0.01;
    const double from = std::acos(cosines.hi) - beyond, to = std::acos(cosines.lo) + beyond;
    // On wider arcs the bounds are hardly ever narrow enough.
    constexpr double wide = 0.8;
    const double pieces = std::ceil((to - from) / wide);
    const Angle half((to - from) / (2 * pieces));
    for (double i = 0.5; i < pieces; ++i) search(arc({from + i * 2 * half.radians}, half));
  }

  /// No gap of bodies that overlap and meet at these rims is larger than this or than the best one.
  double highest() const { return highest_ + rims_.distance_rounding(); }
  /// Whether these rims may be where bodies meet that are apart.
  bool may_be_apart() const { return may_be_apart_; }

 private:
  static constexpr double min_half_width = 1e-8;  // rad
  // The bounds hold on a little more than each arc: angles are rounded as they are bisected.
  static constexpr double overlap = 1 + 1e-5;
  // Of all lengths: what `limit_`, gaps and the place of rim 2's centre are rounded.
  static constexpr double clearance_part = 24 * unit_roundoff;
  static constexpr double small_step = 1e-9;  // rad; its square is below rounding
  // What is left after so many samples is divided only so far that on each arc rim 1, and rim 2's
  // nearest point about axis 2, go on by no more than this.
  static constexpr int max_samples = 20000, last_sample = 3 * max_samples;
  static constexpr int many_samples = 2000;  // are taken only where the distance hardly varies
  static constexpr double coarse_way = 2e-3, coarse_turn = 0.05;  // rad

  /// With its cosine and sine: those of a bisected arc cost less than new ones.
  struct Angle {
    double radians, cosine, sine;

    Angle(double angle) : radians(angle), cosine(std::cos(angle)), sine(std::sin(angle)) {}
    Angle(double angle, double cos, double sin) : radians(angle), cosine(cos), sine(sin) {}
    Angle half() const {
      const double c = std::sqrt((1 + cosine) / 2);
      return {radians / 2, c, sine / (2 * c)};
    }
    /// The cosine and sine are of a unit vector again, to rounding.
    Angle operator+(const Angle& x) const {
      const double c = cosine * x.cosine - sine * x.sine, s = sine * x.cosine + cosine * x.sine;
      const double scale = 1.5 - 0.5 * (c * c + s * s);
      return {radians + x.radians, scale * c, scale * s};
    }
    Angle operator-() const { return {-radians, cosine, -sine}; }
  };

  RimSample at(const Angle& x) {
    ++samples_;
    RimSample sample = rims_.at(x.radians, x.cosine, x.sine);
    limit_ = std::min(limit_, sample.distance);
    return sample;
  }

  /// Whether a largest gap can have such a distance: the bodies overlap by less than the best depth
  /// or are no further apart than `limit_`, and overlap by no less than `least_depth_`. A depth
  /// that is less than the best one by rounding does not matter, but counts.
  bool matters(double min_distance, double max_distance) {
    if (!(max_distance + noise_ >= least_depth_)) return false;
    if (min_distance - noise_ <= limit_ || min_distance + negligible_ < -best_.gap) return true;
    highest_ = std::max(highest_, -min_distance);
    return false;
  }

  /// Whether the rims may meet on the arc, overlapping or, where the bodies may be apart, apart.
  bool may_meet(const RimSample& middle, double half_width, const Passage& passage) const {
    return rims_.may_meet(middle, -1, half_width, passage) ||
           (least_depth_ <= 0 && rims_.may_meet(middle, 1, half_width, passage));
  }

  /// An arc up to `half` from its middle, with bounds on all of it and a little more.
  struct Arc {
    Angle angle, half;
    double half_width;
    RimSample middle;
    Passage passage;
    double bend, change;
  };
  Arc arc(const Angle& angle, const Angle& half) {
    const RimSample middle = at(angle);
    const double half_width = overlap * half.radians;
    const Passage passage = rims_.passage(middle, half_width);
    const double bend = rims_.max_bend(middle, half_width, passage, samples_ > many_samples);
    const double bends = (bend + passage.rounding_of_curvature) / 2;
    return {angle,
            half,
            half_width,
            middle,
            passage,
            bend,
            (std::abs(middle.curvature) + bends) * half_width};
  }

  void search(const Arc& x) {
    const double reach = rims_.radius1() * x.half_width;
    if (!matters(x.middle.distance - reach, x.middle.distance + reach)) return;
    // No stationary distance? Next to axis 2 the change is infinite.
    if (std::abs(x.middle.slope) > x.change + x.passage.rounding) return;
    if (is_decided(x.middle, x.half_width, x.passage, x.bend, x.change)) return;
    // Both before either is searched: the processor computes them at once.
    const Angle quarter = x.half.half();
    const Arc left = arc(x.angle + -quarter, quarter), right = arc(x.angle + quarter, quarter);
    search(left);
    search(right);
  }

  /// Treats an arc that may have a stationary distance; false where it has to be bisected.
  [[gnu::noinline]] bool is_decided(const RimSample& middle, double half_width,
                                    const Passage& passage, double bend, double change) {
    if (middle.curvature + bend < 0) return true;  // only maxima
    if (least_depth_ > 0 && rims_.points_inward(middle, half_width, passage)) return true;
    if (!may_meet(middle, half_width, passage)) return true;
    const double slope = std::abs(middle.slope), way = rims_.radius1() * half_width;
    const double reach = std::min(
        way, reach_of_squares(middle.distance, (slope + passage.rounding + change / 2) * way));
    if (!matters(middle.distance - reach, middle.distance + reach)) return true;
    const bool has_one_distance =
        reach <= noise_ && (slope + change <= noise_ || !(passage.min_radial > 0));
    if (!has_one_distance) {
      if (middle.curvature > bend) {
        converge(middle, half_width, middle.curvature - bend, passage.rounding);
        return true;
      }
      if (rims_.has_only_maxima_beside_axis(middle, half_width, passage)) return true;
      if (half_width > min_half_width && samples_ <= last_sample &&
          (samples_ <= max_samples || !is_coarse(half_width, passage)))
        return false;
      offer_lowest(middle, half_width);
    }
    leave(middle, reach, half_width);
    return true;
  }

  static bool is_coarse(double half_width, const Passage& passage) {
    return 2 * half_width <= coarse_way && passage.min_radial > 0 &&
           2 * half_width * passage.turn <= coarse_turn;
  }

  /// The stationary distance between two angles, of which the lower one has a negative slope and
  /// the higher one a positive one, by Newton's method in a bracket; an end where that is not so.
  RimSample stationary_between(RimSample x, double& lo, double& hi) {
    double previous = 2 * (hi - lo);
    constexpr int max_steps = 60;
    for (int i = 0; i < max_steps; ++i) {
      (x.slope < 0 ? lo : hi) = x.angle;
      double next = std::clamp(x.angle - x.slope / x.curvature, lo, hi);
      if (!(std::abs(next - x.angle) <= previous / 2)) next = (lo + hi) / 2;
      previous = std::abs(next - x.angle);
      x = at({next});
      if (previous <= small_step) break;
    }
    return x;
  }

  /// Of an arc that no bound decides: the minimum between ends towards which the distance rises.
  void offer_lowest(const RimSample& middle, double half_width) {
    double lo = middle.angle - half_width, hi = middle.angle + half_width;
    if (at({lo}).slope < 0 && at({hi}).slope > 0) offer(stationary_between(middle, lo, hi));
  }

  /// The distance is convex on the arc: Newton's method finds the one minimum or leaves the arc.
  /// Slopes on it are rounded by at most `rounding`.
  void converge(const RimSample& middle, double half_width, double min_curvature, double rounding) {
    const double steepest = std::abs(middle.slope) + rounding;
    const double fall = rims_.radius1() * steepest * steepest / min_curvature;
    const double squared = middle.distance * middle.distance - fall;
    if (squared > 0 && !matters(std::sqrt(squared), middle.distance)) return;
    double lo = middle.angle - half_width, hi = middle.angle + half_width;
    const RimSample x = stationary_between(middle, lo, hi);
    // Beyond an end of the arc the minimum is the neighbouring arc's.
    if (!(lo < hi) && std::abs(x.slope) > rounding) return;
    // The minimum is as near as the least curvature between it and x tells.
    const double slope = std::abs(x.slope) + rounding;
    double curvature = min_curvature;
    if (const double width = slope / min_curvature; width < half_width) {
      curvature =
          std::max(curvature, x.curvature - rims_.max_bend(x, width, rims_.passage(x, width)));
    }
    const double change = rims_.radius1() * slope * slope / (2 * curvature);
    leave(x, reach_of_squares(x.distance, change), slope / curvature);
  }

  /// Offers the normal of an arc whose distances are within `reach` of the sample's and whose
  /// angles are within `turn` of its angle, and counts by how much another one there may be better.
  void leave(const RimSample& x, double reach, double turn) {
    const double nearest = std::max({x.distance - reach, least_depth_, 0.0});
    offer(x);
    const Passage passage = rims_.passage(x, turn);
    if (rims_.may_meet(x, -1, turn, passage)) highest_ = std::max(highest_, -nearest);
    if (least_depth_ <= 0 && rims_.may_meet(x, 1, turn, passage)) may_be_apart_ = true;
  }
  /// How far a distance can be from this one when half their squares differ by at most `change`.
  static double reach_of_squares(double distance, double change) {
    const double least = std::max(0.0, distance * distance - 2 * change);
    return 2 * change / (distance + std::sqrt(least));
  }

  /// Offers the normal along the rims' difference, which is noise where they nearly touch, or that
  /// across their tangents, which is noise where these are parallel: both, unless the first leads
  /// to a maximum.
  void offer(const RimSample& x) {
    const Vec3 across = rims_.across_tangents(x.cos1, x.sin1, x.cos2, x.sin2);
    const bool nearly_touch = x.distance < 1e6 * noise_;
    for (Vec3 n : {nearly_touch ? across : x.apart, nearly_touch ? x.apart : across}) {
      const double length = n.norm();
      if (!(length > 0)) continue;
      // The one of ±n towards A has the larger gap; so has, of mirror images, the one on A's side
      // of the plane of the axes. Rims that overlap by a hair show the other one.
      n *= (n.dot(pair_.axes.d()) < 0 ? -1 : 1) / length;
      n.z() = std::abs(n.z());
      best_.offer(pair_.gap(n), n);
      const Stationary found = rims_.polished(n);
      best_.offer(pair_.gap(found.normal), found.normal);
      const double distance = rims_.distance_at(found.normal);
      if (distance < limit_) limit_ = distance;
      if (found.maximum) return;
    }
  }

  const FoldedCylinders& pair_;
  const Rims& rims_;
  double& limit_;
  double least_depth_;
  LargestGap& best_;
  double noise_, negligible_;
  int samples_ = 0;
  double highest_ = -std::numeric_limits<double>::infinity();
  bool may_be_apart_ = false;
};

/// What is known of the bodies' distance before their rims are searched.
struct DistanceBounds {
  double rounding;
  double least_depth;  ///< They overlap by no less; not positive where nothing is known.
  double limit;        ///< They are no further apart, but for rounding.

  explicit DistanceBounds(const FoldedCylinders& pair)
      : rounding((points_part + pair.axes.unit_error()) * pair.lengths()),
        least_depth(overlap_of_balls(pair) - rounding),
        limit(least_depth > 0
                  ? 0
                  : facing_points(pair.axes, {pair.r1, pair.h1}, {pair.r2, pair.h2}).norm()) {}
  double highest_gap() const { return least_depth > 0 ? -least_depth : limit; }

 private:
  static constexpr double points_part = 20 * unit_roundoff;  // proofs.md
};

// Tilts that only rounding makes cost no more than rounding.
constexpr double parallel = 2e-16;

}  // namespace

void offer_rim_rim_normals(const FoldedCylinders& pair, double stop_above, LargestGap& best) {
  if (pair.axes.s <= parallel) return offer_parallel_rim_normal(pair, best);
  const Ends likely = likely_ends(pair, best.normal);
  if (offer_where_likely(pair, Rims(pair, likely.one, likely.two), stop_above, best)) return;

  offer_parallel_rim_normal(pair, best);
  DistanceBounds bounds(pair);
  if (-best.gap <= bounds.least_depth) return;
  for (const double end1 : {likely.one, -likely.one}) {
    for (const double end2 : {likely.two, -likely.two}) {
      if (overlap_too_deeply(pair, end1 == end2, bounds.least_depth)) continue;
      const Rims rims(pair, end1, end2);
      const Range useful = rims.useful_cosines(best.gap, bounds.highest_gap());
      if (useful.empty()) continue;
      RimScan(pair, rims, bounds.limit, bounds.least_depth, 0, best).scan(useful);
      // Apart by the gap, with points no further apart: nothing is better.
      if (best.gap > stop_above || best.gap >= bounds.limit - tie_part * pair.lengths()) return;
    }
  }
}

/// Whether the bodies overlap for certain: two points that are well within them by more than
/// rounding are no further apart than that.
bool overlap_for_certain(const FoldedCylinders& pair, double rounding) {
  const double within = 4 * rounding;
  if (!(std::min({pair.r1, pair.h1, pair.r2, pair.h2}) > within)) return false;
  const Size a{pair.r1 - within, pair.h1 - within}, b{pair.r2 - within, pair.h2 - within};
  for (const int rounds : {2, 20}) {
    if (facing_points(pair.axes, a, b, rounds).norm() <= within) return true;
  }
  return false;
}

double search_all_rims(const FoldedCylinders& pair, LargestGap& best) {
  offer_parallel_rim_normal(pair, best);
  if (pair.axes.s <= parallel) return 0;
  DistanceBounds bounds(pair);
  const double negligible = rounding_part * pair.lengths();
  double highest = best.gap;
  bool may_be_apart = false;
  for (const double end1 : {1.0, -1.0}) {
    for (const double end2 : {1.0, -1.0}) {
      const Rims rims(pair, end1, end2);
      offer_where_likely(pair, rims, no_early_exit, best);
      RimScan scan(pair, rims, bounds.limit, bounds.least_depth, negligible, best);
      scan.scan({-1, 1});
      highest = std::max(highest, scan.highest());
      may_be_apart = may_be_apart || scan.may_be_apart();
    }
  }
  if (may_be_apart && !(best.gap < 0 && overlap_for_certain(pair, bounds.rounding))) {
    highest = std::max(highest, bounds.limit + bounds.rounding);
  }
  return std::max(0.0, highest - best.gap);
}

bool is_proven_where_rims_meet(const FoldedCylinders& pair, const LargestGap& best) {
  const double end1 = std::copysign(1, best.normal.x());
  const Rims rims(pair, end1, std::copysign(1, pair.axes.along_u2(best.normal)));
  for (const Vec3& n : {best.normal, rims.polished(best.normal).normal}) {
    const LargestGap there{pair.gap(n), n};
    if (there.gap >= best.gap - tie_part * pair.lengths() &&
        is_largest(pair, {n, true, rims.slope_at(n)}, there)) {
      return true;
    }
  }
  return false;
}

}  // namespace touchstone
