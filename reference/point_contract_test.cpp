// What every contact promises of its points, whatever the pose and the threshold: one as deep as
// the bodies, none deeper, none beyond the threshold, each halfway between the surfaces.
//
// TOUCHSTONE_COUNT sets how many configurations of each pose class are tried; by default 100.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <string>

#include "properties/identity.hpp"
#include "reference/contact_of.hpp"
#include "reference/critical_poses_test.hpp"
#include "reference/points_on_both_test.hpp"
#include "reference/random_hulls_test.hpp"

namespace touchstone {
namespace {

std::uint64_t contacts_per_class() { return tried_of_each(100); }

/// One point is as deep as the bodies, none deeper and none beyond the threshold.
void expect_depths(const Configuration& c, const Contact& answer, double threshold) {
  const double rounding = 1e-13 * scale_of(c), depth = -answer.signed_distance;
  double deepest = -std::numeric_limits<double>::infinity();
  for (const ContactPoint& p : answer.points()) {
    deepest = std::max(deepest, p.depth);
    EXPECT_GE(p.depth, -threshold - rounding);
  }
  // Three points of a body at rest do not see which way it leans by less than a millionth.
  EXPECT_GE(deepest, depth - std::max(1e-6 * smaller_size(c), rounding));
  EXPECT_LE(deepest, depth + rounding);
}

/// `aside` is how far off their surfaces points may lie, next to what round bodies do.
void expect_contract(const Configuration& c, double threshold, double aside,
                     PointRange range = PointRange::near_deepest) {
  const Contact answer = contact(c, threshold, nullptr, range);
  ASSERT_EQ(answer.points().empty(), answer.signed_distance > threshold);
  if (answer.points().empty()) return;
  expect_depths(c, answer, threshold);
  // As in points_on_both_test.hpp, of the room that the threshold leaves. Balls of a capsule that
  // leans lie below its surface.
  const double size = larger_size(c);
  const double room = std::min(1e-3 * size, threshold - answer.signed_distance);
  const double slant = std::holds_alternative<Capsule>(c.b) ? 5e-5 * size : 50 * room * room / size;
  for (const ContactPoint& p : answer.points()) {
    EXPECT_NEAR(outside(c.a, c.pose_a, p.position - p.depth / 2 * answer.normal), 0, aside + slant);
    EXPECT_NEAR(outside(c.b, c.pose_b, p.position + p.depth / 2 * answer.normal), 0, aside + slant);
  }
}

/// How far off their surfaces points of a pose class may lie, in parts of the larger size. Where
/// rims meet at a small tilt, rounding of the normal over the tilt says where on the rim.
double aside_of(const std::string& pose_class) {
  return pose_class.find("+tilted") != pose_class.npos ? 1e-6 : 3e-8;
}

class PointContract : public testing::TestWithParam<Pair> {};

TEST_P(PointContract, HoldsInEveryPoseClassAtEveryThreshold) {
  Random random(1);
  for (const auto& name : pose_classes(GetParam())) {
    for (std::uint64_t i = 0; i < contacts_per_class(); ++i) {
      const Identity id{GetParam(), name, 13, i};
      const Configuration c = make_configuration(id);
      const double distance = signed_distance(c).value, size = smaller_size(c);
      const auto hair = [&] { return size * random.power_of_ten(-17, 0); };
      SCOPED_TRACE(to_string(id));
      for (const double threshold :
           {0.0, 1e-6 * size, distance, distance / 2, distance + hair(), random.sign() * hair()}) {
        SCOPED_TRACE(threshold);
        expect_contract(c, threshold, aside_of(name) * larger_size(c) + position_rounding(c));
        if (HasFatalFailure()) return;
      }
    }
  }
}

class PointContractOfHulls : public testing::TestWithParam<HullKind> {};

TEST_P(PointContractOfHulls, HoldsAtEveryThreshold) {
  Random random(1);
  for (std::uint64_t i = 0; i < contacts_per_class(); ++i) {
    SCOPED_TRACE(i);
    Configuration c = with_hull(GetParam(), random);
    if (random.toss()) c = moved_to_depth(c, random.power_of_ten(-12, -1) * smaller_size(c));
    const double distance = signed_distance(c).value, size = smaller_size(c);
    const auto hair = [&] { return size * random.power_of_ten(-17, 0); };
    for (const double threshold :
         {0.0, 1e-6 * size, distance, distance / 2, distance + hair(), random.sign() * hair()}) {
      SCOPED_TRACE(threshold);
      expect_contract(c, threshold, 1e-6 * larger_size(c) + position_rounding(c));
      if (HasFatalFailure()) return;
    }
  }
}
TEST_P(PointContractOfHulls, HoldsWithAnyPreviousNormalToWithinTheThreshold) {
  Random random(2);
  for (std::uint64_t i = 0; i < contacts_per_class(); ++i) {
    SCOPED_TRACE(i);
    const Configuration c = with_hull(GetParam(), random);
    const SignedDistance plain = signed_distance(c);
    const double size = smaller_size(c);
    const Vec3 any = random.direction();
    for (const Vec3& previous : {any, Vec3(-plain.normal), plain.normal}) {
      for (const double threshold :
           {0.0, 5e-5 * size, plain.value + 1e-3 * size, 10 * larger_size(c)}) {
        SCOPED_TRACE(threshold);
        const Contact answer = contact(c, threshold, &previous);
        if (answer.points().empty()) continue;
        EXPECT_GE(answer.signed_distance,
                  plain.value - std::max(threshold, 0.0) - 1e-13 * scale_of(c));
        expect_depths(c, answer, threshold);
        const double off = 1e-5 * larger_size(c) + position_rounding(c) + std::max(0.0, threshold);
        for (const ContactPoint& p : answer.points()) {
          const Vec3 half = p.depth / 2 * answer.normal;
          EXPECT_LE(outside(c.a, c.pose_a, p.position - half), off);
          EXPECT_LE(outside(c.b, c.pose_b, p.position + half), off);
        }
        if (HasFailure()) return;
      }
    }
  }
}

TEST_P(PointContractOfHulls, HoldsOfAllPointsWithinTheThreshold) {
  constexpr double leans_most = 0.1;
  Random random(3);
  for (std::uint64_t i = 0; i < contacts_per_class(); ++i) {
    SCOPED_TRACE(i);
    Configuration c = with_hull(GetParam(), random);
    if (random.toss()) c = moved_to_depth(c, random.power_of_ten(-12, -1) * smaller_size(c));
    const double distance = signed_distance(c).value, size = smaller_size(c);
    for (const double threshold : {0.0, 0.02 * size, distance + 0.1 * size}) {
      SCOPED_TRACE(threshold);
      expect_contract(c, threshold, leans_most * leans_most / 2 * larger_size(c),
                      PointRange::within_threshold);
      if (HasFatalFailure()) return;
    }
  }
}

// Of hulls a unit in the last place off a lattice, faces may be so thin that no normal of theirs
// tells where the hull is.
TEST_P(PointContractOfHulls, NothingOfAHullLiesOutsideOfIt) {
  Random random(4);
  for (std::uint64_t i = 0; i < 10 * contacts_per_class(); ++i) {
    SCOPED_TRACE(i);
    std::vector<Vec3> points = hull_points(GetParam(), random);
    const Convex hull = oracle::convex_hull(points);
    for (const Vec3& p : points) ASSERT_LE(outside(hull, p), 1e-15 * p.norm());
  }
}

std::string hull_name(const testing::TestParamInfo<HullKind>& kind) {
  return hull_kind_names[static_cast<int>(kind.param)];
}
INSTANTIATE_TEST_SUITE_P(, PointContractOfHulls, testing::ValuesIn(hull_kinds), hull_name);

// Along a previous normal that only ties, features need not reach each other: points then lie on
// the bodies to within the threshold, or the bodies part along their best normal.
class PointContractOfHints : public testing::TestWithParam<Pair> {};

TEST_P(PointContractOfHints, HoldsWithAnyPreviousNormalToWithinTheThreshold) {
  Random random(2);
  const std::uint64_t count = of_each_class(GetParam(), contacts_per_class());
  for (const auto& name : pose_classes(GetParam())) {
    for (std::uint64_t i = 0; i < count; ++i) {
      const Identity id{GetParam(), name, 15, i};
      const Configuration c = make_configuration(id);
      const SignedDistance plain = signed_distance(c);
      const double distance = plain.value, size = smaller_size(c);
      SCOPED_TRACE(to_string(id));
      const Vec3 any = random.direction();
      for (const Vec3& previous : {any, Vec3(-plain.normal)}) {
        for (const double threshold :
             {0.0, 5e-5 * size, distance + 1e-3 * size, distance + size, 10 * larger_size(c)}) {
          SCOPED_TRACE(threshold);
          const Contact answer = contact(c, threshold, &previous);
          if (answer.points().empty()) continue;
          expect_depths(c, answer, threshold);
          const double off = (aside_of(name) + 5e-5) * larger_size(c) + position_rounding(c) +
                             std::max(0.0, threshold);
          for (const ContactPoint& p : answer.points()) {
            const Vec3 half = p.depth / 2 * answer.normal;
            EXPECT_LE(outside(c.a, c.pose_a, p.position - half), off);
            EXPECT_LE(outside(c.b, c.pose_b, p.position + half), off);
          }
          if (HasFailure()) return;
        }
      }
    }
  }
}

// The corner of a plate's face, which leans, is on the cap's rim but for rounding.
TEST(PointsWhereACornerTouchesARim, LieOnBothBodies) {
  const Configuration c = make_configuration(
      parse_identity("cylinder-box/vertex-rim+touching+plate+not-quite-unit/13/2486"));
  expect_contract(c, 1e-6 * smaller_size(c), 3e-8 * larger_size(c));
}

// The cap of a needle that leans by 0.09 over a larger cap's rim is seen from it as an ellipse, of
// which the circle within does not reach as far as the rims do.
TEST(PointsWhereRimsTouch, LieOnBothBodies) {
  for (const char* identity : {"cylinder-cylinder/general+needle/21/800",
                               "cylinder-cylinder/rim-rim+shallow+needle+huge/21/22207"}) {
    SCOPED_TRACE(identity);
    const Configuration c = make_configuration(parse_identity(identity));
    expect_contract(c, 0, 3e-8 * larger_size(c));
  }
}

// An edge in two pieces, in line but for the least double, of which the side crosses one: the other
// one ends beside A, where A's surface has fallen off.
TEST(PointsWhereAnEdgeIsInPieces, LieOnBothBodies) {
  constexpr double least = std::numeric_limits<double>::denorm_min();
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    SCOPED_TRACE(i);
    const double end = random.uniform(-0.5, 0.5), turn = random.uniform(0.2, 1.5);
    const Convex roof = oracle::convex_hull(
        {Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3(end, 0, least), Vec3(0, 1, -1), Vec3(0, -1, -1)});
    const Cylinder a(random.uniform(0.2, 1), 1);
    const double aside = random.power_of_ten(-3, -1) * random.sign(), depth = 0.1 * a.radius();
    const Vec3 axis(std::cos(turn), std::sin(turn), 0);
    const Configuration c{
        a, Pose(Vec3(end + aside, 0, a.radius() - depth), turn_between(Vec3::UnitZ(), axis)), roof,
        Pose()};
    expect_contract(c, 0, 3e-8 * larger_size(c));
    if (HasFailure()) return;
  }
}

// A side that crosses an edge next to which a face leans by less than would be seen, but by more
// than the overlap leaves: the bodies are deepest where side and edge cross, and nowhere else.
TEST(PointsWhereASideCrossesAnEdge, LieOnBothBodies) {
  Random random(1);
  const auto between = [&](double lo, double hi) {
    return random.power_of_ten(std::log10(lo), std::log10(hi));
  };
  for (int i = 0; i < 100000; ++i) {
    const Cylinder a(between(1e-4, 0.3), between(0.3, 1));
    const Box b({between(0.3, 1), between(1e-4, 0.3), between(1e-4, 0.3)});
    const double lean = between(1e-7, 1e-3), turn = between(1e-6, 0.1);
    const Quaternion crossing = Quaternion(1, lean, turn, random.uniform(-1, 1)).normalized();
    Vec3 place(random.uniform(-1, 1), random.uniform(-1, 1) / 10, 1);
    const auto posed = [&] {
      return Configuration{a, Pose(place, crossing * along_y.normalized()), b, Pose()};
    };
    const double depth = between(1e-9, 1e-5);
    for (int k = 0; k < 3; ++k) place.z() -= signed_distance(posed()).value + depth;
    SCOPED_TRACE(i);
    expect_contract(posed(), 0, 3e-8 * larger_size(posed()));
    if (HasFailure()) return;
  }
}

// For engines: features that lean by up to 0.1 have all their points, off round surfaces by half
// its square.
TEST_P(PointContract, LiesOnBothBodiesInEveryPoseClass) {
  for (const auto& name : pose_classes(GetParam())) {
    for (std::uint64_t i = 0; i < 10; ++i) {
      const Identity id{GetParam(), name, 11, i};
      const Configuration c = make_configuration(id);
      const Contact answer = contact(c, 0);
      SCOPED_TRACE(to_string(id));
      ASSERT_EQ(answer.points().empty(), answer.signed_distance > 0);
      expect_points_on_both(c, answer, aside_of(name) * larger_size(c) + position_rounding(c));
    }
  }
}

TEST_P(PointContract, HoldsOfAllPointsWithinTheThreshold) {
  constexpr double leans_most = 0.1;
  for (const auto& name : pose_classes(GetParam())) {
    for (std::uint64_t i = 0; i < contacts_per_class(); ++i) {
      const Identity id{GetParam(), name, 14, i};
      const Configuration c = make_configuration(id);
      const double distance = signed_distance(c).value, size = smaller_size(c);
      SCOPED_TRACE(to_string(id));
      for (const double threshold : {0.0, 0.02 * size, distance + 0.1 * size}) {
        SCOPED_TRACE(threshold);
        expect_contract(c, threshold, leans_most * leans_most / 2 * larger_size(c),
                        PointRange::within_threshold);
        if (HasFatalFailure()) return;
      }
    }
  }
}

TEST(PointsWithinTheThreshold, HoldARockingCoinAtBothEdges) {
  // Its lower edge is 12 mm in the floor, its upper one, 2 × 0.1 m × 0.04 higher, 4 mm.
  const Quaternion leaning(Eigen::AngleAxisd(0.04, Vec3::UnitX()));
  const double lowest = 0.1 * std::sin(0.04) + 0.01 * std::cos(0.04);
  const Configuration on_box{Cylinder(0.1, 0.01), Pose({0, 0, lowest - 0.012}, leaning),
                             Box({1, 1, 1}), Pose(Vec3(0, 0, -1))};
  const Configuration on_plane{on_box.a, on_box.pose_a, Plane(Vec3::UnitZ(), 0), Pose()};
  for (const Configuration& c : {on_box, on_plane}) {
    EXPECT_EQ(contact(c, 0).points().size(), 1u);
    double lower = 0, upper = 0;
    const Contact all = contact(c, 0, nullptr, PointRange::within_threshold);
    for (const ContactPoint& p : all.points()) {
      lower = std::min(lower, p.position.y()), upper = std::max(upper, p.position.y());
    }
    EXPECT_NEAR(lower, -0.1, 1e-3);
    EXPECT_GT(upper, 0.04);
  }
}

// Without a hint hulls have tests of their own, above: of fourteen poses in 20,328 of their
// classes, twelve of them a million metres away, a point lies off a surface by 1e-6 to 0.3.
INSTANTIATE_TEST_SUITE_P(, PointContract, testing::ValuesIn(all_pairs), name_of_other);
INSTANTIATE_TEST_SUITE_P(, PointContractOfHints, testing::ValuesIn(all_pairs), name_of_other);

// Configurations that were found to break it once.
TEST(PointContractOfTheHostile, HoldsAtEveryThreshold) {
  for (const auto& [name, c] : critical_poses("points")) {
    SCOPED_TRACE(name);
    const double distance = signed_distance(c).value, size = smaller_size(c);
    for (const double part : {0.0, 0.5, 1 - 1e-6, 1 - 1e-12, 1.0}) {
      SCOPED_TRACE(part);
      expect_contract(c, part * distance, 1e-6 * larger_size(c));
    }
    for (const double threshold : {1e-6 * size, 1e-6, 1e-3, 0.1 * size, 0.1, 600.0}) {
      SCOPED_TRACE(threshold);
      expect_contract(c, threshold, 1e-6 * larger_size(c));
    }
  }
}

// Beside the ends that keep a body from turning there is the place where the bodies are deepest.
TEST(PointContractOfTheHostile, SidesThatCrossByAHairHaveThreePoints) {
  const Eigen::Quaterniond turned(Eigen::AngleAxisd(0.01, Vec3::UnitZ()));
  const Configuration c{Cylinder(1, 2), Pose({0, 0, 1.999}, turned * along_x), Cylinder(1, 2),
                        Pose({0, 0, 0}, along_x)};
  const Contact answer = contact(c, 0);
  ASSERT_EQ(answer.points().size(), 3u);
  EXPECT_NEAR(answer.points()[2].depth, 0.001, 1e-15);
  EXPECT_NEAR(answer.points()[2].position.x(), 0, 1e-9);
  for (const int end : {0, 1}) {
    // The lines' ends are 2 · 0.01 apart, which takes y²/2R of R = 2.
    EXPECT_NEAR(answer.points()[end].depth, 0.001 - 0.02 * 0.02 / 4, 1e-8);
    EXPECT_NEAR(std::abs(answer.points()[end].position.x()), 2, 1e-3);
  }
}

TEST(PreviousNormal, MayHaveAnyLengthAndMayBeNone) {
  const Configuration c{Cylinder(1, 1), Pose({0.1, 0, 1.9}, Eigen::Quaterniond(1, 0, 0, 0)),
                        Cylinder(1, 1), Pose()};
  const double infinity = std::numeric_limits<double>::infinity();
  const Vec3 oblique(0.48, 0.36, 0.8);
  for (const double length : {0.0, 1e-300, 0.9, 1.1, 1e300, infinity}) {
    const Vec3 previous = length * oblique;
    const Contact answer = contact(c, 10, &previous);
    EXPECT_NEAR(answer.normal.norm(), 1, 4e-15) << length;
    EXPECT_FALSE(answer.points().empty()) << length;
  }
}

}  // namespace
}  // namespace touchstone
