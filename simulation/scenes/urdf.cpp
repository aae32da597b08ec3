#include <boost/property_tree/ptree.hpp>
#include <fmt/format.h>
#include <set>
#include <sstream>
#include <urdf_parser/urdf_parser.h>

#include "properties/files/given_text.hpp"
#include "reference/invalid_input.hpp"
#include "simulation/scenes/mesh.hpp"

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

Pose to_pose(const Eigen::Isometry3d& X) {
  return {X.translation(), Eigen::Quaterniond(X.rotation())};
}

/// Lengths in URDF are full lengths. Not for a mesh.
Shape shape_of(const urdf::Geometry& geometry) {
  switch (geometry.type) {
    case urdf::Geometry::SPHERE:
      return Sphere(static_cast<const urdf::Sphere&>(geometry).radius);
    case urdf::Geometry::BOX: {
      const urdf::Vector3& side = static_cast<const urdf::Box&>(geometry).dim;
      return Box(Vec3(side.x, side.y, side.z) / 2);
    }
    default: {
      const auto& c = static_cast<const urdf::Cylinder&>(geometry);
      return Cylinder(c.radius, c.length / 2);
    }
  }
}

/// The file that is read, and where to look for what it names.
struct Source {
  std::filesystem::path file;
  Folders folders;
};

/// Adds a link's own shapes and mass.
int add_link(const urdf::Link& link, const Eigen::Isometry3d& X_RL, const Source& source,
             RobotFile& result) {
  Link made{link.name, to_pose(X_RL)};
  for (std::size_t i = 0; i < link.collision_array.size(); ++i) {
    const urdf::Collision& collision = *link.collision_array[i];
    const std::string name =
        link.name + '/' + (collision.name.empty() ? std::to_string(i + 1) : collision.name);
    if (!collision.geometry) continue;
    const Pose X_RC = to_pose(X_RL * isometry(collision.origin));
    try {
      if (collision.geometry->type == urdf::Geometry::MESH) {
        const auto& given = static_cast<const urdf::Mesh&>(*collision.geometry);
        const Mesh mesh = named_mesh(given.filename, {given.scale.x, given.scale.y, given.scale.z},
                                     source.file, source.folders);
        made.shapes.push_back(hull_of(mesh, given.filename, name, X_RC, result));
      } else {
        made.shapes.push_back({name, shape_of(*collision.geometry), X_RC});
      }
    } catch (const InvalidInput& e) {
      throw e.within("collision " + name);
    }
  }
  if (const auto& given = link.inertial) {
    made.mass = given->mass;
    Eigen::Matrix3d moments;
    moments << given->ixx, given->ixy, given->ixz,  //
        given->ixy, given->iyy, given->iyz,         //
        given->ixz, given->iyz, given->izz;
    set_inertia(made, to_pose(X_RL * isometry(given->origin)), moments, result);
  }
  result.links.push_back(std::move(made));
  return static_cast<int>(result.links.size()) - 1;
}

/// Notes what of a joint is not read.
void note_unread(const urdf::Joint& joint, UnreadOfJoints& unread) {
  if (joint.dynamics) {
    unread.add("damping", joint.dynamics->damping, joint.name);
    unread.add("friction", joint.dynamics->friction, joint.name);
  }
  if (joint.limits) unread.add("the largest speed", joint.limits->velocity, joint.name);
  unread.add("the safety controller", joint.safety ? 1 : 0, joint.name);
}

/// Adds the joint between two links that have been added; X_RJ is its frame.
void add_joint(const urdf::Joint& joint, int parent, int child, const Eigen::Isometry3d& X_RJ,
               RobotFile& result) {
  LinkJoint made;
  made.name = joint.name;
  made.child = child;
  made.parent = parent;
  switch (joint.type) {
    case urdf::Joint::FIXED:
      break;
    case urdf::Joint::REVOLUTE:
    case urdf::Joint::CONTINUOUS:
      made.kind = JointKind::hinge;
      break;
    case urdf::Joint::PRISMATIC:
      made.kind = JointKind::slider;
      break;
    case urdf::Joint::FLOATING:
      result.ignored.push_back(
          fmt::format("joint {}: floating, so that both links move freely", joint.name));
      return;
    default:
      result.ignored.push_back(fmt::format("joint {}: planar; taken as fixed", joint.name));
  }
  if (made.kind != JointKind::fixed) {
    made.anchor = X_RJ.translation();
    made.axis = X_RJ.rotation() * Vec3(joint.axis.x, joint.axis.y, joint.axis.z);
    made.lower = -infinity;
    made.upper = infinity;
    if (joint.limits) {
      if (joint.limits->effort > 0) made.effort = joint.limits->effort;
      if (joint.limits->effort < 0) {
        throw InvalidInput("joint " + joint.name + ".limit.effort",
                           fmt::format("{:g}", joint.limits->effort), "must not be negative");
      }
    }
    if (joint.limits && joint.type != urdf::Joint::CONTINUOUS) {
      made.lower = joint.limits->lower;
      made.upper = joint.limits->upper;
    }
    if (joint.mimic) {
      result.ignored.push_back(
          fmt::format("joint {}: its mimic of {} is not read; it moves by itself", joint.name,
                      joint.mimic->joint_name));
    }
  }
  result.joints.push_back(std::move(made));
}

