// How far a cylinder may move: known on paper, against the truth, and through thin bodies.
//
// TOUCHSTONE_COUNT sets how many random sweeps of each pair are held against the truth, by default
// 200.
#include "reference/cast.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "oracle/hull.hpp"
#include "reference/error_of_test.hpp"
#include "reference/first_zero.hpp"
#include "reference/invalid_input.hpp"
#include "reference/random_bodies_test.hpp"
#include "reference/random_casts_test.hpp"

namespace touchstone {
namespace {

const Eigen::Quaterniond not_turned = Eigen::Quaterniond::Identity();

/// A few roundings of a number of about one.
constexpr double on_paper = 4e-15;

TEST(Cast, ACanIsLetDownOntoEveryShape) {
  // Of 1 m half length, from 5 m, by 4 m: each body reaches up to z = 1.
  const Cylinder can(0.5, 1);
  const Convex tip =
      oracle::convex_hull(std::vector<Vec3>{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}, {0, 0, 1}});
  const Shape bodies[] = {Plane({0, 0, 2}, 2), Sphere(1),          Capsule(0.5, 0.5),
                          Cylinder(2, 1),      Box({0.5, 0.5, 1}), tip};
  for (const Shape& b : bodies) {
    SCOPED_TRACE(shape_name(b));
    const Cast found = cast(can, Pose({0, 0, 5}, not_turned), {0, 0, -4}, b, Pose());
    EXPECT_EQ(found.status, CastStatus::touch);
    EXPECT_NEAR(found.fraction, 0.75, on_paper);
    EXPECT_NEAR(found.normal.z(), 1, on_paper);
  }
}

TEST(Cast, ARimPassesASphereWithinTheSweepOrNot) {
  // The rim's lowest point moves along x at the height 0.5 above the middle of a unit sphere.
  const Cylinder coin(0.5, 0.25);
  const auto found = [&](double length) {
    return cast(coin, Pose({-5.5, 0, 0.75}, not_turned), {length, 0, 0}, Sphere(1), Pose());
  };
  const double until = 5 - std::sqrt(0.75);
  EXPECT_EQ(found(8).status, CastStatus::touch);
  EXPECT_NEAR(found(8).fraction, until / 8, on_paper);
  EXPECT_NEAR(found(8).normal.x(), -std::sqrt(0.75), on_paper);
  EXPECT_EQ(found(until - 1e-12).status, CastStatus::never);
  EXPECT_EQ(found(until - 1e-12).fraction, 1);
  EXPECT_EQ(found(-8).status, CastStatus::never);
}

TEST(Cast, FromInsideAndFromATouchNothingMoves) {
  const Cylinder can(0.5, 1);
  for (const double height : {0.0, 0.5, 1.5, 2.0}) {
    const Cast found = cast(can, Pose({0, 0, height}, not_turned), {0, 0, 7}, Sphere(1), Pose());
    EXPECT_EQ(found.status, CastStatus::from_start) << height;
    EXPECT_EQ(found.fraction, 0);
    EXPECT_NEAR(found.normal.norm(), 1, on_paper);
  }
}

TEST(Cast, WithoutASweepApartStaysApart) {
  const Cylinder can(0.5, 1);
  const auto status = [&](double height) {
    return cast(can, Pose({0, 0, height}, not_turned), Vec3::Zero(), Sphere(1), Pose()).status;
  };
  EXPECT_EQ(status(2), CastStatus::from_start);
  EXPECT_EQ(status(2 + 1e-15), CastStatus::never);
}

TEST(Cast, ASweepMayEndInATouch) {
  const Cylinder can(0.5, 1);
  for (const double from : {3.0, 2.1, 2.3, 1e6}) {
    const Cast found =
        cast(can, Pose({0, 0, from}, not_turned), {0, 0, 2 - from}, Box({1, 1, 1}), Pose());
    EXPECT_EQ(found.status, CastStatus::touch) << from;
    EXPECT_NEAR(found.fraction, 1, on_paper) << from;
  }
}

TEST(Cast, SlidesAlongAFloorWithoutTouchingIt) {
  const Cylinder can(0.5, 1);
  const Plane floor({0, 0, 1}, 0);
  const auto status = [&](double height, double down) {
    return cast(can, Pose({-3, 0, 1 + height}, not_turned), {6, 0, -down}, floor, Pose()).status;
  };
  EXPECT_EQ(status(0, 0), CastStatus::from_start);
  EXPECT_EQ(status(1e-13, 0), CastStatus::never);
  EXPECT_EQ(status(1e-9, 1e-8), CastStatus::touch);
  EXPECT_EQ(status(1e-8, 1e-9), CastStatus::never);
}

TEST(Cast, NothingIsTooThinForAnyLengthOfSweep) {
  // A coin's cap meets a coin, a needle and a sheet in the middle of the way.
  const double thin = 1e-9;
  const Cylinder coin(0.5, thin);
  const Convex sheet = oracle::convex_hull(std::vector<Vec3>{{-1, -1, 0}, {1, -1, 0}, {0, 2, 0}});
  const Shape bodies[] = {Cylinder(0.5, thin), Cylinder(thin, 3), Capsule(thin, 3),
                          Sphere(thin),        Box({1, 1, thin}), sheet};
  Random random(1);
  for (const Shape& b : bodies) {
    for (double length = 10; length <= 1e6; length *= 10) {
      for (int i = 0; i < 20; ++i) {
        // Both turned as they like, towards the other's middle and half as far again.
        const Vec3 way = length * random.direction();
        const Configuration c{coin, Pose(-way, random.turn()), b,
                              Pose(Vec3::Zero(), random.turn())};
        const Cast found = cast(c, 1.5 * way);
        ASSERT_EQ(found.status, CastStatus::touch) << shape_name(b) << " from " << length;
        const Configuration there = swept(c, Sweep(1.5 * way), found.fraction);
        EXPECT_LE(std::abs(signed_distance(there).value), 1e-14 + 0x1p-51 * length);
      }
    }
  }
}

TEST(Cast, GrazesWithinRounding) {
  // A lying can passes above a sphere; by how much is lost at 1e-15 and told at 1e-12.
  const Cylinder can(0.5, 1);
  const Pose lying(Vec3::Zero(), Eigen::Quaterniond(1, 1, 0, 0));  // along -y
  const auto found = [&](double above) {
    return cast(can, Pose({-4, 0, 1.5 + above}, lying.orientation()), {9, 0, 0}, Sphere(1), Pose());
  };
  for (const double above : {1e-12, 1e-9, 1e-3}) {
    EXPECT_EQ(found(above).status, CastStatus::never) << above;
    const Cast below = found(-above);
    EXPECT_EQ(below.status, CastStatus::touch) << above;
    const Configuration c{can, Pose({-4, 0, 1.5 - above}, lying.orientation()), Sphere(1), Pose()};
    const double left = signed_distance(swept(c, Sweep({9, 0, 0}), below.fraction)).value;
    EXPECT_LE(std::abs(left), 1e-14) << above;
  }
  for (const double above : {0.0, 1e-15, -1e-15}) {
    if (found(above).status == CastStatus::never) continue;
    EXPECT_NEAR(found(above).fraction, 4.0 / 9, 1e-6) << above;
  }
}

TEST(Cast, FromFarAwayGrazesWithinRounding) {
  // An upright can passes a ball askew to the axes, its path known to 1e-16 m, though differences
  // of the positions are rounded by 1e-10 m.
  const Cylinder can(0.5, 1);
  constexpr double far = 0x1p20, x = 0.1, y = 2.3;
  const double beside = (y - x) / std::numbers::sqrt2;
  for (const double nearer : {1e-12, -1e-12}) {
    const Cast found = cast(can, Pose({-far, -far, 0}, not_turned), {2 * far, 2 * far, 0},
                            Sphere(beside - can.radius() + nearer), Pose({x, y, 0}, not_turned));
    EXPECT_EQ(found.status, nearer > 0 ? CastStatus::touch : CastStatus::never) << nearer;
  }
}

/// What a search finds, and how many moments it asks about.
struct CountedSearch {
  FirstZero end;
  int moments;
};
template <class At>
CountedSearch count_moments(At at) {
  int moments = 1;
  const auto counted = [&](double t) { return ++moments, at(t); };
  const FirstZero end = FirstZeroSearch(at(0)).find(counted);
  return {end, moments};
}

TEST(Cast, AGrazeTakesFewMoments) {
  // Distances that are lowest at t = 0.7: as a ball passes, a ball that then slides along a face, a
  // flatter body, and an edge. Tangents alone halve the way to the first, and take 26 moments.
  struct Graze {
    const char* name;
    double (*height)(double x);
    double (*slope)(double x);
  };
  const Graze grazes[] = {
      {"square", [](double x) { return x * x; }, [](double x) { return 2 * x; }},
      {"flat", [](double x) { return x < 0 ? x * x : 0; },
       [](double x) { return x < 0 ? 2 * x : 0; }},
      {"fourth power", [](double x) { return x * x * x * x; },
       [](double x) { return 4 * x * x * x; }},
      {"edge", [](double x) { return std::abs(x); }, [](double x) { return x < 0 ? -1.0 : 1.0; }}};
  for (const Graze& graze : grazes) {
    for (const double lower : {0.0, 1e-15, -1e-15, 1e-12, -1e-12, 1e-6, -1e-6, 0.1, -0.1}) {
      SCOPED_TRACE(testing::Message() << graze.name << ", lowest at " << lower);
      const auto [end, moments] = count_moments([&](double t) -> Moment {
        const double height = graze.height(t - 0.7) + lower;
        return {t, {4 * height, Vec3::UnitX()}, height, graze.slope(t - 0.7), 1};
      });
      constexpr double rounding = 1e-14;
      if (std::abs(lower) > rounding) {
        EXPECT_EQ(end.is_reached, lower < 0);
      }
      if (end.is_reached) {
        EXPECT_LE(std::abs(end.at.height), rounding);
        EXPECT_LE(end.at.t, 0.7 + 1e-3);  // where the fourth power is rounding
      }
      EXPECT_LE(moments, 18);
    }
  }
}

/// The parts of themselves by which heights are wrong, less than what rounding may make.
constexpr double wrong_by[] = {0, 0x1p-48, -0x1p-48};

TEST(Cast, AMissIsToldFromWhereAIsNearest) {
  // A ball passes another by `gap`; the normal's rounding leaves a slope, along which the next
  // moment is a kilometre away, where the height is wrong by 6e-12 m: rounding may make 2e-11.
  for (const double gap : {8e-12, 4e-12, 2e-12, 1.1e-12}) {
    for (const double part : wrong_by) {
      const auto at = [&](double t) -> Moment {
        const double along = 16e3 * (t - 0.5), apart = std::hypot(25 + gap, along);
        const double height = (1 + part) * (apart - 25);
        return {t, {height, Vec3::UnitX()}, height / 4, 4e3 * along / apart, 60 + 2 * apart};
      };
      Moment nearest = at(0.5);
      for (const double slope : {-2.5e-11, -1e-11, -5e-12}) {
        nearest.slope = slope;
        EXPECT_FALSE(FirstZeroSearch(nearest).find(at).is_reached)
            << "by " << gap << ", part " << part << ", slope " << slope;
      }
    }
  }
}

TEST(Cast, AMissIsToldFromFarAway) {
  // A comes from 35 km, whose rounding is that of 2e-10 m, and then slides along a face 1e-10 m
  // above it, where rounding leaves a slope that rises.
  const auto at = [](double t) -> Moment {
    const double left = 35e3 * (0.99998 - t);
    const bool is_sliding = left < 1e-10;
    const double height = is_sliding ? 1e-10 : left, slope = is_sliding ? 5e-14 : -35e3;
    return {t, {height, Vec3::UnitX()}, height / 4, slope / 4, 2 + 2 * std::abs(left)};
  };
  const auto [end, moments] = count_moments(at);
  EXPECT_FALSE(end.is_reached);
  EXPECT_LE(moments, 10);
}

TEST(Cast, AnEdgeFromFarAwayIsTouchedOrNot) {
  // A comes from 35 km, where the height may be wrong by 1.2e-10 m, and leaves as steeply. The
  // first moment is one on the way out.
  for (const double lowest : {-2e-11, -1e-11, 1e-11, 2e-11}) {
    for (const double part : wrong_by) {
      const auto at = [&](double t) -> Moment {
        const double left = 35e3 * (0.75 - t);
        const double height = (1 + part) * std::abs(left) + lowest, slope = left > 0 ? -35e3 : 35e3;
        return {t, {height, Vec3::UnitX()}, height / 4, slope / 4, 2 + 2 * std::abs(left)};
      };
      EXPECT_EQ(FirstZeroSearch(at(0)).find(at).is_reached, lowest < 0)
          << "lowest " << lowest << ", part " << part;
    }
  }
}

TEST(Cast, AnEdgeOnTheWayOutIsNoTouch) {
  // A starts above an edge, where rounding leaves a slope along which the next moment is 29 km
  // away.
  for (const double lowest : {1e-11, 1e-12}) {
    for (const double part : wrong_by) {
      const double fall = -1.2 * lowest;
      const auto at = [&](double t) -> Moment {
        const double height = (1 + part) * 35e3 * t + lowest, slope = t > 0 ? 35e3 : fall;
        return {t, {height, Vec3::UnitX()}, height / 4, slope / 4, 2 + 2 * 35e3 * t};
      };
      EXPECT_FALSE(FirstZeroSearch(at(0)).find(at).is_reached)
          << "lowest " << lowest << ", part " << part;
    }
  }
}

TEST(Cast, PassesNoEdgeBehindACurve) {
  // A is in B from t = `in` to `out`, and where it leaves rounding makes a zero of the height.
  // Parabolas lead past that, since the curvature falls from a third power on.
  Random random(11);
  constexpr int count = 2000;
  for (int i = 0; i < count; ++i) {
    SCOPED_TRACE(i);
    const double in = random.uniform(0.3, 0.9), bend = random.uniform(0, 20);
    const double fall = random.power_of_ten(-2, 0);
    const double rise = random.power_of_ten(-2, 0);
    const double out = in + random.power_of_ten(-11, -6), third = random.uniform(0, 100);
    const auto end = count_moments([&](double t) -> Moment {
                       const double x = std::max(in - t, 0.0), leaving = rise * (t - out) - 1e-17;
                       const double coming = fall * (in - t) + x * x * (bend + third * x);
                       const double height = std::max(coming, leaving);
                       const double slope =
                           coming < leaving ? rise : -fall - x * (2 * bend + 3 * third * x);
                       return {t, {4 * height, Vec3::UnitX()}, height, slope, 1};
                     }).end;
    ASSERT_TRUE(end.is_reached);
    EXPECT_LE(end.at.t, in + 1e-14 / fall);
  }
}

TEST(Cast, RefusesASweepThatIsNotFinite) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const auto error = [](const Vec3& sweep) {
    return error_text_of([&] { cast(Cylinder(1, 1), Pose(), sweep, Sphere(1), Pose()); });
  };
  EXPECT_EQ(error({0, infinite, 0}), "sweep is not finite: must be finite");
  EXPECT_EQ(error({NAN, 0, 0}), error({0, infinite, 0}));
  EXPECT_THROW(Sweep({0, infinite, 0}), InvalidInput);
  EXPECT_THROW(Sweep({0, 0, 0}, {NAN, 0, 0}), InvalidInput);
}

