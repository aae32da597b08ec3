#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "reference/pose.hpp"
#include "reference/shape.hpp"
#include "simulation/scenes/scene_file.hpp"

namespace touchstone {

/// A collision shape of a robot or world file, every joint in its default position.
struct PlacedShape {
  std::string name;  ///< "link/collision", of a world "model::link/collision"
  std::string link;  ///< the body that it belongs to, with other shapes maybe
  Shape shape;
  Pose pose;           ///< in the world, of a robot in its root link
  bool fixed = false;  ///< part of a static model
};

/// What a URDF or SDF file says of contacts.
struct ShapesFile {
  std::string name;  ///< of the robot or world
  std::vector<PlacedShape> shapes;
  std::set<std::pair<std::string, std::string>> joined;  ///< links with a joint between them
  /// What was not read, each with element and name: "collision upper/hull: a mesh".
  std::vector<std::string> ignored;
};

/// Does the name end as those of robot and world files (.urdf, .sdf, .world)?
bool is_shapes_file(const std::filesystem::path& file);

/// Reads URDF or SDF by the name's ending. Throws InvalidInput with the element's name.
ShapesFile read_shapes(const std::filesystem::path& file);
/// Both libraries may print on standard error what is wrong.
ShapesFile read_urdf(const std::filesystem::path& file);
ShapesFile read_sdf(const std::filesystem::path& file);

/// The file's text. Throws InvalidInput where its elements are nested so deeply that a parser would
/// overflow the stack.
std::string read_xml(const std::filesystem::path& file);

/// The shapes as bodies that stay where they are.
SceneFile still_scene(const ShapesFile& shapes);

}  // namespace touchstone
