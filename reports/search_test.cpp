#include "reports/search.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "candidates/candidates.hpp"

namespace touchstone {
namespace {

SearchResult found_by(const char* candidate, const Cell& cell, std::uint64_t budget,
                      std::uint64_t* asked = nullptr) {
  CandidateProcess process(find_candidate(candidate), 0);
  return search(process, {cell, 1, budget, Bar{}}, [&](std::uint64_t n) {
    if (asked) *asked = n;
  });
}

/// The worst severity of as many sampled configurations.
double sampled_severity(const char* candidate, const Cell& cell, std::uint64_t budget) {
  CandidateProcess process(find_candidate(candidate), 0);
  std::vector<Configuration> configurations;
  for (std::uint64_t i = 0; i < budget; ++i) {
    configurations.push_back(make_configuration({cell.pair, cell.pose_class, 1, i}));
  }
  const auto answers = process.answers(configurations);
  double worst = 0;
  for (std::size_t i = 0; i < budget; ++i) {
    const Configuration& c = configurations[i];
    worst = std::max(worst, score(c, oracle::truth(c), answers[i], Bar{}).severity);
  }
  return worst;
}

TEST(Search, FindsWorseThanSamplingDoes) {
  const Cell cell{Pair::sphere, "general-deep"};
  std::uint64_t asked = 0;
  const SearchResult found = found_by("capsule", cell, 800, &asked);
  EXPECT_EQ(asked, 800u);
  EXPECT_GT(found.score.severity, 1.05 * sampled_severity("capsule", cell, 800));
  EXPECT_GE(found.score.severity, found.sampled.severity);
}

TEST(Search, FindsTheSameAgain) {
  const Cell cell{Pair::box, "rim-face"};
  EXPECT_EQ(to_json(found_by("bullet", cell, 200), cell),
            to_json(found_by("bullet", cell, 200), cell));
}

TEST(Search, TheFailureIsThatOfTheScore) {
  const Cell cell{Pair::sphere, "general-deep"};
  const SearchResult found = found_by("capsule", cell, 100);
  CandidateProcess process(find_candidate("capsule"), 0);
  const auto failure = failure_of(found, process, Bar{});
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->violation.failure, outcome_name(found.score.outcome));
  EXPECT_DOUBLE_EQ(failure->violation.amount, found.score.severity);

  CandidateProcess right(find_candidate("reference"), 0);
  EXPECT_FALSE(failure_of(found_by("reference", cell, 100), right, Bar{}));
}

TEST(Search, WorksWithTheSmallestBudget) {
  std::uint64_t asked = 0;
  found_by("reference", {Pair::plane, "general-deep"}, 1, &asked);
  EXPECT_EQ(asked, 1u);
}

}  // namespace
}  // namespace touchstone
