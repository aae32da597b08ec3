// Points whose hull covers an ArcPolygon well.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "arc_polygon.hpp"
#include "disc_layout.hpp"

namespace touchstone {
namespace {

/// An arc that is not longer than this is covered well by its ends.
constexpr double long_arc = 0.4 * std::numbers::pi;
/// An arc's piece that stands out by less than this part of the region's width is covered by its
/// ends.
constexpr double flat_part = 0.14;
/// With so many points an arc need not be divided for that.
constexpr int enough = 6;

double twice_area(const Vec2& p, const Vec2& q, const Vec2& r) {
  return std::abs(cross2(q - p, r - p));
}

}  // namespace

int ArcPolygon::spread(const Vec2& first, std::array<Vec2, 8>& points) const {
  if (is_disc_) {
    const auto& [centre, radius] = circles_[0];
    int count = 0;
    for (const Vec2& arm : three_arms(radius, first.normalized())) points[count++] = centre + arm;
    return count;
  }

  struct Edge {
    Vec2 from;
    int circle;
    double angle;
    int inside;           // points on it, ends not counted
    double standing_out;  // how far its pieces do, as a part of the region's width there
  };
  std::array<Edge, max_vertices> edges;
  int total = 0;
  int corner = 0;
  for (int i = 1; i < count_; ++i) {
    if (first.dot(vertices_[i].at - vertices_[corner].at) > 0) corner = i;
  }
  for (int i = 0; i < count_; ++i, corner = next(corner)) {
    const auto& [from, circle] = vertices_[corner];
    double angle = 0;
    if (circle != straight) {
      const Vec2& centre = circles_[circle].centre;
      angle = angle_between(from - centre, vertices_[next(corner)].at - centre);
    }
    edges[i] = {from, circle, angle, 0, 0};
  }
  for (int i = 0; i < count_; ++i) {
    Edge& e = edges[i];
    e.inside = std::max(0, static_cast<int>(std::ceil(e.angle / long_arc - 1e-9)) - 1);
    total += 1 + e.inside;
  }
  const auto piece = [](const Edge& e) { return e.angle / (e.inside + 1); };
  const auto rise = [&](const Edge& e, double angle) {  // of an arc above its chord
    return circles_[e.circle].radius * (1 - std::cos(angle / 2));
  };
  const auto measure = [&](int i) {
    Edge& e = edges[i];
    if (e.circle == straight) return;
    const Vec2 chord = edges[i + 1 < count_ ? i + 1 : 0].from - e.from;
    const double length = chord.norm();
    double width = 0;
    for (int k = 0; k < count_ && length > 0; ++k) {
      width = std::max(width, cross2(chord, edges[k].from - e.from) / length);
    }
    const double whole = rise(e, e.angle);
    e.standing_out = (e.inside == 0 ? whole : rise(e, piece(e))) / (width + whole);
  };
  for (int i = 0; i < count_ && total < enough; ++i) measure(i);
  while (total < enough) {
    int most = 0;
    for (int i = 1; i < count_; ++i) {
      if (edges[i].standing_out > edges[most].standing_out) most = i;
    }
    if (!(edges[most].standing_out > flat_part)) break;
    ++edges[most].inside;
    ++total;
    measure(most);
  }

  std::array<Vec2, std::size_t{2} * max_vertices> all;
  int count = 0;
  for (int i = 0; i < count_; ++i) {
    const Edge& e = edges[i];
    all[count++] = e.from;
    if (e.inside == 0) continue;
    const Vec2& centre = circles_[e.circle].centre;
    const double c = std::cos(piece(e)), s = std::sin(piece(e));
    Vec2 arm = e.from - centre;
    for (int k = 1; k <= e.inside; ++k) {
      arm = Vec2(c * arm.x() - s * arm.y(), s * arm.x() + c * arm.y());
      all[count++] = centre + arm;
    }
  }
  while (count > static_cast<int>(points.size())) {  // but the first, the one that spans the least
    int least = 1;
    double least_area = std::numeric_limits<double>::infinity();
    for (int i = 1; i < count; ++i) {
      const double area = twice_area(all[(i + count - 1) % count], all[i], all[(i + 1) % count]);
      if (area < least_area) least_area = area, least = i;
    }
    std::copy(all.begin() + least + 1, all.begin() + count, all.begin() + least);
    --count;
  }
  std::copy(all.begin(), all.begin() + count, points.begin());
  return count;
}

}  // namespace touchstone
