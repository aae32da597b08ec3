#include "simulation/scene.hpp"

#include <fmt/format.h>
#include <numbers>
#include <set>

#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

/// Bounds for moving bodies, metres and kg/m³, within which masses and moments of inertia keep all
/// their digits.
constexpr double min_half_width = 1e-6, min_density = 1e-6, max_density = 1e9;
/// Bound on the ratio of the smallest to the largest moment of inertia: that of a rod a million
/// times as long as wide.
constexpr double min_inertia_ratio = 1e-12;
constexpr double max_friction = 1e6;
/// Seconds.
constexpr double min_step = 1e-6, max_step = 1;
/// Bounds on a quaternion's entries, whose squares must not overflow or vanish.
constexpr double min_length = 1e-100, max_length = 1e100;

void check_between(const std::string& field, double value, double min, double max) {
  if (value >= min && value <= max) return;  // false for NaN
  throw InvalidInput(field, fmt::format("{}", value),
                     fmt::format("must lie between {} and {}", min, max));
}

void check_vector(const std::string& field, const Vec3& v) {
  for (int i = 0; i < 3; ++i) {
    check_between(fmt::format("{}[{}]", field, i), v[i], -max_in_world, max_in_world);
  }
}

void check_shape(const std::string& field, const Body& body) {
  if (const auto* plane = std::get_if<Plane>(&body.shape)) {
    check_between(field + ".displacement", plane->unit_displacement(), -max_in_world, max_in_world);
    return;
  }
  const double smallest = smallest_half_extent(body.shape);
  const double largest = largest_half_extent(body.shape);
  if (!(smallest >= min_half_width && largest <= max_in_world)) {
    throw InvalidInput(field, fmt::format("{} to {} m in half width", smallest, largest),
                       fmt::format("must be from {} to {} m", min_half_width, max_in_world));
  }
  if (body.fixed) return;
  const Vec3 moments = inertia(body.shape, body.density).principal;
  if (!(moments.minCoeff() >= min_inertia_ratio * moments.maxCoeff())) {
    throw InvalidInput(field, fmt::format("{} to {} m in half width", smallest, largest),
                       "must be thicker for its length to be turned");
  }
}

void check_body(const std::string& field, const Body& body) {
  const Material& m = body.material;
  if (!body.fixed) check_between(field + ".density", body.density, min_density, max_density);
  check_between(field + ".friction", m.friction, 0, max_friction);
  check_between(field + ".restitution", m.restitution, 0, 1);
  check_vector(field + ".pose.position", body.pose.position());
  check_between(field + ".pose.orientation", body.pose.orientation().coeffs().cwiseAbs().maxCoeff(),
                min_length, max_length);
  check_vector(field + ".velocity", body.velocity);
  check_vector(field + ".angular_velocity", body.angular_velocity);
  check_shape(field + ".shape", body);
  if (!body.fixed && inertia(body.shape, body.density).mass == 0) {
    throw InvalidInput(field + ".fixed", "false",
                       fmt::format("a {} has no mass and must be fixed", shape_name(body.shape)));
  }
}

using std::numbers::pi;

struct InertiaOf {
  double density;

  /// For any other shape.
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
    const Vec3 h = s.half_extents(), squared = h.cwiseProduct(h);
    const double mass = density * 8 * h.prod();
    return {mass, mass / 3 * (Vec3::Constant(squared.sum()) - squared)};
  }
};

}  // namespace

void check_scene(const Scene& scene) {
  if (scene.bodies.empty()) throw InvalidInput("bodies", "empty", "must hold at least one body");
  std::set<std::string> names;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const std::string field = fmt::format("bodies[{}]", i);
    check_body(field, scene.bodies[i]);
    if (!names.insert(scene.bodies[i].name).second) {
      throw InvalidInput(field + ".name", '"' + scene.bodies[i].name + '"',
                         "must be another one: two bodies have this name");
    }
  }
  check_vector("gravity", scene.gravity);
  check_between("step", scene.step, min_step, max_step);
  check_between("duration", scene.duration, 0, max_in_world);
  check_between("surface_layer", scene.surface_layer, 0, max_in_world);
  if (scene.solver_iterations < 1) {
    throw InvalidInput("solver_iterations", fmt::format("{}", scene.solver_iterations),
                       "must be at least 1");
  }
}

Inertia inertia(const Shape& shape, double density) {
  return std::visit(InertiaOf{density}, shape);
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
