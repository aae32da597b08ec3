#include "reports/compare.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sstream>

#include <nlohmann/json.hpp>

#include "reference/invalid_input.hpp"
#include "reports/compared_reports_test.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// The small report and what became of it.
Comparison compared_with(const json& now) { return compare(report_of_rows(), now, {}); }
std::vector<std::string> changes_to(const json& now) { return changes(compared_with(now)); }

TEST(Compare, OfAReportWithItselfFindsNothing) {
  const Comparison c = compare(report_of_rows(), report_of_rows(), {});
  EXPECT_TRUE(c.changes.empty());
  EXPECT_TRUE(c.remarks.empty());
  EXPECT_FALSE(c.has_regressed());
  EXPECT_THAT(comparison_text(c), HasSubstr("No change."));
}

TEST(Compare, NamesPairClassCandidateAndFactorOfALargerError) {
  json now = report_of_rows();
  now["results"][1] = row("rim-face", "mine", 80, 3e-6, 200);
  const Comparison c = compared_with(now);
  EXPECT_THAT(changes(c), testing::UnorderedElementsAre("worse rim-face mine depth error, median",
                                                        "worse rim-face mine depth error, p99",
                                                        "worse rim-face mine depth error, max"));
  EXPECT_TRUE(c.has_regressed());
  EXPECT_THAT(comparison_text(c),
              testing::StartsWith("mine: worse on cylinder-box, 1 class, depth error, median "
                                  "1.0e-07 -> 3.0e-07\n\n"
                                  "mine, cylinder-box: worse\n"
                                  "  rim-face  depth error, median 1.0e-07 -> 3.0e-07 (x 3)\n"));
  // The other way round it is better, and within wider limits nothing to report.
  const Comparison back = compare(now, report_of_rows(), {});
  EXPECT_EQ(changes(back).front().substr(0, 6), "better");
  EXPECT_FALSE(back.has_regressed());
  CompareLimits wide;
  wide.error_factor = 3.5;
  EXPECT_FALSE(compare(report_of_rows(), now, wide).has_regressed());
  EXPECT_THAT(comparison_text(compare(report_of_rows(), now, wide)),
              HasSubstr("3 smaller changes"));
}

TEST(Compare, ADeepestPointThatLosesItsDepthIsARegressionWhereBothReportsKnowIt) {
  const auto with_deepest = [](double max) {
    json report = report_of_rows();
    report["results"][1]["deepest_error"] = {{"median", 0}, {"p99", 1e-9}, {"max", max}};
    return report;
  };
  EXPECT_THAT(changes(compare(with_deepest(1e-9), with_deepest(1e-3), {})),
              ElementsAre("worse rim-face mine deepest point's error, max"));
  EXPECT_TRUE(compare(report_of_rows(), with_deepest(1e-3), {}).changes.empty());
  EXPECT_TRUE(compare(with_deepest(1e-3), report_of_rows(), {}).changes.empty());
}

TEST(Compare, OfACandidateThatWasStoppedCountsChangesBeyondChanceAlone) {
  // Of 100, so many agree before the third time-out.
  const auto stopped = [](int agree) {
    json report = report_of_rows();
    json& row = report["results"][1];
    row["outcomes"] = {{"agree", agree}, {"timed-out", 3}, {"not-asked", 97 - agree}};
    row["depth_error"]["max"] = 1e-3;
    return report;
  };
  // 80% before; at least 70% now: within three deviations.
  const Comparison c = compare(report_of_rows(), stopped(70), {});
  EXPECT_TRUE(c.changes.empty());
  EXPECT_THAT(remarks(c), HasSubstr("mine times out so often"));
  const Comparison far = compare(report_of_rows(), stopped(33), {});
  EXPECT_THAT(changes(far), ElementsAre("worse rim-face mine agreement"));
  EXPECT_DOUBLE_EQ(far.changes[0].after, 0.33);
  EXPECT_TRUE(compare(stopped(33), stopped(33), {}).changes.empty());
}

TEST(Compare, OfAnOlderReportThatHadAskedASampleTakesItsAnswersAsTheyAre) {
  json old = report_of_rows(), now = report_of_rows();
  old["results"][1]["outcomes"] = {{"agree", 33}, {"timed-out", 7}, {"not-asked", 60}};
  old["results"][1]["represented"] = {{"agree", 50}, {"timed-out", 10}};
  now["results"][1]["outcomes"] = {{"agree", 30}, {"timed-out", 3}, {"not-asked", 67}};
  EXPECT_TRUE(compare(old, now, {}).changes.empty());
}

