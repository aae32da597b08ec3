// Any finite sizes and poses, among them denormals, 1e±308 and their mixtures: the answer is a
// number, its normal a unit vector. And bodies of ordinary sizes whose lengths are all multiplied
// by a power of two, which rounds nothing: the answer is the same to the last bit.
// Run under the sanitizers too (CONTRIBUTING.md). TOUCHSTONE_COUNT sets how many are tried for each
// pair.
#include <bit>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <optional>
#include <random>
#include <vector>

#include "oracle/hull.hpp"
#include "reference/contact_of.hpp"
#include "reference/invalid_input.hpp"
#include "reference/random_bodies_test.hpp"
#include "reference/support.hpp"

namespace touchstone {
namespace {

class RawBits {
 public:
  explicit RawBits(std::uint64_t seed) : bits_(seed) {}

  /// All 64 bits at random, an ordinary number, or one at the ends of the range.
  double any() {
    constexpr double special[] = {0.0,     -0.0,     1.0,   -1.0, 4.9e-324, 2.3e-308,
                                  1.7e308, -1.7e308, 1e-50, 1e50, 0.5,      1e154};
    switch (bits_() % 4) {
      case 0:
        return std::bit_cast<double>(bits_());
      case 1:
        return special[bits_() % std::size(special)];
      default:
        return std::ldexp(static_cast<double>(static_cast<std::int64_t>(bits_())), -62);
    }
  }
  double size() { return std::abs(any()); }
  Vec3 vector() {
    const double x = any(), y = any(), z = any();
    return {x, y, z};
  }
  Pose pose() {
    const Vec3 position = vector(), v = vector();
    return Pose(position, Eigen::Quaterniond(any(), v.x(), v.y(), v.z()));
  }
  Cylinder cylinder() {
    const double radius = size();
    return Cylinder(radius, size());
  }
  Shape shape(Pair pair) {
    if (pair == Pair::convex) {
      std::vector<Vec3> points;
      for (auto left = 3 + bits_() % 6; left > 0; --left) points.push_back(vector());
      return oracle::convex_hull(points);
    }
    const auto plane = [&] {
      const Vec3 normal = vector();
      return Plane(normal, any());
    };
    return shape_of_sizes(
        pair, [&] { return size(); }, plane);
  }

