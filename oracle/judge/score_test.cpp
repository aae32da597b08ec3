#include "oracle/judge/score.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <set>
#include <string>

namespace touchstone {
namespace {

/// A can of size 0.5 standing on a box, 1e-3 deep: truth −1e-3 along z, −2e-3 of the size.
const Configuration standing{Cylinder(0.5, 1),
                             Pose(Vec3(0, 0, 1.999), Eigen::Quaterniond::Identity()),
                             Box(Vec3(2, 2, 1)), Pose()};

ts_answer contact(double signed_distance, const Vec3& normal) {
  ts_answer a{};
  a.status = TS_CONTACT;
  a.signed_distance = signed_distance;
  for (int i = 0; i < 3; ++i) a.normal[i] = normal[i];
  a.point_count = 1;
  a.points[0] = {{0, 0, 1}, {normal.x(), normal.y(), normal.z()}, -signed_distance};
  return a;
}

ts_answer none() {
  ts_answer a{};
  a.status = TS_NONE;
  return a;
}

Score scored(const Configuration& c, const ts_answer& a, const Bar& bar = {}) {
  return score(c, oracle::truth(c), a, bar);
}

Configuration lifted(double by) {
  return {standing.a,
          Pose(standing.pose_a.position() + Vec3(0, 0, by), standing.pose_a.orientation()),
          standing.b, standing.pose_b};
}

const Vec3 up(0, 0, 1);

TEST(Score, TheRightAnswerAgreesWithNoError) {
  const Score s = scored(standing, contact(-1e-3, up));
  EXPECT_EQ(s.outcome, Outcome::agree);
  EXPECT_NEAR(*s.depth_error, 0, 1e-12);
  EXPECT_NEAR(*s.normal_regret, 0, 1e-12);
  EXPECT_NEAR(*s.normal_angle, 0, 1e-12);
  EXPECT_EQ(s.points, 1);
}

/// Answered with that normal, and the true depth.
Score along(const Configuration& c, const Vec3& n) {
  const oracle::Truth truth = oracle::truth(c);
  return score(c, truth, contact(truth.signed_distance.midpoint(), n), {});
}

/// A normal turned by `degrees` about an axis.
Vec3 turned(const Vec3& n, const Vec3& axis, double degrees) {
  return Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis.normalized()) * n;
}

constexpr double angle_rounding = 1e-12;

TEST(NormalAngle, IsNoneForAnyMemberOfACircleAndElseTheAngleToIt) {
  // All directions across the axis tie.
  const Configuration c{Cylinder(1, 0.5), Pose(), Capsule(0.25, 2), Pose()};
  for (const double turn : {0.0, 30.0, 45.0, 81.9, 90.0, 200.0}) {
    const Vec3 member = turned(Vec3(1, 0, 0), Vec3(0, 0, 1), turn);
    EXPECT_NEAR(*along(c, member).normal_angle, 0, angle_rounding) << turn;
    const Vec3 off = turned(member, Vec3(0, 0, 1).cross(member), 0.5);
    EXPECT_NEAR(*along(c, off).normal_angle, 0.5, angle_rounding) << turn;
  }
}

TEST(NormalAngle, OfConcentricBodiesIsNoneForAPerfectAnswer) {
  const Configuration c{Cylinder(1, 0.5), Pose(), Capsule(1, 0.5), Pose()};
  for (const oracle::OptimalNormal& optimal : oracle::truth(c).normals) {
    EXPECT_EQ(*along(c, optimal.n).normal_angle, 0);
  }
  for (const Vec3& radial : {Vec3(0.6, 0.8, 0), Vec3(0, -1, 0), Vec3(-0.8, 0.6, 0)}) {
    EXPECT_NEAR(*along(c, radial).normal_regret, 0, 1e-15);
    EXPECT_EQ(*along(c, radial).normal_angle, 0);
  }
}

TEST(NormalAngle, IsNoneWithinAnArcAndBeyondItsEndsTheAngleToTheNearerOne) {
  // A rim that touches a box's edge exactly: all directions between those of the cap and the face.
  const Configuration c{Cylinder(1, 1), Pose(Vec3(0, 0, 2), {1, 0, 0, 0}), Box(Vec3(1, 1, 1)),
                        Pose(Vec3(2, 0, 0), {1, 0, 0, 0})};
  const oracle::Truth truth = oracle::truth(c);
  ASSERT_EQ(truth.ties, oracle::Ties::continuum);
  ASSERT_EQ(truth.families.size(), 1u);
  const oracle::NormalFamily& arc = truth.families[0];
  ASSERT_EQ(arc.kind, oracle::NormalFamily::Kind::arc);
  const Vec3 middle = (arc.ends[0] + arc.ends[1]).normalized();
  EXPECT_NEAR(*along(c, middle).normal_angle, 0, angle_rounding);
  EXPECT_NEAR(*along(c, turned(middle, middle.cross(arc.axis), 2)).normal_angle, 2, 1e-6);
  EXPECT_NEAR(*along(c, turned(arc.ends[1], arc.axis, 3)).normal_angle, 3, 1e-9);
}

TEST(Score, SaysHowFarPointsAreOffTheBodies) {
  EXPECT_EQ(*scored(standing, contact(-1e-3, up)).point_error, 0);
  ts_answer off = contact(-1e-3, up);
  off.point_count = 2;
  off.points[1] = {{0, 0, 1.1}, {0, 0, 1}, 1e-3};  // 0.1 above the box, 1e-3 of it allowed
  const Score s = scored(standing, off);
  EXPECT_NEAR(*s.point_error, (0.1 - 1e-3) / 0.5, 1e-12);
  off.point_count = 0;
  EXPECT_FALSE(scored(standing, off).point_error);
  EXPECT_FALSE(scored(standing, none()).point_error);
}

TEST(Score, ErrorsBeyondTheLargestDoubleAreTheLargestDouble) {
  const Configuration small{Cylinder(1e-3, 1e-3), Pose(), Sphere(1e-3), Pose()};
  Answer answer{contact(-1e308, up), {}, 1e308};
  answer.points[0].position[0] = 1e308;
  const Score s = score(small, oracle::truth(small), answer, Bar{});
  constexpr double largest = std::numeric_limits<double>::max();
  EXPECT_EQ(s.depth_error, -largest);
  EXPECT_EQ(s.deepest_error, largest);
  EXPECT_EQ(s.model_error, largest);
  EXPECT_EQ(s.solver_error, -largest);
  EXPECT_EQ(s.severity, largest);
  EXPECT_EQ(s.outcome, Outcome::overdeep);
}

/// Bodies 1e-3 deep (2e-3 of the size) with points of these depths.
ts_answer with_depths(const std::vector<double>& depths) {
  ts_answer a = contact(-1e-3, up);
  a.point_count = static_cast<int>(depths.size());
  for (std::size_t i = 0; i < depths.size(); ++i) {
    a.points[i] = {{0, 0, 1}, {0, 0, 1}, depths[i]};
  }
  return a;
}

TEST(DeepestPoint, WithTheDepthAgreesHoweverShallowTheOthersAre) {
  const Score s = scored(standing, with_depths({0, 1e-3, 2e-4}));
  EXPECT_EQ(s.outcome, Outcome::agree);
  EXPECT_NEAR(*s.deepest_error, 0, 1e-12);
}

TEST(DeepestPoint, WithoutTheDepthIsShallowPointsByWhatIsLacking) {
  const Score s = scored(standing, with_depths({0, 4e-4}));
  EXPECT_EQ(s.outcome, Outcome::shallow_points);
  EXPECT_NEAR(*s.depth_error, 0, 1e-12);
  EXPECT_NEAR(*s.deepest_error, -0.6e-3 / 0.5, 1e-12);
  EXPECT_NEAR(s.severity, 0.6e-3 / 0.5, 1e-12);
}

TEST(DeepestPoint, DeeperThanTheBodiesIsOverdeepPointsByTheExcess) {
  const Score s = scored(standing, with_depths({1e-3, 3e-3}));
  EXPECT_EQ(s.outcome, Outcome::overdeep_points);
  EXPECT_NEAR(*s.deepest_error, 2e-3 / 0.5, 1e-12);
  EXPECT_NEAR(s.severity, 2e-3 / 0.5, 1e-12);
}

TEST(DeepestPoint, IsJudgedAtTheBar) {
  const ts_answer lacking = with_depths({1e-3 - 2e-5});  // 4e-5 of the size
  EXPECT_EQ(scored(standing, lacking).outcome, Outcome::agree);
  EXPECT_EQ(scored(standing, lacking, {.tolerance = 1e-5, .threshold = 0}).outcome,
            Outcome::shallow_points);
}

TEST(DeepestPoint, OfAContactWithoutPointsIsLackingAltogether) {
  const Score s = scored(standing, with_depths({}));
  EXPECT_EQ(s.outcome, Outcome::no_points);
  EXPECT_FALSE(s.deepest_error);
  EXPECT_NEAR(s.severity, 1e-3 / 0.5, 1e-12);
  // Nor do bodies rest on nothing where they only touch.
  ts_answer touching = with_depths({});
  touching.signed_distance = 0;
  EXPECT_EQ(scored(lifted(1e-3), touching).outcome, Outcome::no_points);
  ts_answer apart = with_depths({});
  apart.signed_distance = 0.01;
  EXPECT_EQ(scored(lifted(0.011), apart, {.tolerance = 1e-4, .threshold = 0.02}).outcome,
            Outcome::agree);
}

TEST(DeepestPoint, IsNotSoughtWhereDepthOrNormalAreWrong) {
  ts_answer shallow = with_depths({0});
  shallow.signed_distance = -0.5e-3;
  EXPECT_EQ(scored(standing, shallow).outcome, Outcome::shallow);
  ts_answer sideways = with_depths({0});
  sideways.normal[0] = 1, sideways.normal[2] = 0;
  EXPECT_EQ(scored(standing, sideways).outcome, Outcome::wrong_normal);
}

TEST(Points, OffTheBodiesByMoreThanTheBarAreAnOutcomeBySoMuch) {
  ts_answer a = contact(-1e-3, up);
  a.point_count = 2;
  a.points[1] = {{0.2, 0, 1 + 6e-5}, {0, 0, 1}, 0};  // above the box, by more than 1e-4 of the size
  EXPECT_EQ(scored(standing, a).outcome, Outcome::off_body);
  a.points[1].depth = 2e-5;
  EXPECT_EQ(scored(standing, a).outcome, Outcome::agree);
  a.points[1] = {{0.2, 0, 0.9995}, {0, 0, 1}, 0};  // within both
  EXPECT_EQ(scored(standing, a).outcome, Outcome::agree);
  a.points[1] = {{12.6, 0, 1}, {0, 0, 1}, 1e-3};
  const Score far = scored(standing, a);
  EXPECT_EQ(far.outcome, Outcome::off_body);
  EXPECT_NEAR(far.severity, (12.6 - 0.5) / 0.5, 0.01);
  EXPECT_EQ(scored(standing, a, {.tolerance = 100, .threshold = 0}).outcome, Outcome::agree);
  // Where depth or normal are wrong, these come first.
  a.signed_distance = -2e-3;
  EXPECT_EQ(scored(standing, a).outcome, Outcome::overdeep);
}

/// The pose of an outside user: a cylinder that stands 0.1 mm deep on a floor of 200 m.
const Configuration on_floor{Cylinder(1, 1), Pose(Vec3(3, -2, 0.9999), {1, 0, 0, 0}),
                             Box(Vec3(100, 100, 1)), Pose(Vec3(0, 0, -1), {1, 0, 0, 0})};

TEST(FeltRegret, OfANormalOnAFloorIsThatOnAPlane) {
  const Configuration on_plane{on_floor.a, on_floor.pose_a, Plane(up, 0), Pose()};
  for (const double degrees : {4e-4, 0.01, 1.0, 30.0, 90.0}) {
    const Vec3 n = turned(up, Vec3(0.6, 0.8, 0), degrees);
    const Score floor = along(on_floor, n), plane = along(on_plane, n);
    // But for the depth, by which a turned normal comes out of a plane sooner.
    const double sooner = 1e-4 * (1 - std::cos(degrees * std::numbers::pi / 180));
    EXPECT_NEAR(*floor.normal_regret, *plane.normal_regret + sooner, 1e-12) << degrees;
    EXPECT_NEAR(*plane.normal_regret, *plane.whole_regret, 1e-12) << degrees;
    EXPECT_GT(*floor.whole_regret, 40 * *floor.normal_regret) << degrees;
  }
}

TEST(FeltRegret, JudgesTheSmallerBodyWhicheverItIs) {
  // A die on a table that is a cylinder.
  const Configuration table{Cylinder(100, 1), Pose(Vec3(0, 0, -1)), Box(Vec3(0.01, 0.01, 0.01)),
                            Pose(Vec3(40, 5, 0.00999), {1, 0, 0, 0})};
  for (const double degrees : {1e-3, 1.0}) {
    const Score s = along(table, turned(-up, Vec3(1, 0, 0), degrees));
    EXPECT_EQ(s.outcome == Outcome::wrong_normal, degrees == 1.0);
    EXPECT_LT(*s.normal_regret, 1e-3 * *s.whole_regret);
  }
}

TEST(FeltRegret, OfBodiesOfOneSizeIsThatOfTheWholeBodies) {
  const Configuration cans{Cylinder(0.5, 1), Pose(Vec3(0, 0, 1.999)), Cylinder(0.5, 1), Pose()};
  for (const double degrees : {1e-3, 0.1, 10.0, 90.0}) {
    const Score s = along(cans, turned(up, Vec3(1, 0, 0), degrees));
    EXPECT_EQ(s.normal_regret, s.whole_regret) << degrees;
  }
}

TEST(FeltRegret, OfANormalAcrossIsWrongHoweverDeepTheBodiesAre) {
  // Deeper than the cylinder is wide: across, the column beneath it would end sooner.
  const Configuration sunk{Cylinder(0.5, 0.5), Pose(Vec3(0, 0, -4)), Box(Vec3(100, 100, 50)),
                           Pose(Vec3(0, 0, -50), {1, 0, 0, 0})};
  EXPECT_EQ(along(sunk, Vec3(1, 0, 0)).outcome, Outcome::wrong_normal);
  EXPECT_EQ(along(sunk, -up).outcome, Outcome::wrong_normal);
  // All directions across the axis tie, and the one between them and the axis is none of them.
  const Configuration concentric{Cylinder(1, 1), Pose(), Sphere(1), Pose()};
  EXPECT_GT(*along(concentric, Vec3(0, 0.6, 0.8)).normal_regret, 0.3);
}

TEST(FeltRegret, OfANormalDoesNotGrowWithAFloor) {
  // 0.0004 degrees off are nothing to a can, a degree is much, on 20 m as on 20 km.
  for (const double half : {10.0, 100.0, 1e4}) {
    const Configuration c{on_floor.a, on_floor.pose_a, Box(Vec3(half, half, 1)), on_floor.pose_b};
    EXPECT_LT(*along(c, turned(up, Vec3(0, 1, 0), 4e-4)).normal_regret, 2e-5) << half;
    EXPECT_EQ(along(c, turned(up, Vec3(0, 1, 0), 1)).outcome, Outcome::wrong_normal) << half;
  }
}

TEST(Points, BeyondTheThresholdArePhantomPointsByTheGap) {
  const ts_answer far = with_depths({1e-3, -2e-3});
  const Score s = scored(standing, far);
  EXPECT_EQ(s.outcome, Outcome::phantom_points);
  EXPECT_NEAR(s.severity, 2e-3 / 0.5, 1e-12);
  EXPECT_NEAR(*s.deepest_error, 0, 1e-12);
  EXPECT_EQ(scored(standing, far, {.tolerance = 1e-4, .threshold = 2e-3}).outcome, Outcome::agree);
}

// Parallel sides that a tilt of 0.03 makes cross: signed distance and normal are right to the last
// digits, but a solver sees no depth.
TEST(DeepestPoint, IsLackingWhereOurOwnCapsuleOnceHadPointsAtTheEndsOnly) {
  const Configuration c{Cylinder(0x1p-2, 5),
                        Pose(Vec3(0x1.1745d1745d174p-2, -0x1.ac37dac37dac4p-2, 0x1.bed61bed61bfp-6),
                             Eigen::Quaterniond(0x1.041c6a547a96ep+1, -0x1.78c73ac4b8bf4p+1,
                                                -0x1.1fa452869f12cp-7, -0x1.847b2902f586dp+1)),
                        Capsule(0x1p-2, 5), Pose(Vec3::Zero(), Eigen::Quaterniond(2, -3, 0, -3))};
  const oracle::Truth truth = oracle::truth(c);
  ts_answer a = contact(truth.signed_distance.midpoint(), truth.normals.front().n);
  const Vec3 middle = oracle::contact_patch(c, truth.normals.front()).centroid();
  for (int i = 0; i < 3; ++i) a.points[0].position[i] = middle[i];
  a.points[1] = a.points[0];
  EXPECT_EQ(score(c, truth, a, {}).outcome, Outcome::agree);
  a.point_count = 2;
  a.points[0].depth = a.points[1].depth = 3e-17;
  const Score s = score(c, truth, a, {});
  EXPECT_EQ(s.outcome, Outcome::shallow_points);
  EXPECT_NEAR(*s.deepest_error, -0.00244 / 0.25, 1e-4);
}

TEST(Score, OutcomesAreNamedAfterTheSymptom) {
  EXPECT_EQ(scored(standing, none()).outcome, Outcome::missed);
  EXPECT_EQ(scored(standing, contact(-0.5e-3, up)).outcome, Outcome::shallow);
  EXPECT_EQ(scored(standing, contact(-2e-3, up)).outcome, Outcome::overdeep);
  EXPECT_EQ(scored(standing, contact(-1e-3, -up)).outcome, Outcome::wrong_normal);
  EXPECT_EQ(scored(standing, contact(-1e-3, Vec3(0, 0, 2))).outcome, Outcome::wrong_normal);
  EXPECT_EQ(scored(standing, contact(-1e-3, Vec3::Zero())).outcome, Outcome::wrong_normal);
  EXPECT_EQ(scored(lifted(0.1), contact(-1e-3, up)).outcome, Outcome::phantom);
  EXPECT_EQ(scored(lifted(0.1), none()).outcome, Outcome::agree);
  ts_answer broken = none();
  broken.status = TS_FAILED;
  EXPECT_EQ(scored(standing, broken).outcome, Outcome::failed);
  broken.status = TS_UNSUPPORTED;
  EXPECT_EQ(scored(standing, broken).outcome, Outcome::unsupported);
}

TEST(Score, EveryOutcomeIsListedOnceInItsPlaceWithANameOfItsOwn) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < all_outcomes.size(); ++i) {
    EXPECT_EQ(static_cast<std::size_t>(all_outcomes[i]), i);  // statistics count by it
    EXPECT_TRUE(names.insert(outcome_name(all_outcomes[i])).second);
    EXPECT_EQ(find_outcome(outcome_name(all_outcomes[i])), all_outcomes[i]);
  }
}

TEST(Score, NotANumberAnywhereIsNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(scored(standing, contact(nan, up)).outcome, Outcome::not_finite);
  EXPECT_EQ(scored(standing, contact(-1e-3, Vec3(0, nan, 1))).outcome, Outcome::not_finite);
  ts_answer in_point = contact(-1e-3, up);
  in_point.points[0].position[1] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(scored(standing, in_point).outcome, Outcome::not_finite);
}

TEST(Score, ErrorsAreRelativeToTheSmallerSize) {
  const Score s = scored(standing, contact(-0.5e-3, up));
  EXPECT_NEAR(*s.depth_error, 0.5e-3 / 0.5, 1e-12);
  EXPECT_NEAR(s.severity, 1e-3, 1e-12);
}

TEST(Score, ErrorsAreRelativeToAShareOfTheLargerSizeWhereDoublesSayNoMore) {
  const Configuration needle{Cylinder(1e-3, 1e9), Pose(), Sphere(1), Pose()};
  EXPECT_EQ(error_size(needle, {}), 1);  // 1e-13 over the tolerance of 1e-4
  EXPECT_EQ(error_size(needle, {.tolerance = 1e-13, .threshold = 0}), 1e9);
  EXPECT_EQ(error_size(needle, {.tolerance = 0, .threshold = 0}), 1e9);
  EXPECT_EQ(error_size(standing, {}), 0.5);
  // A plane has no end: the cylinder's distance along it counts.
  const Configuration aside{Cylinder(0.5, 1), Pose(Vec3(1e12, 0, 0)), Plane(up, 0), Pose()};
  EXPECT_DOUBLE_EQ(error_size(aside, {}), 1e3);
}

