#include "oracle/patch/convex_set.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace touchstone::oracle {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double rounding = 1e-14;

/// The part of the unit disc with x >= cos(half_angle).
ConvexSet disc_segment(double half_angle) {
  const Side arc = Side::arc(Vec2::Zero(), 1, -half_angle, 2 * half_angle);
  return ConvexSet::region({arc, Side::line(arc.to, arc.from)});
}

TEST(ConvexSet, WholeDisc) {
  const ConvexSet disc = ConvexSet::region({Side::arc({3, 4}, 2, 1, 2 * pi)});
  EXPECT_NEAR(disc.area(), 4 * pi, rounding * 100);
  EXPECT_NEAR(disc.perimeter(), 4 * pi, rounding * 100);
  EXPECT_NEAR((disc.centroid() - Vec2(3, 4)).norm(), 0, rounding * 100);
  EXPECT_NEAR(disc.support({0, 1}), 6, rounding * 100);
  EXPECT_EQ(disc.distance({3, 4}), 0);
  EXPECT_NEAR(disc.distance({3, 7}), 1, rounding * 100);
  EXPECT_EQ(disc.outline(8).size(), 32u);
}

TEST(ConvexSet, HalfDiscHasItsCentroidAtFourThirdsOverPi) {
  const ConvexSet half = disc_segment(pi / 2);
  EXPECT_NEAR(half.area(), pi / 2, rounding);
  EXPECT_NEAR(half.perimeter(), pi + 2, rounding);
  EXPECT_NEAR(half.centroid().x(), 4 / (3 * pi), rounding);
  EXPECT_NEAR(half.centroid().y(), 0, rounding);
  EXPECT_NEAR(half.support({-1, 0}), 0, rounding);
  EXPECT_NEAR(half.distance({-1, 0}), 1, rounding);
  EXPECT_NEAR(half.distance({-3, 5}), std::hypot(3, 4), 10 * rounding);
}

TEST(ConvexSet, ThinDiscSegmentsKeepTheirDigits) {
  // area → 2/3 · chord · height; centroid → 3/5 of the height from the arc.
  const double t = 1e-5;
  const ConvexSet thin = disc_segment(t);
  EXPECT_NEAR(thin.area() / (2.0 / 3 * t * t * t), 1, 1e-9);
  EXPECT_NEAR((1 - thin.centroid().x()) / (t * t / 2), 3.0 / 5, 1e-5);
}

TEST(ConvexSet, RectangleFarFromTheOriginKeepsItsDigits) {
  const Vec2 o(1e8, -1e8);
  const ConvexSet r = ConvexSet::polygon({o, o + Vec2(2, 0), o + Vec2(2, 1), o + Vec2(0, 1)});
  EXPECT_EQ(r.area(), 2);
  EXPECT_EQ(r.perimeter(), 6);
  EXPECT_EQ(r.centroid(), o + Vec2(1, 0.5));
  EXPECT_EQ(r.distance(o + Vec2(5, 5)), 5);
}

TEST(ConvexSet, SegmentAndPoint) {
  const ConvexSet s = ConvexSet::polygon({Vec2(0, 0), Vec2(3, 4)});
  EXPECT_EQ(s.kind(), ConvexSet::Kind::segment);
  EXPECT_EQ(s.area(), 0);
  EXPECT_EQ(s.perimeter(), 5);
  EXPECT_EQ(s.centroid(), Vec2(1.5, 2));
  EXPECT_EQ(s.distance({1.5, 2}), 0);
  EXPECT_NEAR(s.distance({-3, -4}), 5, rounding);
  const ConvexSet p = ConvexSet::polygon({Vec2(1, 2)});
  EXPECT_EQ(p.kind(), ConvexSet::Kind::point);
  EXPECT_EQ(p.support({1, 1}), 3);
  EXPECT_EQ(p.distance({1, 4}), 2);
  EXPECT_EQ(p.outline(8).size(), 1u);
}

TEST(ConvexPolygon, HullDropsInnerPointsAndThoseOnItsSides) {
  const auto hull =
      convex_hull({Vec2(0, 0), Vec2(1, 1), Vec2(2, 0), Vec2(1, 0), Vec2(2, 2), Vec2(0, 2)});
  EXPECT_EQ(hull.size(), 4u);
  EXPECT_EQ(ConvexSet::polygon(hull).area(), 4);
  EXPECT_EQ(convex_hull({Vec2(0, 0), Vec2(1, 1), Vec2(3, 3)}).size(), 2u);
  EXPECT_EQ(convex_hull({Vec2(1, 1), Vec2(1, 1)}).size(), 1u);
}

TEST(ConvexPolygon, IntersectionOfSquares) {
  const std::vector<Vec2> square{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  const std::vector<Vec2> moved{{1, 1}, {3, 1}, {3, 3}, {1, 3}};
  EXPECT_EQ(ConvexSet::polygon(intersection(square, moved)).area(), 1);
  const std::vector<Vec2> away{{5, 0}, {6, 0}, {6, 1}};
  EXPECT_TRUE(intersection(square, away).empty());
  EXPECT_EQ(halfway(square, away), Vec2(3.5, 0));
}

TEST(ConvexPolygon, IntersectionWithASegmentIsWhatLiesInside) {
  const std::vector<Vec2> square{{0, 0}, {2, 0}, {2, 2}, {0, 2}}, segment{{1, 1}, {5, 1}};
  for (const auto& common : {intersection(square, segment), intersection(segment, square)}) {
    ASSERT_EQ(common.size(), 2u);
    EXPECT_EQ((common[0] - common[1]).norm(), 1);
  }
}

}  // namespace
}  // namespace touchstone::oracle
