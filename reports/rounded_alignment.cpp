#include "reports/rounded_alignment.hpp"

#include <cmath>

namespace touchstone {
namespace {

oracle::Alignment alignment(const Vec3& axis, const Vec3& n) {
  constexpr double rounding = 1e-12;
  if (std::abs(axis.dot(n)) <= rounding) return oracle::Alignment::perpendicular;
  if (axis.cross(n).norm() <= rounding) return oracle::Alignment::parallel;
  return oracle::Alignment::oblique;
}

}  // namespace

oracle::OptimalNormal with_rounded_alignment(const Configuration& c, const Vec3& n) {
  oracle::OptimalNormal result{n, alignment(c.pose_a.rotation().col(2), n), {}};
  const Eigen::Matrix3d axes = c.pose_b.rotation();
  const Pair pair = pair_of(c);
  if (pair == Pair::plane || pair == Pair::sphere) return result;
  for (int i = pair == Pair::box ? 0 : 2; i < 3; ++i) {
    result.to_b[i] = alignment(axes.col(i), n);
  }
  return result;
}

}  // namespace touchstone
