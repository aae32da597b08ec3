#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "oracle/audit/certain_bounds.hpp"
#include "oracle/audit/certificate.hpp"
#include "oracle/audit/enclose.hpp"
#include "oracle/audit/pair_search.hpp"
#include "oracle/hull.hpp"
#include "properties/moves.hpp"
#include "reference/support.hpp"

namespace touchstone::audit {
namespace {

class RandomBodies : public testing::Test {
 protected:
  double uniform(double lo, double hi) {
    return std::uniform_real_distribution<double>(lo, hi)(random_);
  }
  Vec3 vector(double limit) {
    return {uniform(-limit, limit), uniform(-limit, limit), uniform(-limit, limit)};
  }
  Pose pose() {
    return Pose(vector(0.3), {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)});
  }
  double size() { return uniform(0.2, 1); }
  Shape other() {
    switch (random_() % 6) {
      case 0:
        return Sphere(size());
      case 4:
        return hull(8);
      case 5:
        return hull(3);
      case 1:
        return Capsule(size(), size());
      case 2:
        return Cylinder(size(), size());
      default:
        return Box({size(), size(), size()});
    }
  }
  /// About its frame's origin, which deep bodies share with the cylinder.
  Convex hull(int points) {
    const CGAL::Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST);
    std::vector<Vec3> vertices;
    for (int i = 0; i < points; ++i) vertices.push_back(vector(0.6));
    return oracle::convex_hull(vertices);
  }
  Configuration configuration() { return {Cylinder(size(), size()), pose(), other(), pose()}; }
  DirectionCell<double> cell() {
    auto c = DirectionCell<double>::whole_face(static_cast<int>(random_() % 6));
    for (auto depth = random_() % 6; depth > 0; --depth) {
      c = c.child(static_cast<int>(random_() % 4));
    }
    return c;
  }

  const CGAL::Protect_FPU_rounding<true> outward_;
  std::mt19937_64 random_{20261121};
};

// Error of the program's value after some dozens of updates of its inverse: at most the tolerance
// to which it is solved.
constexpr double program_rounding = 1e-9;
constexpr double rounding = 1e-14;  // of the reference's gap in double, bodies of about a metre

TEST_F(RandomBodies, GapIsEnclosedFromBelowAndTightly) {
  for (int i = 0; i < 1000; ++i) {
    const Configuration c = configuration();
    const Vec3 n = vector(1);
    const double lo = gap_below(make_bodies<Interval>(c, 1), n);
    EXPECT_NEAR(lo, gap(c, n.normalized()), rounding);
  }
}

TEST_F(RandomBodies, SupportPairsDecideTheGap) {
  for (int i = 0; i < 1000; ++i) {
    const Configuration c = configuration();
    const auto bodies = make_bodies<double>(c, 1);
    const Vec3 n = vector(1).normalized();
    EXPECT_NEAR(difference(bodies, support_pair(bodies, n)).dot(n), gap(c, n), rounding);
  }
}

TEST_F(RandomBodies, PointsPulledInsideAreCertainlyInside) {
  for (int i = 0; i < 1000; ++i) {
    const Configuration c = configuration();
    const auto certain = make_bodies<Interval>(c, 1);
    const auto search = make_bodies<double>(c, 1);
    const auto pair = pulled_inside(search, support_pair(search, vector(1)));
    EXPECT_TRUE(certainly_contain(certain, pair));
    EXPECT_FALSE(certainly_contains(certain.a, Vec3(1.001 * pair.a)));
  }
}

TEST_F(RandomBodies, NoDirectionOfACellBeatsItsBound) {
  int bounded = 0;
  for (int i = 0; i < 1000; ++i) {
    const Configuration c = configuration();
    const auto certain = make_bodies<Interval>(c, 1);
    const auto search = make_bodies<double>(c, 1);
    const auto k = cell();
    CellProgram<double> program(search, k, some_pair(search));
    program.run(-1e9, 1e-9, 100);
    const auto pair = pulled_inside(search, program.pair());
    ASSERT_TRUE(certainly_contain(certain, pair));
    const double bound = corner_bound_above(certain, pair, k);
    EXPECT_NEAR(bound, program.value(), program_rounding);
    if (!(bound < 0)) continue;
    ++bounded;
    for (int j = 0; j < 20; ++j) {
      const Vec3 n = k.at(k.u + uniform(0, 1) * k.size, k.v + uniform(0, 1) * k.size);
      EXPECT_LE(gap(c, n.normalized()), bound + rounding);
    }
  }
  EXPECT_GT(bounded, 500);
}

