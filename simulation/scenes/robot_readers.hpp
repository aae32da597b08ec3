#pragma once

#include <boost/property_tree/ptree_fwd.hpp>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/scenes/robot_file.hpp"

// What reads robots and worlds, in the module touchstone-robots.so: the libraries that it needs
// take 35 ms to start, longer than most commands run. Only `read_robot` loads it, in a process of
// its own: it may crash, hang and print.
namespace touchstone {

/// Returns as bytes true and the RobotFile, or false and the field, the value and the remedy of an
/// InvalidInput. What the libraries print goes to `log`, a file in memory.
using ReadRobot = std::string(const std::filesystem::path& file, const Folders& folders, int log);
/// The module's function without arguments that returns its ReadRobot*.
inline constexpr const char* robots_entry = "touchstone_robots";

RobotFile read_urdf(const std::filesystem::path& file, const Folders& folders);
RobotFile read_sdf(const std::filesystem::path& file, const Folders& folders);
RobotFile read_mjcf(const std::filesystem::path& file);

/// Gives a link with its mass and shapes the moments and products of inertia of its file, which are
/// about the axes of a frame in its centre of mass. If no body can have them, or hardly one of
/// these shapes, it only gets the centre, and the robot a note.
void set_inertia(Link& link, const Pose& frame, const Eigen::Matrix3d& moments, RobotFile& robot);

/// What joints have beside limits and motors, which nothing here obeys.
class UnreadOfJoints {
 public:
  /// Notes a property of a joint ("damping") unless its value is zero or not finite.
  void add(const char* property, double value, const std::string& joint);
  /// Adds "damping of joints elbow and wrist: not read", one note for each property.
  void note(RobotFile& robot) const;

 private:
  std::map<std::string, std::vector<std::string>> joints_;  ///< by property
};

/// What a library has said on standard error up to now, in one line: its first error. Empty outside
/// of `read_robot`.
std::string library_complaint();
/// Puts the name of another file in place of that: what `read_robot` says if its process ends now.
void now_reading(const std::string& file);

// Checks before a library reads:

/// Text of an XML file. Throws InvalidInput if its elements are nested so deeply that a parser
/// would overflow the stack.
std::string read_xml(const std::filesystem::path& file);
/// Throws InvalidInput, with the line, unless it is XML.
boost::property_tree::ptree parse_xml(const std::string& text, const std::filesystem::path& file);
/// Throws InvalidInput, with the collision and the field, unless each collision's shape is known
/// and has the lengths it needs, and no others. Returns the number of collisions of each link.
std::map<std::string, std::size_t> check_urdf_collisions(const boost::property_tree::ptree& robot);
/// Checks those of SDF, and that its version is not above that which its reader knows.
void check_sdf_collisions(const boost::property_tree::ptree& sdf, std::string_view newest_version);

/// Where to look for what a file names: in the folders given, in those of SDF_PATH,
/// GZ_SIM_RESOURCE_PATH, GAZEBO_MODEL_PATH, IGN_GAZEBO_RESOURCE_PATH, ROS_PACKAGE_PATH and
/// AMENT_PREFIX_PATH (there `share`), in that of the file, its folder `models`, and all above it.
Folders resource_folders(const Folders& given, const std::filesystem::path& file);
/// The file or folder that a URI names, after model://, package:// or file://; empty if there is
/// none.
std::filesystem::path find_resource(const std::string& uri, const Folders& folders);

}  // namespace touchstone
