// The promise of the headers, held on every pair and pose class against the oracle.
//
// TOUCHSTONE_COUNT sets how many configurations of each class are tried; by default 425, which
// makes 100,000 over all pairs and takes some 20 s of one core. 8500 make two million.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>
#include <random>
#include <string>

#include "oracle/truth.hpp"
#include "properties/identity.hpp"
#include "reference/contact_of.hpp"

namespace touchstone {
namespace {

std::uint64_t count_per_class() {
  const char* text = std::getenv("TOUCHSTONE_COUNT");
  return text ? std::strtoull(text, nullptr, 10) : 425;
}

/// Errors of one answer, relative to the larger size.
struct Errors {
  double distance, regret;
  explicit Errors(const Configuration& c) {
    const oracle::Truth t = oracle::truth(c);
    const SignedDistance answer = signed_distance(c);
    // A plane may be far from its own origin; its offset then counts as a size.
    const auto* plane = std::get_if<Plane>(&c.b);
    const double size = std::max(
        larger_size(c), plane ? std::abs(plane->displacement()) / plane->normal().norm() : 0);
    distance = std::abs(answer.value - t.signed_distance.midpoint()) / size;
    regret = oracle::normal_regret(c, t, answer.normal) / size;
  }
};

class Accuracy : public testing::TestWithParam<Pair> {};

TEST_P(Accuracy, IsWithinRoundingOfTheLargerSize) {
  constexpr double promised = 1e-13;
  double worst_distance = 0, worst_regret = 0;
  std::string worst_distance_id, worst_regret_id;
  for (const auto& name : pose_classes(GetParam())) {
    for (std::uint64_t i = 0; i < count_per_class(); ++i) {
      const Identity id{GetParam(), name, 7, i};
      const Configuration c = make_configuration(id);
      const Errors errors(c);
      const double distance = errors.distance, regret = errors.regret;
      EXPECT_LE(distance, promised) << to_string(id);
      EXPECT_LE(regret, promised) << to_string(id);
      EXPECT_NEAR(signed_distance(c).normal.norm(), 1, 4e-15) << to_string(id);
      if (distance > worst_distance) worst_distance = distance, worst_distance_id = to_string(id);
      if (regret > worst_regret) worst_regret = regret, worst_regret_id = to_string(id);
    }
  }
  RecordProperty("worst_distance", std::to_string(worst_distance) + " " + worst_distance_id);
  std::printf("worst distance %.2g at %s, worst regret %.2g at %s\n", worst_distance,
              worst_distance_id.c_str(), worst_regret, worst_regret_id.c_str());
}

// Of ten million configurations (touchstone campaign --candidates reference --count 42373) those
// with the largest errors, relative to the smaller size: all of extreme aspect.
TEST(AccuracyOfTheWorst, IsWithinRoundingOfTheLargerSize) {
  for (const char* id :
       {"cylinder-sphere/aspect-needle-deep/1/18013", "cylinder-sphere/aspect-needle-deep/1/7553",
        "cylinder-cylinder/aspect-coin-deep/1/27067", "cylinder-sphere/aspect-needle/1/17514",
        "cylinder-cylinder/aspect-coin/1/41393",      "cylinder-cylinder/aspect-coin/1/2798",
        "cylinder-cylinder/aspect-needle/1/15061",    "cylinder-sphere/aspect-needle/1/23949",
        "cylinder-capsule/aspect-coin/1/18475",       "cylinder-box/aspect-needle/1/18623",
        "cylinder-capsule/aspect-needle/1/32780",     "cylinder-capsule/aspect-needle/1/830",
        "cylinder-capsule/aspect-coin/1/24641",       "cylinder-box/aspect-coin/1/9003",
        "cylinder-box/aspect-needle/1/33844",         "cylinder-plane/aspect-needle-deep/1/19335",
        "cylinder-plane/aspect-needle-deep/1/1848",   "cylinder-box/aspect-coin/1/27023",
        "cylinder-plane/aspect-needle/1/4270",        "cylinder-plane/aspect-coin/1/21195"}) {
    const Errors errors(make_configuration(parse_identity(id)));
    EXPECT_LE(errors.distance, 1e-13) << id;
    EXPECT_LE(errors.regret, 1e-13) << id;
  }
}

// Rims that are all but tangent, from outside or from within, on axes that are all but parallel:
// two stationary points lie close together in a valley that is flat to rounding.
TEST(CylinderCylinder, RimsThatNearlyTouchOnNearlyParallelAxesAreExact) {
  std::mt19937_64 random(1);
  const auto uniform = [&](double lo, double hi) {
    return std::uniform_real_distribution(lo, hi)(random);
  };
  const auto sign = [&] { return uniform(-1, 1) < 0 ? -1.0 : 1.0; };
  const auto power_of_ten = [&](double lo, double hi) { return std::pow(10, uniform(lo, hi)); };
  const std::uint64_t count = 2 * count_per_class();
  double worst = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    const Cylinder a(uniform(0.2, 1), uniform(0.2, 1)), b(uniform(0.2, 1), uniform(0.2, 1));
    const double hair = power_of_ten(-12, -5), tilt = power_of_ten(-13, -2);
    const double heading = uniform(0, 6.3),
                 leaning = heading + uniform(-1, 1) * power_of_ten(-9, 0.5);
    const double beside =
        (uniform(0, 1) < 0.5 ? a.radius() + b.radius() : std::abs(a.radius() - b.radius())) +
        sign() * hair * uniform(0, 1);
    const double above = a.half_length() + b.half_length() +
                         (uniform(0, 1) < 0.5 ? 1 : tilt) * sign() * hair * uniform(0, 1) +
                         sign() * tilt * a.radius();
    const Eigen::Quaterniond turn(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    const Eigen::Quaterniond lean(1, tilt / 2 * std::cos(leaning), tilt / 2 * std::sin(leaning), 0);
    const Vec3 d(beside * std::cos(heading), beside * std::sin(heading), above);
    const Configuration c{a, Pose(turn.normalized() * d, turn * lean), b, Pose(Vec3::Zero(), turn)};
    const Errors errors(c);
    EXPECT_LE(errors.distance, 1e-13) << i;
    EXPECT_LE(errors.regret, 1e-13) << i;
    worst = std::max({worst, errors.distance, errors.regret});
  }
  std::printf("worst %.2g\n", worst);
}

// Along normals nearly parallel to an axis, 1 - (n·u)² has no digits left where the axes are
// perpendicular to within the square root of rounding.
TEST(CylinderCylinder, RimsThatFaceEachOtherOnNearlyPerpendicularAxesAreExact) {
  const Configuration facing{Cylinder(1, 2), Pose({-0.48, -3.38, 2.66}, {1, 1.000000022, 0, 0}),
                             Cylinder(1, 1), Pose()};
  EXPECT_LE(Errors(facing).distance, 1e-13);
  EXPECT_LE(Errors(facing).regret, 1e-13);

  std::mt19937_64 random(1);
  const auto uniform = [&](double lo, double hi) {
    return std::uniform_real_distribution(lo, hi)(random);
  };
  const auto sign = [&] { return uniform(-1, 1) < 0 ? -1.0 : 1.0; };
  const std::uint64_t count = 4 * count_per_class();
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto size = [&] { return std::exp2(uniform(-2, 2)); };
    const Cylinder a(size(), size()), b(size(), size());
    const double tilt = sign() * std::pow(10, uniform(-9, -7));
    const double at_a = uniform(0, 6.3), at_b = uniform(0, 6.3);
    const Vec3 rim_a(a.radius() * std::cos(at_a), sign() * a.half_length(),
                     a.radius() * std::sin(at_a));
    const Vec3 rim_b(b.radius() * std::cos(at_b), b.radius() * std::sin(at_b),
                     sign() * b.half_length());
    const Vec3 apart = std::pow(10, uniform(-4, 0)) * std::min(a.radius(), b.radius()) *
                       Vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    const Configuration c{a, Pose(rim_b - rim_a + apart, {1, 1 + tilt, 0, 0}), b, Pose()};
    const Errors errors(c);
    EXPECT_LE(errors.distance, 1e-13) << i;
    EXPECT_LE(errors.regret, 1e-13) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(, Accuracy, testing::ValuesIn(all_pairs), [](const auto& pair) {
  return std::string(pair_name(pair.param)).substr(std::string("cylinder-").size());
});

}  // namespace
}  // namespace touchstone