void add_branch(const urdf::Link& link, const Eigen::Isometry3d& X_RL, int joints_from_root,
                const Source& source, RobotFile& result) {
  constexpr int max_joints = 1000;
  if (joints_from_root > max_joints) {
    throw InvalidInput("link", '"' + link.name + '"',
                       fmt::format("must be at most {} joints from the root", max_joints));
  }
  const int index = add_link(link, X_RL, source, result);
  for (std::size_t i = 0; i < link.child_joints.size(); ++i) {
    const urdf::Joint& joint = *link.child_joints[i];
    const Eigen::Isometry3d X_RJ = X_RL * isometry(joint.parent_to_joint_origin_transform);
    const int child = static_cast<int>(result.links.size());
    add_branch(*link.child_links[i], X_RJ, joints_from_root + 1, source, result);
    add_joint(joint, index, child, X_RJ, result);
  }
}

/// Gives the shapes of a link the friction of its `gazebo` element. Is there any?
bool read_friction(const boost::property_tree::ptree& gazebo, const std::string& name,
                   RobotFile& result) {
  auto text = gazebo.get_optional<std::string>("mu1.<xmlattr>.value");
  if (!text) text = gazebo.get_optional<std::string>("mu1");
  if (!text) return false;
  std::istringstream word(*text);
  std::string digits;
  word >> digits;
  const auto mu = parse_double(digits);
  if (!mu || *mu < 0) {
    throw InvalidInput("gazebo " + printable(name, 60) + ".mu1", '"' + printable(*text, 60) + '"',
                       "must be a number that is not negative");
  }
  for (Link& link : result.links) {
    if (link.name != name) continue;
    for (LinkShape& s : link.shapes) s.friction = mu;
  }
  return true;
}

/// Reads friction, and adds what the parser silently passes over.
void read_other_elements(const boost::property_tree::ptree& xml, RobotFile& result) {
  for (const auto& [element, content] : xml.get_child("robot")) {
    if (element == "link" || element == "joint" || element == "material" || element[0] == '<') {
      continue;
    }
    const auto name = content.get_optional<std::string>("<xmlattr>.name");
    const auto reference = content.get_optional<std::string>("<xmlattr>.reference");
    const bool has_friction =
        element == "gazebo" && reference && read_friction(content, *reference, result);
    result.ignored.push_back(fmt::format("{} {}: not read{}", element,
                                         name        ? *name
                                         : reference ? *reference
                                                     : std::string("of the whole robot"),
                                         has_friction ? " but for its mu1" : ""));
  }
}

/// A link that two joints hold would be read twice, and its own links four times, and so on.
void refuse_second_parents(const urdf::ModelInterface& robot) {
  std::set<std::string> children;
  for (const auto& [name, joint] : robot.joints_) {
    if (children.insert(joint->child_link_name).second) continue;
    throw InvalidInput("joint " + name + ".child", '"' + joint->child_link_name + '"',
                       "must be the child of no other joint: a URDF robot is a tree");
  }
}

/// Links in a circle of joints do not hang on the root: urdfdom keeps them to itself.
void refuse_missing_links(const urdf::ModelInterface& robot, const RobotFile& result) {
  std::set<std::string> found;
  for (const Link& link : result.links) found.insert(link.name);
  for (const auto& [name, link] : robot.links_) {
    if (found.contains(name)) continue;
    throw InvalidInput("link " + name, "in a circle of joints",
                       "must hang on link " + robot.getRoot()->name + " by joints, as in a tree");
  }
}

/// Throws InvalidInput with what urdfdom has printed.
[[noreturn]] void refuse(const std::string& field, const std::string& value,
                         const std::string& otherwise) {
  const std::string complaint = library_complaint();
  throw InvalidInput(field, value,
                     otherwise + (complaint.empty() ? "" : "; its reader says: " + complaint));
}

}  // namespace

RobotFile read_urdf(const std::filesystem::path& file, const Folders& folders) {
  const std::string text = read_xml(file);
  if (text.find('%') != text.npos) {
    // urdfdom 3.0.1 passes what it complains of to printf as the format: "%n" ends the process.
    throw InvalidInput("scene", '"' + file.string() + '"',
                       "must not hold a percent sign, which its reader takes for a format");
  }
  const boost::property_tree::ptree xml = parse_xml(text, file);
  const auto collision_counts = check_urdf_collisions(xml);
  const urdf::ModelInterfaceSharedPtr robot = urdf::parseURDF(text);
  if (!robot || !robot->getRoot()) {
    refuse("scene", '"' + file.string() + '"', "must be a URDF robot");
  }
  for (const auto& [name, count] : collision_counts) {
    const auto link = robot->getLink(name);
    const std::size_t read = link ? link->collision_array.size() : 0;
    if (read == count) continue;  // of a link with a faulty origin or visual it drops collisions
    refuse("link " + name, fmt::format("read with {} of {} collisions", read, count),
           "must be without a fault");
  }
  RobotFile result;
  result.name = robot->getName();
  refuse_second_parents(*robot);
  add_branch(*robot->getRoot(), Eigen::Isometry3d::Identity(), 0,
             {file, resource_folders(folders, file)}, result);
  refuse_missing_links(*robot, result);
  UnreadOfJoints unread;
  for (const auto& [name, joint] : robot->joints_) {
    if (joint->type != urdf::Joint::FIXED) note_unread(*joint, unread);
  }
  unread.note(result);
  // A root named so is the world, which holds the robot, as Gazebo and MoveIt read it.
  Link& root = result.links.front();
  root.fixed = root.name == "world";
  read_other_elements(xml, result);
  return result;
}

}  // namespace touchstone
