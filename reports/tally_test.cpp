#include "reports/tally.hpp"

#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>
#include <vector>

#include <nlohmann/json.hpp>

#include "candidates/candidates.hpp"
#include "reports/make_report.hpp"
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

ScoreTally tally_of(const std::vector<Score>& scores, Resolution resolution) {
  ScoreTally tally(resolution);
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
  for (const Resolution resolution : {Resolution::exact, Resolution::eighths}) {
    const Statistics s = tally_of({agreeing, overdeep, missed}, resolution).statistics();
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
    const Resolution resolution = *rc::gen::element(Resolution::exact, Resolution::eighths);
    std::vector<ScoreTally> parts(4, ScoreTally(resolution));
    for (std::size_t i = 0; i < scores.size(); ++i) {
      parts[*rc::gen::inRange<std::size_t>(0, 4)].add(3, i, scores[i]);
    }
    ScoreTally sum(resolution);
    const auto orders =
        std::vector<std::vector<std::size_t>>{{0, 1, 2, 3}, {3, 2, 1, 0}, {2, 0, 3, 1}};
    for (const std::size_t i : *rc::gen::elementOf(orders)) sum.add(parts[i]);
    RC_ASSERT(text(sum) == text(tally_of(scores, resolution)));
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
    const Statistics exact = tally_of(scores, Resolution::exact).statistics();
    const Statistics found = tally_of(scores, Resolution::eighths).statistics();
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
  const auto bias = [](const std::vector<double>& errors, Resolution resolution) {
    std::vector<Score> scores(errors.size());
    for (std::size_t i = 0; i < errors.size(); ++i) scores[i].depth_error = errors[i];
    return tally_of(scores, resolution).statistics().bias;
  };
  EXPECT_EQ(bias({-3, 1, -2}, Resolution::exact)->value, -2);
  EXPECT_EQ(bias({-3, 1, 2, 0}, Resolution::exact)->value, 0);
  EXPECT_EQ(bias({-3, 1, 2, 4, 5}, Resolution::exact)->value, 2);
  const auto binned = bias({-3, 1, -2.1}, Resolution::eighths);
  EXPECT_LE(binned->bounds->lower, -2.1);
  EXPECT_GE(binned->bounds->upper, -2.1);
  EXPECT_LT(binned->bounds->upper, 0);
  EXPECT_EQ(binned->value, binned->bounds->lower);
  EXPECT_FALSE(bias({}, Resolution::exact));
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
               Resolution::eighths);
  std::vector<std::uint64_t> indices;
  for (const Case& c : tally.worst) indices.push_back(c.index);
  EXPECT_THAT(indices, testing::ElementsAre(6, 4, 2, 0));  // of equal ones, 1 and 3, neither
}

TEST(ScoreTally, KeepsTheFirstOfEquallyBadCases) {
  Score s;
  s.outcome = Outcome::missed;
  s.severity = 1;
  ScoreTally tally(Resolution::exact);
  for (const std::uint64_t index : {7U, 9U, 2U, 5U}) tally.add(0, index, s);
  std::vector<std::uint64_t> indices;
  for (const Case& c : tally.worst) indices.push_back(c.index);
  EXPECT_THAT(indices, testing::ElementsAre(2, 5));
}

TEST(ScoreTally, KeepsTheLargestDoubleForWhatIsBeyond) {
  Score s;
  s.outcome = Outcome::overdeep;
  s.depth_error = -std::numeric_limits<double>::infinity();
  s.normal_regret = std::numeric_limits<double>::quiet_NaN();
  s.severity = std::numeric_limits<double>::infinity();
  constexpr double largest = std::numeric_limits<double>::max();
  const ScoreTally tally = tally_of({s}, Resolution::eighths);
  EXPECT_EQ(tally.statistics().depth_error->max, largest);
  EXPECT_EQ(tally.statistics().normal_regret->median, largest);
  EXPECT_EQ(tally.worst[0].score.depth_error, -largest);
  EXPECT_EQ(tally.worst[0].score.severity, largest);
}

