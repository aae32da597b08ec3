#include "simulation/scenes/disturbed_scene.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <set>
#include <string>

namespace touchstone {
namespace {

/// Cans that stand upright on the cap of a fixed cylinder each.
Scene cans(const std::vector<Vec3>& places) {
  Scene scene;
  const auto add = [&](const char* name, double half_length, const Vec3& at) -> Body& {
    scene.bodies.push_back({name, Cylinder(0.03, half_length)});
    scene.bodies.back().pose = Pose(at);
    return scene.bodies.back();
  };
  for (const Vec3& place : places) {
    add("pedestal", 0.1, place - Vec3(0, 0, 0.1)).fixed = true;
    add("can", 0.06, place + Vec3(0, 0, 0.06));
  }
  return scene;
}

TEST(DisturbedScenes, AreTheSceneAsItIsWrittenFirst) {
  const Scene scene = cans({Vec3(0.5, 0, 0)});
  const DisturbedScene none(scene, 7, 0);
  EXPECT_EQ(none.origin, (std::vector{0, 1}));
  EXPECT_EQ(none.scene.gravity, scene.gravity);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(none.scene.bodies[i].pose.position(), scene.bodies[i].pose.position());
    EXPECT_EQ(none.scene.bodies[i].pose.orientation().coeffs(),
              scene.bodies[i].pose.orientation().coeffs());
  }
}

TEST(DisturbedScenes, TurnedBackAreTheSceneButForASmallShiftTurnAndKickOfWhatMoves) {
  const Scene scene = cans({Vec3(0.5, 0, 0), Vec3(0, 0.7, 0.3)});
  double largest_shift = 0, largest_angle = 0, largest_kick = 0;
  std::set<std::vector<int>> orders;
  for (std::size_t d = 1; d <= 100; ++d) {
    const DisturbedScene disturbed(scene, 7, d);
    orders.insert(disturbed.origin);
    EXPECT_NEAR(disturbed.scene.gravity.norm(), 9.81, 1e-12);
    Trajectory start;
    start.frames.emplace_back();
    start.answers = {{0, 1, 2, 0.01, TS_CONTACT, -0.01, disturbed.scene.gravity, 1}};
    for (const Body& b : disturbed.scene.bodies) {
      start.frames[0].push_back({b.pose, b.velocity, b.angular_velocity});
    }
    const Trajectory back = disturbed.turned_back(start);
    EXPECT_EQ(back.answers[0].a, disturbed.origin[1]);
    EXPECT_EQ(back.answers[0].b, disturbed.origin[2]);
    EXPECT_LT((*back.answers[0].wrong_normal - scene.gravity).norm(), 1e-12);
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      const BodyState& s = back.frames[0][i];
      const Pose& written = scene.bodies[i].pose;
      const double shift = (s.pose.position() - written.position()).norm();
      const double angle = s.pose.unit_orientation().angularDistance(written.unit_orientation());
      const double rounding = scene.bodies[i].fixed ? 1e-15 : 1;
      EXPECT_LE(shift, std::min(0.06e-4, rounding));
      EXPECT_LE(angle, std::min(1e-3, 1e8 * rounding));
      largest_shift = std::max(largest_shift, shift);
      largest_angle = std::max(largest_angle, angle);
      largest_kick = std::max(largest_kick, s.velocity.norm());
    }
  }
  EXPECT_GT(largest_shift, 0.05e-4);
  EXPECT_GT(largest_angle, 0.8e-3);
  EXPECT_NEAR(largest_kick, 1e-3 * std::sqrt(2 * 9.81 * 0.06), 1e-4);
  EXPECT_EQ(orders.size(), 24U);  // of four bodies
}

/// A cart with a wheel under a push, a driven hand with a finger, and an arm on the world.
Scene mechanisms() {
  Scene scene;
  const auto add = [&](const char* name, const Vec3& position, const auto& shape) {
    scene.bodies.push_back({name, shape});
    scene.bodies.back().pose = Pose(position, Eigen::Quaterniond(0.8, 0.1, 0.5, -0.2));
  };
  add("cart", Vec3(1, 2, 3), Box(Vec3(0.2, 0.1, 0.1)));
  add("wheel", Vec3(1.3, 2, 3), Cylinder(0.1, 0.05));
  add("hand", Vec3(-3, 0, 1), Box(Vec3(0.2, 0.1, 0.1)));
  add("finger", Vec3(-3, 0.2, 1), Box(Vec3(0.02, 0.1, 0.1)));
  add("arm", Vec3(0, 5, 0), Capsule(0.1, 0.5));
  scene.bodies[2].drive = Waypoints{{0.5, Pose(Vec3(-3, 0, 2))}};
  scene.joints = {{"axle", JointKind::hinge, 1, 0, Vec3(1.2, 2, 3), Vec3::UnitY()},
                  {"squeeze", JointKind::slider, 3, 2, Vec3::Zero(), Vec3::UnitY()},
                  {"elbow", JointKind::hinge, 4, world_body, Vec3(0, 5, 1), Vec3::UnitX()}};
  scene.pushes = {{0, Vec3(1, 2, 3), Vec3(4, 5, 6), 0.1, 0.2}};
  return scene;
}