TEST(Compare, RoundingIsNoChange) {
  json old = report_of_rows(), now = report_of_rows();
  old["results"][1] = row("rim-face", "mine", 80, 0, 200);
  now["results"][1] = row("rim-face", "mine", 80, 4e-15, 200);
  EXPECT_TRUE(compare(old, now, {}).changes.empty());
  now["results"][1] = row("rim-face", "mine", 80, 4e-13, 200);
  EXPECT_TRUE(compare(old, now, {}).has_regressed());
}

TEST(Compare, AnErrorBeyondAllOthersHasAFactor) {
  json now = report_of_rows();
  now["results"][1]["depth_error"]["max"] = 1e308;
  const Comparison c = compared_with(now);
  ASSERT_EQ(c.changes.size(), 1u);
  EXPECT_TRUE(c.changes[0].factor && std::isfinite(*c.changes[0].factor));
}

TEST(Compare, LostAgreementIsARegressionUnlessAllowed) {
  json now = report_of_rows();
  now["results"][1] = row("rim-face", "mine", 79, 1e-6, 200);
  const Comparison c = compared_with(now);
  EXPECT_THAT(changes(c), ElementsAre("worse rim-face mine agreement"));
  CompareLimits limits;
  limits.agreement = 0.98;
  EXPECT_FALSE(compare(report_of_rows(), now, limits).has_regressed());
  // None before, some now.
  json none = report_of_rows();
  none["results"][1] = row("rim-face", "mine", 0, 1e-6, 200);
  EXPECT_THAT(changes(compare(none, now, {})), ElementsAre("better rim-face mine agreement"));
  EXPECT_TRUE(compare(now, none, {}).has_regressed());
}

TEST(Compare, TheVerdictIsOfAllClassesThatAreWorse) {
  json now = report_of_rows();
  now["results"][1] = row("rim-face", "mine", 60, 1e-3, 200);
  now["results"][3] = row("touching", "mine", 70, 1e-6, 200);
  EXPECT_THAT(
      comparison_text(compared_with(now)),
      testing::AllOf(testing::StartsWith(
                         "mine: worse on cylinder-box, 2 classes, agreement 80.0% -> 65.0%\n\n"),
                     HasSubstr("  rim-face  agreement 80.0% -> 60.0% (x 0.75)\n"),
                     HasSubstr("  touching  agreement 80.0% -> 70.0% (x 0.875)\n")));
}

TEST(Compare, TheTextSaysOfMoreThanTwentyClassesHowManyThereAre) {
  json old = report_of_rows(), now = report_of_rows();
  for (int i = 0; i < 30; ++i) {
    const std::string name = "z" + std::to_string(i);
    old["results"].push_back(row(name.c_str(), "mine", 90, 1e-6, 200));
    now["results"].push_back(row(name.c_str(), "mine", 80, 1e-6, 200));
  }
  const std::string text = comparison_text(compare(old, now, {}));
  EXPECT_THAT(text, testing::StartsWith("mine: worse on cylinder-box, 30 classes, "));
  EXPECT_THAT(text, HasSubstr("\nand 10 more, which --json lists\n"));
}

TEST(Compare, ALostRoutineIsARegression) {
  json now = report_of_rows();
  now["results"][1]["outcomes"] = {{"unsupported", 100}};
  const Comparison c = compared_with(now);
  EXPECT_THAT(changes(c), ElementsAre("worse rim-face mine has a routine"));
  EXPECT_TRUE(c.has_regressed());
  EXPECT_THAT(comparison_text(c), testing::StartsWith("mine: worse on cylinder-box, 1 class, has "
                                                      "a routine yes -> no\n"));
  EXPECT_FALSE(compare(now, report_of_rows(), {}).has_regressed());
}

