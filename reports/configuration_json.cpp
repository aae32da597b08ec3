#include "reports/configuration_json.hpp"

#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <functional>
#include <gmpxx.h>
#include <initializer_list>
#include <string>
#include <utility>

#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

/// The value as the person wrote it, cut where it is long.
std::string shown(const json& value) {
  std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
  if (text.size() > 60) text = text.substr(0, 57) + "...";
  return text;
}

double number(const json& value, const std::string& field) {
  if (value.is_number()) return value.get<double>();
  if (value.is_string()) {
    const std::string text = value.get<std::string>();
    char* end = nullptr;
    const double parsed = std::strtod(text.c_str(), &end);
    const bool blank = text.empty() || std::isspace(static_cast<unsigned char>(text[0]));
    if (!blank && *end == '\0') return parsed;
  }
  throw InvalidInput(field, shown(value),
                     "must be a number, or a string with a decimal or hexadecimal float such as "
                     "\"0x1.8p-1\"");
}

const json& member(const json& object, const char* name, const std::string& path) {
  if (!object.contains(name)) {
    throw InvalidInput(path.empty() ? name : path + "." + name, "missing", "must be given");
  }
  return object[name];
}

void require_object(const json& value, const std::string& field) {
  if (!value.is_object()) throw InvalidInput(field, shown(value), "must be an object");
}

void refuse_others(const json& object, std::initializer_list<const char*> known,
                   const std::string& path) {
  for (const auto& [name, value] : object.items()) {
    bool found = false;
    std::string names;
    for (const char* k : known) {
      found = found || name == k;
      names += (names.empty() ? "" : ", ") + std::string(k);
    }
    if (!found) {
      throw InvalidInput(path.empty() ? name : path + "." + name, shown(value),
                         "is not known here; known are " + names);
    }
  }
}

template <std::size_t N>
std::array<double, N> numbers(const json& value, const std::string& field) {
  if (!value.is_array() || value.size() != N) {
    throw InvalidInput(field, shown(value), fmt::format("must be an array of {} numbers", N));
  }
  std::array<double, N> result;
  for (std::size_t i = 0; i < N; ++i) {
    result[i] = number(value[i], fmt::format("{}[{}]", field, i));
  }
  return result;
}

Vec3 vector(const json& value, const std::string& field) {
  const auto v = numbers<3>(value, field);
  return Vec3(v[0], v[1], v[2]);
}

/// The constructors name the field within the shape; the path in front of it is added here.
template <class Make>
auto at_path(const std::string& path, Make make) {
  try {
    return make();
  } catch (const InvalidInput& e) {
    throw e.within(path);
  }
}

Shape shape_from_json(const json& value, const std::string& path) {
  require_object(value, path);
  const json& kind = member(value, "shape", path);
  const auto size = [&](const char* name) {
    return number(member(value, name, path), path + "." + name);
  };
  if (kind == "cylinder" || kind == "capsule") {
    refuse_others(value, {"shape", "radius", "half_length"}, path);
    const double radius = size("radius"), half_length = size("half_length");
    return at_path(path, [&]() -> Shape {
      if (kind == "cylinder") return Cylinder(radius, half_length);
      return Capsule(radius, half_length);
    });
  }
  if (kind == "sphere") {
    refuse_others(value, {"shape", "radius"}, path);
    const double radius = size("radius");
    return at_path(path, [&]() -> Shape { return Sphere(radius); });
  }
  if (kind == "box") {
    refuse_others(value, {"shape", "half_extents"}, path);
    const Vec3 half = vector(member(value, "half_extents", path), path + ".half_extents");
    return at_path(path, [&]() -> Shape { return Box(half); });
  }
  if (kind == "plane") {
    refuse_others(value, {"shape", "normal", "displacement"}, path);
    const Vec3 normal = vector(member(value, "normal", path), path + ".normal");
    const double displacement = size("displacement");
    return at_path(path, [&]() -> Shape { return Plane(normal, displacement); });
  }
  throw InvalidInput(path + ".shape", shown(kind),
                     "must be \"cylinder\", \"plane\", \"sphere\", \"capsule\" or \"box\"");
}

