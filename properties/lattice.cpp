#include "properties/lattice.hpp"

#include <array>
#include <cmath>
#include <initializer_list>
#include <stdexcept>

namespace touchstone {

Lattice::Lattice(Draw& draw, Frame frame) {
  do {
    const auto entry = [&] { return static_cast<double>(draw.integer(-4, 4)); };
    const double w = entry(), x = entry(), y = entry(), z = entry();
    q_ = Eigen::Quaterniond(w, x, y, z);
    norm_ = w * w + x * x + y * y + z * z;
  } while (norm_ == 0);
  if (frame == Frame::aligned) {
    q_ = Eigen::Quaterniond(1, 0, 0, 0);
    norm_ = 1;
  }
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
  // Sums of integers below 2^53, times a power of two: exact.
  return Vec3(((i * a.x.x() + j * a.y.x()) + k * a.z.x()) * scale_,
              ((i * a.x.y() + j * a.y.y()) + k * a.z.y()) * scale_,
              ((i * a.x.z() + j * a.y.z()) + k * a.z.z()) * scale_);
}

Eigen::Quaterniond Lattice::orientation(const Eigen::Quaterniond& turn) const {
  return product(q_, turn);
}

namespace {

Shape other_shape(Pair pair, const Lattice& l, const Sizes& s) {
  switch (pair) {
    case Pair::plane:
      return Plane(Vec3(0, 0, 1), 0);
    case Pair::sphere:
      return Sphere(l.length(s.radius_b));
    case Pair::capsule:
      return Capsule(l.length(s.radius_b), l.length(s.half_b));
    case Pair::cylinder:
      return Cylinder(l.length(s.radius_b), l.length(s.half_b));
    case Pair::box:
      return Box(Vec3(l.length(s.radius_b), l.length(s.other_b), l.length(s.half_b)));
  }
  throw std::logic_error("no such pair");
}

}  // namespace

Sizes draw_sizes(Draw& draw, const Lattice& lattice, Proportions proportions) {
  const auto size = [&] { return lattice.draw_size(draw); };
  Sizes s{size(), size(), size(), size(), size()};
  const auto divide = [](std::initializer_list<Steps*> lengths, Steps by) {
    for (Steps* length : lengths) *length /= by;
  };
  switch (proportions) {
    case Proportions::usual:
      break;
    case Proportions::needle:
      s.half_a = s.radius_a;
      divide({&s.radius_a}, extreme_ratio);
      break;
    case Proportions::coin:
      s.half_a = s.radius_a;
      divide({&s.half_a}, extreme_ratio);
      break;
    case Proportions::plate: {
      const std::array<bool, 3> is_thin = draw_thin_extents(draw);
      s.other_b = s.half_b = s.radius_b;
      if (is_thin[0]) divide({&s.radius_b}, extreme_ratio);
      if (is_thin[1]) divide({&s.other_b}, extreme_ratio);
      if (is_thin[2]) divide({&s.half_b}, extreme_ratio);
      break;
    }
    case Proportions::uneven: {
      const std::int64_t ratio = draw_uneven_ratio(draw);
      if (draw.coin()) {
        divide({&s.radius_a, &s.half_a}, ratio);
      } else {
        divide({&s.radius_b, &s.half_b, &s.other_b}, ratio);
      }
      break;
    }
  }
  return s;
}

Steps draw_offset(Draw& draw, Steps max) { return draw.integer(-max, max); }

Steps reach_b(Pair pair, const Sizes& s) {
  if (pair == Pair::capsule) return s.half_b + s.radius_b;
  return pair == Pair::sphere ? s.radius_b : s.half_b;
}

Configuration place(Draw& draw, Pair pair, const Lattice& l, const Sizes& s, const Placement& p) {
  const Steps x = draw_offset(draw, Lattice::metre), y = draw_offset(draw, Lattice::metre),
              z = draw_offset(draw, Lattice::metre);
  return {Cylinder(l.length(s.radius_a), l.length(s.half_a)),
          Pose(l.at(x + p.x, y + p.y, z + p.z), l.orientation(p.turn_a)), other_shape(pair, l, s),
          Pose(l.at(x, y, z), l.orientation(p.turn_b))};
}

}  // namespace touchstone
