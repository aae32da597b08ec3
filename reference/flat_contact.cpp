// A cap on a cap or on a face.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "cap_on_cap.hpp"
#include "cap_on_face.hpp"
#include "cap_on_polygon.hpp"
#include "contact_plane.hpp"
#include "disc_layout.hpp"

namespace touchstone {
namespace {

template <class Patch>
struct PatchPoints {
  std::array<Vec2, Patch::max_points> points;
  int count = 0;
  double clearness = 0;         ///< of its lean
  Vec2 deepest = Vec2::Zero();  ///< its deepest place, if it leans clearly
};

/// The points of a patch of this size about a middle, where this part of the cap faces it. Those of
/// a body that clearly leans have its deepest place among them and none above the slack.
template <class Patch>
PatchPoints<Patch> points_of(const ContactPlane& plane, const Patch& patch, const Vec2& middle,
                             double radius, double part, const Surfaces& s) {
  const Vec2 slope = s.slope();
  const double steepness = slope.norm(), rise = 2 * radius * steepness;
  const double clearness = deepest_point_weight(rise, plane.margins().clear_rise());
  PatchPoints<Patch> found;
  if (clearness == 0) {
    found.count = patch.spread(slope, Vec2(0, 0), 0, found.points);
    return found;
  }
  // So that along an edge that is leaned over straight nothing rises by what is clear.
  const double straight = std::min(0.1, plane.margins().clear_rise() / rise);
  const Vec2 up = slope / steepness, deepest = patch.farthest(-up, straight);
  found.count = patch.spread(-up, deepest, clearness, found.points);
  found.deepest = deepest;
  found.clearness = clearness;
  const double room = plane.room_above(s.clearance(middle + deepest), part);
  if (rise > room) {
    patch.cut_off(up, up.dot(deepest) + room / steepness, found.points, found.count);
  }
  return found;
}

/// Adds those of the points that differ. The same point twice would tell a solver that the body
/// stands more firmly there.
template <class Patch>
void add_distinct(const ContactPlane& plane, const PatchPoints<Patch>& found, const Vec2& middle,
                  double radius, const Surfaces& s) {
  const double same = 2 * unseen_part * radius;
  const auto begin = found.points.begin();
  for (int i = 0; i < found.count; ++i) {
    const auto is_same = [&](const Vec2& p) {
      return (p - found.points[i]).squaredNorm() <= same * same;
    };
    if (std::none_of(begin, begin + i, is_same)) plane.add(middle + found.points[i], s);
  }
}

/// Of caps that hardly face each other any more the points draw together to the deepest: as they
/// lean, for where their rims cross next to the deepest place the normal leans anywhere between.
[[gnu::noinline]] void draw_to_deepest(PatchPoints<CapOnCap>& found, const FacingFeature& first,
                                       const FacingFeature& second, const ContactPlane& plane,
                                       double radius, const Surfaces& s) {
  const double facing = facing_part(radius, s.slope().norm(), plane.margins().flat);
  const double part = std::min(first.part * second.part, facing);
  if (part == 1) return;
  const Vec2 to_where = found.clearness * found.deepest;
  for (int i = 0; i < found.count; ++i) {
    found.points[i] = to_where + part * (found.points[i] - to_where);
  }
}

}  // namespace

void disc_on_rectangle(const Manifold& to, const FacingFeature& cap, const FacingFeature& face) {
  const ContactPlane plane(to, cap.axis);
  const ContactPlane::Face seen = plane.face(face);
  const Surfaces s{plane.incline(cap), seen.surface};
  const Circle disc{plane.to_plane(cap.middle), cap.radius};
  const auto whole = [&](int i) -> Strip {
    const Strip& strip = seen.strips[i];
    const double x = strip.across.x(), y = strip.across.y(), inverse = 1 / std::sqrt(x * x + y * y);
    return {{inverse * x, inverse * y},
            inverse * (strip.middle + face.left_out[i] / 2),
            inverse * (strip.half_width + std::abs(face.left_out[i]) / 2)};
  };
  const CapOnFace patch(disc, whole(0), whole(1));
  if (patch.empty()) return plane.add(disc.centre + patch.nearest(), s);  // the rim only touches
  auto found = points_of(plane, patch, disc.centre, disc.radius, cap.part, s);
  for (int i = 0; i < 2; ++i) {  // of a face that leans, the part that faces the cap
    if (face.left_out[i] == 0) continue;
    const double part = face.half_side[i] / (face.half_side[i] + std::abs(face.left_out[i]) / 2);
    const Vec2 up = std::copysign(1, face.left_out[i]) * seen.strips[i].across.normalized();
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (int k = 0; k < found.count; ++k) {
      const double height = up.dot(found.points[k]);
      low = std::min(low, height), high = std::max(high, height);
    }
    low += found.clearness * (up.dot(found.deepest) - low);
    patch.cut_off(up, low + part * (high - low), found.points, found.count);
  }
  add_distinct(plane, found, disc.centre, disc.radius, s);
}

void disc_on_polygon(const Manifold& to, const FacingFeature& cap, const FacingFeature& face) {
  const ContactPlane plane(to, cap.axis);
  const Surfaces s{plane.incline(cap), plane.incline(face)};
  const Vec2 middle = plane.to_plane(cap.middle);
  const CarriedCorners corners(plane, face, middle);
  const CapOnPolygon<CarriedCorners> patch(cap.radius, corners);
  if (patch.empty()) return plane.add(middle + patch.nearest(), s);  // the rim only touches
  auto found = points_of(plane, patch, middle, cap.radius, cap.part, s);
  if (face.part < 1) {  // of a face that leans, the part that faces the cap
    const Vec2 slope = s.slope(), up = slope / slope.norm();
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (int k = 0; k < found.count; ++k) {
      const double height = up.dot(found.points[k]);
      low = std::min(low, height), high = std::max(high, height);
    }
    low += found.clearness * (up.dot(found.deepest) - low);
    patch.cut_off(up, low + face.part * (high - low), found.points, found.count);
  }
  add_distinct(plane, found, middle, cap.radius, s);
}

void disc_on_disc(const Manifold& to, const FacingFeature& first, const FacingFeature& second,
                  bool first_is_a) {
  const ContactPlane plane(to, first.axis);
  const Incline incline1 = plane.incline(first), incline2 = plane.incline(second);
  const Surfaces s = first_is_a ? Surfaces{incline1, incline2} : Surfaces{incline2, incline1};
  // A leaning disc is seen as an ellipse; the circle within it keeps its points on the body.
  const Circle c1{plane.to_plane(first.middle), first.radius};
  const Circle c2{plane.to_plane(second.middle),
                  second.radius * plane.min_scale(second.axis, first.axis)};
  const CapOnCap patch(c1, c2, plane.to_plane(first.mark));
  if (patch.empty()) return plane.add(patch.middle() + patch.nearest(), s);
  const double radius = std::min(c1.radius, c2.radius);
  auto found = points_of(plane, patch, patch.middle(), radius, 1, s);
  if (found.clearness > 0) draw_to_deepest(found, first, second, plane, radius, s);
  add_distinct(plane, found, patch.middle(), radius, s);
}

}  // namespace touchstone
