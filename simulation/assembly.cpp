#include "simulation/assembly.hpp"

#include <algorithm>
#include <map>
#include <numeric>

namespace touchstone {
namespace {

/// By first body of what is rigid: is it fixed, or joined rigidly to the world?
std::vector<bool> is_held(const Scene& scene, const std::vector<int>& first) {
  std::vector<bool> held(scene.bodies.size());
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    if (scene.bodies[b].fixed) held[first[b]] = true;
  }
  for (const Joint& joint : scene.joints) {
    if (joint.kind == JointKind::fixed && joint.b == world_body) held[first[joint.a]] = true;
  }
  return held;
}

/// Centre of mass and principal axes of bodies that are rigidly joined; the moment of a point mass
/// is m (r² 1 − r rᵀ) (parallel axis theorem). They stay the first body's if there is no mass.
void join(const Scene& scene, Assembly& assembly) {
  double mass = 0;
  Vec3 moment = Vec3::Zero();
  for (const int b : assembly.bodies) {
    const Body& body = scene.bodies[b];
    const auto [i, X_BC] = inertia(body);
    mass += i.mass;
    moment += i.mass * (body.pose.position() + body.pose.rotation() * X_BC.position());
  }
  if (mass == 0) return;
  const Vec3 centre = moment / mass;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const int b : assembly.bodies) {
    const Body& body = scene.bodies[b];
    const auto [i, X_BC] = inertia(body);
    const Eigen::Matrix3d r = body.pose.rotation() * X_BC.rotation();
    const Vec3 arm = body.pose.position() + body.pose.rotation() * X_BC.position() - centre;
    sum += r * i.principal.asDiagonal() * r.transpose();
    sum += i.mass * (arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose());
  }
  const PosedInertia joined = along_principal_axes(mass, centre, sum);
  assembly.inertia = joined.inertia;
  assembly.X_WF = joined.X_BC;
}

}  // namespace

std::vector<int> connected(const Scene& scene, bool rigidly) {
  std::vector<int> group(scene.bodies.size());
  std::iota(group.begin(), group.end(), 0);
  const auto root = [&](int i) {
    while (group[i] != i) i = group[i];
    return i;
  };
  for (const Joint& joint : scene.joints) {
    if (joint.b == world_body || (rigidly && joint.kind != JointKind::fixed)) continue;
    const int a = root(joint.a), b = root(joint.b);
    group[std::max(a, b)] = std::min(a, b);
  }
  for (int& g : group) g = root(g);
  return group;
}

Pose relative(const Pose& X_WA, const Pose& X_WB) {
  const Eigen::Quaterniond back = X_WA.unit_orientation().conjugate();
  return {back * (X_WB.position() - X_WA.position()), back * X_WB.unit_orientation()};
}

std::vector<Assembly> assemblies(const Scene& scene) {
  const std::vector<int> first = connected(scene, true);
  const std::vector<bool> held = is_held(scene, first);
  const int count = static_cast<int>(scene.bodies.size());
  std::vector<int> place(scene.bodies.size(), -1);
  std::vector<Assembly> result;
  for (int b = 0; b < count; ++b) {
    // Of what does not move each body can stand for itself.
    int& index = held[first[b]] ? place[b] : place[first[b]];
    if (index < 0) {
      index = static_cast<int>(result.size());
      result.emplace_back();
    }
    Assembly& assembly = result[index];
    assembly.bodies.push_back(b);
    assembly.fixed = held[first[b]];
    if (scene.bodies[b].drive) assembly.driven = b;
  }
  for (Assembly& assembly : result) {
    const int first_body = assembly.bodies.front();
    const Body& lead = scene.bodies[assembly.driven < 0 ? first_body : assembly.driven];
    assembly.X_WF = lead.pose;
    const bool is_uniform =
        assembly.bodies.size() == 1 && !lead.inertia && !std::holds_alternative<Convex>(lead.shape);
    if (assembly.is_free()) {
      assembly.inertia = inertia(lead).inertia;
      if (!is_uniform) join(scene, assembly);
    }
    const bool is_body = assembly.bodies.size() == 1 && (is_uniform || !assembly.is_free());
    for (const int b : assembly.bodies) {
      assembly.X_FB.push_back(is_body ? Pose() : relative(assembly.X_WF, scene.bodies[b].pose));
    }
  }
  return result;
}

std::vector<bool> moved_by_forces(const Scene& scene) {
  std::vector<bool> result(scene.bodies.size());
  for (const Assembly& assembly : assemblies(scene)) {
    for (const int b : assembly.bodies) result[b] = assembly.is_free();
  }
  return result;
}

BodyState start_of(const Assembly& assembly, const Scene& scene) {
  if (!assembly.is_free()) return {assembly.X_WF, Vec3::Zero(), Vec3::Zero()};
  const Body& first = scene.bodies[assembly.bodies.front()];
  const Vec3 arm = assembly.X_WF.position() - first.pose.position();
  return {assembly.X_WF, first.velocity + first.angular_velocity.cross(arm),
          first.angular_velocity};
}

BodyState state_within(const BodyState& state, const Pose& X_FB) {
  // To the last digit the same where the frames are.
  if (X_FB.position().isZero(0) && X_FB.orientation().vec().isZero(0)) return state;
  const Vec3 arm = state.pose.rotation() * X_FB.position();
  return {
      Pose(state.pose.position() + arm, state.pose.unit_orientation() * X_FB.unit_orientation()),
      state.velocity + state.angular_velocity.cross(arm), state.angular_velocity};
}

BodyState driven_state(const Drive& drive, const Pose& start, double time, double step) {
  const Pose before = driven_pose(drive, start, time - step);
  const Pose after = driven_pose(drive, start, time);
  return {after, (after.position() - before.position()) / step,
          driven_spin(drive, start, time - step, time)};
}

Touching::Touching(const Scene& scene)
    : count_(scene.bodies.size()), allowed_(count_ * count_, true) {
  const std::vector<Assembly> all = assemblies(scene);
  std::vector<std::size_t> of(count_);
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (const int b : all[i].bodies) of[b] = i;
  }
  for (std::size_t a = 0; a < count_; ++a) {
    for (std::size_t b = 0; b < count_; ++b) {
      const bool is_one = of[a] == of[b];
      const bool is_moved = all[of[a]].is_free() || all[of[b]].is_free();
      if (is_one || !is_moved || !scene.bodies[a].collides || !scene.bodies[b].collides) {
        allowed_[a * count_ + b] = false;
      }
    }
  }
  for (const auto& [a, b] : scene.apart) {
    allowed_[a * count_ + b] = allowed_[b * count_ + a] = false;
  }
  const std::vector<int> first = connected(scene, true);
  std::map<int, std::vector<std::size_t>> rigid;
  for (std::size_t b = 0; b < count_; ++b) rigid[first[b]].push_back(b);
  for (const Joint& joint : scene.joints) {
    if (joint.b == world_body) continue;
    for (const std::size_t a : rigid[first[joint.a]]) {
      for (const std::size_t b : rigid[first[joint.b]]) {
        allowed_[a * count_ + b] = allowed_[b * count_ + a] = false;
      }
    }
  }
}

}  // namespace touchstone
