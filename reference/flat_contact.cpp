// A cap on a cap or on a face.
#include <algorithm>
#include <cmath>
#include <limits>

#include "contact_plane.hpp"
#include "disc_layout.hpp"

namespace touchstone {
namespace {

/// Adds points of a whole disc, at rest the first along `anchor` (disc_layout.hpp).
void add_disc(const ContactPlane& plane, const Circle& disc, const Vec2& anchor,
              const Surfaces& s) {
  const Vec2 slope = s.slope();
  const double steepness = slope.norm(), rise = 2 * disc.radius * steepness;
  const double room = plane.room_above(s.clearance(disc.centre) - rise / 2);
  if (!(room > 0)) return;
  if (is_one_point(room, rise)) return plane.add(disc.centre - disc.radius / steepness * slope, s);
  std::array<Vec2, 6> arms;
  const int count = spread_disc(disc.radius, slope, anchor, room,
                                std::min(plane.margins().clear_rise(), room / 8), arms);
  for (int i = 0; i < count; ++i) plane.add(disc.centre + arms[i], s);
}

/// Adds a layout of so many points, and the deepest point with that weight against their middle.
void add_layout(const ContactPlane& plane, std::array<Vec2, 8>& layout, int count, double part,
                const Vec2& deepest, const Surfaces& s) {
  if (part > 0) {
    Vec2 sum = Vec2::Zero();
    int nearest = 0;
    double nearest_squared = std::numeric_limits<double>::infinity();
    for (int i = 0; i < count; ++i) {
      sum += layout[i];
      const double squared = (layout[i] - deepest).squaredNorm();
      if (squared < nearest_squared) nearest_squared = squared, nearest = i;
    }
    const Vec2 middle = sum / count;
    // The same point twice would tell a solver that the body stands more firmly there.
    constexpr double same = 1e-6;
    if (nearest_squared > same * same * (middle - deepest).squaredNorm()) {
      if (count < Contact::max_points) {
        layout[count++] = middle + part * (deepest - middle);
      } else {
        layout[nearest] += part * (deepest - layout[nearest]);
      }
    }
  }
  for (int i = 0; i < count; ++i) plane.add(layout[i], s);
}

/// Adds, of a region over which the clearance has a slope, points of the part that does not rise
/// above the slack, the deepest among them; to that it is clipped. False, and no points, where all
/// of it is within.
bool add_leaning(const ContactPlane& plane, ArcPolygon& region, const Surfaces& s) {
  const Vec2 slope = s.slope();
  const double steepness = slope.norm();
  const Vec2 lowest = -slope / steepness;
  const auto [deepest, highest] = region.extremes(lowest);
  const double bottom = -lowest.dot(deepest), top = -lowest.dot(highest);
  const double room = plane.room_above(s.clearance(deepest));
  if (steepness * (top - bottom) <= room) return false;
  if (is_one_point(room, steepness * (top - bottom))) {
    plane.add(deepest, s);
    return true;
  }
  region.clip(-lowest, bottom + room / steepness);
  region.mark_farthest(lowest);
  std::array<Vec2, 8> points;
  const int count = region.spread(lowest, points);
  for (int i = 0; i < count; ++i) plane.add(points[i], s);
  return true;
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
  const auto edges = [&](const Strip& strip) -> Edges {
    const double x = strip.across.x(), y = strip.across.y(), inverse = 1 / std::sqrt(x * x + y * y);
    const double middle = inverse * strip.middle, half_width = inverse * strip.half_width;
    return {{Vec2(inverse * x, inverse * y), middle, half_width},
            inverse * (x * disc.centre.x() + y * disc.centre.y()) - middle,
            half_width - disc.radius};
  };
  const Edges sides[] = {edges(seen.strips[0]), edges(seen.strips[1])};
  const double unseen = unseen_part * disc.radius;
  const auto lies_between = [&](const Edges& e) { return std::abs(e.offset) <= e.beyond + unseen; };
  if (lies_between(sides[0]) && lies_between(sides[1])) {
    return add_disc(plane, narrowed(disc, sides), sides[0].across, s);
  }

  const Vec2 slope = s.slope();
  const double max_rise = 2 * disc.radius * slope.norm();
  const bool leans = max_rise > plane.margins().slack;
  ArcPolygon region(disc, sides[0], sides[1], leans ? ArcPolygon::sliver : unseen_part);
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
  if (leans && add_leaning(plane, region, s)) return;
  std::array<Vec2, 8> points;
  // No two corners of a symmetric patch are equally far along this direction.
  const int count = region.spread(sides[0].across + 0.37 * sides[1].across, points);
  for (const Edges& e : sides) {  // an arc that is not cut ends within the face, too
    const double over = std::abs(e.offset) - e.beyond;
    if (!(over > 0 && over <= unseen)) continue;
    for (int i = 0; i < count; ++i) {
      points[i] -= e.excess(e.across.dot(points[i]) - e.middle) * e.across;
    }
  }
  const double part = deepest_point_weight(max_rise, plane.margins().clear_rise());
  add_layout(plane, points, count, part, part > 0 ? region.farthest(-slope) : Vec2(0, 0), s);
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
  if (!over.has_begun()) return add_disc(plane, disc, plane.to_plane(first.mark).normalized(), s);

  const Vec2 slope = s.slope();
  const double steepness = slope.norm(), max_rise = 2 * smaller * steepness;
  const Lens lens(c1, c2, apart, towards);
  if (max_rise > plane.margins().slack) {
    ArcPolygon region(lens);
    if (add_leaning(plane, region, s)) return;
  }
  std::array<Vec2, 8> points;
  int count = 0;
  for (const Vec2& p : lens.spread()) {
    points[count++] = disc.centre + over.new_size() * (p - disc.centre);
  }
  if (!over.is_over()) {
    for (const Vec2& arm :
         three_arms(over.old_size() * disc.radius, plane.to_plane(first.mark).normalized())) {
      points[count++] = disc.centre + arm;
    }
  }
  const double part = deepest_point_weight(max_rise, plane.margins().clear_rise());
  add_layout(plane, points, count, part, part > 0 ? lens.farthest(-slope / steepness) : Vec2(0, 0),
             s);
}

}  // namespace touchstone