TEST(Cast, AnyFiniteNumbersAreAnswered) {
  constexpr double huge = std::numeric_limits<double>::max();
  constexpr double least = std::numeric_limits<double>::denorm_min();
  const double numbers[] = {0, -1, 1e-300, -1e300, huge, -huge, least};
  const Cylinder can(0.5, 1);
  for (const double x : numbers) {
    for (const double y : numbers) {
      const Cast found = cast(can, Pose({x, y, 3}, not_turned), {y, -x, -4}, Box({1, 1, 1}),
                              Pose({y, 0, x}, not_turned));
      EXPECT_TRUE(found.fraction >= 0 && found.fraction <= 1) << x << ' ' << y;
      EXPECT_TRUE(found.normal.allFinite()) << x << ' ' << y;
    }
  }
  for (const double size : {1e-200, 1e200}) {
    const Cast found = cast(Cylinder(size, size), Pose({0, 0, 5 * size}, not_turned),
                            {0, 0, -4 * size}, Sphere(size), Pose());
    EXPECT_EQ(found.status, CastStatus::touch);
    EXPECT_NEAR(found.fraction, 0.75, on_paper);
  }
}

TEST(Cast, OfABatchIsThatOfEachPair) {
  Random random(2);
  const Cylinder can(0.4, 0.9);
  const Box box({0.3, 0.7, 1.1});
  std::vector<Pose> poses_a, poses_b;
  std::vector<Vec3> sweeps;
  for (int i = 0; i < 40; ++i) {
    poses_a.emplace_back(3 * random.direction(), random.turn());
    poses_b.emplace_back(random.uniform(0, 1) * random.direction(), random.turn());
    sweeps.push_back(6 * random.direction());
  }
  std::vector<Cast> results(40);
  cast(can, poses_a, sweeps, box, poses_b, results);
  for (std::size_t i = 0; i < results.size(); ++i) {
    const Cast one = cast(can, poses_a[i], sweeps[i], box, poses_b[i]);
    EXPECT_EQ(results[i].status, one.status);
    EXPECT_EQ(results[i].fraction, one.fraction);
    EXPECT_EQ(results[i].normal, one.normal);
  }
  sweeps.pop_back();
  EXPECT_THROW(cast(can, poses_a, sweeps, box, poses_b, results), InvalidInput);
}

