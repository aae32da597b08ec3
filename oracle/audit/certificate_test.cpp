// The claims of certificates, besides the closed forms that all oracles prove
// (closed_forms_test.cpp); oracle/check_certificate.py checks their proofs
// (reports/second_oracle_test.cpp).
#include "oracle/audit/certificate.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "oracle/hull.hpp"
#include "properties/moves.hpp"

namespace touchstone::audit {
namespace {

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
