#include "simulation/scenes/scene_file.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>

#include <nlohmann/json.hpp>

#include "candidates/readable.hpp"
#include "properties/files/configuration_json.hpp"
#include "properties/files/disk.hpp"
#include "properties/files/strict_json.hpp"
#include "reference/invalid_input.hpp"
#include "reference/support.hpp"
#include "simulation/assembly.hpp"
#include "simulation/scenes/mechanism_json.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

struct NamedMaterial {
  Material material;
  double density;
};

std::map<std::string, NamedMaterial> read_materials(const json& file) {
  std::map<std::string, NamedMaterial> result;
  if (!file.contains("materials")) return result;
  require_object(file["materials"], "materials");
  for (const auto& entry : file["materials"].items()) {
    const std::string& name = entry.key();
    const json& value = entry.value();
    const std::string path = "materials." + name;
    require_object(value, path);
    refuse_others(value, {"density", "friction", "restitution"}, path);
    const Body defaults{"", Sphere(1)};
    const auto get = [&](const char* field, double otherwise, double min, double max) {
      if (!value.contains(field)) return otherwise;
      const double x = number(value[field], path + '.' + field);
      if (!(x >= min && x <= max)) {
        throw InvalidInput(path + '.' + field, shown(value[field]),
                           fmt::format("must lie between {:g} and {:g}", min, max));
      }
      return x;
    };
    result[name] = {{get("friction", defaults.material.friction, 0, max_friction),
                     get("restitution", defaults.material.restitution, 0, 1)},
                    get("density", defaults.density, min_density, max_density)};
  }
  return result;
}

bool read_bool(const json& value, const std::string& field) {
  if (!value.is_boolean()) throw InvalidInput(field, shown(value), "must be true or false");
  return value.get<bool>();
}

/// Reads name, shape and material.
Body read_kind_of_body(const json& value, const std::string& path,
                       const std::map<std::string, NamedMaterial>& materials) {
  Body body{string(member(value, "name", path), path + ".name"),
            shape_from_json(member(value, "shape", path), path + ".shape")};
  check_printable(path + ".name", body.name);
  if (body.name.find_first_not_of(' ') == body.name.npos) {
    throw InvalidInput(path + ".name", shown(body.name), "must have a letter, to be told by");
  }
  if (value.contains("material")) {
    const std::string name = string(value["material"], path + ".material");
    if (!materials.contains(name)) {
      std::vector<std::string> names;
      for (const auto& [known, material] : materials) names.push_back(known);
      throw InvalidInput(path + ".material", shown(name),
                         fmt::format("must be one of the materials: {}", fmt::join(names, ", ")));
    }
    body.material = materials.at(name).material;
    body.density = materials.at(name).density;
  }
  return body;
}

PosedInertia inertia_from_json(const json& value, const std::string& path) {
  require_object(value, path);
  refuse_others(value, {"mass", "pose", "moments"}, path);
  PosedInertia result{{number(member(value, "mass", path), path + ".mass"),
                       vector(member(value, "moments", path), path + ".moments")}};
  if (value.contains("pose")) result.X_BC = pose_from_json(value["pose"], path + ".pose");
  return result;
}

Body read_body(const json& value, const std::string& path,
               const std::map<std::string, NamedMaterial>& materials) {
  require_object(value, path);
  refuse_others(value,
                {"name", "shape", "material", "pose", "velocity", "angular_velocity", "fixed",
                 "drive", "surface_velocity", "collides", "inertia"},
                path);
  Body body = read_kind_of_body(value, path, materials);
  const auto read = [&](const char* name, auto& member, auto reader) {
    if (value.contains(name)) member = reader(value[name], path + '.' + name);
  };
  read("pose", body.pose, pose_from_json);
  read("velocity", body.velocity, vector);
  read("angular_velocity", body.angular_velocity, vector);
  read("fixed", body.fixed, read_bool);
  read("drive", body.drive, drive_from_json);
  read("surface_velocity", body.surface_velocity, vector);
  read("collides", body.collides, read_bool);
  read("inertia", body.inertia, inertia_from_json);
  return body;
}

