// The claims of certificates; oracle/check_certificate.py checks their proofs
// (reports/second_oracle_test.cpp).
#include "oracle/audit/certificate.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "properties/moves.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone::audit {
namespace {

using Quaternion = Eigen::Quaterniond;

const Quaternion tilt(3, 1, 2, 1);

const Configuration overlapping{Cylinder(0.3, 0.7), Pose({0.25, 0.25, 0.1}, tilt),
                                Cylinder(0.4, 0.2), Pose()};

void expect_proof(const Configuration& c, double width, const mpq_class& exact) {
  const Certificate proof = certify(c, {width, 4000});
  EXPECT_LE(proof.lo, exact);
  EXPECT_GE(proof.hi, exact);
  EXPECT_LE(proof.hi - proof.lo, mpq_class(width) * mpq_class(larger_size(c)));
}

TEST(Certificate, BodiesApartNeedOnePair) {
  // 3-4-5 from the rim point (1, 0, 1) to the sphere's centre, less its radius.
  const Configuration c{Cylinder(1, 1), Pose(), Sphere(2), Pose({4, 0, 5}, upright)};
  expect_proof(c, 1e-30, 3);
  const Certificate proof = certify(c, {1e-30, 4000});
  EXPECT_TRUE(proof.pair);
  EXPECT_TRUE(proof.cells.empty());
}

TEST(Certificate, OverlapNeedsCellsAllOverTheCube) {
  const Certificate proof = certify(overlapping, {1e-30, 4000});
  EXPECT_FALSE(proof.pair);
  double faces = 0;
  for (const auto& cell : proof.cells) {
    faces += std::pow(0.25, static_cast<double>(cell.path.size()) - 1);
  }
  EXPECT_NEAR(faces, 6, 1e-12);
}

TEST(Certificate, SphereBelowACapIsAsDeepAsTheCapSays) {
  expect_proof({Cylinder(2, 1), Pose(), Sphere(0.5), Pose({0.5, 0, 0.75}, upright)}, 1e-30,
               mpq_class(-3, 4));
}

TEST(Certificate, TiltedCylinderOverPlaneHasTheRimsHeight) {
  // Tilted by arctan(24/7): height 3 − 2·7/25 − 1·24/25.
  const Configuration c{Cylinder(1, 2), Pose({0, 0, 3}, Quaternion(4, 0, 3, 0)),
                        Plane({0, 0, 2}, 0), Pose()};
  expect_proof(c, 1e-30, mpq_class(37, 25));
  expect_proof(c, 1e-60, mpq_class(37, 25));
}

TEST(Certificate, TouchingIsZeroToTheWidthAskedFor) {
  expect_proof({Cylinder(1, 1), Pose({0.25, 0, 2}, upright), Box({2, 2, 1}), Pose()}, 1e-60, 0);
}

TEST(Certificate, WidthIsKeptDownToTenToTheMinusSixty) {
  const Certificate coarse = certify(overlapping, {1e-20, 4000});
  const Certificate fine = certify(overlapping, {1e-60, 4000});
  EXPECT_LE(fine.hi - fine.lo, mpq_class(1e-60));
  EXPECT_LE(coarse.lo, fine.hi);
  EXPECT_GE(coarse.hi, fine.lo);
}

TEST(Certificate, AFamilyOfOptimalNormalsIsProvenToTheWidthReached) {
  const Configuration c{Cylinder(1, 8), Pose(), Sphere(0.5), Pose({0, 0, 1}, upright)};
  const Certificate proof = certify(c, {1e-30, 1000});
  EXPECT_LE(proof.lo, mpq_class(-3, 2));
  EXPECT_GE(proof.hi, mpq_class(-3, 2));
  EXPECT_LE(proof.hi - proof.lo, mpq_class(1, 100));
  EXPECT_LE(proof.cells.size(), 1000u);
}

TEST(Certificate, SurvivesTheEndsOfTheDoubleRange) {
  const Configuration c{
      Cylinder(1e-300, 1e300), Pose({1e308, 0, 0}, Quaternion(1e-300, 1e300, 1, 0)),
      Box({5e-324, 1, 1e300}), Pose({-1e308, 1e-308, 0}, Quaternion(1, 1e-160, 0, 0))};
  const Certificate proof = certify(c, {1e-30, 4000});
  EXPECT_GT(proof.lo, mpq_class(1e308));
  EXPECT_GE(proof.hi, proof.lo);
}

TEST(Certificate, OfAPlaneFarFromItsOrigin) {
  const Configuration c{Cylinder(1, 1), Pose({0, 0, 1e300}, upright), Plane({0, 0, 1e-5}, 1e295),
                        Pose()};
  const Certificate proof = certify(c, {1e-30, 4000});
  const mpq_class exact = mpq_class(1e300) - 1 - mpq_class(1e295) / mpq_class(1e-5);
  EXPECT_LE(proof.lo, exact);
  EXPECT_GE(proof.hi, exact);
}

TEST(Certificate, OfAPlaneBeyondAllDoubles) {
  const double length = 5e-324;
  const Configuration c{Cylinder(1, 2), Pose({0, 0, -7}, upright), Plane({0, 0, -length}, 0.5),
                        Pose()};
  const Certificate proof = certify(c, {1e-30, 4000});
  const mpq_class exact = 7 - 2 - mpq_class(0.5) / mpq_class(length);
  EXPECT_LE(proof.lo, exact);
  EXPECT_GE(proof.hi, exact);
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

TEST(Certificate, OfACapsuleLongerThanAllDoubles) {
  const double radius = 1.7e308, distance = 1.75e308;
  const Configuration c{Cylinder(1, 1), Pose({distance, 0, 0}, upright), Capsule(radius, radius),
                        Pose()};
  const Certificate proof = certify(c, {1e-30, 4000});
  const mpq_class exact = mpq_class(distance) - mpq_class(radius) - 1;
  EXPECT_LE(proof.lo, exact);
  EXPECT_GE(proof.hi, exact);
}

TEST(Certificate, RefusesAWidthThatIsNone) {
  EXPECT_THROW(certify(overlapping, {0, 100}), InvalidInput);
  EXPECT_THROW(certify(overlapping, {HUGE_VAL, 100}), InvalidInput);
}

}  // namespace
}  // namespace touchstone::audit