class CastOf : public testing::TestWithParam<Pair> {};

TEST_P(CastOf, RandomSweepsIsWithinRoundingOfTheTruth) {
  Random random(static_cast<std::uint64_t>(GetParam()) + 3);
  const std::uint64_t count = tried_of_each(200);
  HeldCasts casts;
  int all_moments = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    const CastIdentity identity = any_cast(GetParam(), random);
    SCOPED_TRACE(to_string(identity));
    const auto [c, sweep] = make_cast(identity);
    const Cast found = casts.hold(c, sweep);
    const Vec3 offset = c.pose_a.position() - c.pose_b.position();
    const int moments = count_moments([&](double t) -> Moment {
                          Configuration at = c;
                          at.pose_a = Pose(offset + t * sweep, c.pose_a.orientation());
                          at.pose_b = Pose(Vec3::Zero(), c.pose_b.orientation());
                          const SignedDistance d = signed_distance(at);
                          return {t, d, d.value / 4, d.normal.dot(sweep) / 4,
                                  size_of(c) + at.pose_a.position().norm()};
                        }).moments;
    constexpr int max_moments = 114;  // proofs.md, "The first touch"
    if (found.status != CastStatus::from_start) {
      EXPECT_LE(moments, max_moments);
      all_moments += moments;
    }
  }
  EXPECT_LT(all_moments, static_cast<int>(3 * count));
  EXPECT_GT(casts.touches, static_cast<int>(count / 10)) << "too few of the sweeps touch";
  EXPECT_GT(casts.nevers, static_cast<int>(count / 20)) << "too few of the sweeps miss";
}