TEST(Compare, TimesCountAsMultiplesOfTheBaseline) {
  json now = report_of_rows();
  // A machine at half the speed: all times double, no ratio changes.
  for (const char* list : {"results", "summary"}) {
    for (json& r : now[list]) {
      for (const char* name : {"median", "low", "high"}) {
        r["nanoseconds"][name] = 2 * r["nanoseconds"][name].get<double>();
      }
    }
  }
  EXPECT_TRUE(compared_with(now).changes.empty());
  CompareLimits other;
  other.baseline = "mine";
  EXPECT_TRUE(compare(report_of_rows(), now, other).changes.empty());
  now["results"][1] = row("rim-face", "mine", 80, 1e-6, 400);
  EXPECT_THAT(changes_to(now), ElementsAre("slower rim-face mine time"));
  EXPECT_FALSE(compared_with(now).has_regressed());
  CompareLimits strict;
  strict.time_counts = true;
  EXPECT_TRUE(compare(report_of_rows(), now, strict).has_regressed());
  EXPECT_FALSE(compare(now, report_of_rows(), strict).has_regressed());
}

TEST(Compare, TimesWhoseSpreadsReachWithinTheFactorAreNoChange) {
  json now = report_of_rows();
  now["results"][1] = row("rim-face", "mine", 80, 1e-6, 400);
  now["results"][1]["nanoseconds"]["ratio_low"] = 3;  // before: 1.98 to 2.02
  EXPECT_TRUE(compared_with(now).changes.empty());
}

TEST(Compare, WithoutTheBaselineTimesAreNotCompared) {
  CompareLimits limits;
  limits.baseline = "havok";
  const Comparison c = compare(report_of_rows(), report_of_rows(), limits);
  EXPECT_THAT(remarks(c), HasSubstr("havok is not in both"));
}

TEST(Compare, CountsInstructionsWhereBothHaveThem) {
  json old = report_of_rows(), now = report_of_rows();
  old["results"][1]["nanoseconds"]["instructions"] = 1000;
  now["results"][1]["nanoseconds"]["instructions"] = 1600;
  EXPECT_THAT(changes(compare(old, now, {})), ElementsAre("slower rim-face mine instructions"));
  EXPECT_TRUE(compared_with(now).changes.empty());
}

TEST(Compare, SaysWhatIsOnlyInOne) {
  json now = report_of_rows();
  now["candidates"][1]["name"] = "yours";
  now["results"] = {row("rim-face", "bullet", 90, 1e-3, 100), row("lying", "yours", 1, 1, 1)};
  now["summary"][1]["candidate"] = "yours";
  const std::string said = remarks(compared_with(now));
  for (const char* expected :
       {"old report, not compared: candidates mine.", "new report, not compared: candidates yours.",
        "old report, not compared: classes cylinder-box/touching.",
        "new report, not compared: classes cylinder-box/lying."}) {
    EXPECT_THAT(said, HasSubstr(expected));
  }
}

TEST(Compare, NamesTheRowsThatOneOfThemLacks) {
  json now = report_of_rows();
  now["results"].erase(3);
  const std::string rows = " report, not compared: rows cylinder-box/touching of mine.";
  EXPECT_THAT(remarks(compared_with(now)), HasSubstr("Only in the old" + rows));
  EXPECT_THAT(remarks(compare(now, report_of_rows(), {})), HasSubstr("Only in the new" + rows));
}

TEST(Compare, SaysThatItTakesYourOwnConfigurationsForTheSame) {
  json report = report_of_rows();
  for (const int i : {2, 3}) report["results"][i]["class"] = "given";
  EXPECT_THAT(remarks(compare(report, report, {})),
              HasSubstr("as if both reports had the same file"));
}

TEST(Compare, SaysWhatElseDiffers) {
  json now = report_of_rows();
  now["seed"] = 2;
  now["tolerance"] = 1e-3;
  now["partial"] = true;
  now["machine"]["cpu"] = "two";
  now["candidates"][1]["version"] = "2";
  const std::string said = remarks(compared_with(now));
  for (const char* expected :
       {"seed 1 and 2", "tolerance 0.0001 and 0.001", "new report is partial",
        "Another cpu: one before, two now.", "mine: version 1 before, 2 now."}) {
    EXPECT_THAT(said, HasSubstr(expected));
  }
}

TEST(Compare, OfOtherConfigurationsTakesPairsAsAWholeBeyondChance) {
  json now = report_of_rows();
  now["seed"] = 2;
  now["results"][1] = row("rim-face", "mine", 10, 1, 200);     // no matter
  now["summary"][1] = row("everyday", "mine", 70, 1e-6, 200);  // 80 of 100 or 70: chance
  EXPECT_TRUE(compared_with(now).changes.empty());
  now["summary"][1] = row("everyday", "mine", 50, 1e-6, 200);
  EXPECT_THAT(changes_to(now), ElementsAre("worse everyday mine agreement"));
}

