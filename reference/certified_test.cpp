// What `certified_distance` says of itself, held against the oracle on every pair and pose class
// and on hostile configurations: the truth lies within the bound, the bound is rounding (the search
// is proven complete), and the fast routine's answer lies within it, too.
//
// TOUCHSTONE_COUNT sets how many configurations of each class are tried (default 100); of hostile
// ones it is fifty times as many.
#include <algorithm>
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
  return text ? std::strtoull(text, nullptr, 10) : 25;
}

/// The larger size, or how far the bodies are apart.
double scale(const Configuration& c) {
  const auto* plane = std::get_if<Plane>(&c.b);
  return std::max({larger_size(c), (c.pose_a.position() - c.pose_b.position()).norm(),
                   plane ? std::abs(plane->unit_displacement()) : 0});
}

class Certified : public testing::TestWithParam<Pair> {};

TEST_P(Certified, BoundsHoldAndAreRounding) {
  constexpr double proven_part = 1e-13;
  std::vector<std::string> classes = pose_classes(GetParam());
  classes.push_back("hostile");
  constexpr double min_proven_part_of_hostile = 0.998;
  double worst = 0;
  std::string worst_id;
  for (const std::string& name : classes) {
    const bool hostile = name == "hostile";
    const std::uint64_t count = count_per_class() * (hostile ? 200 : 1);
    std::uint64_t proven = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
      const Identity id{GetParam(), name, 13, i};
      const Configuration c = make_configuration(id);
      const CertifiedDistance certified = certified_distance(c);
      const double error =
          std::abs(certified.value - oracle::truth(c, 1e-20).signed_distance.midpoint());
      EXPECT_LE(error, certified.error_bound) << to_string(id);
      EXPECT_LE(std::abs(signed_distance(c).value - certified.value), 2 * certified.error_bound)
          << to_string(id);
      EXPECT_NEAR(certified.normal.norm(), 1, 4e-15) << to_string(id);
      proven += certified.error_bound <= proven_part * scale(c);
      const double part = error / certified.error_bound;
      if (part > worst) worst = part, worst_id = to_string(id);
    }
    const double share = static_cast<double>(proven) / static_cast<double>(count);
    EXPECT_GE(share, hostile ? min_proven_part_of_hostile : 1) << name;
    if (hostile) std::printf("proven %.3f%% of hostile ones\n", 100 * share);
  }
  std::printf("largest error %.2g of its bound at %s\n", worst, worst_id.c_str());
}

// Rims that touch from within along axes that are parallel but for rounding: every point of the
// rims is a stationary one.
TEST(CertifiedDistance, IsProvenWhereRimsCoincide) {
  for (const double tilt : {0.0, 1e-17, 1e-16, 3e-16, 1e-15, 1e-12, 1e-8}) {
    const Configuration c{Cylinder(1, 1), Pose({0, 0, 1.99}, {1, tilt, 0, 0}), Cylinder(1, 1),
                          Pose()};
    const CertifiedDistance certified = certified_distance(c);
    EXPECT_NEAR(certified.value, oracle::truth(c).signed_distance.midpoint(), certified.error_bound)
        << tilt;
    EXPECT_LE(certified.error_bound, 5e-14) << tilt;
  }
}

INSTANTIATE_TEST_SUITE_P(, Certified, testing::ValuesIn(all_pairs), [](const auto& pair) {
  return std::string(pair_name(pair.param)).substr(std::string("cylinder-").size());
});

}  // namespace
}  // namespace touchstone
