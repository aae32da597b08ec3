#include "reduce_points.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace touchstone {
namespace {

constexpr int capacity = Contact::max_points;

/// The points of a contact seen along its normal, in the order in which they lie around their
/// middle, from the first one on. A set of them is the bits of their places in that order.
class Outline {
 public:
  explicit Outline(const Contact& contact) : count_(static_cast<int>(contact.points().size())) {
    // Seen along the axis nearest to the normal, all areas shrink alike.
    int z = 0;
    contact.normal.cwiseAbs().maxCoeff(&z);
    const int x = (z + 1) % 3, y = (z + 2) % 3;
    const double side = std::copysign(1, contact.normal[z]);
    Vec3 middle = Vec3::Zero();
    for (const ContactPoint& p : contact.points()) middle += p.position / count_;
    std::array<Vec3, capacity> arm;
    std::array<double, capacity> angle;
    double longest = 0;
    for (int i = 0; i < count_; ++i) {
      arm[i] = contact.points()[i].position - middle;
      angle[i] = std::atan2(side * arm[i][y], arm[i][x]);
      longest = std::max(longest, arm[i].cwiseAbs().maxCoeff());
    }
    // No product may overflow or vanish; a power of two rounds nothing.
    constexpr int max_exponent = 1000;
    const int exponent = std::ilogb(longest);  // INT_MIN of zero
    unit_ = std::ldexp(1, std::clamp(exponent, -max_exponent, max_exponent));
    for (int i = 0; i < count_; ++i) arm[i] *= 1 / unit_;
    std::iota(around_.begin(), around_.begin() + count_, 0);
    std::sort(around_.begin(), around_.begin() + count_,
              [&](int i, int j) { return angle[i] < angle[j]; });
    std::rotate(around_.begin(), std::find(around_.begin(), around_.begin() + count_, 0),
                around_.begin() + count_);
    for (int i = 0; i < count_; ++i) {
      for (int j = 0; j < count_; ++j) {
        const Vec3 &p = arm[around_[i]], &q = arm[around_[j]];
        area_[i][j] = side * (p[x] * q[y] - p[y] * q[x]);
        squared_[i][j] = (p - q).squaredNorm();
        max_squared_ = std::max(max_squared_, squared_[i][j]);
      }
    }
  }

  /// The contact's point at this place.
  int point(int place) const { return around_[place]; }
  /// The longest distance of two points, metres.
  double length() const { return unit_ * std::sqrt(max_squared_); }
  double squared_distance(unsigned pair) const {
    return squared_[std::countr_zero(pair)][std::countr_zero(pair & (pair - 1))];
  }
  /// Twice the area of the hull of corners and one more point: the corners' polygon, and the
  /// triangles over those of its edges beyond which the point lies.
  double area(unsigned corners, int more) const {
    const int first = std::countr_zero(corners);
    double sum = 0;
    for (unsigned rest = corners; rest != 0; rest &= rest - 1) {
      const int i = std::countr_zero(rest);
      const unsigned later = rest & (rest - 1);
      const int j = later != 0 ? std::countr_zero(later) : first;
      sum += std::max(area_[i][j], area_[i][more] + area_[more][j]);
    }
    return sum;
  }

 private:
  int count_;
  double unit_;  ///< of the lengths whose areas and squares follow, metres
  std::array<int, capacity> around_;
  double area_[capacity][capacity];     ///< twice that of the triangle of the middle and two points
  double squared_[capacity][capacity];  ///< of two points' distance
  double max_squared_ = 0;
};

}  // namespace

void reduce_points(Contact& contact, int max_points, double level, double max_lack) {
  const int count = static_cast<int>(contact.points().size());
  if (count <= max_points) return;
  const Contact all = contact;
  const Outline outline(all);
  double depth = all.points()[0].depth;
  for (const ContactPoint& p : all.points()) depth = std::max(depth, p.depth);
  unsigned deepest = 0;
  for (int k = 0; k < count; ++k) {
    const double lack = depth - all.points()[outline.point(k)].depth;
    const bool is_deep = lack <= std::min(level * outline.length(), max_lack);
    deepest |= static_cast<unsigned>(is_deep) << k;
  }
  constexpr double clearly_more = 1.001;
  unsigned best = 0;
  double best_span = 0;
  // All sets of this size in the order of their bits (R. W. Gosper in HAKMEM, item 175).
  for (unsigned set = (1u << max_points) - 1; set < 1u << count;) {
    if (const unsigned deep = set & deepest; deep != 0) {
      // One of the deepest, which has to be kept, may lie inside.
      const unsigned kept = deep & -deep;
      const double span = max_points == 2 ? outline.squared_distance(set)
                                          : outline.area(set ^ kept, std::countr_zero(kept));
      if (best == 0 || span > clearly_more * best_span) best = set, best_span = span;
    }
    const unsigned low = set & -set, carried = set + low;
    set = carried | (((set ^ carried) >> 2) / low);
  }
  unsigned kept = 0;
  for (int k = 0; k < count; ++k) kept |= (best >> k & 1u) << outline.point(k);
  contact.clear_points();
  for (int i = 0; i < count; ++i) {
    const ContactPoint& p = all.points()[i];
    if (kept >> i & 1u) contact.add_point(p.position, p.depth);
  }
}

}  // namespace touchstone
