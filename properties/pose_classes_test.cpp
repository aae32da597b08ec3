// The promises of each pose class: relations of axes in rational arithmetic, distances by the
// oracle.
#include <algorithm>
#include <array>
#include <cmath>
#include <gmpxx.h>
#include <gtest/gtest.h>
#include <set>

#include "oracle/truth.hpp"
#include "properties/pose_class.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

TEST(PoseClasses, AreNamedOnceAndDescribedInASentence) {
  for (const Pair pair : all_pairs) {
    std::set<std::string> names;
    for (const auto& name : pose_classes(pair)) {
      EXPECT_TRUE(names.insert(name).second) << name;
      const auto text = PoseClass(pair, name).description();
      EXPECT_GT(text.size(), 20u);
      EXPECT_EQ(text.back(), '.') << name;
    }
  }
}

// Shapes and poses reject numbers that are not finite, so that constructing them is the test.
TEST(PoseClasses, MakeValidConfigurationsOfTheirPair) {
  for (const Pair pair : all_pairs) {
    for (const auto& name : pose_classes(pair)) {
      for (std::uint64_t i = 0; i < 50; ++i) {
        const Identity id{pair, name, 1, i};
        ASSERT_NO_THROW(ASSERT_EQ(pair_of(make_configuration(id)), pair)) << to_string(id);
      }
    }
  }
}

bool has_class(Pair pair, const std::string& name) {
  return !selected_classes(pair, {.names = {name}}).empty();
}

constexpr std::uint64_t samples = 40;

TEST(PoseClasses, TouchingIsZeroToTheLastBit) {
  constexpr double width = 1e-40;  // no clearance of two doubles is as small as that
  for (const Pair pair : all_pairs) {
    for (const char* name : {"touching", "touching-tilted"}) {
      for (std::uint64_t i = 0; i < 2 * samples; ++i) {
        const Identity id{pair, name, 1, i};
        const auto t = oracle::truth(make_configuration(id), width);
        EXPECT_LE(t.signed_distance.lo, 0) << to_string(id);
        EXPECT_GE(t.signed_distance.hi, 0) << to_string(id);
      }
    }
  }
}

/// Signed distance over the smaller size.
struct Range {
  const char* name;
  double lo, hi;
};

// Coordinates of a few metres against sizes of 0.2 m lose 1e-15 of a size, and needles and coins a
// thousand times more; 1e-9 covers them and is far below the smallest clearance, 1e-6.
constexpr double rounding = 1e-9;
constexpr double most_shallow = -0.05 - rounding;
constexpr double most_apart = 1 + rounding;

class DistanceOfClass : public testing::TestWithParam<Range> {};

TEST_P(DistanceOfClass, IsWhatTheClassSays) {
  const auto& [name, lo, hi] = GetParam();
  int pairs = 0;
  for (const Pair pair : all_pairs) {
    if (!has_class(pair, name)) continue;
    ++pairs;
    for (std::uint64_t i = 0; i < samples; ++i) {
      const Identity id{pair, name, 1, i};
      const Configuration c = make_configuration(id);
      const double relative = oracle::truth(c).signed_distance.midpoint() / smaller_size(c);
      EXPECT_GE(relative, lo) << to_string(id);
      EXPECT_LE(relative, hi) << to_string(id);
    }
  }
  EXPECT_GT(pairs, 0) << "no pair has this class";
}

constexpr double any_depth = -1e6;

