#include "rim_rim.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "deep_normals.hpp"
#include "rim_scan.hpp"

namespace touchstone {
namespace {

/// Radius and half length.
struct Size {
  double r, h;
};

/// Two points of cylinders of these sizes that are near each other, by alternating projections:
/// from B's to A's, in the folded frame.
Vec3 facing_points(const FoldedAxes& f, const Size& a, const Size& b) {
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
  constexpr int rounds = 2;
  for (int i = 0; i < rounds; ++i) {
    on_b = from_b(nearest(b, to_b(on_a)));
    on_a = d + nearest(a, on_b - d);
  }
  return on_a - on_b;
}

/// The largest balls within a cylinder are as wide as it; their centres fill a segment or a disc.
/// How far two such balls, near each other, overlap: the bodies do so no less. Negative if they do
/// not.
double overlap_of_balls(const FoldedCylinders& pair) {
  const auto centres = [](double r, double h) {
    return Size{std::max(r - h, 0.0), std::max(h - r, 0.0)};
  };
  return std::min(pair.r1, pair.h1) + std::min(pair.r2, pair.h2) -
         facing_points(pair.axes, centres(pair.r1, pair.h1), centres(pair.r2, pair.h2)).norm();
}

/// With parallel axes the sum of two cylinders is a cylinder; its rim has this normal.
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

/// Whether a local maximum of the gap is the largest gap.
///
/// Apart, the gap is concave as far as it is positive. At depth δ, g + δ |n| is concave as a
/// function of the ray along n where the sum of the bodies is rounder than a ball of that radius:
/// at n3 >= κ (the Hessian at `Rims::polished`; ρ1 ρ2 is at most (ρ1² + ρ2²) / 2). So no other
/// normal there has more. With a smaller n3 the gap is at most that of the bodies' shadows in the
/// plane of the axes, which are rectangles, and n3 d3.
bool is_largest_where_round(const FoldedCylinders& pair, const LargestGap& maximum) {
  const FoldedAxes& f = pair.axes;
  // Along nearly parallel axes the gap is flat, and Newton's last step small anywhere.
  constexpr double parallel = 1e-2;
  if (f.s < parallel) return false;
  if (maximum.gap > 0) return true;
  const double delta = -maximum.gap, r1 = pair.r1, r2 = pair.r2;
  const double round = (1 - delta / r1) * (1 - delta / r2);
  if (!(delta < r1)) return false;
  const double kappa = std::sqrt(1 - round) / f.s * (1 + f.c) / (1 + std::sqrt(round));
  if (!(kappa < 1 && maximum.normal.z() > kappa)) return false;
  return f.d3 * kappa + delta < -pair.gap_of_shadows() * std::sqrt(1 - kappa * kappa);
}

/// The proofs of `bends_away` for a stationary normal of two rims.
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

bool is_largest(const FoldedCylinders& pair, const Stationary& found, const LargestGap& best) {
  return is_largest_at_shallow_depth(pair, found, best.gap) || is_largest_where_round(pair, best);
}

/// Which ends' rims meet: +1 or -1 along each axis, as seen from B to A.
struct Ends {
  double one, two;
};

/// Those that a normal points to. Along an axis that it is across, the end beyond which the bodies
/// meet along it.
Ends likely_ends(const FoldedCylinders& pair, const Vec3& n) {
  const FoldedAxes& f = pair.axes;
  constexpr double across = 1e-15;
  const double along1 = n.x(), along2 = f.along_u2(n);
  Ends ends{std::copysign(1, along1), std::copysign(1, along2)};
  if (std::abs(along1) <= across && std::abs(along2) <= across) {  // the sides cross
    const auto [t1, t2] = f.crossing();
    ends = {std::copysign(1, t1), std::copysign(1, t2)};
  } else if (std::abs(along1) <= across) {
    ends.one = -std::copysign(1, pair.along_axis1(n));
  } else if (std::abs(along2) <= across) {
    ends.two = std::copysign(1, pair.along_axis2(n));
  }
  return ends;
}

/// Offers the normal at which these rims meet. True if it is the largest gap of all or exceeds
/// `enough`.
bool offer_where_likely(const FoldedCylinders& pair, const Rims& rims, double enough,
                        LargestGap& best) {
  // As deep in each other as this, bodies hardly ever come free where rims meet.
  constexpr double deep = 0.3;
  if (-best.gap > deep * (std::min(pair.r1, pair.h1) + std::min(pair.r2, pair.h2))) return false;
  Vec3 start;
  if (const auto crossing = rims.crossing_normal()) {
    start = *crossing;
  } else {
    start = facing_points(pair.axes, {pair.r1, pair.h1}, {pair.r2, pair.h2});
  }
  if (!(start.squaredNorm() > 0)) return false;
  if (enough < never) {
    // Bodies that are clearly apart are so along it, too.
    const Vec3 n = start.normalized();
    const double gap = pair.gap(n);
    if (gap > enough + pair.clear_gap()) {
      best.offer(gap, n);
      return true;
    }
  }
  const double before = best.gap;
  constexpr int few_steps = 8;
  const Stationary found = rims.polished(start, few_steps);
  if (found.normal.z() >= 0) best.offer(pair.gap(found.normal), found.normal);
  return best.gap > enough || (found.maximum && best.gap > before && is_largest(pair, found, best));
}

/// What is known of the bodies' distance before their rims are searched.
struct DistanceBounds {
  double rounding;
  double least_depth;  ///< They overlap by no less; not positive where nothing is known.
  double limit;        ///< They are no further apart.

