#include "simulation/scene.hpp"

#include <numbers>

#include <Eigen/Eigenvalues>

namespace touchstone {
namespace {

using std::numbers::pi;

struct InertiaOf {
  double density;

  /// For a plane, which has none; of a hull see inertia_of_hull.
  template <class Massless>
  Inertia operator()(const Massless&) const {
    return {0, Vec3::Zero()};
  }
  Inertia operator()(const Sphere& s) const {
    const double r2 = s.radius() * s.radius(), mass = density * 4 / 3 * pi * r2 * s.radius();
    return {mass, Vec3::Constant(0.4 * mass * r2)};
  }
  Inertia operator()(const Cylinder& s) const {
    const double r2 = s.radius() * s.radius(), h = s.half_length();
    const double mass = density * 2 * pi * r2 * h, across = mass * (r2 / 4 + h * h / 3);
    return {mass, Vec3(across, across, mass * r2 / 2)};
  }
  /// A cylinder and two half balls, whose centres of mass lie 3/8 of the radius beyond its ends.
  /// The parallel axis theorem adds m ((h + 3/8 r)² − (3/8 r)²) = m (h² + 3/4 h r).
  Inertia operator()(const Capsule& s) const {
    const double r = s.radius(), h = s.half_length();
    const Inertia side = (*this)(Cylinder(r, h)), ball = (*this)(Sphere(r));
    const double across =
        side.principal.x() + ball.principal.x() + ball.mass * (h * h + 0.75 * r * h);
    return {side.mass + ball.mass, Vec3(across, across, side.principal.z() + ball.principal.z())};
  }
  Inertia operator()(const Box& s) const {
    const Vec3& h = s.half_extents();
    const Vec3 squared = h.cwiseProduct(h);
    const double mass = density * 8 * h.prod();
    return {mass, mass / 3 * (Vec3::Constant(squared.sum()) - squared)};
  }
};

/// Sum of the tetrahedra between the hull's middle and the triangles of its faces. One with the
/// edges a, b, c has a sixth of their determinant V as its volume, its centre at s/4 and the second
/// moments V/20 (s sᵀ + a aᵀ + b bᵀ + c cᵀ), with s = a + b + c.
PosedInertia inertia_of_hull(const Convex& hull, double density) {
  double volume = 0;
  Vec3 first = Vec3::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  const auto edge = [&](int vertex) { return Vec3(hull.vertices()[vertex] - hull.middle()); };
  for (const Convex::Face& face : hull.faces()) {
    const Vec3 a = edge(face.vertices[0]);
    for (std::size_t i = 2; i < face.vertices.size(); ++i) {
      const Vec3 b = edge(face.vertices[i - 1]), c = edge(face.vertices[i]), sum = a + b + c;
      const double part = a.dot(b.cross(c)) / 6;
      volume += part;
      first += part / 4 * sum;
      second += part / 20 *
                (sum * sum.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
    }
  }
  if (hull.is_flat() || !(volume > 0)) return {{0, Vec3::Zero()}};
  const Vec3 centre = first / volume;
  const Eigen::Matrix3d spread = second - volume * centre * centre.transpose();
  return along_principal_axes(density * volume, hull.middle() + centre,
                              density * (spread.trace() * Eigen::Matrix3d::Identity() - spread));
}

}  // namespace

PosedInertia inertia(const Shape& shape, double density) {
  if (const auto* hull = std::get_if<Convex>(&shape)) return inertia_of_hull(*hull, density);
  return {std::visit(InertiaOf{density}, shape)};
}

PosedInertia along_principal_axes(double mass, const Vec3& centre, const Eigen::Matrix3d& moments) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(moments);
  Eigen::Matrix3d axes = principal.eigenvectors();
  if (axes.determinant() < 0) axes.col(0) *= -1;
  return {{mass, principal.eigenvalues()}, Pose(centre, Eigen::Quaterniond(axes))};
}

PosedInertia inertia(const Body& body) {
  return body.inertia ? *body.inertia : inertia(body.shape, body.density);
}

const char* impossible(const Vec3& principal) {
  constexpr double rounding = 0.01, min_ratio = 1e-12;  // as check_scene asks of shapes
  const double largest = principal.maxCoeff(), others = principal.sum() - largest;
  if (!principal.allFinite()) return "not finite";
  if (!(principal.minCoeff() > 0)) return "not positive";
  if (principal.minCoeff() < min_ratio * largest) return "next to nothing beside another";
  return largest > (1 + rounding) * others ? "larger than the sum of the others" : nullptr;
}

double kinetic_energy(const BodyState& state, const Inertia& inertia) {
  return (inertia.mass * state.velocity.squaredNorm() +
          state.angular_velocity.dot(spin(state.pose, inertia, state.angular_velocity))) /
         2;
}

Vec3 angular_velocity(const Pose& pose, const Inertia& inertia, const Vec3& spin) {
  const Eigen::Matrix3d& r = pose.rotation();
  return r * (r.transpose() * spin).cwiseQuotient(inertia.principal);
}

Vec3 free_angular_velocity(const Pose& pose, const Inertia& inertia, const Vec3& spin,
                           double step) {
  constexpr int iterations = 6;  // each contracts the error by about half the angle of the step
  Vec3 mean = angular_velocity(pose, inertia, spin);
  for (int i = 0; i < iterations; ++i) {
    const double angle = step / 2 * mean.norm();
    if (angle == 0) break;
    const Eigen::Matrix3d half_way = Eigen::AngleAxisd(angle, mean.normalized()) * pose.rotation();
    mean = half_way * (half_way.transpose() * spin).cwiseQuotient(inertia.principal);
  }
  return mean;
}

Vec3 spin(const Pose& pose, const Inertia& inertia, const Vec3& angular_velocity) {
  const Eigen::Matrix3d& r = pose.rotation();
  return r * inertia.principal.cwiseProduct(r.transpose() * angular_velocity);
}

}  // namespace touchstone
