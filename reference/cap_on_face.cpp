#include <algorithm>

#include "contact_plane.hpp"
#include "disc_layout.hpp"

namespace touchstone {

void ContactPlane::cap_on_face(const FacingFeature& cap, const FacingFeature& face) {
  const Surfaces s{incline(cap), incline(face)};
  const Circle disc{to_plane(cap.middle), cap.radius};
  // The face's edges lie across `side`, half_side from its middle; how far the disc's centre lies
  // from there, and how far from there on the disc is beyond the face.
  std::array<Vec2, 2> side;
  std::array<double, 2> middle, half_side, offset, beyond;
  for (int i = 0; i < 2; ++i) {
    const Strip strip = this->strip(face, i);
    const double inverse = 1 / strip.across.norm();
    side[i] = inverse * strip.across;
    middle[i] = inverse * strip.middle;
    half_side[i] = inverse * strip.half_width;
    offset[i] = side[i].dot(disc.centre) - middle[i];
    beyond[i] = half_side[i] - disc.radius;
  }
  const bool whole = std::abs(offset[0]) <= beyond[0] && std::abs(offset[1]) <= beyond[1];
  if (whole) return add_disc(disc, side[0], s);

  ArcPolygon region(disc);
  for (int i = 0; i < 2; ++i) {
    if (offset[i] > beyond[i]) region.clip(side[i], half_side[i] + middle[i]);
    if (-offset[i] > beyond[i]) region.clip(-side[i], half_side[i] - middle[i]);
  }
  if (region.empty()) {
    // The rim only touches the face's edge: the face's point that is nearest to the cap's middle.
    Vec2 p = disc.centre;
    for (int i = 0; i < 2; ++i) {
      p += (std::clamp(offset[i], -half_side[i], half_side[i]) - offset[i]) * side[i];
    }
    return add(p, s);
  }
  const Vec2 slope = s.slope();
  const double most_rise = 2 * disc.radius * slope.norm();
  if (most_rise > margins_.slack && add_leaning(region, s)) return;
  std::array<Vec2, 8> points;
  // No two corners of a symmetric patch are equally far along this direction.
  const int count = region.spread(side[0] + 0.37 * side[1], points);
  const double part = part_of_the_way_to_the_deepest(most_rise, margins_.clear_rise);
  add_layout(points, count, part, part > 0 ? region.farthest(-slope) : Vec2(0, 0), s);
}

}  // namespace touchstone