TEST(Score, ReversedNormalRegretsTheWholeWayThrough) {
  // Along −z the bodies overlap by 2·1 + 2·1 − 1e-3.
  EXPECT_NEAR(*scored(standing, contact(-1e-3, -up)).normal_regret, (4 - 2e-3) / 0.5, 1e-9);
}

TEST(Score, WhatIsWithinTheBarMayBeMissed) {
  const Configuration touching = lifted(1e-3 - 2e-5);  // 4e-5 of the size deep
  EXPECT_EQ(scored(touching, none()).outcome, Outcome::unseen);
  EXPECT_TRUE(agrees(Outcome::unseen));
  EXPECT_EQ(scored(touching, none()).severity, 0);
  EXPECT_EQ(scored(touching, none(), {.tolerance = 1e-6, .threshold = 0}).outcome, Outcome::missed);
}

TEST(Score, WhatDoublesDoNotTellFromATouchNeedsNoContact) {
  EXPECT_EQ(scored(lifted(1e-3 - 1e-14), none()).outcome, Outcome::agree);
  EXPECT_EQ(scored(lifted(1e-3 - 1e-12), none()).outcome, Outcome::unseen);
  EXPECT_EQ(scored(lifted(1e-3), none()).outcome, Outcome::agree);
}

TEST(Score, ThresholdAllowsContactsThatFarApart) {
  const Configuration apart = lifted(0.011);
  EXPECT_EQ(scored(apart, contact(0.01, up)).outcome, Outcome::phantom);
  EXPECT_EQ(scored(apart, contact(0.01, up), {.tolerance = 1e-4, .threshold = 0.02}).outcome,
            Outcome::agree);
}

