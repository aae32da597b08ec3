#include "reports/statistics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <vector>

namespace touchstone {
namespace {

TEST(Statistics, SharesCountFromBelow) {
  std::vector<double> values;
  for (int i = 0; i <= 200; ++i) values.push_back(i / 200.0);
  const Shares s = *shares(values);
  EXPECT_NEAR(s.mean, 0.5, 1e-12);
  EXPECT_NEAR(s.median, 0.5, 1e-12);
  EXPECT_NEAR(s.p1, 0.01, 1e-12);
  EXPECT_EQ(s.min, 0);
  EXPECT_FALSE(shares({}));
}

TEST(Statistics, QuantilesAreNearestRank) {
  std::vector<double> values;
  for (int i = 200; i >= 1; --i) values.push_back(i);
  const Quantiles q = *quantiles(values);
  EXPECT_EQ(q.median, 100);
  EXPECT_EQ(q.p99, 198);
  EXPECT_EQ(q.max, 200);
  EXPECT_EQ(quantiles({7})->p99, 7);
  EXPECT_FALSE(quantiles({}));
}

TEST(LogHistogram, CountsHalfDecadesAndZerosApart) {
  const LogHistogram h = log_histogram({0, 1e-3, 2e-3, 5e-3, 0.5, 0});
  EXPECT_EQ(h.zero, 2u);
  EXPECT_EQ(h.first, -6);
  EXPECT_EQ(h.counts, (std::vector<std::uint64_t>{2, 1, 0, 0, 0, 1}));
}

TEST(LogHistogram, KeepsWhatIsBeyondItsEnds) {
  const LogHistogram h = log_histogram({1e-300, 1e300});
  EXPECT_EQ(h.first, -36);
  EXPECT_EQ(h.counts.size(), 48u);
  EXPECT_EQ(h.counts.front() + h.counts.back(), 2u);
  EXPECT_EQ(log_histogram({}), LogHistogram{});
  EXPECT_EQ(log_histogram({0}), (LogHistogram{1, 0, {}}));
}

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

TEST(ParetoFront, WhatIsNoNativeCodeTakesNoNativeCodeOffIt) {
  const SpeedAccuracy slow{200, 210, 1e-6};
  SpeedAccuracy compiled_to_wasm{90, 100, 1e-9}, slower_script{900, 910, 1e-6};
  compiled_to_wasm.is_native = slower_script.is_native = false;
  EXPECT_THAT(pareto_front({slow, compiled_to_wasm, slower_script}),
              ElementsAre(true, true, false));
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
