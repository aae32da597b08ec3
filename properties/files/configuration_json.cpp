#include "properties/files/configuration_json.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <functional>
#include <gmpxx.h>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "oracle/hull.hpp"
#include "properties/casts.hpp"
#include "properties/files/disk.hpp"
#include "properties/files/given_text.hpp"
#include "properties/files/strict_json.hpp"
#include "properties/given_orientation.hpp"
#include "properties/identity.hpp"
#include "properties/motions/motion.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

/// How a number is written.
using Write = std::function<json(double)>;

json write_vector(const Vec3& v, const Write& write) {
  return json::array({write(v.x()), write(v.y()), write(v.z())});
}

struct WriteShape {
  Write write;
  json operator()(const Cylinder& s) const {
    return rounded(round("cylinder", s.radius(), s.half_length()), s.rounding());
  }
  json operator()(const Capsule& s) const { return round("capsule", s.radius(), s.half_length()); }
  json operator()(const Sphere& s) const {
    return {{"shape", "sphere"}, {"radius", write(s.radius())}};
  }
  json operator()(const Box& s) const {
    return rounded({{"shape", "box"}, {"half_extents", write_vector(s.half_extents(), write)}},
                   s.rounding());
  }
  json operator()(const Convex& s) const {
    json vertices = json::array();
    for (const Vec3& v : s.vertices()) vertices.push_back(write_vector(v, write));
    return rounded({{"shape", "convex"}, {"vertices", std::move(vertices)}}, s.rounding());
  }
  json operator()(const Plane& s) const {
    return {{"shape", "plane"},
            {"normal", write_vector(s.normal(), write)},
            {"displacement", write(s.displacement())}};
  }
  json rounded(json shape, double rounding) const {
    if (rounding > 0) shape["rounding"] = write(rounding);
    return shape;
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

Shape shape_from_json(const json& value, const std::string& path) {
  require_object(value, path);
  const json& kind = member(value, "shape", path);
  const auto size = [&](const char* name) {
    return number(member(value, name, path), path + "." + name);
  };
  const auto rounding = [&] { return value.contains("rounding") ? size("rounding") : 0; };
  if (kind == "cylinder") {
    refuse_others(value, {"shape", "radius", "half_length", "rounding"}, path);
    const double radius = size("radius"), half_length = size("half_length"), edges = rounding();
    return at_path(path, [&]() -> Shape { return Cylinder(radius, half_length, edges); });
  }
  if (kind == "capsule") {
    refuse_others(value, {"shape", "radius", "half_length"}, path);
    const double radius = size("radius"), half_length = size("half_length");
    return at_path(path, [&]() -> Shape { return Capsule(radius, half_length); });
  }
  if (kind == "sphere") {
    refuse_others(value, {"shape", "radius"}, path);
    const double radius = size("radius");
    return at_path(path, [&]() -> Shape { return Sphere(radius); });
  }
  if (kind == "box") {
    refuse_others(value, {"shape", "half_extents", "rounding"}, path);
    const Vec3 half = vector(member(value, "half_extents", path), path + ".half_extents");
    const double edges = rounding();
    return at_path(path, [&]() -> Shape { return Box(half, edges); });
  }
  if (kind == "plane") {
    refuse_others(value, {"shape", "normal", "displacement"}, path);
    const Vec3 normal = vector(member(value, "normal", path), path + ".normal");
    const double displacement = size("displacement");
    return at_path(path, [&]() -> Shape { return Plane(normal, displacement); });
  }
  if (kind == "convex") {
    refuse_others(value, {"shape", "vertices", "rounding"}, path);
    const json& given = member(value, "vertices", path);
    const std::string field = path + ".vertices";
    if (!given.is_array()) {
      throw InvalidInput(field, shown(given), "must be an array of points, of 3 numbers each");
    }
    if (given.size() > Convex::max_vertices) {
      throw InvalidInput(field, fmt::format("{} points", given.size()),
                         fmt::format("must be at most {}", Convex::max_vertices));
    }
    std::vector<Vec3> vertices;
    for (std::size_t i = 0; i < given.size(); ++i) {
      vertices.push_back(vector(given[i], fmt::format("{}[{}]", field, i)));
    }
    const double around = rounding();
    return at_path(path, [&]() -> Shape { return oracle::convex_hull(vertices, around); });
  }
  throw InvalidInput(
      path + ".shape", shown(kind),
      "must be \"cylinder\", \"plane\", \"sphere\", \"capsule\", \"box\" or \"convex\"");
}

namespace {

Eigen::Quaterniond quaternion_from_json(const json& value, const std::string& field) {
  const auto q = numbers<4>(value, field);
  return {q[0], q[1], q[2], q[3]};
}

Eigen::Matrix3d matrix_from_json(const json& value, const std::string& field) {
  if (!value.is_array() || value.size() != 3) {
    throw InvalidInput(field, shown(value), "must be an array of 3 rows of 3 numbers");
  }
  Eigen::Matrix3d matrix;
  for (int i = 0; i < 3; ++i) matrix.row(i) = vector(value[i], fmt::format("{}[{}]", field, i));
  return matrix;
}

Vec3 axis_from_json(const json& value, const std::string& field) {
  if (value.is_array()) return vector(value, field);
  if (value == "x") return Vec3::UnitX();
  if (value == "y") return Vec3::UnitY();
  if (value == "z") return Vec3::UnitZ();
  throw InvalidInput(field, shown(value),
                     "must be \"x\", \"y\", \"z\" or an array of 3 numbers, the direction of "
                     "the body's z in the world");
}

/// In one of three ways, or not turned.
Eigen::Quaterniond orientation_from_json(const json& pose, const std::string& path) {
  std::string way;
  for (const char* name : {"orientation", "rotation", "axis"}) {
    if (!pose.contains(name)) continue;
    if (!way.empty()) {
      throw InvalidInput(path + '.' + name, shown(pose[name]), "must be left out beside " + way);
    }
    way = name;
  }
  if (way.empty()) return Eigen::Quaterniond::Identity();
  const json& value = pose[way];
  const std::string field = path + '.' + way;
  if (way == "orientation") return quaternion_from_json(value, field);
  if (way == "rotation") {
    const Eigen::Matrix3d rotation = matrix_from_json(value, field);
    return at_path(path, [&] { return orientation_of(rotation); });
  }
  const Vec3 axis = axis_from_json(value, field);
  return at_path(path, [&] { return orientation_along(axis); });
}

}  // namespace

Pose pose_from_json(const json& value, const std::string& path) {
  require_object(value, path);
  refuse_others(value, {"position", "orientation", "rotation", "axis"}, path);
  Vec3 position = Vec3::Zero();
  if (value.contains("position")) {
    position = vector(value["position"], path + ".position");
  }
  const Eigen::Quaterniond orientation = orientation_from_json(value, path);
  return at_path(path, [&] { return Pose(position, orientation); });
}

namespace {

/// Empty for a configuration at rest.
std::optional<Sweep> sweep_from_json(const json& value) {
  const auto given = [&](const char* name) {
    return value.contains(name) ? vector(value[name], name) : Vec3(Vec3::Zero());
  };
  if (!value.contains("sweep") && !value.contains("spin")) return std::nullopt;
  return Sweep(given("sweep"), given("spin"));
}

/// The sweep of body b, as a sees it, where a has it.
std::optional<Sweep> seen_from_b(const std::optional<Sweep>& sweep, const json& value) {
  if (!sweep) return sweep;
  if (sweep->turns()) {
    throw InvalidInput("spin", shown(value["spin"]),
                       "must be left out where body a is no cylinder");
  }
  return Sweep(-sweep->translation());
}

}  // namespace

GivenConfiguration configuration_from_json(const json& value) {
  GivenConfiguration given = cast_from_json(value);
  if (!given.sweep) return given;
  const char* const name = value.contains("sweep") ? "sweep" : "spin";
  throw InvalidInput(name, shown(value[name]),
                     "must be left out: casts are known to solve and replay alone");
}

GivenConfiguration cast_from_json(const json& value) {
  require_object(value, "configuration");
  refuse_others(value, {"id", "a", "pose_a", "b", "pose_b", "sweep", "spin"}, "");
  const Shape a = shape_from_json(member(value, "a", ""), "a");
  const Shape b = shape_from_json(member(value, "b", ""), "b");
  const auto pose = [&](const char* name) {
    return value.contains(name) ? pose_from_json(value[name], name) : Pose();
  };
  const Pose pose_a = pose("pose_a"), pose_b = pose("pose_b");
  const std::optional<Sweep> sweep = sweep_from_json(value);
  if (const auto* cylinder = std::get_if<Cylinder>(&a)) {
    return {{*cylinder, pose_a, b, pose_b}, false, sweep};
  }
  if (const auto* cylinder = std::get_if<Cylinder>(&b)) {
    return {{*cylinder, pose_b, a, pose_a}, true, seen_from_b(sweep, value)};
  }
  throw InvalidInput("a.shape", shown(value["a"]["shape"]),
                     "one of the two bodies must be a cylinder");
}

namespace {

/// Empty for a line without an id.
std::string id_or_none(const json& line) { return line.contains("id") ? id_of(line) : ""; }

/// "c1, c2 and 7 more"
std::string ids_of(const std::vector<json>& lines) {
  constexpr std::size_t max_named = 20, max_length = 60;
  std::vector<std::string> ids;
  for (const json& line : lines) {
    if (const std::string id = id_or_none(line); !id.empty())
      ids.push_back(printable(id, max_length));
  }
  const std::size_t unnamed = ids.size() - std::min(ids.size(), max_named);
  ids.resize(ids.size() - unnamed);
  return fmt::format("{}{}", fmt::join(ids, ", "),
                     unnamed ? fmt::format(" and {} more", unnamed) : "");
}

/// The line of that id, or without an id the only one.
const json& chosen(const std::vector<json>& lines, const std::string& source,
                   const std::optional<std::string>& id) {
  const std::string ids = ids_of(lines);
  if (!id) {
    if (lines.size() == 1) return lines.front();
    throw InvalidInput("input", '"' + source + '"',
                       fmt::format("must hold one configuration, not {}", lines.size()) +
                           (ids.empty() ? "" : "; touchstone replay takes --id of " + ids));
  }
  const auto has_id = [&](const json& line) { return id_or_none(line) == *id; };
  const auto count = std::count_if(lines.begin(), lines.end(), has_id);
  if (count == 1) return *std::find_if(lines.begin(), lines.end(), has_id);
  throw InvalidInput("--id", '"' + *id + '"',
                     count > 1     ? fmt::format("must be of one line, not of {}", count)
                     : ids.empty() ? "must not be given, for no line has an id"
                                   : "must be one of " + ids);
}

Subject subject_of(const std::string& text, const std::string& source,
                   const std::optional<std::string>& id) {
  const std::vector<json> lines = parse_json_lines(text, source);
  const json& line = chosen(lines, source, id);
  require_object(line, source);
  const bool is_wrapped = line.contains("configuration");
  const GivenConfiguration given = cast_from_json(is_wrapped ? line["configuration"] : line);
  return {source, "", given.configuration, id_or_none(line), given.sweep};
}

}  // namespace

Configuration configuration_from_text(const std::string& text, const std::string& source) {
  const Subject subject = subject_of(text, source, std::nullopt);
  refuse_sweep(subject, source);
  return subject.configuration;
}

namespace {

json in_decimal(double x) { return x; }
json in_hex(double x) { return fmt::format("{:a}", x); }

json write_cast(const Configuration& c, const std::optional<Sweep>& sweep, const Write& write) {
  json result = write_configuration(c, write);
  if (!sweep) return result;
  result["sweep"] = write_vector(sweep->translation(), write);
  if (sweep->turns()) result["spin"] = write_vector(sweep->spin(), write);
  return result;
}

}  // namespace

json to_json(const Configuration& c) { return write_configuration(c, in_decimal); }
json to_json(const Configuration& c, const std::optional<Sweep>& sweep) {
  return write_cast(c, sweep, in_decimal);
}

json to_hex_json(const Configuration& c) { return write_configuration(c, in_hex); }
json to_hex_json(const Configuration& c, const std::optional<Sweep>& sweep) {
  return write_cast(c, sweep, in_hex);
}

json to_exact_json(const Configuration& c) {
  return write_configuration(c, [](double x) { return json(mpq_class(x).get_str()); });
}

json to_json(const Shape& shape) {
  return std::visit(WriteShape{[](double x) { return json(x); }}, shape);
}

json to_json(const Vec3& v) { return write_vector(v, or_null); }

namespace {

/// Is it a path rather than an identity? Those begin with a pair, and have four parts and a number
/// at the end.
bool is_meant_as_file(const std::string& name) {
  if (name.starts_with('/') || name.starts_with('.')) return true;
  const bool has_parts = std::count(name.begin(), name.end(), '/') == 3;
  if (is_folder(name) && !has_parts) return true;
  const bool ends_with_number = !name.empty() && name.back() >= '0' && name.back() <= '9';
  return !has_parts && !ends_with_number;
}

/// An identity, a name of the stability room, or either and a perturbation.
Subject named(const std::string& name, const std::optional<std::string>& id) {
  constexpr std::size_t max_name = 1000;  // perturbations of perturbations stand one within another
  if (name.size() > max_name) {
    throw InvalidInput("input", '"' + name + '"',
                       "must be a file, or an identity, which is never that long");
  }
  if (const auto at = name.rfind('@'); at != std::string::npos) {
    const Perturbation perturbation = parse_perturbation(name.substr(at + 1));
    const Subject base = given_configuration(name.substr(0, at), id);
    return {name, base.description, perturbed(base.configuration, perturbation), base.id,
            base.sweep};
  }
  if (id && (!is_meant_as_file(name) || is_cast_identity(name))) {
    throw InvalidInput("--id", '"' + *id + '"', "must be of a line of a file");
  }
  if (const auto stability = named_configuration(name)) return *stability;
  if (is_cast_identity(name)) return subject(parse_cast_identity(name));
  if (is_meant_as_file(name)) {
    throw InvalidInput(
        "input", '"' + name + '"',
        std::string(is_folder(name) ? "must be a file, not a folder" : "there is no such file") +
            "; an identity reads pair/class/seed/index, of a cast also /motion");
  }
  return subject(parse_identity(name));
}

}  // namespace

Subject given_configuration(const std::string& input, const std::optional<std::string>& id) {
  if (input == "-") {
    return subject_of(read_stream(std::cin, standard_input_name, "input"), standard_input_name, id);
  }
  return is_file(input) ? subject_of(read_file(input, "input"), input, id) : named(input, id);
}

void refuse_sweep(const Subject& subject, const std::string& asked) {
  if (!subject.sweep) return;
  const json given = to_json(subject.configuration, subject.sweep);
  throw InvalidInput("sweep", shown(given["sweep"]),
                     "must be left out: " + asked + " knows no casts");
}

}  // namespace touchstone
