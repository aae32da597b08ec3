#include "properties/draw.hpp"

#include <cassert>
#include <cmath>

namespace touchstone {

std::uint64_t Draw::next() {
  if (!tape_) return random_.next();
  if (at_ == tape_->size()) tape_->push_back(random_.next());
  return (*tape_)[at_++];
}

std::int64_t Draw::integer(std::int64_t lo, std::int64_t hi) {
  assert(lo <= hi);
  const std::uint64_t count = static_cast<std::uint64_t>(hi - lo) + 1;
  // The bias of the remainder is below 2^-32 for the ranges in use.
  return lo + static_cast<std::int64_t>(next() % count);
}

double Draw::uniform(double lo, double hi) {
  const double unit = static_cast<double>(next() >> 11) * 0x1p-53;
  return lo + (hi - lo) * unit;
}

double Draw::log_uniform(double lo, double hi) {
  int octaves = 1;
  for (double x = lo; 2 * x < hi; x *= 2) ++octaves;
  for (;;) {
    const double octave = std::ldexp(lo, static_cast<int>(integer(0, octaves - 1)));
    const double x = octave * uniform(1, 2);  // C++ leaves the order of draws within a product open
    if (x <= hi) return x;
  }
}

Vec3 Draw::direction() {
  for (;;) {
    const Vec3 v{uniform(-1, 1), uniform(-1, 1),
                 uniform(-1, 1)};  // braces fix the order of the draws
    const double squared = dot(v, v);
    if (squared <= 1 && squared > 1e-4) return normalized(v);
  }
}

Vec3 Draw::direction_across(const Vec3& unit) {
  for (;;) {
    const Vec3 v = direction();
    const Vec3 across = v - dot(v, unit) * unit;
    if (dot(across, across) > 1e-2) return normalized(across);
  }
}

Eigen::Quaterniond Draw::orientation() {
  for (;;) {
    const double w = uniform(-1, 1), x = uniform(-1, 1), y = uniform(-1, 1), z = uniform(-1, 1);
    const double squared = ((w * w + x * x) + y * y) + z * z;
    if (squared > 1 || squared < 1e-4) continue;
    const double length = std::sqrt(squared);
    return Eigen::Quaterniond(w / length, x / length, y / length, z / length);
  }
}

Eigen::Quaterniond Draw::turn_about_z() {
  for (;;) {
    const double w = uniform(-1, 1), z = uniform(-1, 1);
    const double squared = w * w + z * z;
    if (squared > 1 || squared < 1e-4) continue;
    const double length = std::sqrt(squared);
    return Eigen::Quaterniond(w / length, 0, 0, z / length);
  }
}

double dot(const Vec3& a, const Vec3& b) { return (a.x() * b.x() + a.y() * b.y()) + a.z() * b.z(); }

Vec3 cross(const Vec3& a, const Vec3& b) {
  return Vec3(a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(),
              a.x() * b.y() - a.y() * b.x());
}

Vec3 normalized(const Vec3& v) {
  const double length = std::sqrt(dot(v, v));
  return Vec3(v.x() / length, v.y() / length, v.z() / length);
}

Eigen::Quaterniond normalized(const Eigen::Quaterniond& q) {
  const double length =
      std::sqrt(((q.w() * q.w() + q.x() * q.x()) + q.y() * q.y()) + q.z() * q.z());
  return Eigen::Quaterniond(q.w() / length, q.x() / length, q.y() / length, q.z() / length);
}

Eigen::Quaterniond product(const Eigen::Quaterniond& p, const Eigen::Quaterniond& q) {
  return Eigen::Quaterniond(((p.w() * q.w() - p.x() * q.x()) - p.y() * q.y()) - p.z() * q.z(),
                            ((p.w() * q.x() + p.x() * q.w()) + p.y() * q.z()) - p.z() * q.y(),
                            ((p.w() * q.y() - p.x() * q.z()) + p.y() * q.w()) + p.z() * q.x(),
                            ((p.w() * q.z() + p.x() * q.y()) - p.y() * q.x()) + p.z() * q.w());
}

Axes axes(const Eigen::Quaterniond& q) {
  const double w = q.w(), x = q.x(), y = q.y(), z = q.z();
  const double ww = w * w, xx = x * x, yy = y * y, zz = z * z;
  return {Vec3(((ww + xx) - yy) - zz, 2 * (x * y + w * z), 2 * (x * z - w * y)),
          Vec3(2 * (x * y - w * z), ((ww - xx) + yy) - zz, 2 * (y * z + w * x)),
          Vec3(2 * (x * z + w * y), 2 * (y * z - w * x), ((ww - xx) - yy) + zz)};
}

Vec3 rotated(const Eigen::Quaterniond& q, const Vec3& v) {
  const Axes a = axes(normalized(q));
  return (v.x() * a.x + v.y() * a.y) + v.z() * a.z;
}

}  // namespace touchstone