ts_answer contact_at(const std::vector<Vec3>& positions, const Vec3& normal = up) {
  ts_answer a = contact(-1e-3, normal);
  a.point_count = static_cast<int>(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    a.points[i] = a.points[0];
    for (int k = 0; k < 3; ++k) a.points[i].position[k] = positions[i][k];
  }
  return a;
}

std::vector<Vec3> on_rim(int count) {
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    points.push_back(Vec3(0.5 * std::cos(angle), 0.5 * std::sin(angle), 1));
  }
  return points;
}

/// `standing`, leaning by an angle.
Configuration leaning(double angle) {
  return {standing.a, Pose(standing.pose_a.position(), Eigen::Quaterniond(1, 0, angle / 2, 0)),
          standing.b, standing.pose_b};
}

TEST(Coverage, OfAStandingCylinderGrowsWithItsPoints) {
  constexpr double inscribed = 1e-3;  // the patch is a polygon in the disc
  for (const int count : {3, 4, 8}) {
    EXPECT_NEAR(*scored(standing, contact_at(on_rim(count))).coverage,
                std::cos(std::numbers::pi / count), inscribed);
  }
  EXPECT_EQ(*scored(standing, contact(-1e-3, up)).coverage, 0);
}

TEST(Coverage, HairTiltedCylindersStillStandAndTiltedOnesTouchInAPoint) {
  const Bar loose{.tolerance = 0.1, .threshold = 0};
  EXPECT_NEAR(*scored(leaning(1e-9), contact_at(on_rim(3)), loose).coverage, 0.5, 1e-3);
  EXPECT_EQ(*scored(leaning(1e-9), contact(-1e-3, up), loose).coverage, 0);
  EXPECT_EQ(*scored(leaning(0.017), contact(-1e-3, up), loose).coverage, 1);
}

