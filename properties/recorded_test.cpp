#include "properties/recorded.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <rapidcheck/gtest.h>

#include <nlohmann/json.hpp>

#include "properties/arbitrary.hpp"
#include "properties/files/configuration_json.hpp"
#include "properties/files/disk.hpp"
#include "properties/files/strict_json.hpp"
#include "properties/identity.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

/// Every number to the last bit.

std::string named(const NearestArrangement& n) {
  return std::string(n.name) + (n.tilt ? " 1e-" + std::to_string(*n.tilt) : "");
}

/// How many of 100 configurations of a class are nearest to `expected`.
int count_of(Pair pair, const std::string& pose_class, const NearestArrangement& expected) {
  int count = 0;
  for (std::uint64_t i = 0; i < 100; ++i) {
    count += nearest_arrangement(make_configuration({pair, pose_class, 1, i})) == expected;
  }
  return count;
}

struct Aligned {
  Pair pair;
  const char* name;
  const char* nearest;
};
/// Exactly aligned arrangements whose bodies meet as their names say.
const Aligned aligned[] = {
    {Pair::plane, "standing", "standing"},
    {Pair::plane, "lying", "lying"},
    {Pair::capsule, "parallel-side", "parallel-side"},
    {Pair::capsule, "perpendicular-t", "perpendicular-t"},
    {Pair::capsule, "perpendicular-x", "perpendicular-x"},
    {Pair::capsule, "cap-on-end-centred", "cap-on-end-centred"},
    {Pair::capsule, "cap-on-end-offset", "cap-on-end-offset"},
    {Pair::cylinder, "parallel-side", "parallel-side"},
    {Pair::cylinder, "perpendicular-t", "perpendicular-t"},
    {Pair::cylinder, "perpendicular-x", "perpendicular-x"},
    {Pair::cylinder, "cap-on-cap-centred", "cap-on-cap-centred"},
    {Pair::cylinder, "cap-on-cap-offset", "cap-on-cap-offset"},
    {Pair::box, "parallel-side", "side-on-face"},
    {Pair::box, "cap-on-face-centred", "cap-on-face-centred"},
    {Pair::box, "cap-on-face-offset", "cap-on-face-offset"},
    {Pair::box, "side-on-face", "side-on-face"},
    {Pair::box, "perpendicular-x", "perpendicular-x"},
};

TEST(NearestArrangement, OfAnAlignedOneIsItselfHoweverTurned) {
  for (const auto& [pair, name, nearest] : aligned) {
    for (const char* turned : {"", "+turned"}) {
      EXPECT_GE(count_of(pair, name + std::string(turned), {nearest, NearestArrangement::exact}),
                90)
          << pair_name(pair) << " " << name << turned;
    }
  }
}

TEST(NearestArrangement, TellsTheDecadeOfATilt) {
  for (const auto& [pair, name, nearest] : aligned) {
    // The box's crossing edge is its y axis, and a tilt may be about it.
    if (pair == Pair::box && name == std::string("perpendicular-x")) continue;
    for (const int k : {3, 6, 9, 12}) {
      const std::string tilted = name + std::string("+tilted-1e-") + std::to_string(k) + "+turned";
      int count = count_of(pair, tilted, {nearest, k});
      for (const int side : {k + 1, k + 2}) count += count_of(pair, tilted, {nearest, side});
      EXPECT_GE(count, 80) << pair_name(pair) << " " << tilted;
    }
  }
}

// By chance, random axes are nearly aligned. Where a vertex and a rim overlap, another feature of
// one of the bodies is nearer.
TEST(NearestArrangement, OfFeaturesAtARandomAngleIsTheirs) {
  const struct {
    Pair pair;
    std::vector<const char*> names;
  } table[] = {{Pair::sphere, {"side", "cap", "rim", "cap-on-axis"}},
               {Pair::capsule, {"rim-side", "rim-end", "cap-end", "side-end", "side-side"}},
               {Pair::cylinder, {"rim-rim", "rim-side", "rim-face", "side-side"}},
               {Pair::box,
                {"rim-face", "edge-side", "edge-cap", "edge-rim", "vertex-side", "vertex-cap",
                 "vertex-rim+apart"}}};
  for (const auto& [pair, names] : table) {
    for (const char* name : names) {
      int count = 0;
      for (std::uint64_t i = 0; i < 100; ++i) {
        count += nearest_arrangement(make_configuration({pair, name, 1, i})).name ==
                 parts_of(pair, name).arrangement;
      }
      EXPECT_GE(count, 70) << pair_name(pair) << " " << name;
    }
  }
}