constexpr Range ranges[] = {
    {"general+apart", 1e-6 - rounding, most_apart},
    {"general+shallow", most_shallow, -1e-6 + rounding},
    {"general+deep", any_depth, -0.05},
    {"general+touching", -1e-13, 1e-13},
    {"concentric", any_depth, -1},
    {"concentric-aligned", any_depth, -1},
    {"coaxial", any_depth, 0},
    {"contained", any_depth, -0.1},
    // Clear of cap and side by up to 1 each.
    {"diagonal", 1e-6 - rounding, 1.42},
    {"diagonal+shallow", most_shallow, -1e-8},
    {"diagonal+deep", any_depth, -0.05},
    // Features that meet, three in four overlapping.
    {"rim-rim", most_shallow, most_apart},
    {"rim-side", most_shallow, most_apart},
    {"rim-face", most_shallow, most_apart},
    {"rim-end", 1e-6 - rounding, most_apart},
    {"cap-end", most_shallow, most_apart},
    {"side-end", most_shallow, most_apart},
    {"side-side", most_shallow, most_apart},
    {"side", most_shallow, most_apart},
    {"cap", most_shallow, most_apart},
    {"rim", most_shallow, most_apart},
    {"edge-side", most_shallow, most_apart},
    {"edge-cap", most_shallow, most_apart},
    {"edge-rim", most_shallow, most_apart},
    {"vertex-side", most_shallow, most_apart},
    {"vertex-cap", most_shallow, most_apart},
    {"vertex-rim", most_shallow, most_apart},
    // Exactly aligned bodies always overlap, by at least a step of their lattice.
    {"parallel-side", most_shallow, -1e-8},
    {"perpendicular-t", most_shallow, -1e-8},
    {"perpendicular-x", most_shallow, -1e-8},
    {"cap-on-side", most_shallow, -1e-8},
    {"cap-on-axis", most_shallow, -1e-8},
    {"cap-on-end-centred", most_shallow, -1e-8},
    {"cap-on-end-offset", most_shallow, -1e-8},
    {"cap-on-cap-centred", most_shallow, -1e-8},
    {"cap-on-cap-offset", most_shallow, -1e-8},
    {"cap-on-face-centred", most_shallow, -1e-8},
    {"cap-on-face-offset", most_shallow, -1e-8},
    {"side-on-face", most_shallow, -1e-8},
    {"standing", most_shallow, -1e-8},
    {"lying", most_shallow, -1e-8},
    {"general+needle", most_shallow, most_apart},
    {"general+coin", most_shallow, most_apart},
    {"general+deep+needle", any_depth, -0.05},
    {"general+deep+coin", any_depth, -0.05},
    {"general+tiny", most_shallow, most_apart},
    {"general+huge", most_shallow, most_apart},
    // Positions of 1e6 m have a spacing of 1e-10 m.
    {"general+far", most_shallow - 1e-8, most_apart + 1e-8},
};

INSTANTIATE_TEST_SUITE_P(, DistanceOfClass, testing::ValuesIn(ranges), [](const auto& range) {
  std::string name = range.param.name;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '-' || c == '+'; }, '_');
  return name;
});

// Every old class is in the table above or has a test of its own.
TEST(PoseClasses, AllHaveATest) {
  std::set<std::string> tested = {"touching", "touching-tilted"};
  for (const Range& range : ranges) tested.insert(range.name);
  for (const Pair pair : all_pairs) {
    for (const PoseClass& c : old_classes(pair)) {
      const bool tilt = c.modifiers[ModifierKind::tilt] != 0;
      EXPECT_TRUE(tilt || tested.contains(c.name())) << pair_name(pair) << " " << c.name();
    }
  }
}

/// R(q) z times |q|², exactly.
std::array<mpq_class, 3> exact_axis(const Pose& pose) {
  const auto& q = pose.orientation();
  const mpq_class w(q.w()), x(q.x()), y(q.y()), z(q.z());
  return {2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z};
}

bool exactly_parallel(const Configuration& c) {
  const auto a = exact_axis(c.pose_a), b = exact_axis(c.pose_b);
  return a[1] * b[2] == a[2] * b[1] && a[2] * b[0] == a[0] * b[2] && a[0] * b[1] == a[1] * b[0];
}

bool exactly_perpendicular(const Configuration& c) {
  const auto a = exact_axis(c.pose_a), b = exact_axis(c.pose_b);
  return mpq_class(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) == 0;
}

