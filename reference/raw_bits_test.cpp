// Any finite sizes and poses, among them denormals, 1e±308 and their mixtures: the answer is a
// number, its normal a unit vector. Run under the sanitizers too (CONTRIBUTING.md).
// TOUCHSTONE_COUNT sets how many are tried for each pair.
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <gtest/gtest.h>
#include <optional>
#include <random>

#include "reference/contact_of.hpp"
#include "reference/invalid_input.hpp"

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
    switch (pair) {
      case Pair::plane: {
        const Vec3 normal = vector();
        return Plane(normal, any());
      }
      case Pair::sphere:
        return Sphere(size());
      case Pair::capsule: {
        const double radius = size();
        return Capsule(radius, size());
      }
      case Pair::cylinder:
        return cylinder();
      case Pair::box:
        return Box(vector().cwiseAbs());
    }
    return Sphere(1);
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
  const char* text = std::getenv("TOUCHSTONE_COUNT");
  const std::uint64_t count = text ? std::strtoull(text, nullptr, 10) : 20000;
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

INSTANTIATE_TEST_SUITE_P(, AnyBits, testing::ValuesIn(all_pairs), [](const auto& pair) {
  return std::string(pair_name(pair.param)).substr(std::string("cylinder-").size());
});

}  // namespace
}  // namespace touchstone
