// A cap on a cap or face: what both have in common.
#include <algorithm>

#include "contact_plane.hpp"
#include "disc_layout.hpp"

namespace touchstone {

void ContactPlane::add_disc(const Circle& disc, const Vec2& anchor, const Surfaces& s) {
  const Vec2 slope = s.slope();
  const double steepness = slope.norm(), rise = 2 * disc.radius * steepness;
  const double room = room_above(s.clearance(disc.centre) - rise / 2);
  if (!(room > 0)) return;
  if (is_one_point(room, rise)) return add(disc.centre - disc.radius / steepness * slope, s);
  std::array<Vec2, 6> arms;
  const int count =
      spread_disc(disc.radius, slope, anchor, room, std::min(margins_.clear_rise, room / 8), arms);
  for (int i = 0; i < count; ++i) add(disc.centre + arms[i], s);
}

void ContactPlane::add_layout(std::array<Vec2, 8>& layout, int count, double part,
                              const Vec2& deepest, const Surfaces& s) {
  if (part > 0) {
    Vec2 middle = Vec2::Zero();
    int nearest = 0;
    for (int i = 0; i < count; ++i) {
      middle += layout[i] / count;
      if ((layout[i] - deepest).squaredNorm() < (layout[nearest] - deepest).squaredNorm()) {
        nearest = i;
      }
    }
    // The same point twice would tell a solver that the body stands more firmly there.
    constexpr double same = 1e-6;
    if ((layout[nearest] - deepest).norm() > same * (middle - deepest).norm()) {
      if (count < Contact::max_points) {
        layout[count++] = middle + part * (deepest - middle);
      } else {
        layout[nearest] += part * (deepest - layout[nearest]);
      }
    }
  }
  for (int i = 0; i < count; ++i) add(layout[i], s);
}

bool ContactPlane::add_leaning(ArcPolygon region, const Surfaces& s) {
  const Vec2 slope = s.slope();
  const double steepness = slope.norm();
  const Vec2 lowest = -slope / steepness;
  const Vec2 deepest = region.farthest(lowest);
  const double bottom = -lowest.dot(deepest), top = -lowest.dot(region.farthest(-lowest));
  const double room = room_above(s.clearance(deepest));
  if (steepness * (top - bottom) <= room) return false;
  if (!(room > 0)) return true;
  if (is_one_point(room, steepness * (top - bottom))) {
    add(deepest, s);
    return true;
  }
  region.clip(-lowest, bottom + room / steepness);
  region.mark_farthest(lowest);
  std::array<Vec2, 8> points;
  const int count = region.spread(lowest, points);
  for (int i = 0; i < count; ++i) add(points[i], s);
  return true;
}

}  // namespace touchstone