TEST(Magnitudes, HaveTheLargestDoubleForWhatIsNotFinite) {
  for (const Resolution resolution : {Resolution::exact, Resolution::eighths}) {
    Magnitudes m(resolution);
    m.add(-std::numeric_limits<double>::infinity());
    m.add(std::numeric_limits<double>::quiet_NaN());
    EXPECT_EQ(m.quantiles()->median, std::numeric_limits<double>::max());
    EXPECT_EQ(m.quantiles()->max, std::numeric_limits<double>::max());
  }
}

TEST(Magnitudes, BoundEveryValue) {
  constexpr double smallest = std::numeric_limits<double>::denorm_min();
  for (const double value : {0.0, smallest, 1e-300, 0.999, 1.0, 1.2499999, 1.25, 3e7, 1.7e308}) {
    Magnitudes m(Resolution::eighths);
    m.add(-value);
    m.add(1e308 * 1.79);
    const Bounds bounds = m.ranked(1);
    EXPECT_LE(bounds.lower, value);
    EXPECT_GE(bounds.upper, value);
    EXPECT_LE(bounds.upper, bounds.lower * 1.125 + 1e-307) << value;
  }
  EXPECT_FALSE(Magnitudes(Resolution::eighths).quantiles());
}

Magnitudes exactly(const std::vector<double>& values) {
  Magnitudes result(Resolution::exact);
  for (const double v : values) result.add(v);
  return result;
}

TEST(Magnitudes, HaveQuantilesByNearestRank) {
  std::vector<double> values;
  for (int i = 200; i >= 1; --i) values.push_back(i);
  const Quantiles q = *exactly(values).quantiles();
  EXPECT_EQ(q.median, 100);
  EXPECT_EQ(q.p99, 198);
  EXPECT_EQ(q.max, 200);
  EXPECT_FALSE(q.median_bounds);
  EXPECT_EQ(exactly({7}).quantiles()->p99, 7);
  EXPECT_FALSE(exactly({}).quantiles());
}

TEST(Magnitudes, CountHalfDecadesAndZerosApart) {
  EXPECT_EQ(exactly({0, 1e-3, 2e-3, 5e-3, 0.5, 0}).half_decades(),
            (LogHistogram{2, -6, {2, 1, 0, 0, 0, 1}}));
  EXPECT_EQ(exactly({0}).half_decades(), (LogHistogram{1, 0, {}}));
  EXPECT_FALSE(exactly({}).half_decades());
  const LogHistogram some = *exactly({0, 1e-3, 2e-3, 5e-3, 0.5, 0}).half_decades();
  EXPECT_EQ(some.count(), 6u);
  EXPECT_EQ(some.above(1e-5), 4u);
  EXPECT_EQ(some.above(1e-3), 2u);
  EXPECT_EQ(some.above(1), 0u);
  const LogHistogram beyond = *exactly({1e-300, 1e300}).half_decades();  // in the outermost ones
  EXPECT_EQ(beyond.first, -36);
  EXPECT_EQ(beyond.counts.size(), 48u);
  EXPECT_EQ(beyond.counts.front() + beyond.counts.back(), 2u);
}

TEST(CoverageTally, CountsSharesFromBelow) {
  CoverageTally tally{Magnitudes(Resolution::exact)};
  EXPECT_FALSE(tally.shares());
  for (int i = 0; i <= 200; ++i) tally.add(i / 200.0);
  const Shares s = *tally.shares();
  EXPECT_NEAR(s.mean, 0.5, 1e-12);
  EXPECT_NEAR(s.median, 0.5, 1e-12);
  EXPECT_NEAR(s.p1, 0.01, 1e-12);
  EXPECT_EQ(s.min, 0);
}

