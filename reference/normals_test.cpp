// Where a point faces an ellipse, and how far a proof of deep normals reaches, in numbers worked
// out by hand; deep_normals_test.cpp holds the proofs against the pose classes.
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <rapidcheck.h>

#include "reference/box_sides.hpp"
#include "reference/curves.hpp"
#include "reference/deep_normals.hpp"

namespace touchstone {
namespace {

double gap(double a, double b, double x, double y, const Eigen::Vector2d& n) {
  return n.dot(Eigen::Vector2d(x, y)) - std::hypot(a * n.x(), b * n.y());
}

void expect_largest_in_quadrant(double b, double x, double y) {
  const auto n = ellipse_normal(1, b, x, y);
  double found = std::max(gap(1, b, x, y, {1, 0}), gap(1, b, x, y, {0, 1}));
  if (n) {
    ASSERT_NEAR(n->norm(), 1, 1e-15);
    ASSERT_GE(n->x(), 0);
    ASSERT_GE(n->y(), 0);
    found = std::max(found, gap(1, b, x, y, *n));
  }
  for (int i = 0; i <= 10000; ++i) {
    const double t = std::numbers::pi / 2 * i / 10000;
    ASSERT_LE(gap(1, b, x, y, {std::cos(t), std::sin(t)}), found + 1e-15)
        << b << " " << x << " " << y;
  }
}

TEST(EllipseNormal, HasTheLargestGapOfItsQuadrant) {
  for (const double b : {1.0, 0.9, 0.5, 1e-3, 1e-9, 0.0}) {
    for (const double x : {0.0, 1e-12, 0.1, 0.75, 1.0, 3.0, 1e3, -0.3}) {
      for (const double y : {0.0, 1e-12, 0.05, 0.5, 1e-3, 2.0, 1e3, -1e-12, -1e-3, -0.2, -3.0}) {
        expect_largest_in_quadrant(b, x, y);
      }
    }
  }
}

TEST(EllipseNormal, OfAnyPointHasTheLargestGapOfItsQuadrant) {
  EXPECT_TRUE(rc::check([] {
    const auto magnitude = [] { return std::pow(10, -1e-2 * *rc::gen::inRange(0, 800)); };
    const double sign = *rc::gen::element(-1.0, 1.0);
    expect_largest_in_quadrant(magnitude(), 3 * magnitude(), sign * 3 * magnitude());
    RC_ASSERT(!testing::Test::HasFatalFailure());
  }));
}

TEST(EllipseNormal, NextToTheCuspOfTheEvoluteHasTheLargestGapOfItsQuadrant) {
  for (const double b : {0.99, 0.5, 1e-3, 1e-9}) {
    for (int i = 0; i <= 16; i += 2) {
      for (int j = 0; j <= 16; j += 2) {
        const double cusp = (1 - b) * (1 + b), away = std::pow(10, -i), y = std::pow(10, -j);
        expect_largest_in_quadrant(b, cusp * (1 + away), cusp * y / b);
        expect_largest_in_quadrant(b, cusp * (1 - away), cusp * y / b);
      }
    }
  }
}

TEST(EllipseNormal, OnTheMajorAxisBetweenTheCentresOfCurvatureLeansToTheFlatSide) {
  const auto n = ellipse_normal(2, 1, 0.75, 0);
  ASSERT_TRUE(n);
  // The foot is at cos t = a x/(a² − b²) = 1/2.
  EXPECT_NEAR(n->x() / n->y(), std::tan(std::numbers::pi / 6) / 2, 1e-14);
}

/// Two cylinders with r = h = R = H = 1, whose axes lean by this sine and whose centres lie 0.5
/// apart along one of them.
AboutAxis half_way_in(double sine) {
  return {1, 1, 1, 1, std::sqrt(1 - sine * sine), sine, 0.5, 0};
}

TEST(DeepNormals, OffTheAxisAreProvenUpToTheDepthAtItsCone) {
  // At 0.05 from the axis F is at least 0.5 cos + sin + cos (0.05 − γ) + sin (0.05 − γ) = 1.588.
  const AboutAxis nearly_parallel = half_way_in(0.01);
  const double cone = std::asin(0.05), gamma = std::asin(0.01);
  const double bound =
      0.5 * std::cos(cone) + std::sin(cone) + std::cos(cone - gamma) + std::sin(cone - gamma);
  EXPECT_TRUE(no_normal_off_axis_beats(nearly_parallel, bound - 1e-9));
  EXPECT_FALSE(no_normal_off_axis_beats(nearly_parallel, bound + 1e-9));
}

// A thin body about the axis, as long as it lies across it: the least depth is that of its own end.
TEST(DeepNormals, OffTheAxisAreProvenUpToTheDepthOfTheOtherEnd) {
  constexpr double r = 3, h = 0.1, thin = 0.001, s = 0.02;
  const double c = std::sqrt(1 - s * s);
  const AboutAxis about{r, h, thin, 1, c, s, 0, 0};
  const double bound = h * c + r * s + (c * c - s * s) + thin * 2 * s * c;
  EXPECT_TRUE(no_normal_off_axis_beats(about, bound - 1e-9));
  EXPECT_FALSE(no_normal_off_axis_beats(about, bound + 1e-9));
}

TEST(DeepNormals, OffTheAxisAreProvenOnlyOfNearlyParallelAxes) {
  EXPECT_TRUE(no_normal_off_axis_beats(half_way_in(0.11), 1.4));
  EXPECT_FALSE(no_normal_off_axis_beats(half_way_in(0.111), 1.4));
}

// Left over, a slope lowers the proven depth by its square over λ, here 0.5: no more than rounding.
TEST(DeepNormals, OfRimsAreProvenWhereNoSlopeIsLeftThatRoundingShows) {
  const Rim rim{1, 1};
  EXPECT_TRUE(bends_away(rim, rim, 1, 0, 4.4e-9));
  EXPECT_FALSE(bends_away(rim, rim, 1, 0, 4.5e-9));
  constexpr double lean = 0.05, depth = 1.5;
  EXPECT_TRUE(bends_away_near_axis(rim, rim, lean, 1, depth, 0.99e-8, half_way_in(0.01)));
  EXPECT_FALSE(bends_away_near_axis(rim, rim, lean, 1, depth, 1.01e-8, half_way_in(0.01)));
}

TEST(DeepNormals, OfRimsAreProvenUpToTheDepthThatTheyBendAway) {
  const Rim rim{1, 1}, flat{1, 0.1};
  EXPECT_TRUE(bends_away(rim, rim, 1, 0.199, 0));  // 2 λ / 5
  EXPECT_FALSE(bends_away(rim, rim, 1, 0.201, 0));
  EXPECT_TRUE(bends_away(flat, flat, 1, 0.036, 0));  // 0.2 of both half lengths, over 1.1
  EXPECT_FALSE(bends_away(flat, flat, 1, 0.037, 0));
  const AboutAxis about = half_way_in(0.01);
  EXPECT_TRUE(bends_away_near_axis(rim, rim, 0.05, 1, 1.5, 0, about));
  EXPECT_FALSE(bends_away_near_axis(rim, rim, 0.051, 1, 1.5, 0, about));
  EXPECT_TRUE(bends_away_near_axis(rim, rim, 0.05, 0.226, 1.5, 0, about));  // 5 δ 0.06 <= 4 λ
  EXPECT_FALSE(bends_away_near_axis(rim, rim, 0.05, 0.224, 1.5, 0, about));
}

/// A cylinder with r = 1 and h = 4 that leans by 45 degrees over the upper right edge of a cube
/// with half extents of 3, along y, which lies at (1, 1)/√2 from it; the depth there is 1 −
/// `apart`.
CylinderInBoxFrame leaning_over_an_edge(double apart, double along_axis = 0,
                                        double along_edge = 0) {
  const double half = std::sqrt(0.5);
  const Vec3 axis(half, 0, -half), out(half, 0, half), edge(3, 0, 3);
  return CylinderInBoxFrame(1, 4, Vec3(3, 3, 3),
                            edge + apart * out - along_axis * axis + along_edge * Vec3::UnitY(),
                            axis);
}

// Of the ball about the place where edge and side meet, as wide as the bodies overlap: it has to
// lie in the cylinder.
TEST(BoxSides, EdgesAreProvenWithinBothOfThemDownToTheAxis) {
  const auto is_edge_proven = [](const CylinderInBoxFrame& p) {
    const BoxSides sides(p);
    EXPECT_EQ(sides.kind(), BoxSides::Kind::edge);
    return sides.best(p, no_early_exit).is_proven;
  };
  EXPECT_TRUE(is_edge_proven(leaning_over_an_edge(0.2)));
  EXPECT_TRUE(is_edge_proven(leaning_over_an_edge(1e-6)));
  EXPECT_FALSE(is_edge_proven(leaning_over_an_edge(-1e-6)));  // deeper than the radius
  for (const double side : {1.0, -1.0}) {
    EXPECT_TRUE(is_edge_proven(leaning_over_an_edge(0.2, side * 3.1999)));  // h − 0.8
    EXPECT_FALSE(is_edge_proven(leaning_over_an_edge(0.2, side * 3.2001)));
    EXPECT_TRUE(is_edge_proven(leaning_over_an_edge(0.2, 0, side * 2.9999)));
    EXPECT_FALSE(is_edge_proven(leaning_over_an_edge(0.2, 0, side * 3.0001)));
  }
}

// The lowest point of a cylinder with r = h = 1 that leans by 45 degrees lies at (x, y, 3 − depth)
// over a cube's upper face.
TEST(BoxSides, FacesAreProvenAsFarFromTheirEdgesAsTheDepth) {
  const double half = std::sqrt(0.5);
  const auto is_face_proven = [&](double x, double y, double depth) {
    const Vec3 axis(half, 0, half), lowest(x, y, 3 - depth);
    const CylinderInBoxFrame p(1, 1, Vec3(3, 3, 3), lowest + axis + Vec3(-half, 0, half), axis);
    const BoxSides sides(p);
    EXPECT_EQ(sides.kind(), BoxSides::Kind::face);
    return sides.best(p, no_early_exit).is_proven;
  };
  EXPECT_TRUE(is_face_proven(0, 0, 0.5));
  for (const double side : {1.0, -1.0}) {
    EXPECT_TRUE(is_face_proven(side * 2.4999, 0, 0.5));
    EXPECT_TRUE(is_face_proven(0, side * 2.4999, 0.5));
    EXPECT_FALSE(is_face_proven(0, side * 2.9, 0.5));
  }
}

}  // namespace
}  // namespace touchstone
