// The module touchstone-robots.so: the formats of robots and worlds, and what their numbers must
// be.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sstream>
#include <sys/resource.h>
#include <unistd.h>

#include "candidates/host/guard.hpp"
#include "candidates/readable.hpp"
#include "properties/files/bytes.hpp"
#include "properties/files/given_text.hpp"
#include "properties/files/strict_json.hpp"
#include "reference/invalid_input.hpp"
#include "simulation/scenes/library_log.hpp"
#include "simulation/scenes/robot_readers.hpp"

namespace touchstone {
namespace {

/// File in memory that standard error of a reading process goes to; −1 outside of one.
int library_log = -1;

[[noreturn]] void refuse(const std::string& field, double value, const char* remedy) {
  throw InvalidInput(field, fmt::format("{:g}", value), remedy);
}

void check_link(const Link& link) {
  const std::string name = "link " + link.name;
  check_printable("link", link.name);
  if (link.mass && !(*link.mass >= 0 && *link.mass <= std::numeric_limits<double>::max())) {
    refuse(name + ".mass", *link.mass, "must be finite and not negative");
  }
  for (const LinkShape& s : link.shapes) {
    check_printable("collision", s.name);
    if (s.friction && !(*s.friction >= 0)) {
      refuse("collision " + s.name + ".friction", *s.friction, "must not be negative");
    }
  }
}

void check_joint(const LinkJoint& joint) {
  const std::string name = "joint " + joint.name;
  check_printable("joint", joint.name);
  if (!(joint.anchor.allFinite() && joint.axis.allFinite() && joint.axis.norm() > 0)) {
    throw InvalidInput(
        name + ".axis",
        fmt::format("\"{:g} {:g} {:g}\"", joint.axis.x(), joint.axis.y(), joint.axis.z()),
        "must be three finite numbers, not all zero");
  }
  if (std::isnan(joint.lower)) refuse(name + ".limit.lower", joint.lower, "must be a number");
  if (std::isnan(joint.upper)) refuse(name + ".limit.upper", joint.upper, "must be a number");
  if (joint.lower > joint.upper) {
    refuse(name + ".limit.lower", joint.lower, "must not lie above the upper limit");
  }
  if (joint.effort && !(*joint.effort > 0)) {
    refuse(name + ".limit.effort", *joint.effort, "must be positive");
  }
}

/// Throws InvalidInput unless the numbers make sense; readers pass on what their libraries give.
void check_robot(RobotFile& robot, const std::filesystem::path& file) {
  std::size_t shapes = 0;
  check_printable("name", robot.name);
  for (const Link& link : robot.links) {
    check_link(link);
    shapes += link.shapes.size();
  }
  for (const LinkJoint& joint : robot.joints) check_joint(joint);
  if (!robot.gravity.allFinite()) throw InvalidInput("gravity", "not finite", "must be finite");
  constexpr std::size_t max_shapes = 2000;  // all pairs are tested
  if (shapes > max_shapes) {
    throw InvalidInput(
        "scene", '"' + file.string() + '"',
        fmt::format("must have at most {} collision shapes, not {}", max_shapes, shapes));
  }
  if (robot.links.size() > max_links || robot.joints.size() > max_links) {
    throw InvalidInput("scene", '"' + file.string() + '"',
                       fmt::format("must have at most {} links and joints, not {} and {}",
                                   max_links, robot.links.size(), robot.joints.size()));
  }
  for (std::string& note : robot.ignored) note = readable(note);
}

/// Bounds the memory of the process that reads: a number in a file may ask for any amount.
void bound_memory() {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // these map terabytes
  constexpr rlim_t max_bytes = rlim_t{4} << 30;
  const rlimit memory{max_bytes, max_bytes};
  setrlimit(RLIMIT_AS, &memory);
#endif
}

enum class Format { urdf, sdf, mjcf };

/// Name of the first element of an XML file; empty if there is none.
std::string_view root_element(std::string_view text) {
  const auto skip = [&](std::string_view open, std::string_view close) {
    if (!text.starts_with(open)) return false;
    const std::size_t end = text.find(close, open.size());
    text.remove_prefix(end == text.npos ? text.size() : end + close.size());
    return true;
  };
  for (;;) {
    const std::size_t start = text.find('<');
    if (start == text.npos) return {};
    text.remove_prefix(start);
    if (skip("<!--", "-->") || skip("<?", "?>") || skip("<!", ">")) continue;
    text.remove_prefix(1);
    return text.substr(0, text.find_first_of(" \t\r\n/>"));
  }
}

/// Format of a file by its ending, of .xml by its root element.
Format format_of(const std::filesystem::path& file, const std::string& text) {
  const auto ending = file.extension();
  if (text.find("<xacro:") != text.npos || ending == ".xacro") {
    throw InvalidInput("scene", '"' + file.string() + '"',
                       "must be expanded first: it is a xacro file, of which "
                       "`xacro FILE > robot.urdf` makes a URDF");
  }
  if (ending == ".urdf") return Format::urdf;
  if (ending == ".sdf" || ending == ".world") return Format::sdf;
  const std::string_view root = root_element(text);
  const auto root_is = [&](const char* name) { return root == name; };
  if (ending == ".mjcf" || root_is("mujoco")) return Format::mjcf;
  if (root_is("robot")) return Format::urdf;
  if (root_is("sdf")) return Format::sdf;
  throw InvalidInput("scene", '"' + file.string() + '"',
                     "must be MJCF, URDF or SDF: its root element is not mujoco, robot or sdf");
}

RobotFile read_format(Format format, const std::filesystem::path& file, const Folders& folders) {
  switch (format) {
    case Format::urdf:
      return read_urdf(file, folders);
    case Format::sdf:
      return read_sdf(file, folders);
    case Format::mjcf:
      break;
  }
  return read_mjcf(file);
}

/// A ReadRobot.
std::string read_as_bytes(const std::filesystem::path& file, const Folders& folders, int log) {
  library_log = log;
  bound_memory();
  for (const int standard : {STDOUT_FILENO, STDERR_FILENO}) dup2(log, standard);
  try {
    RobotFile robot = read_format(format_of(file, read_xml(file)), file, folders);
    check_robot(robot, file);
    return to_bytes(true, robot);
  } catch (const InvalidInput& e) {
    return to_bytes(false, e.field(), e.value(), e.remedy());
  } catch (const std::exception& e) {  // thrown by the libraries
    constexpr std::size_t max_reason = 200;
    return to_bytes(
        false, std::string("scene"), '"' + file.string() + '"',
        "must be a URDF, SDF or MJCF file; its reader says: " + printable(e.what(), max_reason));
  }
}

}  // namespace

namespace {

/// Why a link with a mass does not have these principal moments; null if it may. A radius of
/// gyration of 3% of a shape's is a placeholder's, and contacts sink in with it.
const char* fault_of(const Vec3& principal, const Link& link) {
  if (const char* fault = impossible(principal)) return fault;
  constexpr double min_share = 1e-3;
  double of_shapes = 0;  // at most, kg m²
  for (const LinkShape& s : link.shapes) {
    const Inertia one = inertia(s.shape, 1).inertia;
    if (one.mass > 0)
      of_shapes = std::max(of_shapes, *link.mass / one.mass * one.principal.maxCoeff());
  }
  return principal.maxCoeff() < min_share * of_shapes ? "next to nothing beside its shapes'"
                                                      : nullptr;
}

}  // namespace

void set_inertia(Link& link, const Pose& frame, const Eigen::Matrix3d& moments, RobotFile& robot) {
  if (!(link.mass.value_or(0) > 0)) {
    if (!moments.isZero(0)) {
      robot.ignored.push_back(fmt::format("link {}: an inertia without a mass", link.name));
    }
    return;
  }
  link.inertia = {frame};
  const auto [inertia, X_FC] = along_principal_axes(
      *link.mass, Vec3::Zero(),
      moments.allFinite() ? moments : Eigen::Matrix3d(Eigen::Matrix3d::Zero()));
  if (const char* fault = fault_of(inertia.principal, link)) {
    robot.ignored.push_back(
        fmt::format("link {}: its inertia, of which one principal moment is {}; that of its shapes "
                    "is taken, with its mass and centre of mass",
                    link.name, fault));
    return;
  }
  link.inertia = {Pose(frame.position(), frame.unit_orientation() * X_FC.orientation()),
                  inertia.principal};
}

void UnreadOfJoints::add(const char* property, double value, const std::string& joint) {
  if (value != 0 && std::isfinite(value)) joints_[property].push_back(joint);
}

void UnreadOfJoints::note(RobotFile& robot) const {
  constexpr std::size_t max_named = 3;
  for (const auto& [property, joints] : joints_) {
    const std::size_t count = joints.size();
    const bool names_all = count <= max_named + 1;
    const std::vector<std::string> named(joints.begin(),
                                         names_all ? joints.end() - 1 : joints.begin() + max_named);
    const std::string last =
        names_all ? joints.back() : fmt::format("{} others", count - max_named);
    robot.ignored.push_back(count == 1 ? fmt::format("{} of joint {}: not read", property, last)
                                       : fmt::format("{} of joints {} and {}: not read", property,
                                                     fmt::join(named, ", "), last));
  }
}

std::string library_complaint() { return library_log < 0 ? "" : complaint_in(library_log); }

void now_reading(const std::string& file) {
  if (library_log < 0 || ftruncate(library_log, 0) != 0) return;
  lseek(library_log, 0, SEEK_SET);  // also of standard error, which shares it
  const std::string text = "reading " + file + '\n';
  if (write(library_log, text.data(), text.size()) < 0) fail("write");
}

namespace {

/// Folders that a variable of the environment names, between colons; of these, folders below.
void add_folders(const char* variable, const char* below, Folders& folders) {
  const char* value = std::getenv(variable);
  std::istringstream names(value ? value : "");
  for (std::string name; std::getline(names, name, ':');) {
    if (!name.empty()) folders.push_back(std::filesystem::path(name) / below);
  }
}

}  // namespace

Folders resource_folders(const Folders& given, const std::filesystem::path& file) {
  Folders folders = given;
  for (const char* variable : {"SDF_PATH", "GZ_SIM_RESOURCE_PATH", "GAZEBO_MODEL_PATH",
                               "IGN_GAZEBO_RESOURCE_PATH", "ROS_PACKAGE_PATH"}) {
    add_folders(variable, "", folders);
  }
  add_folders("AMENT_PREFIX_PATH", "share", folders);
  for (std::filesystem::path& folder : folders) folder = std::filesystem::absolute(folder);
  std::filesystem::path here = std::filesystem::absolute(file).parent_path();
  folders.push_back(here);
  folders.push_back(here / "models");
  for (; here != here.parent_path(); here = here.parent_path()) {
    folders.push_back(here.parent_path());
  }
  return folders;
}

std::filesystem::path find_resource(const std::string& uri, const Folders& folders) {
  std::string name = uri;
  for (const char* scheme : {"model://", "package://", "file://"}) {
    if (name.starts_with(scheme)) name.erase(0, std::strlen(scheme));
  }
  std::error_code error;
  if (std::filesystem::path(name).is_absolute()) {
    return std::filesystem::exists(name, error) ? std::filesystem::path(name)
                                                : std::filesystem::path();
  }
  for (const std::filesystem::path& folder : folders) {
    if (std::filesystem::exists(folder / name, error)) return folder / name;
  }
  return {};
}

}  // namespace touchstone

extern "C" touchstone::ReadRobot* touchstone_robots() { return touchstone::read_as_bytes; }
