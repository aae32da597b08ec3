// ODE 0.16.2's own world.
//
// World     A sweep-and-prune space, for a hash space loses pairs (ode_space_test.cpp),
//           dSpaceCollide, a contact joint for every point, dWorldQuickStep with ODE's default 20
//           iterations, ERP 0.2 and CFM 1e-10 (double precision); bodies do not fall
//           asleep, as by default. At its best: dWorldStep, which solves directly, and CFM 1e-12.
// Contacts  dCollide is asked for 8 points, as in ODE's examples. Friction is Coulomb's as a
//           pyramid (dContactApprox1), for without that flag a coefficient is a force; its
//           directions are ODE's own. Two bodies have the geometric mean of their friction.
// Shapes    dCreateCylinder and so on (ode_scene.hpp); a plane has no pose and is made in world
//           coordinates; a convex body is a mesh of triangles, which misses some of a cylinder's
//           contacts, and so is a floor of triangles. Spheres are several geoms of one body, as are
//           bodies that fixed joints connect.
// Joints    Hinges and sliders with stops and motors (dParamVel, dParamFMax), as in our own world,
//           which counts a hinge's turns.
// Belts     The velocity of a contact's surfaces (dContactMotion1) along its first direction.
// Drives    Kinematic bodies with the velocity that leads to their next pose, where they are then
//           put.
#include <ode/ode.h>
#include <optional>

#include "candidates/ode_library.hpp"
#include "candidates/ode_mesh.hpp"
#include "reference/engines/ode.hpp"
#include "simulation/engines/engine_world.hpp"
#include "simulation/ode_scene.hpp"

namespace touchstone {
namespace {

class OdeWorld : public EngineWorld {
 public:
  OdeWorld(const Scene& scene, const EngineSetup& setup)
      : EngineWorld(scene, setup),
        is_direct_(setup.best_solver),
        world_(dWorldCreate()),
        space_(dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ)),
        contacts_(dJointGroupCreate(0)) {
    if (is_direct_) dWorldSetCFM(world_, 1e-12);
    dRandSetSeed(0);  // of the order in which QuickStep takes its rows
    dWorldSetGravity(world_, scene.gravity.x(), scene.gravity.y(), scene.gravity.z());
    for (std::size_t i = 0; i < assemblies_.size(); ++i) add(i);
    for (const Joint& joint : scene.joints) {
      const dBodyID b = joint.b == world_body ? nullptr : body_of(joint.b);
      joints_.emplace_back();
      if (joint.kind == JointKind::fixed) continue;
      joints_.back().emplace(world_, joint, body_of(joint.a), b);
    }
  }
  ~OdeWorld() override {
    dJointGroupDestroy(contacts_);
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
  }
  OdeWorld(const OdeWorld&) = delete;
  OdeWorld& operator=(const OdeWorld&) = delete;

  Contacts contacts() const override { return {points_}; }

 protected:
  void advance() override {
    dJointGroupEmpty(contacts_);
    points_ = 0;
    dSpaceCollide(space_, this, [](void* self, dGeomID a, dGeomID b) {
      static_cast<OdeWorld*>(self)->meet(a, b);
    });
    is_direct_ ? dWorldStep(world_, scene_.step) : dWorldQuickStep(world_, scene_.step);
    for (auto& joint : joints_) {
      if (joint) joint->follow(scene_.step);
    }
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      if (!assemblies_[i].is_free()) continue;
      const dReal* q = dBodyGetQuaternion(bodies_[i]);
      set_state(i, Vec3(dBodyGetPosition(bodies_[i])), {q[0], q[1], q[2], q[3]},
                Vec3(dBodyGetLinearVel(bodies_[i])), Vec3(dBodyGetAngularVel(bodies_[i])));
    }
  }

