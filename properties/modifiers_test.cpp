// Modifiers, by what they do to configurations.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <utility>

#include "oracle/truth.hpp"
#include "properties/pose_classes_test.hpp"

namespace touchstone {
namespace {

TEST(Modifiers, ClearancesAreMetExactlyOnALattice) {
  const auto distance = [](Pair pair, const std::string& name, std::uint64_t i) {
    const Configuration c = make_configuration({pair, name, 1, i});
    const auto t = oracle::truth(c, 1e-40);
    if (name.ends_with("+touching")) {
      EXPECT_LE(t.signed_distance.lo, 0) << pair_name(pair) << " " << name;
      EXPECT_GE(t.signed_distance.hi, 0) << pair_name(pair) << " " << name;
    }
    return t.signed_distance.midpoint() / smaller_size(c);
  };
  for (const Pair pair : all_pairs) {
    for (const Arrangement& a : arrangements(pair)) {
      if (a.orientations != Arrangement::Orientations::exact || a.clearances.empty()) continue;
      int deep = 0;
      constexpr std::uint64_t count = 16;
      const std::string apart = a.own == Clearance::apart ? a.name : a.name + "+apart";
      for (std::uint64_t i = 0; i < count; ++i) {
        if (has_class(pair, a.name + "+touching")) distance(pair, a.name + "+touching", i);
        EXPECT_GE(distance(pair, apart, i), 1e-7) << pair_name(pair) << " " << a.name;
        if (!has_class(pair, a.name + "+deep")) continue;
        const double depth = -distance(pair, a.name + "+deep", i);
        EXPECT_GE(depth, 0.01) << pair_name(pair) << " " << a.name << " " << i;
        deep += depth > 0.0999;
      }
      // Another feature may be nearer, where the bodies lie beside each other.
      if (has_class(pair, a.name + "+deep")) {
        EXPECT_GE(deep, static_cast<int>(count) / 2) << pair_name(pair) << " " << a.name;
      }
    }
  }
}

/// What the modifier of the frame makes of a configuration, whose distance it keeps up to rounding,
/// and the configuration without it.
struct Reframed {
  Configuration now, before;
};
Reframed expect_kept_distance(Pair pair, const std::string& name, const char* frame,
                              std::uint64_t i, double rounding_of_frame) {
  const Identity id{pair, name + frame, 1, i};
  std::vector<std::uint64_t> tape;
  const Configuration now = make_configuration(id, tape);
  const Configuration before = make_configuration({pair, name, 1, i}, tape);
  const auto distance = [](const Configuration& c) {
    return oracle::truth(c).signed_distance.midpoint();
  };
  EXPECT_NEAR(distance(now), distance(before), rounding_of_frame) << to_string(id);
  EXPECT_NEAR(now.pose_a.orientation().norm(), 1, 1e-15) << to_string(id);
  EXPECT_NEAR(now.pose_b.orientation().norm(), 1, 1e-15) << to_string(id);
  return {now, before};
}

TEST(Modifiers, TurnedKeepsTheDistanceAndForgetsTheFrame) {
  for (const char* name : {"perpendicular-t", "cap-on-cap-offset", "coaxial", "touching"}) {
    for (std::uint64_t i = 0; i < samples; ++i) {
      const auto [turned, before] = expect_kept_distance(Pair::cylinder, name, "+turned", i, 1e-14);
      EXPECT_GT((turned.pose_a.position() - before.pose_a.position()).norm(), 1e-3);
    }
  }
}

// `turned` gives bodies of the same orientation the same rounding: they stay exactly parallel.
TEST(Modifiers, WornRoundsEachBodyByItself) {
  constexpr double most = 1e-12;  // a thousand steps there and back, each rounded by 1e-15 at most
  for (const Pair pair : {Pair::capsule, Pair::cylinder, Pair::box}) {
    int parallel = 0, decades[4] = {};
    constexpr std::uint64_t count = 10 * samples;
    for (std::uint64_t i = 0; i < count; ++i) {
      EXPECT_TRUE(exactly_parallel(make_configuration({pair, "diagonal+turned", 1, i})));
      const Configuration c = make_configuration({pair, "diagonal+worn", 1, i});
      const double sine = axis_angle(c).sine;
      EXPECT_LE(sine, most) << i;
      parallel += sine == 0;
      double lower = 1e-17;
      for (int& in_decade : decades) {
        in_decade += sine > lower && sine <= 10 * lower;
        lower *= 10;
      }
    }
    int apart = 0;
    for (std::uint64_t i = 0; i < samples; ++i) {
      const Configuration c = make_configuration({pair, "concentric-aligned+worn", 1, i});
      const double between = (c.pose_a.position() - c.pose_b.position()).norm();
      EXPECT_LE(between, most) << i;
      apart += between > 0;
    }
    EXPECT_GT(apart, static_cast<int>(samples) / 2);
    EXPECT_LT(parallel, static_cast<int>(count) / 10);
    EXPECT_GT(decades[1], static_cast<int>(count) / 4) << "1e-16 to 1e-15";
    EXPECT_GT(decades[2], static_cast<int>(count) / 20) << "1e-15 to 1e-14";
  }
}

TEST(Modifiers, WornKeepsTheDistanceOfEveryExactArrangement) {
  constexpr double rounding_of_steps = 1e-12;
  for (const Pair pair : all_pairs) {
    for (const Arrangement& a : arrangements(pair)) {
      if (!a.is_exact()) continue;
      for (std::uint64_t i = 0; i < 4; ++i) {
        expect_kept_distance(pair, a.name, "+worn", i, rounding_of_steps);
      }
    }
  }
}

TEST(Modifiers, NeedlesAreBothOfAThousandToOne) {
  expect_of_each({Pair::capsule, Pair::cylinder},
                 {"general+needles", "parallel-side+needles", "contained+needles"},
                 [](const Configuration& c, Pair) {
                   const Vec3 half = half_extents_of_b(c);
                   EXPECT_NEAR(c.a.half_length() / c.a.radius(), 1000, 0.2);
                   EXPECT_NEAR(half.z() / half.x(), 1000, 0.2);
                 });
}

// They meet where their sides cross, or one's end meets the other's side.
TEST(Modifiers, TiltedNeedlesCrossAtAMilliradian) {
  constexpr double across = 1e-6;  // sine; at an end, a needle is met at a slant
  for (const Pair pair : {Pair::capsule, Pair::cylinder}) {
    int crossing = 0;
    expect_of_each({pair}, {"parallel-side+needles+tilted-1e-3"},
                   [&](const Configuration& c, Pair) {
                     EXPECT_NEAR(axis_angle(c).sine, 1e-3, 1e-6);
                     const Vec3 n = oracle::truth(c).normals.front().n;
                     crossing += std::abs(n.dot(c.pose_a.rotation().col(2))) < across &&
                                 std::abs(n.dot(c.pose_b.rotation().col(2))) < across;
                   });
    EXPECT_GT(crossing, static_cast<int>(samples) / 8) << pair_name(pair);
  }
}

TEST(Modifiers, ScalesLeaveExactArrangementsExact) {
  for (const char* scale : {"+tiny", "+huge"}) {
    for (std::uint64_t i = 0; i < samples; ++i) {
      const Identity id{Pair::capsule, std::string("touching") + scale, 1, i};
      const Configuration c = make_configuration(id);
      const auto t = oracle::truth(c, 1e-40);
      EXPECT_LE(t.signed_distance.lo, 0) << to_string(id);
      EXPECT_GE(t.signed_distance.hi, 0) << to_string(id);
      const double size = smaller_size(c) * (scale[1] == 't' ? 1e6 : 1e-6);
      EXPECT_GT(size, 0.1);
      EXPECT_LT(size, 1.1);
    }
  }
}

TEST(Modifiers, ProportionsAreWhatTheirNamesSay) {
  // Sizes on a lattice are rounded to its steps.
  for (const auto& [arrangement, rounding_of_ratio] :
       {std::pair("general", 1e-9), std::pair("side-on-face", 0.2)}) {
    int bars = 0, plates = 0;
    for (std::uint64_t i = 0; i < samples; ++i) {
      const auto made = [i, name = std::string(arrangement)](const char* proportions) {
        return make_configuration({Pair::box, name + proportions, 1, i});
      };
      const Cylinder needle = made("+needle").a, coin = made("+coin").a;
      EXPECT_NEAR(needle.half_length() / needle.radius(), 1000, rounding_of_ratio);
      EXPECT_NEAR(coin.radius() / coin.half_length(), 1000, rounding_of_ratio);
      const Vec3 plate = std::get<Box>(made("+plate").b).half_extents();
      EXPECT_NEAR(plate.maxCoeff() / plate.minCoeff(), 1000, rounding_of_ratio);
      const auto thin = (plate.array() < plate.maxCoeff() / 2).count();
      bars += thin == 2;
      plates += thin == 1;
      const Configuration uneven = made("+uneven");
      const double ratio = std::max(uneven.a.radius() / std::get<Box>(uneven.b).half_extents().x(),
                                    std::get<Box>(uneven.b).half_extents().x() / uneven.a.radius());
      EXPECT_GE(ratio, 100 / 5.01);
      EXPECT_LE(ratio, 1000 * 5.01);
    }
    EXPECT_EQ(bars + plates, static_cast<int>(samples));
    EXPECT_GT(bars, 5);
    EXPECT_GT(plates, 5);
  }
}

TEST(Modifiers, LengthsOfQuaternionsAreOffByWhatAnIntegratorLeaves) {
  expect_of_each({Pair::capsule}, {"general+not-quite-unit"}, [](const Configuration& c, Pair) {
    for (const Pose& pose : {c.pose_a, c.pose_b}) {
      EXPECT_LE(std::abs(pose.orientation().norm() - 1), 1.01e-7);
    }
  });
}

TEST(Modifiers, FarIsAMillionMetresAway) {
  const Configuration c = make_configuration({Pair::box, "side-on-face+turned+far", 1, 0});
  EXPECT_NEAR(c.pose_a.position().norm(), 1e6, 10);
  EXPECT_LT((c.pose_a.position() - c.pose_b.position()).norm(), 10);
}

}  // namespace
}  // namespace touchstone
