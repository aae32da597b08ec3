// Casts in a report: who is asked, what is counted, and what a person reads.
#include "reports/casts.hpp"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numeric>

#include <nlohmann/json.hpp>

#include "candidates/candidates.hpp"
#include "properties/casts.hpp"
#include "reports/campaign.hpp"
#include "reports/report.hpp"
#include "reports/report_json.hpp"
#include "reports/terminal.hpp"

namespace touchstone {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;

Campaign of_boxes(unsigned workers = 2) {
  return {.pairs = {Pair::box},
          .groups = {Group::everyday, Group::degenerate},
          .candidates = find_candidates({"reference", "bullet", "ode"}),
          .workers = workers};
}

/// Made once.
const Casts& casts_of_boxes() {
  static const Casts casts = measure_casts(of_boxes());
  return casts;
}

TEST(Casts, AreAskedOfThoseThatHaveThem) {
  const Casts& casts = casts_of_boxes();
  ASSERT_EQ(casts.results.size(), 4U) << "two candidates in two groups; ode has no casts";
  for (const Casts::Row& row : casts.results) {
    EXPECT_EQ(row.count, casts.count * cast_motions().size());
    std::uint64_t sum = 0;
    for (const auto& [outcome, count] : row.outcomes) sum += count;
    EXPECT_EQ(sum, row.count);
    if (row.candidate == "reference") {
      EXPECT_EQ(row.outcomes.at(CastOutcome::agree), row.count);
      EXPECT_TRUE(row.wrong_by_motion.empty());
      EXPECT_LT(*row.distance_max, 1e-9);
    }
  }
}

TEST(Casts, NameTheWorstOfBulletsByItsIdentity) {
  const auto& worst = casts_of_boxes().worst;
  const auto found = std::ranges::find(worst, "bullet", &Casts::Worst::candidate);
  ASSERT_NE(found, worst.end()) << "whose rims are rounded";
  EXPECT_TRUE(is_cast_identity(found->id)) << found->id;
  EXPECT_THAT(found->replay, HasSubstr("replay " + found->id));
  EXPECT_EQ(std::ranges::count(worst, "reference", &Casts::Worst::candidate), 0);
}

TEST(Casts, DoNotDependOnTheNumberOfWorkers) {
  Report one, two;
  one.casts = measure_casts(of_boxes(1));
  two.casts = casts_of_boxes();
  EXPECT_EQ(to_json(one)["casts"], to_json(two)["casts"]);
}

Report report_of_casts(std::vector<Casts::Row> rows, std::vector<Casts::Worst> worst = {}) {
  Report report;
  report.candidates = {{"reference", "", "", "", ""}, {"bullet", "", "", "", ""}};
  report.casts = Casts{8, std::move(rows), std::move(worst)};
  return report;
}

TEST(CastsText, SaysWhatIsRightOfTheFirstGroup) {
  using enum CastOutcome;
  const Report report = report_of_casts(
      {{"cylinder-box", "everyday", "reference", 1000, {{agree, 1000}}, {}, {}, {}},
       {"cylinder-box", "everyday", "bullet", 1000, {{agree, 599}, {late, 401}}, {}, {}, {}},
       {"cylinder-plane", "everyday", "bullet", 1000, {{agree, 1000}}, {}, {}, {}},
       {"cylinder-box", "extreme", "bullet", 7, {{made_up, 7}}, {}, {}, {}}},
      {{"cylinder-box/rim-face/1/0/near",
        "cylinder-box",
        "everyday",
        "bullet",
        late,
        -1e-3,
        {},
        "mild"},
       {"cylinder-box/rim-face/1/1/near",
        "cylinder-box",
        "everyday",
        "bullet",
        late,
        -1e-2,
        {},
        "worse"},
       {"cylinder-box/rim-face/1/2/near",
        "cylinder-box",
        "extreme",
        "bullet",
        late,
        -1,
        {},
        "elsewhere"}});
  const std::string text = casts_text(report, {});
  EXPECT_THAT(text, HasSubstr("reference 100.0 (0), bullet 79.9 (401)"));
  EXPECT_THAT(text, ContainsRegex("\n  worse\n$"));
  EXPECT_LE(std::ranges::count(text, '\n'), 5);
}

TEST(CastsText, IsEmptyWithoutCasts) {
  EXPECT_EQ(casts_text(Report(), {}), "");
  EXPECT_EQ(casts_text(report_of_casts({}), {}), "");
}

}  // namespace
}  // namespace touchstone
