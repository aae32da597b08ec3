// Casts against spheres, which closed forms begin and end: sweeps made from where they pass or
// touch, against the truth.
//
// TOUCHSTONE_COUNT sets how many are tried of each place, by default 2000.
#include "reference/passing_sphere.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <string>

#include "reference/contact_of.hpp"
#include "reference/random_bodies_test.hpp"
#include "reference/random_casts_test.hpp"

namespace touchstone {
namespace {

struct SphereCast {
  Configuration bodies;
  Vec3 sweep;
};

/// Where a sphere meets A, its edges between cap, side and rim included.
enum class Place { cap, side, rim, edge_of_cap, edge_of_side };

std::string name_of_place(const testing::TestParamInfo<Place>& place) {
  constexpr const char* names[] = {"Cap", "Side", "Rim", "EdgeOfCap", "EdgeOfSide"};
  return names[static_cast<int>(place.param)];
}

/// A sweep by which the sphere comes as near as `gap` to the place, be it that it goes on into A or
/// that it only passes along; and that ends there, or before or after it.
SphereCast random_cast(Place place, double gap, Random& random) {
  const double r = random.power_of_ten(-3, 3), h = random.power_of_ten(-3, 3);
  const double rounding = random.toss() ? 0 : random.uniform(0, 1) * std::min(r, h);
  const Cylinder a(r, h, rounding);
  const Sphere b(random.power_of_ten(-3, 3));
  const double tilt = place == Place::cap || place == Place::edge_of_cap ? 0
                      : place == Place::rim ? random.uniform(0, std::numbers::pi / 2)
                                            : std::numbers::pi / 2;
  const double across = place == Place::cap ? random.uniform(0, 1) : 1;
  const double along = place == Place::side ? random.uniform(-1, 1) : 1;
  const double azimuth = random.uniform(0, 2 * std::numbers::pi);
  const Vec3 radial(std::cos(azimuth), std::sin(azimuth), 0);
  const Vec3 on_core =
      across * a.core_radius() * radial + along * a.core_half_length() * Vec3::UnitZ();
  const Vec3 normal = std::sin(tilt) * radial + std::cos(tilt) * Vec3::UnitZ();
  const Vec3 centre = on_core + (rounding + b.radius() + gap) * normal;
  Vec3 way = random.direction();
  if (random.toss()) {
    const Vec3 level = way - way.dot(normal) * normal;
    way = (level - (random.toss() ? 0 : random.power_of_ten(-16, 0)) * normal).normalized();
  }
  if (way.dot(normal) > 0) way = -way;
  const double size = std::max({r, h, b.radius()});
  const double length = size * random.power_of_ten(random.toss() ? -3 : -17, 6);
  const Vec3 from = centre - length * way;
  const double end = random.toss() ? 1 + random.sign() * random.power_of_ten(-16, 0) : 2;
  // In a frame of its own, where A moves.
  const Pose pose_a(random.direction() * random.uniform(0, 10), random.turn());
  const Vec3 position_b = pose_a.position() + pose_a.rotation() * from;
  return {{a, pose_a, b, Pose(position_b, random.turn())},
          -(end * length) * (pose_a.rotation() * way)};
}

class PassingSpheres : public testing::TestWithParam<Place> {};

TEST_P(PassingSpheres, AreMetWhereTheyAre) {
  Random random(static_cast<std::uint64_t>(GetParam()) + 31);
  HeldCasts casts;
  int misses = 0;
  const std::uint64_t count = tried_of_each(2000);
  for (std::uint64_t i = 0; i < count; ++i) {
    SCOPED_TRACE(i);
    const double gap = random.toss() ? 0 : random.sign() * random.power_of_ten(-16, 0);
    const auto [c, sweep] = random_cast(GetParam(), gap, random);
    casts.hold(c, sweep);
    const Vec3 offset = c.pose_a.position() - c.pose_b.position();
    misses += PassingSphere(c.a, c.pose_a, offset, sweep, std::get<Sphere>(c.b)).misses();
  }
  const int some = static_cast<int>(count / 10);
  EXPECT_GT(casts.touches, some);
  EXPECT_GT(casts.nevers, some);
  EXPECT_GE(misses, some / 6);
}

TEST_P(PassingSpheres, AreMetByTheirClosedForms) {
  Random random(static_cast<std::uint64_t>(GetParam()) + 41);
  int touches = 0, exact = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto [c, sweep] = random_cast(GetParam(), 0, random);
    const Cast found = cast(c, sweep);
    if (found.status != CastStatus::touch) continue;
    ++touches;
    const Vec3 offset = c.pose_a.position() - c.pose_b.position();
    const PassingSphere passing(c.a, c.pose_a, offset, sweep, std::get<Sphere>(c.b));
    const double apart = signed_distance(swept(c, Sweep(sweep), passing.time())).value;
    exact += std::abs(apart) <= distance_tolerance(c, sweep);
  }
  EXPECT_GT(touches, 200);
  EXPECT_GT(exact, touches / 2);
}

INSTANTIATE_TEST_SUITE_P(Places, PassingSpheres,
                         testing::Values(Place::cap, Place::side, Place::rim, Place::edge_of_cap,
                                         Place::edge_of_side),
                         name_of_place);

}  // namespace
}  // namespace touchstone
