// What holds for every cast without a truth to compare it with. Each law is tried on sweeps of all
// pairs, which rapidcheck draws (RC_PARAMS sets their number and seed).
#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <string>
#include <utility>

#include "properties/moves.hpp"
#include "reference/cast.hpp"
#include "reference/random_casts_test.hpp"
#include "reference/sweep.hpp"

namespace touchstone {
namespace {

using CastLaw = std::function<void(const Configuration&, const Vec3& sweep)>;

void expect_of_every_pair(const CastLaw& law) {
  for (const Pair pair : all_pairs) {
    EXPECT_TRUE(rc::check(pair_name(pair), [&] {
      Random random(static_cast<std::uint64_t>(*rc::gen::inRange(0, 1 << 30)));
      const auto [c, sweep] = random_sweep(pair, random);
      law(c, sweep);
    }));
  }
}

double distance_after(const Configuration& c, const Vec3& sweep, double t) {
  return signed_distance({c.a, Sweep(sweep).moved(c.pose_a, t), c.b, c.pose_b}).value;
}
/// A pose far from the world's origin is rounded as it is moved there, unlike within a cast.
double tolerance_after(const Configuration& c, const Vec3& sweep, double t) {
  const Configuration there{c.a, Sweep(sweep).moved(c.pose_a, t), c.b, c.pose_b};
  return distance_tolerance(there, sweep) + 0x1p-51 * there.pose_a.position().norm();
}

/// Is it no touch, or one in which only rounding could see anything but one?
bool barely_touches(const Configuration& c, const Vec3& sweep, const Cast& found) {
  constexpr int parts = 64;
  for (int i = 0; i <= parts; ++i) {
    const double t = found.fraction + (1 - found.fraction) * i / parts;
    if (distance_after(c, sweep, t) < -tolerance_after(c, sweep, t)) return false;
  }
  return true;
}

TEST(CastLaw, ThePoseAtTheTouchTouches) {
  expect_of_every_pair([](const Configuration& c, const Vec3& sweep) {
    const Cast found = cast(c, sweep);
    if (found.status != CastStatus::touch) return;
    RC_ASSERT(std::abs(distance_after(c, sweep, found.fraction)) <=
              tolerance_after(c, sweep, found.fraction));
  });
}

TEST(CastLaw, ThereIsNoContactStrictlyBefore) {
  expect_of_every_pair([](const Configuration& c, const Vec3& sweep) {
    const Cast found = cast(c, sweep);
    if (found.status == CastStatus::from_start) return;
    for (int i = 1; i < 8; ++i) {
      const double t = found.fraction * i / 8;
      RC_ASSERT(distance_after(c, sweep, t) >= -tolerance_after(c, sweep, t));
    }
  });
}

TEST(CastLaw, HalfASweepTakesTwiceTheFractionOrNeverTouches) {
  expect_of_every_pair([](const Configuration& c, const Vec3& sweep) {
    const Cast whole = cast(c, sweep), half = cast(c, sweep / 2);
    RC_ASSERT((whole.status == CastStatus::from_start) == (half.status == CastStatus::from_start));
    if (whole.status != CastStatus::touch) return;
    const double t = 2 * whole.fraction;
    if (half.status == CastStatus::touch) {
      RC_ASSERT(std::abs(distance_after(c, sweep / 2, std::min(t, 1.0))) <=
                2 * tolerance_after(c, sweep, whole.fraction));
    } else if (t < 1) {
      RC_ASSERT(barely_touches(c, sweep / 2, {CastStatus::touch, t, whole.normal}));
    }
  });
}

TEST(CastLaw, ALongerSweepDoesNotTouchLater) {
  expect_of_every_pair([](const Configuration& c, const Vec3& sweep) {
    const Cast shorter = cast(c, sweep), longer = cast(c, 3 * sweep);
    if (shorter.status != CastStatus::touch) return;
    if (longer.status == CastStatus::never) {
      RC_ASSERT(barely_touches(c, sweep, shorter));
      return;
    }
    // A later one would go deeper in between.
    const double t = 3 * longer.fraction;
    if (t <= shorter.fraction) return;
    for (int i = 1; i <= 8; ++i) {
      const double between = shorter.fraction + (t - shorter.fraction) * i / 8;
      RC_ASSERT(distance_after(c, sweep, between) >= -4 * tolerance_after(c, sweep, between));
    }
  });
}

TEST(CastLaw, TheOtherBodyMovingBackwardsTouchesAtTheSameTime) {
  for (const char* name : {"general-shallow", "rim-rim", "parallel-side", "coaxial"}) {
    EXPECT_TRUE(rc::check(name, [&] {
      Random random(static_cast<std::uint64_t>(*rc::gen::inRange(0, 1 << 30)));
      Configuration c = make_configuration(
          {Pair::cylinder, name, 1, static_cast<std::uint64_t>(random.one_of(1000))});
      const Vec3 sweep = larger_size(c) * random.power_of_ten(-1, 2) * random.direction();
      c = with_a_moved(c, -random.uniform(0, 1) * sweep);
      const Cast one = cast(c, sweep), other = cast(exchanged(c), -sweep);
      RC_ASSERT(one.status == other.status);
      RC_ASSERT(one.fraction == other.fraction);
      RC_ASSERT(one.normal == Vec3(-other.normal));
    }));
  }
}

TEST(CastLaw, BothBodiesAndTheSweepTurnedAlikeTouchAlike) {
  expect_of_every_pair([](const Configuration& c, const Vec3& sweep) {
    const Eigen::Quaterniond turn(1, 2, -3, 4);
    const Eigen::Quaterniond unit = turn.normalized();
    const Vec3 turned_sweep = unit * sweep;
    const Cast found = cast(c, sweep), turned = cast(rotated(c, unit), turned_sweep);
    // Turning rounds positions, which are much larger than the bodies' distance when A is far.
    const double rounding = 1e-15 * (c.pose_a.position().norm() + c.pose_b.position().norm());
    const double tolerance = 4 * tolerance_after(c, sweep, found.fraction) + 4 * rounding;
    const auto touches_at = [&](double t) {
      return std::abs(distance_after(c, sweep, t)) <= tolerance;
    };
    if (found.status == CastStatus::touch && turned.status == CastStatus::touch) {
      RC_ASSERT(touches_at(turned.fraction));
    } else if (found.status == CastStatus::never && turned.status == CastStatus::touch) {
      RC_ASSERT(touches_at(turned.fraction));
    } else if (found.status == CastStatus::touch && turned.status == CastStatus::never) {
      for (int i = 0; i <= 64; ++i) {
        const double t = found.fraction + (1 - found.fraction) * i / 64;
        RC_ASSERT(distance_after(c, sweep, t) >= -tolerance);
      }
    }
  });
}

}  // namespace
}  // namespace touchstone
