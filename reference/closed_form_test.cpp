#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "reference/contact_of.hpp"
#include "reference/facing_feature.hpp"
#include "reference/manifold.hpp"
#include "reference/random_bodies_test.hpp"
#include "reference/support.hpp"

namespace touchstone {
namespace {

using Quaternion = Eigen::Quaterniond;

const Quaternion upright(1, 0, 0, 0);
const Quaternion along_x(1, 0, 1, 0);
const Quaternion along_y(1, -1, 0, 0);

struct Case {
  const char* name;
  Configuration configuration;
  double signed_distance;
  Vec3 normal;
};

std::vector<Case> closed_forms() {
  const Cylinder unit(1, 1);
  return {
      {"sphere off the rim, 3-4-5",
       {unit, Pose(), Sphere(2), Pose({4, 0, 5}, upright)},
       3,
       {-0.6, 0, -0.8}},
      {"sphere centre inside, nearer to the cap",
       {unit, Pose(), Sphere(0.5), Pose({0.25, 0, 0.75}, upright)},
       -0.75,
       {0, 0, -1}},
      {"sphere centre inside, nearer to the side",
       {unit, Pose(), Sphere(0.5), Pose({0.75, 0, 0.25}, upright)},
       -0.75,
       {-1, 0, 0}},
      {"capsule end off the rim",
       {unit, Pose(), Capsule(0.5, 1), Pose({4, 0, 6}, upright)},
       4.5,
       {-0.6, 0, -0.8}},
      {"capsule across the cap",
       {unit, Pose({0, 0, 2}, upright), Capsule(0.5, 3), Pose({0, 0, 0}, along_x)},
       0.5,
       {0, 0, 1}},
      {"crossed cylinders",
       {Cylinder(1, 5), Pose({0, 0, 1.25}, along_x), Cylinder(0.5, 5), Pose({0, 0, 0}, along_y)},
       -0.25,
       {0, 0, 1}},
      {"parallel cylinders",
       {unit, Pose({3, 4, 0.5}, upright), Cylinder(2, 1), Pose()},
       2,
       {0.6, 0.8, 0}},
      {"cap on cap", {unit, Pose({0.5, 0, 1.75}, upright), unit, Pose()}, -0.25, {0, 0, 1}},
      {"box edge at the side, 3-4-5",
       {Cylinder(1, 3), Pose(), Box({1, 1, 1}), Pose({4, 5, 0}, upright)},
       4,
       {-0.6, -0.8, 0}},
      {"cap on box face",
       {unit, Pose({1, 1, 1.75}, upright), Box({2, 2, 1}), Pose()},
       -0.25,
       {0, 0, 1}},
      {"cylinder off the box's vertex",
       {unit, Pose({0, 0, 3}, upright), Box({1, 1, 1}), Pose()},
       1,
       {0, 0, 1}},
  };
}

TEST(Contact, HasTheDistanceAndNormalOfTheClosedForm) {
  for (const Case& c : closed_forms()) {
    SCOPED_TRACE(c.name);
    const SignedDistance answer = signed_distance(c.configuration);
    EXPECT_NEAR(answer.value, c.signed_distance, 1e-14);
    EXPECT_LT((answer.normal - c.normal).norm(), 1e-7);
    EXPECT_EQ(overlaps(c.configuration), c.signed_distance <= 0);
    EXPECT_EQ(contact(c.configuration, 0).points().empty(), c.signed_distance > 0);
  }
}

// The thesis's figure 20: did the body come from the side or from above? Both ways out are as long.
TEST(Contact, PreviousNormalDecidesBetweenSideAndTop) {
  const Cylinder can(1, 2);
  const Vec3 side(1, 0, 0), top(0, 0, 1);
  const struct {
    const char* name;
    Configuration configuration;
  } table[] = {
      {"cylinder", {can, Pose({1.75, 0, 3.75}, upright), can, Pose()}},
      {"box", {can, Pose({1.75, 0, 3.75}, upright), Box({1, 1, 2}), Pose()}},
      {"sphere", {can, Pose({0.75, 0, 1.75}, upright), Sphere(0.5), Pose()}},
  };
  for (const auto& row : table) {
    SCOPED_TRACE(row.name);
    for (const Vec3& previous : {side, top}) {
      const Contact answer = contact(row.configuration, 1e-6, &previous);
      EXPECT_NEAR(answer.normal.dot(previous), 1, 1e-15);
      EXPECT_NEAR(answer.signed_distance, signed_distance(row.configuration).value, 1e-15);
    }
  }
}

TEST(CylinderOnPlane, PosedPlaneWithALongNormalIsTheSameHalfSpace) {
  const Configuration c{Cylinder(1, 2), Pose({5, 6, 4}, upright), Plane({0, 0, 8}, 4),
                        Pose({1, 2, 1}, upright)};  // 8 (z − 1) <= 4
  EXPECT_NEAR(signed_distance(c).value, 0.5, 1e-15);
}

// One's end lies 0.002 beyond the other's axis. Along the vertical, which the previous normal asks
// for, the generators would cross there: the end and the other's axis share what is between them by
// the radii, and both surfaces have fallen off there. Of cylinders as wide the shorter one comes
// first.
TEST(CylinderCylinder, GeneratorsThatCrossBeyondAnEndMeetBetweenThatEndAndTheCrossing) {
  constexpr double beyond = 0.002;
  const double fall = 1 - std::sqrt(1 - beyond * beyond);  // part of radii that add up to 1
  const Vec3 vertical(0, 0, 1);
  for (const double side : {1.0, -1.0}) {
    for (const double half_length : {0.9, 1.5}) {
      for (const double radius : {0.5, 0.25, 0.75}) {
        const Contact answer =
            contact({Cylinder(radius, 1), Pose({side * (1 + beyond), 0, radius - 0.01}, along_x),
                     Cylinder(1 - radius, half_length), Pose({0, 0, radius - 1}, along_y)},
                    beyond, &vertical);
        EXPECT_NEAR((answer.normal - vertical).norm(), 0, 1e-15);
        EXPECT_NEAR(answer.signed_distance, -0.01, 1e-15);
        ASSERT_EQ(answer.points().size(), 1u);
        const ContactPoint& point = answer.points()[0];
        EXPECT_NEAR(point.depth, 0.01, 1e-15);
        const double height = -0.005 + (2 * radius - 1) * fall / 2;
        const Vec3 between(side * beyond * (1 - radius), 0, height);
        EXPECT_NEAR((point.position - between).norm(), 0, 1e-8);
      }
    }
  }
}

// Likewise of generators along one line, the end of one of which lies 0.002 beyond that of the
// other.
TEST(CylinderCylinder, GeneratorsEndToEndMeetBetweenTheirEnds) {
  constexpr double beyond = 0.002;
  const Vec3 vertical(0, 0, 1);
  for (const double side : {1.0, -1.0}) {
    for (const double radius : {0.25, 0.75}) {
      const Contact answer =
          contact({Cylinder(radius, 1), Pose({side * (2.5 + beyond), 0, radius - 0.01}, along_x),
                   Cylinder(1 - radius, 1.5), Pose({0, 0, radius - 1}, along_x)},
                  0.02, &vertical);
      EXPECT_NEAR((answer.normal - vertical).norm(), 0, 1e-15);
      EXPECT_NEAR(answer.signed_distance, -0.01, 1e-15);
      ASSERT_EQ(answer.points().size(), 1u);
      const double x = answer.points()[0].position.x();
      EXPECT_NEAR(x, side * (1.5 + beyond * (1 - radius)), 1e-8);
    }
  }
}

TEST(FacingPart, GoesFromAllToNoneWhereATenthLiesWithinTheSlack) {
  constexpr double slack = 1e-3;  // of a length of 2
  EXPECT_EQ(facing_part(1, 0, slack), 1);
  EXPECT_EQ(facing_part(1, -0.0049, slack), 1);
  EXPECT_NEAR(facing_part(1, 0.00525, slack), 0.5, 1e-12);
  EXPECT_NEAR(facing_part(1, 0.004, slack, 0.1, 0.5), 0.5, 1e-12);
  EXPECT_EQ(facing_part(1, 0.0055001, slack), 0);
  // However small it is, it leans by at most 0.1.
  EXPECT_EQ(facing_part(1e-4, 0.0909, slack), 1);
  EXPECT_NEAR(facing_part(1e-4, 0.105 / 1.1, slack), 0.5, 1e-12);
  EXPECT_EQ(facing_part(1e-4, 0.1, slack), 0);
}

// Of a face that leans the side that is nearest to the other body stays; caps, generators and
// edges, whose points draw together in the end, stay whole.
TEST(FacingFeature, OfAFaceShrinksToItsNearestSide) {
  constexpr double slack = 1e-3, sine = 0.004;
  const Pose pose({1, 2, 3}, upright);
  const Vec3 outward(sine, 0, std::sqrt((1 - sine) * (1 + sine)));
  const auto expect_near = [](const Vec3& x, const Vec3& y) {
    EXPECT_NEAR((x - y).norm(), 0, 1e-15);
  };
  const FacingFeature face = facing(posed(Box({1, 2, 3}), pose, Vec3::Zero()), -outward, slack);
  ASSERT_EQ(face.kind, FacingFeature::Kind::rectangle);
  EXPECT_NEAR(face.half_side[0], 0.5, 1e-12);
  EXPECT_NEAR(face.left_out[0], 1, 1e-12);
  EXPECT_EQ(face.half_side[1], 2);
  expect_near(face.middle - face.half_side[0] * Vec3::UnitX(), Vec3(-1, 0, -3));
  constexpr double steeper = 0.00525;
  const Vec3 aside(std::sqrt((1 - steeper) * (1 + steeper)), 0, steeper);
  const FacingFeature side = facing(posed(Cylinder(2, 1), pose, Vec3::Zero()), aside, slack);
  ASSERT_EQ(side.kind, FacingFeature::Kind::segment);
  EXPECT_LT(side.part, 1);
  EXPECT_EQ(side.half_length, 1);
  EXPECT_NEAR(side.left_out[0], -2 * (1 - side.part), 1e-15);
  expect_near(side.middle, Vec3(2, 0, 0));
}

TEST(Support, OfAHalfSpaceIsInfiniteButAlongItsNormal) {
  const Plane plane({0, 0, 2}, 3);  // z <= 1.5
  EXPECT_EQ(support(plane, Pose({5, 6, 1}, upright), Vec3(0, 0, 1)), 2.5);
  EXPECT_TRUE(std::isinf(support(plane, Pose(), Vec3(0, 0, -1))));
  EXPECT_TRUE(std::isinf(support(plane, Pose(), Vec3(0.6, 0, 0.8))));
}

TEST(Margins, AreOfTheSmallerBody) {
  const Extents needle{1e-3, 2}, cube{1, 1};
  for (const bool exchanged : {false, true}) {
    const Margins margins(exchanged ? cube : needle, exchanged ? needle : cube, 0, -0.5, 0);
    EXPECT_EQ(margins.slack, 1e-3);
    EXPECT_EQ(margins.flat, 1e-3);
    EXPECT_NEAR(margins.clear_rise(), 1e-9, 1e-24);
    EXPECT_NEAR(margins.unseen_depth(), 0.5e-9 + margins.rounding, 1e-24);
  }
}

// The axis is parallel to an edge, in rounded rotations all but parallel, which must not hide that
// the edge touches the side.
TEST(CylinderBox, EdgeParallelToTheAxisTouchesTheSide) {
  const Configuration table[] = {
      {Cylinder(0x1.294ce49p-1, 0x1.e5debd4p-3),
       Pose({0x1.d8af52f8p-1, -0x1.3bb5decp+0, 0x1.96086e2p-2}, {-1, 4, -1, 1}),
       Box({0x1.2bc5c818p-1, 0x1.8a87e3ep-3, 0x1.cb6c224p-2}),
       Pose({-0x1.4ef983p-4, -0x1.1b484ab8p-1, 0x1.6ab93f1p-2}, {-4, 11, -7, 2})},
      {Cylinder(0x1.e93abfcp-3, 0x1.38e7232p-3),
       Pose({-0x1.e927938p-2, -0x1.35e8b2fp-1, -0x1.57ee448p-3}, {1, -1, -4, -1}),
       Box({0x1.36f5a3cp-3, 0x1.9b85399p-2, 0x1.2966a33p-1}),
       Pose({0x1.d4e5f2cp-4, -0x1.36a9988p-1, -0x1.afb913bp-2}, {4, -7, -11, -2})},
  };
  for (const Configuration& c : table) EXPECT_NEAR(signed_distance(c).value, 0, 1e-15);
}

// Rims that meet in parallel tangents: of some arcs all bounds fail, and what may be missed there
// counts as error. In the second configuration the bodies may also be apart for all it knows.
constexpr double rounding_of_31_m = 2.5e-13;  // of lengths that add up to no more
TEST(CertifiedDistance, IsNotClaimedForArcsOnWhichTheSearchGaveUp) {
  const std::vector<std::pair<Configuration, double>> table = {
      {{Cylinder(1, 3.25),
        Pose({0x1.2a818b0d83d0fp+2, 0x1.b33966b99392p+2, -0x1.175fe690f2b7ep+2},
             {0x1.03368b82f2231p-1, 0x1.2e6cd07299afcp-2, -0x1.67e6ba974dbb9p-1,
              0x1.9eaa1bb5b88bep-2}),
        Cylinder(3.5, 0.25),
        Pose({0x1.aaa6abff5af1ap+1, 0x1.5b98bf2128bb6p+3, -0x1.2faf8d9efe9c5p-1},
             {0x1.3e447b0348375p-1, 0x1.14531cfc1bc8fp-1, -0x1.134d05cf6fdffp-1,
              0x1.752dd2430d2ep-3})},
       -6.5475180832663682e-11},
      {{Cylinder(2.75, 3.75),
        Pose({-0x1.1ba264b40654p+1, 0x1.74434743a6972p+2, -0x1.02819b4059ed8p+3},
             {0x1.5e64244c62e98p-23, -0x1.d5de4f9841e66p-1, -0x1.96c7ec2a85a7dp-2,
              0x1.94bbb12fc027cp-22}),
        Cylinder(4, 4),
        Pose({-0x1.2f888349fa70dp-1, -0x1.788080619798dp-1, -0x1.50338c7f39e3p-2}, upright)},
       -1.264865061895617e-13}};
  for (const auto& [c, distance] : table) {
    const CertifiedDistance certified = certified_distance(c);
    EXPECT_NEAR(certified.value, distance, 1e-14);
    EXPECT_GT(certified.error_bound, rounding_of_31_m);
    EXPECT_LE(certified.error_bound, 1e-8);
  }
}

// The same, but how the rims bend away from the best normal proves it for all arcs.
TEST(CertifiedDistance, IsProvenByTheBestNormalWhereArcsAreLeftOpen) {
  const Configuration c{Cylinder(3.25, 2.75),
                        Pose({0x1.171848db4edd8p+0, 0x1.a9b636cd32c6cp+1, -0x1.6fffffff14d0fp+2},
                             {0x1.920a976ca45f1p-51, 1, 1, 0}),
                        Cylinder(0.25, 3), Pose()};
  const CertifiedDistance certified = certified_distance(c);
  EXPECT_NEAR(certified.value, -8.5559526589006752e-10, 1e-14);
  EXPECT_LE(certified.error_bound, rounding_of_31_m);
}

TEST(PreviousNormal, IsKeptAsLongAsItIsAsGood) {
  const Pose centre;
  const auto hinted = [](const Pose& pose_b, const Vec3& previous, double threshold) {
    return contact({Cylinder(1, 1), Pose(), Sphere(0.5), pose_b}, threshold, &previous);
  };
  // A sphere in the middle of a square can: every way out along the axis or off it is as short.
  for (const Vec3& n : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(0.6, 0.8, 0), Vec3(-1, 0, 0)}) {
    const Contact c = hinted(centre, n, 1e-6);
    EXPECT_LE((c.normal - n).norm(), 1e-15);
    EXPECT_NEAR(c.signed_distance, -1.5, 1e-15);
  }
  EXPECT_NEAR(hinted(centre, Vec3(0.6, 0, 0.8), 1e-6).signed_distance, -1.5, 1e-15);

