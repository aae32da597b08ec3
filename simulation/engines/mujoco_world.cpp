// MuJoCo 2.2.2's own world.
//
// World     A model made from XML, mj_step. All options are MuJoCo's defaults but for the time
//           step: Newton solver, pyramidal friction cones, condim 3, semi-implicit Euler. Its
//           contacts are soft (solref 0.02 1, solimp 0.9 0.95 0.001): a body at rest sinks in by
//           about g τ² (1 − d) = 0.2 mm (τ = 0.02 s, d = 0.95), and one that friction holds creeps.
//           At its best: as hard as the step allows (solref two steps, solimp 0.99 0.999),
//           elliptic cones, impratio 10.
// Shapes    cylinder, box, capsule, sphere with half lengths; a plane is infinite. A hull is a mesh
//           asset, and so is a convex body that is not flat; a floor of triangles is an hfield
//           without heights. Spheres, and bodies that fixed joints connect, are several geoms of
//           one body.
// Masses    Inertia of the exact bodies. MuJoCo takes the larger friction of two bodies.
// Joints    The tree of MuJoCo's users (SceneXml): hinge and slide, with limits as soft as
//           contacts. What may touch is decided in mjcb_contactfilter.
// Motors    Velocity actuators with a force range. Their gain is the largest with which the
//           explicit step does not overshoot; what a load takes of the rate is integrated.
// Drives    A free body so heavy that no contact stops it, whose pose is set before each step, and
//           which a force gives its velocity: contacts with a mocap body know nothing of its
//           velocity, and what hangs on a body whose velocity is set would be carried along.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <mujoco/mujoco.h>
#include <string>

#include "candidates/mujoco_library.hpp"
#include "reference/engines/mujoco.hpp"
#include "simulation/engines/engine_world.hpp"
#include "simulation/kinematic_tree.hpp"

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
  std::string operator()(const Convex&) const { return ""; }  // a piece with corners
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