TEST_F(RandomBodies, TheProgramFindsTheLargestGapOfTheCornersHull) {
  for (int i = 0; i < 300; ++i) {
    const Configuration c = configuration();
    const auto search = make_bodies<double>(c, 1);
    const auto k = cell();
    CellProgram<double> program(search, k, some_pair(search));
    program.run(-1e9, 1e-12, 200);
    double best = -1e9;
    for (int j = 0; j < 2000; ++j) {
      double weights[4], sum = 0;
      for (double& w : weights) sum += w = -std::log(uniform(1e-9, 1));
      Vec3 x = Vec3::Zero();
      for (int m = 0; m < 4; ++m) x += weights[m] / sum * k.corners()[m].normalized();
      best = std::max(best, gap_times_length(search, x));
    }
    EXPECT_GE(program.value(), best - program_rounding);
    EXPECT_LE(program.value(), best + 0.05);  // as coarse as the samples
  }
}

TEST(DirectionCell, ChildrenTileTheirParent) {
  const auto parent = DirectionCell<double>::whole_face(3).child(2);
  double area = 0;
  for (int quarter = 0; quarter < 4; ++quarter) {
    const auto child = parent.child(quarter);
    EXPECT_EQ(child.face, 3);
    EXPECT_EQ(child.level, 2);
    EXPECT_GE(child.u, parent.u);
    EXPECT_LE(child.u + child.size, parent.u + parent.size);
    area += child.size * child.size;
  }
  EXPECT_EQ(area, parent.size * parent.size);
}

TEST(CertainlyContains, RefusesWhatIsNoPoint) {
  const auto bodies = make_bodies<Interval>({Cylinder(1, 1), Pose(), Sphere(1), Pose()}, 1);
  const double nan = std::nan("");
  EXPECT_FALSE(certainly_contains(bodies.a, Vec3(nan, 0, 0)));
  EXPECT_FALSE(certainly_contains(bodies.b, Vec3(0, HUGE_VAL, 0)));
}

TEST(CertainlyContains, KnowsTheEndsOfACapsuleFromThoseOfACylinder) {
  const Pose here;
  const auto capsule = make_bodies<Interval>({Cylinder(1, 1), here, Capsule(1, 1), here}, 1);
  EXPECT_FALSE(certainly_contains(capsule.a, Vec3(0, 0, 1.5)));
  EXPECT_TRUE(certainly_contains(capsule.b, Vec3(0, 0, 1.5)));
  EXPECT_FALSE(certainly_contains(capsule.b, Vec3(0.9, 0, 1.5)));
}

using Quaternion = Eigen::Quaterniond;

TEST(Enclose, MoreCellsNeverWiden) {
  const Configuration c{Cylinder(0.3, 0.7), Pose({0.1, 0.05, 0.1}, Quaternion(3, 1, 2, 1)),
                        Cylinder(0.4, 0.2), Pose()};
  double width = HUGE_VAL;
  for (const int cells : {0, 10, 50, 200}) {
    const Enclosure e = enclose(c, {1e-12, cells});
    EXPECT_LE(e.hi - e.lo, width) << cells;
    width = e.hi - e.lo;
  }
}

TEST(Enclose, SeparatedBodiesNeedNoCell) {
  const Configuration c{Cylinder(0.3, 0.7), Pose({1.5, 0.25, 0.1}, Quaternion(3, 1, 2, 1)),
                        Box({0.4, 0.2, 0.3}), Pose()};
  const Enclosure e = enclose(c);
  EXPECT_EQ(e.cells, 0);
  EXPECT_EQ(e.hi, e.pair_distance);
  EXPECT_LE(e.pair_distance - e.lo, 1e-12);
}

TEST(Enclose, OverlappingBodiesShareAPoint) {
  const Configuration c{Cylinder(1, 1), Pose(), Sphere(1), Pose({0.5, 0.25, 0.1}, upright)};
  const Enclosure e = enclose(c);
  EXPECT_LE(e.pair_distance, 1e-12);
  EXPECT_LT(e.hi, 0);
}

TEST(Enclose, ATriangleInACylinderIsAsDeepAsThatIsWideAcrossIt) {
  // Flat, so that its own width is none: the nearer cap is half a metre away.
  const Convex triangle = oracle::convex_hull(std::vector<Vec3>{{1, 0, 0}, {0, 1, 0}, {-1, -1, 0}});
  const Enclosure e = enclose({Cylinder(4, 1), Pose({0, 0, 0.5}, upright), triangle, Pose()});
  EXPECT_LE(e.lo, -0.5);
  EXPECT_GE(e.hi, -0.5);
  EXPECT_LE(e.hi - e.lo, 1e-8);
}