TEST(Coverage, OfALyingCylinderNeedsBothEnds) {
  const Configuration lying{Cylinder(0.5, 1),
                            Pose(Vec3(0, 0, 0.499), Eigen::Quaterniond(1, 0, 1, 0)), Plane(up, 0),
                            Pose()};
  EXPECT_NEAR(*scored(lying, contact_at({Vec3(-1, 0, 0), Vec3(1, 0, 0)})).coverage, 1, 1e-9);
  EXPECT_NEAR(*scored(lying, contact_at({Vec3(-0.5, 0, 0), Vec3(1, 0, 0)})).coverage, 0.5, 1e-9);
  EXPECT_EQ(*scored(lying, contact_at({Vec3(0, 0, 0)})).coverage, 0);
}

TEST(Coverage, OfARoundContactIsOneWithOnePointHoweverLargeTheSphere) {
  for (const double radius : {0.5, 5e3}) {
    const Configuration c{Cylinder(0.5, 1), Pose(Vec3(0, 0, 0.999), Eigen::Quaterniond::Identity()),
                          Sphere(radius),
                          Pose(Vec3(0, 0, -radius), Eigen::Quaterniond::Identity())};
    EXPECT_EQ(*scored(c, contact_at({Vec3::Zero()})).coverage, 1);
  }
}

