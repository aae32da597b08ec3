// A cap on a cap or face: what both have in common.
#include "contact_plane.hpp"
#include "disc_layout.hpp"

namespace touchstone {

using Kind = FacingFeature::Kind;

void ContactPlane::flat_on_flat(const FacingFeature& a, const FacingFeature& b) {
  const Surfaces surfaces{incline(a), incline(b)};
  b.kind == Kind::rectangle ? cap_on_face(a, b, surfaces) : cap_on_cap(a, b, surfaces);
}

void ContactPlane::add_disc(const Circle& disc, const Vec2& anchor, const Surfaces& s) {
  std::array<Vec2, 6> arms;
  const int count = spread_disc(disc.radius, s.slope(), anchor, slack_, arms);
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
  const double bottom = -lowest.dot(region.farthest(lowest));
  const double top = -lowest.dot(region.farthest(-lowest));
  if (steepness * (top - bottom) <= slack_) return false;
  region.clip(-lowest, bottom + slack_ / steepness);
  region.mark_farthest(lowest);
  std::array<Vec2, 8> points;
  const int count = region.spread(lowest, points);
  for (int i = 0; i < count; ++i) add(points[i], s);
  return true;
}

}  // namespace touchstone
