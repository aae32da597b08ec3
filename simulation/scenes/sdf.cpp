// The only file that includes libsdformat's headers, which take seconds to compile.
#include <filesystem>
#include <fmt/format.h>
#include <functional>
#include <sdf/sdf.hh>
#include <set>

#include "reference/invalid_input.hpp"
#include "simulation/scenes/scene_file.hpp"

namespace touchstone {
namespace {

using ignition::math::Pose3d;

void refuse(const sdf::Errors& errors, const std::string& field) {
  if (errors.empty()) return;
  throw InvalidInput(field, "not usable", errors.front().Message());
}

Pose3d resolved(const sdf::SemanticPose& pose, const std::string& name) {
  Pose3d result;
  refuse(pose.Resolve(result), name + ".pose");
  return result;
}

Pose to_pose(const Pose3d& p) {
  return {Vec3(p.Pos().X(), p.Pos().Y(), p.Pos().Z()),
          Eigen::Quaterniond(p.Rot().W(), p.Rot().X(), p.Rot().Y(), p.Rot().Z())};
}

/// Lengths in SDF are full lengths. Nothing for a mesh or a heightmap.
std::optional<Shape> shape_of(const sdf::Geometry& geometry) {
  if (const auto* s = geometry.SphereShape()) return Sphere(s->Radius());
  if (const auto* s = geometry.CylinderShape()) return Cylinder(s->Radius(), s->Length() / 2);
  if (const auto* s = geometry.CapsuleShape()) return Capsule(s->Radius(), s->Length() / 2);
  if (const auto* s = geometry.BoxShape()) {
    return Box(Vec3(s->Size().X(), s->Size().Y(), s->Size().Z()) / 2);
  }
  if (const auto* s = geometry.PlaneShape()) {
    return Plane(Vec3(s->Normal().X(), s->Normal().Y(), s->Normal().Z()), 0);
  }
  return std::nullopt;
}

void add_model(const sdf::Model& model, const std::string& outer, const Pose3d& X_WO,
               ShapesFile& result) {
  const std::string path = outer + model.Name();
  const Pose3d X_WM = X_WO * resolved(model.SemanticPose(), path);
  for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
    const sdf::Link& link = *model.LinkByIndex(i);
    const std::string link_name = path + "::" + link.Name();
    const Pose3d X_WL = X_WM * resolved(link.SemanticPose(), link_name);
    for (std::uint64_t k = 0; k < link.CollisionCount(); ++k) {
      const sdf::Collision& collision = *link.CollisionByIndex(k);
      const std::string name = link_name + '/' + collision.Name();
      try {
        const auto shape = shape_of(*collision.Geom());
        if (!shape) {
          result.ignored.push_back(
              fmt::format("collision {}: a mesh, a heightmap or another shape", name));
          continue;
        }
        const Pose3d X_WC = X_WL * resolved(collision.SemanticPose(), name);
        result.shapes.push_back({name, link_name, *shape, to_pose(X_WC), model.Static()});
      } catch (const InvalidInput& e) {
        throw e.within("collision " + name);
      }
    }
  }
  for (std::uint64_t i = 0; i < model.JointCount(); ++i) {
    const sdf::Joint& joint = *model.JointByIndex(i);
    std::string parent, child;
    refuse(joint.ResolveParentLink(parent), path + "::" + joint.Name());
    refuse(joint.ResolveChildLink(child), path + "::" + joint.Name());
    const auto full = [&](const std::string& link) {
      return link == "world" ? link : path + "::" + link;
    };
    result.joined.insert({full(parent), full(child)});
    if (joint.Type() != sdf::JointType::FIXED) {
      result.ignored.push_back(
          fmt::format("joint {}::{}: held in its default position", path, joint.Name()));
    }
  }
  for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
    add_model(*model.ModelByIndex(i), path + "::", X_WM, result);
  }
}

/// Adds elements that have no part in contacts.
void note_ignored_elements(const sdf::ElementPtr& element, ShapesFile& result) {
  static const std::set<std::string> ignored = {"plugin", "sensor", "actor", "wind"};
  for (auto child = element->GetFirstElement(); child; child = child->GetNextElement()) {
    if (ignored.contains(child->GetName())) {
      const std::string name = child->HasAttribute("name") ? child->Get<std::string>("name")
                                                           : std::string("without a name");
      result.ignored.push_back(fmt::format("{} {}: not read", child->GetName(), name));
    } else {
      note_ignored_elements(child, result);
    }
  }
}

/// Adds the files that the element and those within it were read from.
void add_files(const sdf::ElementPtr& element, std::set<std::filesystem::path>& files) {
  files.insert(element->FilePath());
  for (auto child = element->GetFirstElement(); child; child = child->GetNextElement()) {
    add_files(child, files);
  }
}

/// Checks the collisions of the models that a file includes.
void check_included(const sdf::Root& root, const std::filesystem::path& file) {
  std::set<std::filesystem::path> files;
  add_files(root.Element(), files);
  for (const std::filesystem::path& included : files) {
    if (included.extension() != ".sdf" || std::filesystem::equivalent(included, file)) continue;
    try {
      check_sdf_collisions(read_xml(included), sdf::SDF::Version());
    } catch (const InvalidInput& e) {
      throw InvalidInput(included.string() + ": " + e.field(), e.value(), e.remedy());
    }
  }
}

}  // namespace

ShapesFile read_sdf(const std::filesystem::path& file) {
  const std::string text = read_xml(file);
  sdf::Root root;
  // By a relative name libsdformat finds its own description first, which has one of world.sdf and
  // model.sdf.
  const sdf::Errors errors = root.Load(std::filesystem::absolute(file).string());
  if (!errors.empty()) {
    throw InvalidInput("scene", '"' + file.string() + '"',
                       "must be SDF: " + errors.front().Message());
  }
  check_sdf_collisions(text, sdf::SDF::Version());
  check_included(root, file);
  ShapesFile result;
  result.name = file.stem().string();
  if (const sdf::Model* model = root.Model()) {
    result.name = model->Name();
    add_model(*model, "", Pose3d::Zero, result);
  }
  for (std::uint64_t w = 0; w < root.WorldCount(); ++w) {
    const sdf::World& world = *root.WorldByIndex(w);
    result.name = world.Name();
    for (std::uint64_t i = 0; i < world.ModelCount(); ++i) {
      add_model(*world.ModelByIndex(i), "", Pose3d::Zero, result);
    }
  }
  note_ignored_elements(root.Element(), result);
  return result;
}

}  // namespace touchstone