Vec3 in_body(const Pose& pose, const Vec3& point) {
  return pose.rotation().transpose() * (point - pose.position());
}

TEST(DisturbedScenes, MoveMechanismsAsOneAndLeaveAloneWhatIsHeldOrDriven) {
  const Scene written = mechanisms();
  const auto names = [](const Scene& scene, int b) {
    return b == world_body ? std::string("world") : scene.bodies[b].name;
  };
  for (std::size_t d = 1; d <= 30; ++d) {
    const DisturbedScene disturbed(written, 7, d);
    const Scene& scene = disturbed.scene;
    check_scene(scene);
    const Eigen::Quaterniond back = disturbed.turn.conjugate();
    for (std::size_t j = 0; j < 3; ++j) {
      const Joint &was = written.joints[j], &is = scene.joints[j];
      EXPECT_EQ(names(scene, is.a), names(written, was.a));
      EXPECT_EQ(names(scene, is.b), names(written, was.b));
      const Pose &a = scene.bodies[is.a].pose, &a0 = written.bodies[was.a].pose;
      EXPECT_LT((in_body(a, is.anchor) - in_body(a0, was.anchor)).norm(), 1e-14);
      EXPECT_LT((a.rotation().transpose() * is.axis - a0.rotation().transpose() * was.axis).norm(),
                1e-14);
      if (was.b == world_body) continue;
      const Pose &b = scene.bodies[is.b].pose, &b0 = written.bodies[was.b].pose;
      EXPECT_LT((in_body(a, b.position()) - in_body(a0, b0.position())).norm(), 1e-14);
      EXPECT_LT(
          (a.rotation().transpose() * b.rotation() - a0.rotation().transpose() * b0.rotation())
              .norm(),
          1e-14);
    }
    const Push& push = scene.pushes[0];
    EXPECT_EQ(scene.bodies[push.body].name, "cart");
    EXPECT_LT((back * push.force - Vec3(1, 2, 3)).norm(), 1e-14);
    EXPECT_LT((back * push.torque - Vec3(4, 5, 6)).norm(), 1e-14);
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      const Body &is = scene.bodies[i], &was = written.bodies[disturbed.origin[i]];
      const double shift = (back * is.pose.position() - was.pose.position()).norm();
      const bool is_on_cart = was.name == "cart" || was.name == "wheel";
      EXPECT_LT(shift, is_on_cart ? 1e-3 : 1e-14) << was.name;
      EXPECT_GT(shift + (back * is.velocity).norm(), is_on_cart ? 1e-9 : -1) << was.name;
      EXPECT_EQ(is.velocity.isZero(0), !is_on_cart) << was.name;
      if (!was.drive) continue;
      const Pose expected = driven_pose(*was.drive, was.pose, 0.3);
      const Pose found = driven_pose(*is.drive, is.pose, 0.3);
      EXPECT_LT((back * found.position() - expected.position()).norm(), 1e-14);
      EXPECT_LT((back.toRotationMatrix() * found.rotation() - expected.rotation()).norm(), 1e-14);
    }
  }
}

TEST(DisturbedScenes, TurnVelocitiesWithWhatMoves) {
  const Vec3 spin(0, 6, 8), speed(0.5, -0.2, 0), arm(0.1, 0, 0);
  Scene written;
  for (const char* name : {"left", "right"}) {
    Body half{name, Box(Vec3(0.04, 0.04, 0.04))};
    half.velocity = speed;
    half.angular_velocity = spin;
    written.bodies.push_back(half);
  }
  written.bodies[1].pose = Pose(arm);
  written.bodies[1].velocity += spin.cross(arm);
  written.joints = {{"weld", JointKind::fixed, 1, 0}};
  for (std::size_t d = 1; d <= 40; ++d) {
    const DisturbedScene disturbed(written, 7, d);
    ASSERT_NO_THROW(check_scene(disturbed.scene)) << d;
    const bool is_in_order = disturbed.origin[0] == 0;
    const Body& left = disturbed.scene.bodies[is_in_order ? 0 : 1];
    const Body& right = disturbed.scene.bodies[is_in_order ? 1 : 0];
    const Vec3 between = right.pose.position() - left.pose.position();
    EXPECT_LT((right.velocity - left.velocity - left.angular_velocity.cross(between)).norm(), 1e-13)
        << d;
    // In its own frame each body spins as it is written.
    for (const Body* body : {&left, &right}) {
      EXPECT_LT((body->pose.rotation().transpose() * body->angular_velocity - spin).norm(), 1e-13);
    }
  }
}

TEST(DisturbedScenes, AreOthersForEverySeedAndTheSameForTheSame) {
  const Scene scene = cans({Vec3(0.5, 0, 0)});
  const auto gravity = [&](std::uint64_t seed, std::size_t d) {
    return DisturbedScene(scene, seed, d).scene.gravity;
  };
  EXPECT_EQ(gravity(1, 3), gravity(1, 3));
  EXPECT_NE(gravity(1, 3), gravity(2, 3));
  EXPECT_NE(gravity(1, 3), gravity(1, 4));
}

}  // namespace
}  // namespace touchstone