Configuration turned(double angle, const Shape& b) {
  const Eigen::Quaterniond q(std::cos(angle / 2), std::sin(angle / 2), 0, 0);
  return {Cylinder(0.5, 2), Pose(Vec3(3, 0, 4), q), b, Pose()};
}

TEST(Variables, TiltIsMeasuredFromParallelAndFromPerpendicular) {
  const double quarter = std::acos(0.0);
  const Shape plane = Plane(Vec3(0, 0, 2), 0);
  for (const double tilt : {1e-9, 1e-3, 0.7}) {
    for (const Shape& b : {plane, Shape(Capsule(1, 1)), Shape(Cylinder(1, 1))}) {
      EXPECT_NEAR(*value_of(Variable::tilt, turned(tilt, b), -1), tilt, 1e-15);
      EXPECT_NEAR(*value_of(Variable::tilt, turned(quarter - tilt, b), -1), tilt, 1e-15);
    }
  }
  EXPECT_FALSE(value_of(Variable::tilt, turned(1, Sphere(1)), -1));
  // Of a box's axes the nearest counts: turned about x, the cylinder stays perpendicular to x.
  const Shape box = Box(Vec3(1, 1, 1));
  EXPECT_EQ(*value_of(Variable::tilt, turned(0.7, box), -1), 0);
  const Eigen::Quaterniond skew(1, 0.1, 0.2, 0);
  const Configuration c{Cylinder(0.5, 2), Pose(Vec3(0, 0, 0), skew), box, Pose()};
  EXPECT_NEAR(*value_of(Variable::tilt, c, -1), std::asin(0.2 / 1.05), 1e-15);
}

TEST(Variables, AreRelativeToSize) {
  const Configuration c = turned(0, Box(Vec3(1, 1, 10)));
  EXPECT_DOUBLE_EQ(*value_of(Variable::depth, c, -0.1), 0.2);
  EXPECT_FALSE(value_of(Variable::depth, c, 0.1));
  EXPECT_DOUBLE_EQ(*value_of(Variable::aspect, c, -0.1), 10);
  EXPECT_DOUBLE_EQ(*value_of(Variable::aspect, turned(0, Plane(Vec3(0, 0, 1), 0)), -0.1), 4);
  EXPECT_DOUBLE_EQ(*value_of(Variable::distance, c, -0.1), 0.5);
}

TEST(Trends, HaveTheLastDecadeForWhatIsBeyondTheLargestDouble) {
  Score missed;
  missed.outcome = Outcome::missed;
  missed.severity = 1;
  TrendTally tally;
  tally.add({Cylinder(1e-9, 1e-9), Pose(Vec3(1e300, 0, 0)), Sphere(1e-9), Pose()}, -1e-9, {missed});
  std::vector<int> decades;
  for (const Trend& trend : tally.trends("cylinder-sphere", "extreme", {"far"})) {
    if (trend.variable == "distance") decades.push_back(trend.bins.at(0).decade.value());
  }
  EXPECT_EQ(decades, std::vector{308});
}

TEST(Trends, EveryJudgedAnswerLiesInOneDecade) {
  Campaign campaign{.pairs = {Pair::plane, Pair::sphere},
                    .classes = {"general-shallow", "far-from-origin"},
                    .candidates = find_candidates({"reference", "capsule"}),
                    .count = 5};
  std::size_t missed = 0;
  for (const Trend& trend : make_report(campaign, "x").trends) {
    EXPECT_FALSE(trend.pair == "cylinder-sphere" && trend.variable == "tilt");
    std::size_t count = 0;
    for (const TrendBin& bin : trend.bins) {
      count += bin.count;
      EXPECT_LE(bin.missed, bin.count);
      EXPECT_LE(bin.median, bin.max);
      if (trend.variable == "distance") missed += bin.missed;
    }
    if (trend.variable != "depth") {
      EXPECT_EQ(count, 5u);  // one class in each group
    }
  }
  // The inscribed capsule misses the shallow contacts at the rim.
  EXPECT_GT(missed, 0u);
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
