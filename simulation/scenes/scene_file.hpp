#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "simulation/scene.hpp"
#include "simulation/scenes/need.hpp"

namespace touchstone {

/// From where a picture of a scene is taken, z up, metres.
struct Camera {
  Vec3 position, look_at;
};

/// A scene as a person writes it (docs/scenes.md).
struct SceneFile {
  std::string name;  ///< of the file, without folder and ending
  std::string description;
  Scene scene;
  std::vector<Need> needs;
  Camera camera;  ///< one that sees all bodies, where the file has none
};

/// Throws InvalidInput with the path of the field ("bodies[3].shape.radius").
SceneFile scene_from_json(const nlohmann::json& json, const std::string& name);
/// The same, or InvalidInput where the file cannot be read or is no JSON.
SceneFile read_scene(const std::filesystem::path& file);

/// Sees all bodies but the planes from the front right above.
Camera camera_for(const Scene& scene);

}  // namespace touchstone
