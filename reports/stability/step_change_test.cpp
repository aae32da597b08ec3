#include "reports/stability/step_change.hpp"

#include <gtest/gtest.h>

#include "oracle/patch/convex_set.hpp"

namespace touchstone {
namespace {

using oracle::ContactPatch;
using oracle::ConvexSet;

constexpr double rounding = 1e-15;

ContactPatch level(double height, const ConvexSet& set) {
  return {{{0, 0, height}, {1, 0, 0}, {0, 1, 0}}, set};
}
ConvexSet square(double side, double x) {
  return ConvexSet::polygon({{x, 0}, {x + side, 0}, {x + side, side}, {x, side}});
}

TEST(Movement, OfAShiftIsItsLength) {
  EXPECT_NEAR(movement(level(0, square(1, 0)), level(0, square(1, 0.25))), 0.25, rounding);
  EXPECT_NEAR(movement(level(0, square(1, 0)), level(0.5, square(1, 0))), 0.5, rounding);
}

TEST(Movement, OfAnUnchangedSetIsZero) {
  const ConvexSet disc = ConvexSet::region({oracle::Side::arc({1, 2}, 0.5, 0, 2 * M_PI)});
  EXPECT_NEAR(movement(level(1, disc), level(1, disc)), 0, rounding);
}

TEST(Movement, CountsWhicheverSetReachesFarther) {
  const ContactPatch point = level(0, ConvexSet::point({0, 0}));
  const ContactPatch segment = level(0, ConvexSet::segment({-1, 0}, {3, 0}));
  EXPECT_NEAR(movement(point, segment), 3, rounding);
  EXPECT_NEAR(movement(segment, point), 3, rounding);
}

TEST(Movement, IsMeasuredInSpaceBetweenDifferentPlanes) {
  const ContactPatch upright{{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}}, ConvexSet::segment({0, 0}, {0, 2})};
  EXPECT_NEAR(movement(level(0, ConvexSet::point({0, 0})), upright), 2, rounding);
}

ts_answer answered(std::initializer_list<Vec3> points) {
  ts_answer a{};
  a.status = TS_CONTACT;
  a.normal[2] = 1;
  for (const Vec3& p : points) {
    for (int i = 0; i < 3; ++i) a.points[a.point_count].position[i] = p[i];
    ++a.point_count;
  }
  return a;
}

TEST(HullOfPoints, IsWhatThePointsSpan) {
  const ContactPatch hull = hull_of_points(
      answered({{1, 1, 5}, {3, 1, 5}, {2, 1.5, 5}, {3, 3, 5}, {1, 3, 5}, {1, 1, 5}}));
  EXPECT_NEAR(hull.area(), 4, 1e-14);
  EXPECT_LT((hull.centroid() - Vec3(2, 2, 5)).norm(), 1e-14);
  EXPECT_EQ(hull_of_points(answered({{1, 2, 3}})).kind(), ContactPatch::Kind::point);
  EXPECT_EQ(hull_of_points(answered({{1, 2, 3}, {2, 2, 3}})).kind(), ContactPatch::Kind::segment);
}

// An alternating contact: the point goes from one end of a line to the other.
TEST(HullOfPoints, MovesAsFarAsAPointJumps) {
  EXPECT_NEAR(movement(hull_of_points(answered({{-0.045, 0, 0}})),
                       hull_of_points(answered({{0.045, 0, 0}}))),
              0.09, rounding);
}

}  // namespace
}  // namespace touchstone
