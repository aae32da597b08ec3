#include "reports/compare.hpp"

#include <cmath>
#include <cstdlib>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <sstream>

#include <nlohmann/json.hpp>

#include "reference/invalid_input.hpp"
#include "reports/history.hpp"
#include "reports/report_json.hpp"
#include "reports/small_report_test.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// A row with an agreement of `agree` in 100, a 99th percentile of `error`, a time of `time` ns
/// give or take 1% and Bullet at 100 ns.
json row(const char* pose_class, const char* candidate, int agree, double error, double time) {
  const json errors = {{"median", error / 10}, {"p99", error}, {"max", 2 * error}};
  return {{"pair", "cylinder-box"},
          {"class", pose_class},
          {"candidate", candidate},
          {"count", 100},
          {"outcomes", {{"agree", agree}, {"shallow", 100 - agree}}},
          {"depth_error", errors},
          {"normal_regret", nullptr},
          {"point_error", nullptr},
          {"coverage", {{"mean", 0.5}}},
          {"pareto", true},
          {"nanoseconds",
           {{"median", time},
            {"low", 0.99 * time},
            {"high", 1.01 * time},
            {"instructions", nullptr},
            {"ratio_to_bullet", time / 100},
            {"ratio_low", 0.99 * time / 100},
            {"ratio_high", 1.01 * time / 100}}}};
}

json small_report() {
  return {{"schema", report_schema},
          {"version", "0.1.0"},
          {"seed", 1},
          {"tolerance", 1e-4},
          {"threshold", 0.0},
          {"configurations", 200},
          {"partial", false},
          {"machine", {{"cpu", "one"}, {"compiler", "g++"}}},
          {"candidates",
           {{{"name", "bullet"}, {"version", "3.24"}, {"settings", "as it is"}},
            {{"name", "mine"}, {"version", "1"}, {"settings", "as it is"}}}},
          {"results",
           {row("rim-face", "bullet", 90, 1e-3, 100), row("rim-face", "mine", 80, 1e-6, 200),
            row("touching", "bullet", 90, 1e-3, 100), row("touching", "mine", 80, 1e-6, 200)}},
          {"summary",
           {row("everyday", "bullet", 90, 1e-3, 100), row("everyday", "mine", 80, 1e-6, 200)}}};
}

/// As they are, but for the sum of all classes.
Comparison compare(const json& before, const json& after, const CompareLimits& limits) {
  const auto read = [](json report) {
    std::map<std::string, std::uint64_t> counts;
    for (const json& row : report["results"]) {
      counts[row["pair"].get<std::string>() + '/' + row["class"].get<std::string>()] = row["count"];
    }
    report["configurations"] = 0;
    for (const auto& [name, count] : counts) {
      report["configurations"] = report["configurations"].get<std::uint64_t>() + count;
    }
    return report_from_text(report.dump(), "report");
  };
  return touchstone::compare(read(before), read(after), limits);
}

/// Lists the changes beyond the limits.
std::vector<std::string> changes(const Comparison& comparison) {
  std::vector<std::string> result;
  for (const Change& c : comparison.changes) {
    if (!c.beyond_limits) continue;
    std::ostringstream text;
    text << verdict_name(c.verdict) << ' ' << c.pose_class << ' ' << c.candidate << ' '
         << c.measure;
    result.push_back(text.str());
  }
  return result;
}

/// The small report and what became of it.
Comparison compared_with(const json& now) { return compare(small_report(), now, {}); }
std::vector<std::string> changes_to(const json& now) { return changes(compared_with(now)); }

std::string remarks(const Comparison& comparison) {
  std::string text;
  for (const std::string& remark : comparison.remarks) text += remark + '\n';
  return text;
}

TEST(Compare, OfAReportWithItselfFindsNothing) {
  const Comparison c = compare(small_report(), small_report(), {});
  EXPECT_TRUE(c.changes.empty());
  EXPECT_TRUE(c.remarks.empty());
  EXPECT_FALSE(c.has_regressed());
  EXPECT_THAT(comparison_text(c), HasSubstr("No change."));
}

TEST(Compare, NamesPairClassCandidateAndFactorOfALargerError) {
  json now = small_report();
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
  const Comparison back = compare(now, small_report(), {});
  EXPECT_EQ(changes(back).front().substr(0, 6), "better");
  EXPECT_FALSE(back.has_regressed());
  CompareLimits wide;
  wide.error_factor = 3.5;
  EXPECT_FALSE(compare(small_report(), now, wide).has_regressed());
  EXPECT_THAT(comparison_text(compare(small_report(), now, wide)), HasSubstr("3 smaller changes"));
}

