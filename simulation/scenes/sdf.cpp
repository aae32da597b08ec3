// The only file that includes libsdformat's headers, which take seconds to compile.
#include <algorithm>
#include <boost/property_tree/ptree.hpp>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <numbers>
#include <sdf/sdf.hh>
#include <set>

#include "properties/files/disk.hpp"
#include "properties/files/given_text.hpp"
#include "reference/invalid_input.hpp"
#include "simulation/scenes/mesh.hpp"

namespace touchstone {
namespace {

using boost::property_tree::ptree;
using ignition::math::Pose3d;

void refuse(const sdf::Errors& errors, const std::string& field) {
  if (errors.empty()) return;
  throw InvalidInput(field, "not usable", errors.front().Message());
}

/// The first error that leaves something unread; null if there is none. An inertia that no body can
/// have is read all the same, though with it a whole world counts as not loaded.
const sdf::Error* first_fault(const sdf::Errors& errors) {
  bool has_inertia = false;
  for (const sdf::Error& error : errors) {
    const bool is_of_inertia = error.Code() == sdf::ErrorCode::LINK_INERTIA_INVALID;
    has_inertia = has_inertia || is_of_inertia;
    const bool follows = has_inertia && error.Message() == "Failed to load a world.";
    if (!is_of_inertia && !follows) return &error;
  }
  return nullptr;
}

Pose3d resolved(const sdf::SemanticPose& pose, const std::string& name,
                const std::string& in = "") {
  Pose3d result;
  refuse(pose.Resolve(result, in), name + ".pose");
  return result;
}

Vec3 to_vector(const ignition::math::Vector3d& v) { return {v.X(), v.Y(), v.Z()}; }

Pose to_pose(const Pose3d& p) {
  return {to_vector(p.Pos()),
          Eigen::Quaterniond(p.Rot().W(), p.Rot().X(), p.Rot().Y(), p.Rot().Z())};
}

/// Lengths in SDF are full lengths. Nothing for a heightmap.
std::optional<Shape> shape_of(const sdf::Geometry& geometry) {
  if (const auto* s = geometry.SphereShape()) return Sphere(s->Radius());
  if (const auto* s = geometry.CylinderShape()) return Cylinder(s->Radius(), s->Length() / 2);
  if (const auto* s = geometry.CapsuleShape()) return Capsule(s->Radius(), s->Length() / 2);
  if (const auto* s = geometry.BoxShape()) return Box(to_vector(s->Size()) / 2);
  if (const auto* s = geometry.PlaneShape()) return Plane(to_vector(s->Normal()), 0);
  return std::nullopt;
}

/// The element at a path below this one that the file itself has; null otherwise.
sdf::ElementPtr descendant(sdf::ElementPtr element, std::initializer_list<const char*> path) {
  for (const char* name : path) {
    if (!element || !element->HasElement(name)) return nullptr;
    element = element->GetElement(name);
  }
  return element;
}

void leave_out(const sdf::Geometry& geometry, const std::string& name, RobotFile& result) {
  ++result.left_out.shapes;
  if (const auto* s = geometry.EllipsoidShape()) {
    result.ignored.push_back(fmt::format("collision {}: an ellipsoid", name));
    const Vec3 r = to_vector(s->Radii());
    result.left_out.volume += 4 * std::numbers::pi / 3 * r.prod();
    return;
  }
  result.ignored.push_back(fmt::format("collision {}: a heightmap or another shape", name));
  ++result.left_out.unknown;
}

Mesh mesh_of(const sdf::Mesh& mesh, const Folders& folders) {
  if (!mesh.Submesh().empty()) {
    throw InvalidInput("mesh.submesh", '"' + printable(mesh.Submesh(), 60) + '"',
                       "must be left out: a mesh is read as a whole; save this part by itself");
  }
  return named_mesh(mesh.Uri(), to_vector(mesh.Scale()), mesh.FilePath(), folders);
}

/// Is the element at a path below this one in the file, and not false or zero?
bool is_set(const sdf::ElementPtr& element, std::initializer_list<const char*> path) {
  const sdf::ElementPtr found = descendant(element, path);
  if (!found) return false;
  const std::string text = found->GetValue() ? found->GetValue()->GetAsString() : "";
  return text != "false" && parse_double(text) != 0;
}

/// Reads what a collision says of its surface; adds what of that is not read.
void add_surface(const sdf::ElementPtr& collision, LinkShape& shape, RobotFile& result) {
  if (const auto mu = descendant(collision, {"surface", "friction", "ode", "mu"})) {
    shape.friction = mu->Get<double>();
  }
  constexpr int all_bits = 0xffff;  // Gazebo's default
  shape.mask = {all_bits, all_bits};
  if (const auto bits = descendant(collision, {"surface", "contact", "collide_bitmask"})) {
    const int given = static_cast<int>(bits->Get<unsigned int>());
    shape.mask = {given, given};
  }
  const auto unread = [&](const char* what) {
    result.ignored.push_back(fmt::format("collision {}: {}", shape.name, what));
  };
  if (is_set(collision, {"surface", "contact", "collide_without_contact"})) {
    unread("collide_without_contact is not read; it touches others");
  }
  if (is_set(collision, {"surface", "bounce", "restitution_coefficient"})) {
    unread("bounce is not read");
  }
}

void note_unread(const sdf::Link& link, const std::string& name, RobotFile& result) {
  const sdf::ElementPtr element = link.Element();
  const auto unread = [&](const char* what) {
    result.ignored.push_back(fmt::format("link {}: {}", name, what));
  };
  if (descendant(element, {"gravity"}) && !is_set(element, {"gravity"})) {
    unread("gravity is not read; it falls");
  }
  if (is_set(element, {"kinematic"})) unread("kinematic is not read; forces move it");
  if (is_set(element, {"enable_wind"})) unread("enable_wind is not read");
}

void add_link(const sdf::Link& link, const std::string& link_name, const Pose3d& X_WL,
              bool is_static, const Folders& folders, RobotFile& result) {
  Link made{link_name, to_pose(X_WL)};
  made.fixed = is_static;
  const auto& given = link.Inertial();
  made.mass = given.MassMatrix().Mass();  // 1 kg by default, as Gazebo has it
  for (std::uint64_t k = 0; k < link.CollisionCount(); ++k) {
    const sdf::Collision& collision = *link.CollisionByIndex(k);
    const std::string name = link_name + '/' + collision.Name();
    try {
      const Pose X_WC = to_pose(X_WL * resolved(collision.SemanticPose(), name));
      if (const sdf::Mesh* mesh = collision.Geom()->MeshShape()) {
        made.shapes.push_back(hull_of(mesh_of(*mesh, folders), mesh->Uri(), name, X_WC, result));
      } else if (const auto shape = shape_of(*collision.Geom())) {
        made.shapes.push_back({name, *shape, X_WC});
      } else {
        leave_out(*collision.Geom(), name, result);
        continue;
      }
      add_surface(collision.Element(), made.shapes.back(), result);
      // Gazebo's planes do not move, whatever the model.
      made.fixed = made.fixed || std::holds_alternative<Plane>(made.shapes.back().shape);
    } catch (const InvalidInput& e) {
      throw e.within("collision " + name);
    }
  }
  if (descendant(link.Element(), {"inertial", "inertia"})) {
    const ignition::math::Vector3d on = given.MassMatrix().DiagonalMoments();
    const ignition::math::Vector3d off = given.MassMatrix().OffDiagonalMoments();
    Eigen::Matrix3d moments;
    moments << on.X(), off.X(), off.Y(),  //
        off.X(), on.Y(), off.Z(),         //
        off.Y(), off.Z(), on.Z();
    set_inertia(made, to_pose(X_WL * given.Pose()), moments, result);
  } else if (*made.mass > 0 && descendant(link.Element(), {"inertial", "pose"})) {
    made.inertia = {to_pose(X_WL * given.Pose())};
  }
  if (!made.fixed) note_unread(link, link_name, result);
  result.links.push_back(std::move(made));
}

const char* other_type(sdf::JointType type) {
  switch (type) {
    case sdf::JointType::BALL:
      return "ball";
    case sdf::JointType::UNIVERSAL:
      return "universal";
    case sdf::JointType::SCREW:
      return "screw";
    case sdf::JointType::GEARBOX:
      return "gearbox";
    case sdf::JointType::REVOLUTE2:
      return "revolute2";
    default:
      return "of an unknown type";
  }
}

/// Limits beyond which SDF has none.
constexpr double no_limit = 1e15;

/// Notes what of a joint's axis is not read.
void note_unread(const sdf::JointAxis& axis, const std::string& joint, UnreadOfJoints& unread) {
  unread.add("damping", axis.Damping(), joint);
  unread.add("friction", axis.Friction(), joint);
  unread.add("the spring", axis.SpringStiffness(), joint);
  const double speed = axis.MaxVelocity();
  if (speed >= 0 && speed < no_limit) unread.add("the largest speed", speed, joint);
}

void add_axis(const sdf::Joint& joint, const Pose3d& X_WJ, LinkJoint& made) {
  const sdf::JointAxis* axis = joint.Axis();
  if (!axis) throw InvalidInput("joint " + made.name + ".axis", "missing", "must be there");
  ignition::math::Vector3d direction;
  refuse(axis->ResolveXyz(direction), "joint " + made.name + ".axis");
  made.anchor = to_vector(X_WJ.Pos());
  made.axis = to_vector(X_WJ.Rot() * direction);
  const bool is_limited = joint.Type() != sdf::JointType::CONTINUOUS;
  made.lower = !is_limited || axis->Lower() <= -no_limit ? -infinity : axis->Lower();
  made.upper = !is_limited || axis->Upper() >= no_limit ? infinity : axis->Upper();
  if (axis->Effort() > 0 && axis->Effort() < no_limit) made.effort = axis->Effort();
}

void add_joint(const sdf::Joint& joint, const std::string& path, const Pose3d& X_WM,
               RobotFile& result) {
  LinkJoint made;
  made.name = path + "::" + joint.Name();
  const std::string field = "joint " + made.name;
  std::string parent, child;
  refuse(joint.ResolveParentLink(parent), field + ".parent");
  refuse(joint.ResolveChildLink(child), field + ".child");
  const auto index = [&](const std::string& link) {
    if (link == "world") return world_body;
    const std::string full = path + "::" + link;
    const auto is_it = [&](const Link& l) { return l.name == full; };
    const auto at = std::ranges::find_if(result.links, is_it);
    if (at == result.links.end()) {
      throw InvalidInput(field, '"' + printable(link, 60) + '"', "must join links of the model");
    }
    return static_cast<int>(at - result.links.begin());
  };
  made.parent = index(parent);
  made.child = index(child);
  if (made.child == world_body) std::swap(made.child, made.parent);
  const Pose3d X_WJ = X_WM * resolved(joint.SemanticPose(), field, "__model__");
  switch (joint.Type()) {
    case sdf::JointType::FIXED:
      break;
    case sdf::JointType::REVOLUTE:
    case sdf::JointType::CONTINUOUS:
      made.kind = JointKind::hinge;
      add_axis(joint, X_WJ, made);
      break;
    case sdf::JointType::PRISMATIC:
      made.kind = JointKind::slider;
      add_axis(joint, X_WJ, made);
      break;
    default:
      result.ignored.push_back(
          fmt::format("joint {}: {}; taken as fixed", made.name, other_type(joint.Type())));
  }
  result.joints.push_back(std::move(made));
}

void add_model(const sdf::Model& model, const std::string& outer, const Pose3d& X_WO,
               bool is_static, const Folders& folders, RobotFile& result) {
  const std::string path = outer + model.Name();
  const Pose3d X_WM = X_WO * resolved(model.SemanticPose(), path);
  is_static = is_static || model.Static();
  if (descendant(model.Element(), {"self_collide"}) && !model.SelfCollide()) {
    result.ignored.push_back(
        fmt::format("model {}: self_collide is not read; its links touch each other", path));
  }
  for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
    const sdf::Link& link = *model.LinkByIndex(i);
    const std::string name = path + "::" + link.Name();
    add_link(link, name, X_WM * resolved(link.SemanticPose(), name), is_static, folders, result);
  }
  for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
    add_model(*model.ModelByIndex(i), path + "::", X_WM, is_static, folders, result);
  }
  for (std::uint64_t i = 0; i < model.JointCount(); ++i) {
    add_joint(*model.JointByIndex(i), path, X_WM, result);
  }
}

