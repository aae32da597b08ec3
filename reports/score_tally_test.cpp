#include "reports/score_tally.hpp"

#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <rapidcheck.h>
#include <vector>

#include <nlohmann/json.hpp>

#include "reports/report_json.hpp"

namespace touchstone {
namespace {

/// Every kind of score: any outcome, errors of any magnitude, present or not.
Score arbitrary_score() {
  const auto maybe = [](double value) {
    return *rc::gen::arbitrary<bool>() ? std::optional(value) : std::nullopt;
  };
  const auto magnitude = [] {
    const double fraction = 1 + *rc::gen::inRange(0, 1000) / 1000.0;
    return std::ldexp(fraction, *rc::gen::inRange(-70, 20));
  };
  Score s;
  s.outcome = *rc::gen::elementOf(std::vector<Outcome>(all_outcomes.begin(), all_outcomes.end()));
  s.depth_error = maybe((*rc::gen::arbitrary<bool>() ? -1 : 1) * magnitude());
  s.normal_regret = maybe(magnitude());
  s.normal_angle = maybe(magnitude());
  s.point_error = maybe(magnitude());
  s.deepest_error = maybe((*rc::gen::arbitrary<bool>() ? -1 : 1) * magnitude());
  s.coverage = maybe(*rc::gen::inRange(0, 101) / 100.0);
  s.model_error = maybe(magnitude());
  s.solver_error = maybe(-magnitude());
  s.points = *rc::gen::inRange(0, 9);
  s.severity = *rc::gen::inRange(0, 4);  // many ties
  return s;
}

ScoreTally tally_of(const std::vector<Score>& scores, Precision precision) {
  ScoreTally tally(precision);
  for (std::size_t i = 0; i < scores.size(); ++i) tally.add(3, i, scores[i]);
  return tally;
}

/// Everything that a report says of it.
std::string text(const ScoreTally& tally) {
  ResultRow row;
  row.statistics = tally.statistics();
  std::string result = to_json(row).dump();
  for (const Case& c : tally.worst) {
    result += fmt::format(" {} {} {}", c.index, outcome_name(c.score.outcome), c.score.severity);
  }
  return result;
}

TEST(ScoreTally, CountsOutcomesAndPoints) {
  Score agreeing, overdeep, missed;
  agreeing.points = overdeep.points = 1;
  agreeing.depth_error = 0;
  overdeep.outcome = Outcome::overdeep;
  overdeep.depth_error = -2e-3;
  missed.outcome = Outcome::missed;
  for (const Precision precision : {Precision::exact, Precision::binned}) {
    const Statistics s = tally_of({agreeing, overdeep, missed}, precision).statistics();
    EXPECT_EQ(s.count, 3u);
    EXPECT_EQ(s.of(Outcome::agree), 1u);
    EXPECT_EQ(s.of(Outcome::overdeep), 1u);
    EXPECT_EQ(s.of(Outcome::missed), 1u);
    EXPECT_EQ(s.points.at(1), 2u);
    EXPECT_EQ(s.depth_error->max, 2e-3);
  }
}

TEST(ScoreTally, OfPartsInAnyOrderIsThatOfTheWhole) {
  EXPECT_TRUE(rc::check([] {
    std::vector<Score> scores(static_cast<std::size_t>(*rc::gen::inRange(1, 40)));
    for (Score& s : scores) s = arbitrary_score();
    const Precision precision = *rc::gen::element(Precision::exact, Precision::binned);
    std::vector<ScoreTally> parts(4, ScoreTally(precision));
    for (std::size_t i = 0; i < scores.size(); ++i) {
      // The mean of exact coverages depends on their order: only some sums of doubles are exact.
      if (scores[i].coverage) scores[i].coverage = std::round(*scores[i].coverage * 4) / 4;
      parts[*rc::gen::inRange<std::size_t>(0, 4)].add(3, i, scores[i]);
    }
    ScoreTally sum(precision);
    const auto orders =
        std::vector<std::vector<std::size_t>>{{0, 1, 2, 3}, {3, 2, 1, 0}, {2, 0, 3, 1}};
    for (const std::size_t i : *rc::gen::elementOf(orders)) sum.add(parts[i]);
    RC_ASSERT(text(sum) == text(tally_of(scores, precision)));
  }));
}

void expect_within(const std::optional<Bounds>& bounds, double value) {
  ASSERT_TRUE(bounds);
  EXPECT_LE(bounds->lower, value);
  EXPECT_GE(bounds->upper, value);
  EXPECT_LE(bounds->upper - bounds->lower, value / 8 + 1e-300);
}

TEST(ScoreTally, BinnedBoundsTheExactQuantiles) {
  EXPECT_TRUE(rc::check([] {
    std::vector<Score> scores(static_cast<std::size_t>(*rc::gen::inRange(1, 200)));
    for (Score& s : scores) s = arbitrary_score();
    const Statistics exact = tally_of(scores, Precision::exact).statistics();
    const Statistics found = tally_of(scores, Precision::binned).statistics();
    EXPECT_EQ(found.count, exact.count);
    EXPECT_EQ(found.outcomes, exact.outcomes);
    EXPECT_EQ(found.points, exact.points);
    if (exact.depth_error) {
      expect_within(found.depth_error->median_bounds, exact.depth_error->median);
      expect_within(found.depth_error->p99_bounds, exact.depth_error->p99);
      EXPECT_EQ(found.depth_error->max, exact.depth_error->max);
      EXPECT_GE(found.depth_error->median, exact.depth_error->median);
    }
    if (exact.bias) {
      EXPECT_LE(found.bias->bounds->lower, exact.bias->value);
      EXPECT_GE(found.bias->bounds->upper, exact.bias->value);
    }
    if (exact.severity) {
      expect_within(found.severity->median_bounds, exact.severity->median);
      EXPECT_EQ(found.severity->max, exact.severity->max);
    }
    if (exact.coverage) {
      EXPECT_NEAR(found.coverage->mean, exact.coverage->mean, CoverageTally::unit);
      EXPECT_LE(found.coverage->p1, exact.coverage->p1);
      EXPECT_EQ(found.coverage->min, exact.coverage->min);
    }
    RC_ASSERT(!testing::Test::HasFailure());
  }));
}

TEST(ScoreTally, TheBiasIsTheMedianDepthErrorWithItsSign) {
  const auto bias = [](const std::vector<double>& errors, Precision precision) {
    std::vector<Score> scores(errors.size());
    for (std::size_t i = 0; i < errors.size(); ++i) scores[i].depth_error = errors[i];
    return tally_of(scores, precision).statistics().bias;
  };
  EXPECT_EQ(bias({-3, 1, -2}, Precision::exact)->value, -2);
  EXPECT_EQ(bias({-3, 1, 2, 0}, Precision::exact)->value, 0);
  EXPECT_EQ(bias({-3, 1, 2, 4, 5}, Precision::exact)->value, 2);
  const auto binned = bias({-3, 1, -2.1}, Precision::binned);
  EXPECT_LE(binned->bounds->lower, -2.1);
  EXPECT_GE(binned->bounds->upper, -2.1);
  EXPECT_LT(binned->bounds->upper, 0);
  EXPECT_EQ(binned->value, binned->bounds->lower);
  EXPECT_FALSE(bias({}, Precision::exact));
}

TEST(ScoreTally, KeepsTheTwoWorstAndTheWorstOfEachOutcome) {
  const auto score = [](Outcome outcome, double severity) {
    Score s;
    s.outcome = outcome;
    s.severity = severity;
    return s;
  };
  const ScoreTally tally =
      tally_of({score(Outcome::agree, 1e-9), score(Outcome::missed, 5), score(Outcome::shallow, 2),
                score(Outcome::missed, 5), score(Outcome::missed, 7),
                score(Outcome::unsupported, 0), score(Outcome::crashed, 0)},
               Precision::binned);
  std::vector<std::uint64_t> indices;
  for (const Case& c : tally.worst) indices.push_back(c.index);
  EXPECT_THAT(indices, testing::ElementsAre(6, 4, 2, 0));  // of equal ones, 1 and 3, neither
}

TEST(ScoreTally, KeepsTheFirstOfEquallyBadCases) {
  Score s;
  s.outcome = Outcome::missed;
  s.severity = 1;
  ScoreTally tally(Precision::exact);
  for (const std::uint64_t index : {7U, 9U, 2U, 5U}) tally.add(0, index, s);
  std::vector<std::uint64_t> indices;
  for (const Case& c : tally.worst) indices.push_back(c.index);
  EXPECT_THAT(indices, testing::ElementsAre(2, 5));
}

TEST(Magnitudes, HaveTheLargestDoubleForWhatIsNotFinite) {
  for (const Precision precision : {Precision::exact, Precision::binned}) {
    Magnitudes m(precision);
    m.add(-std::numeric_limits<double>::infinity());
    m.add(std::numeric_limits<double>::quiet_NaN());
    EXPECT_EQ(m.quantiles()->median, std::numeric_limits<double>::max());
    EXPECT_EQ(m.quantiles()->max, std::numeric_limits<double>::max());
  }
}

TEST(Magnitudes, BoundEveryValue) {
  constexpr double smallest = std::numeric_limits<double>::denorm_min();
  for (const double value : {0.0, smallest, 1e-300, 0.999, 1.0, 1.2499999, 1.25, 3e7, 1.7e308}) {
    Magnitudes m(Precision::binned);
    m.add(-value);
    m.add(1e308 * 1.79);
    const auto bounds = m.percentile(50);
    EXPECT_LE(bounds->lower, value);
    EXPECT_GE(bounds->upper, value);
    EXPECT_LE(bounds->upper, bounds->lower * 1.125 + 1e-307) << value;
  }
  EXPECT_FALSE(Magnitudes(Precision::binned).percentile(50));
}

}  // namespace
}  // namespace touchstone
