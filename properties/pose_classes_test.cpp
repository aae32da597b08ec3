// The promises of each pose class: relations of axes in rational arithmetic, distances by the
// oracle.
#include "properties/pose_classes_test.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <set>

#include "oracle/truth.hpp"
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
    ASSERT_NO_THROW(expect_of_each(
        {pair}, pose_classes(pair),
        [](const Configuration& c, Pair of) { ASSERT_EQ(pair_of(c), of); }, 50));
  }
}

TEST(PoseClasses, TouchingIsZeroToTheLastBit) {
  constexpr double width = 1e-40;  // no clearance of two doubles is as small as that
  expect_of_each(
      every_pair, {"touching", "touching-tilted"},
      [](const Configuration& c, Pair) {
        const auto t = oracle::truth(c, width);
        EXPECT_LE(t.signed_distance.lo, 0);
        EXPECT_GE(t.signed_distance.hi, 0);
      },
      2 * samples);
}

// Coordinates of a few metres against sizes of 0.2 m lose 1e-15 of a size, and needles and coins a
// thousand times more; 1e-9 covers them and is far below the smallest clearance, 1e-6.
constexpr double rounding = 1e-9;
constexpr double most_shallow = -0.05 - rounding;
constexpr double most_apart = 1 + rounding;
constexpr double any_depth = -1e6;

/// Bounds of the signed distance over the smaller size, and classes that keep them.
struct Distances {
  double lo, hi;
  std::vector<std::string> classes;
};
const Distances all_distances[] = {
    {1e-6 - rounding, most_apart, {"general+apart", "rim-end"}},
    {most_shallow, -1e-6 + rounding, {"general+shallow"}},
    {any_depth,
     -0.05,
     {"general+deep", "diagonal+deep", "general+deep+needle", "general+deep+coin"}},
    {-1e-13, 1e-13, {"general+touching"}},
    {any_depth, -1, {"concentric", "concentric-aligned"}},
    {any_depth, 0, {"coaxial"}},
    {any_depth, -0.1, {"contained"}},
    // Clear of cap and side by up to 1 each.
    {1e-6 - rounding, 1.42, {"diagonal"}},
    // Features that meet, three in four overlapping.
    {most_shallow,
     most_apart,
     {"rim-rim", "rim-side", "rim-face", "cap-end", "side-end", "side-side", "side", "cap", "rim",
      "edge-side", "edge-cap", "edge-rim", "vertex-side", "vertex-cap", "vertex-rim",
      "general+needle", "general+coin", "general+tiny", "general+huge"}},
    // Exactly aligned bodies always overlap, by at least a step of their lattice.
    {most_shallow,
     -1e-8,
     {"diagonal+shallow", "parallel-side", "perpendicular-t", "perpendicular-x", "cap-on-side",
      "cap-on-axis", "cap-on-end-centred", "cap-on-end-offset", "cap-on-cap-centred",
      "cap-on-cap-offset", "cap-on-face-centred", "cap-on-face-offset", "side-on-face", "standing",
      "lying"}},
    // Positions of 1e6 m have a spacing of 1e-10 m.
    {most_shallow - 1e-8, most_apart + 1e-8, {"general+far"}},
};

TEST(PoseClasses, HaveTheDistancesThatTheirNamesSay) {
  for (const auto& [lo, hi, classes] : all_distances) {
    for (const std::string& name : classes) {
      expect_of_each(every_pair, {name}, [lo = lo, hi = hi](const Configuration& c, Pair) {
        const double relative = oracle::truth(c).signed_distance.midpoint() / smaller_size(c);
        EXPECT_GE(relative, lo);
        EXPECT_LE(relative, hi);
      });
    }
  }
}

// Every old class is in the table above or has a test of its own.
TEST(PoseClasses, AllHaveATest) {
  std::set<std::string> tested = {"touching", "touching-tilted"};
  for (const Distances& d : all_distances) tested.insert(d.classes.begin(), d.classes.end());
  for (const Pair pair : all_pairs) {
    for (const PoseClass& c : old_classes(pair)) {
      const bool tilt = c.modifiers[ModifierKind::tilt] != 0;
      EXPECT_TRUE(tilt || tested.contains(c.name())) << pair_name(pair) << " " << c.name();
    }
  }
}

