#include "reduce_points.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace touchstone {
namespace {

constexpr int capacity = Contact::max_points;

/// The points of a contact seen along its normal, numbered by their angle about their middle.
struct Outline {
  int count;
  std::array<int, capacity> place;  ///< of each point among the contact's
  /// Twice the signed area of the triangle of the middle and two points.
  double area[capacity][capacity];
  double squared[capacity][capacity];  ///< of two points' distance
  double length;                       ///< the largest distance of two points
  unsigned deepest = 0;                ///< bits of the points that are as deep as any

  explicit Outline(const Contact& contact) : count(static_cast<int>(contact.points().size())) {
    const auto points = contact.points();
    Vec3 middle = Vec3::Zero();
    double depth = points[0].depth;
    for (const ContactPoint& p : points)
      middle += p.position / count, depth = std::max(depth, p.depth);
    // Seen along the axis nearest to the normal all areas shrink alike.
    int z = 0;
    contact.normal.cwiseAbs().maxCoeff(&z);
    const int x = (z + 1) % 3, y = (z + 2) % 3;
    std::array<Vec3, capacity> arm;
    std::array<double, capacity> angle;
    for (int i = 0; i < count; ++i) {
      arm[i] = points[i].position - middle;
      angle[i] = std::atan2(arm[i][y], arm[i][x]);
    }
    std::iota(place.begin(), place.begin() + count, 0);
    std::sort(place.begin(), place.begin() + count,
              [&](int i, int j) { return angle[i] < angle[j]; });
    double most = 0;
    for (int i = 0; i < count; ++i) {
      for (int j = 0; j < count; ++j) {
        const Vec3 &p = arm[place[i]], &q = arm[place[j]];
        area[i][j] = p[x] * q[y] - p[y] * q[x];
        squared[i][j] = (p - q).squaredNorm();
        most = std::max(most, squared[i][j]);
      }
    }
    length = std::sqrt(most);
    constexpr double equally_deep = 1e-6;
    for (int i = 0; i < count; ++i) {
      if (points[place[i]].depth >= depth - equally_deep * length) deepest |= 1u << i;
    }
  }

  /// Twice the area of a subset's polygon; the squared length of two points.
  double span(unsigned subset) const {
    const int first = std::countr_zero(subset);
    int last = first;
    double sum = 0;
    for (unsigned rest = subset & (subset - 1); rest != 0; rest &= rest - 1) {
      const int next = std::countr_zero(rest);
      if (std::popcount(subset) == 2) return squared[first][next];
      sum += area[last][next];
      last = next;
    }
    return sum + area[last][first];
  }
};

}  // namespace

void reduce_points(Contact& contact, int max_points) {
  const int count = static_cast<int>(contact.points().size());
  if (count <= max_points) return;
  const Outline outline(contact);
  constexpr double clearly_more = 1.001;
  unsigned best = 0;
  double most = 0;
  // All subsets of this size in the order of their bits (Gosper's hack: HAKMEM, item 175).
  for (unsigned subset = (1u << max_points) - 1; subset < 1u << count;) {
    if ((subset & outline.deepest) != 0) {
      const double span = outline.span(subset);
      if (best == 0 || span > clearly_more * most) best = subset, most = span;
    }
    const unsigned low = subset & -subset, carried = subset + low;
    subset = carried | (((subset ^ carried) >> 2) / low);
  }
  unsigned kept = 0;
  for (int i = 0; i < count; ++i) kept |= (best >> i & 1u) << outline.place[i];
  const Contact all = contact;
  contact.clear_points();
  for (int i = 0; i < count; ++i) {
    const ContactPoint& p = all.points()[i];
    if (kept >> i & 1u) contact.add_point(p.position, p.depth);
  }
}

}  // namespace touchstone
