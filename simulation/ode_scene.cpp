#include "simulation/ode_scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace touchstone {
namespace {

/// By this much the stops lie beyond the limits, rad or m: at a stop ODE pushes a motor's whole
/// force into the bodies where it should lead them away at a rate, and joints begin at their
/// limits.
constexpr double stop_slack = 1e-6;

/// ODE's shape of a body, in the body's frame.
struct MakeGeom {
  dSpaceID space;
  OdeMeshes& meshes;

  dGeomID operator()(const Cylinder& s) const {
    return dCreateCylinder(space, s.radius(), 2 * s.half_length());
  }
  dGeomID operator()(const Plane& s) const {
    return dCreatePlane(space, s.normal().x(), s.normal().y(), s.normal().z(), s.displacement());
  }
  dGeomID operator()(const Sphere& s) const { return dCreateSphere(space, s.radius()); }
  dGeomID operator()(const Capsule& s) const {
    return dCreateCapsule(space, s.radius(), 2 * s.half_length());
  }
  dGeomID operator()(const Box& s) const {
    const Vec3 side = 2 * s.half_extents();
    return dCreateBox(space, side.x(), side.y(), side.z());
  }
  dGeomID operator()(const Convex& s) const {
    std::vector<dTriIndex> indices;
    for (const Convex::Face& face : s.faces()) {
      const auto corner = [&](std::size_t i) { return static_cast<dTriIndex>(face.vertices[i]); };
      for (std::size_t i = 2; i < face.vertices.size(); ++i) {
        indices.insert(indices.end(), {corner(0), corner(i - 1), corner(i)});
      }
    }
    return meshes.emplace_back(std::make_unique<OdeMesh>(s.vertices(), std::move(indices)))
        ->make_geom(space);
  }
};

/// The posed plane in world coordinates.
Plane in_world(const Plane& plane, const Pose& pose) {
  const Vec3 normal = (pose.rotation() * plane.unit_normal()).normalized();
  return Plane(normal, plane.unit_displacement() + normal.dot(pose.position()));
}

}  // namespace

OdeQuaternion::OdeQuaternion(const Pose& pose) {
  const Eigen::Quaterniond q = pose.unit_orientation();
  wxyz[0] = q.w(), wxyz[1] = q.x(), wxyz[2] = q.y(), wxyz[3] = q.z();
}

dBodyID make_ode_body(dWorldID world, const Assembly& assembly) {
  if (assembly.fixed) return nullptr;
  const dBodyID made = dBodyCreate(world);
  if (!assembly.is_free()) {
    dBodySetKinematic(made);
    return made;
  }
  const Vec3& i = assembly.inertia.principal;
  dMass mass;
  dMassSetParameters(&mass, assembly.inertia.mass, 0, 0, 0, i.x(), i.y(), i.z(), 0, 0, 0);
  dBodySetMass(made, &mass);
  return made;
}

dGeomID make_ode_geom(dSpaceID space, const Shape& shape, dBodyID moving, const Pose& pose,
                      OdeMeshes& meshes) {
  const MakeGeom make{space, meshes};
  if (const auto* plane = std::get_if<Plane>(&shape)) return make(in_world(*plane, pose));
  const dGeomID made = std::visit(make, shape);
  const Vec3& p = pose.position();
  if (!moving) {
    dGeomSetPosition(made, p.x(), p.y(), p.z());
    dGeomSetQuaternion(made, OdeQuaternion(pose).wxyz);
    return made;
  }
  dGeomSetBody(made, moving);
  if (p.isZero(0) && pose.rotation().isIdentity(0)) return made;
  dGeomSetOffsetPosition(made, p.x(), p.y(), p.z());
  dGeomSetOffsetQuaternion(made, OdeQuaternion(pose).wxyz);
  return made;
}

