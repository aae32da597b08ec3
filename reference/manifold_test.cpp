// The contact points of every pair as the thesis counts them (its figures 4 to 6, 16 to 20 and 21
// to 28), and the laws that every manifold keeps.
#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "properties/identity.hpp"
#include "reference/arc_polygon.hpp"
#include "reference/contact_of.hpp"

namespace touchstone {
namespace {

using Quaternion = Eigen::Quaterniond;

const Quaternion upright(1, 0, 0, 0);
const Quaternion along_x(1, 0, 1, 0);
const Quaternion along_y(1, -1, 0, 0);
const Quaternion aslant(0.9, 0.3, 0.2, 0.1);

struct Row {
  const char* name;
  Configuration configuration;
  std::size_t points;
};

std::vector<Row> rows() {
  const Cylinder can(1, 2);
  const Plane ground({0, 0, 1}, 0);
  const Capsule pill(0.5, 2);
  const Box slab({3, 3, 1});
  return {
      {"plane, tilted (figure 4)", {can, Pose({0, 0, 2}, aslant), ground, Pose()}, 1},
      {"plane, lying (figure 5)", {can, Pose({0, 0, 0.9}, along_x), ground, Pose()}, 2},
      {"plane, standing (figure 6)", {can, Pose({0, 0, 1.9}, upright), ground, Pose()}, 3},
      {"sphere", {can, Pose(), Sphere(1), Pose({1.9, 0, 0}, upright)}, 1},
      {"capsule beside, parallel", {can, Pose(), pill, Pose({1.4, 0, 1}, upright)}, 2},
      {"capsule across the cap",
       {can, Pose({0, 0, 2.4}, upright), pill, Pose({0, 0, 0}, along_x)},
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
      {"cylinders, parallel sides (figure 17a)", {can, Pose({1.9, 0, 1}, upright), can, Pose()}, 2},
      {"cylinders, side across the whole cap (figure 17b, c4 and c5)",
       {can, Pose({0, 0, 2.9}, upright), Cylinder(1, 4), Pose({0, 0.3, 0}, along_x)},
       2},
      {"cylinders, side ending within the cap (figure 17b, c6 and c7)",
       {can, Pose({0, 0, 2.9}, upright), Cylinder(1, 4), Pose({4.2, 0.3, 0}, along_x)},
       2},
      {"cylinders, cap within cap (figure 18)",
       {can, Pose({0.3, 0, 3.9}, upright), Cylinder(2, 2), Pose()},
       3},
      {"cylinders, caps partly overlapping (figure 19)",
       {can, Pose({1.1, 0, 3.9}, upright), can, Pose()},
       4},
      {"cylinders, side or top (figure 20)", {can, Pose({1.8, 0, 3.9}, upright), can, Pose()}, 4},
      {"box, tilted cylinder's rim on a face (figure 21)",
       {can, Pose({0, 0, 3}, aslant), slab, Pose()},
       1},
      {"box, crossed edge and side (figure 21)",
       {can, Pose({0, 0, 2.3}, along_y), Box({3, 1, 1}),
        Pose({0, 0, 0}, Quaternion(0.92, 0.38, 0, 0))},
       1},
      {"box, side on a face (figure 22)", {can, Pose({0, 0, 1.9}, along_x), slab, Pose()}, 2},
      {"box, side on a face, ending beyond it (figure 22)",
       {can, Pose({2, 0, 1.9}, along_x), slab, Pose()},
       2},
      {"box, cap within a face (figure 23)", {can, Pose({0, 0, 2.9}, upright), slab, Pose()}, 3},
      {"box, cap cut by one edge", {can, Pose({2.7, 0, 2.9}, upright), slab, Pose()}, 5},
      {"box, face within the cap (figure 24)",
       {can, Pose({0, 0, 2.9}, upright), Box({0.5, 0.5, 1}), Pose()},
       4},
      {"box, cap over a corner of the face",
       {can, Pose({2.9, 2.9, 2.9}, upright), slab, Pose()},
       4},
      {"box, cap cut by two opposite edges",
       {can, Pose({0, 0, 2.9}, upright), Box({0.6, 3, 1}), Pose()},
       6},
      {"box, cap cut by three edges (figure 27)",
       {can, Pose({0, 0.3, 2.9}, upright), Box({0.95, 1.2, 1}), Pose()},
       7},
      {"box, cap cut by all four edges (figure 28)",
       {can, Pose({0, 0, 2.9}, upright), Box({0.9, 0.9, 1}), Pose()},
       8},
  };
}

TEST(Manifold, CountsThePointsOfEachFigure) {
  for (const Row& row : rows()) {
    const Contact answer = contact(row.configuration, 1e-6);
    EXPECT_EQ(answer.points().size(), row.points) << row.name;
  }
}

/// How far the point lies beyond A's surface (positive outside), and B's.
double outside(const Cylinder& s, const Vec3& x) {
  return std::max(std::hypot(x.x(), x.y()) - s.radius(), std::abs(x.z()) - s.half_length());
}
double outside(const Plane& s, const Vec3& x) {
  return (s.normal().dot(x) - s.displacement()) / s.normal().norm();
}
double outside(const Sphere& s, const Vec3& x) { return x.norm() - s.radius(); }
double outside(const Capsule& s, const Vec3& x) {
  const double z = std::clamp(x.z(), -s.half_length(), s.half_length());
  return (x - Vec3(0, 0, z)).norm() - s.radius();
}
double outside(const Box& s, const Vec3& x) { return (x.cwiseAbs() - s.half_extents()).maxCoeff(); }
double outside(const Shape& shape, const Pose& pose, const Vec3& x) {
  const Vec3 local = pose.rotation().transpose() * (x - pose.position());
  return std::visit([&](const auto& s) { return outside(s, local); }, shape);
}

double position_rounding(const Configuration& c) {
  return 4e-16 * (c.pose_a.position().norm() + c.pose_b.position().norm());
}

/// Where a round body leans by θ, points beside its deepest one are seen at a slant, which moves
/// them into it by up to θ²/2 of its size. Those that are kept lie within a thousandth of the size,
/// and no farther above the deepest point than that is deep: θ <= 1e-2 min(1, depth / 1e-3).
double seen_at_a_slant(const Configuration& c, const Contact& answer) {
  const double slack = std::min(1e-3 * larger_size(c), std::max(0.0, -answer.signed_distance));
  return 50 * slack * slack / larger_size(c);
}

/// Each point, moved by half its depth along the normal, lies on A's surface, and against it on
/// B's; the deepest has the contact's depth.
void expect_points_on_both(const Configuration& c, const Contact& answer, double tolerance) {
  const double aside = tolerance + seen_at_a_slant(c, answer);
  double deepest = -std::numeric_limits<double>::infinity();
  for (const ContactPoint& p : answer.points()) {
    EXPECT_NEAR(outside(c.a, c.pose_a, p.position - p.depth / 2 * answer.normal), 0, aside);
    EXPECT_NEAR(outside(c.b, c.pose_b, p.position + p.depth / 2 * answer.normal), 0, aside);
    deepest = std::max(deepest, p.depth);
  }
  if (answer.points().empty()) return;
  constexpr double steepest = 1e-2;  // what is moved aside changes the depth by the slope
  EXPECT_NEAR(deepest, -answer.signed_distance, tolerance + steepest * seen_at_a_slant(c, answer));
}

TEST(Manifold, PointsOfEachFigureLieOnBothBodies) {
  for (const Row& row : rows()) {
    SCOPED_TRACE(row.name);
    expect_points_on_both(row.configuration, contact(row.configuration, 1e-6), 1e-12);
  }
}

TEST(Manifold, FullDiscHasPointsAtTheRim120DegreesApart) {
  const Configuration c{Cylinder(1, 2), Pose({0, 0, 2.9}, upright), Box({3, 3, 1}), Pose()};
  const Contact answer = contact(c, 0);
  ASSERT_EQ(answer.points().size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 p = answer.points()[i].position, q = answer.points()[(i + 1) % 3].position;
    EXPECT_NEAR((p - q).norm(), std::sqrt(3.0), 1e-14);
    EXPECT_NEAR(p.z(), 0.95, 1e-15);
  }
}

TEST(Manifold, ParallelSidesHaveTheEndsOfTheirOverlap) {
  const Configuration c{Cylinder(1, 2), Pose({1.9, 0, 1}, upright), Cylinder(1, 2), Pose()};
  const Contact answer = contact(c, 0);
  ASSERT_EQ(answer.points().size(), 2u);
  const double z0 = answer.points()[0].position.z(), z1 = answer.points()[1].position.z();
  EXPECT_NEAR(std::min(z0, z1), -1, 1e-14);
  EXPECT_NEAR(std::max(z0, z1), 2, 1e-14);
  for (const auto& p : answer.points()) EXPECT_NEAR(p.position.x(), 0.95, 1e-15);
}

TEST(Manifold, SideEndingWithinTheCapHasItsEndAndTheRim) {
  const Configuration c{Cylinder(1, 2), Pose({0, 0, 2.9}, upright), Cylinder(1, 4),
                        Pose({4.2, 0.6, 0}, along_x)};
  const Contact answer = contact(c, 0);
  ASSERT_EQ(answer.points().size(), 2u);
  const double x0 = answer.points()[0].position.x(), x1 = answer.points()[1].position.x();
  EXPECT_NEAR(std::min(x0, x1), 0.2, 1e-14);
  EXPECT_NEAR(std::max(x0, x1), 0.8, 1e-14);
}

// About the lens's middle, the hull of the points reaches at least half as far as the lens does, in
// every direction.
TEST(Manifold, FourPointsCoverCapsThatPartlyOverlap) {
  for (const double radius : {0.3, 0.8, 1.0, 2.5}) {
    for (const double part : {0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99}) {
      // From nearly apart to nearly within.
      const double distance = std::abs(radius - 1) + part * 2 * std::min(radius, 1.0);
      const Configuration c{Cylinder(1, 1), Pose({distance, 0, 1.999}, upright),
                            Cylinder(radius, 1), Pose()};
      const Contact answer = contact(c, 0);
      ASSERT_EQ(answer.points().size(), 4u);
      const ArcPolygon lens = ArcPolygon::lens({Vec2(distance, 0), 1}, {Vec2(0, 0), radius});
      const double left = lens.farthest(Vec2(-1, 0)).x(), right = lens.farthest(Vec2(1, 0)).x();
      const Vec2 middle((left + right) / 2, 0);
      for (double angle = 0; angle < 6.3; angle += 0.01) {
        const Vec2 n(std::cos(angle), std::sin(angle));
        double most = 0;
        for (const auto& p : answer.points()) {
          most = std::max(most, n.dot(Vec2(p.position.x(), p.position.y()) - middle));
        }
        EXPECT_GE(most, 0.5 * n.dot(lens.farthest(n) - middle)) << radius << " " << part;
      }
    }
  }
}

// A tilt of a hair keeps the manifold, a degree leaves the deepest point.
TEST(Manifold, FadesAsTheTiltGrows) {
  const struct {
    const char* name;
    Cylinder a;
    Vec3 position;
    Quaternion base;
    Shape b;
    std::size_t straight;
  } table[] = {
      {"standing on a plane", Cylinder(1, 2), {0, 0, 1.9}, upright, Plane({0, 0, 1}, 0), 3},
      {"lying on a plane", Cylinder(1, 2), {0, 0, 0.9}, along_x, Plane({0, 0, 1}, 0), 2},
      {"standing on a cylinder", Cylinder(1, 2), {0.3, 0, 3.9}, upright, Cylinder(2, 2), 3},
      {"standing on a box", Cylinder(1, 2), {0, 0, 2.9}, upright, Box({3, 3, 1}), 3},
      {"standing on a box's corner", Cylinder(1, 2), {3, 3, 2.9}, upright, Box({3, 3, 1}), 4},
      {"lying on a box", Cylinder(1, 2), {0, 0, 1.9}, along_x, Box({3, 3, 1}), 2},
      {"beside a capsule", Cylinder(1, 2), {1.4, 0, 0}, upright, Capsule(0.5, 2), 2},
      {"beside a cylinder", Cylinder(1, 2), {1.9, 0, 0}, upright, Cylinder(1, 2), 2},
  };
  for (const auto& row : table) {
    SCOPED_TRACE(row.name);
    const auto tilted = [&](double tilt) {
      const Quaternion turn(1, tilt / 2 * 0.6, tilt / 2 * 0.8, 0);
      return Configuration{row.a, Pose(row.position, turn * row.base), row.b, Pose()};
    };
    for (const double tilt : {0.0, 1e-15, 1e-12, 1e-9}) {
      EXPECT_EQ(contact(tilted(tilt), 0).points().size(), row.straight) << tilt;
    }
    EXPECT_EQ(contact(tilted(0.0175), 0).points().size(), 1u);
    // Points that stay are always on both bodies and never far above the deepest.
    for (double tilt = 1e-15; tilt < 0.1; tilt *= 1.1) {
      const Configuration c = tilted(tilt);
      const Contact answer = contact(c, 0);
      SCOPED_TRACE(tilt);
      expect_points_on_both(c, answer, 1e-8);
      for (const auto& p : answer.points()) EXPECT_GE(p.depth, -answer.signed_distance - 3e-3);
    }
  }
}

// A tilt of a few 1e-4 is what one step of a simulation makes of a body that lost its support on
// one side: as long as that side overlaps it must keep a point.
TEST(Manifold, StandsOnAllSidesThatOverlap) {
  const Cylinder can(1, 1);
  const Plane ground({0, 0, 1}, 0);
  const auto standing = [&](double tilt, double depth) {
    const double height = std::cos(tilt) + std::sin(tilt) - depth;
    return contact({can, Pose({0, 0, height}, Quaternion(Eigen::AngleAxisd(tilt, Vec3::UnitY()))),
                    ground, Pose()},
                   0);
  };
  EXPECT_EQ(standing(4e-4, 1e-3).points().size(), 3u);  // all of the cap overlaps
  const Contact half = standing(4e-4, 4e-4);            // half of it does
  EXPECT_GT(half.points().size(), 2u);
  double least = 1;
  for (const auto& p : half.points()) least = std::min(least, p.position.x());
  EXPECT_NEAR(least, 0, 1e-3);
  EXPECT_EQ(standing(4e-4, 0).points().size(), 1u);
}

TEST(Manifold, StandsOnThreePointsWhereverTheThresholdAdmitsThem) {
  const Cylinder can(1, 1);
  const Plane ground({0, 0, 1}, 0);
  EXPECT_EQ(contact({can, Pose({0, 0, 1}, upright), ground, Pose()}, 0).points().size(), 3u);
  EXPECT_EQ(contact({can, Pose({0, 0, 1 + 1e-7}, upright), ground, Pose()}, 0).points().size(), 0u);
  EXPECT_EQ(contact({can, Pose({0, 0, 1 + 1e-7}, upright), ground, Pose()}, 1e-6).points().size(),
            3u);
}

class ManifoldOfPair : public testing::TestWithParam<Pair> {};

TEST_P(ManifoldOfPair, LiesOnBothBodiesInEveryPoseClass) {
  for (const auto& name : pose_classes(GetParam())) {
    for (std::uint64_t i = 0; i < 40; ++i) {
      const Identity id{GetParam(), name, 11, i};
      const Configuration c = make_configuration(id);
      const Contact answer = contact(c, 0);
      SCOPED_TRACE(to_string(id));
      ASSERT_EQ(answer.points().empty(), answer.signed_distance > 0);
      // Where rims meet at a small tilt, rounding of the normal over the tilt says where on the
      // rim.
      const double aside = name.starts_with("near-parallel") ? 1e-6 : 3e-8;
      expect_points_on_both(c, answer, aside * larger_size(c) + position_rounding(c));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, ManifoldOfPair, testing::ValuesIn(all_pairs), [](const auto& pair) {
  return std::string(pair_name(pair.param)).substr(std::string("cylinder-").size());
});

}  // namespace
}  // namespace touchstone
