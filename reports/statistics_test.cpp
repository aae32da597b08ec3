#include "reports/statistics.hpp"

#include <gtest/gtest.h>
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

}  // namespace
}  // namespace touchstone