/// Adds elements that have no part in contacts.
void note_ignored_elements(const sdf::ElementPtr& element, RobotFile& result) {
  static const std::set<std::string> ignored = {"plugin", "sensor", "actor",   "wind",
                                                "light",  "state",  "physics", "population"};
  for (auto child = element->GetFirstElement(); child; child = child->GetNextElement()) {
    const bool is_default = child->GetName() == "physics" && !child->GetExplicitlySetInFile();
    if (ignored.contains(child->GetName()) && !is_default) {
      std::string name = "without a name";
      for (const char* attribute : {"name", "world_name"}) {
        if (child->HasAttribute(attribute)) name = child->Get<std::string>(attribute);
      }
      result.ignored.push_back(fmt::format("{} {}: not read", child->GetName(), name));
    } else {
      note_ignored_elements(child, result);
    }
  }
}

/// Calls f(path, joint) for each joint of a model and of those in it.
template <class F>
void each_joint(const sdf::Model& model, const std::string& outer, F f) {
  const std::string path = outer + model.Name() + "::";
  for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
    each_joint(*model.ModelByIndex(i), path, f);
  }
  for (std::uint64_t i = 0; i < model.JointCount(); ++i) f(path, *model.JointByIndex(i));
}

void note_unread_of_joints(const sdf::Root& root, RobotFile& result) {
  UnreadOfJoints unread;
  const auto note = [&](const std::string& path, const sdf::Joint& joint) {
    if (joint.Axis()) note_unread(*joint.Axis(), path + joint.Name(), unread);
  };
  if (root.Model()) each_joint(*root.Model(), "", note);
  for (std::uint64_t w = 0; w < root.WorldCount(); ++w) {
    const sdf::World& world = *root.WorldByIndex(w);
    for (std::uint64_t i = 0; i < world.ModelCount(); ++i) {
      each_joint(*world.ModelByIndex(i), "", note);
    }
  }
  unread.note(result);
}

