#include "arc_polygon.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <rapidcheck.h>
#include <vector>

namespace touchstone {
namespace {

const Circle unit{Vec2(0, 0), 1};

Vec2 direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// min over directions of (support of the points)/(support of the region), about its centroid.
double coverage(const ArcPolygon& region) {
  std::array<Vec2, 8> points;
  const int count = region.spread(Vec2(1, 0), points);
  constexpr int directions = 720;
  Vec2 centroid(0, 0);
  double area = 0;
  for (int i = 0; i < directions; ++i) {  // of the polygon of support points
    const Vec2 p = region.farthest(direction(2 * std::numbers::pi * i / directions));
    const Vec2 q = region.farthest(direction(2 * std::numbers::pi * (i + 1) / directions));
    area += cross2(p, q) / 2;
    centroid += cross2(p, q) / 6 * (p + q);
  }
  centroid /= area;
  double least = 1;
  for (int i = 0; i < directions; ++i) {
    const Vec2 n = direction(2 * std::numbers::pi * (i + 0.5) / directions);
    double most = -1;
    for (int k = 0; k < count; ++k) most = std::max(most, n.dot(points[k] - centroid));
    least = std::min(least, most / n.dot(region.farthest(n) - centroid));
  }
  return least;
}

TEST(ArcPolygon, HalfDiscHasItsTwoCornersAndTwoPointsOnTheArc) {
  ArcPolygon region(unit);
  region.clip(Vec2(1, 0), 0);
  std::array<Vec2, 8> points;
  ASSERT_EQ(region.spread(Vec2(1, 0), points), 4);
  int corners = 0;
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(points[i].norm(), 1, 1e-15);
    corners += std::abs(points[i].x()) < 1e-15;
  }
  EXPECT_EQ(corners, 2);
  EXPECT_GT(coverage(region), 0.75);
}

// Rounding puts the second line's crossing of the circle before or behind the corner; what lies
// beyond the line is cut off all the same.
TEST(ArcPolygon, TwoLinesThatMeetOnTheCircleCutBothCapsOff) {
  for (int i = 0; i < 1000; ++i) {
    const double angle = 0.1 + 1.3 * i / 1000;
    const Vec2 corner = direction(angle);
    for (const double hair : {-1e-16, 0.0, 1e-16}) {
      ArcPolygon region(unit);
      region.clip(Vec2(1, 0), corner.x());
      region.clip(Vec2(0, 1), corner.y() + hair);
      EXPECT_LE(region.farthest(Vec2(1, 0)).x(), corner.x() + 1e-15) << angle;
      EXPECT_LE(region.farthest(Vec2(0, 1)).y(), corner.y() + 1e-15) << angle;
      std::array<Vec2, 8> points;
      const int count = region.spread(Vec2(1, 0.37), points);
      for (int k = 0; k < count; ++k) EXPECT_LE(points[k].y(), corner.y() + 1e-15) << angle;
    }
  }
}

TEST(ArcPolygon, CutThatLeavesMostOfTheDiscKeepsItsLongArc) {
  for (const double left : {0.9, 1 - 1e-6, 1 - 1e-11}) {
    ArcPolygon region(unit);
    region.clip(Vec2(1, 0), left);
    EXPECT_NEAR(region.farthest(Vec2(1, 0)).x(), left, 1e-15);
    EXPECT_NEAR((region.farthest(Vec2(-1, 0)) - Vec2(-1, 0)).norm(), 0, 1e-15);
    EXPECT_GT(coverage(region), 0.7) << left;
    region.clip(Vec2(-1, 0), left);  // both crossings lie on that arc
    EXPECT_NEAR(region.farthest(Vec2(-1, 0)).x(), -left, 1e-15);
    EXPECT_NEAR((region.farthest(Vec2(0, 1)) - Vec2(0, 1)).norm(), 0, 1e-15);
    EXPECT_GT(coverage(region), 0.7) << left;
  }
}

TEST(ArcPolygon, CutThatLeavesASliverHasItsTop) {
  ArcPolygon region(unit);
  region.clip(Vec2(1, 0), -0.99);
  EXPECT_NEAR((region.farthest(Vec2(-1, 0)) - Vec2(-1, 0)).norm(), 0, 1e-15);
  std::array<Vec2, 8> points;
  EXPECT_GE(region.spread(Vec2(-1, 0), points), 3);
}

TEST(ArcPolygon, DiscThatNothingIsCutOffHasThreePoints) {
  ArcPolygon region(unit);
  region.clip(Vec2(1, 0), 1);
  std::array<Vec2, 8> points;
  ASSERT_EQ(region.spread(Vec2(0, 2), points), 3);
  EXPECT_NEAR((points[0] - Vec2(0, 1)).norm(), 0, 1e-15);
}

TEST(ArcPolygon, DiscCutByAllFourEdgesOfASquareHasEightCorners) {
  ArcPolygon region(unit);
  for (const Vec2& n : {Vec2(1, 0), Vec2(0, 1), Vec2(-1, 0), Vec2(0, -1)}) region.clip(n, 0.9);
  std::array<Vec2, 8> points;
  ASSERT_EQ(region.spread(Vec2(1, 0), points), 8);
  for (int i = 0; i < 8; ++i) {
    EXPECT_NEAR(points[i].norm(), 1, 1e-14);
    EXPECT_NEAR(points[i].cwiseAbs().maxCoeff(), 0.9, 1e-15);
  }
  EXPECT_GT(coverage(region), 0.9);
}

// A square's cut disc with one of its eight corners cut off in turn.
TEST(ArcPolygon, OfNineCornersTheOneThatSpansTheLeastIsLeftOut) {
  ArcPolygon region(unit);
  for (const Vec2& n : {Vec2(1, 0), Vec2(0, 1), Vec2(-1, 0), Vec2(0, -1)}) region.clip(n, 0.9);
  const Vec2 on_arc = direction(0.47), on_side(0.9, 0.4);
  const Vec2 cut = -turned_left(Vec2(on_arc - on_side)).normalized();
  region.clip(cut, cut.dot(on_side));
  std::array<Vec2, 8> points;
  ASSERT_EQ(region.spread(Vec2(1, -0.5), points), 8);
  EXPECT_NEAR((points[0] - Vec2(0.9, -std::sqrt(0.19))).norm(), 0, 1e-15);
  EXPECT_NEAR((points[1] - on_arc).norm(), 0, 1e-15);  // and not `on_side`, which comes before it
}

TEST(ArcPolygon, SixCornersAreEnoughForAnArcThatStandsOut) {
  ArcPolygon region(unit);
  const double half = 35 * std::numbers::pi / 180;  // of the arc
  region.clip(Vec2(0, 1), std::sin(half));
  region.clip(Vec2(0, -1), std::sin(half));
  region.clip(Vec2(-1, 0), -0.3);
  std::array<Vec2, 8> points;
  ASSERT_EQ(region.spread(Vec2(-1, 0.1), points), 5);  // the arc's middle, too
  EXPECT_NEAR((points[3] - Vec2(1, 0)).norm(), 0, 1e-15);
  for (const double side : {1.0, -1.0}) {
    const Vec2 oblique = Vec2(-1, side).normalized();
    region.clip(oblique, oblique.dot(Vec2(0.35, side * std::sin(half))));
  }
  EXPECT_EQ(region.spread(Vec2(-1, 0.1), points), 6);
}

TEST(ArcPolygon, SquareWithinTheDiscHasItsCorners) {
  ArcPolygon region(unit);
  for (const Vec2& n : {Vec2(1, 0), Vec2(0, 1), Vec2(-1, 0), Vec2(0, -1)}) region.clip(n, 0.5);
  std::array<Vec2, 8> points;
  ASSERT_EQ(region.spread(Vec2(1, 0), points), 4);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR((points[i].cwiseAbs() - Vec2(0.5, 0.5)).norm(), 0, 1e-15);
}

TEST(ArcPolygon, CutBeyondTheDiscLeavesNothing) {
  ArcPolygon region(unit);
  region.clip(Vec2(0, 1), -1.5);
  EXPECT_TRUE(region.empty());
}

TEST(Lens, EndsWhereTheCirclesCross) {
  const Lens lens(unit, {Vec2(1, 0), 1}, 1, Vec2(1, 0));
  EXPECT_NEAR((lens.farthest(Vec2(0, 1)) - Vec2(0.5, std::sqrt(0.75))).norm(), 0, 1e-15);
  EXPECT_NEAR((lens.farthest(Vec2(1, 0)) - Vec2(1, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((lens.farthest(Vec2(-1, 0)) - Vec2(0, 0)).norm(), 0, 1e-15);
}

TEST(ArcPolygon, PointsOfADiscInARectangleLieInBothAndCoverHalfOfIt) {
  const auto thousandths = [](int lo, int hi) { return 1e-3 * *rc::gen::inRange(lo, hi); };
  EXPECT_TRUE(rc::check([&] {
    ArcPolygon region(unit);
    std::array<std::pair<Vec2, double>, 4> cuts;
    const double turn = thousandths(0, 1571);
    for (int i = 0; i < 4; ++i) {
      // Opposite sides are at least 0.05 apart.
      const double bound =
          i < 2 ? thousandths(-300, 1500) : -cuts[i - 2].second + thousandths(50, 2000);
      cuts[i] = {direction(turn + i * std::numbers::pi / 2), bound};
    }
    for (const auto& [normal, bound] : cuts) region.clip(normal, bound);
    RC_PRE(!region.empty());
    std::array<Vec2, 8> points;
    const int count = region.spread(Vec2(1, 0), points);
    for (int i = 0; i < count; ++i) {
      RC_ASSERT(points[i].norm() <= 1 + 1e-12);
      for (const auto& [normal, bound] : cuts) RC_ASSERT(normal.dot(points[i]) <= bound + 1e-12);
    }
    RC_ASSERT(coverage(region) >= 0.499);
  }));
}

// As though cut by one line after the other; the strips cross at any angle.
TEST(ArcPolygon, DiscInTwoStripsIsTheDiscCutByTheirFourLines) {
  const auto number = [](int lo, int hi) { return 1e-3 * *rc::gen::inRange(lo, hi) + 0.00037; };
  const auto size = [](const ArcPolygon& region) -> Vec2 {
    std::array<Vec2, 8> points;
    const int count = region.spread(Vec2(1, 0.37), points);
    return {count, (points[0] - points[count - 1]).norm()};
  };
  EXPECT_TRUE(rc::check([&] {
    const Circle circle{Vec2(number(-1000, 1000), number(-1000, 1000)), number(500, 2000)};
    ArcPolygon expected(circle);
    std::array<Strip, 2> strips;
    double angle = number(0, 6283);
    for (Strip& s : strips) {
      s = {direction(angle), number(-2500, 2500), number(1, 2500)};
      angle += (*rc::gen::inRange(0, 2) ? 1 : -1) * number(600, 2500);
      expected.clip(s.across, s.half_width + s.middle);
      expected.clip(-s.across, s.half_width - s.middle);
    }
    const ArcPolygon region(circle, strips[0], strips[1]);
    RC_ASSERT(region.empty() == expected.empty());
    if (region.empty()) return;
    RC_ASSERT((size(region) - size(expected)).norm() < 1e-9);
    for (int i = 0; i < 32; ++i) {
      const auto [top, bottom] = region.extremes(direction(i));
      // Of two corners that are equally far, either.
      RC_ASSERT(std::abs(direction(i).dot(top - expected.farthest(direction(i)))) < 1e-9);
      RC_ASSERT(std::abs(direction(i).dot(bottom - expected.farthest(-direction(i)))) < 1e-9);
    }
  }));
}

// Where a strip is as thin as rounding, which corners are in the disc is rounding, too. A sliver of
// 1e-12, which is not cut off, is 2.9e-6 long.
TEST(ArcPolygon, DiscInThinStripsAtItsRimIsWithinBoth) {
  const auto power = [](int lo) { return std::pow(10, 0.1 * *rc::gen::inRange(10 * lo, 1)); };
  EXPECT_TRUE(rc::check([&] {
    const double angle = 0.001 * *rc::gen::inRange(0, 6283), apart = *rc::gen::element(0.0, 1.0);
    const double off = (*rc::gen::element(-1, 1)) * apart * power(-20);
    const Vec2 middle = (1 + off) * direction(*rc::gen::element(angle, angle + 0.5, angle + 1.5));
    const double turn = *rc::gen::element(0.5, 1.0, 1.5, 2.5) * std::numbers::pi / 3;
    std::array<Strip, 2> strips;
    for (Strip& s : strips) {
      const Vec2 across = direction(&s == strips.data() ? angle : angle + turn);
      s = {across, across.dot(middle), *rc::gen::element(1.0, 0.0) * power(-20) + 1e-238};
    }
    const ArcPolygon region(unit, strips[0], strips[1]);
    if (region.empty()) return;
    std::array<Vec2, 8> points;
    const int count = region.spread(Vec2(1, 0.37), points);
    RC_ASSERT(count > 0);
    for (int i = 0; i < count; ++i) {
      RC_ASSERT(points[i].norm() <= 1 + 1e-12);
      for (const Strip& s : strips) {
        RC_ASSERT(std::abs(s.across.dot(points[i]) - s.middle) <= s.half_width + 2.9e-6);
      }
    }
  }));
}

TEST(ArcPolygon, DiscInParallelStripsIsCutByBoth) {
  for (const double turn : {0.0, 1e-12, 0.09}) {
    const ArcPolygon region(unit, {Vec2(1, 0), 0.1, 0.5}, {-direction(turn), 0, 0.3});
    const double top = 0.3 / std::cos(turn) + std::sqrt(1 - 0.3 * 0.3) * std::tan(turn);
    EXPECT_LE(region.farthest(Vec2(1, 0)).x(), top + 1e-12) << turn;
    EXPECT_GE(region.farthest(Vec2(1, 0)).x(), 0.3) << turn;
    EXPECT_NEAR(direction(turn).dot(region.farthest(direction(turn))), 0.3, 1e-12) << turn;
    EXPECT_NEAR(direction(turn).dot(region.farthest(-direction(turn))), -0.3, 1e-12) << turn;
  }
}

TEST(ArcPolygon, DiscThatTwoStripsHoldIsWhole) {
  for (const double half_width : {1.0, 1 - 1e-14, 3.0}) {
    const ArcPolygon region(unit, {Vec2(1, 0), 0, half_width}, {Vec2(0, -1), 0, half_width});
    std::array<Vec2, 8> points;
    EXPECT_EQ(region.spread(Vec2(1, 0), points), 3) << half_width;
  }
}

TEST(ArcPolygon, PointInsideAnArcIsItsMiddle) {
  for (const double degrees : {40.0, 44.9, 45.1, 55.0}) {  // half of the arc
    const double half = degrees * std::numbers::pi / 180;
    for (const double turn : {0.0, 0.7, 2.9}) {
      const Vec2 x = direction(turn), y = turned_left(x);
      const ArcPolygon region(unit, {y, 0, std::sin(half)}, {x, 1, 1.4});
      std::array<Vec2, 8> points;
      ASSERT_EQ(region.spread(-x + 0.1 * y, points), 5);  // four corners
      EXPECT_NEAR((points[3] - x).norm(), 0, 1e-15) << degrees << " " << turn;
    }
  }
}

}  // namespace
}  // namespace touchstone
