#include "candidates/candidates.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

using Quaternion = Eigen::Quaterniond;

const Quaternion upright(1, 0, 0, 0);
const Quaternion along_x = Quaternion(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitY()));

Vec3 normal_of(const ts_answer& a) { return Vec3(a.normal[0], a.normal[1], a.normal[2]); }

/// A contact that every engine must get right in the way it is called here: faces and sides meet,
/// no rounded edge is involved.
struct Case {
  const char* name;
  Configuration configuration;
  double signed_distance;
  Vec3 normal;
};

std::vector<Case> plain_contacts() {
  const Cylinder a(0.5, 1);
  return {
      {"standing on a plane",
       {a, Pose({3, 2, 2.99}, upright), Plane({0, 0, 1}, 2), Pose()},
       -0.01,
       {0, 0, 1}},
      {"lying on a posed plane",
       {a, Pose({3, 2, 1.49}, along_x), Plane({0, 0, 1}, 0), Pose({0, 0, 1}, upright)},
       -0.01,
       {0, 0, 1}},
      {"sphere at the side",
       {a, Pose({1, 0, 0}, upright), Sphere(0.55), Pose({0, 0, 0.3}, upright)},
       -0.05,
       {1, 0, 0}},
      {"sphere under the cap",
       {a, Pose({0, 0, 1.45}, upright), Sphere(0.5), Pose({0.1, 0.1, 0}, upright)},
       -0.05,
       {0, 0, 1}},
      {"crossed capsule",
       {a, Pose({0, 0, 0.95}, along_x), Capsule(0.5, 1),
        Pose({0, 0, 0}, Quaternion(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitX())))},
       -0.05,
       {0, 0, 1}},
      {"crossed cylinder",
       {a, Pose({0, 0, 0.95}, along_x), Cylinder(0.5, 1),
        Pose({0, 0, 0}, Quaternion(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitX())))},
       -0.05,
       {0, 0, 1}},
      {"standing on a box",
       {a, Pose({0.2, 0.1, 1.95}, upright), Box({2, 2, 1}), Pose()},
       -0.05,
       {0, 0, 1}},
      {"lying on a box",
       {a, Pose({0.2, 0.1, 1.45}, along_x), Box({2, 2, 1}), Pose()},
       -0.05,
       {0, 0, 1}},
  };
}

/// Everyday accuracy of iterative engines on such contacts, metres and sine of the angle; ODE's MPR
/// on crossed capsules is the worst.
constexpr double everyday = 2e-3;

TEST(Candidates, AgreeOnPlainContactsInDepthAndNormal) {
  for (const ts_candidate* candidate : all_candidates()) {
    for (const Case& c : plain_contacts()) {
      SCOPED_TRACE(std::string(candidate->name) + ": " + c.name);
      const ts_answer a = answer(*candidate, c.configuration, 0);
      ASSERT_EQ(a.status, TS_CONTACT);
      EXPECT_NEAR(a.signed_distance, c.signed_distance, everyday);
      EXPECT_LT((normal_of(a) - c.normal).norm(), everyday);
      ASSERT_GE(a.point_count, 1);
      double deepest = -1;
      for (int i = 0; i < a.point_count; ++i) deepest = std::max(deepest, a.points[i].depth);
      EXPECT_EQ(deepest, -a.signed_distance);
    }
  }
}

TEST(Candidates, TurnWithTheWorld) {
  // The same contacts seen from a turned and shifted frame: every convention is exercised.
  const Quaternion turn = Quaternion(0.5, -0.1, 0.7, 0.3).normalized();
  const Vec3 shift(0.3, -0.2, 0.5);
  for (const ts_candidate* candidate : all_candidates()) {
    for (const Case& c : plain_contacts()) {
      SCOPED_TRACE(std::string(candidate->name) + ": " + c.name);
      const auto moved = [&](const Pose& p) {
        return Pose(turn * p.position() + shift, turn * p.orientation());
      };
      const Configuration& plain = c.configuration;
      const ts_answer a =
          answer(*candidate, {plain.a, moved(plain.pose_a), plain.b, moved(plain.pose_b)}, 0);
      ASSERT_EQ(a.status, TS_CONTACT);
      EXPECT_NEAR(a.signed_distance, c.signed_distance, everyday);
      EXPECT_LT((normal_of(a) - turn * c.normal).norm(), everyday);
    }
  }
}

TEST(Candidates, SayNoneWhenApart) {
  for (const ts_candidate* candidate : all_candidates()) {
    for (const Case& c : plain_contacts()) {
      SCOPED_TRACE(std::string(candidate->name) + ": " + c.name);
      const Configuration& k = c.configuration;
      const Pose lifted(k.pose_a.position() + (0.01 - c.signed_distance) * c.normal,
                        k.pose_a.orientation());
      EXPECT_EQ(answer(*candidate, {k.a, lifted, k.b, k.pose_b}, 0).status, TS_NONE);
    }
  }
}

