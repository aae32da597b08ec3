// Convex bodies that move, in our own world and in the engines': held to paper, and to boxes.
#include <cmath>
#include <gmock/gmock.h>
#include <numbers>

#include "simulation/assembly.hpp"
#include "simulation/each_world.hpp"
#include "simulation/mechanism_scenes.hpp"

namespace touchstone {
namespace {

using testing::HasSubstr;

/// The box of these half extents about a point, as a hull.
Convex hull_of_box(const Vec3& h, const Vec3& centre = Vec3::Zero()) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) {
    const Vec3 sign(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    corners.emplace_back(centre + sign.cwiseProduct(h));
  }
  return {corners,
          {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
}

Eigen::Matrix3d moments_in_body(const PosedInertia& inertia) {
  const Eigen::Matrix3d& axes = inertia.X_BC.rotation();
  return axes * inertia.inertia.principal.asDiagonal() * axes.transpose();
}

TEST(InertiaOfAHull, OfABoxIsTheBoxsWhereverItLies) {
  const Vec3 h(0.3, 0.2, 0.1), centre(5, -3, 0.5);
  const PosedInertia hull = inertia(hull_of_box(h, centre), 700), box = inertia(Box(h), 700);
  EXPECT_NEAR(hull.inertia.mass, box.inertia.mass, 1e-12);
  EXPECT_LT((hull.X_BC.position() - centre).norm(), 1e-14);
  EXPECT_LT((moments_in_body(hull) - moments_in_body(box)).norm(), 1e-13);
}

// About the centre (1/4, 1/4, 1/4) of the tetrahedron of the unit vectors: 1/80 on the diagonal,
// 1/480 beside it.
TEST(InertiaOfAHull, OfATetrahedronIsThatOnPaper) {
  const Convex corner({Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()},
                      {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
  const PosedInertia found = inertia(corner, 1);
  EXPECT_NEAR(found.inertia.mass, 1.0 / 6, 1e-16);
  EXPECT_LT((found.X_BC.position() - Vec3::Constant(0.25)).norm(), 1e-15);
  Eigen::Matrix3d on_paper = Eigen::Matrix3d::Constant(1.0 / 480);
  on_paper.diagonal().setConstant(1.0 / 80);
  EXPECT_LT((moments_in_body(found) - on_paper).norm(), 1e-16);
}

Convex triangle() { return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {2, 1, 0}}}; }

TEST(Hulls, ThatAreFlatMustBeFixed) {
  Scene scene;
  scene.bodies = {{"leaf", triangle()}};
  EXPECT_EQ(refusal_of(scene),
            "bodies[0].fixed is false: a flat convex has no mass and must be fixed");
  scene.bodies[0].fixed = true;
  EXPECT_EQ(refusal_of(scene), "accepted");
}

TEST(Hulls, FarFromTheirOriginAreRefused) {
  Scene scene;
  scene.bodies = {{"far", hull_of_box(Vec3::Ones(), Vec3(0, 2e6, 0))}};
  EXPECT_EQ(refusal_of(scene),
            "bodies[0].shape.vertices is 2000000 m from the body's origin: must be at most 1000000 "
            "m from it");
}

TEST(Hulls, ThatAreFlatHaveNoMeshInMuJoCo) {
  Scene scene;
  scene.bodies = {{.name = "leaf", .shape = triangle(), .fixed = true}};
  EXPECT_NO_THROW(check_engine_scene("bullet", scene));
  EXPECT_THAT([&] { check_engine_scene("mujoco", scene); },
              testing::ThrowsMessage<InvalidInput>(
                  HasSubstr("bodies[0].shape is flat, or too small: must not be there")));
}

using HullIn = EachWorld;
INSTANTIATE_TEST_SUITE_P(Each, HullIn, testing::ValuesIn(HullIn::all()), HullIn::plain_name);

/// A hull of a box whose frame lies elsewhere, as the box at this pose.
Body off_centre(const char* name, const Vec3& half_extents, const Pose& pose) {
  const Vec3 centre(0.4, -0.1, 0.2);
  Body body{.name = name, .shape = hull_of_box(half_extents, centre)};
  body.pose = Pose(pose.position() - pose.rotation() * centre, pose.orientation());
  return body;
}

TEST_P(HullIn, TumblesAsItsBoxDoes) {
  Scene boxes = TumblingBox().whole, hulls = boxes;
  boxes.duration = hulls.duration = 0.5;
  Body& hull = hulls.bodies[0] = off_centre("whole", Vec3(0.6, 0.2, 0.1), Pose());
  const Body& box = boxes.bodies[0];
  hull.angular_velocity = box.angular_velocity;
  hull.velocity = box.velocity + box.angular_velocity.cross(hull.pose.position());
  const BodyState of_box = end(boxes)[0], of_hull = end(hulls)[0];
  // A world may take the axes of inertia in another order, and rounds otherwise.
  const double rounding = is_single() ? 1e-4 : 1e-7;
  const Vec3 centre = of_hull.pose.position() - of_hull.pose.rotation() * hull.pose.position();
  EXPECT_LT((centre - of_box.pose.position()).norm(), rounding);
  EXPECT_LT((of_hull.pose.rotation() - of_box.pose.rotation()).norm(), rounding);
}

/// A brick that lies on something, and how far it is from there, and turned, after a second.
struct Rest {
  double way, turn;
};
template <class In>
Rest rest_on(const In& in, const Body& base) {
  Scene scene;
  const Vec3 h(0.1, 0.08, 0.05);
  scene.bodies = {base, off_centre("brick", h, at(0, 0, h.z()))};
  const Pose from = scene.bodies[1].pose, to = in(scene)[1].pose;
  return {(to.position() - from.position()).norm(), (to.rotation() - from.rotation()).norm()};
}

TEST_P(HullIn, LiesStillOnAPlaneABoxAndAHull) {
  const auto in = [&](const Scene& scene) { return end(scene); };
  const Vec3 h(0.5, 0.4, 0.1);
  // MuJoCo's contacts are soft (mujoco_world.cpp); ours tolerate an overlap of 1e-4 m.
  const double sunk = is_mujoco() ? 1e-3 : is_single() ? 5e-4 : 2e-4;
  std::vector<Body> bases = {fixed({.name = "ground", .shape = Plane(Vec3::UnitZ(), 0)})};
  if (!is_mujoco()) {  // which gives a mesh one point on all but planes, about which it rocks
    bases.push_back(fixed(box("table", h, at(0, 0, -0.1))));
    bases.push_back(fixed(off_centre("block", h, at(0, 0, -0.1))));
  }
  for (const Body& base : bases) {
    const Rest rest = rest_on(in, base);
    EXPECT_LT(rest.way, sunk) << base.name;
    EXPECT_LT(rest.turn, 2e-3) << base.name;
  }
}

TEST_F(WorldFixture, ACanRollsDownAHullAsDownItsBox) {
  const Eigen::Quaterniond tilt(Eigen::AngleAxisd(0.1, Vec3::UnitY()));
  const auto state_on = [&](const Body& ramp) {
    Scene scene;
    scene.duration = 0.5;
    constexpr double overlap = 1e-5;  // m, so that no rounding parts them at the start
    Body can{.name = "can", .shape = Cylinder(0.05, 0.1)};
    can.pose =
        Pose(tilt * Vec3(0, 0, 0.15 - overlap),
             tilt * Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitX())));
    scene.bodies = {fixed(ramp), can};
    return run(scene).states()[1];
  };
  const Vec3 h(1, 0.5, 0.1);
  const BodyState on_box = state_on(box("ramp", h, Pose(Vec3::Zero(), tilt))),
                  on_hull = state_on(off_centre("ramp", h, Pose(Vec3::Zero(), tilt)));
  // Rolling without slip: s = g sin(a) t² / 3.
  EXPECT_NEAR(on_hull.pose.position().dot(tilt * Vec3::UnitX()), 9.81 * std::sin(0.1) * 0.25 / 3,
              2e-3);
  EXPECT_LT((on_hull.pose.position() - on_box.pose.position()).norm(), 1e-9);
  EXPECT_LT((on_hull.velocity - on_box.velocity).norm(), 1e-9);
}

}  // namespace
}  // namespace touchstone
