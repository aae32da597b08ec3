#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

#include "oracle/judge/made_answers.hpp"

namespace touchstone {
namespace {

using oracle::BoundaryPiece;
using oracle::ContactPatch;
using oracle::ConvexSet;
using oracle::Vec2;

using std::numbers::pi;
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

// Of answers, along the normal that is theirs.

ts_answer contact_at(const std::vector<Vec3>& positions, const Vec3& normal = up) {
  ts_answer a = contact(-1e-3, normal);
  a.point_count = static_cast<int>(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    a.points[i] = a.points[0];
    for (int k = 0; k < 3; ++k) a.points[i].position[k] = positions[i][k];
  }
  return a;
}

/// `standing`, leaning by an angle.
Configuration leaning(double angle) {
  return {standing.a, Pose(standing.pose_a.position(), Eigen::Quaterniond(1, 0, angle / 2, 0)),
          standing.b, standing.pose_b};
}

TEST(Coverage, HairTiltedCylindersStillStandAndTiltedOnesTouchInAPoint) {
  const Bar loose{.tolerance = 0.1, .threshold = 0};
  const double y = std::sqrt(3) / 4;
  const ts_answer third_turns = contact_at({{0.5, 0, 1}, {-0.25, y, 1}, {-0.25, -y, 1}});
  EXPECT_NEAR(*scored(leaning(1e-9), third_turns, loose).coverage, 0.5, 1e-3);
  EXPECT_EQ(*scored(leaning(1e-9), contact(-1e-3, up), loose).coverage, 0);
  EXPECT_EQ(*scored(leaning(0.017), contact(-1e-3, up), loose).coverage, 1);
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

}  // namespace
}  // namespace touchstone
