// The table of candidates by pairs for a page of somebody's own.
#include "reports/engine_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

Statistics right_but(std::uint64_t missed, std::map<int, std::uint64_t> points = {}) {
  Statistics s;
  s.count = 10;
  s.outcomes[static_cast<std::size_t>(Outcome::agree)] = 10 - missed;
  s.outcomes[static_cast<std::size_t>(Outcome::missed)] = missed;
  s.points = std::move(points);
  s.depth_error = Quantiles{1e-9, 1e-6, 2e-3};
  return s;
}

/// Of two candidates: one that knows boxes alone, and one that is always right there.
Report two_on_boxes() {
  Report r;
  r.version = "1";
  r.command = "touchstone report --name a<b";
  for (const char* name : {"one", "two"}) {
    CandidateDescription& c = r.candidates.emplace_back();
    c.name = name;
    c.version = "2.0";
  }
  const auto row = [](const char* pair, const char* of, const char* candidate, Statistics s) {
    return ResultRow{pair, of, candidate, std::move(s), {}, {}, {}, {}};
  };
  r.summary.push_back(row("cylinder-box", "everyday", "one", right_but(3)));
  r.summary.push_back(row("cylinder-box", "everyday", "two", right_but(0)));
  r.summary.push_back(row("cylinder-plane", "everyday", "two", right_but(0)));
  r.results.push_back(row("cylinder-box", "rim-face", "one", right_but(1)));
  r.results.push_back(row("cylinder-box", "vertex-cap", "one", right_but(3)));
  r.results.push_back(
      row("cylinder-box", "cap-on-face-centred+turned", "one", right_but(0, {{1, 2}, {4, 7}})));
  // The everyday poses are those that count, though more fail here.
  r.results.push_back(row("cylinder-box", "general-deep", "one", right_but(9)));
  r.results.push_back(row("cylinder-box", "general-deep", "two", right_but(9)));
  return r;
}

TEST(EngineTable, HasTheShareOfRightAnswersPointsAtRestAndTheLargestErrorOfEachPair) {
  EXPECT_EQ(engine_table(two_on_boxes(), false),
            "Of everyday poses: % answered right, points of a contact at rest, largest depth error "
            "in the smaller size, median ns. By Touchstone 1: `touchstone report --name a<b`\n\n"
            "|engine|cylinder-plane|cylinder-box|fails first|\n"
            "|---|---|---|---|\n"
            "|one<br>2.0|-|70.0<br>4<br>2e-03<br>-|cylinder-box/vertex-cap:<br>missed|\n"
            "|two<br>2.0|100.0<br>-<br>2e-03<br>-|100.0<br>-<br>2e-03<br>-|"
            "cylinder-box/general-deep:<br>missed|\n");
}

TEST(EngineTable, IsAPageWhereItsFilesNameSaysSo) {
  const std::string page = engine_table(two_on_boxes(), true);
  EXPECT_THAT(page, testing::StartsWith("<!doctype html>"));
  EXPECT_THAT(page, testing::HasSubstr("<code>touchstone report --name a&lt;b</code>"));
  EXPECT_THAT(page, testing::HasSubstr("<tr><td>one<br>2.0</td><td>-</td><td>70.0<br>4<br>"));
  EXPECT_TRUE(is_html_table("a/b.html"));
  EXPECT_FALSE(is_html_table("a/b.md"));
  EXPECT_THROW(is_html_table("a/b"), InvalidInput);
}

}  // namespace
}  // namespace touchstone