  // A centre 1e-7 beyond the rim: oblique, but along the axis is no worse than that.
  const Pose beyond_rim({1 + 1e-7, 0, 1 + 1e-7}, {1, 0, 0, 0});
  EXPECT_EQ(hinted(beyond_rim, Vec3(0, 0, -1), 1e-6).normal, Vec3(0, 0, -1));
  EXPECT_NEAR(hinted(beyond_rim, Vec3(0, 0, -1), 1e-9).normal.z(), -std::sqrt(0.5), 1e-6);
  // Nor is any oblique one, of no axis or face.
  const Vec3 oblique = Vec3(-0.3, 0, -1).normalized();
  EXPECT_EQ(hinted(beyond_rim, oblique, 1e-6).normal, oblique);
}

// Two parallel sides as seen along a normal off the line between the axes: where their surfaces
// have fallen off by more than three quarters of the radii they hardly face each other. Of needles,
// whose radii are less than what a surface may lie above the deepest point.
TEST(PreviousNormal, OffTheLineBetweenParallelSidesLeavesTheirEndsAsLongAsTheyFaceEachOther) {
  constexpr double r = 1e-4;
  const Cylinder needle(r, 2);
  const Configuration c{needle, Pose({1.9 * r, 0, 0}, upright), needle, Pose()};
  for (const double side : {1.0, -1.0}) {
    const auto points = [&](double sine) {
      const Vec3 previous(std::sqrt(1 - sine * sine), side * sine, 0);
      const Contact answer = contact(c, 2, &previous);
      EXPECT_NEAR((answer.normal - previous).norm(), 0, 1e-15);
      return answer.points().size();
    };
    EXPECT_EQ(points(1.49 / 1.9), 2u);
    EXPECT_EQ(points(1.51 / 1.9), 1u);
  }
}

}  // namespace
// The way to a rim that all but faces a surface is short, and rounding is along the axis, too.
TEST(FacingFeature, ARimThatLeansByAHairLiesInItsCap) {
  Random random(7);
  const Cylinder cylinder(0.7, 0.4);
  for (int i = 0; i < 2000; ++i) {
    const Pose pose(Vec3::Zero(), random.turn());
    const Vec3 aside = random.sign() * pose.rotation().col(0);
    const Vec3 outward = (pose.axis() + random.power_of_ten(-12, -6) * aside).normalized();
    const FacingFeature rim = facing(posed(cylinder, pose, Vec3::Zero()), outward, 1e-15);
    EXPECT_NEAR(rim.middle.dot(pose.axis()), cylinder.half_length(), 1e-14);
  }
}

}  // namespace touchstone
