// Steps of a search: of every magnitude, to where cases meet, and the same again.
#include "properties/random_step.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>

#include "properties/identity.hpp"
#include "properties/numbers.hpp"

namespace touchstone {
namespace {

Draw seeded(std::uint64_t seed) { return Draw(rc::Random(rc::Random::Key{seed, 0, 0, 0})); }

/// What a number of steps from this configuration lead to.
template <class Look>
void look_at_steps(const Configuration& c, int count, const Look& look) {
  Draw draw = seeded(1);
  RandomStep step(c, draw);
  for (int i = 0; i < count; ++i) look(step.from(c).configuration);
}

TEST(RandomStep, HasEveryMagnitude) {
  const Configuration c = make_configuration({Pair::cylinder, "general-shallow", 1, 0});
  std::array<int, 18> of_decade{};  // of the shift, relative to the larger size
  look_at_steps(c, 20000, [&](const Configuration& next) {
    const double shift = (next.pose_a.position() - c.pose_a.position()).norm() / larger_size(c);
    if (shift == 0 || shift >= 1) return;
    ++of_decade[static_cast<std::size_t>(std::min(17.0, -std::log10(shift)))];
  });
  for (std::size_t decade = 0; decade <= 15; ++decade) EXPECT_GT(of_decade[decade], 100) << decade;
}

TEST(RandomStep, LeadsToWhereCasesMeet) {
  for (const Pair pair : all_pairs) {
    const Configuration c = make_configuration({pair, "general-shallow", 1, 0});
    int equal = 0, aligned = 0, exact = 0;
    look_at_steps(c, 4000, [&](const Configuration& next) {
      const Numbers n = numbers_of(next);
      equal += n.sizes[0] == n.sizes[1];
      const double z = next.pose_a.axis().dot(next.pose_b.axis());
      aligned += std::abs(z) < 1e-15 || 1 - std::abs(z) < 1e-15;
      exact += next.pose_a.axis() == next.pose_b.axis();
    });
    EXPECT_GT(equal, 10) << pair_name(pair);
    EXPECT_GT(aligned, 40) << pair_name(pair);
    EXPECT_GT(exact, 10) << pair_name(pair);
  }
}

TEST(RandomStep, KeepsSizesNearTheirStart) {
  for (const Pair pair : all_pairs) {
    const Configuration start = make_configuration({pair, "general-shallow", 1, 0});
    const std::vector<double> sizes = numbers_of(start).sizes;
    const auto [min, max] = std::minmax_element(sizes.begin(), sizes.end());
    Draw draw = seeded(2);
    RandomStep step(start, draw);
    Configuration c = start;
    for (int i = 0; i < 3000; ++i) {
      c = step.from(c, 0.5).configuration;
      for (const double size : numbers_of(c).sizes) {
        EXPECT_GE(size, *min / 2);
        EXPECT_LE(size, 2 * *max);
      }
    }
  }
}

TEST(RandomStep, IsTheSameAgain) {
  const Configuration c = make_configuration({Pair::box, "hostile", 1, 3});
  Draw one = seeded(7), two = seeded(7);
  RandomStep first(c, one), second(c, two);
  for (int i = 0; i < 200; ++i) {
    Numbers n = numbers_of(first.from(c, 1e-6).configuration);
    Numbers m = numbers_of(second.from(c, 1e-6).configuration);
    const auto all = every_number(n), other = every_number(m);
    for (std::size_t k = 0; k < all.size(); ++k) EXPECT_EQ(*all[k], *other[k]);
  }
}

}  // namespace
}  // namespace touchstone
