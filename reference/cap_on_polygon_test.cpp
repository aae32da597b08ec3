// The points that stand for what a cap shares with a convex polygon.
#include "reference/cap_on_polygon.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

#include "reference/patch_points_test.hpp"
#include "reference/random_bodies_test.hpp"

namespace touchstone {
namespace {

struct GivenCorners {
  std::vector<Vec2> corners;
  int count() const { return static_cast<int>(corners.size()); }
  Vec2 corner(int i) const { return corners[static_cast<std::size_t>(i)]; }
};
using OnPolygon = CapOnPolygon<GivenCorners>;

GivenCorners regular(int sides, double radius, const Vec2& middle, double turn = 0) {
  GivenCorners result;
  for (int i = 0; i < sides; ++i) {
    result.corners.push_back(middle + radius * direction(turn + 2 * std::numbers::pi * i / sides));
  }
  return result;
}

TEST(CapOnPolygon, WithinItHasThreePoints) {
  const GivenCorners floor = regular(5, 10, {1, 2});
  const OnPolygon patch(1, floor);
  EXPECT_FALSE(patch.empty());
  const auto points = distinct_points(patch, Vec2(0, 0), 0);
  ASSERT_EQ(points.size(), 3u);
  for (const Vec2& p : points) EXPECT_NEAR(p.norm(), 1, 1e-15);
  // And a fourth at the deepest place, if it leans.
  EXPECT_EQ(distinct_points(patch, direction(0.3), 1).size(), 4u);
}

TEST(CapOnPolygon, AboutItHasItsCorners) {
  for (const int sides : {3, 4, 5, 6, 7, 8}) {
    const GivenCorners top = regular(sides, 0.9, {0.02, -0.03}, 0.4);
    const OnPolygon patch(1, top);
    const auto points = distinct_points(patch, Vec2(0, 0), 0);
    ASSERT_EQ(points.size(), static_cast<std::size_t>(sides));
    for (const Vec2& corner : top.corners) {
      EXPECT_TRUE(std::any_of(points.begin(), points.end(),
                              [&](const Vec2& p) { return (p - corner).norm() < 1e-14; }));
    }
  }
}

// Few points of a patch with many corners, or with arcs, leave a part of it out.
TEST(CapOnPolygon, IsCoveredByItsPoints) {
  Random random(1);
  for (int i = 0; i < 3000; ++i) {
    SCOPED_TRACE(i);
    const int sides = 3 + random.one_of(10);
    GivenCorners polygon = regular(sides, random.uniform(0.3, 2), Vec2(0, 0), random.uniform(0, 6));
    const Vec2 away(random.uniform(-1, 1), random.uniform(-1, 1));
    for (Vec2& p : polygon.corners) p += 0.7 * away;
    const OnPolygon patch(1, polygon);
    if (patch.empty()) continue;
    ASSERT_GE(coverage(patch), 0.45);
  }
}

TEST(CapOnPolygon, PointsLieInBoth) {
  Random random(2);
  for (int i = 0; i < 3000; ++i) {
    SCOPED_TRACE(i);
    GivenCorners polygon = regular(3 + random.one_of(400), random.uniform(0.3, 2), Vec2(0, 0));
    const Vec2 away(random.uniform(-1, 1), random.uniform(-1, 1));
    const double flat = random.power_of_ten(-6, 0);
    for (Vec2& p : polygon.corners) p = Vec2(p.x(), flat * p.y()) + away;
    const OnPolygon patch(1, polygon);
    if (patch.empty()) continue;
    for (const Vec2& p :
         distinct_points(patch, direction(random.uniform(0, 6)), random.uniform(0, 1))) {
      ASSERT_LE(p.norm(), 1 + 1e-14);
      for (int k = 0; k < polygon.count(); ++k) {
        const Vec2 from = polygon.corner(k), to = polygon.corner((k + 1) % polygon.count());
        ASSERT_GE(cross2((to - from).normalized(), p - from), -1e-14);
      }
    }
  }
}

TEST(CapOnPolygon, HullNeverJumps) {
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const int sides = 3 + random.one_of(10);
    const Vec2 away(random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5));
    const double size = random.uniform(0.3, 2), lean = random.uniform(0, 6),
                 clearness = random.uniform(0, 1);
    const auto reach = [&](const Vec2& moved, double turned, const Vec2& way) {
      const GivenCorners polygon = regular(sides, size, away + moved);
      const OnPolygon patch(1, polygon);
      double most = -3;
      if (patch.empty()) return most;
      for (const Vec2& p : distinct_points(patch, direction(lean + turned), clearness)) {
        most = std::max(most, way.dot(p));
      }
      return most;
    };
    constexpr double step = 1e-9;
    for (int k = 0; k < 8; ++k) {
      const Vec2 way = direction(random.uniform(0, 6));
      const double before = reach(Vec2(0, 0), 0, way);
      const double after = reach(step * direction(random.uniform(0, 6)), step, way);
      if (before < -2 || after < -2) continue;
      // A corner of the patch begins as the root of how far an edge has come in.
      ASSERT_NEAR(before, after, 3e-4) << i;
    }
  }
}

}  // namespace
}  // namespace touchstone
