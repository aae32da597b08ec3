// The contact points of every pair as the thesis counts them (its figures 4 to 6, 16 to 20 and 21
// to 28), and the laws that every manifold keeps.
#include <array>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <random>
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

/// A contact patch in the plane z = 0 about a point within it: how far it reaches along a unit
/// vector.
struct Patch {
  Vec2 within;
  std::function<double(const Vec2&)> reach;
};

double reach_in_disc(const Vec2& from, const Vec2& unit, const Vec2& centre, double radius) {
  const Vec2 arm = from - centre;
  const double along = arm.dot(unit);
  return -along + std::sqrt(along * along + radius * radius - arm.squaredNorm());
}
double reach_in_rectangle(const Vec2& from, const Vec2& unit, const Vec2& half_sides) {
  double reach = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 2; ++i) {
    if (unit[i] != 0)
      reach = std::min(reach, (std::copysign(half_sides[i], unit[i]) - from[i]) / unit[i]);
  }
  return reach;
}

/// By what factor, at most 1, the patch may be shrunk about its centroid to lie within the hull of
/// the points.
double coverage(const Patch& patch, const Contact& answer) {
  constexpr int directions = 240;
  std::vector<Vec2> outline;
  for (int i = 0; i < directions; ++i) {
    const double angle = 2 * std::numbers::pi * i / directions;
    const Vec2 unit(std::cos(angle), std::sin(angle));
    outline.push_back(patch.within + patch.reach(unit) * unit);
  }
  double area = 0;
  Vec2 centroid(0, 0);
  for (int i = 0; i < directions; ++i) {
    const Vec2 p = outline[i] - patch.within, q = outline[(i + 1) % directions] - patch.within;
    area += cross2(p, q);
    centroid += cross2(p, q) / 3 * (p + q);
  }
  centroid = patch.within + centroid / area;

  double least = 1;
  for (int i = 0; i < directions; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.5) / directions;
    const Vec2 n(std::cos(angle), std::sin(angle));
    double hull = 0, whole = 0;
    for (const Vec2& p : outline) whole = std::max(whole, n.dot(p - centroid));
    for (const auto& p : answer.points()) {
      hull = std::max(hull, n.dot(Vec2(p.position.x(), p.position.y()) - centroid));
    }
    least = std::min(least, hull / whole);
  }
  return least;
}

/// What so many points cover at least. The most that three of a full disc's rim can is 0.5, four
/// 0.707, eight 0.924; fewer are left where edges cut off next to nothing, so that corners
/// coincide.
double bar(std::size_t points) { return points < 4 ? 0.495 : points < 8 ? 0.65 : 0.85; }

TEST(Manifold, CoversTheDiscsThatCapsShare) {
  for (const double radius : {0.3, 0.8, 1.0, 2.5}) {
    for (const double part : {0.0, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99}) {
      // From one within the other to nearly apart.
      const double distance = std::abs(radius - 1) + part * 2 * std::min(radius, 1.0);
      const Configuration c{Cylinder(1, 1), Pose({distance, 0, 1.999}, upright),
                            Cylinder(radius, 1), Pose()};
      const Contact answer = contact(c, 0);
      EXPECT_EQ(answer.points().size(), part > 0 ? 4u : 3u);
      const Vec2 other(distance, 0),
          middle((std::max(distance - 1, -radius) + std::min(distance + 1, radius)) / 2, 0);
      const Patch patch{middle, [&](const Vec2& unit) {
                          return std::min(reach_in_disc(middle, unit, other, 1),
                                          reach_in_disc(middle, unit, {0, 0}, radius));
                        }};
      // No two pairs of points, mirrored across the line of centres, have more than 0.68 of some.
      EXPECT_GE(coverage(patch, answer), part > 0 ? 0.65 : bar(3)) << radius << " " << part;
    }
  }
}

// The lens keeps its four points, and the deepest, whichever way it leans by a hair.
TEST(Manifold, CoversTheDiscsThatLeaningCapsShare) {
  for (const double radius : {0.3, 1.0, 2.5}) {
    for (const double part : {0.1, 0.5, 0.9}) {
      const double distance = std::abs(radius - 1) + part * 2 * std::min(radius, 1.0);
      const Vec2 other(distance, 0);
      const Vec2 middle((std::max(distance - 1, -radius) + std::min(distance + 1, radius)) / 2, 0);
      const Patch patch{middle, [&](const Vec2& unit) {
                          return std::min(reach_in_disc(middle, unit, other, 1),
                                          reach_in_disc(middle, unit, {0, 0}, radius));
                        }};
      for (double heading = 0.1; heading < 6.3; heading += 0.3) {
        const Vec3 axis(std::cos(heading), std::sin(heading), 0);
        const Configuration c{Cylinder(1, 1),
                              Pose({distance, 0, 1.999}, Quaternion(Eigen::AngleAxisd(1e-9, axis))),
                              Cylinder(radius, 1), Pose()};
        const Contact answer = contact(c, 0);
        EXPECT_GE(answer.points().size(), 4u);
        EXPECT_LE(answer.points().size(), 5u);
        EXPECT_GE(coverage(patch, answer), 0.5) << radius << " " << part << " " << heading;
        EXPECT_NEAR(answer.points()[0].depth, -answer.signed_distance, 1e-14);
      }
    }
  }
}