TEST(PoseClasses, ParallelIsExact) {
  for (const Pair pair : {Pair::capsule, Pair::cylinder, Pair::box}) {
    for (const char* name :
         {"parallel-side", "coaxial", "concentric-aligned", "cap-on-end-centred",
          "cap-on-end-offset", "cap-on-cap-centred", "cap-on-cap-offset", "cap-on-face-centred",
          "cap-on-face-offset", "diagonal", "contained"}) {
      if (!has_class(pair, name)) continue;
      for (std::uint64_t i = 0; i < samples; ++i) {
        EXPECT_TRUE(exactly_parallel(make_configuration({pair, name, 1, i}))) << name << i;
      }
    }
  }
}

TEST(PoseClasses, PerpendicularIsExact) {
  for (const Pair pair : {Pair::capsule, Pair::cylinder, Pair::box}) {
    for (const char* name : {"perpendicular-t", "perpendicular-x", "cap-on-side", "side-on-face"}) {
      // The box's crossing edge is its y axis; its z axis is not perpendicular to A.
      if (!has_class(pair, name) || (pair == Pair::box && name == std::string("perpendicular-x"))) {
        continue;
      }
      for (std::uint64_t i = 0; i < samples; ++i) {
        EXPECT_TRUE(exactly_perpendicular(make_configuration({pair, name, 1, i}))) << name << i;
      }
    }
  }
}

TEST(PoseClasses, StandingAndLyingTieTheirPointsExactly) {
  for (std::uint64_t i = 0; i < samples; ++i) {
    EXPECT_TRUE(exactly_parallel(make_configuration({Pair::plane, "standing", 1, i})));
    EXPECT_TRUE(exactly_perpendicular(make_configuration({Pair::plane, "lying", 1, i})));
  }
}

/// Sine and cosine of the angle between the axes, each without cancellation.
struct AxisAngle {
  double sine, cosine;
};
AxisAngle axis_angle(const Configuration& c) {
  const auto a = exact_axis(c.pose_a), b = exact_axis(c.pose_b);
  const auto squared = [](const mpq_class& x, const mpq_class& y, const mpq_class& z) {
    return mpq_class(x * x + y * y + z * z);
  };
  const mpq_class lengths = squared(a[0], a[1], a[2]) * squared(b[0], b[1], b[2]);
  const mpq_class cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const mpq_class sine_squared =
      squared(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]) /
      lengths;
  const mpq_class cosine_squared = cosine * cosine / lengths;
  return {std::sqrt(sine_squared.get_d()), std::sqrt(cosine_squared.get_d())};
}

TEST(PoseClasses, TiltsAreWhatTheirNamesSay) {
  // Rounding of unit quaternions: 2 % of the smallest tilt that is tested, 1e-14.
  constexpr double rounding_of_axes = 1e-15;
  const auto expect_tilt = [](double actual, double tilt, double least, const Identity& id) {
    EXPECT_GE(actual, least * tilt - rounding_of_axes) << to_string(id);
    // The tilt's tangent is drawn, not its sine: 1e-1 is off by its third power.
    EXPECT_LE(actual, 1.01 * tilt + rounding_of_axes) << to_string(id);
  };
  for (const Pair pair : {Pair::plane, Pair::capsule, Pair::cylinder, Pair::box}) {
    for (int k = 1; k <= 14; ++k) {
      const double tilt = std::pow(10, -k);
      const std::string digits = "1e-" + std::to_string(k);
      for (std::uint64_t i = 0; i < samples; ++i) {
        // The plane's normal is the z axis of its body: lying is perpendicular to it.
        const bool plane = pair == Pair::plane;
        const Identity along{
            pair, plane ? "perpendicular+tilted-" + digits : "parallel+tilted-" + digits, 1, i};
        const Identity across{
            pair, plane ? "parallel+tilted-" + digits : "perpendicular+tilted-" + digits, 1, i};
        expect_tilt(axis_angle(make_configuration(along)).sine, tilt, 0.99, along);
        expect_tilt(axis_angle(make_configuration(across)).cosine, tilt, 0.49, across);
      }
    }
  }
}

