// The oracle against brute force on every pair and pose class.
//
// TOUCHSTONE_COUNT sets how many configurations of each class are tried (10 by default, for CI).
#include <cstdlib>
#include <gtest/gtest.h>
#include <string>

#include "oracle/brute_force.hpp"
#include "oracle/truth.hpp"
#include "properties/identity.hpp"

namespace touchstone::oracle {
namespace {

std::uint64_t count_per_class() {
  const char* text = std::getenv("TOUCHSTONE_COUNT");
  return text ? std::strtoull(text, nullptr, 10) : 10;
}

class PoseClasses : public testing::TestWithParam<Pair> {};

TEST_P(PoseClasses, NoDirectionBeatsTheOracle) {
  for (const auto& name : pose_classes(GetParam())) {
    for (std::uint64_t i = 0; i < count_per_class(); ++i) {
      const Identity id{GetParam(), name, 20261121, i};
      SCOPED_TRACE(to_string(id));
      const Configuration c = make_configuration(id);
      const Truth t = truth(c);
      if (GetParam() == Pair::plane) {
        EXPECT_LE(t.signed_distance.width(), 1e-15 * larger_size(c));
        const double rounding =
            1e-14 * (larger_size(c) + c.pose_a.position().norm() + c.pose_b.position().norm());
        EXPECT_NEAR(lowest_point_over_plane(c), t.signed_distance.midpoint(), rounding);
      } else {
        expect_brute_force_agrees(c, t, 400);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, PoseClasses, testing::ValuesIn(all_pairs), [](const auto& pair) {
  return std::string(pair_name(pair.param)).substr(std::string("cylinder-").size());
});

}  // namespace
}  // namespace touchstone::oracle
