// The two oracles against each other on every pair and pose class.
//
// TOUCHSTONE_COUNT sets how many configurations of each class are tried (10 by default, for CI).
#include <cstdlib>
#include <gtest/gtest.h>
#include <string>

#include "oracle/audit/enclose.hpp"
#include "oracle/truth.hpp"
#include "properties/identity.hpp"

namespace touchstone {
namespace {

std::uint64_t count_per_class() {
  const char* text = std::getenv("TOUCHSTONE_COUNT");
  return text ? std::strtoull(text, nullptr, 10) : 10;
}

class PoseClasses : public testing::TestWithParam<Pair> {};

TEST_P(PoseClasses, BothOraclesEncloseOneSignedDistance) {
  // Relative to the larger size; continua of normals (concentric, coaxial) cost the most.
  constexpr double widest = 1e-4;
  for (const auto& name : pose_classes(GetParam())) {
    for (std::uint64_t i = 0; i < count_per_class(); ++i) {
      const Identity id{GetParam(), name, 20261121, i};
      SCOPED_TRACE(to_string(id));
      const Configuration c = make_configuration(id);
      const oracle::Enclosure truth = oracle::truth(c).signed_distance;
      const audit::Enclosure e = audit::enclose(c);
      ASSERT_LE(mpq_class(e.lo), truth.hi);
      ASSERT_GE(mpq_class(e.hi), truth.lo);
      ASSERT_GE(mpq_class(e.pair_distance), truth.lo);
      EXPECT_LE(e.hi - e.lo, widest * larger_size(c));
      if (name.starts_with("general-")) {
        EXPECT_LE(e.hi - e.lo, 1.0001e-9 * larger_size(c));
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, PoseClasses, testing::ValuesIn(all_pairs), [](const auto& pair) {
  return std::string(pair_name(pair.param)).substr(std::string("cylinder-").size());
});

}  // namespace
}  // namespace touchstone