 private:
  std::mt19937_64 bits_;
};

/// None where the bits have a NaN, an infinity or a zero, which are refused as they should be.
std::optional<Configuration> configuration(std::uint64_t seed, Pair pair) {
  RawBits bits(seed);
  try {
    const Cylinder a = bits.cylinder();
    const Pose pose_a = bits.pose();
    const Shape b = bits.shape(pair);
    return Configuration{a, pose_a, b, bits.pose()};
  } catch (const InvalidInput&) {
    return std::nullopt;
  }
}

void expect_numbers(const Configuration& c) {
  const SignedDistance distance = signed_distance(c);
  ASSERT_TRUE(std::isfinite(distance.value));
  ASSERT_NEAR(distance.normal.norm(), 1, 1e-14);
  overlaps(c);
  const Vec3 hint(0, 0.6, 0.8);
  for (const double threshold : {0.0, 1e-6, 1e300}) {
    for (const Vec3* previous : {static_cast<const Vec3*>(nullptr), &hint}) {
      const Contact answer = contact(c, threshold, previous);
      ASSERT_TRUE(std::isfinite(answer.signed_distance));
      ASSERT_NEAR(answer.normal.norm(), 1, 1e-14);
      ASSERT_EQ(answer.points().empty(), !(answer.signed_distance <= threshold));
      for (const ContactPoint& p : answer.points()) {
        ASSERT_TRUE(p.position.allFinite() && std::isfinite(p.depth));
      }
    }
  }
}

class AnyBits : public testing::TestWithParam<Pair> {};

TEST_P(AnyBits, AreAnsweredWithNumbers) {
  const std::uint64_t count = tried_of_each(20000);
  std::uint64_t tried = 0;
  for (std::uint64_t seed = 0; tried < count; ++seed) {
    const std::optional<Configuration> c = configuration(seed, GetParam());
    if (!c) continue;
    SCOPED_TRACE(seed);
    expect_numbers(*c);
    if (HasFatalFailure()) return;
    ++tried;
  }
}

/// Bodies of ordinary sizes that overlap or are apart by less than one of them, their axes at any
/// angle or one that is small.
Configuration ordinary(std::uint64_t seed, Pair pair) {
  Random random(seed);
  const auto size = [&] { return random.power_of_ten(-1.5, 1); };
  const auto hull = [&]() -> Shape {
    std::vector<Vec3> points;
    for (int left = 3 + random.one_of(8); left > 0; --left) {
      points.push_back(size() * random.direction());
    }
    return oracle::convex_hull(points);
  };
  // A plane's normal that is not rounded again.
  const Shape b = pair == Pair::convex
                      ? hull()
                      : shape_of_sizes(pair, size, [&] { return Plane(Vec3::UnitX(), size()); });
  const double radius = size();
  Configuration c{Cylinder(radius, size()), Pose(), b, Pose()};
  const Eigen::Quaterniond turn_b = random.turn();
  const double tilt = random.power_of_ten(-9, 0);
  const Eigen::Quaterniond lean(Eigen::AngleAxisd(tilt, random.turn() * Vec3::UnitX()));
  const Eigen::Quaterniond turn_a = seed % 2 == 0 ? lean * turn_b : random.turn();
  const Vec3 n = random.turn() * Vec3::UnitX();
  c.pose_b = Pose(Vec3(size(), size(), size()), turn_b);
  c.pose_a = Pose(c.pose_b.position(), turn_a);
  const double room = pair == Pair::plane ? radius : -gap(c, n);
  c.pose_a = Pose(c.pose_b.position() + random.uniform(0, 1.2) * room * n, turn_a);
  return c;
}

Shape raw_scaled(const Shape& shape, double factor) {
  if (const auto* s = std::get_if<Plane>(&shape)) {
    return Plane(s->unit_normal(), factor * s->unit_displacement());
  }
  if (const auto* s = std::get_if<Sphere>(&shape)) return Sphere(factor * s->radius());
  if (const auto* s = std::get_if<Capsule>(&shape)) {
    return Capsule(factor * s->radius(), factor * s->half_length());
  }
  if (const auto* s = std::get_if<Cylinder>(&shape)) {
    return Cylinder(factor * s->radius(), factor * s->half_length());
  }
  if (const auto* s = std::get_if<Convex>(&shape)) {
    std::vector<Vec3> vertices = s->vertices();
    for (Vec3& v : vertices) v *= factor;
    return oracle::convex_hull(vertices);
  }
  return Box(factor * std::get<Box>(shape).half_extents());
}

void expect_same_but_for_scale(const Configuration& c, double factor) {
  const auto moved = [&](const Pose& pose) {
    return Pose(factor * pose.position(), pose.orientation());
  };
  const Configuration other{std::get<Cylinder>(raw_scaled(c.a, factor)), moved(c.pose_a),
                            raw_scaled(c.b, factor), moved(c.pose_b)};
  const SignedDistance one = signed_distance(c), two = signed_distance(other);
  ASSERT_EQ(two.value, factor * one.value);
  ASSERT_EQ(two.normal, one.normal);
  const CertifiedDistance sure1 = certified_distance(c), sure2 = certified_distance(other);
  ASSERT_EQ(sure2.value, factor * sure1.value);
  ASSERT_EQ(sure2.error_bound, factor * sure1.error_bound);
  ASSERT_EQ(overlaps(other), overlaps(c));
  for (const double threshold : {0.0, 0.25}) {
    const Contact contact1 = contact(c, threshold), contact2 = contact(other, factor * threshold);
    ASSERT_EQ(contact2.signed_distance, factor * contact1.signed_distance);
    ASSERT_EQ(contact2.normal, contact1.normal);
    ASSERT_EQ(contact2.points().size(), contact1.points().size());
    for (std::size_t i = 0; i < contact1.points().size(); ++i) {
      ASSERT_EQ(contact2.points()[i].position, factor * contact1.points()[i].position);
      ASSERT_EQ(contact2.points()[i].depth, factor * contact1.points()[i].depth);
    }
  }
}

// Terms of different dimensions that are added or compared would show.
TEST_P(AnyBits, AreTheSameWhateverTheUnitOfLength) {
  for (std::uint64_t seed = 0; seed < tried_of_each(10000); ++seed) {
    SCOPED_TRACE(seed);
    const Configuration c = ordinary(seed, GetParam());
    expect_same_but_for_scale(c, 0x1p40);
    expect_same_but_for_scale(c, 0x1p-40);
    if (HasFatalFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(, AnyBits, testing::ValuesIn(all_pairs), name_of_other);

}  // namespace
}  // namespace touchstone
