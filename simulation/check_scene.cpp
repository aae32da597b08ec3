#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>
#include <utility>

#include "reference/invalid_input.hpp"
#include "simulation/assembly.hpp"
#include "simulation/scene.hpp"

namespace touchstone {
namespace {

/// Bounds for moving bodies, metres and kg/m³, within which masses and moments of inertia keep all
/// their digits.
constexpr double min_half_width = 1e-6;
/// Bound on the ratio of the smallest to the largest moment of inertia: that of a rod a million
/// times as long as wide.
constexpr double min_inertia_ratio = 1e-12;
/// Bounds on the mass of a body whose inertia is given, kg, and on its largest moment, kg m²: about
/// those of the smallest and the largest shapes.
constexpr double min_mass = 1e-24, max_mass = 1e24, min_moment = 1e-36, max_moment = 1e36;
/// Seconds.
constexpr double min_step = 1e-6, max_step = 1;
/// Bounds on a quaternion's entries, whose squares must not overflow or vanish.
constexpr double min_length = 1e-100, max_length = 1e100;
/// Bounds on forces and torques (N, N m), the frequency of an oscillation (Hz), and times (s).
constexpr double max_force = 1e12, max_frequency = 1e6, max_time = 1e9;

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
  if (const double rounding = rounding_of(body.shape); rounding > 0) {
    throw InvalidInput(field + ".rounding", fmt::format("{}", rounding),
                       "must be left out: bodies of scenes have sharp edges");
  }
  if (const auto* hull = std::get_if<Convex>(&body.shape)) {
    const double off = hull->middle().cwiseAbs().maxCoeff();
    if (!(off <= max_in_world)) {
      throw InvalidInput(field + ".vertices", fmt::format("{} m from the body's origin", off),
                         fmt::format("must be at most {} m from it", max_in_world));
    }
  }
  const double smallest = smallest_half_extent(body.shape);
  const double largest = largest_half_extent(body.shape);
  if (!(smallest >= min_half_width && largest <= max_in_world)) {
    throw InvalidInput(field, fmt::format("{} to {} m in half width", smallest, largest),
                       fmt::format("must be from {} to {} m", min_half_width, max_in_world));
  }
  if (!body.is_free() || body.inertia) return;
  const Vec3 moments = inertia(body.shape, body.density).inertia.principal;
  if (!(moments.minCoeff() >= min_inertia_ratio * moments.maxCoeff())) {
    throw InvalidInput(field, fmt::format("{} to {} m in half width", smallest, largest),
                       "must be thicker for its length to be turned");
  }
}

void check_pose(const std::string& field, const Pose& pose) {
  check_vector(field + ".position", pose.position());
  check_between(field + ".orientation", pose.orientation().coeffs().cwiseAbs().maxCoeff(),
                min_length, max_length);
}

void check_inertia(const std::string& field, const PosedInertia& given) {
  const auto& [mass, principal] = given.inertia;
  check_pose(field + ".pose", given.X_BC);
  if (mass == 0 && principal.isZero(0)) return;  // see check_assembly
  check_between(field + ".mass", mass, min_mass, max_mass);
  if (const char* fault = impossible(principal)) {
    throw InvalidInput(
        field + ".moments",
        fmt::format("[{}, {}, {}]", principal.x(), principal.y(), principal.z()),
        std::string("must be principal moments that a body can have: they are not if one is ") +
            fault);
  }
  check_between(field + ".moments", principal.maxCoeff(), min_moment, max_moment);
}

struct CheckDrive {
  const std::string& field;
  const Pose& start;

