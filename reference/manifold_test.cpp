// The contact points of every pair as the thesis counts them (its figures 4 to 6, 16 to 20 and 21
// to 28), on both bodies.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <utility>
#include <vector>

#include "reference/contact_of.hpp"
#include "reference/points_on_both_test.hpp"

namespace touchstone {
namespace {

struct Row {
  const char* name;
  Configuration configuration;
  std::size_t points;
  double span = 0;  ///< the longest distance of two points, where it is looked at
};

std::vector<Row> rows() {
  const Cylinder can(1, 2);
  const Plane ground({0, 0, 1}, 0);
  const Capsule pill(0.5, 2);
  const Box slab({3, 3, 1});
  const double triangle = std::sqrt(3.0);         // side of that in a cap
  const double chord = std::sqrt(1 - 0.3 * 0.3);  // half of one, 0.3 from a cap's middle
  return {
      {"plane, tilted (figure 4)", {can, Pose({0, 0, 2}, aslant), ground, Pose()}, 1},
      {"plane, lying (figure 5)", {can, Pose({0, 0, 0.9}, along_x), ground, Pose()}, 2, 4},
      {"plane, standing (figure 6)",
       {can, Pose({0, 0, 1.9}, upright), ground, Pose()},
       3,
       triangle},
      {"sphere", {can, Pose(), Sphere(1), Pose({1.9, 0, 0}, upright)}, 1},
      {"capsule beside, parallel", {can, Pose(), pill, Pose({1.4, 0, 1}, upright)}, 2, 3},
      {"capsule across the cap",
       {can, Pose({0, 0, 2.4}, upright), pill, Pose({0, 0, 0}, along_x)},
       2,
       2},
      {"capsule crossing the side", {can, Pose(), pill, Pose({1.4, 0, 0}, along_y)}, 1},
      {"capsule's end on the cap", {can, Pose({0, 0, 4.4}, upright), pill, Pose()}, 1},
      {"cylinders, rim on side (figure 16a)",
       {can, Pose({0, 0, 3.0}, aslant), Cylinder(1, 5), Pose({0, 0, 0}, along_x)},
       1},
      {"cylinders, sides crossed (figure 16c)",
       {can, Pose({0, 0, 1.9}, along_x), can, Pose({0, 0, 0}, along_y)},
       1},
      {"cylinders, rim on rim (figure 16d)",
       {Cylinder(1, 1), Pose({1.3, 0.2, 2.1}, Quaternion(0.9, 0, 0.4, 0.1)), Cylinder(1, 1),
        Pose()},
       1},
      {"cylinders, parallel sides (figure 17a)",
       {can, Pose({1.9, 0, 1}, upright), can, Pose()},
       2,
       3},
      {"cylinders, side across the whole cap (figure 17b, c4 and c5)",
       {can, Pose({0, 0, 2.9}, upright), Cylinder(1, 4), Pose({0, 0.3, 0}, along_x)},
       2,
       2 * chord},
      {"cylinders, side ending within the cap (figure 17b, c6 and c7)",
       {can, Pose({0, 0, 2.9}, upright), Cylinder(1, 4), Pose({4.2, 0.3, 0}, along_x)},
       2,
       chord - 0.2},
      {"cylinders, cap within cap (figure 18)",
       {can, Pose({0.3, 0, 3.9}, upright), Cylinder(2, 2), Pose()},
       3,
       triangle},
      {"cylinders, caps partly overlapping (figure 19)",
       {can, Pose({1.1, 0, 3.9}, upright), can, Pose()},
       4,
       2 * std::sqrt(1 - 0.55 * 0.55)},
      {"cylinders, side or top (figure 20)",
       {can, Pose({1.8, 0, 3.9}, upright), can, Pose()},
       4,
       2 * std::sqrt(1 - 0.9 * 0.9)},
      {"box, tilted cylinder's rim on a face (figure 21)",
       {can, Pose({0, 0, 3}, aslant), slab, Pose()},
       1},
      {"box, crossed edge and side (figure 21)",
       {can, Pose({0, 0, 2.3}, along_y), Box({3, 1, 1}),
        Pose({0, 0, 0}, Quaternion(0.92, 0.38, 0, 0))},
       1},
      {"box, side on a face (figure 22)", {can, Pose({0, 0, 1.9}, along_x), slab, Pose()}, 2, 4},
      {"box, side on a face, ending beyond it (figure 22)",
       {can, Pose({2, 0, 1.9}, along_x), slab, Pose()},
       2,
       3},
      {"box, cap within a face (figure 23)",
       {can, Pose({0, 0, 2.9}, upright), slab, Pose()},
       3,
       triangle},
      {"box, cap cut by one edge", {can, Pose({2.7, 0, 2.9}, upright), slab, Pose()}, 5},
      {"box, face within the cap (figure 24)",
       {can, Pose({0, 0, 2.9}, upright), Box({0.5, 0.5, 1}), Pose()},
       4,
       std::sqrt(2.0)},
      {"box, cap over a corner of the face",
       {can, Pose({2.9, 2.9, 2.9}, upright), slab, Pose()},
       4},
      {"box, cap cut by two opposite edges",
       {can, Pose({0, 0, 2.9}, upright), Box({0.6, 3, 1}), Pose()},
       6,
       2},
      {"box, cap cut by three edges (figure 27)",
       {can, Pose({0, 0.3, 2.9}, upright), Box({0.95, 1.2, 1}), Pose()},
       7},
      {"box, cap cut by all four edges (figure 28)",
       {can, Pose({0, 0, 2.9}, upright), Box({0.9, 0.9, 1}), Pose()},
       8,
       2},
  };
}

TEST(Manifold, CountsThePointsOfEachFigureAndSpansIt) {
  for (const Row& row : rows()) {
    const Contact answer = contact(row.configuration, 1e-6);
    EXPECT_EQ(answer.points().size(), row.points) << row.name;
    double span = 0;
    for (const ContactPoint& p : answer.points()) {
      for (const ContactPoint& q : answer.points()) {
        span = std::max(span, (p.position - q.position).norm());
      }
    }
    if (row.span > 0) {
      EXPECT_NEAR(span, row.span, 1e-14) << row.name;
    }
  }
}

TEST(Manifold, PointsOfEachFigureLieOnBothBodies) {
  for (const Row& row : rows()) {
    SCOPED_TRACE(row.name);
    expect_points_on_both(row.configuration, contact(row.configuration, 1e-6), 1e-12);
  }
}

TEST(Manifold, StandsOnThreePoints120DegreesApartOnAPlaneOfAnyNormalAndOnAFace) {
  for (const Vec3& n : {Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(0.6, 0, -0.8), Vec3(2, 3, 6)}) {
    const Quaternion turn = turn_between(Vec3::UnitZ(), n);
    const Pose standing(1.9 * n.normalized(), turn), below(-n.normalized(), turn);
    for (const auto& [b, pose_b] :
         {std::pair(Shape(Plane(n, 0)), Pose()), std::pair(Shape(Box({3, 3, 1})), below)}) {
      const Contact answer = contact({Cylinder(1, 2), standing, b, pose_b}, 0);
      ASSERT_EQ(answer.points().size(), 3u);
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 p = answer.points()[i].position, q = answer.points()[(i + 1) % 3].position;
        EXPECT_NEAR((p - q).norm(), std::sqrt(3.0), 1e-14);
        EXPECT_NEAR(answer.points()[i].depth, 0.1, 1e-15);
      }
    }
  }
}

TEST(Manifold, StandsOnThreePointsWhereverTheThresholdAdmitsThem) {
  const Cylinder can(1, 1);
  const Plane ground({0, 0, 1}, 0);
  EXPECT_EQ(contact({can, Pose({0, 0, 1}, upright), ground, Pose()}, 0).points().size(), 3u);
  EXPECT_EQ(contact({can, Pose({0, 0, 1 + 1e-7}, upright), ground, Pose()}, 0).points().size(), 0u);
  EXPECT_EQ(contact({can, Pose({0, 0, 1 + 1e-7}, upright), ground, Pose()}, 1e-6).points().size(),
            3u);
  // The very distance of a can that has sunk in, on a plane that rounding tilts.
  for (const Vec3& n : {Vec3(0.6, 0, -0.8), Vec3(2, 3, 6), Vec3(-1, 5, 0.3)}) {
    const Quaternion turn = turn_between(Vec3::UnitZ(), n);
    const Configuration sunk{can, Pose(-4 * n.normalized(), turn), Plane(n, 0), Pose()};
    EXPECT_EQ(contact(sunk, signed_distance(sunk).value).points().size(), 3u);
  }
}

// Of sides that cross near one end the other end may be so far aside that the surfaces hardly face
// each other there: the last point lies where they have fallen off by three quarters of the radii,
// and so apart by 1 - √7/4 of these.
TEST(PointsWithinTheThreshold, LieWhereSidesThatCrossStillFaceEachOther) {
  constexpr double r = 0.1, angle = 0.05;
  for (const double turn : {angle, -angle}) {
    for (const double crossing : {1.9, -1.9}) {
      const Quaternion turned = Quaternion(Eigen::AngleAxisd(turn, Vec3::UnitZ())) * along_x;
      const Vec3 along(std::cos(turn), std::sin(turn), 0);
      const Configuration c{Cylinder(r, 2), Pose({0, 0, 2 * r}, along_x), Cylinder(r, 2),
                            Pose(Vec3(crossing, 0, 0) - crossing * along, turned)};
      const Contact all = contact(c, 2 * r, nullptr, PointRange::within_threshold);
      double lowest = 0, highest = -1;
      for (const ContactPoint& p : all.points()) {
        lowest = std::min(lowest, p.depth), highest = std::max(highest, p.depth);
      }
      EXPECT_NEAR(highest, 0, 1e-12);
      EXPECT_NEAR(lowest, -2 * r * (1 - std::sqrt(7) / 4), 1e-3 * r);
    }
  }
}

}  // namespace
}  // namespace touchstone
