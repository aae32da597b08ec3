#include "simulation/scenes/mechanism_json.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <rapidcheck.h>
#include <tuple>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "properties/draw.hpp"
#include "properties/files/configuration_json.hpp"
#include "properties/files/strict_json.hpp"
#include "reference/support.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

constexpr double degree = std::numbers::pi / 180;

Vec3 vector_or_zero(const json& object, const char* name, const std::string& path) {
  return object.contains(name) ? vector(object[name], path + '.' + name) : Vec3(Vec3::Zero());
}

Oscillation oscillation(const json& value, const std::string& path) {
  require_object(value, path);
  refuse_others(value, {"amplitude", "turn", "frequency"}, path);
  return {vector_or_zero(value, "amplitude", path), degree * vector_or_zero(value, "turn", path),
          number(member(value, "frequency", path), path + ".frequency")};
}

Waypoints waypoints(const json& value, const std::string& path) {
  Waypoints result;
  for (std::size_t i = 0; i < array(value, path).size(); ++i) {
    const std::string at = fmt::format("{}[{}]", path, i);
    require_object(value[i], at);
    refuse_others(value[i], {"time", "pose"}, at);
    result.push_back({number(member(value[i], "time", at), at + ".time"),
                      pose_from_json(member(value[i], "pose", at), at + ".pose")});
  }
  if (result.empty()) throw InvalidInput(path, "empty", "must hold at least one waypoint");
  return result;
}

/// One number for all times, or pairs of a time and a number.
std::vector<std::pair<double, double>> course(const json& value, const std::string& path,
                                              double unit) {
  if (!value.is_array()) return {{0, unit * number(value, path)}};
  std::vector<std::pair<double, double>> result;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const auto [time, target] = numbers<2>(value[i], fmt::format("{}[{}]", path, i));
    result.emplace_back(time, unit * target);
  }
  return result;
}

/// `unit` is that of positions in radians or metres.
Motor motor(const json& value, const std::string& path, double unit) {
  require_object(value, path);
  refuse_others(value, {"rate", "position", "max_force"}, path);
  if (value.contains("rate") == value.contains("position")) {
    throw InvalidInput(path, shown(value), "must have either a rate or a position");
  }
  Motor result;
  if (value.contains("rate")) {
    result.course = course(value["rate"], path + ".rate", 1);
  } else {
    result.target = Motor::Target::position;
    result.course = course(value["position"], path + ".position", unit);
  }
  result.max_force = number(member(value, "max_force", path), path + ".max_force");
  return result;
}

JointKind joint_kind(const json& value, const std::string& path) {
  for (const JointKind kind : {JointKind::fixed, JointKind::hinge, JointKind::slider}) {
    if (value == joint_kind_name(kind)) return kind;
  }
  throw InvalidInput(path, shown(value), "must be \"fixed\", \"hinge\" or \"slider\"");
}

/// Names one body, which the world holds, or two.
std::pair<int, int> joined(const json& value, const std::string& path, const Scene& scene) {
  const std::size_t count = array(value, path).size();
  if (count != 1 && count != 2) {
    throw InvalidInput(path, shown(value),
                       "must be the names of two bodies, or of one that is joined to the world");
  }
  return {body_index(value[0], path + "[0]", scene),
          count == 1 ? world_body : body_index(value[1], path + "[1]", scene)};
}

}  // namespace

Drive drive_from_json(const json& value, const std::string& path) {
  require_object(value, path);
  refuse_others(value, {"velocity", "angular_velocity", "oscillation", "waypoints"}, path);
  const bool is_steady = value.contains("velocity") || value.contains("angular_velocity");
  if (is_steady + value.contains("oscillation") + value.contains("waypoints") != 1) {
    throw InvalidInput(
        path, shown(value),
        "must have one of: waypoints, oscillation, or velocity and angular_velocity");
  }
  if (value.contains("oscillation"))
    return oscillation(value["oscillation"], path + ".oscillation");
  if (value.contains("waypoints")) return waypoints(value["waypoints"], path + ".waypoints");
  return SteadyMotion{vector_or_zero(value, "velocity", path),
                      vector_or_zero(value, "angular_velocity", path)};
}

int body_index(const json& name, const std::string& path, const Scene& scene) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (name == scene.bodies[i].name) return static_cast<int>(i);
  }
  throw InvalidInput(path, shown(name), "must be the name of one of the bodies");
}