/// The small report with another seed, in which so many contacts of a candidate have an error of
/// about 1e-7, and so many of 1e-3.
json report_of_errors(int seed, int small, int large) {
  const auto at_rank = [&](int rank) { return rank <= small ? 1e-7 : 1e-3; };
  const int n = small + large;
  json report = report_of_rows();
  report["seed"] = seed;
  for (json& each : report["summary"]) {
    each["count"] = n;
    each["outcomes"] = {{"agree", n}};
  }
  json& row = report["summary"][1];
  json counts = {small, 0, 0, 0, 0, 0, 0, 0, large};
  if (large == 0) counts = {small};
  row["depth_error"] = {{"median", at_rank((n + 1) / 2)},
                        {"p99", at_rank((99 * n + 99) / 100)},
                        {"max", at_rank(n)},
                        {"histogram", {{"zero", 0}, {"first", -14}, {"counts", counts}}}};
  return report;
}

TEST(Compare, APercentileOfOtherConfigurationsHasChangedWhereMoreErrorsAreLarge) {
  const auto changed = [](const json& before, const json& after) {
    return changes(compare(before, after, {}));
  };
  // Of three configurations it is the largest error; of 500 it is of the one kind or the other.
  EXPECT_THAT(changed(report_of_errors(1, 3, 0), report_of_errors(2, 2, 1)), testing::IsEmpty());
  EXPECT_THAT(changed(report_of_errors(1, 496, 4), report_of_errors(2, 492, 8)),
              testing::IsEmpty());
  EXPECT_THAT(changed(report_of_errors(1, 251, 249), report_of_errors(2, 249, 251)),
              testing::IsEmpty());
  EXPECT_THAT(changed(report_of_errors(1, 496, 4), report_of_errors(2, 460, 40)),
              ElementsAre("worse everyday mine depth error, p99"));
  EXPECT_THAT(changed(report_of_errors(1, 460, 40), report_of_errors(2, 496, 4)),
              ElementsAre("better everyday mine depth error, p99"));
}

TEST(Compare, OfOtherConfigurationsTakesEveryGroupOfWhichBothReportsHaveAllClasses) {
  json now = report_of_rows();
  now["seed"] = 2;
  now["summary"][1] = row("everyday", "mine", 50, 1e-6, 200);
  for (const char* list : {"results", "summary"}) {  // another pair, and with it all pairs
    now[list].push_back(
        row(list == std::string("results") ? "cap" : "everyday", "mine", 1, 1, 200));
    now[list].back()["pair"] = "cylinder-sphere";
  }
  json old = report_of_rows();
  for (json* report : {&old, &now}) {
    (*report)["summary"].push_back(row("everyday", "mine", report == &old ? 80 : 10, 1, 200));
    (*report)["summary"].back()["pair"] = "all";
  }
  EXPECT_THAT(changes(compare(old, now, {})), ElementsAre("worse everyday mine agreement"));

  // A class of another group, and one that this version does not know.
  now["results"].push_back(row("general+far", "mine", 1, 1, 200));
  EXPECT_THAT(changes(compare(old, now, {})), ElementsAre("worse everyday mine agreement"));
  now["results"].back()["class"] = "of-tomorrow";
  EXPECT_THAT([&] { compare(old, now, {}); },
              ThrowsMessage<InvalidInput>(HasSubstr("all classes of a group")));
}

TEST(Compare, AReportOfTheOldSchemaIsComparedByClassesUnderTheirNamesOfToday) {
  json old = report_of_rows(), now = report_of_rows();
  old["schema"] = 1;
  old["results"][0]["class"] = old["results"][1]["class"] = "near-parallel-1e-6";
  now["results"][0]["class"] = now["results"][1]["class"] = "parallel+tilted-1e-6";
  old["summary"][0]["class"] = old["summary"][1]["class"] = "all";
  EXPECT_TRUE(compare(old, now, {}).changes.empty());
  now["results"][1]["depth_error"]["p99"] = 2e-6;
  old["results"][1]["depth_error"]["p99"] = 2e-7;
  const Comparison c = compare(old, now, {});
  EXPECT_THAT(changes(c), ElementsAre("worse parallel+tilted-1e-6 mine depth error, p99"));
  EXPECT_THAT(remarks(c), HasSubstr("old report is of schema 1, which knows no groups"));
  now["seed"] = 2;
  EXPECT_THAT([&] { compare(old, now, {}); },
              ThrowsMessage<InvalidInput>(HasSubstr("OLD is of schema 1")));
}

