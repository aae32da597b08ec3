#include "manifold.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "arc_polygon.hpp"

namespace touchstone {
namespace {

using Kind = FacingFeature::Kind;

/// Slopes below this are rounding: the surface is level, and any point is the deepest.
constexpr double level_slope = 1e-15;

bool is_flat(const FacingFeature& f) {
  return f.kind == Kind::disc || f.kind == Kind::rectangle || f.kind == Kind::half_space;
}

/// Two unit vectors that make a right-handed frame with the unit normal (Duff et al., "Building an
/// orthonormal basis, revisited", 2017).
std::pair<Vec3, Vec3> across(const Vec3& n) {
  const double sign = std::copysign(1.0, n.z());
  const double a = -1 / (sign + n.z());
  const double b = n.x() * n.y() * a;
  return {Vec3(1 + sign * n.x() * n.x() * a, sign * b, -sign * n.x()),
          Vec3(b, sign + n.y() * n.y() * a, -n.y())};
}

/// z = height + slope·p over the contact plane.
struct Incline {
  double height;
  Vec2 slope;
  double at(const Vec2& p) const { return height + slope.dot(p); }
};

/// p(t) = middle + t along, z(t) = height + t rise, |t| <= half_length.
struct Line {
  Vec2 middle, along;
  double height, rise, half_length, radius;
  Vec2 at(double t) const { return middle + t * along; }
};

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

class Manifold {
 public:
  Manifold(Contact& contact, const Vec3& origin, const ManifoldRule& rule)
      : contact_(contact), n_(contact.normal), origin_(origin), slack_(rule.slack) {
    std::tie(x_, y_) = across(n_);
  }

  void flat_on_flat(const FacingFeature& a, const FacingFeature& b);
  void line_on_flat(const FacingFeature& line, const FacingFeature& flat, bool line_is_a);
  void line_on_line(const FacingFeature& a, const FacingFeature& b);

 private:
  Vec2 to_plane(const Vec3& v) const { return {v.dot(x_), v.dot(y_)}; }
  Incline incline(const FacingFeature& f) const {
    const double up = f.axis.dot(n_);
    return {f.axis.dot(f.middle) / up, to_plane(f.axis) / -up};
  }
  Line line(const FacingFeature& f) const {
    return {to_plane(f.middle), to_plane(f.axis), f.middle.dot(n_),
            f.axis.dot(n_),     f.half_length,    f.radius};
  }
  /// A leaning disc is seen as an ellipse; the circle within it keeps its points on the body.
  Circle circle(const FacingFeature& f) const {
    return {to_plane(f.middle), f.radius * std::abs(f.axis.dot(n_))};
  }
  void add(const Vec2& p, double height_a, double height_b) {
    contact_.add_point(origin_ + p.x() * x_ + p.y() * y_ + (height_a + height_b) / 2 * n_,
                       height_b - height_a);
  }
  bool add_whole_disc(const Circle& disc, const Vec2& aside, const Incline& a, const Incline& b);
  void add_spread(ArcPolygon region, const Vec2& aside, const Incline& a, const Incline& b);

