// A cap on a cap or on a face.
#include <algorithm>
#include <array>
#include <cmath>

#include "contact_plane.hpp"
#include "disc_layout.hpp"
#include "patch_layout.hpp"

namespace touchstone {
namespace {

/// Points of a whole disc as arms from its centre, at rest the first along `anchor`
/// (disc_layout.hpp), and how many; none where all of it is above the slack.
int spread_arms(const ContactPlane& plane, const Circle& disc, const Vec2& anchor,
                const Surfaces& s, std::array<Vec2, 6>& arms) {
  const Vec2 slope = s.slope();
  const double steepness = slope.norm(), rise = 2 * disc.radius * steepness;
  const double room = plane.room_above(s.clearance(disc.centre) - rise / 2);
  if (!(room > 0)) return 0;
  if (is_one_point(room, rise)) {
    arms[0] = -disc.radius / steepness * slope;
    return 1;
  }
  return spread_disc(disc.radius, slope, anchor, room,
                     std::min(plane.margins().clear_rise(), room / 8), arms);
}

void add_disc(const ContactPlane& plane, const Circle& disc, const Vec2& anchor,
              const Surfaces& s) {
  std::array<Vec2, 6> arms;
  const int count = spread_arms(plane, disc, anchor, s, arms);
  for (int i = 0; i < count; ++i) plane.add(disc.centre + arms[i], s);
}

/// Adds to a layout over which the clearance rises by at most so much, where that is clear, the
/// patch's deepest point, which is asked for, and leaves none above the slack.
template <class Deepest>
void follow_slope(PatchLayout& layout, const ContactPlane& plane, double max_rise,
                  const Surfaces& s, Deepest deepest_point) {
  const double weight = deepest_point_weight(max_rise, plane.margins().clear_rise());
  if (weight == 0) return;
  const Vec2 deepest = deepest_point();
  const double room = plane.room_above(s.clearance(deepest));
  if (!(room > 0)) {
    layout.count = 0;
    return layout.add(deepest);
  }
  layout.add_deepest(deepest, weight);
  if (max_rise > room) layout.cut_off(s.slope(), s.slope().dot(deepest) + room);
}

void add_points(const ContactPlane& plane, PatchLayout& layout, const Surfaces& s) {
  layout.reduce();
  for (int i = 0; i < layout.count; ++i) plane.add(layout.points[i], s);
}

/// The largest disc within what two discs share, `apart` metres apart along the unit vector
/// `towards`: the smaller one where the other holds it.
Circle largest_shared(const Circle& c1, const Circle& c2, double apart, const Vec2& towards) {
  if (c1.radius + apart <= c2.radius) return c1;
  if (c2.radius + apart <= c1.radius) return c2;
  return {c1.centre + (c1.radius + apart - c2.radius) / 2 * towards,
          (c1.radius + c2.radius - apart) / 2};
}

/// How far a disc's centre lies from the middle between two opposite edges, and how far from there
/// on the disc is beyond them.
struct Edges : Strip {
  double offset, beyond;