/// Calls read(element, "name[i]") for each element of the array, if the file has one.
template <class Read>
void each_of(const json& file, const char* name, Read read) {
  if (!file.contains(name)) return;
  const json& array = file[name];
  if (!array.is_array()) throw InvalidInput(name, shown(array), "must be an array");
  for (std::size_t i = 0; i < array.size(); ++i) read(array[i], fmt::format("{}[{}]", name, i));
}

/// Reads the members of a need from its JSON object.
class NeedReader final : public NeedMembers {
 public:
  NeedReader(const json& value, std::string path, const Scene& scene)
      : value_(value), path_(std::move(path)), scene_(scene), is_free_(moved_by_forces(scene)) {}

  void body(std::vector<int>& bodies) override {
    bodies = {body_index(member(value_, "body", path_), at("body"), scene_)};
    require_motion(bodies, value_["body"], at("body"));
  }
  void bodies(std::vector<int>& bodies) override {
    constexpr std::size_t no_limit = 1000000;
    bodies = array(1, no_limit);
    require_motion(bodies, value_["bodies"], at("bodies"));
  }
  void moving_bodies(std::vector<int>& bodies) override {
    if (value_.contains("bodies")) {
      bodies = array(1, scene_.bodies.size());
      require_motion(bodies, value_["bodies"], at("bodies"));
      return;
    }
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
      if (is_free_[i]) bodies.push_back(static_cast<int>(i));
    }
  }
  /// One of them must be a cylinder: contacts of other pairs are not judged.
  void pair(std::vector<int>& bodies) override {
    bodies = array(2, 2);
    const auto is_cylinder = [&](int b) {
      return std::holds_alternative<Cylinder>(scene_.bodies[b].shape);
    };
    if (!is_cylinder(bodies[0]) && !is_cylinder(bodies[1])) {
      throw InvalidInput(at("bodies"), shown(value_["bodies"]), "one of them must be a cylinder");
    }
  }
  void any_pair(std::vector<int>& bodies) override {
    if (value_.contains("bodies")) pair(bodies);
  }
  void number(const char* name, double& value) override {
    const json& given = member(value_, name, path_);
    value = touchstone::number(given, at(name));
    if (!(value >= 0 && value <= max_in_world)) {
      throw InvalidInput(at(name), shown(given),
                         fmt::format("must be a number from 0 to {:g}", max_in_world));
    }
  }
  void number_or_default(const char* name, double& value) override {
    if (value_.contains(name)) number(name, value);
  }
  void positive(const char* name, std::optional<double>& value) override {
    if (!value_.contains(name)) return;
    number(name, value.emplace());
    if (*value == 0) throw InvalidInput(at(name), "0", "must be positive");
  }
  void time_or_default(const char* name, double& value) override {
    if (!value_.contains(name)) return;
    number(name, value);
    if (value > scene_.duration) {
      throw InvalidInput(at(name), shown(value_[name]), "must lie within the scene's duration");
    }
  }
  void point(const char* name, Vec3& value) override {
    value = vector(member(value_, name, path_), at(name));
  }

 private:
  std::string at(const char* name) const { return path_ + '.' + name; }

  /// What a need says of a motion, a fixed or driven body would meet or break whatever it meets.
  void require_motion(const std::vector<int>& bodies, const json& given,
                      const std::string& field) const {
    for (const int b : bodies) {
      if (is_free_[b]) continue;
      throw InvalidInput(
          field, shown(given),
          fmt::format("must be moved by forces: {} is fixed or driven", scene_.bodies[b].name));
    }
  }
  std::vector<int> array(std::size_t min, std::size_t max) const {
    const json& names = member(value_, "bodies", path_);
    if (!names.is_array() || names.size() < min || names.size() > max) {
      throw InvalidInput(at("bodies"), shown(names),
                         min == max
                             ? "must be an array of two names of bodies"
                             : fmt::format("must be an array of at least {} names of bodies", min));
    }
    std::vector<int> result;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const int body = body_index(names[i], fmt::format("{}[{}]", at("bodies"), i), scene_);
      if (std::ranges::find(result, body) != result.end()) {
        throw InvalidInput(at("bodies"), shown(names), "must be bodies that differ");
      }
      result.push_back(body);
    }
    return result;
  }

  const json& value_;
  std::string path_;
  const Scene& scene_;
  const std::vector<bool> is_free_;  ///< by body
};