TEST(Compare, AReportOfTheOldJudgeIsComparedByWhatMeansTheSame) {
  json old = report_of_rows(), now = report_of_rows();
  for (json* report : {&old, &now}) {
    (*report)["results"][1]["normal_regret"] = {{"median", 0}, {"p99", 1e-3}, {"max", 1e-3}};
  }
  now["results"][1]["outcomes"] = {{"agree", 70}, {"shallow", 20}, {"wrong-normal", 10}};
  now["results"][1]["normal_regret"]["p99"] = 1e-6;
  now["results"][1]["coverage"]["mean"] = 0.9;
  EXPECT_EQ(changes(compare(old, now, {})).size(), 3u);
  old["schema"] = 2;
  const Comparison c = compare(old, now, {});
  EXPECT_TRUE(c.changes.empty());
  EXPECT_THAT(remarks(c), HasSubstr("old report is of a schema before 3"));
  old["results"][1]["depth_error"]["p99"] = 2e-7;
  now["results"][1]["depth_error"]["p99"] = 2e-6;
  EXPECT_THAT(changes(compare(old, now, {})), ElementsAre("worse rim-face mine depth error, p99"));
  now["schema"] = 2;
  EXPECT_EQ(changes(compare(old, now, {})).size(), 4u);
  // What no longer finds the contacts has no errors of depth.
  now["schema"] = 3;
  now["results"][1]["outcomes"] = {{"missed", 100}};
  for (const char* errors : {"depth_error", "normal_regret", "coverage"}) {
    now["results"][1][errors] = nullptr;
  }
  EXPECT_THAT(changes(compare(old, now, {})),
              ElementsAre("worse rim-face mine agreement in depth"));
}

TEST(Compare, AClassOfAnotherCountIsOfOtherConfigurations) {
  json now = report_of_rows();
  for (const int i : {0, 1}) {
    now["results"][i]["count"] = 50;
    now["results"][i]["outcomes"] = {{"agree", 50}};
  }
  const Comparison c = compared_with(now);
  EXPECT_TRUE(c.changes.empty());
  EXPECT_THAT(remarks(c), HasSubstr("100 and 50 of a class"));
}

/// A report of answers that came in a file, to configurations with this digest.
json report_of_given(const char* pose_class, const json& digest, int agree) {
  json report = report_of_rows();
  const char* const group = pose_class == std::string("given") ? "given" : "everyday";
  report["results"] = json::array({row(pose_class, "mine", agree, 1e-6, 200)});
  report["summary"] = json::array({row(group, "mine", agree, 1e-6, 200)});
  report["classes"] =
      json::array({{{"pair", "cylinder-box"}, {"class", pose_class}, {"group", group}}});
  if (!digest.is_null()) report["classes"][0]["digest"] = digest;
  return report;
}

TEST(Compare, AnswersToOtherConfigurationsAreNotCompared) {
  for (const char* const pose_class : {"given", "rim-face"}) {
    const json before = report_of_given(pose_class, "00000000000000a1", 80);
    const Comparison same =
        compare(before, report_of_given(pose_class, "00000000000000a1", 70), {});
    EXPECT_THAT(changes(same), ElementsAre(std::string("worse ") + pose_class + " mine agreement"));
    EXPECT_TRUE(same.remarks.empty()) << remarks(same);
    const json other = report_of_given(pose_class, "00000000000000b2", 70);
    EXPECT_THAT([&] { compare(before, other, {}); },
                ThrowsMessage<InvalidInput>(HasSubstr("with the same configurations")));
    // Beside them another class has another count, and nothing of it is left to chance.
    json both = before, both_other = other;
    for (json* const report : {&both, &both_other}) {
      (*report)["results"].push_back(row("touching", "mine", 60, 1e-6, 200));
      (*report)["classes"].push_back(
          {{"pair", "cylinder-box"}, {"class", "touching"}, {"group", "degenerate"}});
    }
    both_other["results"][0]["count"] = 50;
    both_other["results"][0]["outcomes"] = {{"agree", 50}};
    both_other["summary"] = json::array();
    both_other["results"][1]["outcomes"] = {{"agree", 59}, {"shallow", 41}};
    const Comparison c = compare(both, both_other, {});
    EXPECT_THAT(changes(c), ElementsAre("worse touching mine agreement"));
    EXPECT_THAT(remarks(c), HasSubstr(std::string("Answers to other configurations, not compared: "
                                                  "cylinder-box/") +
                                      pose_class + ".\n"));
  }
  // A report from before there were digests.
  const Comparison old =
      compare(report_of_given("given", nullptr, 80), report_of_given("given", "a1", 80), {});
  EXPECT_TRUE(old.changes.empty());
  EXPECT_THAT(remarks(old), HasSubstr("as if both reports had the same file"));
}