TEST(PoseClasses, NearParallelAndNearPerpendicularMeet) {
  for (const Pair pair : {Pair::plane, Pair::capsule, Pair::cylinder, Pair::box}) {
    for (const char* name : {"parallel+tilted-1e-6", "perpendicular+tilted-1e-6"}) {
      int overlapping = 0;
      for (std::uint64_t i = 0; i < samples; ++i) {
        const Identity id{pair, name, 1, i};
        const Configuration c = make_configuration(id);
        const double relative = oracle::truth(c).signed_distance.midpoint() / smaller_size(c);
        EXPECT_LE(relative, most_apart + 1e-4) << to_string(id);  // the tilt lifts far ends
        overlapping += relative < 0;
      }
      EXPECT_GE(overlapping, static_cast<int>(samples) / 2) << pair_name(pair) << " " << name;
    }
  }
}

/// Local axis number i of a pose times |q|², exactly.
std::array<mpq_class, 3> exact_column(const Pose& pose, int i) {
  const auto& q = pose.orientation();
  const mpq_class w(q.w()), x(q.x()), y(q.y()), z(q.z());
  if (i == 0) return {w * w + x * x - y * y - z * z, 2 * (x * y + w * z), 2 * (x * z - w * y)};
  if (i == 1) return {2 * (x * y - w * z), w * w - x * x + y * y - z * z, 2 * (y * z + w * x)};
  return exact_axis(pose);
}

TEST(PoseClasses, CentredAndCoaxialCentresLieOnTheAxisExactly) {
  for (const Pair pair : {Pair::sphere, Pair::capsule, Pair::cylinder, Pair::box}) {
    for (const char* name : {"coaxial", "cap-on-axis", "cap-on-end-centred", "cap-on-cap-centred",
                             "cap-on-face-centred"}) {
      if (!has_class(pair, name)) continue;
      for (std::uint64_t i = 0; i < samples; ++i) {
        const Configuration c = make_configuration({pair, name, 1, i});
        for (int across = 0; across < 2; ++across) {
          const auto e = exact_column(c.pose_a, across);
          mpq_class offset = 0;
          for (std::size_t k = 0; k < 3; ++k) {
            const auto j = static_cast<Eigen::Index>(k);
            offset +=
                e[k] * (mpq_class(c.pose_a.position()[j]) - mpq_class(c.pose_b.position()[j]));
          }
          EXPECT_EQ(offset, 0) << pair_name(pair) << " " << name << " " << i;
        }
      }
    }
  }
}

/// Where A's centre lies from B's, along local axis number i of B, exactly.
mpq_class offset_along(const Configuration& c, int i) {
  const auto e = exact_column(c.pose_b, i);
  const auto& q = c.pose_b.orientation();
  const mpq_class w(q.w()), x(q.x()), y(q.y()), z(q.z());
  mpq_class offset = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto j = static_cast<Eigen::Index>(k);
    offset += e[k] * (mpq_class(c.pose_a.position()[j]) - mpq_class(c.pose_b.position()[j]));
  }
  return offset / (w * w + x * x + y * y + z * z);
}

/// B's half extents along its local axes; a capsule's without its round ends.
Vec3 half_extents_of_b(const Configuration& c) {
  if (const auto* s = std::get_if<Box>(&c.b)) return s->half_extents();
  if (const auto* s = std::get_if<Capsule>(&c.b)) {
    return {s->radius(), s->radius(), s->half_length()};
  }
  const auto& s = std::get<Cylinder>(c.b);
  return {s.radius(), s.radius(), s.half_length()};
}

TEST(PoseClasses, DiagonalBodiesLieBeyondCapAndSide) {
  for (const Pair pair : {Pair::capsule, Pair::cylinder, Pair::box}) {
    for (std::uint64_t i = 0; i < samples; ++i) {
      const Identity id{pair, "diagonal", 1, i};
      const Configuration c = make_configuration(id);
      const Vec3 half = half_extents_of_b(c);
      const double beside = mpq_class(abs(offset_along(c, 0))).get_d() - c.a.radius();
      const double above = mpq_class(abs(offset_along(c, 2))).get_d() - c.a.half_length();
      EXPECT_GT(above, half.z()) << to_string(id);
      // Beyond a capsule's segment, whose ball reaches out to the rim.
      EXPECT_GT(beside, pair == Pair::capsule ? 0 : half.x()) << to_string(id);
      const Vec3 n = oracle::truth(c).normals.front().n, axis = c.pose_a.rotation().col(2);
      constexpr double least = 1e-7;  // clearances are within 1:1e6 of each other
      EXPECT_GT(std::abs(n.dot(axis)), least) << to_string(id);
      EXPECT_GT(n.cross(axis).norm(), least) << to_string(id);
    }
  }
}