OdeJoint::OdeJoint(dWorldID world, const Joint& joint, dBodyID a, dBodyID b) : joint_(joint) {
  const bool is_turned = !a;
  // ODE measures from its first body, which must not be null.
  if (is_turned) std::swap(a, b);
  const Vec3 &p = joint.anchor, axis = is_turned ? Vec3(-joint.axis) : joint.axis;
  if (joint.kind == JointKind::hinge) {
    made_ = dJointCreateHinge(world, nullptr);
    dJointAttach(made_, a, b);
    dJointSetHingeAnchor(made_, p.x(), p.y(), p.z());
    dJointSetHingeAxis(made_, axis.x(), axis.y(), axis.z());
    return;
  }
  made_ = dJointCreateSlider(world, nullptr);
  dJointAttach(made_, a, b);
  dJointSetSliderAxis(made_, axis.x(), axis.y(), axis.z());
  dJointSetSliderParam(made_, dParamLoStop, joint.lower - stop_slack);
  dJointSetSliderParam(made_, dParamHiStop, joint.upper + stop_slack);
}

/// ODE compares an angle in [−π, π) with the stops, and only while one of them is at most half a
/// turn from 0 and they are in order. At an upper one of π it never is.
void OdeJoint::set_hinge_stops(double turns) {
  if (std::isinf(joint_.lower) && std::isinf(joint_.upper)) return;
  const double lower = joint_.lower - stop_slack - turns;
  const double upper =
      std::max(lower, std::min(joint_.upper + stop_slack - turns, std::numbers::pi));
  dJointSetHingeParam(made_, dParamLoStop, lower);
  dJointSetHingeParam(made_, dParamHiStop, upper);
}

void OdeJoint::prepare(double time, double step) {
  const bool turns = joint_.kind == JointKind::hinge;
  if (turns) {
    const double angle = dJointGetHingeAngle(made_);
    position_ = nearest_turn(angle, position_);
    set_hinge_stops(position_ - angle);
  } else {
    position_ = dJointGetSliderPosition(made_);
  }
  if (!joint_.motor) return;
  const auto set = turns ? dJointSetHingeParam : dJointSetSliderParam;
  set(made_, dParamVel, motor_rate(joint_, position_, time, step));
  set(made_, dParamFMax, joint_.motor->max_force);
}

void OdeJoint::follow(double step) {
  if (joint_.kind == JointKind::hinge) position_ += step * dJointGetHingeAngleRate(made_);
}

void set_materials(dContact& contact, const Material& a, const Material& b) {
  dSurfaceParameters& surface = contact.surface;
  surface.mode = dContactApprox1;
  surface.mu = std::sqrt(a.friction * b.friction);
  surface.bounce = std::max(a.restitution, b.restitution);
  surface.bounce_vel = 0.01;  // m/s, below which nothing bounces
  if (surface.bounce > 0) surface.mode |= dContactBounce;
}

void set_belt(dContact& contact, const Vec3& belt, bool is_first_null) {
  // ODE takes the velocity that its first body shall have, along fdir1 and normal × fdir1.
  const Vec3 first(contact.fdir1), second = Vec3(contact.geom.normal).cross(first);
  contact.surface.mode |= dContactMotion1 | dContactMotion2;
  contact.surface.motion1 = (is_first_null ? 1 : -1) * belt.dot(first);
  contact.surface.motion2 = -belt.dot(second);
}

void place(dBodyID body, const BodyState& state) {
  const Vec3 &p = state.pose.position(), &v = state.velocity, &w = state.angular_velocity;
  dBodySetPosition(body, p.x(), p.y(), p.z());
  dBodySetQuaternion(body, OdeQuaternion(state.pose).wxyz);
  dBodySetLinearVel(body, v.x(), v.y(), v.z());
  dBodySetAngularVel(body, w.x(), w.y(), w.z());
}

BodyState state_of(dBodyID body) {
  const auto vector = [](const dReal* v) { return Vec3(v[0], v[1], v[2]); };
  const dReal* q = dBodyGetQuaternion(body);
  return {Pose(vector(dBodyGetPosition(body)), Eigen::Quaterniond(q[0], q[1], q[2], q[3])),
          vector(dBodyGetLinearVel(body)), vector(dBodyGetAngularVel(body))};
}

}  // namespace touchstone