TEST(NearestArrangement, FollowsFromAnglesByHand) {
  const Cylinder can(1, 2);
  const auto about_y = [](double angle) {
    return Eigen::Quaterniond(std::cos(angle / 2), 0, std::sin(angle / 2), 0);
  };
  const double quarter = std::acos(-1.0) / 2;
  const auto on_ground = [&](double lean, double height) {
    return named(nearest_arrangement(
        {can, Pose({0, 0, height}, about_y(lean)), Plane(Vec3::UnitZ(), 0), Pose()}));
  };
  EXPECT_EQ(on_ground(0, 2), "standing 1e-15");
  EXPECT_EQ(on_ground(2e-7, 2), "standing 1e-7");
  EXPECT_EQ(on_ground(0.09, 2), "standing 1e-1");
  EXPECT_EQ(on_ground(0.11, 2), "general");
  EXPECT_EQ(on_ground(quarter - 0.11, 1), "general");
  EXPECT_EQ(on_ground(quarter - 0.005, 1), "lying 1e-2");
  EXPECT_EQ(on_ground(quarter, 1), "lying 1e-15");

  const auto on_can = [&](const Vec3& centre, double lean) {
    return named(nearest_arrangement({can, Pose(centre, about_y(lean)), can, Pose()}));
  };
  EXPECT_EQ(on_can({0, 0, 4}, 0), "cap-on-cap-centred 1e-15");
  EXPECT_EQ(on_can({0.5, 0, 4}, 0), "cap-on-cap-offset 1e-15");
  EXPECT_EQ(on_can({2, 0, 1}, 1e-3), "parallel-side 1e-3");
  EXPECT_EQ(on_can({0, 0, 3}, quarter), "perpendicular-t 1e-15");
  EXPECT_EQ(on_can({3, 0, 0}, quarter), "cap-on-side 1e-15");
  EXPECT_EQ(on_can({0, 2, 0}, quarter), "perpendicular-x 1e-15");
  EXPECT_EQ(on_can({0, 2, 0}, quarter / 2), "side-side");

  const auto on_box = [&](const Vec3& centre, double lean) {
    return named(nearest_arrangement({can, Pose(centre, about_y(lean)), Box({4, 4, 4}), Pose()}));
  };
  EXPECT_EQ(on_box({0, 0, 6}, 0), "cap-on-face-centred 1e-15");
  EXPECT_EQ(on_box({3, 0, 6}, 0), "cap-on-face-offset 1e-15");
  EXPECT_EQ(on_box({3, 0, 5}, quarter), "side-on-face 1e-15");
  EXPECT_EQ(on_box({4.7, 4.7, 0}, 1e-4), "parallel 1e-4");  // beside an upright edge
}

// What the binary holds is the file that `simulate --record` wrote, to the last bit.
TEST(Recorded, IsTheFileThatSimulateWrote) {
  std::map<Pair, std::size_t> at;
  const std::string text = read_file(TOUCHSTONE_RECORDED, "input");
  for (const nlohmann::json& line : parse_json_lines(text, "recorded.jsonl")) {
    const Configuration c = configuration_from_json(line["configuration"]).configuration;
    ASSERT_LT(at[pair_of(c)], recorded(pair_of(c)).size());
    const Recorded& r = recorded(pair_of(c))[at[pair_of(c)]++];
    EXPECT_EQ(rc::toString(r.configuration), rc::toString(c)) << line["id"];
    EXPECT_EQ(line["scene"], r.scene);
    EXPECT_EQ(line["weight"], r.weight);
  }
  for (const Pair pair : all_pairs) EXPECT_EQ(at[pair], recorded(pair).size());
}

TEST(Recorded, IdentitiesReplayEntriesAsOftenAsTheyWeigh) {
  for (const Pair pair : all_pairs) {
    if (recorded(pair).empty()) continue;
    double total = 0;
    std::map<std::string, double> weights, drawn;
    for (const Recorded& r : recorded(pair)) {
      weights[rc::toString(r.configuration)] += static_cast<double>(r.weight);
      total += static_cast<double>(r.weight);
    }
    constexpr int count = 20000;
    for (std::uint64_t i = 0; i < count; ++i) {
      const Identity id{pair, "recorded", 1, i};
      const std::string text = rc::toString(make_configuration(id));
      ASSERT_TRUE(weights.contains(text)) << to_string(id);
      drawn[text] += 1;
    }
    for (const auto& [text, weight] : weights) {
      const double expected = count * weight / total;
      EXPECT_NEAR(drawn[text], expected, 5 * std::sqrt(expected) + 5) << pair_name(pair);
    }
  }
}

TEST(Recorded, IsAClassAndGroupOfItsOwnThatNothingModifies) {
  for (const Pair pair : all_pairs) {
    const auto& names = pose_classes(pair);
    EXPECT_EQ(std::count(names.begin(), names.end(), "recorded"), recorded(pair).empty() ? 0 : 1);
    if (recorded(pair).empty()) continue;
    EXPECT_EQ(names.back(), "recorded");
    EXPECT_EQ(PoseClass(pair, "recorded").group(), Group::recorded);
    EXPECT_THROW(parse_identity(std::string(pair_name(pair)) + "/recorded+turned/1/2"),
                 InvalidInput);
    for (const std::string& name : names) {
      EXPECT_EQ(PoseClass(pair, name).group() == Group::recorded, name == "recorded") << name;
    }
  }
}

TEST(RecordedShares, AddUpToOneForEachPairAndNameItsArrangements) {
  std::map<Pair, double> sums;
  for (const RecordedShare& s : recorded_shares()) {
    sums[s.pair] += s.share;
    EXPECT_TRUE(find_pose_class(s.pair, s.arrangement.name)) << s.arrangement.name;
  }
  for (const Pair pair : all_pairs) {
    EXPECT_EQ(sums.contains(pair), !recorded(pair).empty());
    EXPECT_NEAR(sums.contains(pair) ? sums[pair] : 1, 1, 1e-12);
  }
}

}  // namespace
}  // namespace touchstone
