#include "arc_polygon.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <optional>
#include <rapidcheck.h>
#include <vector>

namespace touchstone {
namespace {

const Circle unit{Vec2(0, 0), 1};

Vec2 direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

constexpr double far = 2;  // beyond the unit disc

/// What of the unit disc has its coordinates between these.
ArcPolygon cut_disc(const Vec2& lower, const Vec2& upper) {
  const auto strip = [&](int i) -> Strip {
    return {Vec2::Unit(i), (lower[i] + upper[i]) / 2, (upper[i] - lower[i]) / 2};
  };
  return {unit, strip(0), strip(1)};
}
ArcPolygon disc_in_square(double half_side) {
  return cut_disc(Vec2(-half_side, -half_side), Vec2(half_side, half_side));
}

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
  const ArcPolygon region = cut_disc({-far, -far}, {0, far});
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
      const Vec2 upper(corner.x(), corner.y() + hair);
      const ArcPolygon region = cut_disc(upper - Vec2(2, 2), upper);
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
    const ArcPolygon region = cut_disc({-far, -far}, {left, far});
    EXPECT_NEAR(region.farthest(Vec2(1, 0)).x(), left, 1e-15);
    EXPECT_NEAR((region.farthest(Vec2(-1, 0)) - Vec2(-1, 0)).norm(), 0, 1e-15);
    EXPECT_GT(coverage(region), 0.7) << left;
    const ArcPolygon from_both_sides = cut_disc({-left, -far}, {left, far});
    EXPECT_NEAR(from_both_sides.farthest(Vec2(-1, 0)).x(), -left, 1e-15);
    EXPECT_NEAR((from_both_sides.farthest(Vec2(0, 1)) - Vec2(0, 1)).norm(), 0, 1e-15);
    EXPECT_GT(coverage(from_both_sides), 0.7) << left;
  }
}

TEST(ArcPolygon, CutThatLeavesASliverHasItsTop) {
  const ArcPolygon region = cut_disc({-far, -far}, {-0.99, far});
  EXPECT_NEAR((region.farthest(Vec2(-1, 0)) - Vec2(-1, 0)).norm(), 0, 1e-15);
  std::array<Vec2, 8> points;
  EXPECT_GE(region.spread(Vec2(-1, 0), points), 3);
}

TEST(ArcPolygon, DiscCutByAllFourEdgesOfASquareHasEightCorners) {
  const ArcPolygon region = disc_in_square(0.9);
  std::array<Vec2, 8> points;
  ASSERT_EQ(region.spread(Vec2(1, 0), points), 8);
  for (int i = 0; i < 8; ++i) {
    EXPECT_NEAR(points[i].norm(), 1, 1e-14);
    EXPECT_NEAR(points[i].cwiseAbs().maxCoeff(), 0.9, 1e-15);
  }
  EXPECT_GT(coverage(region), 0.9);
}

// Of eight corners and the middles of four arcs: one corner of each of the four short edges.
TEST(ArcPolygon, OfTwelvePointsThoseThatSpanTheLeastAreLeftOut) {
  const ArcPolygon region = disc_in_square(0.99);
  std::array<Vec2, 8> points;
  ASSERT_EQ(region.spread(Vec2(1, 0.1), points), 8);
  int middles = 0;
  for (const Vec2& p : points) {
    const Vec2 from_axes = p.cwiseAbs();
    const bool is_middle = std::abs(from_axes.x() - from_axes.y()) < 1e-15;
    EXPECT_NEAR(from_axes.maxCoeff(), is_middle ? std::sqrt(0.5) : 0.99, 1e-15);
    middles += is_middle;
  }
  EXPECT_EQ(middles, 4);
}

TEST(ArcPolygon, AnArcThatStandsOutOfFourCornersHasAPoint) {
  const double sine = std::sin(35 * std::numbers::pi / 180);  // of half of the arc
  const ArcPolygon region = cut_disc({0.3, -sine}, {far, sine});
  std::array<Vec2, 8> points;
  ASSERT_EQ(region.spread(Vec2(-1, 0.1), points), 5);  // the arc's middle, too
  EXPECT_NEAR((points[3] - Vec2(1, 0)).norm(), 0, 1e-15);
}

TEST(ArcPolygon, SquareWithinTheDiscHasItsCorners) {
  const ArcPolygon region = disc_in_square(0.5);
  std::array<Vec2, 8> points;
  ASSERT_EQ(region.spread(Vec2(1, 0), points), 4);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR((points[i].cwiseAbs() - Vec2(0.5, 0.5)).norm(), 0, 1e-15);
}

