#include "properties/given_orientation.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

#include "reference/error_of_test.hpp"
#include "reference/invalid_input.hpp"
#include "reference/pose.hpp"

namespace touchstone {
namespace {

using testing::HasSubstr;

/// Some roundings of numbers up to 1.
constexpr double some_roundings = 8 * 0x1p-53;

Eigen::Matrix3d matrix_of(const Eigen::Quaterniond& q) { return Pose(Vec3::Zero(), q).rotation(); }

Eigen::Quaterniond any_turn(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const double w = normal(random), x = normal(random), y = normal(random), z = normal(random);
  return Eigen::Quaterniond(w, x, y, z).normalized();
}

/// Equal as turns: q and −q are one.
double angle_between(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  return 2 * std::asin((a.normalized() * b.normalized().conjugate()).vec().norm());
}

TEST(RotationMatrix, IsGivenBackByItsQuaternion) {
  std::mt19937 random(1);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Quaterniond q = any_turn(random);
    EXPECT_LT(angle_between(orientation_of(matrix_of(q)), q), some_roundings) << q;
  }
}

// All 24 turns of a cube, whose axes stay exactly parallel and perpendicular.
TEST(RotationMatrix, OfTurnsByRightAnglesIsExact) {
  int turns = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      for (const double sign_i : {1, -1}) {
        for (const double sign_j : {1, -1}) {
          if (i == j) continue;
          Eigen::Matrix3d m;
          m.col(0) = sign_i * Vec3::Unit(i);
          m.col(1) = sign_j * Vec3::Unit(j);
          m.col(2) = m.col(0).cross(m.col(1));
          const Eigen::Quaterniond q = orientation_of(m);
          EXPECT_EQ(matrix_of(q), m) << q;
          for (const double x : q.coeffs()) EXPECT_TRUE(x == 0 || std::abs(x) == 1) << q;
          ++turns;
        }
      }
    }
  }
  EXPECT_EQ(turns, 24);
}

// Of a matrix that is off by e the nearest rotation is off by at most that, and what stretches or
// shears it alone, which no rotation does, changes nothing: a Newton step leaves e².
TEST(RotationMatrix, ThatIsNearlyOneIsReadAsTheNearest) {
  std::mt19937 random(2);
  const Eigen::Matrix3d shear = (Eigen::Matrix3d() << 3, 1, -2, 1, -4, 2, -2, 2, 1).finished();
  for (int i = 0; i < 100; ++i) {
    const Eigen::Quaterniond q = any_turn(random);
    const Eigen::Matrix3d m = matrix_of(q) * (Eigen::Matrix3d::Identity() + 1e-10 * shear);
    EXPECT_LT(angle_between(orientation_of(m), q), some_roundings) << q;
  }
}

std::string refusal_of(const Eigen::Matrix3d& m) {
  return error_text_of([&] { orientation_of(m); });
}

TEST(RotationMatrix, ThatIsNoneIsRefusedWithTheReason) {
  Eigen::Matrix3d m = Eigen::Matrix3d::Identity();
  EXPECT_EQ(refusal_of(m), "accepted");
  m(1, 1) = 1 + 2e-9;
  EXPECT_THAT(refusal_of(m),
              HasSubstr("must be a rotation to 1e-09, but column 2 has length 1.00"));
  m(1, 1) = -1;
  EXPECT_EQ(refusal_of(m),
            "rotation is [[1, 0, 0], [0, -1, 0], [0, 0, 1]]: must be a rotation to 1e-09, but it "
            "mirrors");
  m << 1, 0.6, 0, 0, 0.8, 0, 0, 0, 1;
  EXPECT_THAT(refusal_of(m), HasSubstr("columns 1 and 2 are 53.13"));
  m << 1e300, 0, 0, 0, 1e300, 0, 0, 0, 1e300;
  EXPECT_THAT(refusal_of(m), HasSubstr("column 1 has length "));
  EXPECT_THAT(refusal_of(Eigen::Matrix3d::Zero()), HasSubstr("column 1 has length 0"));
}

TEST(AxisOfABody, IsReachedByTheShortestTurn) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 1000; ++i) {
    const double x = normal(random), y = normal(random), z = normal(random);
    const double size = std::pow(10, i % 600 - 300);
    const Vec3 direction = Vec3(x, y, z).normalized();
    const Eigen::Quaterniond q = orientation_along(size * direction);
    EXPECT_LT((matrix_of(q).col(2) - direction).norm(), some_roundings) << direction;
    EXPECT_EQ(q.z(), 0) << "it turns about its own axis, too";
  }
}

// So that bodies that are meant to be parallel are exactly parallel for the oracle.
TEST(AxisOfABody, IsExactWhereItsLengthIs) {
  const auto q = [](double w, double x, double y) { return Eigen::Quaterniond(w, x, y, 0); };
  EXPECT_EQ(orientation_along({0, 0, 4}).coeffs(), q(1, 0, 0).coeffs());
  EXPECT_EQ(orientation_along({0, 1, 0}).coeffs(), q(1, -1, 0).coeffs());
  EXPECT_EQ(orientation_along({3, 0, 0}).coeffs(), q(1.5, 0, 1.5).coeffs());
  EXPECT_EQ(orientation_along({0, 0, -1}).coeffs(), q(0, 1, 0).coeffs());
  EXPECT_EQ(orientation_along({0, 4, 3}).coeffs(), q(1, -0.5, 0).coeffs());
}

TEST(AxisOfABody, MayBeOfAnySizeButZero) {
  for (const double size : {5e-324, 1e-300, 1.7e308}) {
    const Eigen::Quaterniond q = orientation_along({0, size, 0});
    EXPECT_GE(q.w(), 1) << size;
    EXPECT_EQ(q.x(), -q.w()) << "it is no quarter turn";
    EXPECT_EQ(q.y(), 0);
  }
  EXPECT_THROW(orientation_along(Vec3::Zero()), InvalidInput);
}

}  // namespace
}  // namespace touchstone