  explicit DistanceBounds(const FoldedCylinders& pair)
      : rounding(2e-16 * (pair.axes.d().norm() + pair.h1 + pair.h2 + pair.r1 + pair.r2)),
        least_depth(overlap_of_balls(pair) - rounding),
        limit(least_depth > 0
                  ? 0
                  : facing_points(pair.axes, {pair.r1, pair.h1}, {pair.r2, pair.h2}).norm()) {}
  double highest_gap() const { return least_depth > 0 ? -least_depth : limit; }
};

// Tilts that only rounding makes cost no more than rounding.
constexpr double parallel = 2e-16;

}  // namespace

void offer_rim_rim_normals(const FoldedCylinders& pair, double enough, LargestGap& best) {
  if (pair.axes.s <= parallel) return offer_parallel_rim_normal(pair, best);
  const Ends likely = likely_ends(pair, best.normal);
  if (offer_where_likely(pair, Rims(pair, likely.one, likely.two), enough, best)) return;

  offer_parallel_rim_normal(pair, best);
  DistanceBounds bounds(pair);
  if (-best.gap <= bounds.least_depth) return;
  for (const double end1 : {likely.one, -likely.one}) {
    for (const double end2 : {likely.two, -likely.two}) {
      const Rims rims(pair, end1, end2);
      const Range useful = rims.useful_cosines(best.gap, bounds.highest_gap());
      if (useful.empty()) continue;
      RimScan(pair, rims, bounds.limit, bounds.least_depth, best).scan(useful);
      // Apart by the gap, with points no further apart: nothing is better.
      if (best.gap > enough || best.gap >= bounds.limit - bounds.rounding) return;
    }
  }
}

double search_all_rims(const FoldedCylinders& pair, LargestGap& best) {
  offer_parallel_rim_normal(pair, best);
  if (pair.axes.s <= parallel) return 0;
  DistanceBounds bounds(pair);
  double unproven = 0;
  for (const double end1 : {1.0, -1.0}) {
    for (const double end2 : {1.0, -1.0}) {
      const Rims rims(pair, end1, end2);
      offer_where_likely(pair, rims, never, best);
      RimScan scan(pair, rims, bounds.limit, bounds.least_depth, best);
      scan.scan({-1, 1});
      unproven = std::max(unproven, scan.unproven());
    }
  }
  return unproven;
}

}  // namespace touchstone