TEST(ArcPolygon, CutBeyondTheDiscLeavesNothing) {
  EXPECT_TRUE(cut_disc({-far, -far}, {far, -1.5}).empty());
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
    const Vec2 x = direction(thousandths(0, 1571)), y = turned_left(x);
    const auto strip = [&](const Vec2& across) -> Strip {
      const double upper = thousandths(-300, 1500), width = thousandths(50, 2000);
      return {across, upper - width / 2, width / 2};
    };
    const Strip strips[] = {strip(x), strip(y)};
    const ArcPolygon region(unit, strips[0], strips[1]);
    RC_PRE(!region.empty());
    std::array<Vec2, 8> points;
    const int count = region.spread(Vec2(1, 0), points);
    for (int i = 0; i < count; ++i) {
      RC_ASSERT(points[i].norm() <= 1 + 1e-12);
      for (const Strip& s : strips) {
        RC_ASSERT(std::abs(s.across.dot(points[i]) - s.middle) <= s.half_width + 1e-12);
      }
    }
    RC_ASSERT(coverage(region) >= 0.499);
  }));
}

/// The place of a disc in strips that is farthest along a direction, by trying all that may be: the
/// circle's own, and where edges cross it and each other. None where the disc is not in them.
std::optional<Vec2> farthest_of_all(const Circle& circle, const std::array<Strip, 2>& strips,
                                    const Vec2& unit_vector) {
  std::vector<Vec2> places = {circle.centre + circle.radius * unit_vector};
  struct Edge {
    Vec2 foot, along;
  };
  std::vector<Edge> edges;
  for (const Strip& s : strips) {
    for (const double bound : {s.middle + s.half_width, s.middle - s.half_width}) {
      const double distance = bound - s.across.dot(circle.centre);
      const Edge edge{circle.centre + distance * s.across, turned_left(s.across)};
      const double squared = circle.radius * circle.radius - distance * distance;
      for (const double way : {std::sqrt(squared), -std::sqrt(squared)}) {
        if (squared > 0) places.push_back(edge.foot + way * edge.along);
      }
      for (const Edge& other : edges) {
        const double turn = cross2(edge.along, other.along);
        if (std::abs(turn) < 0.1) continue;
        places.push_back(edge.foot +
                         cross2(other.foot - edge.foot, other.along) / turn * edge.along);
      }
      edges.push_back(edge);
    }
  }
  constexpr double rounding = 1e-12;
  std::optional<Vec2> best;
  for (const Vec2& p : places) {
    bool is_in = (p - circle.centre).norm() <= circle.radius + rounding;
    for (const Strip& s : strips) {
      is_in = is_in && std::abs(s.across.dot(p) - s.middle) <= s.half_width + rounding;
    }
    if (is_in && (!best || unit_vector.dot(p) > unit_vector.dot(*best))) best = p;
  }
  return best;
}

// The strips cross at any angle.
TEST(ArcPolygon, DiscInTwoStripsReachesAsFarAsAnyPlaceOfBoth) {
  const auto number = [](int lo, int hi) { return 1e-3 * *rc::gen::inRange(lo, hi) + 0.00037; };
  EXPECT_TRUE(rc::check([&] {
    const Circle circle{Vec2(number(-1000, 1000), number(-1000, 1000)), number(500, 2000)};
    std::array<Strip, 2> strips;
    double angle = number(0, 6283);
    for (Strip& s : strips) {
      s = {direction(angle), number(-2500, 2500), number(1, 2500)};
      angle += (*rc::gen::inRange(0, 2) ? 1 : -1) * number(600, 2500);
    }
    const ArcPolygon region(circle, strips[0], strips[1]);
    for (int i = 0; i < 32; ++i) {
      const Vec2 n = direction(i);
      const auto expected = farthest_of_all(circle, strips, n);
      RC_ASSERT(region.empty() == !expected);
      if (region.empty()) return;
      RC_ASSERT(std::abs(n.dot(region.extremes(n).top - *expected)) < 1e-9);
      RC_ASSERT(std::abs(n.dot(region.extremes(-n).bottom - *expected)) < 1e-9);
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

TEST(ArcPolygon, DiscThatTwoStripsHoldIsWhole) {
  for (const double half_width : {1.0, 1 - 1e-14, 3.0}) {
    const ArcPolygon region(unit, {Vec2(1, 0), 0, half_width}, {Vec2(0, -1), 0, half_width});
    std::array<Vec2, 8> points;
    ASSERT_EQ(region.spread(Vec2(0, 2), points), 3) << half_width;
    EXPECT_NEAR((points[0] - Vec2(0, 1)).norm(), 0, 1e-15);
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
