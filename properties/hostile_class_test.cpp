// The promises of the hostile class: it reaches every difficulty that its description names, and
// makes valid configurations only.
#include <array>
#include <cmath>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "properties/draw.hpp"
#include "properties/identity.hpp"
#include "properties/recorded.hpp"

namespace touchstone {
namespace {

constexpr std::uint64_t hostile_samples = 20000;

Configuration hostile(Pair pair, std::uint64_t index) {
  return make_configuration({pair, "hostile", 1, index});
}

int count(Pair pair, const std::function<bool(const Configuration&)>& holds) {
  int result = 0;
  for (std::uint64_t i = 0; i < hostile_samples; ++i) result += holds(hostile(pair, i));
  return result;
}

/// Sine of the angle between both z axes, and its cosine: without cancellation where one is small.
struct Angle {
  double sine, cosine;
};
Angle between_axes(const Configuration& c) {
  const Eigen::Quaterniond q = c.pose_b.orientation().conjugate() * c.pose_a.orientation();
  const double across = std::hypot(q.x(), q.y()), along = std::hypot(q.w(), q.z());
  const double squared = across * across + along * along;
  return {2 * across * along / squared, (along - across) * (along + across) / squared};
}

bool is_within(double x, double lo, double hi) { return std::abs(x) > lo && std::abs(x) < hi; }

// Shapes and poses reject numbers that are not finite, so that constructing them is the test.
TEST(HostileClass, MakesValidConfigurationsOfItsPair) {
  for (const Pair pair : all_pairs) {
    // A hull is made of its points, which takes as long as a hundred others.
    const std::uint64_t samples = pair == Pair::convex ? hostile_samples / 5 : hostile_samples;
    for (std::uint64_t i = 0; i < samples; ++i) EXPECT_EQ(pair_of(hostile(pair, i)), pair) << i;
  }
}

/// Histogram of `hostile_samples` tilts by powers of ten: counts[k] starts at 1e-(k+1).
struct Decades {
  std::array<int, 16> counts{};
  void add(double tilt) {
    double lower = 0.1;
    for (int& in_decade : counts) {
      in_decade += is_within(tilt, lower, 10 * lower);
      lower /= 10;
    }
  }
};

TEST(HostileClass, TiltsAxesByEveryPowerOfTenFromParallelAndPerpendicular) {
  for (const Pair pair : {Pair::capsule, Pair::cylinder, Pair::box}) {
    Decades parallel, perpendicular;
    for (std::uint64_t i = 0; i < hostile_samples; ++i) {
      const Angle angle = between_axes(hostile(pair, i));
      parallel.add(angle.sine);
      perpendicular.add(angle.cosine);
    }
    EXPECT_THAT(parallel.counts, testing::Each(testing::Gt(20))) << pair_name(pair);
    EXPECT_THAT(perpendicular.counts, testing::Each(testing::Gt(20))) << pair_name(pair);
  }
}

TEST(HostileClass, HasEveryKindOfNumber) {
  const struct {
    const char* what;
    std::function<bool(const Configuration&)> holds;
  } kinds[] = {
      {"ordinary", [](const Configuration& c) { return is_within(larger_size(c), 0.1, 10); }},
      {"larger than any galaxy", [](const Configuration& c) { return larger_size(c) > 0x1p128; }},
      {"smaller than any atom", [](const Configuration& c) { return larger_size(c) < 0x1p-128; }},
      {"of extreme aspect",
       [](const Configuration& c) { return larger_size(c) > 1e7 * smaller_size(c); }},
      {"exactly parallel", [](const Configuration& c) { return between_axes(c).sine == 0; }},
      {"exactly perpendicular", [](const Configuration& c) { return between_axes(c).cosine == 0; }},
      {"concentric",
       [](const Configuration& c) { return c.pose_a.position() == c.pose_b.position(); }},
      {"as long as wide", [](const Configuration& c) { return c.a.radius() == c.a.half_length(); }},
      {"of integers",
       [](const Configuration& c) {
         return c.pose_a.position() == c.pose_a.position().array().round().matrix();
       }},
      {"denormal",
       [](const Configuration& c) {
         return (c.pose_b.position().array().abs() < 0x1p-1022 && c.pose_b.position().array() != 0)
             .any();
       }},
      {"a quaternion far from unit length",
       [](const Configuration& c) {
         const double largest = c.pose_a.orientation().coeffs().cwiseAbs().maxCoeff();
         return largest > 1e154 || largest < 1e-162;
       }},
      {"a quaternion just off unit length",
       [](const Configuration& c) {
         return is_within(c.pose_a.orientation().squaredNorm() - 1, 1e-12, 1e-3);
       }},
  };
  for (const auto& kind : kinds) EXPECT_GT(count(Pair::box, kind.holds), 40) << kind.what;
}

TEST(HostileClass, PutsBodiesAnywhereWithinEachOtherAtClearTilts) {
  for (const Pair pair : {Pair::cylinder, Pair::box}) {
    EXPECT_GT(count(pair,
                    [](const Configuration& c) {
                      const Vec3 between = c.pose_a.position() - c.pose_b.position();
                      return is_within(between_axes(c).sine, 1e-3, 0.3) &&
                             is_within(between.norm(), 0, larger_size(c)) &&
                             larger_size(c) < 40 * smaller_size(c);
                    }),
              200)
        << pair_name(pair);
  }
}

// In a frame turned at random, parallel but for what rounding leaves of each body's own motion.
TEST(HostileClass, RoundsParallelBodiesByThemselves) {
  EXPECT_GT(count(Pair::cylinder,
                  [](const Configuration& c) {
                    const auto q = c.pose_b.orientation().coeffs().array();
                    const bool is_turned = (q != q.round()).all();
                    return is_turned && is_within(between_axes(c).sine, 0, 1e-12);
                  }),
            1900);
}

// Between three points of a whole cap and four of a lens.
TEST(HostileClass, PutsCapsOnCapsThatAreNotQuiteCoaxial) {
  EXPECT_GT(count(Pair::cylinder,
                  [](const Configuration& c) {
                    const Vec3 between = c.pose_a.position() - c.pose_b.position();
                    const double across = std::hypot(between.x(), between.y());
                    const double above = c.a.half_length() + std::get<Cylinder>(c.b).half_length() -
                                         std::abs(between.z());
                    return between_axes(c).sine == 0 && is_within(above / c.a.radius(), 0, 0.1) &&
                           is_within(across / c.a.radius(), 1e-6, 1e-2);
                  }),
            150);
}

TEST(HostileClass, ChangesKnownFailuresByLittle) {
  for (const Pair pair : {Pair::sphere, Pair::capsule, Pair::cylinder, Pair::box}) {
    const Numbers& known = known_failures(pair).front();
    EXPECT_GT(count(pair,
                    [&](const Configuration& c) {
                      Numbers changed = numbers_of(c), original = known;
                      const auto now = every_number(changed), then = every_number(original);
                      int same = 0;
                      for (std::size_t i = 0; i < now.size(); ++i) same += *now[i] == *then[i];
                      return same + 3 >= std::ssize(now) && same < std::ssize(now);
                    }),
              100)
        << pair_name(pair);
  }
}

}  // namespace
}  // namespace touchstone
