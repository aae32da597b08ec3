#include "simulation/resolution.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace touchstone {
namespace {

TEST(Resolution, SinkingIsTheSpeedThatCfmLeavesUnderAWeight) {
  EXPECT_DOUBLE_EQ(sinking(3), 3 * 9.81e-10);
}

TEST(Resolution, LayerLetsABodyOnTwoPointsSinkAndLean) {
  // Points 0.4 m apart, one at the layer's top and one at its bottom.
  EXPECT_DOUBLE_EQ(lean_within_layer(1e-4, 0.4), 2.5e-4);
  EXPECT_DOUBLE_EQ(way_within_layer(1e-4, 0.4, 0.5, 0.1), 1e-4 + 2.5e-4 * 0.6);
}

TEST(Resolution, LandingIsAsFastAsTheFallOfALeaningBody) {
  constexpr double gyration = 0.6, arm = 0.25, across = 0.5, lean = 0.01, tick = 1e-7;
  double angle = lean, rate = 0;
  while (angle > 0) {
    rate += tick * 9.81 * arm / (gyration * gyration);
    angle -= tick * rate;
  }
  EXPECT_NEAR(way_of_late_landing(lean, arm, gyration, across, 1e-3), across * rate * 1e-3, 1e-9);
}

TEST(Resolution, BisectionLeavesHalfOfTheLastInterval) {
  EXPECT_EQ(bisected(1), 0.25);
  EXPECT_EQ(bisected(12), 0.5 / 4096);
}

}  // namespace
}  // namespace touchstone
