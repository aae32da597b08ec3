#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "oracle/judge/score.hpp"

namespace touchstone {
namespace {

using oracle::ContactPatch;
using oracle::ConvexSet;
using oracle::Side;
using oracle::Vec2;

constexpr double pi = std::numbers::pi;
constexpr double rounding = 1e-14;
constexpr double fine = 1e-3;

const ContactPatch::Plane plane{Vec3(1, 2, 3), Vec3(0, 1, 0), Vec3(0, 0, 1)};

ContactPatch patch(const ConvexSet& shape) { return {plane, shape}; }

ContactPatch disc(double radius) {
  return patch(ConvexSet::region({Side::arc(Vec2::Zero(), radius, 0, 2 * pi)}));
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
