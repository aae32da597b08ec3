#include "reports/sampler.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "properties/files/bytes.hpp"
#include "properties/files/configuration_json.hpp"
#include "reports/report_json.hpp"
#include "reports/small_report_test.hpp"
#include "reports/timing.hpp"

namespace touchstone {
namespace {

/// Boxes at their worst: tied normals, families of them, every status.
Campaign sampled_campaign() {
  Campaign c{.pairs = {Pair::box, Pair::sphere},
             .classes = {"touching", "concentric", "general-deep"},
             .candidates = find_candidates({"reference", "bullet", "capsule"}),
             .count = 6};
  return c;
}

Sample sample_of(const Campaign& campaign, Resolution resolution, std::size_t cell,
                 std::uint64_t first, std::uint64_t last) {
  auto processes = start(campaign.candidates, 0);
  return sample_run(campaign, resolution, pointers(processes), cells(campaign),
                    {{cell, first, last}})
      .front();
}

/// Everything in it but the oracle's times.
std::string text(const Sample& sample, Resolution resolution) {
  std::string result;
  for (std::size_t k = 0; k < sample.tallies.size(); ++k) {
    ResultRow row;
    row.statistics = sample.tallies[k].statistics();
    result += to_json(row).dump() + '\n';
    for (const Case& c : sample.tallies[k].worst) {
      result += fmt::format("{} {} {}\n", c.cell, c.index, outcome_name(c.score.outcome));
      if (resolution == Resolution::eighths) continue;
      auto [configuration, truth, answers] = *sample.examined(k, c.index);
      Examination e{"x", configuration, truth, {}, ""};
      for (const auto& [answer, score] : answers) {
        e.answers.push_back({std::to_string(e.answers.size()), answer, score});
      }
      result += to_json(e).dump() + '\n';
    }
    for (const Outcome outcome : sample.timed_outcomes[k]) result += outcome_name(outcome);
  }
  for (const Configuration& c : sample.timed) result += to_hex_json(c).dump() + '\n';
  for (const Trend& trend : sample.trends.trends("", "", {"a", "b", "c"})) {
    result += trend.candidate + trend.variable;
    for (const TrendBin& bin : trend.bins) {
      result += fmt::format(" {} {} {} {} {}", bin.decade.value_or(-99), bin.count, bin.missed,
                            bin.median, bin.max);
    }
  }
  return result + fmt::format(" {}", sample.oracle_microseconds.count());
}

TEST(Sample, IsReadBackToTheLastBit) {
  const Campaign campaign = sampled_campaign();
  for (const Resolution resolution : {Resolution::exact, Resolution::eighths}) {
    for (std::size_t cell = 0; cell < cells(campaign).size(); ++cell) {
      const Sample sample = sample_of(campaign, resolution, cell, 0, 6);
      Sample read(3, resolution);
      BytesIn(to_bytes(sample))(read);
      EXPECT_EQ(text(read, resolution), text(sample, resolution));
      EXPECT_EQ(to_bytes(read.oracle_microseconds), to_bytes(sample.oracle_microseconds));
    }
  }
}

TEST(Sample, OfUnitsAddedUpIsThatOfTheWhole) {
  const Campaign campaign = sampled_campaign();
  for (const Resolution resolution : {Resolution::exact, Resolution::eighths}) {
    Sample sum = sample_of(campaign, resolution, 1, 0, 2);
    sum.add(sample_of(campaign, resolution, 1, 2, 6));
    EXPECT_EQ(text(sum, resolution), text(sample_of(campaign, resolution, 1, 0, 6), resolution));
  }
}

TEST(Sample, KeepsTruthAndAnswersOfEveryWorstCase) {
  const Campaign campaign = sampled_campaign();
  for (std::size_t cell = 0; cell < cells(campaign).size(); ++cell) {
    const Sample sample = sample_of(campaign, Resolution::exact, cell, 0, 6);
    for (std::size_t k = 0; k < 3; ++k) {
      for (const Case& worst : sample.tallies[k].worst) {
        const auto [configuration, truth, answers] = *sample.examined(k, worst.index);
        const oracle::Truth again = oracle::truth(configuration);
        EXPECT_EQ(truth.signed_distance.lo, again.signed_distance.lo);
        EXPECT_EQ(truth.signed_distance.hi, again.signed_distance.hi);
        ASSERT_EQ(truth.normals.size(), again.normals.size());
        EXPECT_EQ(truth.normals.back().n, again.normals.back().n);
        EXPECT_EQ(truth.normals.back().to_b, again.normals.back().to_b);
        EXPECT_EQ(truth.ties, again.ties);
        EXPECT_EQ(truth.families.size(), again.families.size());
        ASSERT_EQ(answers.size(), k == 0 ? 1u : 2u);
        EXPECT_EQ(answers.front().second.severity, worst.score.severity);
        EXPECT_EQ(answers.front().second.outcome, worst.score.outcome);
      }
    }
  }
}

TEST(Sampler, HandsOverEveryUnitOnceWhateverTheNumberOfWorkers) {
  Campaign campaign = sampled_campaign();
  const auto sampled = [&](unsigned workers) {
    campaign.workers = workers;
    std::vector<std::string> units(6);
    EXPECT_TRUE(sample(
        scorer(campaign, Resolution::exact), units.size() / 2,
        [](std::uint64_t cell) {
          return UnitRun{{cell, 0, 3}, {cell, 3, 6}};
        },
        [&](std::uint64_t cell, const std::vector<Sample>& samples) {
          ASSERT_EQ(samples.size(), 2u);
          for (std::size_t i = 0; i < 2; ++i) {
            EXPECT_TRUE(units[2 * cell + i].empty());
            units[2 * cell + i] = text(samples[i], Resolution::exact);
          }
        },
        [] { return true; }));
    return units;
  };
  EXPECT_EQ(sampled(1), sampled(3));
}

TEST(Sampler, EndsWhenItIsTold) {
  const Campaign campaign = sampled_campaign();
  EXPECT_FALSE(sample(
      scorer(campaign, Resolution::eighths), 1000000,
      [](std::uint64_t) {
        return UnitRun{{0, 0, 1}};
      },
      [](std::uint64_t, const std::vector<Sample>&) {}, [] { return false; }));
}

TEST(Sampler, OfUnitsInOneSessionGivesWhatEachGivesInItsOwn) {
  const Campaign campaign = sampled_campaign();
  auto processes = start(campaign.candidates, 0);
  const UnitRun run = {{0, 0, 4}, {1, 0, 6}, {2, 2, 6}, {4, 0, 1}};
  for (const Resolution resolution : {Resolution::exact, Resolution::eighths}) {
    const auto samples =
        sample_run(campaign, resolution, pointers(processes), cells(campaign), run);
    ASSERT_EQ(samples.size(), run.size());
    for (std::size_t i = 0; i < run.size(); ++i) {
      EXPECT_EQ(text(samples[i], resolution),
                text(sample_of(campaign, resolution, run[i].cell, run[i].first, run[i].last),
                     resolution));
    }
  }
}

TEST(Runs, HoldAllUnitsInOrderAndNoMoreConfigurationsThanAsked) {
  const std::vector<Unit> units = {{0, 0, 20},    {1, 0, 20}, {2, 0, 25}, {3, 0, 512},
                                   {3, 512, 520}, {4, 0, 1},  {5, 0, 63}};
  const std::vector<UnitRun> runs = runs_of(units, 64);
  std::vector<std::size_t> sizes;
  std::vector<Unit> joined;
  for (const UnitRun& run : runs) {
    sizes.push_back(run.size());
    joined.insert(joined.end(), run.begin(), run.end());
  }
  EXPECT_EQ(sizes, (std::vector<std::size_t>{2, 1, 1, 2, 1}));
  ASSERT_EQ(joined.size(), units.size());
  for (std::size_t i = 0; i < units.size(); ++i) {
    EXPECT_EQ(joined[i].cell, units[i].cell);
    EXPECT_EQ(joined[i].first, units[i].first);
    EXPECT_EQ(joined[i].last, units[i].last);
  }
}

TEST(Sampler, MakesConfigurationsOfEveryShapeAgainToTheLastBit) {
  for (const Pair pair : all_pairs) {
    for (const std::string& name : pose_classes(pair)) {
      const Configuration c = make_configuration({pair, name, 7, 1});
      const std::string bytes = to_bytes(c);
      const auto read = from_bytes<Configuration>(bytes);
      EXPECT_EQ(pair_of(read), pair);
      EXPECT_EQ(read.pose_b.rotation(), c.pose_b.rotation());
      EXPECT_EQ(to_bytes(read), bytes) << name;
    }
  }
}

/// Planes under A at these x; below zero, the candidate of the tests never answers.
std::vector<Configuration> planes_under(const std::vector<double>& xs) {
  std::vector<Configuration> result;
  for (const double x : xs) {
    const Configuration c = make_configuration({Pair::plane, "lying", 1, 0});
    result.push_back({c.a, Pose({x, 0, 0}, {1, 0, 0, 0}), c.b, c.pose_b});
  }
  return result;
}

/// A letter for each configuration: answered, timed out, or not asked. `sessions` counts.
std::string asked(const std::vector<double>& xs, const std::vector<std::size_t>& unit_ends,
                  int* sessions = nullptr) {
  const auto ask = [&](std::span<const Configuration> configurations, bool in_new_session) {
    if (sessions) *sessions += in_new_session;
    std::vector<Answer> answers;
    for (const Configuration& c : configurations) {
      const bool hangs = c.pose_a.position().x() < 0;
      answers.emplace_back().status = hangs ? TS_TIMED_OUT : TS_NONE;
      if (hangs) break;
    }
    return answers;
  };
  std::string letters;
  for (const Answer& a : answers_until_stopped(ask, planes_under(xs), unit_ends)) {
    letters += !a.was_asked ? '.' : a.status == TS_TIMED_OUT ? 't' : 'a';
  }
  return letters;
}

TEST(AnswersUntilStopped, AreAllWhereFewTimeOut) {
  EXPECT_EQ(asked({1, -1, 1, 1, -1, 1}, {6}), "ataata");
}

TEST(AnswersUntilStopped, EndWithTheThirdTimeOut) {
  std::vector<double> xs(10, -1);
  EXPECT_EQ(asked(xs, {10}), "ttt.......");
  xs[0] = xs[2] = 1;
  EXPECT_EQ(asked(xs, {10}), "atatt.....");
  EXPECT_EQ(asked({1, -1, -1, -1}, {4}), "attt");
}

TEST(AnswersUntilStopped, BeginAnewInEveryUnitAndGoOnInOneSession) {
  int sessions = 0;
  std::vector<double> xs(29, 1);
  for (const int i : {1, 2, 5, 6, 7, 8}) xs[i] = -1;
  EXPECT_EQ(asked(xs, {6, 11, 29}, &sessions),
            "attaat"
            "ttt.."
            "aaaaaaaaaaaaaaaaaa");
  EXPECT_EQ(sessions, 1);
}

/// A candidate that never answers where A's x is negative.
Campaign stalling_campaign() {
  add_test_plugin("touchstone-sabotage.so");
  Campaign c{.pairs = {Pair::plane},
             .classes = {"general-shallow"},
             .candidates = find_candidates({"stalling", "reference"}),
             .count = 40};
  c.limits.seconds = 0.2;  // beyond its slow answers even when lowered to a tenth
  return c;
}

TEST(Sampler, StopsACandidateThatHangsAtTheSamePlaceWhateverTheNumberOfWorkers) {
  Campaign campaign = stalling_campaign();
  std::vector<double> xs;
  for (std::uint64_t i = 0; i < 40; ++i) {
    const Identity identity{Pair::plane, "general-shallow", campaign.seed, i};
    xs.push_back(make_configuration(identity).pose_a.position().x());
  }
  const std::string expected = asked(xs, {20, 40});
  ASSERT_GT(std::count(expected.begin(), expected.end(), '.'), 4);
  for (const unsigned workers : {1u, 2u}) {
    campaign.workers = workers;
    std::string found;
    sample(
        scorer(campaign, Resolution::exact), 1,
        [](std::uint64_t) {
          return UnitRun{{0, 0, 20}, {0, 20, 40}};
        },
        [&](std::uint64_t, const std::vector<Sample>& samples) {
          for (const Sample& s : samples) {
            for (const Outcome o : s.timed_outcomes[0]) {
              found += o == Outcome::not_asked ? '.' : o == Outcome::timed_out ? 't' : 'a';
            }
            // The reference is asked everything, and is shown beside no answer that there is not.
            EXPECT_EQ(s.tallies[1].outcomes[0], 20u);
            for (const Case& c : s.tallies[1].worst) {
              const bool both = expected[c.index] != '.';
              EXPECT_EQ(s.examined(1, c.index)->answers.size(), both ? 2u : 1u);
            }
          }
        },
        [] { return true; });
    EXPECT_EQ(found, expected);
  }
}

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

TEST(QueryTime, HasTheTailOfTheLastRepetitionAndOfSeveralCellsTheLongest) {
  Repetitions quick = repetitions(100, 0), slow = repetitions(200, 0);
  for (QueryCost& cost : quick) cost.tail = 900;
  quick.back().tail = 150;
  slow.back().tail = 799;
  const Times times = {{quick}, {slow}, {repetitions(10, 0)}};
  EXPECT_EQ(query_time(times, {0}, 0)->p95, 150);
  EXPECT_EQ(query_time(times, {0, 1, 2}, 0)->p95, 799);
  EXPECT_FALSE(query_time(times, {2}, 0)->p95);
  EXPECT_FALSE(has_slow_tail(*query_time(times, {1}, 0)));
  slow.back().tail = 801;
  EXPECT_TRUE(has_slow_tail(*query_time({{slow}}, {0}, 0)));
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