TEST(Coverage, OfAContinuumIsThatOfTheAnswersOwnNormal) {
  // Coaxial: a ring of radial normals, each with a segment across the shared length.
  const Configuration coaxial{Cylinder(0.5, 1), Pose(), Cylinder(0.25, 4), Pose()};
  const Vec3 n = Vec3(3, 4, 0) / 5;
  ts_answer a = contact_at({-0.5 * n + Vec3(0, 0, -1), -0.5 * n + Vec3(0, 0, 1)}, n);
  a.signed_distance = -0.75;
  EXPECT_NEAR(*scored(coaxial, a).coverage, 1, 1e-9);
}

TEST(Coverage, IsUndefinedWithoutARightContact) {
  EXPECT_FALSE(scored(standing, none()).coverage);
  EXPECT_FALSE(scored(standing, contact(-1e-3, Vec3(1, 0, 0))).coverage);
  EXPECT_FALSE(scored(lifted(0.1), contact(-1e-3, up)).coverage);
}

TEST(PointDistance, OfEveryShape) {
  const Pose at({1, 2, 3}, {1, 0, 0, 0});
  const auto distance = [&](const Shape& s, const Vec3& p) { return point_distance(s, at, p); };
  EXPECT_DOUBLE_EQ(distance(Cylinder(1, 2), {4, 2, 3}), 2);
  EXPECT_DOUBLE_EQ(distance(Cylinder(1, 2), {5, 2, 9}), 5);
  EXPECT_DOUBLE_EQ(distance(Cylinder(1, 2), {1.25, 2, 3}), -0.75);
  EXPECT_DOUBLE_EQ(distance(Cylinder(1, 2), {1, 2, 4.5}), -0.5);
  EXPECT_DOUBLE_EQ(distance(Capsule(1, 2), {1, 2, 7}), 1);
  EXPECT_DOUBLE_EQ(distance(Capsule(1, 2), {1, 2, 3}), -1);
  EXPECT_DOUBLE_EQ(distance(Sphere(1), {1, 2, 5}), 1);
  EXPECT_DOUBLE_EQ(distance(Box({1, 1, 1}), {5, 2, 7}), std::hypot(3, 3));
  EXPECT_DOUBLE_EQ(distance(Box({1, 2, 3}), {1, 2, 3}), -1);
  EXPECT_DOUBLE_EQ(distance(Plane({0, 0, 2}, 2), {0, 0, 5}), 1);
}

