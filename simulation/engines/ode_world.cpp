// ODE 0.16.2's own world.
//
// World     A hash space, dSpaceCollide, a contact joint for every point, dWorldQuickStep with
// ODE's
//           default 20 iterations, ERP 0.2 and CFM 1e-10 (double precision); bodies do not fall
//           asleep, as by default. At its best: dWorldStep, which solves directly, and CFM 1e-12.
// Contacts  dCollide is asked for 8 points, as in ODE's examples. Friction is Coulomb's as a
//           pyramid (dContactApprox1), for without that flag a coefficient is a force; its
//           directions are ODE's own. Two bodies have the geometric mean of their friction.
// Shapes    dCreateCylinder and so on; a plane has no pose and is made in world coordinates.
#include <cmath>
#include <ode/ode.h>

#include "candidates/ode_library.hpp"
#include "reference/engines/ode.hpp"
#include "simulation/engines/engine_world.hpp"

namespace touchstone {
namespace {

struct MakeGeom {
  dSpaceID space;
  const Pose& pose;

  dGeomID operator()(const Cylinder& s) const {
    return dCreateCylinder(space, s.radius(), 2 * s.half_length());
  }
  dGeomID operator()(const Plane& s) const {
    const Vec3 normal = (pose.rotation() * s.unit_normal()).normalized();
    return dCreatePlane(space, normal.x(), normal.y(), normal.z(),
                        s.unit_displacement() + normal.dot(pose.position()));
  }
  dGeomID operator()(const Sphere& s) const { return dCreateSphere(space, s.radius()); }
  dGeomID operator()(const Capsule& s) const {
    return dCreateCapsule(space, s.radius(), 2 * s.half_length());
  }
  dGeomID operator()(const Box& s) const {
    const Vec3 side = 2 * s.half_extents();
    return dCreateBox(space, side.x(), side.y(), side.z());
  }
};

Vec3 from_vector(const dReal* v) { return Vec3(v[0], v[1], v[2]); }

class OdeWorld : public EngineWorld {
 public:
  OdeWorld(const Scene& scene, bool best_solver)
      : EngineWorld(scene),
        is_direct_(best_solver),
        world_(dWorldCreate()),
        space_(dHashSpaceCreate(nullptr)),
        joints_(dJointGroupCreate(0)) {
    if (is_direct_) dWorldSetCFM(world_, 1e-12);
    dRandSetSeed(0);  // of the order in which QuickStep takes its rows
    dWorldSetGravity(world_, scene.gravity.x(), scene.gravity.y(), scene.gravity.z());
    for (const Body& body : scene.bodies) add(body);
  }
  ~OdeWorld() override {
    dJointGroupDestroy(joints_);
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
  }
  OdeWorld(const OdeWorld&) = delete;
  OdeWorld& operator=(const OdeWorld&) = delete;

  void step() override {
    dJointGroupEmpty(joints_);
    points_ = 0;
    dSpaceCollide(space_, this, [](void* self, dGeomID a, dGeomID b) {
      static_cast<OdeWorld*>(self)->meet(a, b);
    });
    is_direct_ ? dWorldStep(world_, scene_.step) : dWorldQuickStep(world_, scene_.step);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      if (!bodies_[i]) continue;
      const dReal* q = dBodyGetQuaternion(bodies_[i]);
      set_state(i, from_vector(dBodyGetPosition(bodies_[i])), {q[0], q[1], q[2], q[3]},
                from_vector(dBodyGetLinearVel(bodies_[i])),
                from_vector(dBodyGetAngularVel(bodies_[i])));
    }
  }

  Contacts contacts() const override { return {points_}; }

 private:
  void add(const Body& body) {
    const dGeomID geom = std::visit(MakeGeom{space_, body.pose}, body.shape);
    friction_.push_back(body.material.friction);
    dGeomSetData(geom, reinterpret_cast<void*>(friction_.size() - 1));
    const Vec3& p = body.pose.position();
    const Eigen::Quaterniond turn = body.pose.unit_orientation();
    const dQuaternion q = {turn.w(), turn.x(), turn.y(), turn.z()};
    bodies_.push_back(nullptr);
    if (body.fixed) {
      if (std::holds_alternative<Plane>(body.shape)) return;
      dGeomSetPosition(geom, p.x(), p.y(), p.z());
      dGeomSetQuaternion(geom, q);
      return;
    }
    const dBodyID made = bodies_.back() = dBodyCreate(world_);
    const Inertia i = inertia(body.shape, body.density);
    dMass mass;
    dMassSetParameters(&mass, i.mass, 0, 0, 0, i.principal.x(), i.principal.y(), i.principal.z(), 0,
                       0, 0);
    dBodySetMass(made, &mass);
    dGeomSetBody(geom, made);
    dBodySetPosition(made, p.x(), p.y(), p.z());
    dBodySetQuaternion(made, q);
    const Vec3 &v = body.velocity, &w = body.angular_velocity;
    dBodySetLinearVel(made, v.x(), v.y(), v.z());
    dBodySetAngularVel(made, w.x(), w.y(), w.z());
  }

  double friction_of(dGeomID geom) const {
    return friction_[reinterpret_cast<std::size_t>(dGeomGetData(geom))];
  }

  void meet(dGeomID a, dGeomID b) {
    constexpr int max_points = 8;
    const dBodyID body_a = dGeomGetBody(a), body_b = dGeomGetBody(b);
    if (!body_a && !body_b) return;
    dContact contacts[max_points] = {};
    const int count = dCollide(a, b, max_points, &contacts[0].geom, sizeof(dContact));
    points_ += count;
    for (int i = 0; i < count; ++i) {
      contacts[i].surface.mode = dContactApprox1;
      contacts[i].surface.mu = std::sqrt(friction_of(a) * friction_of(b));
      dJointAttach(dJointCreateContact(world_, joints_, &contacts[i]), body_a, body_b);
    }
  }

  bool is_direct_;
  dWorldID world_;
  dSpaceID space_;
  dJointGroupID joints_;
  std::vector<dBodyID> bodies_;  ///< null where the body is fixed
  std::vector<double> friction_;
  int points_ = 0;
};

std::unique_ptr<Simulation> begin(const Scene& scene, const EngineSetup& setup) {
  initialise_ode();
  if (setup.cured) ode::install();
  return std::make_unique<OdeWorld>(scene, setup.best_solver);
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
