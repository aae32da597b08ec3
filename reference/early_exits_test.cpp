// Where a search ends early it rests on a proof (proofs.md, "Where a search ends early"). Each test
// draws bodies that attack one of them: it held of most, and was false of some.
//
// TOUCHSTONE_COUNT times a hundred and more pairs are drawn of each kind; by default 100.
#include <cmath>
#include <gtest/gtest.h>

#include "oracle/hull.hpp"
#include "oracle/truth.hpp"
#include "reference/contact_of.hpp"
#include "reference/random_hulls_test.hpp"
#include "reference/rounding_made_test.hpp"

namespace touchstone {
namespace {

std::uint64_t count() { return tried_of_each(100); }

void expect_the_truth(const Configuration& c, std::uint64_t index) {
  const oracle::Truth truth = oracle::truth(c);
  const double sigma = truth.signed_distance.midpoint(), rounding = promised * scale_of(c);
  const SignedDistance answer = signed_distance(c);
  EXPECT_NEAR(answer.value, sigma, rounding) << index;
  EXPECT_LE(oracle::normal_regret(c, truth, answer.normal), rounding) << index;
  EXPECT_NEAR(certified_distance(c).value, sigma, rounding) << index;
}

/// Against `certified_distance`, which takes no early exit.
void expect_no_short_cut_is_wrong(const Configuration& c, std::uint64_t index) {
  const double sigma = certified_distance(c).value, rounding = promised * scale_of(c);
  EXPECT_NEAR(signed_distance(c).value, sigma, rounding) << index;
  for (const double threshold : {0.0, 0.9 * sigma, 1.1 * sigma}) {
    if (std::abs(sigma - threshold) <= rounding) continue;
    EXPECT_EQ(contact(c, threshold).points().empty(), sigma > threshold) << index;
  }
  if (std::abs(sigma) > rounding) {
    EXPECT_EQ(overlaps(c), sigma < 0) << index;
  }
}

// The point of a cap that faces the other body was looked for in the direction of the product of
// the axes, and as far off as that is long; of axes that are parallel but for rounding, that is
// noise. A point that was not on the rim at all proved a cap the best of bodies beyond each other's
// cap and side, up to 3e-3 of the size too near.
TEST(EarlyExits, AreRightOfWhatRoundingMakes) {
  for (std::uint64_t i = 0; i < 500 * count(); ++i) {
    const Configuration c = RoundingMade(i).arrangement();
    expect_no_short_cut_is_wrong(c, i);
    if (i % 1000 == 0) expect_the_truth(c, i);
    expect_no_short_cut_is_wrong(RoundingMade(i).diagonal(), i);
  }
}

// Along a normal that is the coin's own axis but for rounding every point of its cap is the
// furthest. The one that the formula took lay within the post, the one that faces it beyond its
// end: the cap's normal was taken for the best, up to 5e-6 of the size too deep.
TEST(EarlyExits, AreRightOfPostsAlongACoinsRim) {
  for (std::uint64_t i = 0; i < 5 * count(); ++i) {
    expect_the_truth(RoundingMade(i).post_along_rim(), i);
  }
}

// Bounds on arcs fail where the gap is flat, and the search gave up after 20,000 samples with most
// of the rim left: one in four was wrong, by up to 1e-8 of the size.
TEST(EarlyExits, AreRightOfEqualCoinsThroughEachOthersCentres) {
  for (std::uint64_t i = 0; i < 2 * count(); ++i) {
    expect_the_truth(RoundingMade(i).equal_coins(), i);
  }
}

// Sines next to one, rounded down on one side and up on the other, left an empty range of normals:
// up to 1e-11 of the size too near.
TEST(EarlyExits, AreRightOfNeedlesOverAFarLargerRim) {
  for (std::uint64_t i = 0; i < 200 * count(); ++i) {
    expect_no_short_cut_is_wrong(RoundingMade(i).needle_over_rim(), i);
  }
}

// The search of rims stopped before it had found the best normal of one in two hundred of them, up
// to 8e-7 of the size off, and proved half.
TEST(EarlyExits, AreRightOfCoinsDeepInEachOtherOnNearlyPerpendicularAxes) {
  for (std::uint64_t i = 0; i < count(); ++i) {
    expect_the_truth(RoundingMade(i).deep_coins(), i);
  }
}

/// In any frame: A as it is placed there, B the hull of points.
Configuration turned(Random& random, const Cylinder& a, const Vec3& centre, const Vec3& axis,
                     const std::vector<Vec3>& points) {
  const Eigen::Quaterniond turn = random.turn();
  return {a, Pose(turn * centre, turn * turn_between(Vec3::UnitZ(), axis)),
          oracle::convex_hull(points), Pose(Vec3::Zero(), turn)};
}

/// About as long as another length, or by far longer.
double about_or_longer(Random& random, double length) {
  return length * (random.toss() ? random.uniform(0.5, 2) : random.power_of_ten(0, 3));
}

// A's lowest point is in a triangle, or the top of a tetrahedron, about its depth away from an
// edge, and A is about that thick. Without its disc about the point as wide as that, or without the
// rest of A, the shorter way out is past the edge. It is shorter by a hair where A stands nearly
// upright and the point is a little less than its depth away.
TEST(EarlyExits, AreRightOfFacesNextToTheirEdges) {
  for (std::uint64_t i = 0; i < 200 * count(); ++i) {
    Random random(i);
    const double depth = random.power_of_ten(-3, 0);
    const Cylinder a(about_or_longer(random, depth), about_or_longer(random, depth));
    const bool is_by_a_hair = random.toss();
    const double hair = random.power_of_ten(-7, 0), lean = hair * random.power_of_ten(-4, 0);
    const double beside = is_by_a_hair ? depth * (1 - hair) : about_or_longer(random, depth);
    std::vector<Vec3> points = {{-beside, -2e3, 0}, {-beside, 2e3, 0}, {4e3, 0, 0}};
    if (random.toss()) points.emplace_back(1, 0, -about_or_longer(random, depth));
    const Vec3 axis = is_by_a_hair ? Vec3(lean, lean * random.uniform(-1, 1), 1).normalized()
                                   : random.direction();
    const Vec3 low = a.half_length() * -axis;
    const Vec3 down = (Vec3::UnitZ() - axis.z() * axis).normalized();
    const Vec3 centre = Vec3(0, 0, -depth) - (axis.z() > 0 ? low : Vec3(-low)) + a.radius() * down;
    expect_no_short_cut_is_wrong(turned(random, a, centre, axis, points), i);
  }
}

// A rim meets an edge along a normal that is stationary, about as deep as it may be for a maximum;
// the edge goes on for about that much, and A is about as thick.
TEST(EarlyExits, AreRightOfRimsAcrossAnEdge) {
  for (std::uint64_t i = 0; i < 200 * count(); ++i) {
    Random random(i);
    const double radius = random.uniform(0.2, 1), steep = random.uniform(0.01, 1.5);
    const double turn = random.toss() ? random.uniform(0, 1.6) : random.power_of_ten(-3, 0);
    const double length = random.toss() ? random.uniform(0.1, 2) : random.power_of_ten(-3, 0);
    const double sine = std::sin(turn);
    const double round = 2 * radius * length * sine * sine / (radius + 2 * length);
    const double depth = random.toss() ? round * random.uniform(0, 2) : -random.power_of_ten(-9, 0);
    const Cylinder a(radius, about_or_longer(random, std::abs(depth)));
    const Vec3 outward(std::cos(steep), 0, std::sin(steep)), tangent(0, 1, 0);
    const Vec3 along = std::cos(turn) * outward.cross(tangent) + sine * tangent;
    const Vec3 on_edge = Vec3(radius, 0, a.half_length()) - depth * outward;
    const Vec3 aside = along.cross(outward);
    std::vector<Vec3> points = {on_edge - length * along,
                                on_edge + about_or_longer(random, length) * along};
    for (int k = random.toss() ? 1 : 3; k > 0; --k) {
      points.push_back(on_edge + random.power_of_ten(-2, 1) * (random.uniform(0, 1) * outward +
                                                               random.uniform(-1, 1) * aside +
                                                               random.uniform(-1, 1) * along));
    }
    expect_no_short_cut_is_wrong(turned(random, a, Vec3::Zero(), Vec3::UnitZ(), points), i);
  }
}

// Of a segment off a rim the other end is farther along the way from its end to there, or less far,
// by a hair or by much: only where it is less far that end has a normal of its own.
TEST(EarlyExits, AreRightOfSegmentsAcrossTheWayToARim) {
  for (std::uint64_t i = 0; i < 20 * count(); ++i) {
    Random random(i);
    const Cylinder a(random.power_of_ten(-1, 0), random.power_of_ten(-1, 0));
    const double steep = random.uniform(0.01, 1.5), turn = random.uniform(-3, 3);
    const double lean = random.sign() * random.power_of_ten(-16, 0);
    const Vec3 away(std::cos(steep), 0, std::sin(steep)), tangent(0, 1, 0);
    const Vec3 across = std::cos(turn) * tangent + std::sin(turn) * away.cross(tangent);
    const Vec3 along = (across + lean * away).normalized();
    const Capsule b(random.power_of_ten(-9, -3), random.power_of_ten(-1, 0));
    const Vec3 end = Vec3(a.radius(), 0, a.half_length()) + random.power_of_ten(-6, 0) * away;
    expect_the_truth(
        {a, Pose(), b, Pose(end + b.half_length() * along, turn_between(Vec3::UnitZ(), along))}, i);
  }
}

// Along the best normal of one edge another vertex is farther, or less far, by a hair: the edge's
// distance is the hull's only where it is less far.
TEST(EarlyExits, AreRightOfVerticesThatExceedAnEdgeByAHair) {
  for (std::uint64_t i = 0; i < 50 * count(); ++i) {
    Random random(i);
    const Cylinder a(random.power_of_ten(-1, 0), random.power_of_ten(-1, 0));
    const Capsule edge(random.power_of_ten(-9, -3), random.power_of_ten(-1, 0));
    const Vec3 along = random.direction(), end = edge.half_length() * along;
    const Pose pose(Vec3::Zero(), turn_between(Vec3::UnitZ(), along));
    Configuration c{a, Pose(random.direction(), random.turn()), edge, pose};
    c = moved_to_depth(c, (random.toss() ? 1 : -1) * random.power_of_ten(-4, -1));
    const Vec3 n = signed_distance(c).normal, beside = random.direction();
    const double hair = random.sign() * random.power_of_ten(-14, -3);
    const Vec3 from = n.dot(end) > 0 ? end : Vec3(-end);
    const Vec3 vertex = from + beside - (n.dot(beside) - hair) * n;
    c.b = oracle::convex_hull({-end, end, vertex}), c.pose_b = Pose();
    expect_no_short_cut_is_wrong(c, i);
  }
}

// Corners a unit in the last place apart, or the least double, leave faces so thin that their
// normals were lost: a plane that did not pass through its face proved edges closed, up to 0.06 too
// deep.
TEST(EarlyExits, AreRightOfHullsWithTheThinnestFaces) {
  for (std::uint64_t i = 0; i < 50 * count(); ++i) {
    Random random(i);
    const auto coordinate = [&] {
      const double x = std::round(random.uniform(-2.5, 2.5)) / 2;
      if (random.uniform(0, 1) < 0.7) return x;
      return std::nextafter(x, random.toss() ? 2 : -2);
    };
    std::vector<Vec3> points;
    for (int k = 0; k < 8; ++k) points.emplace_back(coordinate(), coordinate(), coordinate());
    points.emplace_back(points[0].x(), std::nextafter(points[0].y(), 2), points[0].z());
    const Cylinder a(random.power_of_ten(-2, 0), random.power_of_ten(-2, 0));
    const Vec3 centre(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    expect_no_short_cut_is_wrong({a, Pose(centre, turn_between(Vec3::UnitZ(), random.direction())),
                                  oracle::convex_hull(points), Pose()},
                                 i);
  }
}

}  // namespace
}  // namespace touchstone