TEST(Compare, ADeepestPointThatLosesItsDepthIsARegressionWhereBothReportsKnowIt) {
  const auto with_deepest = [](double max) {
    json report = small_report();
    report["results"][1]["deepest_error"] = {{"median", 0}, {"p99", 1e-9}, {"max", max}};
    return report;
  };
  EXPECT_THAT(changes(compare(with_deepest(1e-9), with_deepest(1e-3), {})),
              ElementsAre("worse rim-face mine deepest point's error, max"));
  EXPECT_TRUE(compare(small_report(), with_deepest(1e-3), {}).changes.empty());
  EXPECT_TRUE(compare(with_deepest(1e-3), small_report(), {}).changes.empty());
}

TEST(Compare, OfACandidateThatWasStoppedCountsChangesBeyondChanceAlone) {
  // Of 100, so many agree before the third time-out.
  const auto stopped = [](int agree) {
    json report = small_report();
    json& row = report["results"][1];
    row["outcomes"] = {{"agree", agree}, {"timed-out", 3}, {"not-asked", 97 - agree}};
    row["depth_error"]["max"] = 1e-3;
    return report;
  };
  // 80% before; at least 70% now: within three deviations.
  const Comparison c = compare(small_report(), stopped(70), {});
  EXPECT_TRUE(c.changes.empty());
  EXPECT_THAT(remarks(c), HasSubstr("mine times out so often"));
  const Comparison far = compare(small_report(), stopped(33), {});
  EXPECT_THAT(changes(far), ElementsAre("worse rim-face mine agreement"));
  EXPECT_DOUBLE_EQ(far.changes[0].after, 0.33);
  EXPECT_TRUE(compare(stopped(33), stopped(33), {}).changes.empty());
}

TEST(Compare, OfAnOlderReportThatHadAskedASampleTakesItsAnswersAsTheyAre) {
  json old = small_report(), now = small_report();
  old["results"][1]["outcomes"] = {{"agree", 33}, {"timed-out", 7}, {"not-asked", 60}};
  old["results"][1]["represented"] = {{"agree", 50}, {"timed-out", 10}};
  now["results"][1]["outcomes"] = {{"agree", 30}, {"timed-out", 3}, {"not-asked", 67}};
  EXPECT_TRUE(compare(old, now, {}).changes.empty());
}

TEST(Compare, RoundingIsNoChange) {
  json old = small_report(), now = small_report();
  old["results"][1] = row("rim-face", "mine", 80, 0, 200);
  now["results"][1] = row("rim-face", "mine", 80, 4e-15, 200);
  EXPECT_TRUE(compare(old, now, {}).changes.empty());
  now["results"][1] = row("rim-face", "mine", 80, 4e-13, 200);
  EXPECT_TRUE(compare(old, now, {}).has_regressed());
}

TEST(Compare, AnErrorBeyondAllOthersHasAFactor) {
  json now = small_report();
  now["results"][1]["depth_error"]["max"] = 1e308;
  const Comparison c = compared_with(now);
  ASSERT_EQ(c.changes.size(), 1u);
  EXPECT_TRUE(c.changes[0].factor && std::isfinite(*c.changes[0].factor));
}

TEST(Compare, LostAgreementIsARegressionUnlessAllowed) {
  json now = small_report();
  now["results"][1] = row("rim-face", "mine", 79, 1e-6, 200);
  const Comparison c = compared_with(now);
  EXPECT_THAT(changes(c), ElementsAre("worse rim-face mine agreement"));
  CompareLimits limits;
  limits.agreement = 0.98;
  EXPECT_FALSE(compare(small_report(), now, limits).has_regressed());
  // None before, some now.
  json none = small_report();
  none["results"][1] = row("rim-face", "mine", 0, 1e-6, 200);
  EXPECT_THAT(changes(compare(none, now, {})), ElementsAre("better rim-face mine agreement"));
  EXPECT_TRUE(compare(now, none, {}).has_regressed());
}

TEST(Compare, TheVerdictIsOfAllClassesThatAreWorse) {
  json now = small_report();
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
  json old = small_report(), now = small_report();
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
  json now = small_report();
  now["results"][1]["outcomes"] = {{"unsupported", 100}};
  const Comparison c = compared_with(now);
  EXPECT_THAT(changes(c), ElementsAre("worse rim-face mine has a routine"));
  EXPECT_TRUE(c.has_regressed());
  EXPECT_THAT(comparison_text(c), testing::StartsWith("mine: worse on cylinder-box, 1 class, has "
                                                      "a routine yes -> no\n"));
  EXPECT_FALSE(compare(now, small_report(), {}).has_regressed());
}