  /// What of a coordinate is outside them.
  double excess(double from_middle) const {
    return from_middle - std::clamp(from_middle, -half_width, half_width);
  }
};

/// A disc within one that reaches beyond edges by a hair, and within these.
Circle narrowed(Circle disc, const Edges (&sides)[2]) {
  const double radius = disc.radius;
  for (const Edges& e : sides) {
    const double ahead = e.excess(e.offset + radius), behind = e.excess(e.offset - radius);
    disc.centre -= (ahead + behind) / 2 * e.across;
    disc.radius -= (ahead - behind) / 2;
  }
  return disc;
}

}  // namespace

void disc_on_rectangle(const Manifold& to, const FacingFeature& cap, const FacingFeature& face) {
  const ContactPlane plane(to, cap.axis);
  const ContactPlane::Face seen = plane.face(face);
  const Surfaces s{plane.incline(cap), seen.surface};
  const Circle disc{plane.to_plane(cap.middle), cap.radius};
  const auto edges = [&](int i) -> Edges {
    const Strip& strip = seen.strips[i];
    const double x = strip.across.x(), y = strip.across.y(), inverse = 1 / std::sqrt(x * x + y * y);
    const double middle = inverse * (strip.middle + face.left_out[i] / 2);
    const double half_width = inverse * (strip.half_width + std::abs(face.left_out[i]) / 2);
    return {{Vec2(inverse * x, inverse * y), middle, half_width},
            inverse * (x * disc.centre.x() + y * disc.centre.y()) - middle,
            half_width - disc.radius};
  };
  const Edges sides[] = {edges(0), edges(1)};
  const double unseen = unseen_part * disc.radius;
  const auto lies_between = [&](const Edges& e) { return std::abs(e.offset) <= e.beyond + unseen; };
  if (lies_between(sides[0]) && lies_between(sides[1])) {
    return add_disc(plane, narrowed(disc, sides), sides[0].across, s);
  }

  const ArcPolygon region(disc, sides[0], sides[1], unseen_part);
  if (region.empty()) {
    // The rim only touches the face's edge: the face's point that is nearest to the cap's middle.
    const auto way = [](const Edges& e) {
      return std::clamp(e.offset, -e.half_width, e.half_width) - e.offset;
    };
    const Vec2 &across0 = sides[0].across, &across1 = sides[1].across;
    const double way0 = way(sides[0]), way1 = way(sides[1]);
    // At a corner both edges count, which are not quite at right angles where the face leans.
    const bool is_corner = way0 != 0 && way1 != 0;
    const Vec2 arm = is_corner ? Vec2((way1 * turned_left(across0) - way0 * turned_left(across1)) /
                                      cross2(across0, across1))
                               : Vec2(way0 * across0 + way1 * across1);
    return plane.add(disc.centre + arm, s);
  }
  PatchLayout layout(disc.radius);
  // No two corners of a symmetric patch are equally far along this direction.
  std::array<Vec2, Contact::max_points> points;
  const int count = region.spread(sides[0].across + 0.37 * sides[1].across, points);
  // An arc that is not cut ends within the face, too.
  const auto keep_within = [&](Vec2& p) {
    for (const Edges& e : sides) {
      const double over = std::abs(e.offset) - e.beyond;
      if (over > 0 && over <= unseen) p -= e.excess(e.across.dot(p) - e.middle) * e.across;
    }
  };
  for (int i = 0; i < count; ++i) {
    keep_within(points[i]);
    layout.add(points[i]);
  }
  const Vec2 slope = s.slope();
  follow_slope(layout, plane, 2 * disc.radius * slope.norm(), s, [&] {
    Vec2 deepest = region.farthest(-slope);
    keep_within(deepest);
    return deepest;
  });
  for (int i = 0; i < 2; ++i) {  // of a face that leans, the part that faces the cap
    if (face.left_out[i] == 0) continue;
    const double side = std::copysign(1, face.left_out[i]);
    const Strip& strip = seen.strips[i];
    layout.cut_off(side * strip.across, side * strip.middle + strip.half_width);
  }
  add_points(plane, layout, s);
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
  const Vec2 between = c2.centre - c1.centre;
  const double apart = between.norm(), smaller = std::min(c1.radius, c2.radius);
  const Vec2 towards = apart > 0 ? Vec2(between / apart) : Vec2(1, 0);
  if (apart >= c1.radius + c2.radius) {  // the rims only touch
    return plane.add(c1.centre + c1.radius / (c1.radius + c2.radius) * between, s);
  }
  const Circle disc = largest_shared(c1, c2, apart, towards);
  // A disc is held by three points, and one of which the other cap leaves a lens by four. Of nearly
  // coaxial caps rounding says where the line of centres runs, so the four wait until it is clear.
  constexpr double clear = 1e-6, handed_over = 0.005;
  const double missing = (apart - std::abs(c1.radius - c2.radius)) / smaller;
  const HandOver over{(missing - clear) / handed_over};
  const Vec2 anchor = plane.to_plane(first.mark).normalized();
  if (!over.has_begun()) return add_disc(plane, disc, anchor, s);

  const Lens lens(c1, c2, apart, towards);
  PatchLayout layout(smaller);
  for (const Vec2& p : lens.spread()) {
    layout.add(disc.centre + over.new_size() * (p - disc.centre));
  }
  if (!over.is_over()) {
    std::array<Vec2, 6> arms;
    const Circle old{disc.centre, over.old_size() * disc.radius};
    const int count = spread_arms(plane, old, anchor, s, arms);
    for (int i = 0; i < count; ++i) layout.add(disc.centre + arms[i]);
  }
  const Vec2 slope = s.slope();
  const double steepness = slope.norm();
  follow_slope(layout, plane, 2 * smaller * steepness, s,
               [&] { return lens.farthest(-slope / steepness); });
  add_points(plane, layout, s);
}

}  // namespace touchstone
