// A generator or edge on a cap or face, or on another one.
#include <algorithm>
#include <cmath>
#include <limits>

#include "contact_plane.hpp"

namespace touchstone {
namespace {

using Kind = FacingFeature::Kind;

struct Range {
  double lo, hi;
  bool empty() const { return !(lo <= hi); }
};

/// Keeps of `range` where |a + b t| <= bound.
void keep_within(Range& range, double a, double b, double bound) {
  if (b == 0) {
    if (std::abs(a) > bound) range.hi = -std::numeric_limits<double>::infinity();
    return;
  }
  const double t = (-bound - a) / b, u = (bound - a) / b;
  range.lo = std::max(range.lo, std::min(t, u));
  range.hi = std::min(range.hi, std::max(t, u));
}

constexpr double crossed = 0.1;  // rad; lines that turn by more cross in a point

/// At a distance y across two lines the clearance grows by y² / 2R, R being the sum of the radii
/// across them; they share y by their radii.
struct Roundness {
  double curvature, share_of_a;
};
Roundness roundness(double radius_a, double radius_b) {
  const double sum = radius_a + radius_b;
  return sum > 0 ? Roundness{1 / sum, radius_a / sum} : Roundness{0, 0.5};
}

}  // namespace

bool add_crossing(Contact& contact, const FacingFeature& a, const FacingFeature& b,
                  const Vec3& origin) {
  const Vec3& n = contact.normal;
  const double turn = a.axis.cross(b.axis).dot(n);
  if (!(std::abs(turn) > crossed)) return false;
  const Vec3 from_a = b.middle - a.middle;
  const double t = from_a.cross(b.axis).dot(n) / turn, s = from_a.cross(a.axis).dot(n) / turn;
  if (std::abs(t) <= a.half_length && std::abs(s) <= b.half_length) {
    const Vec3 on_a = a.middle + t * a.axis, on_b = b.middle + s * b.axis;
    contact.add_point(origin + (on_a + on_b) / 2, (on_b - on_a).dot(n));
    return true;
  }
  const Vec3 on_a = a.middle + std::clamp(t, -a.half_length, a.half_length) * a.axis;
  const Vec3 along_b = b.axis - b.axis.dot(n) * n;
  const double foot = (on_a - b.middle).dot(along_b) / along_b.squaredNorm();
  const Vec3 on_b = b.middle + std::clamp(foot, -b.half_length, b.half_length) * b.axis;
  const double between = (on_b - on_a).dot(n);
  const Vec3 y = on_b - on_a - between * n;
  const auto [curvature, share] = roundness(a.radius, b.radius);
  const double bend = y.squaredNorm() * curvature * curvature / 2;
  const double middle = (between + (a.radius - b.radius) * bend) / 2;
  contact.add_point(origin + (on_a + share * y + middle * n),
                    between - (a.radius + b.radius) * bend);
  return true;
}

void ContactPlane::line_on_flat(const FacingFeature& f, const FacingFeature& flat, bool line_is_a) {
  const Line l = line(f);
  const Incline surface = incline(flat);
  Range range{-l.half_length, l.half_length};
  if (flat.kind == Kind::disc) {
    const Circle disc = circle(flat);
    const double squared = l.along.squaredNorm();
    const Vec2 arm = l.middle - disc.centre;
    const double foot = -arm.dot(l.along) / squared;
    const double offset = cross2(l.along, arm) / std::sqrt(squared);
    const double half =
        std::sqrt(std::max(0.0, (disc.radius - offset) * (disc.radius + offset)) / squared);
    range = {std::max(range.lo, foot - half), std::min(range.hi, foot + half)};
  } else if (flat.kind == Kind::rectangle) {
    const Vec2 arm = l.middle - to_plane(flat.middle);
    for (int i = 0; i < 2; ++i) {
      const Vec2 side = to_plane(flat.side[i]).normalized();
      keep_within(range, arm.dot(side), l.along.dot(side), flat.half_side[i]);
    }
  }
  if (range.empty()) {  // they only touch, where the line comes nearest
    const Vec2 arm = to_plane(flat.middle) - l.middle;
    const double t =
        std::clamp(arm.dot(l.along) / l.along.squaredNorm(), -l.half_length, l.half_length);
    range = {t, t};
  }
  const auto clearance = [&](double t) {
    const double gap = l.height + t * l.rise - surface.at(l.at(t));
    return line_is_a ? gap : -gap;
  };
  const double at_lo = clearance(range.lo), at_hi = clearance(range.hi);
  const double rise = std::abs(at_hi - at_lo);
  if (rise > slack_) {
    const double kept = slack_ / rise * (range.hi - range.lo);
    (at_lo < at_hi ? range.hi = range.lo + kept : range.lo = range.hi - kept);
  }
  const auto add_at = [&](double t) {
    const Vec2 p = l.at(t);
    const double on_line = l.height + t * l.rise, on_flat = surface.at(p);
    line_is_a ? add(p, on_line, on_flat) : add(p, on_flat, on_line);
  };
  add_at(range.lo);
  if (range.hi > range.lo) add_at(range.hi);
}

// Both lines are across the normal but for the slack, and run side by side.
void ContactPlane::line_on_line(const FacingFeature& f, const FacingFeature& g) {
  const Line a = line(f), b = line(g);
  const double turn = cross2(a.along, b.along);
  const Vec2 from_a = b.middle - a.middle;
  const auto [curvature, share] = roundness(a.radius, b.radius);

  // Points of both lines that face each other: s = s0 + s1 t.
  const double inverse = 1 / b.along.squaredNorm();
  const double s0 = -from_a.dot(b.along) * inverse, s1 = a.along.dot(b.along) * inverse;
  const auto add_at = [&](double t, double s) {
    const Vec2 p = a.at(t), y = b.at(s) - p;
    const double bend = y.squaredNorm() * curvature * curvature / 2;
    add(p + share * y, a.height + t * a.rise + a.radius * bend,
        b.height + s * b.rise - b.radius * bend);
  };

  Range range{-a.half_length, a.half_length};
  keep_within(range, s0, s1, b.half_length);
  if (range.empty()) {  // end to end
    const double t = std::clamp(range.lo, -a.half_length, a.half_length);
    return add_at(t, std::clamp(s0 + s1 * t, -b.half_length, b.half_length));
  }
  // The clearance is c0 + c1 t + c2 t² up to a constant.
  const double y0 = -cross2(b.along, from_a + s0 * b.along), y1 = -cross2(b.along, a.along);
  const double bend = curvature / 2;
  const double c2 = bend * y1 * y1;
  const double c1 = a.rise - s1 * b.rise - 2 * bend * y0 * y1;
  const auto clearance = [&](double t) { return t * (c1 + c2 * t); };
  const double bottom = clearance(range.lo) <= clearance(range.hi) ? range.lo : range.hi;
  const double lowest = c2 > 0 ? std::clamp(-c1 / (2 * c2), range.lo, range.hi) : bottom;
  const double deepest = clearance(lowest) <= clearance(bottom) ? lowest : bottom;
  const double whole = range.hi - range.lo;
  // Less of the slack as the lines come to be crossed, so that the points have drawn together then.
  const double slack = slack_ * std::min(1.0, 2 - 2 * std::abs(turn) / crossed);
  const double level = clearance(deepest) + slack;
  // How far from the deepest point the clearance stays below the level.
  const auto reach = [&](double end) {
    if (clearance(end) <= level) return end;
    const double way = end < deepest ? -1 : 1;
    const double slope = way * (c1 + 2 * c2 * deepest);  // >= 0 but for rounding
    const double grow = std::max(slope, 0.0);
    return deepest + way * 2 * slack / (grow + std::sqrt(grow * grow + 4 * c2 * slack));
  };
  const double lo = reach(range.lo), hi = reach(range.hi);
  constexpr double least_part = 0.1;
  const double part = (hi - lo) / whole;
  if (!(part > least_part)) return add_at(deepest, s0 + s1 * deepest);
  const double fade = std::min(1.0, part / least_part - 1);
  for (const double end : {lo, hi}) {
    const double t = deepest + fade * (end - deepest);
    add_at(t, s0 + s1 * t);
  }
}

}  // namespace touchstone
