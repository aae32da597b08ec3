#include "simulation/ode_shapes.hpp"

static_assert(sizeof(dReal) == sizeof(double), "built against single-precision ODE");

namespace touchstone {
namespace {

/// ODE's default handlers print and, for errors of its own, end the process.
void ignore_message(int, const char*, va_list) {}

struct MakeGeom {
  dGeomID operator()(const Cylinder&) const { return nullptr; }
  dGeomID operator()(const Plane& s) const {
    return dCreatePlane(nullptr, s.normal().x(), s.normal().y(), s.normal().z(), s.displacement());
  }
  dGeomID operator()(const Sphere& s) const { return dCreateSphere(nullptr, s.radius()); }
  dGeomID operator()(const Capsule& s) const {
    return dCreateCapsule(nullptr, s.radius(), 2 * s.half_length());
  }
  dGeomID operator()(const Box& s) const {
    const Vec3 side = 2 * s.half_extents();
    return dCreateBox(nullptr, side.x(), side.y(), side.z());
  }
};

/// The posed plane as a shape of the world: ODE's cannot be placed.
Plane in_world(const Plane& plane, const Pose& pose) {
  const Vec3 normal = (pose.rotation() * plane.unit_normal()).normalized();
  return Plane(normal, plane.unit_displacement() + normal.dot(pose.position()));
}

}  // namespace

void initialise_ode() {
  static const bool done = [] {
    dInitODE2(0);
    dSetMessageHandler(ignore_message);
    dAllocateODEDataForThread(dAllocateMaskAll);
    return true;
  }();
  (void)done;
}

dBodyID make_ode_body(dWorldID world, const Body& body, const Inertia& inertia) {
  const dBodyID made = dBodyCreate(world);
  const Vec3 &p = body.pose.position(), &v = body.velocity, &w = body.angular_velocity;
  const Eigen::Quaterniond unit = body.pose.unit_orientation();
  const dQuaternion q = {unit.w(), unit.x(), unit.y(), unit.z()};
  const Vec3& i = inertia.principal;
  dMass mass;
  dMassSetParameters(&mass, inertia.mass, 0, 0, 0, i.x(), i.y(), i.z(), 0, 0, 0);
  dBodySetMass(made, &mass);
  dBodySetPosition(made, p.x(), p.y(), p.z());
  dBodySetQuaternion(made, q);
  dBodySetLinearVel(made, v.x(), v.y(), v.z());
  dBodySetAngularVel(made, w.x(), w.y(), w.z());
  dBodySetFiniteRotationMode(made, 1);  // turns by the whole angle, not by its tangent
  dBodySetGyroscopicMode(made, 0);      // see World::State::move
  return made;
}

dGeomID make_ode_geom(const Body& body, dBodyID moving) {
  if (const auto* plane = std::get_if<Plane>(&body.shape)) {
    return MakeGeom{}(in_world(*plane, body.pose));
  }
  const dGeomID made = std::visit(MakeGeom{}, body.shape);
  if (!made) return nullptr;
  if (moving) {
    dGeomSetBody(made, moving);
    return made;
  }
  const Vec3& p = body.pose.position();
  const Eigen::Quaterniond unit = body.pose.unit_orientation();
  const dQuaternion q = {unit.w(), unit.x(), unit.y(), unit.z()};
  dGeomSetPosition(made, p.x(), p.y(), p.z());
  dGeomSetQuaternion(made, q);
  return made;
}

BodyState state_of(dBodyID body) {
  const auto vector = [](const dReal* v) { return Vec3(v[0], v[1], v[2]); };
  const dReal* q = dBodyGetQuaternion(body);
  return {Pose(vector(dBodyGetPosition(body)), Eigen::Quaterniond(q[0], q[1], q[2], q[3])),
          vector(dBodyGetLinearVel(body)), vector(dBodyGetAngularVel(body))};
}

}  // namespace touchstone