/// Describes the members of a need as JSON Schema.
class NeedSchema final : public NeedMembers {
 public:
  explicit NeedSchema(Need& need) {
    properties_["need"] = {{"const", need.name}};
    need.visit(*this);
    schema_ = {{"type", "object"},
               {"properties", properties_},
               {"required", required_},
               {"additionalProperties", false},
               {"description", need.meaning}};
  }
  const ordered_json& schema() const { return schema_; }
  /// The members that are known, "need" first.
  std::vector<std::string> names() const {
    std::vector<std::string> result;
    for (const auto& [name, property] : properties_.items()) result.push_back(name);
    return result;
  }

  void body(std::vector<int>&) override { add("body", body_name, true); }
  void bodies(std::vector<int>&) override { add("bodies", some_bodies, true); }
  void moving_bodies(std::vector<int>&) override { add("bodies", some_bodies, false); }
  void pair(std::vector<int>&) override { add("bodies", two_bodies, true); }
  void any_pair(std::vector<int>&) override { add("bodies", two_bodies, false); }
  void number(const char* name, double&) override { add(name, any_number, true); }
  void number_or_default(const char* name, double& value) override {
    ordered_json property = any_number;
    const bool is_whole = value == std::round(value);
    if (std::isfinite(value)) {
      property["default"] = is_whole ? ordered_json(std::lround(value)) : ordered_json(value);
    }
    add(name, property, false);
  }
  void positive(const char* name, std::optional<double>&) override { add(name, any_number, false); }
  void time_or_default(const char* name, double& value) override { number_or_default(name, value); }
  void point(const char* name, Vec3&) override { add(name, {{"$ref", "#/$defs/vector"}}, true); }

 private:
  void add(const char* name, const ordered_json& property, bool required) {
    properties_[name] = property;
    if (required) required_.push_back(name);
  }

  const ordered_json any_number = {{"$ref", "#/$defs/number"}};
  const ordered_json body_name = {{"type", "string"}, {"description", "The name of a body"}};
  const ordered_json some_bodies = {{"type", "array"}, {"items", body_name}, {"minItems", 1}};
  const ordered_json two_bodies = {
      {"type", "array"}, {"items", body_name}, {"minItems", 2}, {"maxItems", 2}};
  ordered_json properties_, required_ = {"need"}, schema_;
};

/// The kind of a need by its name, with its default members.
std::unique_ptr<Need> need_of_kind(const json& kind, const std::string& field) {
  std::vector<std::string> names;
  for (auto& need : all_needs()) {
    if (kind == need->name) return std::move(need);
    names.emplace_back(need->name);
  }
  std::sort(names.begin(), names.end());
  throw InvalidInput(field, shown(kind), fmt::format("must be one of {}", fmt::join(names, ", ")));
}

/// {"need": "stands", "body": "can", "degrees": 0.5}
std::shared_ptr<const Need> read_need(const json& value, const std::string& path,
                                      const Scene& scene) {
  require_object(value, path);
  auto need = need_of_kind(member(value, "need", path), path + ".need");
  refuse_others(value, NeedSchema(*need).names(), path);
  NeedReader reader(value, path, scene);
  need->visit(reader);
  at_path(path, [&] { need->check(scene); });
  return need;
}

Camera read_camera(const json& value) {
  require_object(value, "camera");
  refuse_others(value, {"position", "look_at"}, "camera");
  Camera camera{vector(member(value, "position", "camera"), "camera.position"),
                vector(member(value, "look_at", "camera"), "camera.look_at")};
  const double apart = (camera.position - camera.look_at).norm();
  if (!(std::isfinite(apart) && apart > 0)) {
    throw InvalidInput("camera.position", shown(value["position"]),
                       "must be finite and away from look_at");
  }
  return camera;
}

}  // namespace

Camera camera_for(const Scene& scene) {
  Aabb all{Vec3::Constant(std::numeric_limits<double>::infinity()),
           Vec3::Constant(-std::numeric_limits<double>::infinity())};
  for (const Body& body : scene.bodies) {
    if (std::holds_alternative<Plane>(body.shape)) continue;
    const Aabb box = aabb(body.shape, body.pose);
    all = {all.lower.cwiseMin(box.lower), all.upper.cwiseMax(box.upper)};
  }
  if (!(all.lower.x() <= all.upper.x())) all = {Vec3::Constant(-1), Vec3::Constant(1)};
  const Vec3 centre = (all.lower + all.upper) / 2;
  const double reach = (all.upper - all.lower).norm() / 2;
  return {centre + 2.6 * reach * Vec3(0.45, -0.8, 0.4), centre};
}