/// A sweep that comes as near as `gap` to the body, or goes on into it, mostly all but along its
/// surface; and that ends there, or before or after it.
Vec3 graze(Configuration& c, double gap, Random& random) {
  const SignedDistance at = signed_distance(c);
  const Vec3 nearest = c.pose_a.position() + (gap - at.value) * at.normal;
  Vec3 way = random.direction();
  way -= way.dot(at.normal) * at.normal;
  if (random.one_of(4) > 0) {
    way -= (random.toss() ? 0 : random.power_of_ten(-16, 0)) * way.norm() * at.normal;
  }
  way.normalize();
  const double length = size_of(c) * random.power_of_ten(random.toss() ? -3 : -17, 5);
  const double end = random.toss() ? 1 + random.sign() * random.power_of_ten(-16, 0) : 2;
  c.pose_a = Pose(nearest - length * way, c.pose_a.orientation());
  return end * length * way;
}

TEST_P(CastOf, GrazesIsWithinRoundingOfTheTruth) {
  Random random(static_cast<std::uint64_t>(GetParam()) + 57);
  const std::uint64_t count = tried_of_each(200);
  HeldCasts casts;
  for (std::uint64_t i = 0; i < count; ++i) {
    const Identity pose = any_cast(GetParam(), random).pose;
    SCOPED_TRACE(testing::Message() << i << ' ' << to_string(pose));
    Configuration c = make_configuration(pose);
    const double gap =
        random.one_of(3) == 0 ? 0 : random.sign() * size_of(c) * random.power_of_ten(-16, 0);
    const Vec3 sweep = graze(c, gap, random);
    casts.hold(c, sweep);
  }
  EXPECT_GT(casts.touches, static_cast<int>(count / 10));
  EXPECT_GT(casts.nevers, static_cast<int>(count / 10));
}

INSTANTIATE_TEST_SUITE_P(Pairs, CastOf, testing::ValuesIn(all_pairs), name_of_other);

}  // namespace
}  // namespace touchstone