/// Checks a file and what it includes, each before libsdformat reads it.
class IncludedFiles {
 public:
  explicit IncludedFiles(const Folders& folders) : folders_(folders) {}

  void check(const std::filesystem::path& file) {
    const std::filesystem::path here = std::filesystem::weakly_canonical(file);
    if (std::ranges::find(open_, here) != open_.end()) {
      throw InvalidInput("include", '"' + here.string() + '"',
                         "must not include itself, directly or through others");
    }
    if (!done_.insert(here).second) return;
    open_.push_back(here);
    const bool is_first = open_.size() == 1;
    const ptree tree = parse_xml(read_xml(here), here);
    try {
      check_sdf_collisions(tree, sdf::SDF::Version());
    } catch (const InvalidInput& e) {
      if (is_first) throw;
      throw InvalidInput(here.string() + ": " + e.field(), e.value(), e.remedy());
    }
    check_includes(tree);
    open_.pop_back();
  }

 private:
  void check_includes(const ptree& element) {
    for (const auto& [tag, content] : element) {
      if (tag != "include") {
        check_includes(content);
        continue;
      }
      check_include(content.get<std::string>("uri", ""));
    }
  }

  void check_include(const std::string& given) {
    const std::size_t first = given.find_first_not_of(" \t\r\n");
    const std::size_t last = given.find_last_not_of(" \t\r\n");
    const std::string uri = first == given.npos ? "" : given.substr(first, last - first + 1);
    const std::string shown = '"' + printable(uri, 200) + '"';
    if (uri.starts_with("http://") || uri.starts_with("https://")) {
      throw InvalidInput("include.uri", shown,
                         "must be on this machine: download the model and name its folder with "
                         "--model-path");
    }
    std::filesystem::path model = uri.empty() ? "" : find_resource(uri, folders_);
    if (model.empty()) {
      throw InvalidInput("include.uri", shown,
                         "must name a model in a folder of --model-path, SDF_PATH, "
                         "GZ_SIM_RESOURCE_PATH or GAZEBO_MODEL_PATH, or beside the file");
    }
    if (is_folder(model)) {
      const std::string file = sdf::getModelFilePath(model.string());
      if (file.empty() || !is_file(file)) {
        throw InvalidInput(
            "include.uri", shown,
            "must be a folder with model.config and the SDF file that it names: " + model.string());
      }
      model = file;
    }
    const std::string text = read_xml(model);
    if (text.find("<sdf") == text.npos) {
      throw InvalidInput("include.uri", shown, "must be an SDF model, not " + model.string());
    }
    check(model);
  }

