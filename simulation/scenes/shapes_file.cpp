#include <boost/property_tree/xml_parser.hpp>
#include <exception>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <sstream>
#include <urdf_parser/urdf_parser.h>

#include "candidates/host/plugin_process.hpp"
#include "properties/files/given_text.hpp"
#include "reference/invalid_input.hpp"
#include "simulation/scenes/scene_file.hpp"

namespace touchstone {
namespace {

Eigen::Isometry3d isometry(const urdf::Pose& pose) {
  Eigen::Quaterniond q;
  pose.rotation.getQuaternion(q.x(), q.y(), q.z(), q.w());
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.translate(Vec3(pose.position.x, pose.position.y, pose.position.z));
  result.rotate(q);
  return result;
}

/// Lengths in URDF are full lengths. Nothing for a mesh.
std::optional<Shape> shape_of(const urdf::Geometry& geometry) {
  switch (geometry.type) {
    case urdf::Geometry::SPHERE:
      return Sphere(static_cast<const urdf::Sphere&>(geometry).radius);
    case urdf::Geometry::BOX: {
      const urdf::Vector3& side = static_cast<const urdf::Box&>(geometry).dim;
      return Box(Vec3(side.x, side.y, side.z) / 2);
    }
    case urdf::Geometry::CYLINDER: {
      const auto& c = static_cast<const urdf::Cylinder&>(geometry);
      return Cylinder(c.radius, c.length / 2);
    }
    default:
      return std::nullopt;
  }
}

void add_link(const urdf::Link& link, const Eigen::Isometry3d& X_RL, int joints_from_root,
              ShapesFile& result) {
  constexpr int max_joints = 1000;
  if (joints_from_root > max_joints) {
    throw InvalidInput("link", '"' + link.name + '"',
                       fmt::format("must be at most {} joints from the root", max_joints));
  }
  for (std::size_t i = 0; i < link.collision_array.size(); ++i) {
    const urdf::Collision& collision = *link.collision_array[i];
    const std::string name =
        link.name + '/' + (collision.name.empty() ? std::to_string(i + 1) : collision.name);
    if (!collision.geometry) continue;
    try {
      const auto shape = shape_of(*collision.geometry);
      if (!shape) {
        result.ignored.push_back(fmt::format("collision {}: a mesh", name));
        continue;
      }
      const Eigen::Isometry3d X_RC = X_RL * isometry(collision.origin);
      result.shapes.push_back(
          {name, link.name, *shape, {X_RC.translation(), Eigen::Quaterniond(X_RC.rotation())}});
    } catch (const InvalidInput& e) {
      throw e.within("collision " + name);
    }
  }
  for (std::size_t i = 0; i < link.child_joints.size(); ++i) {
    const urdf::Joint& joint = *link.child_joints[i];
    result.joined.insert({joint.parent_link_name, joint.child_link_name});
    if (joint.type != urdf::Joint::FIXED) {
      result.ignored.push_back(fmt::format("joint {}: held in its default position", joint.name));
    }
    const Eigen::Isometry3d origin = isometry(joint.parent_to_joint_origin_transform);
    add_link(*link.child_links[i], X_RL * origin, joints_from_root + 1, result);
  }
}

/// Adds what the parser silently passes over.
void note_ignored_elements(const std::string& text, ShapesFile& result) {
  std::istringstream in(text);
  boost::property_tree::ptree tree;
  boost::property_tree::read_xml(in, tree);
  for (const auto& [element, content] : tree.get_child("robot")) {
    if (element == "link" || element == "joint" || element == "material" || element[0] == '<') {
      continue;
    }
    const auto name = content.get_optional<std::string>("<xmlattr>.name");
    const auto reference = content.get_optional<std::string>("<xmlattr>.reference");
    result.ignored.push_back(fmt::format("{} {}: not read", element,
                                         name        ? *name
                                         : reference ? *reference
                                                     : std::string("of the whole robot")));
  }
}

}  // namespace

ShapesFile read_urdf(const std::filesystem::path& file) {
  const std::string text = read_xml(file);
  if (text.find('%') != text.npos) {
    // urdfdom 3.0.1 passes what it complains of to printf as the format: "%n" ends the process.
    throw InvalidInput("scene", '"' + file.string() + '"',
                       "must not hold a percent sign, which its reader takes for a format");
  }
  std::map<std::string, std::size_t> collision_counts;
  try {
    collision_counts = check_urdf_collisions(text);
  } catch (const boost::property_tree::xml_parser_error&) {
    // Not XML: urdfdom says more of it.
  }
  const urdf::ModelInterfaceSharedPtr robot = urdf::parseURDF(text);
  if (!robot || !robot->getRoot()) {
    throw InvalidInput("scene", '"' + file.string() + '"',
                       "must be a URDF robot; the lines above say what is wrong");
  }
  for (const auto& [name, count] : collision_counts) {
    const auto link = robot->getLink(name);
    const std::size_t read = link ? link->collision_array.size() : 0;
    if (read == count) continue;  // of a link with a faulty origin or visual it drops collisions
    throw InvalidInput("link " + name, fmt::format("read with {} of {} collisions", read, count),
                       "the lines above say what is wrong in it");
  }
  ShapesFile result;
  result.name = robot->getName();
  add_link(*robot->getRoot(), Eigen::Isometry3d::Identity(), 0, result);
  note_ignored_elements(text, result);
  return result;
}

bool is_shapes_file(const std::filesystem::path& file) {
  const auto ending = file.extension();
  return ending == ".urdf" || ending == ".sdf" || ending == ".world";
}

ShapesFile read_shapes(const std::filesystem::path& file) {
  ShapesFile shapes;
  try {
    shapes = file.extension() == ".urdf" ? read_urdf(file) : read_sdf(file);
  } catch (const InvalidInput& e) {
    if (e.field() == "scene") throw;  // names the file already
    throw InvalidInput(file.string() + ": " + e.field(), e.value(), e.remedy());
  } catch (const std::exception& e) {  // thrown by the libraries
    constexpr std::size_t max_reason = 200;
    throw InvalidInput(
        "scene", '"' + file.string() + '"',
        "must be a URDF or SDF file; its reader says: " + printable(e.what(), max_reason));
  }
  constexpr std::size_t max_shapes = 2000;  // all pairs are tested
  if (shapes.shapes.size() > max_shapes) {
    throw InvalidInput("scene", '"' + file.string() + '"',
                       fmt::format("must have at most {} collision shapes, not {}", max_shapes,
                                   shapes.shapes.size()));
  }
  check_printable(file.string() + ": name", shapes.name);
  for (const PlacedShape& s : shapes.shapes) {
    check_printable(file.string() + ": collision", s.name);
    check_printable(file.string() + ": link", s.link);
  }
  for (std::string& note : shapes.ignored) note = readable(note);
  return shapes;
}

SceneFile still_scene(const ShapesFile& shapes) {
  SceneFile file;
  file.name = shapes.name;
  file.scene.duration = 0;
  for (std::size_t i = 0; i < shapes.shapes.size(); ++i) {
    const PlacedShape& s = shapes.shapes[i];
    Body body{fmt::format("{} {}", i + 1, s.name), s.shape};
    body.pose = s.pose;
    body.fixed = true;
    file.scene.bodies.push_back(body);
  }
  check_scene(file.scene);
  file.camera = camera_for(file.scene);
  return file;
}

}  // namespace touchstone
