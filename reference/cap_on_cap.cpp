#include <algorithm>
#include <cmath>

#include "contact_plane.hpp"
#include "disc_layout.hpp"

namespace touchstone {
namespace {

/// The largest disc within what two discs share, `apart` metres apart along the unit vector
/// `towards`: the smaller one where the other holds it.
Circle largest_shared(const Circle& c1, const Circle& c2, double apart, const Vec2& towards) {
  if (c1.radius + apart <= c2.radius) return c1;
  if (c2.radius + apart <= c1.radius) return c2;
  return {c1.centre + (c1.radius + apart - c2.radius) / 2 * towards,
          (c1.radius + c2.radius - apart) / 2};
}

/// The least factor by which a disc across `axis` shrinks when it is carried along `n` to the plane
/// across `upright`, or somewhat less: a vector v of its plane is carried to v − v·upright /
/// n·upright n, which is not shorter than v's part across n.
double least_scale(const Vec3& axis, const Vec3& upright, const Vec3& n) {
  const double cosine = std::abs(axis.dot(n)), turn = axis.cross(upright).norm();
  const double lean = axis.cross(n).norm();
  return std::max(cosine, std::sqrt(std::max(0.0, 1 - 2 * turn * lean / std::abs(upright.dot(n)))));
}

}  // namespace

void ContactPlane::cap_on_cap(const FacingFeature& first, const FacingFeature& second,
                              bool first_is_a) {
  const Incline incline1 = incline(first), incline2 = incline(second);
  const Surfaces s = first_is_a ? Surfaces{incline1, incline2} : Surfaces{incline2, incline1};
  // A leaning disc is seen as an ellipse; the circle within it keeps its points on the body.
  const Circle c1{to_plane(first.middle), first.radius};
  const Circle c2{to_plane(second.middle),
                  second.radius * least_scale(second.axis, first.axis, n_)};
  const Vec2 between = c2.centre - c1.centre;
  const double apart = between.norm(), smaller = std::min(c1.radius, c2.radius);
  const Vec2 towards = apart > 0 ? Vec2(between / apart) : Vec2(1, 0);
  if (apart >= c1.radius + c2.radius) {  // the rims only touch
    return add(c1.centre + c1.radius / (c1.radius + c2.radius) * between, s);
  }
  const Circle disc = largest_shared(c1, c2, apart, towards);
  // A disc is held by three points, and one of which the other cap leaves a lens by four. Of nearly
  // coaxial caps rounding says where the line of centres runs, so the four wait until it is clear.
  constexpr double clear = 1e-6, handed_over = 0.005;
  const double missing = (apart - std::abs(c1.radius - c2.radius)) / smaller;
  const HandOver over{(missing - clear) / handed_over};
  if (!over.has_begun()) return add_disc(disc, to_plane(first.mark).normalized(), s);

  const Vec2 slope = s.slope();
  const double steepness = slope.norm(), most_rise = 2 * smaller * steepness;
  const Lens lens(c1, c2, apart, towards);
  if (most_rise > margins_.slack && add_leaning(ArcPolygon(lens), s)) return;
  std::array<Vec2, 8> points;
  int count = 0;
  for (const Vec2& p : lens.spread()) {
    points[count++] = disc.centre + over.new_size() * (p - disc.centre);
  }
  if (!over.is_over()) {
    for (const Vec2& arm :
         three_arms(over.old_size() * disc.radius, to_plane(first.mark).normalized())) {
      points[count++] = disc.centre + arm;
    }
  }
  const double part = part_of_the_way_to_the_deepest(most_rise, margins_.clear_rise);
  add_layout(points, count, part, part > 0 ? lens.farthest(-slope / steepness) : Vec2(0, 0), s);
}

}  // namespace touchstone
