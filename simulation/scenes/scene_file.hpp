#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/scene.hpp"
#include "simulation/scenes/need.hpp"

namespace touchstone {

/// View point of a picture of a scene, z up, metres.
struct Camera {
  Vec3 position, look_at;
};

/// A scene as a person writes it (docs/scenes.md).
struct SceneFile {
  std::string name;  ///< of the file, without folder and ending
  std::string description;
  Scene scene;
  std::vector<std::shared_ptr<const Need>> needs;
  Camera camera;  ///< by default `camera_for` the scene
};

/// Reads the text of a scene file. Throws InvalidInput with the path of the field
/// ("bodies[3].shape.radius"), or with the file's name where the text is not JSON.
SceneFile scene_from_text(std::string_view text, const std::filesystem::path& file);
/// Reads a scene file; throws likewise, also where the file cannot be read.
SceneFile read_scene(const std::filesystem::path& file);

/// The JSON Schema of scene files with its needs replaced by those that `scene_from_text` reads.
std::string schema_with_needs(const std::string& schema);

/// A camera that sees all bodies but the planes, from the front right above.
Camera camera_for(const Scene& scene);

}  // namespace touchstone
