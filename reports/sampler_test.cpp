#include "reports/sampler.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "candidates/candidates.hpp"
#include "properties/files/configuration_json.hpp"
#include "reports/report_json.hpp"

namespace touchstone {
namespace {

/// Boxes at their worst: tied normals, families of them, every status.
Campaign small_campaign() {
  Campaign c;
  c.pairs = {Pair::box, Pair::sphere};
  c.classes = {"touching", "concentric", "general-deep"};
  c.candidates = find_candidates({"reference", "bullet", "capsule"});
  c.count = 6;
  return c;
}

Sample sample_of(const Campaign& campaign, Purpose purpose, std::size_t cell, std::uint64_t first,
                 std::uint64_t last) {
  auto processes = start(campaign.candidates, 0);
  return sample_run(campaign, purpose, pointers(processes), cells(campaign), {{cell, first, last}})
      .front();
}

/// Everything in it but the oracle's times.
std::string text(const Sample& sample, Purpose purpose) {
  std::string result;
  for (std::size_t k = 0; k < sample.tallies.size(); ++k) {
    ResultRow row;
    row.statistics = sample.tallies[k].statistics();
    result += to_json(row).dump() + '\n';
    for (const Case& c : sample.tallies[k].worst) {
      result += fmt::format("{} {} {}\n", c.cell, c.index, outcome_name(c.score.outcome));
      if (purpose == Purpose::campaign) continue;
      auto [configuration, truth, answers] = sample.examined(k, c.index);
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
  return result + fmt::format(" {}", sample.oracle_microseconds.size());
}

TEST(Sample, IsReadBackToTheLastBit) {
  const Campaign campaign = small_campaign();
  for (const Purpose purpose : {Purpose::report, Purpose::campaign}) {
    for (std::size_t cell = 0; cell < cells(campaign).size(); ++cell) {
      const Sample sample = sample_of(campaign, purpose, cell, 0, 6);
      const Sample read = Sample::from_bytes(sample.bytes(), 3, purpose);
      EXPECT_EQ(text(read, purpose), text(sample, purpose));
      EXPECT_EQ(read.oracle_microseconds, sample.oracle_microseconds);
    }
  }
}

TEST(Sample, OfUnitsAddedUpIsThatOfTheWhole) {
  const Campaign campaign = small_campaign();
  for (const Purpose purpose : {Purpose::report, Purpose::campaign}) {
    Sample sum = sample_of(campaign, purpose, 1, 0, 2);
    sum.add(sample_of(campaign, purpose, 1, 2, 6));
    EXPECT_EQ(text(sum, purpose), text(sample_of(campaign, purpose, 1, 0, 6), purpose));
  }
}

TEST(Sample, KeepsTruthAndAnswersOfEveryWorstCase) {
  const Campaign campaign = small_campaign();
  for (std::size_t cell = 0; cell < cells(campaign).size(); ++cell) {
    const Sample sample = sample_of(campaign, Purpose::report, cell, 0, 6);
    for (std::size_t k = 0; k < 3; ++k) {
      for (const Case& worst : sample.tallies[k].worst) {
        const auto [configuration, truth, answers] = sample.examined(k, worst.index);
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
  Campaign campaign = small_campaign();
  const auto sampled = [&](unsigned workers) {
    campaign.workers = workers;
    std::vector<std::string> units(6);
    EXPECT_TRUE(sample(
        campaign, Purpose::report, units.size() / 2,
        [](std::uint64_t cell) {
          return UnitRun{{cell, 0, 3}, {cell, 3, 6}};
        },
        [&](std::uint64_t cell, const std::vector<Sample>& samples) {
          ASSERT_EQ(samples.size(), 2u);
          for (std::size_t i = 0; i < 2; ++i) {
            EXPECT_TRUE(units[2 * cell + i].empty());
            units[2 * cell + i] = text(samples[i], Purpose::report);
          }
        },
        [] { return true; }));
    return units;
  };
  EXPECT_EQ(sampled(1), sampled(3));
}

TEST(Sampler, EndsWhenItIsTold) {
  const Campaign campaign = small_campaign();
  EXPECT_FALSE(sample(
      campaign, Purpose::campaign, 1000000,
      [](std::uint64_t) {
        return UnitRun{{0, 0, 1}};
      },
      [](std::uint64_t, const std::vector<Sample>&) {}, [] { return false; }));
}

TEST(Sampler, OfUnitsInOneSessionGivesWhatEachGivesInItsOwn) {
  const Campaign campaign = small_campaign();
  auto processes = start(campaign.candidates, 0);
  const UnitRun run = {{0, 0, 4}, {1, 0, 6}, {2, 2, 6}, {4, 0, 1}};
  for (const Purpose purpose : {Purpose::report, Purpose::campaign}) {
    const auto samples = sample_run(campaign, purpose, pointers(processes), cells(campaign), run);
    ASSERT_EQ(samples.size(), run.size());
    for (std::size_t i = 0; i < run.size(); ++i) {
      EXPECT_EQ(
          text(samples[i], purpose),
          text(sample_of(campaign, purpose, run[i].cell, run[i].first, run[i].last), purpose));
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
      ByteWriter out;
      out.put(c);
      const std::string bytes = out.take();
      const Configuration read = ByteReader(bytes).get_configuration();
      EXPECT_EQ(pair_of(read), pair);
      EXPECT_EQ(read.pose_b.rotation(), c.pose_b.rotation());
      ByteWriter again;
      again.put(read);
      EXPECT_EQ(again.take(), bytes) << name;
    }
  }
}

}  // namespace
}  // namespace touchstone
