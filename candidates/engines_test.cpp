// Known defects of each engine, from its own issue tracker or statements of its maintainers;
// docs/engines.md gives the sources. The tests detect a new version that changes them.
#include <cmath>
#include <gtest/gtest.h>

#include "candidates/testing/plain_contacts.hpp"
#include "oracle/truth.hpp"

namespace touchstone {
namespace {

int points(const char* candidate, int plain_contact) {
  return answer(candidate, plain_contacts().at(plain_contact).configuration).point_count;
}

constexpr int standing_on_plane = 0, lying_on_plane = 1, standing_on_box = 6, lying_on_box = 7;

// Bullet

TEST(Bullet, FindsOnePointAtATimeAndMoreOverSteps) {  // bullet3 #1514
  for (int i = 0; i < static_cast<int>(plain_contacts().size()); ++i) {
    EXPECT_EQ(points("bullet", i), 1) << plain_contacts()[i].name;
  }
  EXPECT_EQ(points("bullet-persistent", standing_on_plane), 4);
  EXPECT_EQ(points("bullet-persistent", lying_on_plane), 2);
}

TEST(Bullet, RoundsSharpEdges) {  // godot-jolt #516
  // A rim tilted by 45° reaches (0.5 + 1)/√2 below its centre; the margin of 0.04 takes
  // 0.04 (√2 − 1) = 0.017 of it away.
  const Quaternion tilted(Eigen::AngleAxisd(M_PI / 4, Vec3::UnitX()));
  const double reach = 1.5 / std::sqrt(2.0);
  const Configuration c{Cylinder(0.5, 1), Pose({0, 0, 1 + reach - 0.01}, tilted), Box({2, 2, 1}),
                        Pose()};
  EXPECT_EQ(answer("reference", c).status, TS_CONTACT);
  EXPECT_EQ(answer("bullet", c).status, TS_NONE);
  EXPECT_EQ(answer("bullet-float", c).status, TS_NONE);
  const Answer sharp = answer("bullet-margin-0", c);
  ASSERT_EQ(sharp.status, TS_CONTACT);
  EXPECT_NEAR(sharp.signed_distance, -0.01, 1e-6);
}

/// Tilted, level, and with a hull: what Bullet rounds by its margins, at every kind of feature.
std::vector<Configuration> against_rounded_edges() {
  const Quaternion tilted(Eigen::AngleAxisd(0.6, Vec3(1, 0.3, 0.2).normalized()));
  const std::vector<Vec3> corners{{-1, -1, 0}, {2, -1, 0.25}, {0, 2, -0.25}, {0, 0, -3}};
  std::vector<Configuration> result;
  for (const double height : {1.0, 1.4, 1.8, 2.2}) {
    for (const Shape& b : {Shape(Box({0.5, 0.7, 0.6})), Shape(Cylinder(0.6, 0.5)),
                           Shape(oracle::convex_hull(corners)), Shape(Plane({0, 0, 1}, 0.1)),
                           Shape(Capsule(0.3, 0.5))}) {
      result.push_back({Cylinder(0.5, 1), Pose({0.3, 0.2, height}, tilted), b, Pose()});
    }
  }
  return result;
}

TEST(Bullet, SolvesTheBodiesThatItsMarginsRound) {
  constexpr double solved = 1e-5;  // metres; GJK's and EPA's tolerance
  int contacts = 0;
  for (const Configuration& c : against_rounded_edges()) {
    for (const char* name : {"bullet", "bullet-margin-0"}) {
      const Answer a = answer(name, c, 1);
      const bool is_sharp = std::string(name) != "bullet";
      ASSERT_EQ(a.roundings.has_value(), !is_sharp);
      Configuration model = c;
      if (!is_sharp) {
        model = {std::get<Cylinder>(with_rounding(c.a, (*a.roundings)[0])), c.pose_a,
                 with_rounding(c.b, (*a.roundings)[1]), c.pose_b};
        EXPECT_NEAR((*a.roundings)[0], 0.04, 1e-9);
      }
      if (a.status != TS_CONTACT) continue;
      ++contacts;
      EXPECT_NEAR(a.signed_distance, oracle::truth(model).signed_distance.midpoint(), solved)
          << name << " " << testing::PrintToString(c.pose_a.position().z()) << " "
          << shape_name(c.b);
    }
  }
  EXPECT_GE(contacts, 16);
}

TEST(Bullet, HasAGivenRoundingAsItsMargin) {
  for (const Configuration& sharp : against_rounded_edges()) {
    const Configuration c{Cylinder(0.5, 1, 0.2), sharp.pose_a, with_rounding(sharp.b, 0.1),
                          sharp.pose_b};
    for (const char* name : {"bullet", "bullet-margin-0", "reference"}) {
      const Answer a = answer(name, c, 1);
      EXPECT_FALSE(a.roundings) << name;  // it is modelled as it was given
      if (a.status != TS_CONTACT) continue;
      EXPECT_NEAR(a.signed_distance, oracle::truth(c).signed_distance.midpoint(), 1e-5) << name;
    }
  }
}

TEST(Engines, ThatKnowNoRoundingSayThatTheyDoNotSupportIt) {
  const Configuration c{Cylinder(0.5, 1, 0.1), Pose({0, 0, 0.9}), Plane({0, 0, 1}, 0), Pose()};
  for (const char* name : {"ode", "fcl", "libccd-mpr", "prism:16", "bullet-hull:16"}) {
    const Answer a = answer(name, c);
    EXPECT_EQ(a.status, TS_UNSUPPORTED) << name;
    EXPECT_EQ(a.reason, "does not round bodies in this way") << name;
  }
}

TEST(Bullet, TakesACapsulesRadiusForItsMargin) {  // bullet3 #928
  // A capsule has no margin: its round end on a face is found to a micrometre.
  const Configuration c{Cylinder(0.5, 1), Pose({0, 0, 1.8 - 1e-6}, upright), Capsule(0.3, 0.5),
                        Pose()};
  EXPECT_NEAR(answer("bullet", c).signed_distance, -1e-6, 1e-9);
}

// ODE

TEST(Ode, CollidesCylindersThroughLibccd) {  // lovr #181
  EXPECT_EQ(points("ode", 5), 1);  // crossed cylinders: without libccd there would be none
}

TEST(Ode, GivesALyingCylinderTwoPointsAndACapsuleOne) {  // gz-physics #692
  EXPECT_EQ(points("ode", standing_on_plane), 4);
  EXPECT_EQ(points("ode", lying_on_plane), 2);
  EXPECT_EQ(points("ode", lying_on_box), 2);
  // A capsule along a cylinder touches it in a line, which the reported single point does not
  // support.
  const Configuration c{Cylinder(0.5, 0.5), Pose({0, 0, 0.699}, along_x), Capsule(0.2, 0.3),
                        Pose({0, 0, 0}, along_x)};
  EXPECT_EQ(answer("ode", c).point_count, 1);
}

TEST(Ode, AThinDiscOnABoxHasAllItsPointsAtOneDepth) {  // webots #2947
  const Configuration c{Cylinder(0.1, 0.015), Pose({0, 0, 0.0149}, upright), Box({5, 5, 0.05}),
                        Pose({0, 0, -0.05}, upright)};
  const Answer a = answer("ode", c);
  ASSERT_EQ(a.point_count, 8);
  for (int i = 0; i < a.point_count; ++i) EXPECT_NEAR(a.points[i].depth, 1e-4, 1e-12);
}

/// A sphere whose centre lies on the axis, nearer to the side than to a cap: 0.7 deep.
const Configuration sphere_on_axis{Cylinder(0.3, 0.76), Pose({0, 0, 0.1}, upright), Sphere(0.4),
                                   Pose()};

TEST(Ode, HasNoNormalForASphereOnTheAxis) {  // found here
  const Answer a = answer("ode", sphere_on_axis);
  EXPECT_NEAR(a.signed_distance, -0.7, 1e-12);
  EXPECT_TRUE(normal_of(a).hasNaN());
}

// FCL

/// The configuration of fcl #375: a disc that stands exactly on a plate.
const Configuration disc_on_plate{Cylinder(0.08, 0.001), Pose({0, 0, 0.0085}, upright),
                                  Box({0.245, 0.315, 0.0075}),
                                  Pose({-0.25, 0, 0}, Quaternion(1, 0, 0, 1))};

/// The configuration of drake #21234: a cylinder less than a nanometre above a plate.
const Configuration barely_apart{
    Cylinder(0.041, 0.085),
    Pose({0.20238033346825459735, 0.027845683594011010065, 0.3114233939246693339},
         Quaternion(0.5886058345265364, 0.6818910619558082, 0.18714854962099609,
                    -0.39184585178457876)),
    Box({0.15, 0.3, 0.008}), Pose({0.4, 0, 0.26885}, upright)};

TEST(Fcl, AnswersExactTouchWithAZeroNormal) {  // fcl #375
  const Answer a = answer("fcl", disc_on_plate);
  ASSERT_EQ(a.status, TS_CONTACT);
  EXPECT_EQ(normal_of(a).norm(), 0);
}

TEST(Fcl, ThrowsOnACylinderThatBarelyMissesABox) {  // drake #21234
  const Answer a = answer("fcl-distance", barely_apart);
  EXPECT_EQ(a.status, TS_CRASHED);
  EXPECT_NE(a.reason.find("validateNearestFeatureOfPolytopeBeingEdge"), std::string::npos)
      << a.reason;
}

TEST(Fcl, NoLongerThrowsInsideACube) {  // fcl #324
  const Configuration c{Cylinder(0.25, 0.125), Pose({0.2, 0, 0}, upright), Box({0.5, 0.5, 0.5}),
                        Pose()};
  EXPECT_NEAR(answer("fcl-distance", c).signed_distance, -0.55, 1e-5);
}

TEST(Fcl, TakesLongForASphereOnTheAxis) {  // found here
  EXPECT_EQ(answer("fcl-distance", sphere_on_axis).status, TS_TIMED_OUT);
  EXPECT_NEAR(answer("fcl", sphere_on_axis).signed_distance, -0.7, 1e-12);
}

TEST(Fcl, AnswersTheSameUpsideDown) {  // drake #8049, as it was mended
  for (const Quaternion& turn : {upright, Quaternion(0, 1, 0, 0)}) {
    const Configuration c{Cylinder(0.5, 1), Pose({0, 0, 0.949}, turn), Plane({0, 0, 1}, 0), Pose()};
    EXPECT_NEAR(answer("fcl", c).signed_distance, -0.051, 1e-12);
  }
}

// libccd

TEST(Libccd, IsNamedByDebiansVersionNotByItsPkgConfigFiles) {
  EXPECT_EQ(find_candidate("libccd-mpr").version, "2.1");
}

TEST(Libccd, MprAnswersExactTouchWithAZeroNormal) {  // fcl #375, of libccd 2.1
  const Answer a = answer("libccd-mpr", disc_on_plate);
  ASSERT_EQ(a.status, TS_CONTACT);
  EXPECT_EQ(normal_of(a).norm(), 0);
}

TEST(Libccd, EpaGivesNoContactPosition) {  // libccd #73
  const Answer a = answer("libccd-gjk", plain_contacts()[standing_on_box].configuration);
  const Vec3 p(a.points[0].position);
  EXPECT_GT((p - Vec3(0.2, 0.1, 0)).head<2>().norm(), 0.6);  // outside the cylinder's 0.5
}

TEST(Libccd, CannotTellTouchFromApart) {  // drake #21673
  const Answer a = answer("libccd-gjk", barely_apart);
  ASSERT_EQ(a.status, TS_CONTACT);
  EXPECT_LT(normal_of(a).dot(normal_of(answer("reference", barely_apart, 1))), -0.99);
}

TEST(Libccd, EpaFindsNoDepthForASphereOnTheAxis) {  // found here
  EXPECT_LT(std::abs(answer("libccd-gjk", sphere_on_axis).signed_distance), 1e-12);
}

TEST(Libccd, AgreesOnStackedAlignedBodies) {  // libccd #25, which is about two cubes
  const Configuration c{Cylinder(1, 1), Pose({0, 0, 1.9}, upright), Box({1, 1, 1}), Pose()};
  for (const char* name : {"libccd-gjk", "libccd-mpr"}) {
    EXPECT_NEAR(answer(name, c).signed_distance, -0.1, 1e-9) << name;
  }
}

// MuJoCo

TEST(Mujoco, HoldsACylinderOnATableByOnePoint) {  // mujoco #420
  const Box table({0.3, 0.6, 0.3});
  const Cylinder can(0.06, 0.06);
  const Answer aside = answer("mujoco", {can, Pose({0, 0.2, 0.359}, upright), table, Pose()});
  ASSERT_EQ(aside.point_count, 1);
  EXPECT_GT(std::hypot(aside.points[0].position[0], aside.points[0].position[1] - 0.2), 0.01);
  // In the centre it lands upright: the point is below its axis.
  const Answer centre = answer("mujoco", {can, Pose({0, 0, 0.359}, upright), table, Pose()});
  ASSERT_EQ(centre.point_count, 1);
  EXPECT_LT(std::hypot(centre.points[0].position[0], centre.points[0].position[1]), 0.001);
}

TEST(Mujoco, HoldsALyingBatteryByOnePoint) {  // mujoco_warp #1555
  const Configuration c{Cylinder(0.007, 0.025), Pose({0.1, 0.05, 0.1068}, along_x),
                        Box({0.3, 0.3, 0.1}), Pose()};
  EXPECT_EQ(answer("mujoco", c).point_count, 1);
}

TEST(Mujoco, StandsAlignedOnAPlaneWithoutNaN) {  // mujoco #2657, of MJX; MuJoCo itself is safe
  const Answer a = answer("mujoco", plain_contacts()[standing_on_plane].configuration);
  ASSERT_EQ(a.point_count, 3);
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(Vec3(a.points[i].position).allFinite());
    EXPECT_NEAR(a.points[i].depth, 0.01, 1e-12);
  }
}

TEST(Mujoco, TurnsANormalRoundInADeepContact) {
  // The pose of fcl #324, in which A comes free along +x after 0.55: MuJoCo gives this depth with
  // the opposite direction.
  const Configuration c{Cylinder(0.25, 0.125), Pose({0.2, 0, 0}, upright), Box({0.5, 0.5, 0.5}),
                        Pose()};
  const Answer a = answer("mujoco", c);
  EXPECT_NEAR(a.signed_distance, -0.55, 1e-6);
  EXPECT_LT(a.normal[0], -0.99);
}

// Our own

TEST(Reference, GivesThreePointsStandingAndTwoLying) {
  EXPECT_EQ(points("reference", standing_on_plane), 3);
  EXPECT_EQ(points("reference", lying_on_plane), 2);
}

}  // namespace
}  // namespace touchstone
