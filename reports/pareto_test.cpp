#include "reports/pareto.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace touchstone {
namespace {

using testing::ElementsAre;

TEST(Pareto, KeepsWhatIsFasterOrMoreAccurate) {
  const SpeedAccuracy fast{1, 2, 1e-3}, exact{10, 11, 1e-15}, worse{12, 13, 1e-3};
  EXPECT_THAT(pareto_front({fast, worse, exact}), ElementsAre(true, false, true));
  EXPECT_TRUE(pareto_front({}).empty());
}

TEST(Pareto, WhatTiesInTimeIsJudgedByItsAccuracy) {
  const SpeedAccuracy rough{10, 12, 1e-3}, exact{11, 13, 1e-15};
  EXPECT_TRUE(tied_in_time(rough, exact));
  EXPECT_THAT(pareto_front({rough, exact}), ElementsAre(false, true));
}

TEST(Pareto, RefusesToRankWhatTiesInBoth) {
  const SpeedAccuracy a{10, 12, 1e-3}, b{12, 13, 1e-3}, slower{12.5, 14, 1e-3};
  EXPECT_THAT(pareto_front({a, b}), ElementsAre(true, true));
  // a is faster than the third beyond the spreads.
  EXPECT_THAT(pareto_front({slower, b, a}), ElementsAre(false, true, true));
}

TEST(Pareto, AChainOfTiesDoesNotHideTheFastest) {
  const SpeedAccuracy fastest{1, 3, 1e-2}, middle{2, 6, 1e-3}, exact{5, 8, 1e-4};
  EXPECT_THAT(pareto_front({fastest, middle, exact}), ElementsAre(true, false, true));
}

RC_GTEST_PROP(Pareto, ExactlyWhatTheFrontBeatsIsOffIt, ()) {
  // Few values, so that ties of every kind come up.
  const auto candidates = *rc::gen::container<std::vector<SpeedAccuracy>>(rc::gen::map(
      rc::gen::tuple(rc::gen::inRange(1, 9), rc::gen::inRange(0, 4), rc::gen::inRange(0, 4)),
      [](const std::tuple<int, int, int>& t) {
        const auto [low, width, error] = t;
        return SpeedAccuracy{1.0 * low, 1.0 * (low + width), 1.0 * error};
      }));
  const auto front = pareto_front(candidates);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    bool beaten = false;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      beaten = beaten || (front[k] && beats(candidates[k], candidates[i]));
    }
    RC_ASSERT(front[i] == !beaten);
  }
}

}  // namespace
}  // namespace touchstone