TEST(Candidates, ThresholdReportsContactsStillApart) {
  for (const char* name : {"reference", "bullet"}) {
    const Configuration apart{Cylinder(0.5, 1), Pose({0, 0, 2.001}, upright), Box({2, 2, 1}),
                              Pose()};
    const ts_answer a = answer(find_candidate(name), apart, 0.01);
    ASSERT_EQ(a.status, TS_CONTACT) << name;
    EXPECT_NEAR(a.signed_distance, 0.001, 1e-9) << name;
  }
}

void expect_same(const ts_answer& x, const ts_answer& y) {
  EXPECT_EQ(x.status, y.status);
  EXPECT_EQ(x.signed_distance, y.signed_distance);
  EXPECT_EQ(normal_of(x), normal_of(y));
  ASSERT_EQ(x.point_count, y.point_count);
  for (int i = 0; i < x.point_count; ++i) {
    EXPECT_EQ(x.points[i].depth, y.points[i].depth);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(x.points[i].position[k], y.points[i].position[k]);
  }
}

TEST(Candidates, AnswerDoesNotDependOnWhatWasQueriedBefore) {
  for (const ts_candidate* candidate : all_candidates()) {
    for (const Case& c : plain_contacts()) {
      const Configuration& k = c.configuration;
      const PreparedPair pair(*candidate, k.a, k.b, 0);
      const ts_pose a = to_ts_pose(k.pose_a), b = to_ts_pose(k.pose_b);
      const ts_pose elsewhere = to_ts_pose(
          Pose(k.pose_a.position() + Vec3(0.03, -0.02, 0.01), Quaternion(0.9, 0.1, -0.3, 0.2)));
      const ts_answer first = pair.query(a, b);
      pair.query(elsewhere, b);
      const ts_answer again = pair.query(a, b);
      SCOPED_TRACE(std::string(candidate->name) + ": " + c.name);
      expect_same(first, again);
    }
  }
}

// What the engines do, as measured; a new version that changes it should be noticed.

int points(const char* candidate, int plain_contact) {
  return answer(find_candidate(candidate), plain_contacts().at(plain_contact).configuration, 0)
      .point_count;
}

TEST(Bullet, GivesOnePointPerQueryEvenForAStandingCylinder) {
  for (int i = 0; i < static_cast<int>(plain_contacts().size()); ++i) {
    EXPECT_EQ(points("bullet", i), 1) << plain_contacts()[i].name;
  }
}

TEST(Ode, GivesFourPointsStandingAndTwoLying) {
  EXPECT_EQ(points("ode", 0), 4);
  EXPECT_EQ(points("ode", 1), 2);
  EXPECT_EQ(points("ode", 7), 2);
}

TEST(Reference, GivesThreePointsStandingAndTwoLying) {
  EXPECT_EQ(points("reference", 0), 3);
  EXPECT_EQ(points("reference", 1), 2);
}

TEST(Bullet, MissesAShallowRimContactBecauseItsEdgesAreRounded) {
  // A rim tilted by 45° reaches (0.5 + 1)/√2 below its centre; the margin of 0.04 takes
  // 0.04 (√2 − 1) = 0.017 of it away.
  const Quaternion tilted(Eigen::AngleAxisd(M_PI / 4, Vec3::UnitX()));
  const double reach = 1.5 / std::sqrt(2.0);
  const Configuration c{Cylinder(0.5, 1), Pose({0, 0, 1 + reach - 0.01}, tilted), Box({2, 2, 1}),
                        Pose()};
  EXPECT_EQ(answer(find_candidate("reference"), c, 0).status, TS_CONTACT);
  EXPECT_EQ(answer(find_candidate("bullet"), c, 0).status, TS_NONE);
}

TEST(FindCandidate, NamesThoseThereAre) {
  EXPECT_THAT([] { find_candidate("bulet"); },
              testing::ThrowsMessage<InvalidInput>(testing::AllOf(
                  testing::HasSubstr("bulet"), testing::HasSubstr("reference, bullet, ode"))));
}

TEST(PreparedPair, PlaneNormalIsPassedWithUnitLength) {
  const ts_shape plane = to_ts_shape(Plane({0, 3, 4}, 10));
  EXPECT_EQ(plane.size[1], 0.6);
  EXPECT_EQ(plane.size[2], 0.8);
  EXPECT_EQ(plane.size[3], 2);
}

}  // namespace
}  // namespace touchstone
