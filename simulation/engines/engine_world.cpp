#include "simulation/engines/engine_world.hpp"

#include <utility>

#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

/// A sphere, a capsule along z through the body's centre, or a hull.
Piece piece_of(RoundedPolytope part) {
  part.place(Eigen::Matrix3d::Identity(), Vec3::Zero());
  const auto& corners = part.vertices();
  if (corners.size() == 1) return {Sphere(part.radius()), corners[0]};
  if (corners.size() == 2) {
    return {Capsule(part.radius(), (corners[1] - corners[0]).norm() / 2)};
  }
  return {Sphere(1), Vec3::Zero(), corners};
}

}  // namespace

std::vector<Piece> pieces(const Body& body, const EngineShape& engine_shape) {
  if (const auto* hull = std::get_if<Convex>(&body.shape)) {
    return {{body.shape, Vec3::Zero(), hull->vertices()}};
  }
  const auto* c = std::get_if<Cylinder>(&body.shape);
  if (!c) return {{body.shape, Vec3::Zero(), {}, body.squares}};
  const auto [kind, count] = engine_shape;
  using Kind = EngineShape::Kind;
  std::vector<RoundedPolytope> parts;
  if (kind == Kind::capsule) parts = inscribed_capsule(c->radius(), c->half_length());
  if (kind == Kind::spheres) parts = inscribed_spheres(count, c->radius(), c->half_length());
  if (kind == Kind::hull) parts = inscribed_prism(count, c->radius(), c->half_length());
  if (kind == Kind::box) return {{Box(Vec3(c->radius(), c->radius(), c->half_length()))}};
  if (parts.empty()) return {{body.shape}};
  std::vector<Piece> result;
  for (RoundedPolytope& part : parts) result.push_back(piece_of(std::move(part)));
  return result;
}

EngineWorld::EngineWorld(const Scene& scene, EngineSetup setup)
    : scene_(scene),
      setup_(std::move(setup)),
      assemblies_(assemblies(scene)),
      may_touch_(scene),
      assembly_of_(scene.bodies.size()) {
  for (const Body& b : scene.bodies) states_.push_back({b.pose, b.velocity, b.angular_velocity});
  for (std::size_t i = 0; i < assemblies_.size(); ++i) {
    centres_.push_back(assemblies_[i].X_WF.position());
    for (const int b : assemblies_[i].bodies) assembly_of_[b] = i;
  }
}

void EngineWorld::step() {
  const double begin = scene_.step * steps_, end = scene_.step * ++steps_;
  for (std::size_t i = 0; i < assemblies_.size(); ++i) {
    if (assemblies_[i].driven < 0) continue;
    const Body& body = driving(assemblies_[i]);
    const BodyState after = driven_state(*body.drive, body.pose, end, scene_.step);
    drive(i, {driven_pose(*body.drive, body.pose, begin), after.velocity, after.angular_velocity},
          after.pose);
  }
  for (std::size_t i = 0; i < scene_.joints.size(); ++i) {
    if (scene_.joints[i].kind != JointKind::fixed) prepare_joint(i, begin);
  }
  for (const Push& p : scene_.pushes) {
    const double share = p.share(begin, scene_.step);
    if (share == 0) continue;
    const std::size_t pushed = assembly_of_[p.body];
    const Vec3 arm = states_[p.body].pose.position() - centres_[pushed];
    push(pushed, share * p.force, share * (p.torque + arm.cross(p.force)));
  }
  advance();
  for (std::size_t i = 0; i < assemblies_.size() && sound_; ++i) {
    if (assemblies_[i].driven < 0) continue;
    const Body& body = driving(assemblies_[i]);
    place_bodies(i, driven_state(*body.drive, body.pose, end, scene_.step));
  }
}

Vec3 EngineWorld::belt(int body, int other, const Vec3& normal) const {
  const auto velocity = [&](int i) {
    return Vec3(states_[i].pose.rotation() * scene_.bodies[i].surface_velocity);
  };
  const Vec3 v = velocity(body) - velocity(other);
  return v - v.dot(normal) * normal;
}

void EngineWorld::set_state(std::size_t assembly, const Vec3& position,
                            const std::array<double, 4>& orientation, const Vec3& velocity,
                            const Vec3& angular_velocity) {
  for (const Vec3& v : {position, velocity, angular_velocity}) {
    if (!(v.norm() < max_in_world)) sound_ = false;
  }
  if (!sound_) return;
  try {
    const auto& [w, x, y, z] = orientation;
    place_bodies(assembly,
                 {Pose(position, Eigen::Quaterniond(w, x, y, z)), velocity, angular_velocity});
  } catch (const InvalidInput&) {  // not a number
    sound_ = false;
  }
}

void EngineWorld::place_bodies(std::size_t assembly, const BodyState& state) {
  const Assembly& a = assemblies_[assembly];
  centres_[assembly] = state.pose.position();
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    states_[a.bodies[i]] = state_within(state, a.X_FB[i]);
  }
}

}  // namespace touchstone
