// The promise of the headers, held on every pair and pose class against the oracle.
//
// TOUCHSTONE_COUNT sets how many configurations of each class are tried (20 by default, for CI).
#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>
#include <string>

#include "oracle/truth.hpp"
#include "properties/identity.hpp"
#include "reference/contact_of.hpp"

namespace touchstone {
namespace {

std::uint64_t count_per_class() {
  const char* text = std::getenv("TOUCHSTONE_COUNT");
  return text ? std::strtoull(text, nullptr, 10) : 20;
}

class Accuracy : public testing::TestWithParam<Pair> {};

TEST_P(Accuracy, IsWithinRoundingOfTheLargerSize) {
  constexpr double promised = 1e-13;
  double worst_distance = 0, worst_regret = 0;
  std::string worst_distance_id, worst_regret_id;
  for (const auto& name : pose_classes(GetParam())) {
    for (std::uint64_t i = 0; i < count_per_class(); ++i) {
      const Identity id{GetParam(), name, 7, i};
      const Configuration c = make_configuration(id);
      const oracle::Truth t = oracle::truth(c);
      const SignedDistance answer = signed_distance(c);
      const double distance =
          std::abs(answer.value - t.signed_distance.midpoint()) / larger_size(c);
      const double regret = oracle::normal_regret(c, t, answer.normal) / larger_size(c);
      // Far from the origin and for planes the positions' own rounding counts.
      const double rounding =
          4e-16 * (c.pose_a.position().norm() + c.pose_b.position().norm()) / larger_size(c);
      EXPECT_LE(distance, promised + rounding) << to_string(id);
      EXPECT_LE(regret, promised) << to_string(id);
      EXPECT_NEAR(answer.normal.norm(), 1, 1e-15) << to_string(id);
      if (distance > worst_distance) worst_distance = distance, worst_distance_id = to_string(id);
      if (regret > worst_regret) worst_regret = regret, worst_regret_id = to_string(id);
    }
  }
  RecordProperty("worst_distance", std::to_string(worst_distance) + " " + worst_distance_id);
  std::printf("worst distance %.2g at %s, worst regret %.2g at %s\n", worst_distance,
              worst_distance_id.c_str(), worst_regret, worst_regret_id.c_str());
}

INSTANTIATE_TEST_SUITE_P(, Accuracy, testing::ValuesIn(all_pairs), [](const auto& pair) {
  return std::string(pair_name(pair.param)).substr(std::string("cylinder-").size());
});

}  // namespace
}  // namespace touchstone
