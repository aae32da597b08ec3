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
#include "reference/support.hpp"

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

// Configurations that generators of another make found wrong.
TEST(AccuracyOfTheHostile, IsWithinRoundingOfTheLargerSize) {
  const struct {
    const char* name;
    Configuration configuration;
  } table[] = {
      // Projections left a gap of one ulp of bodies that overlap deeply; the vertex off the rim lay
      // on the rim, the normal to it vanished, and no gap is as large as that of no normal.
      {"a box's vertex on the rim",
       {Cylinder(0x1.97c35abda3eebp-1, 0x1.93973dd550fddp-1),
        Pose({-0x1.81d3ed9e3d37ap-3, 0x1.da6972f3aa68cp-1, -0x1.68700f31523a4p-1},
             {0x1p+0, 0x1.11baa155417aap-47, -0x1.0bb9b6876a42ap-48, 0x1.b171ba7780121p-19}),
        Box({0x1.2867f0a3b4efbp-2, 0x1.2867f0a3b4efbp-2, 0x1.5939751ff6014p-4}),
        Pose({0x0.0000000000001p-1022, 0, 0}, {1, 0, 0, 0})}},
      // Squares that cancelled took a vertex of a box 4e-7 thin for one beside a cap 4e-8 wide.
      {"a thin box's vertex beside a thin cylinder",
       {Cylinder(0x1.5adf1e53b58cbp-25, 0x1.04c51b27cc453p-10),
        Pose({0x1.50af5789b637ep+1, 0x1.facfbc323149ap+0, 0x1.7328118884318p-1},
             {-0x1.ed71d80335651p-3, 0x1.444e46af34d6bp-1, 0x1.6b6a28280ca2cp-1,
              -0x1.89946b3c4a0b1p-3}),
        Box({0x1.9796486b56d28p-22, 0x1.63e41bbd6b875p-4, 0x1.e96fb2e83a3b5p-1}),
        Pose({0x1p+1, 0x1p+1, 0x0p+0}, {-0x1.ed71d80335652p-3, 0x1.444e46af34d6bp-1,
                                        0x1.6b6a28280ca2cp-1, -0x1.89946b3c4a0b1p-3})}},
      // The cosine between the axes is a denormal, and with it half axis and products of the
      // ellipse.
      {"a capsule across the axis but for a denormal",
       {Cylinder(0x1p-2, 0x1.e4ba4a59350b6p-1),
        Pose({-0x1.9c0c06b22fabcp+0, -0x1.b29ea3cba369fp-2, 0x1.1e4ba9d1425bcp-2},
             {0x1p+0, -0x1.6a09e667f3bcdp-1, 0x1p+0, -0x1.6a09e667f3bcdp-1}),
        Capsule(0x1.e4ba4a59350b7p-1, 0x1.480423537100cp-1),
        Pose({0x0p+0, 0x0p+0, 0x0p+0},
             {0x1p+0, -0x1.6a09e667f3bcdp-1, -0x0.0000000000002p-1022, 0x0p+0})}},
  };
  for (const auto& row : table) {
    const SignedDistance answer = signed_distance(row.configuration);
    EXPECT_NEAR(answer.normal.norm(), 1, 4e-15) << row.name;
    ASSERT_GT(answer.normal.norm(), 0) << row.name;
    const Errors errors(row.configuration);
    EXPECT_LE(errors.distance, 1e-13) << row.name;
    EXPECT_LE(errors.regret, 1e-13) << row.name;
  }
}

Shape scaled(const Shape& shape, double by) {
  if (const auto* s = std::get_if<Plane>(&shape)) return Plane(s->normal(), by * s->displacement());
  if (const auto* s = std::get_if<Sphere>(&shape)) return Sphere(by * s->radius());
  if (const auto* s = std::get_if<Box>(&shape)) return Box(by * s->half_extents());
  if (const auto* s = std::get_if<Capsule>(&shape)) {
    return Capsule(by * s->radius(), by * s->half_length());
  }
  const auto& s = std::get<Cylinder>(shape);
  return Cylinder(by * s.radius(), by * s.half_length());
}
Configuration scaled(const Configuration& c, double by) {
  const auto posed = [by](const Pose& p) { return Pose(by * p.position(), p.orientation()); };
  return {std::get<Cylinder>(scaled(Shape(c.a), by)), posed(c.pose_a), scaled(c.b, by),
          posed(c.pose_b)};
}

// No power of a length may overflow or vanish, of any length that a double holds.
TEST_P(Accuracy, IsTheSameAtEveryScale) {
  for (const auto& name : pose_classes(GetParam())) {
    for (std::uint64_t i = 0; i < 10; ++i) {
      const Identity id{GetParam(), name, 7, i};
      const Configuration c = make_configuration(id);
      const SignedDistance answer = signed_distance(c);
      for (const int exponent : {-700, -170, -130, -100, -82, 82, 100, 128, 140, 166, 400, 900}) {
        const double by = std::ldexp(1, exponent);
        const SignedDistance at_scale = signed_distance(scaled(c, by));
        SCOPED_TRACE(to_string(id) + " times 2^" + std::to_string(exponent));
        const double rounding = 1e-13 * larger_size(c) + 1e-15 * c.pose_a.position().norm();
        ASSERT_NEAR(at_scale.value / by, answer.value, rounding);
        ASSERT_NEAR(at_scale.normal.norm(), 1, 4e-15);
        if (GetParam() == Pair::plane) continue;  // a half-space has a gap along its normal only
        ASSERT_GE(gap(c, at_scale.normal), answer.value - rounding);
      }
    }
  }
}

// Lengths of both ends beside each other.
TEST(AccuracyOfTheHostile, HoldsForLengthsFarApart) {
  const Eigen::Quaterniond turn(0.9, 0.3, 0.2, 0.1);
  for (const double tiny : {1e-40, 1e-24, 1e-9}) {
    for (const double huge : {1e9, 1e24, 1e40}) {
      const Shape others[] = {Sphere(huge),         Sphere(tiny),         Capsule(tiny, huge),
                              Capsule(huge, tiny),  Cylinder(tiny, huge), Cylinder(huge, tiny),
                              Box({tiny, 1, huge}), Box({huge, tiny, 1})};
      for (const Shape& b : others) {
        for (const Cylinder& a : {Cylinder(tiny, huge), Cylinder(huge, tiny), Cylinder(1, 1)}) {
          const double size = std::max(largest_half_extent(a), largest_half_extent(b));
          const Errors errors({a, Pose(size * Vec3(0.3, -0.4, 0.9), turn), b, Pose()});
          EXPECT_LE(errors.distance, 1e-13) << shape_name(b) << " " << tiny << " " << huge;
          EXPECT_LE(errors.regret, 1e-13) << shape_name(b) << " " << tiny << " " << huge;
        }
      }
    }
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