  Contact& contact_;
  const Vec3 n_;
  const Vec3 origin_;
  const double slack_;
  Vec3 x_, y_;
};

/// Three points of a disc that rises nowhere above the slack, the deepest first.
bool Manifold::add_whole_disc(const Circle& disc, const Vec2& aside, const Incline& a,
                              const Incline& b) {
  const Vec2 rise = a.slope - b.slope;  // of the clearance
  const double steepness = rise.norm();
  if (steepness * 2 * disc.radius > slack_) return false;
  const Vec2 first = steepness > level_slope ? Vec2(-rise / steepness) : aside;
  for (const Vec2& arm : ArcPolygon::three_arms(disc.radius, first)) {
    const Vec2 p = disc.centre + arm;
    add(p, a.at(p), b.at(p));
  }
  return true;
}

/// Cuts off what rises above the slack and adds the points of the rest, the deepest first.
void Manifold::add_spread(ArcPolygon region, const Vec2& aside, const Incline& a,
                          const Incline& b) {
  const Vec2 rise = a.slope - b.slope;  // of the clearance
  const double steepness = rise.norm();
  Vec2 first = aside;
  if (steepness > level_slope) {
    first = -rise / steepness;
    const double bottom = -first.dot(region.farthest(first));
    const double top = -first.dot(region.farthest(-first));
    const bool leans = steepness * (top - bottom) > slack_;
    if (leans) region.clip(-first, bottom + slack_ / steepness);
    if (leans || !region.is_disc()) region.mark_farthest(first);
  }
  std::array<Vec2, 8> points;
  const int count = region.spread(first, points);
  for (int i = 0; i < count; ++i) add(points[i], a.at(points[i]), b.at(points[i]));
}

void Manifold::flat_on_flat(const FacingFeature& a, const FacingFeature& b) {
  const Incline on_a = incline(a), on_b = incline(b);
  const Circle disc = circle(a);
  if (b.kind == Kind::half_space) {
    if (add_whole_disc(disc, to_plane(b.side[0]), on_a, on_b)) return;
    add_spread(ArcPolygon(disc), to_plane(b.side[0]), on_a, on_b);
    return;
  }
  if (b.kind == Kind::rectangle) {
    const Vec2 middle = to_plane(b.middle);
    bool whole = true;
    for (int i = 0; i < 2; ++i) {
      const double offset = std::abs(to_plane(b.side[i]).dot(disc.centre - middle));
      whole = whole && offset + disc.radius <= b.half_side[i];
    }
    if (whole && add_whole_disc(disc, to_plane(b.side[0]).normalized(), on_a, on_b)) return;
    ArcPolygon region(disc);
    for (int i = 0; i < 2; ++i) {
      const Vec2 side = to_plane(b.side[i]).normalized();
      region.clip(side, side.dot(middle) + b.half_side[i]);
      region.clip(-side, b.half_side[i] - side.dot(middle));
    }
    if (!region.empty()) return add_spread(region, to_plane(b.side[0]), on_a, on_b);
    // The rim only touches the face's edge: the face's point that is nearest to the cap's middle.
    Vec2 p = middle;
    for (int i = 0; i < 2; ++i) {
      const Vec2 side = to_plane(b.side[i]).normalized();
      p += std::clamp(side.dot(disc.centre - middle), -b.half_side[i], b.half_side[i]) * side;
    }
    return add(p, on_a.at(p), on_b.at(p));
  }

  const Circle other = circle(b);
  const Vec2 between = other.centre - disc.centre;
  const double distance = between.norm();
  // Along the line of centres; of coaxial discs any direction is as good as another.
  const Vec2 aside = distance > 0 ? Vec2(between / distance) : Vec2(1, 0);
  constexpr double rounding = 1e-12;
  if (distance <= std::abs(disc.radius - other.radius) + rounding * (disc.radius + other.radius)) {
    const bool a_is_inside = disc.radius <= other.radius;
    const Circle& inner = a_is_inside ? disc : other;
    const Vec2 first = a_is_inside ? aside : Vec2(-aside);
    if (add_whole_disc(inner, first, on_a, on_b)) return;
    return add_spread(ArcPolygon(inner), first, on_a, on_b);
  }
  if (distance >= disc.radius + other.radius) {  // the rims only touch
    const Vec2 p = disc.centre + disc.radius / (disc.radius + other.radius) * between;
    return add(p, on_a.at(p), on_b.at(p));
  }
  const ArcPolygon region = ArcPolygon::lens(disc, other);
  const Vec2 rise = on_a.slope - on_b.slope;
  const double steepness = rise.norm();
  if (steepness * 2 * std::min(disc.radius, other.radius) > slack_) {
    return add_spread(region, aside, on_a, on_b);
  }
  // Along the line of centres: the corners, or the smaller disc's widest place where it lies
  // within, and both arcs' middles. Where the cap leans, from its deepest point on.
  const Vec2 first = steepness > level_slope ? Vec2(-rise / steepness) : aside;
  const Vec2 left(-first.y(), first.x());
  for (const Vec2& direction : {first, left, Vec2(-first), Vec2(-left)}) {
    const Vec2 p = region.farthest(direction);
    add(p, on_a.at(p), on_b.at(p));
  }
}

void Manifold::line_on_flat(const FacingFeature& f, const FacingFeature& flat, bool line_is_a) {
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
  const double deepest = at_lo <= at_hi ? range.lo : range.hi;
  add_at(deepest);
  if (range.hi > range.lo) add_at(range.lo + range.hi - deepest);
}

// Both lines are across the normal but for the slack. They cross, or run side by side: then the
// clearance grows by y²/2R with their distance y, R being the sum of the radii across them.
void Manifold::line_on_line(const FacingFeature& f, const FacingFeature& g) {
  const Line a = line(f), b = line(g);
  const double turn = cross2(a.along, b.along);
  const Vec2 from_a = b.middle - a.middle;
  const double curvature_radius = a.radius + b.radius;

  // Points of both lines that face each other: s = s0 + s1 t.
  const double squared = b.along.squaredNorm();
  const double s0 = -from_a.dot(b.along) / squared, s1 = a.along.dot(b.along) / squared;
  const auto add_at = [&](double t, double s) {
    const Vec2 p = a.at(t), q = b.at(s);
    const Vec2 y = q - p;
    const double share = curvature_radius > 0 ? a.radius / curvature_radius : 0.5;
    const double bend =
        curvature_radius > 0 ? y.squaredNorm() / (2 * curvature_radius * curvature_radius) : 0;
    add(p + share * y, a.height + t * a.rise + a.radius * bend,
        b.height + s * b.rise - b.radius * bend);
  };

  constexpr double clearly = 0.05;  // rad
  if (std::abs(turn) > clearly) {
    const double t = std::clamp(cross2(from_a, b.along) / turn, -a.half_length, a.half_length);
    return add_at(t, std::clamp(s0 + s1 * t, -b.half_length, b.half_length));
  }
  Range range{-a.half_length, a.half_length};
  keep_within(range, s0, s1, b.half_length);
  if (range.empty()) {  // end to end
    const double t = std::clamp(range.lo, -a.half_length, a.half_length);
    return add_at(t, std::clamp(s0 + s1 * t, -b.half_length, b.half_length));
  }
  // The clearance is c0 + c1 t + c2 t² up to a constant.
  const double y0 = -cross2(b.along, from_a + s0 * b.along), y1 = -cross2(b.along, a.along);
  const double bend = curvature_radius > 0 ? 1 / (2 * curvature_radius) : 0;
  const double c2 = bend * y1 * y1;
  const double c1 = a.rise - s1 * b.rise - 2 * bend * y0 * y1;
  const auto clearance = [&](double t) { return t * (c1 + c2 * t); };
  const double bottom = clearance(range.lo) <= clearance(range.hi) ? range.lo : range.hi;
  const double lowest = c2 > 0 ? std::clamp(-c1 / (2 * c2), range.lo, range.hi) : bottom;
  const double deepest = clearance(lowest) <= clearance(bottom) ? lowest : bottom;
  const double whole = range.hi - range.lo;
  const double level = clearance(deepest) + slack_;
  // How far from the deepest point the clearance stays below the level.
  const auto reach = [&](double end) {
    if (clearance(end) <= level) return end;
    const double way = end < deepest ? -1 : 1;
    const double slope = way * (c1 + 2 * c2 * deepest);  // >= 0 but for rounding
    const double grow = std::max(slope, 0.0);
    return deepest + way * 2 * slack_ / (grow + std::sqrt(grow * grow + 4 * c2 * slack_));
  };
  const double lo = reach(range.lo), hi = reach(range.hi);
  constexpr double least_part = 0.1;
  if (hi - lo <= least_part * whole) return add_at(deepest, s0 + s1 * deepest);
  const double first = deepest - lo <= hi - deepest ? lo : hi;
  add_at(first, s0 + s1 * first);
  add_at(lo + hi - first, s0 + s1 * (lo + hi - first));
}

}  // namespace

ManifoldRule::ManifoldRule(double largest_a, double largest_b, double distance,
                           double signed_distance, double contact_threshold) {
  constexpr double hair = 1e-3;
  const double rounding =
      16 * std::numeric_limits<double>::epsilon() * (std::max(largest_a, largest_b) + distance);
  slack = std::max(rounding, std::min(hair * std::min(largest_a, largest_b),
                                      contact_threshold - signed_distance));
}

void add_manifold(Contact& contact, const FacingFeature& a, const FacingFeature& b,
                  const Vec3& origin, const ManifoldRule& rule) {
  const bool a_is_point = a.kind == Kind::point, b_is_point = b.kind == Kind::point;
  if (a_is_point || b_is_point) {
    const Vec3 half = contact.signed_distance / 2 * contact.normal;
    // Of two points, the one that the normal's rounding moves less.
    const bool take_a = a_is_point && (!b_is_point || a.sine >= b.sine);
    const Vec3 p = take_a ? Vec3(a.middle - half) : Vec3(b.middle + half);
    contact.add_point(origin + p, -contact.signed_distance);
    return;
  }
  Manifold manifold(contact, origin, rule);
  if (is_flat(a)) {
    is_flat(b) ? manifold.flat_on_flat(a, b) : manifold.line_on_flat(b, a, false);
  } else {
    is_flat(b) ? manifold.line_on_flat(a, b, true) : manifold.line_on_line(a, b);
  }
}

}  // namespace touchstone