Pose pose_from_json(const json& object, const char* name) {
  if (!object.contains(name)) return Pose();
  const json& value = object[name];
  require_object(value, name);
  refuse_others(value, {"position", "orientation"}, name);
  Vec3 position = Vec3::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  if (value.contains("position")) {
    position = vector(value["position"], std::string(name) + ".position");
  }
  if (value.contains("orientation")) {
    const auto q = numbers<4>(value["orientation"], std::string(name) + ".orientation");
    orientation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
  }
  return at_path(name, [&] { return Pose(position, orientation); });
}

/// How a number is written.
using Write = std::function<json(double)>;

json write_vector(const Vec3& v, const Write& write) {
  return json::array({write(v.x()), write(v.y()), write(v.z())});
}

struct WriteShape {
  const Write& write;
  json operator()(const Cylinder& s) const {
    return round("cylinder", s.radius(), s.half_length());
  }
  json operator()(const Capsule& s) const { return round("capsule", s.radius(), s.half_length()); }
  json operator()(const Sphere& s) const {
    return {{"shape", "sphere"}, {"radius", write(s.radius())}};
  }
  json operator()(const Box& s) const {
    return {{"shape", "box"}, {"half_extents", write_vector(s.half_extents(), write)}};
  }
  json operator()(const Plane& s) const {
    return {{"shape", "plane"},
            {"normal", write_vector(s.normal(), write)},
            {"displacement", write(s.displacement())}};
  }
  json round(const char* name, double radius, double half_length) const {
    return {{"shape", name}, {"radius", write(radius)}, {"half_length", write(half_length)}};
  }
};

json write_pose(const Pose& pose, const Write& write) {
  const auto& q = pose.orientation();
  return {{"position", write_vector(pose.position(), write)},
          {"orientation", json::array({write(q.w()), write(q.x()), write(q.y()), write(q.z())})}};
}

json write_configuration(const Configuration& c, const Write& write) {
  return {{"a", WriteShape{write}(c.a)},
          {"pose_a", write_pose(c.pose_a, write)},
          {"b", std::visit(WriteShape{write}, c.b)},
          {"pose_b", write_pose(c.pose_b, write)}};
}

}  // namespace

GivenConfiguration configuration_from_json(const json& value) {
  require_object(value, "configuration");
  refuse_others(value, {"id", "a", "pose_a", "b", "pose_b"}, "");
  const Shape a = shape_from_json(member(value, "a", ""), "a");
  const Shape b = shape_from_json(member(value, "b", ""), "b");
  const Pose pose_a = pose_from_json(value, "pose_a"), pose_b = pose_from_json(value, "pose_b");
  if (const auto* cylinder = std::get_if<Cylinder>(&a)) {
    return {{*cylinder, pose_a, b, pose_b}, false};
  }
  if (const auto* cylinder = std::get_if<Cylinder>(&b)) {
    return {{*cylinder, pose_b, a, pose_a}, true};
  }
  throw InvalidInput("a.shape", shown(value["a"]["shape"]),
                     "one of the two bodies must be a cylinder");
}

json to_json(const Configuration& c) {
  return write_configuration(c, [](double x) { return json(x); });
}

json to_hex_json(const Configuration& c) {
  return write_configuration(c, [](double x) { return json(fmt::format("{:a}", x)); });
}

json to_exact_json(const Configuration& c) {
  return write_configuration(c, [](double x) { return json(mpq_class(x).get_str()); });
}

json to_json(const Vec3& v) {
  return write_vector(v, [](double x) { return std::isfinite(x) ? json(x) : json(nullptr); });
}

}  // namespace touchstone
