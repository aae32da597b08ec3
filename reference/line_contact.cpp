// A generator or edge on a cap or face, or on another one.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "contact_plane.hpp"
#include "line_in_polygon.hpp"

namespace touchstone {
namespace {

using Kind = FacingFeature::Kind;

/// Keeps of `range` where |a + b t| <= bound.
void keep_within(Interval& range, double a, double b, double bound) {
  if (b == 0) {
    if (std::abs(a) > bound) range.hi = -std::numeric_limits<double>::infinity();
    return;
  }
  const double t = (-bound - a) / b, u = (bound - a) / b;
  range.lo = std::max(range.lo, std::min(t, u));
  range.hi = std::min(range.hi, std::max(t, u));
}

/// A line that runs along an edge but for this part of rounding is on it or within it.
constexpr double hair_part = 4e3;

constexpr double crossed = 0.1;  // rad; lines that turn by more cross in a point

/// Two lines whose bodies are round about them share the distance y between them, across b, by
/// their radii, so that both surfaces fall off by the same part of these. Across a, which crosses b
/// with this cosine, y is that much less.
struct Roundness {
  double radii;       ///< both together
  double inverse;     ///< of the reach: the distance at which both surfaces have ended
  double share_of_a;  ///< of a distance, what belongs to A
  Roundness(double radius_a, double radius_b, double cosine) : radii(radius_a + radius_b) {
    const double scale = 1 / (radius_a + radius_b * cosine);
    inverse = cosine * scale;
    share_of_a = radius_a * scale;
  }
  /// 1 − √(1 − (y/reach)²), without cancellation.
  double fall(double squared_y) const {
    const double part = std::min(squared_y * inverse * inverse, 1.0);
    constexpr double flat = 1e-8;  // whose square is rounding
    return part < flat ? part / 2 : part / (1 + std::sqrt(1 - part));
  }
};

}  // namespace

bool segments_crossing(const Manifold& to, const FacingFeature& a, const FacingFeature& b) {
  const Vec3& n = to.contact.normal;
  const double turn = triple(a.axis, b.axis, n);
  if (!(std::abs(turn) > crossed)) return false;
  const Vec3 from_a = b.middle - a.middle;
  const double t = triple(from_a, b.axis, n) / turn, s = triple(from_a, a.axis, n) / turn;
  if (std::abs(t) <= a.half_length && std::abs(s) <= b.half_length) {
    const Vec3 on_a = a.middle + t * a.axis, on_b = b.middle + s * b.axis;
    to.contact.add_point(to.origin + (on_a + on_b) / 2, (on_b - on_a).dot(n));
    return true;
  }
  const Vec3 on_a = a.middle + std::clamp(t, -a.half_length, a.half_length) * a.axis;
  const Vec3 along_b = b.axis - b.axis.dot(n) * n;
  const double foot = (on_a - b.middle).dot(along_b) / along_b.squaredNorm();
  const Vec3 on_b = b.middle + std::clamp(foot, -b.half_length, b.half_length) * b.axis;
  const double between = (on_b - on_a).dot(n);
  const Vec3 y = on_b - on_a - between * n;
  const Roundness round(a.radius, b.radius, 1);
  const double fall = round.fall(y.squaredNorm());
  const double middle = (between + (a.radius - b.radius) * fall) / 2;
  to.contact.add_point(to.origin + (on_a + round.share_of_a * y + middle * n),
                       between - round.radii * fall);
  return true;
}

void segment_on_flat(const Manifold& to, const FacingFeature& segment, const FacingFeature& flat,
                     bool segment_is_a) {
  const ContactPlane plane(to, flat.axis);
  const Line l = plane.line(segment);
  const Incline surface = plane.incline(flat);
  Interval range{-l.half_length, l.half_length};
  std::optional<Strip> grazed;  // of a rectangle, the edges that the line all but runs along
  bool grazes_polygon = false;
  if (flat.kind == Kind::disc) {
    const Circle disc{plane.to_plane(flat.middle), flat.radius};
    const double squared = l.along.squaredNorm();
    const Vec2 arm = l.middle - disc.centre;
    const double foot = -arm.dot(l.along) / squared;
    const double offset = cross2(l.along, arm) / std::sqrt(squared);
    // A line that touches the rim has one point of it, whichever side of it rounding puts it on. As
    // the normal leans about the rim by a hair, the line moves by that part of its body's radius.
    const double hair = unseen_part * (disc.radius + l.radius);
    const double within = disc.radius - std::abs(offset), reaches = ramp(within, hair, 2 * hair);
    const double half =
        reaches > 0 ? reaches * std::sqrt(within * (disc.radius + std::abs(offset)) / squared) : 0;
    range = {std::max(range.lo, foot - half), std::min(range.hi, foot + half)};
  } else if (flat.kind == Kind::polygon) {
    grazes_polygon = keep_within_polygon(range, l, CarriedCorners(plane, flat, Vec2::Zero()),
                                         hair_part * plane.margins().rounding);
  } else {  // a rectangle
    // The edges that the line crosses first. One that runs along the others, but for a hair, does
    // so within them or on one, whichever side of that rounding puts it on.
    const std::array<Strip, 2> strips = plane.face(flat).strips;
    const double along[] = {strips[0].across.dot(l.along), strips[1].across.dot(l.along)};
    const int first = std::abs(along[0]) >= std::abs(along[1]) ? 0 : 1;
    for (const int i : {first, 1 - first}) {
      const double hair = hair_part * plane.margins().rounding;
      const double slant = std::abs(along[i]) * (range.hi - range.lo);
      if (slant <= hair) continue;
      const double beyond = let_beyond(l.radius, slant);
      if (beyond > 0) [[unlikely]]
        grazed = strips[i];
      const double offset = strips[i].across.dot(l.middle) - strips[i].middle;
      Interval within = range;
      keep_within(within, offset, along[i], strips[i].half_width + beyond);
      if (within.empty()) {  // they only touch, at the nearer end
        const double middle = offset + along[i] * (range.lo + range.hi) / 2;
        within.lo = within.hi = middle * along[i] > 0 ? range.lo : range.hi;
      }
      range = within;
    }
  }
  if (range.empty()) {  // beside the rim's nearest point
    const double t = std::clamp((range.lo + range.hi) / 2, -l.half_length, l.half_length);
    range = {t, t};
  }
  const auto clearance = [&](double t) {
    const double gap = l.height + t * l.rise - surface.at(l.at(t));
    return segment_is_a ? gap : -gap;
  };
  const double at_lo = clearance(range.lo), at_hi = clearance(range.hi);
  const double rise = std::abs(at_hi - at_lo);
  const double room = plane.room_above(std::min(at_lo, at_hi), flat.part);
  double part = segment.part;
  if (rise > room) part *= is_one_point(room, rise) ? 0 : room / rise;
  const double kept = part * (range.hi - range.lo);
  if (part < 1) (at_lo < at_hi ? range.hi = range.lo + kept : range.lo = range.hi - kept);
  const auto add_at = [&](double t) {
    Vec2 p = l.at(t);
    if (grazed) {
      const double across = grazed->across.dot(p) - grazed->middle;
      const double off = across - within(across, -grazed->half_width, grazed->half_width);
      if (std::abs(off) <= let_beyond(l.radius, 0)) {
        p -= off / grazed->across.squaredNorm() * grazed->across;
      }
    }
    if (grazes_polygon) p = moved_onto(CarriedCorners(plane, flat, Vec2::Zero()), l.radius, p);
    const double on_line = l.height + t * l.rise, on_flat = surface.at(p);
    segment_is_a ? plane.add(p, on_line, on_flat) : plane.add(p, on_flat, on_line);
  };
  // Ends that hardly overlap are one point, whichever side rounding puts them on.
  if (range.hi - range.lo <= 2 * unseen_part * l.half_length) {
    return add_at((range.lo + range.hi) / 2);
  }
  add_at(range.lo);
  add_at(range.hi);
}

void segment_on_segment(const Manifold& to, const FacingFeature& f, const FacingFeature& g) {
  const ContactPlane plane(to);
  const Line a = plane.line(f), b = plane.line(g);
  const double turn = cross2(a.along, b.along);
  const Vec2 from_a = b.middle - a.middle;

  // Points of both lines that face each other: s = s0 + s1 t.
  const double inverse = 1 / b.along.squaredNorm(), inverse_length = std::sqrt(inverse);
  const double dot = a.along.dot(b.along);
  const Roundness round(a.radius, b.radius, std::abs(dot) * inverse_length / a.along.norm());
  const double s0 = -from_a.dot(b.along) * inverse, s1 = dot * inverse;
  const auto add_at = [&](double t, double s) {
    const Vec2 p = a.at(t), y = b.at(s) - p;
    const double fall = round.fall(y.squaredNorm());
    plane.add(p + round.share_of_a * y, a.height + t * a.rise + a.radius * fall,
              b.height + s * b.rise - b.radius * fall);
  };

  Interval range{-a.half_length, a.half_length};
  keep_within(range, s0, s1, b.half_length);
  if (range.empty()) {  // end to end
    const double t = std::clamp(range.lo, -a.half_length, a.half_length);
    return add_at(t, std::clamp(s0 + s1 * t, -b.half_length, b.half_length));
  }
  // They are y = y0 + y1 t apart across b; the clearance is convex where |y| < R, their reach.
  const double y0 = -cross2(b.along, from_a) * inverse_length, y1 = -turn * inverse_length;
  const double level = a.height - b.height - s0 * b.rise, slope = a.rise - s1 * b.rise;
  const auto clearance = [&](double t) {
    const double y = y0 + y1 * t;
    return level + slope * t + round.radii * round.fall(y * y);
  };
  const double whole = range.hi - range.lo;
  const double at_lo = clearance(range.lo), at_hi = clearance(range.hi);
  double deepest = at_lo <= at_hi ? range.lo : range.hi, least = std::min(at_lo, at_hi);
  const double bend = round.radii * y1 * round.inverse, curvature = bend * y1 * round.inverse;
  const bool curved = curvature * whole * whole > plane.margins().rounding;
  if (curved) {
    // Where slope + bend (y/R) / √(1 − (y/R)²) = 0.
    const double y = -std::copysign(slope, bend * slope) /
                     (round.inverse * std::sqrt(slope * slope + bend * bend));
    const double lowest = std::clamp((y - y0) / y1, range.lo, range.hi);
    if (const double there = clearance(lowest); there <= least) deepest = lowest, least = there;
  }
  // Less of the slack as the lines come to be crossed, so that the points have drawn together then.
  const double room = std::min(plane.room_above(least, 1),
                               plane.margins().slack * (2 - 2 * std::abs(turn) / crossed));
  // Surfaces that have fallen off further hardly face each other.
  constexpr double facing = 0.75;
  const double beside = std::max(std::abs(y0 + y1 * range.lo), std::abs(y0 + y1 * range.hi));
  if (beside * round.inverse > facing) keep_within(range, y0, y1, facing / round.inverse);
  if (!(room > 0) || !(range.lo <= deepest && deepest <= range.hi)) {
    return add_at(deepest, s0 + s1 * deepest);
  }
  // How far from the deepest point the clearance takes no more than the room: about as far as its
  // second-order part does, and on the chord to there at most.
  const double grows = slope + bend * (y0 + y1 * deepest) * round.inverse;
  const auto reach = [&](double end) {
    if (clearance(end) - least <= room) return end;
    const double way = end < deepest ? -1 : 1, grow = std::max(way * grows, 0.0);
    const double most = std::abs(end - deepest);
    const double far =
        std::min(most, 2 * room / (grow + std::sqrt(grow * grow + 2 * curvature * room)));
    const double taken = clearance(deepest + way * far) - least;
    return deepest + way * far * (taken > room ? room / taken : 1);
  };
  const double lo = reach(range.lo), hi = reach(range.hi);
  constexpr double min_part = 0.1;
  const double part = (hi - lo) / whole;
  if (!(part > min_part)) return add_at(deepest, s0 + s1 * deepest);
  const double fade = std::min(1.0, part / min_part - 1);
  const double t_lo = deepest + fade * (lo - deepest), t_hi = deepest + fade * (hi - deepest);
  add_at(t_lo, s0 + s1 * t_lo);
  add_at(t_hi, s0 + s1 * t_hi);
  // Of two lines that cross by a hair neither end has the depth.
  if (curved &&
      std::min(clearance(t_lo), clearance(t_hi)) - least > plane.margins().clear_rise() / 2) {
    add_at(deepest, s0 + s1 * deepest);
  }
}

}  // namespace touchstone
