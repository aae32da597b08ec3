// Which of several choices that all serve is the answer.
#include "simulation/scenes/simplest.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace touchstone {
namespace {

constexpr double any_time = std::numeric_limits<double>::infinity();

TEST(SimplestOfCheapest, IsTheCheapestWhereNothingElseIsMuchTheSame) {
  EXPECT_EQ(simplest_of_cheapest({{3, 1.0, 9}, {4, 1.2, 1}, {5, 5.0, 0}}, any_time), 3U);
}

// Two models within a tenth of each other: whichever of them the machine finds cheaper, the simpler
// one is the answer.
TEST(SimplestOfCheapest, IsTheSimplerOfTwoWhicheverNoiseMakesCheaper) {
  for (const double simpler : {0.92, 0.99, 1.0, 1.01, 1.1}) {
    EXPECT_EQ(simplest_of_cheapest({{3, 1.0, 9}, {4, simpler, 2}}, any_time), 4U) << simpler;
    EXPECT_EQ(simplest_of_cheapest({{4, simpler, 2}, {3, 1.0, 9}}, any_time), 4U) << simpler;
  }
  EXPECT_EQ(simplest_of_cheapest({{3, 1.0, 9}, {4, 1.12, 2}}, any_time), 3U);
}

// It is the cheapest with which all are compared, and not the simplest so far: 1.08 is within a
// tenth of 1.0, 1.16 is within a tenth of 1.08 alone.
TEST(SimplestOfCheapest, ComparesWithTheCheapestAlone) {
  EXPECT_EQ(simplest_of_cheapest({{1, 1.16, 0}, {2, 1.08, 1}, {3, 1.0, 2}}, any_time), 2U);
}

TEST(SimplestOfCheapest, IsTheFirstOfEquallySimpleOnes) {
  EXPECT_EQ(simplest_of_cheapest({{7, 1.05, 1}, {8, 1.0, 1}}, any_time), 7U);
}

// The limit is what the exact model takes, less noise: the simplest must keep to it as well.
TEST(SimplestOfCheapest, KeepsToTheLimit) {
  EXPECT_EQ(simplest_of_cheapest({{1, 1.0, 1}, {2, 1.04, 0}}, 1.03), 1U);
  EXPECT_EQ(simplest_of_cheapest({{1, 1.0, 1}, {2, 1.04, 0}}, 1.0), 1U);
  EXPECT_EQ(simplest_of_cheapest({{1, 1.0, 1}, {2, 1.04, 0}}, 0.99), std::nullopt);
  EXPECT_EQ(simplest_of_cheapest({}, any_time), std::nullopt);
}

// Within twice the noise of the cheapest: 1 / 0.81 of it.
TEST(Finalists, AreTheCheapestAndThenTheSimplestThatMayCostMuchTheSame) {
  const std::vector<Finalist> promising = {{3, 1.23, 1}, {4, 1.24, 0}, {5, 1.0, 9}, {6, 1.1, 0}};
  EXPECT_EQ(finalists(promising), (std::vector<std::size_t>{5, 6, 3}));
  EXPECT_TRUE(finalists({}).empty());
}

TEST(Finalists, AreSixAtMost) {
  std::vector<Finalist> alike;
  for (std::size_t i = 0; i < 9; ++i) alike.push_back({i, 1, 9 - i});
  EXPECT_EQ(finalists(alike), (std::vector<std::size_t>{0, 8, 7, 6, 5, 4}));
}

}  // namespace
}  // namespace touchstone
