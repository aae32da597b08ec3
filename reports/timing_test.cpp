#include "reports/timing.hpp"

#include <gtest/gtest.h>

namespace touchstone {
namespace {

Repetitions repetitions(double first, double step, bool counted = false) {
  Repetitions r;
  for (std::size_t i = 0; i < max_repetitions; ++i) {
    r.push_back({first + step * static_cast<double>(i), std::nullopt});
    if (counted) r.back().instructions = 1000;
  }
  return r;
}
const std::vector<std::size_t> both = {0, 1};

TEST(Spread, IsMedianAndQuartiles) {
  const auto s = spread({7, 1, 2, 3, 4, 5, 6, 8, 9, 10, 11});
  EXPECT_EQ(s->median, 6);
  EXPECT_EQ(s->low, 3);
  EXPECT_EQ(s->high, 9);
  EXPECT_EQ(spread({4})->low, 4);
  EXPECT_FALSE(spread({}));
}

TEST(Repetitions, AreSettledWhenHalfOfThemLieWithinThreePercent) {
  const auto settled = [](const std::vector<double>& times) {
    Repetitions r;
    for (const double t : times) r.push_back({t, std::nullopt});
    return is_settled(r);
  };
  EXPECT_TRUE(settled({100, 101, 102.9, 50, 900}));
  EXPECT_FALSE(settled({100, 102, 103.2, 50, 900}));
  EXPECT_FALSE(settled({}));
}

TEST(QueryTime, IsTheMedianOverCellsOfEachRepetition) {
  // A cell that no one timed counts for nothing.
  const Times times = {{repetitions(100, 0)}, {repetitions(300, 10)}, {repetitions(900, 0)}, {{}}};
  const auto time = query_time(times, {0, 1, 2, 3}, 0);
  EXPECT_EQ(time->nanoseconds.median, 350);
  EXPECT_EQ(time->nanoseconds.low, 320);
  EXPECT_EQ(time->nanoseconds.high, 380);
  EXPECT_FALSE(time->instructions);
  EXPECT_FALSE(query_time(times, {3}, 0));
  EXPECT_EQ(query_time(times, {0, 2}, 0)->nanoseconds.median, 100);  // of two the smaller one
}

TEST(QueryTime, GoesAgainThroughTheRepetitionsOfACellThatSettledEarly) {
  const Repetitions early = {{10, {}}, {20, {}}, {30, {}}}, late = repetitions(1000, 1);
  const auto time = query_time({{early}, {early}, {late}}, {0, 1, 2}, 0);
  EXPECT_EQ(time->repetitions, max_repetitions);
  EXPECT_EQ(time->nanoseconds.median, 20);  // 10, 20, 30, 10, …: four, four and three of them
  EXPECT_EQ(query_time({{early}}, {0}, 0)->repetitions, 3u);
  EXPECT_EQ(time_ratio({{early, late}}, {0}, 0, 1)->median,
            20 / 1007.0);  // the sixth of the ratios
}

TEST(QueryTime, HasInstructionsWhereAllWereCounted) {
  const Times times = {{repetitions(1, 0, true)}, {repetitions(1, 0)}};
  EXPECT_EQ(query_time(times, {0}, 0)->instructions, 1000);
  EXPECT_FALSE(query_time(times, both, 0)->instructions);
}

TEST(TimeRatio, CancelsWhatDisturbsBoth) {
  // The machine slows down threefold during the run: the times spread, their ratio does not.
  const Times times = {{repetitions(200, 40), repetitions(100, 20)}};
  const auto ratio = time_ratio(times, {0}, 0, 1);
  EXPECT_DOUBLE_EQ(ratio->median, 2);
  EXPECT_DOUBLE_EQ(ratio->low, 2);
  EXPECT_DOUBLE_EQ(ratio->high, 2);
  EXPECT_GT(query_time(times, {0}, 0)->nanoseconds.high, 300);
}

TEST(TimeRatio, IsOfTheCellsThatBothWereTimedOn) {
  const Times times = {{repetitions(50, 0), repetitions(100, 0)}, {{}, repetitions(9000, 0)}};
  EXPECT_EQ(time_ratio(times, both, 0, 1)->median, 0.5);
  EXPECT_FALSE(time_ratio(times, {1}, 0, 1));
}

}  // namespace
}  // namespace touchstone
