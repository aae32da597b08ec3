// How much of the contact patch the points' hull covers, and the layouts of points on a disc.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "reference/contact_of.hpp"
#include "reference/curves.hpp"
#include "reference/disc_layout.hpp"
#include "reference/points_on_both_test.hpp"

namespace touchstone {
namespace {

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

/// What a disc about the origin shares with one of radius 1 so far along x.
Patch lens(double radius, double distance) {
  const Vec2 other(distance, 0);
  const Vec2 middle((std::max(distance - 1, -radius) + std::min(distance + 1, radius)) / 2, 0);
  return {middle, [=](const Vec2& unit) {
            return std::min(reach_in_disc(middle, unit, other, 1),
                            reach_in_disc(middle, unit, {0, 0}, radius));
          }};
}

TEST(Manifold, CoversTheDiscsThatCapsShare) {
  for (const double radius : {0.3, 0.8, 1.0, 2.5}) {
    for (const double part : {0.0, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99}) {
      // From one within the other to nearly apart.
      const double distance = std::abs(radius - 1) + part * 2 * std::min(radius, 1.0);
      const Configuration c{Cylinder(1, 1), Pose({distance, 0, 1.999}, upright),
                            Cylinder(radius, 1), Pose()};
      const Contact answer = contact(c, 0);
      EXPECT_EQ(answer.points().size(), part > 0 ? 4u : 3u);
      // No two pairs of points, mirrored across the line of centres, have more than 0.68 of some.
      EXPECT_GE(coverage(lens(radius, distance), answer), part > 0 ? 0.65 : bar(3))
          << radius << " " << part;
    }
  }
}

// The lens keeps its four points, whichever way it leans by a hair, and has the deepest with them.
TEST(Manifold, CoversTheDiscsThatLeaningCapsShare) {
  for (const double radius : {0.3, 1.0, 2.5}) {
    for (const double part : {0.1, 0.5, 0.9}) {
      const double distance = std::abs(radius - 1) + part * 2 * std::min(radius, 1.0);
      const Patch patch = lens(radius, distance);
      for (double heading = 0.1; heading < 6.3; heading += 0.3) {
        // The deepest point is one of them when the tilt is clear.
        const double tilt = std::fmod(heading, 0.6) < 0.3 ? 1e-9 : 1e-5;
        const Vec3 axis(std::cos(heading), std::sin(heading), 0);
        const Configuration c{Cylinder(1, 1),
                              Pose({distance, 0, 1.999}, Quaternion(Eigen::AngleAxisd(tilt, axis))),
                              Cylinder(radius, 1), Pose()};
        const Contact answer = contact(c, 0);
        EXPECT_GE(answer.points().size(), 4u);
        EXPECT_LE(answer.points().size(), tilt < 1e-6 ? 4u : 5u);
        EXPECT_GE(coverage(patch, answer), 0.5) << radius << " " << part << " " << heading;
        double deepest = -1;
        for (const auto& p : answer.points()) deepest = std::max(deepest, p.depth);
        EXPECT_NEAR(deepest, -answer.signed_distance, tilt < 1e-6 ? tilt : 1e-14);
      }
    }
  }
}

// Where the threshold admits less and less of a cap that leans, its points draw together: they span
// the chord up to which it is admitted, whose half is sin φ of the radius if 1 - cos φ is admitted.
TEST(Manifold, CoversThePartOfALeaningCapThatTheThresholdAdmits) {
  constexpr double tilt = 1e-5;
  const Quaternion leaning(Eigen::AngleAxisd(tilt, Vec3::UnitY()));
  const double lowest = std::cos(tilt) + std::sin(tilt);
  const Configuration c{Cylinder(1, 1), Pose({0.3, 0.2, 1 + lowest - 0.01}, leaning),
                        Box({3, 3, 1}), Pose()};
  for (const double admitted : {0.5, 0.1, 1e-2, 1e-3, 1e-4, 1e-5}) {
    const Contact answer = contact(c, -0.01 + admitted * tilt);
    double lower = 0, upper = 0;
    for (const auto& p : answer.points()) {
      lower = std::min(lower, p.position.y() - 0.2), upper = std::max(upper, p.position.y() - 0.2);
    }
    const double half_chord = std::sqrt(admitted * (2 - admitted));
    EXPECT_NEAR(upper, half_chord, 1e-3 * half_chord) << admitted;
    EXPECT_NEAR(lower, -half_chord, 1e-3 * half_chord) << admitted;
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
    // Where an edge cuts off less than a hundredth, the three points of a whole cap are handed
    // over.
    const double cut = 1 - (half_sides - centre.cwiseAbs()).minCoeff();
    EXPECT_GE(coverage(patch, answer), bar(cut < 0.01 ? 3 : count))
        << count << " " << centre.transpose() << " in " << half_sides.transpose();
  }
  for (const int count : {3, 4, 5, 6, 7, 8}) EXPECT_GT(met[count], 0) << count;
}

constexpr double radius = 2, slack = 1e-3, clear_rise = 1e-6 * radius;

std::vector<Vec2> layout(const Vec2& slope) {
  std::array<Vec2, 6> arms;
  const int count = spread_disc(radius, slope, Vec2(0.6, 0.8), slack, clear_rise, arms);
  return {arms.begin(), arms.begin() + count};
}
Vec2 unit_at(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// How far above its lowest place the disc is there, metres.
double rise(const Vec2& arm, const Vec2& slope) { return slope.dot(arm) + radius * slope.norm(); }

TEST(DiscLayout, LevelDiscHasThreePointsWhicheverWayRoundingTiltsIt) {
  const std::vector<Vec2> level = layout(Vec2(0, 0));
  ASSERT_EQ(level.size(), 3u);
  EXPECT_NEAR((level[0] - radius * Vec2(0.6, 0.8)).norm(), 0, 1e-15);
  EXPECT_NEAR((level[0] - level[1]).norm(), radius * std::sqrt(3.0), 1e-15);
  EXPECT_NEAR((level[2] - level[1]).norm(), radius * std::sqrt(3.0), 1e-15);
  for (double angle = 0; angle < 6.3; angle += 0.1) {
    for (double steepness = 1e-18; steepness < 4e-7; steepness *= 10) {
      EXPECT_EQ(layout(steepness * unit_at(angle)), level);
    }
  }
}

TEST(DiscLayout, HasTheLowestPointOfADiscThatClearlyLeans) {
  for (double angle = 0; angle < 6.3; angle += 0.1) {
    for (double steepness = 1.01e-6; steepness < 0.01; steepness *= 1.3) {
      const Vec2 slope = steepness * unit_at(angle);
      double lowest = slack;
      for (const Vec2& arm : layout(slope)) {
        lowest = std::min(lowest, rise(arm, slope));
        EXPECT_LE(arm.norm(), radius * (1 + 1e-15));
        EXPECT_LE(rise(arm, slope), slack * (1 + 1e-12));
      }
      EXPECT_NEAR(lowest, 0, 1e-17);
    }
  }
}

TEST(DiscLayout, LessSlackThanTheTiltTakesLeavesThreePointsAboutTheLowest) {
  const Vec2 slope(5e-4, 0);  // rises by the slack over half of the disc
  const std::vector<Vec2> points = layout(slope);
  ASSERT_EQ(points.size(), 3u);
  EXPECT_NEAR((points[0] - Vec2(-radius, 0)).norm(), 0, 1e-15);
  for (const int side : {1, 2}) EXPECT_NEAR(rise(points[side], slope), slack, 1e-15);
}

TEST(HandOver, GrowsTheNewBeforeItShrinksTheOld) {
  EXPECT_FALSE(HandOver{0}.has_begun());
  EXPECT_EQ(HandOver{1}.new_size(), 1);
  EXPECT_EQ(HandOver{1}.old_size(), 1);
  EXPECT_EQ(HandOver{0.5}.new_size(), 0.75);
  EXPECT_EQ(HandOver{1.5}.old_size(), 0.75);
  EXPECT_TRUE(HandOver{2}.is_over());
}

}  // namespace
}  // namespace touchstone
