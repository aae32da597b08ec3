#include "simulation/engines/mujoco_xml.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace touchstone {
namespace {

/// The attributes `pos` and `quat`, unless they are MuJoCo's defaults.
std::string pose_xml(const Pose& pose) {
  const Vec3& p = pose.position();
  const Eigen::Quaterniond q = pose.unit_orientation();
  std::string xml;
  if (!p.isZero(0)) xml += fmt::format(" pos='{} {} {}'", p.x(), p.y(), p.z());
  if (!q.vec().isZero(0)) xml += fmt::format(" quat='{} {} {} {}'", q.w(), q.x(), q.y(), q.z());
  return xml;
}

/// The attributes `type`, `size` and those of the pose. MuJoCo's plane is solid below its xy-plane.
struct GeomXml {
  const Pose& X_FB;

  std::string operator()(const Cylinder& s) const {
    return fmt::format("type='cylinder' size='{} {}'", s.radius(), s.half_length()) +
           pose_xml(X_FB);
  }
  std::string operator()(const Plane& s) const {
    const Vec3 n = X_FB.rotation() * s.unit_normal();
    const Vec3 p = X_FB.position() + s.unit_displacement() * n;
    return fmt::format("type='plane' size='0 0 1' pos='{} {} {}' zaxis='{} {} {}'", p.x(), p.y(),
                       p.z(), n.x(), n.y(), n.z());
  }
  std::string operator()(const Sphere& s) const {
    return fmt::format("type='sphere' size='{}'", s.radius()) + pose_xml(X_FB);
  }
  std::string operator()(const Capsule& s) const {
    return fmt::format("type='capsule' size='{} {}'", s.radius(), s.half_length()) + pose_xml(X_FB);
  }
  std::string operator()(const Box& s) const {
    const Vec3& h = s.half_extents();
    return fmt::format("type='box' size='{} {} {}'", h.x(), h.y(), h.z()) + pose_xml(X_FB);
  }
};

/// Options and defaults of a world whose contacts are as hard as the step allows: by MuJoCo's
/// documentation the time constant of a contact has to be two steps at least.
std::string best_xml(double step) {
  return fmt::format(
      "<option cone='elliptic' impratio='10'/><default><geom solref='{} 1' "
      "solimp='0.99 0.999 0.001'/></default>",
      2 * step);
}

/// Mass of a driven body as a multiple of all free ones': the share of an impulse that moves it.
constexpr double driven_mass_ratio = 1e6;

class Model {
 public:
  Model(const Scene& scene, const std::vector<Assembly>& assemblies,
        const std::vector<Hanging>& tree, const EngineSetup& setup)
      : scene_(scene), assemblies_(assemblies), tree_(tree), setup_(setup) {
    for (const Assembly& a : assemblies) mass_ += a.inertia.mass;
  }

  std::string xml() {
    std::string bodies;
    for (std::size_t i = 0; i < assemblies_.size(); ++i) {
      if (tree_[i].parent < 0) bodies += body_xml(i);
    }
    // Room for contacts; MuJoCo's memory grows with the square of the rows, four to a contact.
    const std::size_t contacts = 16 * geoms_;
    const Vec3& g = scene_.gravity;
    const bool is_multipoint = setup_.has(EngineShape::Kind::multipoint);
    return fmt::format(
        "<mujoco><compiler angle='radian'/><option timestep='{}' gravity='{} {} {}'>{}</option>"
        "<size nconmax='{}' njmax='{}' nuser_geom='1'/>{}{}<worldbody>{}</worldbody>{}</mujoco>",
        scene_.step, g.x(), g.y(), g.z(), is_multipoint ? "<flag multiccd='enable'/>" : "",
        contacts, 4 * contacts + 2 * scene_.joints.size(),
        setup_.best_solver ? best_xml(scene_.step) : "",
        meshes_.empty() ? "" : "<asset>" + meshes_ + "</asset>", bodies,
        motors_.empty() ? "" : "<actuator>" + motors_ + "</actuator>");
  }

