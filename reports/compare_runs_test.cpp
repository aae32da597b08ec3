// Reports of runs compared: of the same code, and of a plug-in that has become worse.
#include <cstdlib>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

#include "reports/compared_reports_test.hpp"
#include "reports/small_report_test.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// The plug-in of testing/sabotage.cpp, worse than it is by this number.
json report_of_declining(const char* by, std::uint64_t seed = 1) {
  add_test_plugin("touchstone-sabotage.so");
  setenv("TOUCHSTONE_DECLINE", by, 1);
  Campaign c{.pairs = {Pair::plane},
             .classes = {"lying", "standing", "general-shallow"},
             .candidates = find_candidates({"bullet", "declining"}),
             .count = 20,
             .seed = seed};
  json report = to_json(make_report(c, "x"));
  unsetenv("TOUCHSTONE_DECLINE");
  return report;
}

TEST(Compare, TwoRunsOfTheSameCodeShowNoChange) {
  const Comparison c = compare(report_of_declining("1"), report_of_declining("1"), {});
  EXPECT_TRUE(c.changes.empty()) << comparison_text(c);
  EXPECT_TRUE(c.remarks.empty()) << remarks(c);
}

/// Of engines whose errors are of all sizes, a report of few configurations.
json report_of_seed(std::uint64_t seed) {
  Campaign c{.pairs = {Pair::plane, Pair::box},
             .classes = {"lying", "general-shallow", "touching", "rim-face"},
             .candidates = find_candidates({"reference", "bullet", "ode"}),
             .count = 3,
             .is_timed = false,
             .seed = seed};
  return to_json(make_report(c, "x"));
}

TEST(Compare, TenPairsOfSeedsOfTheSameCodeShowNoChange) {
  json before = report_of_seed(1);
  for (std::uint64_t seed = 2; seed <= 11; ++seed) {
    json after = report_of_seed(seed);
    const Comparison c = compare(before, after, {});
    EXPECT_TRUE(c.changes.empty()) << comparison_text(c);
    before = std::move(after);
  }
}

TEST(Compare, OfOtherConfigurationsFindsADegradedPluginByItsGroup) {
  EXPECT_THAT(changes(compare(report_of_declining("1"), report_of_declining("10000", 2), {})),
              testing::Contains("worse degenerate declining depth error, p99"));
}

TEST(Compare, FindsADegradedPluginByPairClassAndFactor) {
  const json before = report_of_declining("1");
  const Comparison c = compare(before, report_of_declining("8"), {});
  const auto worse = changes(c);
  EXPECT_THAT(worse, testing::Contains("worse lying declining depth error, p99"));
  for (const std::string& change : worse) EXPECT_THAT(change, HasSubstr(" lying declining "));
  for (const Change& change : c.changes) {
    EXPECT_EQ(change.pair, "cylinder-plane");
    EXPECT_NEAR(change.factor.value(), 8, 0.01);
  }
  const Comparison slow = compare(before, report_of_declining("-1"), {});
  EXPECT_THAT(changes(slow), testing::Contains("slower everyday declining time"));
  for (const std::string& change : changes(slow)) {
    EXPECT_THAT(change, testing::AllOf(testing::StartsWith("slower "), HasSubstr(" declining ")));
  }
}

}  // namespace
}  // namespace touchstone