Joint joint_from_json(const json& value, const std::string& path, const Scene& scene) {
  require_object(value, path);
  refuse_others(value, {"joint", "name", "bodies", "anchor", "axis", "limits", "motor"}, path);
  Joint result;
  result.kind = joint_kind(member(value, "joint", path), path + ".joint");
  if (value.contains("name")) result.name = string(value["name"], path + ".name");
  std::tie(result.a, result.b) = joined(member(value, "bodies", path), path + ".bodies", scene);
  if (result.kind == JointKind::fixed) {
    refuse_others(value, {"joint", "name", "bodies"}, path);
    return result;
  }
  const bool turns = result.kind == JointKind::hinge;
  const double unit = turns ? degree : 1;
  if (turns) {
    result.anchor = vector(member(value, "anchor", path), path + ".anchor");
  } else if (value.contains("anchor")) {
    throw InvalidInput(path + ".anchor", shown(value["anchor"]), "must not be: a slider has none");
  }
  const Vec3 axis = vector(member(value, "axis", path), path + ".axis");
  const double length = axis.stableNorm();
  if (!(length > 0 && std::isfinite(length))) {
    throw InvalidInput(path + ".axis", shown(value["axis"]), "must have a direction");
  }
  result.axis = axis / length;
  if (value.contains("limits")) {
    const auto [lower, upper] = numbers<2>(value["limits"], path + ".limits");
    result.lower = unit * lower;
    result.upper = unit * upper;
  }
  if (value.contains("motor")) result.motor = motor(value["motor"], path + ".motor", unit);
  return result;
}

Push push_from_json(const json& value, const std::string& path, const Scene& scene) {
  require_object(value, path);
  refuse_others(value, {"body", "force", "torque", "from", "until"}, path);
  Push result;
  result.body = body_index(member(value, "body", path), path + ".body", scene);
  result.force = vector_or_zero(value, "force", path);
  result.torque = vector_or_zero(value, "torque", path);
  if (value.contains("from")) result.from = number(value["from"], path + ".from");
  if (value.contains("until")) result.until = number(value["until"], path + ".until");
  return result;
}

namespace {

/// Does the body lie on the outer side of a plane?
bool is_above(const Body& body, const Body& plane) {
  const Plane& shape = std::get<Plane>(plane.shape);
  const Vec3 normal = plane.pose.rotation() * shape.unit_normal();
  const double height = shape.unit_displacement() + normal.dot(plane.pose.position());
  return -support(body.shape, body.pose, -normal) >= height;
}

}  // namespace

void add_drop(const json& value, const std::string& path, Body like, Scene& scene) {
  constexpr int max_tries = 1000;  // for each body
  const std::uint64_t count =
      whole_number(member(value, "count", path), path + ".count", max_bodies);
  if (scene.bodies.size() + count > max_bodies) {
    throw InvalidInput(
        path + ".count", fmt::format("{}", count),
        fmt::format("must be less: a scene has at most {} bodies, of which {} are there",
                    max_bodies, scene.bodies.size()));
  }
  const std::uint64_t seed =
      value.contains("seed") ? whole_number(value["seed"], path + ".seed") : 1;
  const Vec3 lower = vector(member(value, "lower", path), path + ".lower");
  const Vec3 upper = vector(member(value, "upper", path), path + ".upper");
  if (!((upper - lower).minCoeff() > 0 && (upper - lower).allFinite())) {
    throw InvalidInput(path + ".upper", shown(value["upper"]), "must be above lower in each part");
  }
  std::vector<Aabb> taken;
  std::vector<Body> planes;
  for (const Body& body : scene.bodies) {
    if (std::holds_alternative<Plane>(body.shape)) {
      planes.push_back(body);
    } else {
      taken.push_back(aabb(body.shape, body.pose));
    }
  }
  const std::string name = like.name;
  Draw draw(rc::Random(rc::Random::Key{seed, 0, 0, 0}));
  for (std::uint64_t i = 0; i < count; ++i) {
    int tries = 0;
    for (;; ++tries) {
      if (tries == max_tries) {
        throw InvalidInput(path + ".count", fmt::format("{}", count),
                           fmt::format("the box has room for {}: make it larger", i));
      }
      const Eigen::Quaterniond turn = draw.orientation();
      Vec3 position;
      for (int k = 0; k < 3; ++k) position[k] = draw.uniform(lower[k], upper[k]);
      like.pose = Pose(position, turn);
      const Aabb box = aabb(like.shape, like.pose);
      const bool is_inside =
          (box.lower - lower).minCoeff() >= 0 && (upper - box.upper).minCoeff() >= 0 &&
          std::ranges::all_of(planes, [&](const Body& plane) { return is_above(like, plane); });
      if (is_inside && std::none_of(taken.begin(), taken.end(),
                                    [&](const Aabb& other) { return other.overlaps(box); })) {
        taken.push_back(box);
        break;
      }
    }
    like.name = fmt::format("{}-{}", name, i + 1);
    scene.bodies.push_back(like);
  }
}

}  // namespace touchstone