/// Two crossed cans; two coaxial ones, along whose sides all radial normals tie; and one in the
/// middle of a cube, where caps and sides tie, along which patches differ.
const Configuration crossed{Cylinder(0.5, 1), Pose(), Cylinder(0.4, 1.5),
                            Pose({0.1, 0.7, 0.2}, {1, 0.3, 0.1, 0.5})},
    coaxial{Cylinder(0.5, 1), Pose(), Cylinder(0.4, 1), Pose({0, 0, 0.25}, {1, 0, 0, 0})},
    tied{Cylinder(0.5, 0.5), Pose(), Box({2, 2, 2}), Pose()};

TEST(Judge, SaysOfEachOfManyAnswersWhatItSaysOfThatAlone) {
  for (const Configuration& c : {standing, crossed, coaxial, tied, lifted(1)}) {
    const oracle::Truth truth = oracle::truth(c);
    const double distance = truth.signed_distance.midpoint();
    std::vector<ts_answer> answers = {none()};
    std::vector<Vec3> normals;
    for (const double turn : {0.0, 0.3, 1e-5, 2.0, 0.3}) {
      for (const oracle::OptimalNormal& optimal : truth.normals) {
        normals.push_back(Eigen::AngleAxisd(turn, Vec3::UnitZ()) * optimal.n);
      }
    }
    for (const Vec3& n : normals) {
      answers.push_back(contact(distance / 2, Vec3(n.y(), -n.z(), n.x())));
      ts_answer spread = contact(distance, n);
      spread.point_count = 4;
      for (int i = 0; i < 4; ++i) {
        spread.points[i] = spread.points[0];
        spread.points[i].position[i % 2] += i < 2 ? 0.2 : -0.3;
      }
      answers.push_back(spread);
    }
    Judge judge(c, truth, {});
    for (const ts_answer& answer : answers) {
      const Score together = judge.score(answer), alone = score(c, truth, answer, Bar{});
      EXPECT_EQ(together.outcome, alone.outcome);
      EXPECT_EQ(together.normal_regret, alone.normal_regret);
      EXPECT_EQ(together.whole_regret, alone.whole_regret);
      EXPECT_EQ(together.coverage, alone.coverage);
      EXPECT_EQ(together.severity, alone.severity);
    }
  }
}

TEST(Judge, MeasuresTheWholeRegretByTheCertifiedGap) {
  for (const Configuration& c : {standing, crossed, coaxial}) {
    const oracle::Truth truth = oracle::truth(c);
    Judge judge(c, truth, {});
    for (const Vec3& n : {Vec3(0.6, 0, 0.8), Vec3(0, 0, 1), Vec3(0.36, 0.48, -0.8)}) {
      const double regret =
          truth.signed_distance.midpoint() - oracle::certified_gap(c, n).midpoint();
      const double relative = std::max(0.0, regret) / error_size(c, {});
      // Doubles, each rounded towards zero.
      EXPECT_NEAR(*judge.score(contact(-0.1, n)).whole_regret, relative, 1e-15 * (1 + relative));
    }
  }
}

/// A can that stands 0.2 deep in a half-space.
const Configuration in_half_space{Cylinder(1, 2), Pose({0, 0, 1.8}, {1, 0, 0, 0}),
                                  Plane({0, 0, 1}, 0), Pose()};

double excess(const Vec3& p, double depth) {
  return point_excess(in_half_space, {{p.x(), p.y(), p.z()}, {0, 0, 1}, depth});
}

TEST(PointExcess, IsNoneBetweenTheSurfacesWhereverInTheDepth) {
  for (const double z : {-0.2, -0.1, 0.0}) EXPECT_LE(excess({0.5, 0, z}, 0.2), 0) << z;
  EXPECT_LT(excess({0.5, 0, -0.1}, 0.2), 0);
}

TEST(PointExcess, MeasuresFromTheFartherSurface) {
  constexpr double rounding = 1e-14;
  EXPECT_NEAR(excess({3, 0, 0}, 0.2), std::hypot(2, 0.0) - 0.2, rounding);
  // 0.7 above the half-space, 0.9 from the cap below it.
  EXPECT_NEAR(excess({0, 0, 0.7}, 0.2), 0.7, rounding);
  EXPECT_NEAR(excess({0, 0, 0.7}, -0.2), 0.7, rounding);  // points apart have negative depths
}

TEST(PointExcess, LeavesAPointWhatItsCoordinatesRoundTo) {
  const Configuration far{Cylinder(1, 1), Pose(Vec3(1e12, 0, 0)), Sphere(1),
                          Pose(Vec3(1e12, 0, 1.75), {1, 0, 0, 0})};
  EXPECT_LE(point_excess(far, {{1e12, 0, 1.001}, {0, 0, 1}, 0.25}), 0);
}