TEST(Compare, NamesTheFirstOfManyClasses) {
  json now = report_of_rows();
  for (int i = 0; i < 30; ++i) {
    now["results"].push_back(row(("z" + std::to_string(i)).c_str(), "mine", 1, 1, 1));
  }
  EXPECT_THAT(remarks(compared_with(now)), HasSubstr(" and 10 more."));
}

TEST(Compare, RefusesReportsWithNothingInCommon) {
  json now = report_of_rows();
  now["results"] = now["summary"] = json::array();
  EXPECT_THROW(compared_with(now), InvalidInput);
}

TEST(Compare, SaysThatNeitherReportHasAnAnswer) {
  json report = report_of_rows();
  for (const char* list : {"results", "summary"}) {
    for (json& r : report[list]) r["outcomes"] = {{"unsupported", 100}};
  }
  EXPECT_THAT([&] { compare(report, report, {}); },
              ThrowsMessage<InvalidInput>(HasSubstr("without a scored answer, as OLD is")));
  EXPECT_TRUE(compare(report_of_rows(), report, {}).has_regressed());
}

TEST(Compare, TextFitsIntoEightyColumns) {
  json now = report_of_rows();
  now["seed"] = 2;
  now["machine"]["compiler"] = std::string(30, 'x') + ' ' + std::string(40, 'y');
  now["summary"][1] = row("perpendicular+tilted-1e-15", "capsule-circumscribed", 10, 1, 500);
  now["summary"][1]["pair"] = "cylinder-cylinder";
  json old = report_of_rows();
  for (json* report : {&now, &old}) {
    (*report)["candidates"][1]["name"] = "capsule-circumscribed";
    for (const int i : {1, 3}) (*report)["results"][i]["candidate"] = "capsule-circumscribed";
  }
  old["summary"][1] = row("perpendicular+tilted-1e-15", "capsule-circumscribed", 80, 1e-9, 200);
  old["summary"][1]["pair"] = "cylinder-cylinder";
  std::istringstream text(comparison_text(compare(old, now, {})));
  for (std::string line; std::getline(text, line);) EXPECT_LE(line.size(), 80u) << line;
}

TEST(Compare, WritesEveryChangeAsJson) {
  json now = report_of_rows();
  now["results"][1]["outcomes"] = {{"unsupported", 100}};
  now["summary"][1] = row("everyday", "mine", 80, 1e-6, 400);
  const json written = json::parse(comparison_json(compared_with(now)));
  EXPECT_EQ(written["schema"], "touchstone-comparison-1");
  EXPECT_EQ(written["before"]["seed"], 1);
  EXPECT_EQ(written["after"]["machine"]["cpu"], "one");
  EXPECT_EQ(written["limits"]["baseline"], "bullet");
  EXPECT_EQ(written["compared"], 6);
  ASSERT_EQ(written["changes"].size(), 2u);
  const json& lost = written["changes"][0];  // without a factor first
  EXPECT_EQ(lost["measure"], "has a routine");
  EXPECT_EQ(lost["factor"], nullptr);
  EXPECT_EQ(lost["before"], 1.0);
  EXPECT_EQ(lost["verdict"], "worse");
  EXPECT_EQ(lost["beyond_limits"], true);
  EXPECT_EQ(written["changes"][1]["verdict"], "slower");
  EXPECT_EQ(written["changes"][1]["class"], "everyday");
}

}  // namespace
}  // namespace touchstone
