#include "simulation/scene.hpp"

#include <cmath>
#include <fmt/format.h>
#include <set>

#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

[[noreturn]] void refuse(const std::string& field, double value, const char* remedy) {
  throw InvalidInput(field, fmt::format("{}", value), remedy);
}

void check_finite(const std::string& field, const Vec3& v) {
  for (int i = 0; i < 3; ++i) {
    if (!std::isfinite(v[i])) refuse(fmt::format("{}[{}]", field, i), v[i], "must be finite");
  }
}

void check_body(const std::string& field, const Body& body) {
  const Material& m = body.material;
  if (!body.fixed && !(std::isfinite(body.density) && body.density > 0)) {
    refuse(field + ".density", body.density, "must be positive and finite");
  }
  if (!(std::isfinite(m.friction) && m.friction >= 0)) {
    refuse(field + ".friction", m.friction, "must be finite and not negative");
  }
  if (!(m.restitution >= 0 && m.restitution <= 1)) {
    refuse(field + ".restitution", m.restitution, "must lie between 0 and 1");
  }
  check_finite(field + ".velocity", body.velocity);
  check_finite(field + ".angular_velocity", body.angular_velocity);
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
  check_finite("gravity", scene.gravity);
  if (!(std::isfinite(scene.step) && scene.step > 0)) {
    refuse("step", scene.step, "must be positive and finite");
  }
  if (!(std::isfinite(scene.duration) && scene.duration >= 0)) {
    refuse("duration", scene.duration, "must be finite and not negative");
  }
  if (!(std::isfinite(scene.surface_layer) && scene.surface_layer >= 0)) {
    refuse("surface_layer", scene.surface_layer, "must be finite and not negative");
  }
  if (scene.solver_iterations < 1) {
    throw InvalidInput("solver_iterations", fmt::format("{}", scene.solver_iterations),
                       "must be at least 1");
  }
}

}  // namespace touchstone
