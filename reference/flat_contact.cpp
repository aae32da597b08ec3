// A cap on a cap or face.
#include <algorithm>

#include "contact_plane.hpp"

namespace touchstone {
namespace {

using Kind = FacingFeature::Kind;

/// Slopes below this are rounding: the surface is level, and any point is the deepest.
constexpr double level_slope = 1e-15;

}  // namespace

/// Three points of a disc that rises nowhere above the slack, the deepest first.
bool ContactPlane::add_whole_disc(const Circle& disc, const Vec2& aside, const Incline& a,
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
void ContactPlane::add_spread(ArcPolygon region, const Vec2& aside, const Incline& a,
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

void ContactPlane::flat_on_flat(const FacingFeature& a, const FacingFeature& b) {
  const Incline on_a = incline(a), on_b = incline(b);
  const Circle disc = circle(a);
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
      const double offset = side.dot(disc.centre - middle), beyond = b.half_side[i] - disc.radius;
      if (offset > beyond) region.clip(side, side.dot(middle) + b.half_side[i]);
      if (-offset > beyond) region.clip(-side, b.half_side[i] - side.dot(middle));
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
  const Vec2 rise = on_a.slope - on_b.slope;
  const double steepness = rise.norm();
  if (steepness * 2 * std::min(disc.radius, other.radius) > slack_) {
    return add_spread(ArcPolygon::lens(disc, other), aside, on_a, on_b);
  }
  const Lens lens(disc, other);
  const auto add_at = [&](const Vec2& p) { add(p, on_a.at(p), on_b.at(p)); };
  std::array<Vec2, 4> points = lens.spread();
  if (steepness > level_slope) {  // the deepest is one of them, in place of another that is near it
    const Vec2 deepest = lens.farthest(-rise / steepness);
    const auto nearer = [&](const Vec2& p, const Vec2& q) {
      return (p - deepest).squaredNorm() < (q - deepest).squaredNorm();
    };
    const auto nearest = std::min_element(points.begin(), points.end(), nearer);
    constexpr double near = 0.2;
    const double width = disc.radius + other.radius - distance;
    if ((*nearest - deepest).norm() < near * width) {
      *nearest = deepest;
      std::rotate(points.begin(), nearest, points.end());
    } else {
      add_at(deepest);
    }
  }
  for (const Vec2& p : points) add_at(p);
}

}  // namespace touchstone
