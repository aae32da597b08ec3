#include "reports/campaigns/shard.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <random>

#include <nlohmann/json.hpp>

#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

ScoreTally tally_of(const std::vector<Score>& scores) {
  ScoreTally tally(Precision::binned);
  for (std::size_t i = 0; i < scores.size(); ++i) tally.add(3, i, scores[i]);
  return tally;
}

/// Every outcome, errors of any magnitude and sign, present or not.
Score some_score(std::mt19937_64& random) {
  const auto maybe = [&]() -> std::optional<double> {
    if (random() % 2 == 0) return std::nullopt;
    const double fraction = static_cast<double>(random() % 2001) / 1000 - 1;
    return std::ldexp(fraction, static_cast<int>(random() % 90) - 70);
  };
  Score s;
  s.outcome = all_outcomes[random() % all_outcomes.size()];
  for (const ScoreTally::Quantity& quantity : ScoreTally::quantities) s.*quantity.value = maybe();
  if (random() % 2 == 0) s.coverage = static_cast<double>(random() % 101) / 100;
  s.points = static_cast<int>(random() % 9);
  s.severity = static_cast<double>(random() % 4);  // many ties
  return s;
}

TEST(TallyJson, IsReadBackToTheLastBitAndAddsUp) {
  std::mt19937_64 random(1);
  std::vector<Score> scores(300);
  for (Score& s : scores) s = some_score(random);
  ScoreTally sum(Precision::binned);
  for (std::size_t first = 0; first < scores.size(); first += 100) {
    ScoreTally part(Precision::binned);
    for (std::size_t i = first; i < first + 100; ++i) part.add(3, i, scores[i]);
    sum.add(tally_from_json(json::parse(to_json(part).dump()), 3));
  }
  EXPECT_EQ(to_json(sum).dump(), to_json(tally_of(scores)).dump());
}

TEST(TallyJson, OfAFileWithoutTheDeepestPointHasTheRest) {
  Score s;
  s.depth_error = 0.25;
  json old = to_json(tally_of({s, s}));
  old.erase("deepest_error");
  const Statistics read = tally_from_json(old, 3).statistics();
  EXPECT_FALSE(read.deepest_error);
  EXPECT_EQ(read.depth_error->max, 0.25);
  old.erase("depth_error");
  EXPECT_THROW(tally_from_json(old, 3), InvalidInput);
}

TEST(TallyJson, HasTheLargestDoubleForWhatIsBeyond) {
  Score s;
  s.outcome = Outcome::overdeep;
  s.depth_error = -std::numeric_limits<double>::infinity();
  s.normal_regret = std::numeric_limits<double>::quiet_NaN();
  s.severity = std::numeric_limits<double>::infinity();
  constexpr double largest = std::numeric_limits<double>::max();
  const json written = to_json(tally_of({s}));
  EXPECT_EQ(written["depth_error"]["max"], largest);
  EXPECT_EQ(written["worst"][0]["depth_error"], -largest);
  EXPECT_EQ(written["worst"][0]["severity"], largest);
  EXPECT_EQ(tally_of({s}).statistics().normal_regret->median, largest);
}

}  // namespace
}  // namespace touchstone
