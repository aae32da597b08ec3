#include "reports/history.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sstream>
#include <string>
#include <vector>

#include "reports/compared_reports_test.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

/// Three releases: the second broke the class touching and gained on the other, the third mended
/// it.
Report three_releases() {
  json report = report_of_rows();
  report["candidates"] = json::array();
  report["results"] = report["summary"] = json::array();
  constexpr struct {
    const char* name;
    int touching, rim_face;
  } releases[] = {{"mine@0.9", 90, 50}, {"mine@0.10", 30, 54}, {"mine@1.0", 95, 54}};
  for (const auto& [name, touching, rim_face] : releases) {
    report["candidates"].push_back({{"name", name}, {"version", "1"}, {"settings", ""}});
    report["results"].push_back(row("touching", name, touching, 1e-6, 200));
    report["results"].push_back(row("rim-face", name, rim_face, 1e-6, 200));
    report["summary"].push_back(row("everyday", name, (touching + rim_face) / 2, 1e-6, 200));
    report["summary"].push_back(report["summary"].back());
    report["summary"].back()["pair"] = "all";
  }
  Report result = report_from_text(report.dump(), "report");
  result.history = History{"mine", release_steps(result, "mine")};
  return result;
}

TEST(History, NamesTheReleaseThatBrokeAndTheOneThatMendedAClass) {
  const Report report = three_releases();
  EXPECT_THAT(releases_of(report, "mine"), ElementsAre("mine@0.9", "mine@0.10", "mine@1.0"));
  EXPECT_TRUE(releases_of(report, "min").empty());
  const std::vector<ReleaseStep>& steps = report.history->steps;
  ASSERT_EQ(steps.size(), 2u);  // four answers more in a hundred are none
  for (const ReleaseStep& step : steps) EXPECT_EQ(step.pose_class, "touching");
  EXPECT_EQ(steps[0].candidate, "mine@0.10");
  EXPECT_NEAR(steps[0].before, 0.9, 1e-12);
  EXPECT_NEAR(steps[0].after, 0.3, 1e-12);
  EXPECT_EQ(steps[1].candidate, "mine@1.0");
  const std::string text = history_text(report);
  EXPECT_THAT(text, HasSubstr("release   everyday      ns  classes\n"
                              "mine@0.9      70.0     200  -\n"
                              "mine@0.10     42.0     200  broke 1\n"
                              "mine@1.0      74.0     200  mended 1\n"));
  EXPECT_THAT(text, HasSubstr("cylinder-box\n"
                              "  mine@0.10 broke touching: 90.0% -> 30.0%\n"
                              "  mine@1.0 mended touching: 30.0% -> 95.0%\n"));
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
  EXPECT_EQ(to_json(report)["history"]["steps"][1]["after"], 0.95);
  EXPECT_THAT(history_page(report), testing::Not(HasSubstr("/* main */")));
}

TEST(History, AReleaseIsComparedUnderItsEnginesName) {
  const Report report = three_releases();
  const Comparison c = touchstone::compare(part_of(report, {{"mine@0.9", "mine"}}),
                                           part_of(report, {{"mine@0.10", "mine"}}), {});
  EXPECT_THAT(changes(c), testing::Contains("worse touching mine agreement"));
  EXPECT_TRUE(c.has_regressed());
}

}  // namespace
}  // namespace touchstone
