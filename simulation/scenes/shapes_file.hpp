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

/// Reads URDF or SDF, by the extension. Throws InvalidInput with the element's name.
ShapesFile read_shapes(const std::filesystem::path& file);
// The libraries behind them may print on standard error what is wrong.
ShapesFile read_urdf(const std::filesystem::path& file);
ShapesFile read_sdf(const std::filesystem::path& file);

/// Text of an XML file. Throws InvalidInput if its elements are nested so deeply that a parser
/// would overflow the stack.
std::string read_xml(const std::filesystem::path& file);

/// A scene of the shapes as fixed bodies.
SceneFile still_scene(const ShapesFile& shapes);

}  // namespace touchstone