TEST(Compare, TimesCountAsMultiplesOfTheBaseline) {
  json now = small_report();
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
  EXPECT_TRUE(compare(small_report(), now, other).changes.empty());
  now["results"][1] = row("rim-face", "mine", 80, 1e-6, 400);
  EXPECT_THAT(changes_to(now), ElementsAre("slower rim-face mine time"));
  EXPECT_FALSE(compared_with(now).has_regressed());
  CompareLimits strict;
  strict.time_counts = true;
  EXPECT_TRUE(compare(small_report(), now, strict).has_regressed());
  EXPECT_FALSE(compare(now, small_report(), strict).has_regressed());
}

TEST(Compare, TimesWhoseSpreadsReachWithinTheFactorAreNoChange) {
  json now = small_report();
  now["results"][1] = row("rim-face", "mine", 80, 1e-6, 400);
  now["results"][1]["nanoseconds"]["ratio_low"] = 3;  // before: 1.98 to 2.02
  EXPECT_TRUE(compared_with(now).changes.empty());
}

TEST(Compare, WithoutTheBaselineTimesAreNotCompared) {
  CompareLimits limits;
  limits.baseline = "havok";
  const Comparison c = compare(small_report(), small_report(), limits);
  EXPECT_THAT(remarks(c), HasSubstr("havok is not in both"));
}

TEST(Compare, CountsInstructionsWhereBothHaveThem) {
  json old = small_report(), now = small_report();
  old["results"][1]["nanoseconds"]["instructions"] = 1000;
  now["results"][1]["nanoseconds"]["instructions"] = 1600;
  EXPECT_THAT(changes(compare(old, now, {})), ElementsAre("slower rim-face mine instructions"));
  EXPECT_TRUE(compared_with(now).changes.empty());
}

TEST(Compare, SaysWhatIsOnlyInOne) {
  json now = small_report();
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
  json now = small_report();
  now["results"].erase(3);
  const std::string rows = " report, not compared: rows cylinder-box/touching of mine.";
  EXPECT_THAT(remarks(compared_with(now)), HasSubstr("Only in the old" + rows));
  EXPECT_THAT(remarks(compare(now, small_report(), {})), HasSubstr("Only in the new" + rows));
}

TEST(Compare, SaysThatItTakesYourOwnConfigurationsForTheSame) {
  json report = small_report();
  for (const int i : {2, 3}) report["results"][i]["class"] = "given";
  EXPECT_THAT(remarks(compare(report, report, {})),
              HasSubstr("as if both reports had the same file"));
}

TEST(Compare, SaysWhatElseDiffers) {
  json now = small_report();
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
  json now = small_report();
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
  json report = small_report();
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
  json now = small_report();
  now["seed"] = 2;
  now["summary"][1] = row("everyday", "mine", 50, 1e-6, 200);
  for (const char* list : {"results", "summary"}) {  // another pair, and with it all pairs
    now[list].push_back(
        row(list == std::string("results") ? "cap" : "everyday", "mine", 1, 1, 200));
    now[list].back()["pair"] = "cylinder-sphere";
  }
  json old = small_report();
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
  json old = small_report(), now = small_report();
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
  json old = small_report(), now = small_report();
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
  json now = small_report();
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
  json report = small_report();
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
  json now = small_report();
  for (int i = 0; i < 30; ++i) {
    now["results"].push_back(row(("z" + std::to_string(i)).c_str(), "mine", 1, 1, 1));
  }
  EXPECT_THAT(remarks(compared_with(now)), HasSubstr(" and 10 more."));
}

TEST(Compare, RefusesReportsWithNothingInCommon) {
  json now = small_report();
  now["results"] = now["summary"] = json::array();
  EXPECT_THROW(compared_with(now), InvalidInput);
}

TEST(Compare, SaysThatNeitherReportHasAnAnswer) {
  json report = small_report();
  for (const char* list : {"results", "summary"}) {
    for (json& r : report[list]) r["outcomes"] = {{"unsupported", 100}};
  }
  EXPECT_THAT([&] { compare(report, report, {}); },
              ThrowsMessage<InvalidInput>(HasSubstr("without a scored answer, as OLD is")));
  EXPECT_TRUE(compare(small_report(), report, {}).has_regressed());
}

TEST(Compare, TextFitsIntoEightyColumns) {
  json now = small_report();
  now["seed"] = 2;
  now["machine"]["compiler"] = std::string(30, 'x') + ' ' + std::string(40, 'y');
  now["summary"][1] = row("perpendicular+tilted-1e-15", "capsule-circumscribed", 10, 1, 500);
  now["summary"][1]["pair"] = "cylinder-cylinder";
  json old = small_report();
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
  json now = small_report();
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

/// Three releases: the second broke the class touching and gained on the other, the third mended
/// it.
Report three_releases() {
  json report = small_report();
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
