#include "properties/lattice.hpp"

#include <cmath>

namespace touchstone {

Lattice::Lattice(Draw& draw) {
  do {
    const auto entry = [&] { return static_cast<double>(draw.integer(-4, 4)); };
    const double w = entry(), x = entry(), y = entry(), z = entry();
    q_ = Eigen::Quaterniond(w, x, y, z);
    norm_ = w * w + x * x + y * y + z * z;
  } while (norm_ == 0);
  // The largest power of two with norm · scale · metre <= 1 metre.
  int exponent = 0;
  std::frexp(norm_, &exponent);
  scale_ = std::ldexp(1, -25 - exponent);
}

double Lattice::length(std::int64_t steps) const {
  return static_cast<double>(steps) * norm_ * scale_;
}

Vec3 Lattice::at(std::int64_t x, std::int64_t y, std::int64_t z) const {
  const Axes a = axes(q_);
  const double i = static_cast<double>(x), j = static_cast<double>(y), k = static_cast<double>(z);
  // Integers below 2^53, then a power of two.
  return Vec3(((i * a.x.x() + j * a.y.x()) + k * a.z.x()) * scale_,
              ((i * a.x.y() + j * a.y.y()) + k * a.z.y()) * scale_,
              ((i * a.x.z() + j * a.y.z()) + k * a.z.z()) * scale_);
}

Eigen::Quaterniond Lattice::orientation(const Eigen::Quaterniond& turn) const {
  return product(q_, turn);
}

}  // namespace touchstone