 private:
  std::string body_xml(std::size_t index) {
    const Assembly& assembly = assemblies_[index];
    const Hanging& hanging = tree_[index];
    const Pose pose = hanging.parent < 0
                          ? assembly.X_WF
                          : relative(assemblies_[hanging.parent].X_WF, assembly.X_WF);
    std::string xml = fmt::format("<body name='b{}'{}>", index, pose_xml(pose));
    if (!assembly.fixed) {
      xml += hanging.joint < 0 ? "<freejoint/>" : joint_xml(index);
      xml += inertia_xml(assembly);
    }
    for (std::size_t i = 0; i < assembly.bodies.size(); ++i) {
      for (const Piece& piece : pieces(assembly.bodies[i])) {
        xml += geom_xml(assembly.bodies[i], piece, shifted(assembly.X_FB[i], piece.centre));
      }
    }
    for (const int child : hanging.children) xml += body_xml(child);
    return xml + "</body>";
  }

  std::vector<Piece> pieces(int body) const {
    return touchstone::pieces(scene_.bodies[body], setup_.shape_of(body));
  }

  std::string inertia_xml(const Assembly& assembly) const {
    Inertia i = assembly.inertia;
    if (!assembly.is_free()) {
      const Body& body = scene_.bodies[assembly.driven];
      const Inertia one = inertia(body.shape, 1);
      i.mass = driven_mass_ratio * std::max(mass_, 1.0);
      i.principal.setConstant(i.mass / one.mass * one.principal.maxCoeff());
    }
    // MuJoCo takes no moment that is larger than the sum of the others, be it by rounding.
    constexpr double rounding = 1e-12;
    const Vec3 others = Vec3::Constant(i.principal.sum()) - i.principal;
    i.principal = i.principal.cwiseMin((1 - rounding) * others);
    return fmt::format("<inertial pos='0 0 0' mass='{}' diaginertia='{} {} {}'/>", i.mass,
                       i.principal.x(), i.principal.y(), i.principal.z());
  }

  std::string joint_xml(std::size_t index) {
    const Assembly& assembly = assemblies_[index];
    const int number = tree_[index].joint;
    const Joint& joint = scene_.joints[number];
    const auto is_in = [&](int body) { return std::ranges::count(assembly.bodies, body) > 0; };
    const Eigen::Matrix3d R_FW = assembly.X_WF.rotation().transpose();
    const Vec3 axis = R_FW * (is_in(joint.a) ? joint.axis : Vec3(-joint.axis));
    const Vec3 anchor = R_FW * (joint.anchor - assembly.X_WF.position());
    const bool turns = joint.kind == JointKind::hinge;
    std::string xml = fmt::format("<joint name='j{}' type='{}' axis='{} {} {}'", number,
                                  turns ? "hinge" : "slide", axis.x(), axis.y(), axis.z());
    if (turns) xml += fmt::format(" pos='{} {} {}'", anchor.x(), anchor.y(), anchor.z());
    if (std::isfinite(joint.lower) || std::isfinite(joint.upper)) {
      constexpr double min_range = 1e-9;  // rad or m; MuJoCo takes no empty one
      const double lower = std::max(joint.lower, -max_in_world);
      xml += fmt::format(" limited='true' range='{} {}'", lower,
                         std::clamp(joint.upper, lower + min_range, max_in_world));
    }
    if (joint.motor && joint.motor->max_force > 0) {
      motors_ += fmt::format(
          "<velocity name='j{0}' joint='j{0}' forcelimited='true' forcerange='-{1} {1}'/>", number,
          joint.motor->max_force);
    }
    return xml + "/>";
  }

  std::string geom_xml(int body, const Piece& piece, const Pose& X_FB) {
    ++geoms_;
    std::string shape;
    if (piece.corners.empty()) {
      shape = std::visit(GeomXml{X_FB}, piece.shape);
    } else {
      shape = fmt::format("type='mesh' mesh='m{}'", body) + pose_xml(X_FB);
      meshes_ += fmt::format("<mesh name='m{}' vertex='", body);
      for (const Vec3& v : piece.corners) meshes_ += fmt::format("{} {} {} ", v.x(), v.y(), v.z());
      meshes_ += "'/>";
    }
    return fmt::format("<geom {} friction='{} 0.005 0.0001' user='{}'/>", shape,
                       scene_.bodies[body].material.friction, body);
  }

  const Scene& scene_;
  const std::vector<Assembly>& assemblies_;
  const std::vector<Hanging>& tree_;
  const EngineSetup& setup_;
  double mass_ = 0;  ///< kg, of all free assemblies
  std::size_t geoms_ = 1;
  std::string meshes_, motors_;
};

}  // namespace

std::string mujoco_xml(const Scene& scene, const std::vector<Assembly>& assemblies,
                       const std::vector<Hanging>& tree, const EngineSetup& setup) {
  return Model(scene, assemblies, tree, setup).xml();
}

}  // namespace touchstone
