#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "simulation/scenes/robot_readers.hpp"

// Meshes of robots and worlds. What meets a cylinder is their convex hull, as Bullet and MuJoCo
// take them by default.

namespace touchstone {

struct Mesh {
  std::vector<Vec3> points;                   ///< m
  std::vector<std::array<int, 3>> triangles;  ///< indices of points
};

/// Reads STL, OBJ or COLLADA (.dae) through assimp, which keeps coordinates in single precision. Of
/// COLLADA the unit counts and the upward axis does not, as RViz has it. Throws InvalidInput (field
/// "mesh") with what assimp says of the file, or unless it has triangles and finite coordinates.
/// For a process that may crash and hang.
Mesh read_mesh(const std::filesystem::path& file);

/// The mesh that a robot's or world's file names by a path of its own folder or a URI, with its
/// coordinates scaled. Throws InvalidInput (field "mesh" or "mesh.scale").
Mesh named_mesh(const std::string& uri, const Vec3& scale, const std::filesystem::path& file,
                const Folders& folders);

/// The convex hull of a mesh as a collision shape, with its middle as its centre; adds to the robot
/// a note of what it adds to the mesh that is called `mesh_name`. Throws InvalidInput (field
/// "mesh") if there is none, or it has too many corners.
LinkShape hull_of(const Mesh& mesh, const std::string& mesh_name, const std::string& shape_name,
                  const Pose& X_WM, RobotFile& robot);

}  // namespace touchstone
