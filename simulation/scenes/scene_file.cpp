#include "simulation/scenes/scene_file.hpp"

#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>

#include "properties/files/configuration_json.hpp"
#include "properties/files/json_fields.hpp"
#include "properties/files/read_file.hpp"
#include "properties/files/strict_json.hpp"
#include "reference/aabb.hpp"
#include "simulation/scenes/need_json.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

struct NamedMaterial {
  Material material;
  double density;
};

std::map<std::string, NamedMaterial> read_materials(const json& file) {
  std::map<std::string, NamedMaterial> result;
  if (!file.contains("materials")) return result;
  require_object(file["materials"], "materials");
  for (const auto& [name, value] : file["materials"].items()) {
    const std::string path = "materials." + name;
    require_object(value, path);
    refuse_others(value, {"density", "friction", "restitution"}, path);
    const Body usual{"", Sphere(1)};
    const auto get = [&](const char* field, double otherwise, double most) {
      if (!value.contains(field)) return otherwise;
      const double x = number(value[field], path + '.' + field);
      if (!(std::isfinite(x) && x >= 0 && x <= most)) {
        throw InvalidInput(path + '.' + field, shown(value[field]),
                           most == 1 ? "must lie between 0 and 1" : "must be finite and positive");
      }
      return x;
    };
    constexpr double any = std::numeric_limits<double>::max();
    result[name] = {{get("friction", usual.material.friction, any),
                     get("restitution", usual.material.restitution, 1)},
                    get("density", usual.density, any)};
  }
  return result;
}

Body read_body(const json& value, const std::string& path,
               const std::map<std::string, NamedMaterial>& materials) {
  require_object(value, path);
  refuse_others(
      value, {"name", "shape", "material", "pose", "velocity", "angular_velocity", "fixed"}, path);
  Body body{string(member(value, "name", path), path + ".name"),
            shape_from_json(member(value, "shape", path), path + ".shape")};
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
  if (value.contains("pose")) body.pose = pose_from_json(value["pose"], path + ".pose");
  if (value.contains("velocity")) body.velocity = vector(value["velocity"], path + ".velocity");
  if (value.contains("angular_velocity")) {
    body.angular_velocity = vector(value["angular_velocity"], path + ".angular_velocity");
  }
  if (value.contains("fixed")) {
    if (!value["fixed"].is_boolean()) {
      throw InvalidInput(path + ".fixed", shown(value["fixed"]), "must be true or false");
    }
    body.fixed = value["fixed"].get<bool>();
  }
  return body;
}

/// Calls read(element, "name[i]") for each element of the array.
template <class Read>
void each_of(const json& file, const char* name, Read read) {
  const json& array = member(file, name, "");
  if (!array.is_array()) throw InvalidInput(name, shown(array), "must be an array");
  for (std::size_t i = 0; i < array.size(); ++i) read(array[i], fmt::format("{}[{}]", name, i));
}

Camera read_camera(const json& value) {
  require_object(value, "camera");
  refuse_others(value, {"position", "look_at"}, "camera");
  const Camera camera{vector(member(value, "position", "camera"), "camera.position"),
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

SceneFile scene_from_json(const json& file, const std::string& name) {
  require_object(file, "scene");
  refuse_others(file,
                {"$schema", "description", "gravity", "step", "duration", "surface_layer",
                 "materials", "bodies", "needs", "camera"},
                "");
  SceneFile result;
  result.name = name;
  if (file.contains("description")) result.description = string(file["description"], "description");
  Scene& scene = result.scene;
  if (file.contains("gravity")) scene.gravity = vector(file["gravity"], "gravity");
  if (file.contains("step")) scene.step = number(file["step"], "step");
  scene.duration = number(member(file, "duration", ""), "duration");
  if (file.contains("surface_layer")) {
    scene.surface_layer = number(file["surface_layer"], "surface_layer");
  }
  const auto materials = read_materials(file);
  each_of(file, "bodies", [&](const json& value, const std::string& path) {
    scene.bodies.push_back(read_body(value, path, materials));
  });
  constexpr std::size_t max_bodies = 1000;  // in each step every one is held against every other
  if (scene.bodies.size() > max_bodies) {
    throw InvalidInput("bodies", fmt::format("{} bodies", scene.bodies.size()),
                       fmt::format("must be at most {}", max_bodies));
  }
  check_scene(scene);
  constexpr double max_steps = 1e6, max_states = 4e6;  // a state of a body takes 200 bytes
  const double steps = scene.duration / scene.step;
  if (steps > max_steps || steps * static_cast<double>(scene.bodies.size()) > max_states) {
    throw InvalidInput("duration", shown(file["duration"]),
                       "must be at most a million steps, and four million divided by the number of "
                       "bodies");
  }
  if (file.contains("needs")) {
    each_of(file, "needs", [&](const json& value, const std::string& path) {
      result.needs.push_back(need_from_json(value, path, scene));
    });
  }
  result.camera = file.contains("camera") ? read_camera(file["camera"]) : camera_for(scene);
  return result;
}

SceneFile read_scene(const std::filesystem::path& file) {
  return scene_from_json(parse_json(read_file(file, "scene"), file.string()), file.stem().string());
}

}  // namespace touchstone