// Where axes coincide the opposite normal is as good, so that a reversed one does not show.
TEST(PoseClasses, ContainedBodiesComeFreeSidewaysInOneSense) {
  for (const Pair pair : {Pair::capsule, Pair::cylinder, Pair::box}) {
    int wider_a = 0;
    for (const char* proportions : {"", "+needle", "+coin", "+plate", "+uneven", "+needles"}) {
      const std::string name = std::string("contained") + proportions;
      if (!has_class(pair, name)) continue;
      for (std::uint64_t i = 0; i < samples; ++i) {
        const Identity id{pair, name, 1, i};
        const Configuration c = make_configuration(id);
        const Vec3 half = half_extents_of_b(c);
        const mpq_class x = offset_along(c, 0), y = offset_along(c, 1);
        wider_a += c.a.radius() > half.x();
        // A's axis runs through B, beside its middle.
        EXPECT_LT(abs(x), mpq_class(half.x())) << to_string(id);
        EXPECT_LT(abs(y), mpq_class(half.y())) << to_string(id);
        EXPECT_TRUE(x != 0 || y != 0) << to_string(id);
        const oracle::Truth t = oracle::truth(c);
        constexpr double rounding_of_axis = 1e-15;
        const Vec3 axis = c.pose_a.rotation().col(2);
        for (const auto& normal : t.normals) {
          EXPECT_LE(std::abs(normal.n.dot(axis)), rounding_of_axis) << to_string(id);
        }
        const double reversed = oracle::certified_gap(c, -t.normals.front().n).midpoint();
        EXPECT_LT(reversed, t.signed_distance.midpoint() - 1e-9 * larger_size(c)) << to_string(id);
      }
    }
    EXPECT_GT(wider_a, 20) << "B within A: " << pair_name(pair);
  }
}

TEST(PoseClasses, ExtremeAspectIsOneToAThousand) {
  for (std::uint64_t i = 0; i < samples; ++i) {
    const Cylinder needle = make_configuration({Pair::box, "general+needle", 1, i}).a;
    EXPECT_NEAR(needle.half_length() / needle.radius(), 1000, 1e-9);
    const Cylinder coin = make_configuration({Pair::box, "general+coin", 1, i}).a;
    EXPECT_NEAR(coin.radius() / coin.half_length(), 1000, 1e-9);
  }
}

// Modifiers, by what they do to configurations.

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

TEST(Modifiers, TurnedKeepsTheDistanceAndForgetsTheFrame) {
  for (const char* name : {"perpendicular-t", "cap-on-cap-offset", "coaxial", "touching"}) {
    for (std::uint64_t i = 0; i < samples; ++i) {
      const Identity id{Pair::cylinder, std::string(name) + "+turned", 1, i};
      std::vector<std::uint64_t> tape;
      const Configuration turned = make_configuration(id, tape);
      const Configuration before = make_configuration({Pair::cylinder, name, 1, i}, tape);
      const auto distance = [](const Configuration& c) {
        return oracle::truth(c).signed_distance.midpoint();
      };
      EXPECT_NEAR(distance(turned), distance(before), 1e-14) << to_string(id);
      EXPECT_NEAR(turned.pose_a.orientation().norm(), 1, 1e-15);
      EXPECT_NEAR(turned.pose_b.orientation().norm(), 1, 1e-15);
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
        const Identity id{pair, a.name + "+worn", 1, i};
        std::vector<std::uint64_t> tape;
        const Configuration worn = make_configuration(id, tape);
        const Configuration before = make_configuration({pair, a.name, 1, i}, tape);
        const auto distance = [](const Configuration& c) {
          return oracle::truth(c).signed_distance.midpoint();
        };
        EXPECT_NEAR(distance(worn), distance(before), rounding_of_steps) << to_string(id);
        EXPECT_NEAR(worn.pose_a.orientation().norm(), 1, 1e-15);
        EXPECT_NEAR(worn.pose_b.orientation().norm(), 1, 1e-15);
      }
    }
  }
}

