#include "oracle/judge/point_distance.hpp"

#include <algorithm>
#include <cmath>

namespace touchstone {
namespace {

/// From how far the point is beyond each pair of parallel faces, negative inside.
double outside_of_all(double x, double y, double z) {
  const double outside = std::hypot(std::max(x, 0.0), std::max(y, 0.0), std::max(z, 0.0));
  return outside > 0 ? outside : std::max({x, y, z});
}

struct Distance {
  Vec3 p;  // in the body's frame

  double across() const { return std::hypot(p.x(), p.y()); }

  double operator()(const Cylinder& s) const {
    const double side = across() - s.radius(), cap = std::abs(p.z()) - s.half_length();
    return side > 0 || cap > 0 ? std::hypot(std::max(side, 0.0), std::max(cap, 0.0))
                               : std::max(side, cap);
  }
  double operator()(const Capsule& s) const {
    const double beyond = std::max(std::abs(p.z()) - s.half_length(), 0.0);
    return std::hypot(across(), beyond) - s.radius();
  }
  double operator()(const Sphere& s) const { return std::hypot(p.x(), p.y(), p.z()) - s.radius(); }
  double operator()(const Box& s) const {
    const Vec3 beyond = p.cwiseAbs() - s.half_extents();
    return outside_of_all(beyond.x(), beyond.y(), beyond.z());
  }
  double operator()(const Plane& s) const { return s.unit_normal().dot(p) - s.unit_displacement(); }
};

}  // namespace

double point_distance(const Shape& shape, const Pose& pose, const Vec3& point) {
  const Vec3 local = pose.rotation().transpose() * (point - pose.position());
  return std::visit(Distance{local}, shape);
}

double point_excess(const Configuration& c, const ts_point& point) {
  const Vec3 p(point.position[0], point.position[1], point.position[2]);
  return std::max(std::abs(point_distance(c.a, c.pose_a, p)),
                  std::abs(point_distance(c.b, c.pose_b, p))) -
         std::abs(point.depth);
}

}  // namespace touchstone
