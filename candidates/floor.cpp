#include "candidates/floor.hpp"

#include <cmath>

#include "reference/pose.hpp"

namespace touchstone {

Floor::Floor(const Vec3& half, int count) : count_(count), is_plane_(false) {
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3, last = (k + 2) % 3;
    const Vec3 u = half[next] * Vec3::Unit(next), v = half[last] * Vec3::Unit(last);
    for (const double side : {1.0, -1.0}) add_face(side * half[k] * Vec3::Unit(k), u, side * v);
  }
}

Floor::Floor(const ts_shape& a, const ts_shape& b, int count) : count_(count), is_plane_(true) {
  if (b.kind == TS_BOX) {
    *this = Floor(Vec3(b.size), count);
    return;
  }
  // The cylinder's centre is at most half a square from the middle, and all of it over the squares.
  constexpr double width = 5;
  side_ = width * std::hypot(a.size[0], a.size[1]) / count;
  displacement_ = b.size[3];
  to_normal_ = turn_between(Vec3::UnitZ(), Vec3(b.size));
  const double half = side_ * count / 2;
  add_face(Vec3::Zero(), half * Vec3::UnitX(), half * Vec3::UnitY());
}

void Floor::add_face(const Vec3& centre, const Vec3& u, const Vec3& v) {
  const int first = static_cast<int>(corners_.size()), row = count_ + 1;
  for (int j = 0; j <= count_; ++j) {
    for (int i = 0; i <= count_; ++i) {
      corners_.push_back(centre + (2.0 * i / count_ - 1) * u + (2.0 * j / count_ - 1) * v);
    }
  }
  for (int j = 0; j < count_; ++j) {
    for (int i = 0; i < count_; ++i) {
      const int corner = first + j * row + i, across = corner + row + 1;
      triangles_.push_back({corner, corner + 1, across});
      triangles_.push_back({corner, across, corner + row});
    }
  }
}

ts_pose Floor::at(const ts_pose& a, const ts_pose& b) const {
  if (!is_plane_) return b;
  const double* q = b.orientation;
  const Eigen::Quaterniond turn = Eigen::Quaterniond(q[0], q[1], q[2], q[3]) * to_normal_;
  const Vec3 corner = position_of(b) + displacement_ * (turn * Vec3::UnitZ());
  const Vec3 from_corner = turn.conjugate() * (position_of(a) - corner);
  // The middle of an odd number of squares is that of one.
  const double offset = count_ % 2 == 0 ? 0 : 0.5;
  const auto middle = [&](double x) { return side_ * (std::round(x / side_ - offset) + offset); };
  const Vec3 p = corner + turn * Vec3(middle(from_corner.x()), middle(from_corner.y()), 0);
  return {{p.x(), p.y(), p.z()}, {turn.w(), turn.x(), turn.y(), turn.z()}};
}

}  // namespace touchstone
