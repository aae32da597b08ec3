#include "simulation/scene.hpp"

#include <fmt/format.h>
#include <set>

#include "reference/invalid_input.hpp"
#include "simulation/motion.hpp"

namespace touchstone {
namespace {

/// Those of what moves, metres and kg/m³: masses and moments of inertia keep all their digits.
constexpr double min_half_width = 1e-6, min_density = 1e-6, max_density = 1e9;
/// Of the smallest to the largest moment of inertia: a rod a million times as long as wide.
constexpr double min_inertia_ratio = 1e-12;
constexpr double max_friction = 1e6;
/// Seconds.
constexpr double min_step = 1e-6, max_step = 1;
/// Of quaternions, whose squares must not overflow or vanish.
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
  const double least = smallest_half_extent(body.shape), most = largest_half_extent(body.shape);
  if (!(least >= min_half_width && most <= max_in_world)) {
    throw InvalidInput(field, fmt::format("{} to {} m in half width", least, most),
                       fmt::format("must be from {} to {} m", min_half_width, max_in_world));
  }
  if (body.fixed) return;
  const Vec3 moments = inertia(body.shape, body.density).principal;
  if (!(moments.minCoeff() >= min_inertia_ratio * moments.maxCoeff())) {
    throw InvalidInput(field, fmt::format("{} to {} m in half width", least, most),
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
  if (std::holds_alternative<Plane>(body.shape) && !body.fixed) {
    throw InvalidInput(field + ".fixed", "false", "a plane has no mass and must be fixed");
  }
}

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

}  // namespace touchstone
