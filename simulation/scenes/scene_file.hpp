#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "reference/pose.hpp"
#include "reference/shape.hpp"
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

/// A collision shape of a robot or world file, with every joint in its default position.
struct PlacedShape {
  std::string name;  ///< "link/collision", of a world "model::link/collision"
  std::string link;  ///< the body that it is part of
  Shape shape;
  Pose pose;           ///< in the world; for a robot, in its root link
  bool fixed = false;  ///< part of a static model
};

/// Collision shapes of a URDF or SDF file.
struct ShapesFile {
  std::string name;  ///< of the robot or world
  std::vector<PlacedShape> shapes;
  std::set<std::pair<std::string, std::string>> joined;  ///< links with a joint between them
  /// Elements that were not read: "collision upper/hull: a mesh".
  std::vector<std::string> ignored;
};

/// Is it the name of a robot or world file (.urdf, .sdf, .world)?
bool is_shapes_file(const std::filesystem::path& file);

/// Throws InvalidInput with this field unless a terminal shows the name as it is: valid UTF-8
/// without control characters.
void check_printable(const std::string& field, const std::string& name);

/// Reads URDF or SDF, by the extension. Throws InvalidInput with the element's name.
ShapesFile read_shapes(const std::filesystem::path& file);
// The libraries behind them may print on standard error what is wrong.
ShapesFile read_urdf(const std::filesystem::path& file);
ShapesFile read_sdf(const std::filesystem::path& file);

/// Text of an XML file. Throws InvalidInput if its elements are nested so deeply that a parser
/// would overflow the stack.
std::string read_xml(const std::filesystem::path& file);
/// Throws InvalidInput, with the collision and the field, unless each collision's shape is known
/// and has the lengths it needs, and no others. Returns the number of collisions of each link.
std::map<std::string, std::size_t> check_urdf_collisions(const std::string& text);
/// Checks those of SDF, and that its version is not above that which its reader knows.
void check_sdf_collisions(const std::string& text, std::string_view newest_version);

/// A scene of the shapes as fixed bodies.
SceneFile still_scene(const ShapesFile& shapes);

/// Writes a run for POV-Ray 3.7: scene.pov (camera, light), frame-00001.inc, … (the bodies at
/// intervals of `every` seconds), and scene.ini; `povray scene.ini` draws all frames. Returns the
/// number of frames. Throws InvalidInput (field "--out") if a file cannot be written.
int write_povray(const SceneFile& file, const Trajectory& run, double every,
                 const std::filesystem::path& folder);

}  // namespace touchstone