TEST(PoseClasses, ParallelAndPerpendicularAreExact) {
  const auto parallel = [](const Configuration& c, Pair) { EXPECT_TRUE(exactly_parallel(c)); };
  const auto across = [](const Configuration& c, Pair) { EXPECT_TRUE(exactly_perpendicular(c)); };
  expect_of_each(pairs_of_axes,
                 {"parallel-side", "coaxial", "concentric-aligned", "cap-on-end-centred",
                  "cap-on-end-offset", "cap-on-cap-centred", "cap-on-cap-offset",
                  "cap-on-face-centred", "cap-on-face-offset", "diagonal", "contained"},
                 parallel);
  expect_of_each(pairs_of_axes, {"perpendicular-t", "cap-on-side", "side-on-face"}, across);
  // The box's crossing edge is its y axis; its z axis is not perpendicular to A.
  expect_of_each({Pair::capsule, Pair::cylinder}, {"perpendicular-x"}, across);
  expect_of_each({Pair::plane}, {"standing"}, parallel);
  expect_of_each({Pair::plane}, {"lying"}, across);
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
      expect_of_each({pair}, {name}, [&](const Configuration& c, Pair) {
        const double relative = oracle::truth(c).signed_distance.midpoint() / smaller_size(c);
        EXPECT_LE(relative, most_apart + 1e-4);  // the tilt lifts far ends
        overlapping += relative < 0;
      });
      EXPECT_GE(overlapping, static_cast<int>(samples) / 2) << pair_name(pair) << " " << name;
    }
  }
}

TEST(PoseClasses, CentredAndCoaxialCentresLieOnTheAxisExactly) {
  expect_of_each(
      {Pair::sphere, Pair::capsule, Pair::cylinder, Pair::box},
      {"coaxial", "cap-on-axis", "cap-on-end-centred", "cap-on-cap-centred", "cap-on-face-centred"},
      [](const Configuration& c, Pair) {
        EXPECT_EQ(offset_along(c, c.pose_a, 0), 0);
        EXPECT_EQ(offset_along(c, c.pose_a, 1), 0);
      });
}

TEST(PoseClasses, DiagonalBodiesLieBeyondCapAndSide) {
  expect_of_each(pairs_of_axes, {"diagonal"}, [](const Configuration& c, Pair pair) {
    const Vec3 half = half_extents_of_b(c);
    const auto beyond = [&](int axis) {
      return mpq_class(abs(offset_along(c, c.pose_b, axis))).get_d();
    };
    EXPECT_GT(beyond(2) - c.a.half_length(), half.z());
    // Beyond a capsule's segment, whose ball reaches out to the rim.
    EXPECT_GT(beyond(0) - c.a.radius(), pair == Pair::capsule ? 0 : half.x());
    const Vec3 n = oracle::truth(c).normals.front().n, axis = c.pose_a.rotation().col(2);
    constexpr double least = 1e-7;  // clearances are within 1:1e6 of each other
    EXPECT_GT(std::abs(n.dot(axis)), least);
    EXPECT_GT(n.cross(axis).norm(), least);
  });
}

// Where axes coincide the opposite normal is as good, so that a reversed one does not show.
TEST(PoseClasses, ContainedBodiesComeFreeSidewaysInOneSense) {
  for (const Pair pair : pairs_of_axes) {
    int wider_a = 0;
    std::vector<std::string> names = {"contained"};
    for (const Modifier& m : all_modifiers()) {
      if (m.kind == ModifierKind::proportions) names.push_back("contained+" + m.name);
    }
    expect_of_each({pair}, names, [&](const Configuration& c, Pair) {
      const Vec3 half = half_extents_of_b(c);
      const mpq_class x = offset_along(c, c.pose_b, 0), y = offset_along(c, c.pose_b, 1);
      wider_a += c.a.radius() > half.x();
      // A's axis runs through B, beside its middle.
      EXPECT_LT(abs(x), mpq_class(half.x()));
      EXPECT_LT(abs(y), mpq_class(half.y()));
      EXPECT_TRUE(x != 0 || y != 0);
      const oracle::Truth t = oracle::truth(c);
      constexpr double rounding_of_axis = 1e-15;
      const Vec3 axis = c.pose_a.rotation().col(2);
      for (const auto& normal : t.normals) {
        EXPECT_LE(std::abs(normal.n.dot(axis)), rounding_of_axis);
      }
      const double reversed = oracle::certified_gap(c, -t.normals.front().n).midpoint();
      EXPECT_LT(reversed, t.signed_distance.midpoint() - 1e-9 * larger_size(c));
    });
    EXPECT_GT(wider_a, 20) << "B within A: " << pair_name(pair);
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
