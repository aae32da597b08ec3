#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/scene.hpp"
#include "simulation/scenes/need.hpp"
#include "simulation/scenes/trajectory.hpp"

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
  /// Elements of a robot's or world's file that were not read, and what was done instead.
  std::vector<std::string> ignored = {};
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

/// Writes a run for POV-Ray 3.7: scene.pov (camera, light), frame-00001.inc, … (the bodies at
/// intervals of `every` seconds), and scene.ini; `povray scene.ini` draws all frames. Returns the
/// number of frames. Throws InvalidInput (field "--povray") if a file cannot be written.
int write_povray(const SceneFile& file, const Trajectory& run, double every,
                 const std::filesystem::path& folder);

}  // namespace touchstone
