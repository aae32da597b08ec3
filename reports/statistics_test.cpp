#include "reports/statistics.hpp"

#include <gtest/gtest.h>

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

TEST(Statistics, CountsOutcomesAndPoints) {
  Score agreeing, overdeep, missed;
  agreeing.points = overdeep.points = 1;
  agreeing.depth_error = 0;
  overdeep.outcome = Outcome::overdeep;
  overdeep.depth_error = -2e-3;
  missed.outcome = Outcome::missed;
  const Statistics s = statistics({agreeing, overdeep, missed});
  EXPECT_EQ(s.count, 3u);
  EXPECT_EQ(s.of(Outcome::agree), 1u);
  EXPECT_EQ(s.of(Outcome::overdeep), 1u);
  EXPECT_EQ(s.of(Outcome::missed), 1u);
  EXPECT_EQ(s.points.at(1), 2u);
  EXPECT_EQ(s.depth_error->max, 2e-3);
}

}  // namespace
}  // namespace touchstone