  void operator()(const SteadyMotion& m) const {
    check_vector(field + ".velocity", m.velocity);
    check_vector(field + ".angular_velocity", m.angular_velocity);
  }
  void operator()(const Oscillation& o) const {
    check_vector(field + ".amplitude", o.amplitude);
    check_vector(field + ".turn", o.turn);
    check_between(field + ".frequency", o.frequency, 0, max_frequency);
  }
  void operator()(const Waypoints& waypoints) const {
    double before = 0;
    Eigen::Quaterniond turn = start.unit_orientation();
    for (std::size_t i = 0; i < waypoints.size(); ++i) {
      const std::string at = fmt::format("{}.waypoints[{}]", field, i);
      const double time = waypoints[i].time;
      check_between(at + ".time", time, 0, max_time);
      if (!(time > before)) {
        throw InvalidInput(at + ".time", fmt::format("{}", time),
                           fmt::format("must be later than {}", before));
      }
      before = time;
      check_pose(at + ".pose", waypoints[i].pose);
      const Eigen::Quaterniond next = waypoints[i].pose.unit_orientation();
      constexpr double rounding = 1e-6;
      if (std::abs(turn.dot(next)) < rounding) {
        throw InvalidInput(at + ".pose.orientation", "half a turn from the one before",
                           "must be another one: there are two ways there; put a waypoint between");
      }
      turn = next;
    }
  }
};

/// Velocities of a body that forces do not move would have no effect.
void check_at_rest(const std::string& field, const Body& body) {
  if (body.is_free()) return;
  const char* remedy = body.fixed
                           ? "must be zero, for the body is fixed; a body that moves whatever "
                             "meets it is driven"
                           : "must be zero, for the body is driven";
  if (!body.velocity.isZero(0)) throw InvalidInput(field + ".velocity", "not zero", remedy);
  if (!body.angular_velocity.isZero(0)) {
    throw InvalidInput(field + ".angular_velocity", "not zero", remedy);
  }
}

void check_body(const std::string& field, const Body& body) {
  const Material& m = body.material;
  if (body.is_free()) check_between(field + ".density", body.density, min_density, max_density);
  if (body.inertia) check_inertia(field + ".inertia", *body.inertia);
  check_between(field + ".friction", m.friction, 0, max_friction);
  check_between(field + ".restitution", m.restitution, 0, 1);
  check_pose(field + ".pose", body.pose);
  check_vector(field + ".velocity", body.velocity);
  check_vector(field + ".angular_velocity", body.angular_velocity);
  check_vector(field + ".surface_velocity", body.surface_velocity);
  check_at_rest(field, body);
  if (body.drive) {
    if (body.fixed) throw InvalidInput(field + ".fixed", "true", "must be false, for it is driven");
    std::visit(CheckDrive{field + ".drive", body.pose}, *body.drive);
  }
  check_shape(field + ".shape", body);
  if (!body.fixed && inertia(body.shape, 1).inertia.mass == 0) {
    const char* const flat = std::holds_alternative<Convex>(body.shape) ? "flat " : "";
    throw InvalidInput(
        field + ".fixed", "false",
        fmt::format("a {}{} has no mass and must be fixed", flat, shape_name(body.shape)));
  }
}

void check_index(const std::string& field, int index, int from, const Scene& scene) {
  if (index >= from && index < static_cast<int>(scene.bodies.size())) return;
  throw InvalidInput(field, fmt::format("{}", index), "must be the index of a body");
}

void check_motor(const std::string& field, const Motor& motor) {
  check_between(field + ".max_force", motor.max_force, 0, max_force);
  if (motor.course.empty()) throw InvalidInput(field, "without a target", "must have one");
  double before = -infinity;
  for (const auto& [time, target] : motor.course) {
    check_between(field + ": time", time, 0, max_time);
    check_between(field + ": target", target, -max_in_world, max_in_world);
    if (!(time > before)) {
      throw InvalidInput(field + ": time", fmt::format("{}", time),
                         fmt::format("must be later than {}", before));
    }
    before = time;
  }
}

void check_joint(const std::string& field, const Joint& joint, const Scene& scene) {
  check_index(field + ".a", joint.a, 0, scene);
  check_index(field + ".b", joint.b, world_body, scene);
  if (joint.a == joint.b) throw InvalidInput(field, "one body", "must join two");
  if (joint.kind == JointKind::fixed) {
    if (joint.motor) throw InvalidInput(field + ".motor", "given", "must not be: it is fixed");
    return;
  }
  check_vector(field + ".anchor", joint.anchor);
  constexpr double rounding = 1e-6;
  if (!(std::abs(joint.axis.norm() - 1) < rounding)) {
    throw InvalidInput(field + ".axis", fmt::format("{} long", joint.axis.norm()),
                       "must have unit length");
  }
  for (const auto& [name, limit] :
       {std::pair{".lower", joint.lower}, std::pair{".upper", joint.upper}}) {
    if (!std::isinf(limit)) check_between(field + name, limit, -max_in_world, max_in_world);
  }
  if (!(joint.lower <= 0 && joint.upper >= 0)) {
    throw InvalidInput(field + ".limits", fmt::format("[{}, {}]", joint.lower, joint.upper),
                       "must hold 0, where the joint is at the start");
  }
  if (joint.motor) check_motor(field + ".motor", *joint.motor);
}

/// Velocities of what fixed joints make one with what is fixed or driven would have no effect.
void check_at_rest(const std::string& field, const Body& body, const Assembly& assembly,
                   const Scene& scene) {
  const auto refuse = [&](const char* velocity) {
    throw InvalidInput(field + velocity, "not zero",
                       fmt::format("must be zero, for fixed joints make {} one with {}", body.name,
                                   assembly.driven < 0
                                       ? "what is fixed"
                                       : scene.bodies[assembly.driven].name + ", which is driven"));
  };
  if (!body.velocity.isZero(0)) refuse(".velocity");
  if (!body.angular_velocity.isZero(0)) refuse(".angular_velocity");
}

/// What is joined rigidly must move as one at the start, and by one drive at most.
void check_assembly(const Assembly& assembly, const Scene& scene) {
  const Body& first = scene.bodies[assembly.bodies.front()];
  if (assembly.is_free() && assembly.inertia.mass == 0) {
    throw InvalidInput(fmt::format("bodies[{}].inertia.mass", assembly.bodies.front()), "0",
                       "must be positive, unless a fixed joint makes " + first.name +
                           " one with a body that has mass");
  }
  int driven = -1;
  for (const int b : assembly.bodies) {
    const Body& body = scene.bodies[b];
    const std::string field = fmt::format("bodies[{}]", b);
    if (body.drive && (assembly.fixed || driven >= 0)) {
      throw InvalidInput(field + ".drive", "given",
                         fmt::format("must not be: fixed joints make {} one with {}", body.name,
                                     driven >= 0 ? scene.bodies[driven].name : "what is fixed"));
    }
    if (body.drive) driven = b;
    if (!assembly.is_free()) {
      check_at_rest(field, body, assembly, scene);
      continue;
    }
    const Vec3 arm = body.pose.position() - first.pose.position();
    const Vec3 difference = body.velocity - first.velocity - first.angular_velocity.cross(arm);
    const double rounding = 1e-6 * (1 + first.velocity.norm());
    if (difference.norm() > rounding ||
        (body.angular_velocity - first.angular_velocity).norm() > rounding) {
      throw InvalidInput(
          field + ".velocity", fmt::format("{} m/s off", difference.norm()),
          "must be that of " + first.name + ", which a fixed joint makes one with " + body.name);
    }
  }
}

void check_push(const std::string& field, const Push& push, const Scene& scene,
                const std::vector<bool>& is_moved) {
  check_index(field + ".body", push.body, 0, scene);
  for (int k = 0; k < 3; ++k) {
    check_between(fmt::format("{}.force[{}]", field, k), push.force[k], -max_force, max_force);
    check_between(fmt::format("{}.torque[{}]", field, k), push.torque[k], -max_force, max_force);
  }
  check_between(field + ".from", push.from, 0, max_time);
  if (!(push.until > push.from)) {
    throw InvalidInput(field + ".until", fmt::format("{}", push.until),
                       fmt::format("must be later than {}", push.from));
  }
  if (!is_moved[push.body]) {
    throw InvalidInput(
        field + ".body", '"' + scene.bodies[push.body].name + '"',
        "must be moved by forces: it is fixed or driven, or fixed joints make it one "
        "with what is");
  }
}

/// A hinge or slider must move something: no engine has a joint of a body with itself.
void check_moves(const std::string& field, const Joint& joint, const Scene& scene,
                 const std::vector<Assembly>& assemblies) {
  if (joint.kind == JointKind::fixed) return;
  const auto assembly_of = [&](int body) {
    const auto holds = [&](const Assembly& a) { return std::ranges::count(a.bodies, body) > 0; };
    return body == world_body ? nullptr : &*std::ranges::find_if(assemblies, holds);
  };
  const Assembly *a = assembly_of(joint.a), *b = assembly_of(joint.b);
  const bool is_moved = a->is_free() || (b && b->is_free());
  if (a != b && is_moved) return;
  throw InvalidInput(
      field,
      fmt::format("a {} of {} and {}", joint_kind_name(joint.kind), scene.bodies[joint.a].name,
                  b ? scene.bodies[joint.b].name : "the world"),
      is_moved ? "must join what can move apart: fixed joints make these bodies one; leave this "
                 "joint or one of those out"
               : "must join something that forces move: these are fixed or driven; leave it out");
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
  for (std::size_t i = 0; i < scene.joints.size(); ++i) {
    check_joint(fmt::format("joints[{}]", i), scene.joints[i], scene);
  }
  for (const auto& [a, b] : scene.apart) {
    check_index("apart", a, 0, scene);
    check_index("apart", b, 0, scene);
  }
  const std::vector<Assembly> all = assemblies(scene);
  for (const Assembly& assembly : all) check_assembly(assembly, scene);
  for (std::size_t i = 0; i < scene.joints.size(); ++i) {
    check_moves(fmt::format("joints[{}]", i), scene.joints[i], scene, all);
  }
  const std::vector<bool> is_moved = moved_by_forces(scene);
  for (std::size_t i = 0; i < scene.pushes.size(); ++i) {
    check_push(fmt::format("pushes[{}]", i), scene.pushes[i], scene, is_moved);
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