  const Folders& folders_;
  std::vector<std::filesystem::path> open_;
  std::set<std::filesystem::path> done_;
};

}  // namespace

RobotFile read_sdf(const std::filesystem::path& file, const Folders& given) {
  const Folders folders = resource_folders(given, file);
  // By a relative name libsdformat finds its own description first, which has one of world.sdf and
  // model.sdf.
  const std::filesystem::path here = std::filesystem::absolute(file);
  IncludedFiles(folders).check(here);

  // libsdformat looks there before it asks, also for files that were not checked. This process is
  // for this file alone.
  unsetenv("SDF_PATH");
  std::filesystem::current_path("/");
  sdf::ParserConfig config;
  config.SetFindCallback(
      [&](const std::string& uri) { return find_resource(uri, folders).string(); });
  sdf::Root root;
  const sdf::Errors errors = root.Load(here.string(), config);
  if (const sdf::Error* error = first_fault(errors)) {
    std::string reason = error->Message();
    const std::string complaint = library_complaint();
    const bool is_vague = reason.starts_with("Error reading element");
    if (is_vague && !complaint.empty()) reason += "; its reader says: " + complaint;
    throw InvalidInput("scene", '"' + file.string() + '"', "must be SDF: " + reason);
  }
  RobotFile result;
  result.name = file.stem().string();
  if (const sdf::Model* model = root.Model()) {
    result.name = model->Name();
    add_model(*model, "", Pose3d::Zero, false, folders, result);
  }
  if (root.WorldCount() > 0) {
    const sdf::World& world = *root.WorldByIndex(0);
    result.name = world.Name();
    result.is_world = true;
    result.gravity = to_vector(world.Gravity());
    for (std::uint64_t i = 0; i < world.ModelCount(); ++i) {
      add_model(*world.ModelByIndex(i), "", Pose3d::Zero, false, folders, result);
    }
  }
  for (std::uint64_t w = 1; w < root.WorldCount(); ++w) {
    result.ignored.push_back(
        fmt::format("world {}: not read, only the first is", root.WorldByIndex(w)->Name()));
  }
  note_ignored_elements(root.Element(), result);
  note_unread_of_joints(root, result);
  return result;
}

}  // namespace touchstone