  void drive(std::size_t assembly, const BodyState& state, const Pose&) override {
    place(bodies_[assembly], state);
  }
  void push(std::size_t assembly, const Vec3& force, const Vec3& torque) override {
    dBodyAddForce(bodies_[assembly], force.x(), force.y(), force.z());
    dBodyAddTorque(bodies_[assembly], torque.x(), torque.y(), torque.z());
  }
  void prepare_joint(std::size_t joint, double time) override {
    joints_[joint]->prepare(time, scene_.step);
  }

 private:
  dBodyID body_of(int body) const { return bodies_[assembly_of(body)]; }

  void add(std::size_t index) {
    const Assembly& assembly = assemblies_[index];
    const dBodyID made = make_ode_body(world_, assembly);
    bodies_.push_back(made);
    if (made) place(made, start_of(index));
    for (std::size_t i = 0; i < assembly.bodies.size(); ++i) {
      const Body& body = scene_.bodies[assembly.bodies[i]];
      const Pose& at = made ? assembly.X_FB[i] : body.pose;
      for (const Piece& piece : pieces(assembly.bodies[i])) {
        const dGeomID geom = piece.squares > 0 ? make_floor(piece, at)
                                               : make_ode_geom(space_, piece.shape, made,
                                                               shifted(at, piece.centre), meshes_);
        dGeomSetData(geom, const_cast<Body*>(&body));
      }
    }
  }

  dGeomID make_floor(const Piece& piece, const Pose& pose) {
    meshes_.push_back(ode_floor(piece.floor()));
    const dGeomID made = meshes_.back()->make_geom(space_);
    const Vec3& p = pose.position();
    dGeomSetPosition(made, p.x(), p.y(), p.z());
    dGeomSetQuaternion(made, OdeQuaternion(pose).wxyz);
    return made;
  }

  int index_of(dGeomID geom) const {
    return static_cast<int>(static_cast<const Body*>(dGeomGetData(geom)) - scene_.bodies.data());
  }

  void meet(dGeomID a, dGeomID b) {
    constexpr int max_points = 8;
    const int first = index_of(a), second = index_of(b);
    if (!may_touch_(first, second)) return;
    dContact contacts[max_points] = {};
    const int count = dCollide(a, b, max_points, &contacts[0].geom, sizeof(dContact));
    points_ += count;
    for (int i = 0; i < count; ++i) add(contacts[i], first, second);
  }

  void add(dContact& contact, int a, int b) {
    set_materials(contact, scene_.bodies[a].material, scene_.bodies[b].material);
    const Vec3 moves = belt(a, b, Vec3(contact.geom.normal));
    if (const double speed = moves.norm(); speed > 0) {
      contact.surface.mode |= dContactFDir1;
      for (int k = 0; k < 3; ++k) contact.fdir1[k] = moves[k] / speed;
      set_belt(contact, moves, !body_of(a));
    }
    dJointAttach(dJointCreateContact(world_, contacts_, &contact), body_of(a), body_of(b));
  }

  bool is_direct_;
  dWorldID world_;
  dSpaceID space_;
  dJointGroupID contacts_;
  OdeMeshes meshes_;
  std::vector<dBodyID> bodies_;                  ///< by assembly; null where it is fixed
  std::vector<std::optional<OdeJoint>> joints_;  ///< by joint; none where it is fixed
  int points_ = 0;
};

std::unique_ptr<Simulation> begin(const Scene& scene, const EngineSetup& setup) {
  initialise_ode();
  if (setup.cured || setup.has(EngineShape::Kind::exact)) ode::install();
  return std::make_unique<OdeWorld>(scene, setup);
}

}  // namespace
}  // namespace touchstone

const touchstone::EngineModule* touchstone_engine() {
  static const touchstone::EngineModule module = {
      TOUCHSTONE_ODE_VERSION,
      "double precision; dWorldQuickStep, 20 iterations, ERP 0.2, CFM 1e-10; dCollide asked for 8 "
      "points; friction as a pyramid",
      "dWorldStep, CFM 1e-12", touchstone::begin};
  return &module;
}