TEST(Enclose, AHullFarFromItsPositionIsAsOneThatIsAboutIt) {
  const std::vector<Vec3> points{{1, 0, 0}, {0, 1, 0}, {-1, -1, 0}, {0, 0, 1.5}};
  for (const double far : {0.0, 1e6}) {
    const Vec3 by(far, -far, 0);
    std::vector<Vec3> moved = points;
    for (Vec3& p : moved) p += by;
    const Enclosure e = enclose({Cylinder(0.5, 1), Pose({0, 0, 0.5}, upright),
                                 oracle::convex_hull(moved), Pose(-by, upright)});
    EXPECT_LT(e.hi, -0.4);
    EXPECT_LE(e.hi - e.lo, 2e-9);
  }
}

TEST(Enclose, PowerOfTwoScalingScalesTheEnclosureExactly) {
  const double s = std::ldexp(1, -40);
  const Quaternion tilt(3, 1, 2, 1);
  const Enclosure one =
      enclose({Cylinder(0.3, 0.7), Pose({0.25, 0.25, 0.1}, tilt), Cylinder(0.4, 0.2), Pose()});
  const Enclosure small =
      enclose({Cylinder(0.3 * s, 0.7 * s), Pose(s * Vec3(0.25, 0.25, 0.1), tilt),
               Cylinder(0.4 * s, 0.2 * s), Pose()});
  EXPECT_EQ(one.lo * s, small.lo);
  EXPECT_EQ(one.hi * s, small.hi);
}

// The claims of certificates, besides the closed forms that all oracles prove
// (closed_forms_test.cpp); oracle/check_certificate.py checks their proofs
// (reports/second_oracle_test.cpp).

using Quaternion = Eigen::Quaterniond;

const Quaternion tilt(3, 1, 2, 1);

const Configuration overlapping{Cylinder(0.3, 0.7), Pose({0.25, 0.25, 0.1}, tilt),
                                Cylinder(0.4, 0.2), Pose()};

TEST(Certificate, OverlapNeedsCellsAllOverTheCube) {
  const Certificate proof = certify(overlapping, {1e-30, 4000});
  EXPECT_FALSE(proof.pair);
  double faces = 0;
  for (const auto& cell : proof.cells) {
    faces += std::pow(0.25, static_cast<double>(cell.path.size()) - 1);
  }
  EXPECT_NEAR(faces, 6, 1e-12);
}

TEST(Certificate, WidthIsKeptDownToTenToTheMinusSixty) {
  const Certificate coarse = certify(overlapping, {1e-20, 4000});
  const Certificate fine = certify(overlapping, {1e-60, 4000});
  EXPECT_LE(fine.hi - fine.lo, mpq_class(1e-60));
  EXPECT_LE(coarse.lo, fine.hi);
  EXPECT_GE(coarse.hi, fine.lo);
}

TEST(Certificate, OfAHullGivesItsPointsByVerticesAlone) {
  const std::vector<Vec3> points{{1, 0, 0}, {-0.5, 0.75, 0}, {-0.5, -1, 0}, {0, 0.125, 1.5}};
  const Convex hull = oracle::convex_hull(points);
  for (const double height : {0.0, 3.0}) {
    const Configuration c{Cylinder(0.3, 0.7), Pose({0.25, 0.25, height}, tilt), hull, Pose()};
    const Certificate proof = certify(c, {1e-30, 4000});
    EXPECT_LE(proof.hi - proof.lo, mpq_class(1e-30));
    EXPECT_EQ(proof.pair.has_value(), height > 0);
    std::vector<RationalPair> pairs;
    if (proof.pair) pairs.push_back(*proof.pair);
    for (const auto& cell : proof.cells) pairs.push_back(cell.pair);
    for (const RationalPair& pair : pairs) {
      ASSERT_FALSE(pair.weights.empty());
      for (const auto& [vertex, weight] : pair.weights) {
        EXPECT_GE(vertex, 0);
        EXPECT_LT(vertex, 4);
        EXPECT_GT(weight, 0);
      }
    }
  }
}

TEST(Certificate, OfBodiesWhoseDistanceHasMoreBitsThanTheSearch) {
  for (int i = 1; i <= 8; ++i) {
    const double x = std::ldexp(1, 600), y = i * x;
    const Configuration c{Cylinder(0.3, 0.7), Pose({x, y, 0.1}, tilt), Sphere(1), Pose()};
    const Certificate proof = certify(c, {1e-30, 4000});
    EXPECT_NEAR(proof.lo.get_d() / x, std::hypot(1, i), 1e-14);
    EXPECT_GE(proof.hi, proof.lo);
    EXPECT_LE(proof.hi - proof.lo, mpq_class(x) * mpq_class(1e-98));
  }
}

}  // namespace
}  // namespace touchstone::audit