TEST(Modifiers, NeedlesAreBothOfAThousandToOne) {
  for (const Pair pair : {Pair::capsule, Pair::cylinder}) {
    for (const char* name : {"general+needles", "parallel-side+needles", "contained+needles"}) {
      for (std::uint64_t i = 0; i < samples; ++i) {
        const Identity id{pair, name, 1, i};
        const Configuration c = make_configuration(id);
        const Vec3 half = half_extents_of_b(c);
        EXPECT_NEAR(c.a.half_length() / c.a.radius(), 1000, 0.2) << to_string(id);
        EXPECT_NEAR(half.z() / half.x(), 1000, 0.2) << to_string(id);
      }
    }
  }
}

// They meet where their sides cross, or one's end meets the other's side.
TEST(Modifiers, TiltedNeedlesCrossAtAMilliradian) {
  constexpr double across = 1e-6;  // sine; at an end, a needle is met at a slant
  for (const Pair pair : {Pair::capsule, Pair::cylinder}) {
    int crossing = 0;
    for (std::uint64_t i = 0; i < samples; ++i) {
      const Identity id{pair, "parallel-side+needles+tilted-1e-3", 1, i};
      const Configuration c = make_configuration(id);
      EXPECT_NEAR(axis_angle(c).sine, 1e-3, 1e-6) << to_string(id);
      const Vec3 n = oracle::truth(c).normals.front().n;
      crossing += std::abs(n.dot(c.pose_a.rotation().col(2))) < across &&
                  std::abs(n.dot(c.pose_b.rotation().col(2))) < across;
    }
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
  for (const char* arrangement : {"general", "side-on-face"}) {
    int bars = 0, plates = 0;
    for (std::uint64_t i = 0; i < samples; ++i) {
      const auto made = [&](const char* proportions) {
        return make_configuration({Pair::box, std::string(arrangement) + proportions, 1, i});
      };
      const Cylinder needle = made("+needle").a, coin = made("+coin").a;
      EXPECT_NEAR(needle.half_length() / needle.radius(), 1000, 0.2);
      EXPECT_NEAR(coin.radius() / coin.half_length(), 1000, 0.2);
      const Vec3 plate = std::get<Box>(made("+plate").b).half_extents();
      EXPECT_NEAR(plate.maxCoeff() / plate.minCoeff(), 1000, 0.2);
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
  for (std::uint64_t i = 0; i < samples; ++i) {
    const Configuration c = make_configuration({Pair::capsule, "general+not-quite-unit", 1, i});
    for (const Pose& pose : {c.pose_a, c.pose_b}) {
      EXPECT_LE(std::abs(pose.orientation().norm() - 1), 1.01e-7);
    }
  }
}

TEST(Modifiers, FarIsAMillionMetresAway) {
  const Configuration c = make_configuration({Pair::box, "side-on-face+turned+far", 1, 0});
  EXPECT_NEAR(c.pose_a.position().norm(), 1e6, 10);
  EXPECT_LT((c.pose_a.position() - c.pose_b.position()).norm(), 10);
}

// Counted from the names alone.
TEST(CoveringArray, HasEverySensibleCombination) {
  for (const Pair pair : all_pairs) {
    for (const Coverage coverage : {Coverage::pairs, Coverage::triples}) {
      using Combination = std::set<std::string>;
      std::set<Combination> covered;
      for (const auto& name : pose_classes(pair, coverage)) {
        ClassParts parts = parts_of(pair, name);
        std::vector<std::string> all = parts.modifiers;
        all.push_back(parts.arrangement);
        for (const auto& x : all) {
          for (const auto& y : all) {
            for (const auto& z : all) covered.insert({x, y, z});
          }
        }
      }
      const std::size_t strength = coverage == Coverage::triples ? 3 : 2;
      std::size_t sensible = 0;
      const auto expect = [&](const Arrangement& a, const std::vector<const Modifier*>& modifiers) {
        PoseClass c{pair, &a, {}};
        Combination names = {a.name};
        for (const Modifier* m : modifiers) {
          const int set = c.modifiers[m->kind];
          if (nonsense(pair, a, *m) || (set != 0 && set != m->value)) return;
          c.modifiers[m->kind] = m->value;
          names.insert(m->name);
        }
        ++sensible;
        if (names.size() <= strength) {
          EXPECT_TRUE(covered.contains(names)) << pair_name(pair) << " " << c.name();
        }
        names.erase(a.name);
        EXPECT_TRUE(covered.contains(names)) << pair_name(pair) << " " << c.name();
      };
      for (const Arrangement& a : arrangements(pair)) {
        for (const Modifier& x : all_modifiers()) {
          for (const Modifier& y : all_modifiers()) {
            expect(a, {&x, &y});
            if (coverage == Coverage::pairs) continue;
            for (const Modifier& z : all_modifiers()) expect(a, {&x, &y, &z});
          }
        }
      }
      EXPECT_GT(sensible, 500u) << pair_name(pair);
    }
  }
}

// touchstone-suite-1 has nothing that came after it.
TEST(CoveringArray, OfSuite1IsAsItWas) {
  const struct {
    Pair pair;
    std::size_t count;
  } table[] = {{Pair::plane, 159},
               {Pair::sphere, 146},
               {Pair::capsule, 320},
               {Pair::cylinder, 316},
               {Pair::box, 285}};
  for (const auto& [pair, count] : table) {
    const auto& names = pose_classes(pair, Coverage::suite_1);
    EXPECT_EQ(names.size(), count);
    for (const std::string& name : names) {
      for (const char* later : {"diagonal", "contained", "worn", "needles"}) {
        EXPECT_EQ(name.find(later), name.npos) << name;
      }
    }
  }
}

TEST(CoveringArray, HasEveryArrangementAloneTurnedAndWorn) {
  for (const Pair pair : all_pairs) {
    const auto& names = pose_classes(pair);
    const auto has = [&](const std::string& name) {
      return std::find(names.begin(), names.end(), name) != names.end();
    };
    for (const Arrangement& a : arrangements(pair)) {
      if (a.name == "hostile") continue;
      EXPECT_TRUE(has(a.name)) << a.name;
      for (const char* frame : {"+turned", "+worn"}) {
        EXPECT_NE(has(a.name + frame), !has_class(pair, a.name + frame)) << a.name;
      }
    }
  }
}

TEST(Groups, AreWhatAUserMeets) {
  const struct {
    const char* name;
    Group group;
  } table[] = {{"general", Group::everyday},
               {"general+shallow", Group::everyday},
               {"general+apart", Group::everyday},
               {"rim-rim", Group::everyday},
               {"cap-on-cap-offset+turned", Group::everyday},
               {"cap-on-cap-offset+turned+not-quite-unit", Group::everyday},
               {"cap-on-cap-offset", Group::degenerate},
               {"cap-on-cap-offset+tilted-1e-6+turned", Group::degenerate},
               {"general+touching", Group::degenerate},
               {"touching+turned", Group::degenerate},
               {"coaxial+turned", Group::degenerate},
               {"diagonal", Group::degenerate},
               {"diagonal+worn", Group::everyday},
               {"touching+worn", Group::degenerate},
               {"contained", Group::extreme},
               {"contained+worn", Group::extreme},
               {"concentric", Group::degenerate},
               {"general+deep", Group::extreme},
               {"cap-on-cap-offset+coin", Group::extreme},
               {"general+tiny", Group::extreme},
               {"coaxial+far", Group::extreme},
               {"hostile", Group::extreme}};
  for (const auto& [name, group] : table) {
    EXPECT_EQ(PoseClass(Pair::cylinder, name).group(), group) << name;
  }
  for (const Group group : all_groups) EXPECT_EQ(parse_group(group_name(group)), group);
  EXPECT_THROW(parse_group("weekday"), InvalidInput);
}

}  // namespace
}  // namespace touchstone
