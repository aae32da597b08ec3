#include "simulation/kinematic_tree.hpp"

#include <gtest/gtest.h>

namespace touchstone {
namespace {

Joint bare_hinge(int a, int b) { return {"hinge", JointKind::hinge, a, b}; }

Scene boxes(int count) {
  Scene scene;
  for (int i = 0; i < count; ++i) {
    scene.bodies.push_back({.name = std::to_string(i), .shape = Box(Vec3(1, 1, 1))});
  }
  return scene;
}

std::vector<Hanging> tree_of(const Scene& scene) {
  return kinematic_tree(scene, assemblies(scene));
}

TEST(KinematicTree, WheelsHangOnTheChassisWhereverItStands) {
  Scene scene = boxes(3);
  scene.joints = {bare_hinge(0, 1), bare_hinge(2, 1)};
  const auto tree = tree_of(scene);
  EXPECT_EQ(tree[1].joint, -1);
  EXPECT_EQ(tree[0].parent, 1);
  EXPECT_EQ(tree[0].joint, 0);
  EXPECT_EQ(tree[2].joint, 1);
  EXPECT_EQ(tree[1].children, (std::vector<int>{0, 2}));
  EXPECT_FALSE(loop_closing_joint(scene));
}

TEST(KinematicTree, AChainHangsOnWhatHoldsIt) {
  for (const bool is_driven : {false, true}) {
    Scene scene = boxes(3);
    scene.bodies[0].fixed = !is_driven;
    if (is_driven) scene.bodies[0].drive = SteadyMotion{};
    scene.joints = {bare_hinge(1, 2), bare_hinge(0, 1)};
    const auto tree = tree_of(scene);
    EXPECT_EQ(tree[0].joint, -1);
    EXPECT_EQ(tree[1].joint, 1);
    EXPECT_EQ(tree[1].parent, is_driven ? 0 : -1);
    EXPECT_EQ(tree[2].parent, 1);
  }
}

TEST(KinematicTree, APairThatHangsOnEachOtherTwiceClosesALoop) {
  Scene scene = boxes(3);
  scene.joints = {bare_hinge(0, 1), bare_hinge(1, 2), bare_hinge(2, 0)};
  EXPECT_EQ(loop_closing_joint(scene), 2);
  scene.joints = {bare_hinge(0, 1), bare_hinge(1, 0)};
  EXPECT_EQ(loop_closing_joint(scene), 1);
}

TEST(KinematicTree, WhatIsFixedOrDrivenClosesALoopToo) {
  Scene scene = boxes(3);
  scene.bodies[1].fixed = true;
  scene.joints = {bare_hinge(0, world_body), bare_hinge(0, 1)};
  EXPECT_EQ(loop_closing_joint(scene), 1);
  scene.bodies[2].drive = SteadyMotion{};
  scene.joints = {bare_hinge(0, 2), bare_hinge(0, 1)};
  EXPECT_EQ(loop_closing_joint(scene), 1);
  scene.joints = {bare_hinge(1, world_body), bare_hinge(2, 1), bare_hinge(2, world_body)};
  EXPECT_FALSE(loop_closing_joint(scene)) << "none of these joints moves anything";
}

TEST(KinematicTree, RigidlyJoinedBodiesAreOne) {
  Scene scene = boxes(3);
  scene.joints = {{"rigid", JointKind::fixed, 0, 1}, bare_hinge(2, 0), bare_hinge(2, 1)};
  EXPECT_EQ(tree_of(scene).size(), 2);
  EXPECT_EQ(loop_closing_joint(scene), 2);
}

}  // namespace
}  // namespace touchstone