namespace {

/// What is meant is told by the name's ending.
void refuse_xml(std::string_view text, const std::filesystem::path& path) {
  const auto first = text.find_first_not_of("\xef\xbb\xbf \t\r\n");
  if (first == text.npos || text[first] != '<') return;
  throw InvalidInput("scene", '"' + path.string() + '"',
                     "is XML: the name of a robot must end in .urdf, that of a world in .sdf or "
                     ".world; a scene is JSON (docs/scenes.md)");
}

}  // namespace

SceneFile scene_from_text(std::string_view text, const std::filesystem::path& path) {
  refuse_xml(text, path);
  const json file = parse_json(text, path.string());
  require_object(file, "scene");
  refuse_others(file,
                {"$schema", "description", "gravity", "step", "duration", "surface_layer",
                 "materials", "bodies", "drops", "joints", "pushes", "needs", "camera"},
                "");
  SceneFile result;
  result.name = readable(path.stem().string());
  if (file.contains("description")) result.description = string(file["description"], "description");
  Scene& scene = result.scene;
  if (file.contains("gravity")) scene.gravity = vector(file["gravity"], "gravity");
  if (file.contains("step")) scene.step = number(file["step"], "step");
  scene.duration = number(member(file, "duration", ""), "duration");
  if (file.contains("surface_layer")) {
    scene.surface_layer = number(file["surface_layer"], "surface_layer");
  }
  const auto materials = read_materials(file);
  member(file, "bodies", "");  // which must be there
  each_of(file, "bodies", [&](const json& value, const std::string& field) {
    scene.bodies.push_back(read_body(value, field, materials));
  });
  each_of(file, "drops", [&](const json& value, const std::string& field) {
    require_object(value, field);
    refuse_others(value, {"name", "shape", "material", "count", "seed", "lower", "upper"}, field);
    add_drop(value, field, read_kind_of_body(value, field, materials), scene);
  });
  each_of(file, "joints", [&](const json& value, const std::string& field) {
    scene.joints.push_back(joint_from_json(value, field, scene));
  });
  each_of(file, "pushes", [&](const json& value, const std::string& field) {
    scene.pushes.push_back(push_from_json(value, field, scene));
  });
  if (scene.bodies.size() > max_bodies) {
    throw InvalidInput("bodies", fmt::format("{} bodies", scene.bodies.size()),
                       fmt::format("must be at most {}", max_bodies));
  }
  check_scene(scene);
  constexpr double max_steps = 1e6, max_states = 4e6;  // a state of a body takes 200 bytes
  const double steps = scene.duration / scene.step;
  if (steps < 1 - 1e-9) {
    throw InvalidInput("duration", shown(file["duration"]),
                       fmt::format("must be at least one step, which is {:g} s", scene.step));
  }
  if (steps > max_steps || steps * static_cast<double>(scene.bodies.size()) > max_states) {
    throw InvalidInput("duration", shown(file["duration"]),
                       "must be at most a million steps, and four million divided by the number of "
                       "bodies");
  }
  each_of(file, "needs", [&](const json& value, const std::string& field) {
    result.needs.push_back(read_need(value, field, scene));
  });
  result.camera = file.contains("camera") ? read_camera(file["camera"]) : camera_for(scene);
  return result;
}

SceneFile read_scene(const std::filesystem::path& file) {
  return scene_from_text(read_file(file, "scene"), file);
}

std::string schema_with_needs(const std::string& schema) {
  ordered_json result = ordered_json::parse(schema);
  ordered_json definitions, choices = ordered_json::array();
  for (const auto& [name, definition] : result["$defs"].items()) {
    if (!name.starts_with("need-")) definitions[name] = definition;
  }
  for (const auto& need : all_needs()) {
    const std::string name = std::string("need-") + need->name;
    definitions[name] = NeedSchema(*need).schema();
    choices.push_back({{"$ref", "#/$defs/" + name}});
  }
  result["$defs"] = definitions;
  result["properties"]["needs"]["items"]["oneOf"] = choices;
  return result.dump();
}

}  // namespace touchstone