TEST(Manifold, CoversTheOctagonThatFourEdgesCut) {
  const Configuration c{Cylinder(1, 2), Pose({0, 0, 2.9}, upright), Box({0.9, 0.9, 1}), Pose()};
  const Patch patch{Vec2(0, 0), [](const Vec2& unit) {
                      return std::min(reach_in_disc({0, 0}, unit, {0, 0}, 1),
                                      reach_in_rectangle({0, 0}, unit, {0.9, 0.9}));
                    }};
  EXPECT_GE(coverage(patch, contact(c, 0)), 0.9);
}

TEST(Manifold, CoversTheDiscThatAFaceCuts) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::array<int, 9> met{};
  for (int i = 0; i < 600; ++i) {
    const Vec2 half_sides(0.3 + 1.2 * uniform(random), 0.3 + 1.2 * uniform(random));
    // The face's nearest point lies within 0.9 of the disc's radius; a third are centred.
    const Vec2 most = half_sides + Vec2(0.9, 0.9);
    const double x = (2 * uniform(random) - 1) * most.x(), y = (2 * uniform(random) - 1) * most.y();
    const Vec2 centre = i % 3 == 0 ? Vec2(0, 0) : Vec2(x, y);
    const Vec2 nearest = centre.cwiseMax(-half_sides).cwiseMin(half_sides);
    if ((nearest - centre).norm() > 0.9) continue;
    const Configuration c{Cylinder(1, 1), Pose({centre.x(), centre.y(), 1.999}, upright),
                          Box({half_sides.x(), half_sides.y(), 1}), Pose()};
    const Contact answer = contact(c, 0);
    // The mean of points within both is within.
    Vec2 within(0, 0);
    int inside = 0;
    for (int k = 0; k < 41 * 41; ++k) {
      const Vec2 p = half_sides.cwiseProduct(Vec2(k % 41 - 20, k / 41 - 20)) / 20.0;
      if ((p - centre).norm() < 1) within += p, ++inside;
    }
    within /= inside;
    const Patch patch{within, [&](const Vec2& unit) {
                        return std::min(reach_in_disc(within, unit, centre, 1),
                                        reach_in_rectangle(within, unit, half_sides));
                      }};
    const std::size_t count = answer.points().size();
    ++met[count];
    EXPECT_GE(coverage(patch, answer), bar(count))
        << count << " " << centre.transpose() << " in " << half_sides.transpose();
  }
  for (const int count : {3, 4, 5, 6, 7, 8}) EXPECT_GT(met[count], 0) << count;
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

// However a body is turned by a step, the points that it had and those that it has then belong to
// the part of its surface that lies within the slack of the deepest point, before and after, but
// for what the step itself lifts.
TEST(Manifold, MovesNoFurtherThanThePatchInAStep) {
  constexpr double size = 1, slack = 1e-3 * size, depth = 0.01;
  const Shape grounds[] = {Plane({0, 0, 1}, 1), Box({3, 3, 1}), Cylinder(3, 1)};
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const Shape& ground : grounds) {
    for (const Quaternion& base : {upright, along_x}) {
      for (int i = 0; i < 3000; ++i) {
        const auto axis_angle = [&](double angle) {
          const Vec3 axis(uniform(random), uniform(random), 0.1 * uniform(random));
          return Quaternion(Eigen::AngleAxisd(angle, axis.normalized()));
        };
        const double step = std::pow(10, -2 - 8 * std::abs(uniform(random)));
        const Quaternion before =
            axis_angle(std::pow(10, -1 - 11 * std::abs(uniform(random)))) * base.normalized();
        const Quaternion after = axis_angle(step) * before;
        const Cylinder can(size, size);
        // As high as leaves the depth.
        const auto posed_at = [&](const Quaternion& turn) {
          const double z = (turn * Vec3::UnitZ()).z();
          return Pose({0.3, 0.2, 1 + size * (std::abs(z) + std::sqrt((1 - z) * (1 + z))) - depth},
                      turn);
        };
        const Pose pose_before = posed_at(before), pose_after = posed_at(after);
        const auto expect_within = [&](const Pose& of, const Pose& at) {
          const Contact answer = contact({can, of, ground, Pose()}, 0);
          ASSERT_GT(answer.points().size(), 0u);
          for (const auto& p : answer.points()) {
            const Vec3 on_can = p.position - p.depth / 2 * answer.normal;
            const Vec3 local = of.rotation().transpose() * (on_can - of.position());
            const double height = (at.position() + at.rotation() * local).z() - (1 - depth);
            EXPECT_LE(height, slack + 4 * size * step) << step;
          }
        };
        expect_within(pose_before, pose_after);
        expect_within(pose_after, pose_before);
      }
    }
  }
}

TEST(Manifold, StandsOnAPlaneOfAnyNormal) {
  for (const Vec3& n : {Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(0.6, 0, -0.8), Vec3(2, 3, 6)}) {
    const Quaternion turn = Quaternion::FromTwoVectors(Vec3::UnitZ(), n);
    const Contact answer =
        contact({Cylinder(1, 2), Pose(1.9 * n.normalized(), turn), Plane(n, 0), Pose()}, 0);
    ASSERT_EQ(answer.points().size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 p = answer.points()[i].position, q = answer.points()[(i + 1) % 3].position;
      EXPECT_NEAR((p - q).norm(), std::sqrt(3.0), 1e-14);
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