using oracle::BoundaryPiece;
using oracle::ContactPatch;
using oracle::ConvexSet;
using oracle::Vec2;

constexpr double pi = std::numbers::pi;
constexpr double rounding = 1e-14;
constexpr double fine = 1e-3;

const ContactPatch::Plane plane{Vec3(1, 2, 3), Vec3(0, 1, 0), Vec3(0, 0, 1)};

ContactPatch patch(const ConvexSet& shape) { return {plane, shape}; }

ContactPatch disc(double radius) {
  return patch(ConvexSet::region({BoundaryPiece::arc(Vec2::Zero(), radius, 0, 2 * pi)}));
}

std::vector<Vec3> on_circle(int count, double radius, const Vec2& centre = Vec2::Zero()) {
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    const double angle = 0.3 + 2 * pi * i / count;
    // Off the plane as well: points are seen along the normal.
    points.push_back(disc(1).in_world(centre + radius * Vec2(std::cos(angle), std::sin(angle))) +
                     Vec3(i, 0, 0));
  }
  return points;
}

TEST(Coverage, OfAFullDiscByPointsEvenlyRoundItsRim) {
  for (const int count : {3, 4, 8}) {
    EXPECT_NEAR(coverage(disc(2), on_circle(count, 2), fine), std::cos(pi / count), rounding);
  }
}

TEST(Coverage, OfAnyPatchByItsCornersIsOne) {
  const std::vector<Vec2> corners{{0, 0}, {4, 0}, {4, 1}, {1, 3}};
  const ContactPatch p = patch(ConvexSet::polygon(corners));
  EXPECT_NEAR(coverage(p, p.outline(), fine), 1, rounding);
}

TEST(Coverage, ShrinksWithThePointsAboutTheCentroid) {
  EXPECT_NEAR(coverage(disc(2), on_circle(4, 1), fine), std::cos(pi / 4) / 2, rounding);
}

TEST(Coverage, PointsBeyondThePatchCoverItOnce) {
  EXPECT_EQ(coverage(disc(1), on_circle(3, 10), fine), 1);
}

TEST(Coverage, IsZeroUnlessPointsSurroundTheCentroid) {
  EXPECT_EQ(coverage(disc(1), {}, fine), 0);
  EXPECT_EQ(coverage(disc(1), on_circle(1, 0), fine), 0);
  EXPECT_EQ(coverage(disc(1), on_circle(2, 1), fine), 0);
  EXPECT_EQ(coverage(disc(1), on_circle(3, 0.2, Vec2(0.5, 0)), fine), 0);
}

TEST(Coverage, OfASegmentIsTheReachToItsShorterSide) {
  const ContactPatch p = patch(ConvexSet::segment({-1, 0}, {3, 0}));
  const auto at = [&](double x) { return p.in_world({x, 0}); };
  EXPECT_NEAR(coverage(p, {at(-1), at(3)}, fine), 1, rounding);
  EXPECT_NEAR(coverage(p, {at(0), at(3)}, fine), 0.5, rounding);
  EXPECT_NEAR(coverage(p, {at(-1), at(0.9)}, fine), 0, rounding);
  EXPECT_NEAR(coverage(p, {at(-1), at(1), at(2)}, fine), 0.5, rounding);
  EXPECT_EQ(coverage(p, {}, fine), 0);
}

TEST(Coverage, OfAPointIsOneWithAnyPoint) {
  const ContactPatch p = patch(ConvexSet::point({1, 1}));
  EXPECT_EQ(coverage(p, {Vec3(9, 9, 9)}, fine), 1);
  EXPECT_EQ(coverage(p, {}, fine), 0);
}

TEST(Coverage, WhatIsNarrowerThanTheResolutionDoesNotCount) {
  const auto strip = [](double length, double width) {
    return patch(ConvexSet::polygon({{0, 0}, {length, 0}, {length, width}, {0, width}}));
  };
  const ContactPatch band = strip(4, 1e-4);
  EXPECT_NEAR(coverage(band, {band.in_world({0, 0}), band.in_world({4, 0})}, fine), 1, rounding);
  EXPECT_EQ(coverage(strip(1e-3, 1e-4), {Vec3::Zero()}, fine), 1);
  EXPECT_EQ(coverage(strip(4, 1), {Vec3::Zero()}, fine), 0);
}

TEST(Coverage, DoesNotDependOnTheUnitOfLength) {
  for (const double scale : {1e-6, 1e6}) {
    EXPECT_NEAR(coverage(disc(2 * scale), on_circle(3, 2 * scale), fine * scale), 0.5, 1e-9);
  }
}

}  // namespace
}  // namespace touchstone