/// A scene as MuJoCo reads it. Assembly i is the body "b<i>", a hinge or slider j the joint "j<j>",
/// and its motor the actuator of that name; a geom's user data are the index of its body in the
/// scene.
///
/// A free or driven assembly has a freejoint, unless it hangs on another one or the world: then it
/// is nested, and its joint's position is that of the scene's joint. A driven one is so heavy that
/// no contact stops it, and its inertia is that of a ball.
class SceneXml {
 public:
  SceneXml(const Scene& scene, const std::vector<Assembly>& assemblies,
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
      const Inertia one = inertia(body.shape, 1).inertia;
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
    if (piece.squares > 0) {
      // Solid below its frame's xy-plane, down to its base.
      const Vec3 half = std::get<Box>(piece.shape).half_extents();
      shape = fmt::format("type='hfield' hfield='h{}'", body) +
              pose_xml(shifted(X_FB, half.z() * Vec3::UnitZ()));
      meshes_ += fmt::format("<hfield name='h{0}' nrow='{1}' ncol='{1}' size='{2} {3} 1 {4}'/>",
                             body, piece.squares + 1, half.x(), half.y(), 2 * half.z());
    } else if (piece.corners.empty()) {
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

class MujocoWorld : public EngineWorld {
 public:
  MujocoWorld(const Scene& scene, const EngineSetup& setup)
      : EngineWorld(scene, setup),
        tree_(kinematic_tree(scene, assemblies_)),
        model_(load_mjcf(SceneXml(scene, assemblies_, tree_, setup).xml())),
        data_(mj_makeData(model_)),
        integrals_(scene.joints.size()) {
    mjcb_contactfilter = keeps_apart;
    for (std::size_t i = 0; i < assemblies_.size(); ++i) {
      bodies_.push_back(id(mjOBJ_BODY, fmt::format("b{}", i)));
      if (is_root(i)) set_velocity(i, start_of(i));
    }
    update_tree();
  }
  ~MujocoWorld() override {
    mj_deleteData(data_);
    mj_deleteModel(model_);
  }
  MujocoWorld(const MujocoWorld&) = delete;
  MujocoWorld& operator=(const MujocoWorld&) = delete;

  Contacts contacts() const override { return {data_->ncon}; }

 protected:
  void advance() override {
    stepping = this;
    mj_step(model_, data_);
    std::fill_n(data_->xfrc_applied, 6 * model_->nbody, 0.0);
    update_tree();
    const bool was_reset = data_->warning[mjWARN_BADQPOS].number > 0 ||
                           data_->warning[mjWARN_BADQVEL].number > 0 ||
                           data_->warning[mjWARN_BADQACC].number > 0;
    for (std::size_t i = 0; i < assemblies_.size(); ++i) {
      if (!assemblies_[i].is_free()) continue;
      const double *p = &data_->xpos[3 * bodies_[i]], *q = &data_->xquat[4 * bodies_[i]];
      Vec3 velocity, angular_velocity;
      if (is_root(i)) {  // not yet in xpos and xquat unless there is a tree
        p = position_of(i), q = p + 3;
        angular_velocity = Vec3(velocity_of(i) + 3);
        velocity = Vec3(velocity_of(i));
        angular_velocity =
            Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized() * angular_velocity;
      } else {
        std::array<double, 6> both;
        mj_objectVelocity(model_, data_, mjOBJ_BODY, static_cast<int>(bodies_[i]), both.data(), 0);
        angular_velocity = Vec3(both.data());
        velocity = Vec3(both.data() + 3);
      }
      const Vec3 position = was_reset ? Vec3::Constant(2 * max_in_world) : Vec3(p);
      set_state(i, position, {q[0], q[1], q[2], q[3]}, velocity, angular_velocity);
    }
  }

  void drive(std::size_t assembly, const BodyState& state, const Pose&) override {
    double* const q = position_of(assembly);
    const Eigen::Quaterniond turn = state.pose.unit_orientation();
    const Vec3 before(velocity_of(assembly));
    const Vec3 spin_before = turn * Vec3(velocity_of(assembly) + 3);
    mju_copy3(q, state.pose.position().data());
    q[3] = turn.w(), q[4] = turn.x(), q[5] = turn.y(), q[6] = turn.z();
    const double mass = model_->body_mass[bodies_[assembly]];
    const double moment = model_->body_inertia[3 * bodies_[assembly]];
    push(assembly, mass * ((state.velocity - before) / scene_.step - scene_.gravity),
         moment / scene_.step * (state.angular_velocity - spin_before));
  }

  void push(std::size_t assembly, const Vec3& force, const Vec3& torque) override {
    double* const on_body = &data_->xfrc_applied[6 * bodies_[assembly]];
    mju_addTo3(on_body, force.data());
    mju_addTo3(on_body + 3, torque.data());
  }

  void prepare_joint(std::size_t joint, double time) override {
    constexpr double integrated_share = 0.1;  // of the rate's error, per step
    const Joint& driven = scene_.joints[joint];
    if (!driven.motor || driven.motor->max_force <= 0) return;
    const std::string name = fmt::format("j{}", joint);
    const std::size_t motor = id(mjOBJ_ACTUATOR, name), moved = id(mjOBJ_JOINT, name);
    const double position = data_->qpos[model_->jnt_qposadr[moved]];
    const double wanted = motor_rate(driven, position, time, scene_.step);
    const double error = wanted - data_->qvel[model_->jnt_dofadr[moved]];
    const double force = data_->actuator_force[motor], max = driven.motor->max_force;
    const bool is_at_most = error > 0 ? force >= max : force <= -max;
    if (!is_at_most) integrals_[joint] += integrated_share * error;
    const double gain = stable_gain(moved);
    model_->actuator_gainprm[mjNGAIN * motor] = gain;
    model_->actuator_biasprm[mjNBIAS * motor + 2] = -gain;
    data_->ctrl[motor] = wanted + integrals_[joint];
  }

 private:
  bool is_root(std::size_t assembly) const {
    return tree_[assembly].joint < 0 && !assemblies_[assembly].fixed;
  }
  int freejoint(std::size_t assembly) const { return model_->body_jntadr[bodies_[assembly]]; }
  /// Of a root: position and quaternion.
  double* position_of(std::size_t assembly) const {
    return data_->qpos + model_->jnt_qposadr[freejoint(assembly)];
  }
  /// Of a root: the linear part in the world's frame, the angular one in the body's.
  double* velocity_of(std::size_t assembly) const {
    return data_->qvel + model_->jnt_dofadr[freejoint(assembly)];
  }
  void set_velocity(std::size_t assembly, const BodyState& state) {
    const Vec3 spin = state.pose.rotation().transpose() * state.angular_velocity;
    mju_copy3(velocity_of(assembly), state.velocity.data());
    mju_copy3(velocity_of(assembly) + 3, spin.data());
  }
  std::size_t id(int type, const std::string& name) const {
    return static_cast<std::size_t>(mj_name2id(model_, type, name.c_str()));
  }

  /// What mj_step leaves at the step's beginning: poses and velocities of nested bodies, and the
  /// inertia that motors move.
  void update_tree() {
    const bool has_tree =
        std::ranges::any_of(tree_, [](const Hanging& hanging) { return hanging.joint >= 0; });
    if (!has_tree) return;
    mj_kinematics(model_, data_);
    mj_comPos(model_, data_);
    mj_comVel(model_, data_);
    if (model_->nu == 0) return;
    mj_crb(model_, data_);
    mj_factorM(model_, data_);
  }

  /// The largest gain of a joint's motor with which no rate overshoots in an explicit step when all
  /// motors have theirs: then the columns of M⁻¹ times the gains and the step sum up to one at
  /// most.
  double stable_gain(std::size_t joint) const {
    std::vector<double> response(model_->nv), unit(model_->nv);
    unit[model_->jnt_dofadr[joint]] = 1;
    mj_solveM(model_, data_, response.data(), unit.data(), 1);
    double sum = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(model_->nu); ++i) {
      sum += std::abs(response[model_->jnt_dofadr[model_->actuator_trnid[2 * i]]]);
    }
    return 1 / (scene_.step * sum);
  }

  /// MuJoCo's callback has no argument of its own: the world whose step it is.
  static inline const MujocoWorld* stepping = nullptr;
  static int keeps_apart(const mjModel* model, mjData*, int a, int b) {
    const auto body = [&](int geom) { return static_cast<int>(model->geom_user[geom]); };
    return stepping->may_touch_(body(a), body(b)) ? 0 : 1;
  }

  const std::vector<Hanging> tree_;
  mjModel* model_;
  mjData* data_;
  std::vector<std::size_t> bodies_;  ///< by assembly: MuJoCo's index
  std::vector<double> integrals_;    ///< by joint: what its motor adds to its rate for the load
};

std::unique_ptr<Simulation> begin(const Scene& scene, const EngineSetup& setup) {
  if (setup.cured || setup.has(EngineShape::Kind::exact)) mujoco::install();
  mju_user_warning = [](const char*) {};  // it would write a file where the program runs
  mju_user_error = [](const char*) { std::abort(); };  // it would wait for a key
  return std::make_unique<MujocoWorld>(scene, setup);
}

}  // namespace
}  // namespace touchstone

const touchstone::EngineModule* touchstone_engine() {
  static const touchstone::EngineModule module = {
      mj_versionString(),
      "double precision; mj_step with default options: Newton solver, pyramidal cones, soft "
      "contacts (solref 0.02 1)",
      "contacts as hard as the step allows (solref of two steps, solimp 0.99 0.999), elliptic "
      "cones, impratio 10",
      touchstone::begin};
  return &module;
}
