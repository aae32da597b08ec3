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
// Spheres
//           are several geoms of one body.
// Drives    Kinematic bodies with the velocity that leads to their next pose, where they are then
//           put.
#include <algorithm>
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
  OdeWorld(const Scene& scene, const EngineSetup& setup)
      : EngineWorld(scene, setup),
        is_direct_(setup.best_solver),
        world_(dWorldCreate()),
        space_(dHashSpaceCreate(nullptr)),
        joints_(dJointGroupCreate(0)) {
    if (is_direct_) dWorldSetCFM(world_, 1e-12);
    dRandSetSeed(0);  // of the order in which QuickStep takes its rows
    dWorldSetGravity(world_, scene.gravity.x(), scene.gravity.y(), scene.gravity.z());
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) add(i);
  }
  ~OdeWorld() override {
    dJointGroupDestroy(joints_);
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
  }
  OdeWorld(const OdeWorld&) = delete;
  OdeWorld& operator=(const OdeWorld&) = delete;

  Contacts contacts() const override { return {points_}; }

 protected:
  void advance() override {
    dJointGroupEmpty(joints_);
    points_ = 0;
    dSpaceCollide(space_, this, [](void* self, dGeomID a, dGeomID b) {
      static_cast<OdeWorld*>(self)->meet(a, b);
    });
    is_direct_ ? dWorldStep(world_, scene_.step) : dWorldQuickStep(world_, scene_.step);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      if (!scene_.bodies[i].is_free()) continue;
      const dReal* q = dBodyGetQuaternion(bodies_[i]);
      set_state(i, from_vector(dBodyGetPosition(bodies_[i])), {q[0], q[1], q[2], q[3]},
                from_vector(dBodyGetLinearVel(bodies_[i])),
                from_vector(dBodyGetAngularVel(bodies_[i])));
    }
  }

  void drive(std::size_t body, const BodyState& state, const Pose&) override {
    set_state_of(bodies_[body], state);
  }
  void push(std::size_t body, const Push& push) override {
    const Vec3 &f = push.force, &t = push.torque;
    dBodyAddForce(bodies_[body], f.x(), f.y(), f.z());
    dBodyAddTorque(bodies_[body], t.x(), t.y(), t.z());
  }

 private:
  /// A sphere or a capsule; hulls are not for ODE (engine_choice.cpp).
  dGeomID make_part(const RoundedPolytope& part) {
    const auto& corners = part.vertices();
    if (corners.size() == 1) return dCreateSphere(space_, part.radius());
    return dCreateCapsule(space_, part.radius(), (corners[1] - corners[0]).norm());
  }

  static void set_state_of(dBodyID body, const BodyState& state) {
    const Vec3 &p = state.pose.position(), &v = state.velocity, &w = state.angular_velocity;
    const Eigen::Quaterniond turn = state.pose.unit_orientation();
    const dQuaternion q = {turn.w(), turn.x(), turn.y(), turn.z()};
    dBodySetPosition(body, p.x(), p.y(), p.z());
    dBodySetQuaternion(body, q);
    dBodySetLinearVel(body, v.x(), v.y(), v.z());
    dBodySetAngularVel(body, w.x(), w.y(), w.z());
  }

  void add_body(std::size_t index) {
    const Body& body = scene_.bodies[index];
    const dBodyID made = bodies_[index] = dBodyCreate(world_);
    if (body.is_free()) {
      const Inertia i = inertia(body.shape, body.density);
      dMass mass;
      dMassSetParameters(&mass, i.mass, 0, 0, 0, i.principal.x(), i.principal.y(), i.principal.z(),
                         0, 0, 0);
      dBodySetMass(made, &mass);
    } else {
      dBodySetKinematic(made);
    }
    set_state_of(made, {body.pose, body.velocity, body.angular_velocity});
  }

  void add(std::size_t index) {
    const Body& body = scene_.bodies[index];
    bodies_.push_back(nullptr);
    if (!body.fixed) add_body(index);
    std::vector<dGeomID> geoms;
    const auto parts = this->parts(index);
    if (parts.empty()) geoms.push_back(std::visit(MakeGeom{space_, body.pose}, shape(index)));
    for (const RoundedPolytope& part : parts) geoms.push_back(make_part(part));
    for (std::size_t i = 0; i < geoms.size(); ++i) {
      dGeomSetData(geoms[i], const_cast<Body*>(&body));
      if (std::holds_alternative<Plane>(body.shape)) continue;
      const Vec3 centre = parts.size() > 1 ? parts[i].vertices()[0] : Vec3(0, 0, 0);
      if (body.fixed) {
        const Vec3 place = body.pose.position() + body.pose.rotation() * centre;
        const Eigen::Quaterniond turn = body.pose.unit_orientation();
        const dQuaternion q = {turn.w(), turn.x(), turn.y(), turn.z()};
        dGeomSetPosition(geoms[i], place.x(), place.y(), place.z());
        dGeomSetQuaternion(geoms[i], q);
      } else {
        dGeomSetBody(geoms[i], bodies_[index]);
        if (parts.size() > 1) dGeomSetOffsetPosition(geoms[i], centre.x(), centre.y(), centre.z());
      }
    }
  }

  static const Body& body_of(dGeomID geom) { return *static_cast<const Body*>(dGeomGetData(geom)); }

  void meet(dGeomID a, dGeomID b) {
    constexpr int max_points = 8;
    const Body &first = body_of(a), &second = body_of(b);
    if (&first == &second || (!first.is_free() && !second.is_free())) return;
    dContact contacts[max_points] = {};
    const int count = dCollide(a, b, max_points, &contacts[0].geom, sizeof(dContact));
    points_ += count;
    for (int i = 0; i < count; ++i) {
      dSurfaceParameters& surface = contacts[i].surface;
      surface.mode = dContactApprox1;
      surface.mu = std::sqrt(first.material.friction * second.material.friction);
      surface.bounce = std::max(first.material.restitution, second.material.restitution);
      surface.bounce_vel = 0.01;  // as in our own world
      if (surface.bounce > 0) surface.mode |= dContactBounce;
      dJointAttach(dJointCreateContact(world_, joints_, &contacts[i]), dGeomGetBody(a),
                   dGeomGetBody(b));
    }
  }

  bool is_direct_;
  dWorldID world_;
  dSpaceID space_;
  dJointGroupID joints_;
  std::vector<dBodyID> bodies_;  ///< null where the body is fixed
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
