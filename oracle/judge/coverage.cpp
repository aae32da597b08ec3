#include <algorithm>
#include <limits>
#include <utility>

#include "oracle/judge/score.hpp"
#include "oracle/patch/convex_set.hpp"

namespace touchstone {
namespace {

using oracle::ConvexSet;
using oracle::Vec2;

Vec2 across(const Vec2& d) { return {d.y(), -d.x()}; }

double width(const ConvexSet& set, const Vec2& direction) {
  return set.support(direction) + set.support(-direction);
}

/// Direction in which a convex set is narrowest, up to sampling: a polygon is narrowest
/// perpendicular to one of its sides.
Vec2 narrowest_direction(const ConvexSet& set) {
  constexpr int chords_per_quarter = 8;
  const std::vector<Vec2> outline = set.outline(chords_per_quarter);
  Vec2 best(1, 0);
  double min_width = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 side = outline[(i + 1) % outline.size()] - outline[i];
    if (!(side.norm() > 0)) continue;
    const Vec2 direction = across(side.normalized());
    const double here = width(set, direction);
    if (here < min_width) {
      min_width = here;
      best = direction;
    }
  }
  return best;
}

double reach(const std::vector<Vec2>& points, const Vec2& centre, const Vec2& direction) {
  double max = -std::numeric_limits<double>::infinity();
  for (const Vec2& p : points) max = std::max(max, (p - centre).dot(direction));
  return max;
}

}  // namespace

PatchExtent::PatchExtent(oracle::ContactPatch of) : patch(std::move(of)) {
  const ConvexSet& set = patch.shape();
  centre = set.centroid();
  narrow = narrowest_direction(set);
  min_width = width(set, narrow);
  width_across = width(set, across(narrow));
}

double coverage(const PatchExtent& extent, const std::vector<Vec3>& points, double resolution) {
  if (points.empty()) return 0;
  if (extent.width_across <= resolution) return 1;
  std::vector<Vec2> flat;
  flat.reserve(points.size());
  for (const Vec3& p : points) flat.push_back(extent.patch.in_plane(p));

  std::vector<Vec2> directions;
  if (extent.min_width <= resolution) {
    const Vec2 wide = across(extent.narrow);
    directions = {wide, -wide};
  } else {
    // The shrunk patch lies within the hull if it lies inside each of the hull's sides.
    const std::vector<Vec2> hull = oracle::plane_hull(flat);
    if (hull.size() < 3) return 0;
    for (std::size_t i = 0; i < hull.size(); ++i) {
      directions.push_back(across(hull[(i + 1) % hull.size()] - hull[i]).normalized());
    }
  }
  const ConvexSet& set = extent.patch.shape();
  double smallest = 1;
  for (const Vec2& d : directions) {
    smallest =
        std::min(smallest, reach(flat, extent.centre, d) / (set.support(d) - extent.centre.dot(d)));
  }
  return std::max(0.0, smallest);
}

double coverage(const oracle::ContactPatch& patch, const std::vector<Vec3>& points,
                double resolution) {
  return coverage(PatchExtent(patch), points, resolution);
}

}  // namespace touchstone
