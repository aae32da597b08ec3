#include "reports/factors.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "properties/identity.hpp"
#include "reports/findings.hpp"
#include "reports/make_report.hpp"
#include "reports/tally.hpp"

namespace touchstone {
namespace {

/// A report of one candidate on cylinder-cylinder, of which `agree` in 100 agree in each class.
class Rates {
 public:
  Rates() {
    report_.seed = 7;
    report_.candidates = {{"mine", "mine", "1", "", ""}};
  }
  Rates& add(const std::string& pose_class, std::uint64_t agree, std::uint64_t of = 100) {
    report_.classes.push_back(description_of({Pair::cylinder, pose_class}));
    ResultRow& row = report_.results.emplace_back();
    row.pair = pair_name(Pair::cylinder);
    row.pose_class = pose_class;
    row.candidate = "mine";
    row.statistics.count = of;
    row.statistics.outcomes[static_cast<std::size_t>(Outcome::agree)] = agree;
    row.statistics.outcomes[static_cast<std::size_t>(Outcome::shallow)] = of - agree;
    if (agree < of) row.worst_index = 3;
    return *this;
  }
  /// A class of 512 of which so many agree before the third time-out ends it.
  Rates& add_stopped(const std::string& pose_class, std::uint64_t agree) {
    add(pose_class, agree, 512);
    OutcomeCounts& outcomes = report_.results.back().statistics.outcomes;
    outcomes[static_cast<std::size_t>(Outcome::shallow)] = 0;
    outcomes[static_cast<std::size_t>(Outcome::timed_out)] = 3;
    outcomes[static_cast<std::size_t>(Outcome::not_asked)] = 512 - 3 - agree;
    return *this;
  }
  const Report& get() const { return report_; }

 private:
  Report report_;
};

std::vector<std::string> texts(const std::vector<Contrast>& contrasts) {
  std::vector<std::string> result;
  for (const Contrast& c : contrasts) {
    if (c.fails) result.push_back(contrast_text(c));
  }
  return result;
}

TEST(Chance, IsThatOfFishersTeaTasting) {
  // Four cups of eight, all told right: 1/70. Three: 17/70 (Fisher, "The Design of Experiments",
  // 1935).
  EXPECT_NEAR(chance({4, 0}, {4, 4}), 1.0 / 70, 1e-14);
  EXPECT_NEAR(chance({4, 1}, {4, 3}), 17.0 / 70, 1e-14);
  EXPECT_EQ(chance({20, 0}, {20, 0}), 1);
  EXPECT_NEAR(chance({20, 20}, {20, 0}), 1, 1e-12);
  // Counts of a campaign neither overflow nor take their time.
  EXPECT_LT(chance({1000000, 1000}, {1000000, 2000}), 1e-50);
}

TEST(Contrasts, PointOutWhatFailsOnlyWhenTurned) {
  const auto found =
      contrasts(Rates().add("perpendicular-t", 87).add("perpendicular-t+turned", 30).get());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(texts(found), testing::ElementsAre(
                                "cylinder-cylinder/perpendicular-t agrees in 87%, turned in 30%"));
  EXPECT_EQ(found[0].worst, "cylinder-cylinder/perpendicular-t+turned/7/3");
  EXPECT_THAT(contrast_command(found[0]),
              testing::EndsWith(" replay cylinder-cylinder/perpendicular-t+turned/7/3"));
}

TEST(Contrasts, CompareTurnedOnesWithThoseAlongTheAxes) {
  const auto found = contrasts(Rates()
                                   .add("perpendicular-t", 40)
                                   .add("perpendicular-t+aligned", 87)
                                   .add("perpendicular-t+turned", 30)
                                   .get());
  EXPECT_THAT(texts(found), testing::ElementsAre("cylinder-cylinder/perpendicular-t+aligned agrees "
                                                 "in 87%, turned in 30%"));
}

TEST(Contrasts, PointOutNeitherChanceNorWhatFailsAnyway) {
  EXPECT_TRUE(
      texts(contrasts(Rates().add("perpendicular-t", 60).add("perpendicular-t+turned", 10).get()))
          .empty());
  // Four in twenty more: one such table in twenty, by chance.
  EXPECT_TRUE(
      texts(contrasts(
                Rates().add("perpendicular-t", 20, 20).add("perpendicular-t+turned", 16, 20).get()))
          .empty());
  EXPECT_TRUE(
      texts(contrasts(Rates().add("perpendicular-t", 30).add("perpendicular-t+turned", 87).get()))
          .empty());
}

TEST(Contrasts, OfACandidateThatWasStoppedCountWhatItWasAsked) {
  const auto found = contrasts(
      Rates().add("perpendicular-t", 100).add_stopped("perpendicular-t+turned", 26).get());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].modified.count, 29u);
  EXPECT_EQ(found[0].modified.failed, 3u);
  EXPECT_EQ(found[0].chance, chance({100, 0}, {29, 3}));
}

TEST(Contrasts, TakeTheTiltThatIsWorst) {
  EXPECT_THAT(
      texts(contrasts(Rates()
                          .add("perpendicular-t", 100)
                          .add("perpendicular-t+tilted-1e-3", 95)
                          .add("perpendicular-t+tilted-1e-9", 40)
                          .add("perpendicular-t+tilted-1e-9+turned", 0)
                          .get())),
      testing::ElementsAre("cylinder-cylinder/perpendicular-t agrees in 100%, tilted-1e-9 in 40%"));
}

TEST(Contrasts, PointOutTurnedOnesFirst) {
  Report report = Rates()
                      .add("perpendicular-t", 100)
                      .add("perpendicular-t+turned", 50)
                      .add("perpendicular-t+tilted-1e-9", 10)
                      .get();
  report.contrasts = contrasts(report);
  std::vector<std::string> modifiers;
  for (const Contrast* c : failing_contrasts(report)) modifiers.push_back(c->modifier);
  EXPECT_THAT(modifiers, testing::ElementsAre("turned", "tilted-1e-9"));
}

TEST(Contrasts, PointOutEverydayPosesFirstAndOneOfEachPairBeforeTheSecondOfAny) {
  Report report;
  report.candidates = {{"mine", "mine", "1", "", ""}};
  const auto add = [&](Pair pair, const std::string& arrangement, const std::string& modifier,
                       std::uint64_t failed) {
    report.contrasts.push_back({pair_name(pair), "mine", arrangement, arrangement, modifier,
                                FailureRate{100, 0}, FailureRate{100, failed}, 0, true, ""});
  };
  add(Pair::box, "parallel", "tilted-1e-9", 100);
  add(Pair::cylinder, "coaxial", "turned", 100);  // symmetric, so not everyday
  add(Pair::box, "side-on-face", "turned", 40);
  add(Pair::cylinder, "parallel-side", "turned", 80);
  add(Pair::cylinder, "perpendicular-t", "turned", 90);
  std::vector<std::string> arrangements;
  for (const Contrast* c : failing_contrasts(report)) arrangements.push_back(c->arrangement);
  EXPECT_THAT(arrangements, testing::ElementsAre("perpendicular-t", "side-on-face", "parallel-side",
                                                 "coaxial", "parallel"));
}

TEST(Factors, CompareAModifierWithWhatIsEqualButForIt) {
  // Needles fail everywhere; tiny ones are not to be blamed for being tiny.
  const auto found = factors(Rates()
                                 .add("general", 100)
                                 .add("general+needle", 50)
                                 .add("general+needle+tiny", 50)
                                 .add("general+tiny", 100)
                                 .get());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].name, "needle");
  EXPECT_EQ(found[0].group, "extreme");
  EXPECT_EQ(found[0].kind, Factor::Kind::modifier);
  EXPECT_EQ(found[0].with.share(), 0.5);
  EXPECT_EQ(found[0].without, 0);
  EXPECT_EQ(found[0].worst, "cylinder-cylinder/general+needle/7/3");
}

TEST(Factors, CompareAModifierWithWhatIsNearestWhereNothingIsEqual) {
  // Needles fail; that huge was never tried without them must not put the blame on it.
  for (const Factor& f : factors(Rates()
                                     .add("general", 100)
                                     .add("general+needle", 50)
                                     .add("general+needle+tiny", 50)
                                     .add("general+needle+huge+far", 50)
                                     .get())) {
    EXPECT_EQ(f.name, "needle");
  }
}

TEST(Factors, CompareAnArrangementWithOthersUnderTheSameModifiers) {
  // Everything tiny fails; of the arrangements only rim-rim does so of itself.
  const auto found = factors(Rates()
                                 .add("general", 100)
                                 .add("rim-rim", 40)
                                 .add("perpendicular-t+turned", 100)
                                 .add("general+tiny", 10)
                                 .get());
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].kind, Factor::Kind::arrangement);
  EXPECT_EQ(found[0].name, "rim-rim");
  EXPECT_EQ(found[0].group, "everyday");
  EXPECT_EQ(found[0].with.count, 100u);
  EXPECT_EQ(found[0].without, 0);
  EXPECT_THAT(found, testing::Not(testing::Contains(testing::Field(&Factor::name, "general"))));
}

TEST(Factors, AreNotFoundWhereAllIsWell) {
  EXPECT_TRUE(factors(Rates().add("general", 100).add("rim-rim", 100).add("general+tiny", 99).get())
                  .empty());
}

TEST(Factors, OfACandidateThatWasStoppedMustBeBeyondTheChanceOfFewConfigurations) {
  const auto needles = [](Rates rates) { return factors(rates.add("general", 94).get()).size(); };
  EXPECT_EQ(needles(Rates().add("general+needle", 448, 512)), 1u);
  EXPECT_EQ(needles(Rates().add_stopped("general+needle", 21)), 0u);  // 21 of 24, which is as much
}

TEST(Headings, AreOfOneGroupEach) {
  const std::vector<PoseClass> cells = {{Pair::plane, "touching"},
                                        {Pair::plane, "general+shallow"},
                                        {Pair::box, "general+deep"},
                                        {Pair::box, "general+shallow"}};
  std::vector<std::string> found;
  for (const Heading& h : headings(cells, [](std::size_t) { return true; })) {
    found.push_back(h.pair + ' ' + group_name(h.group));
    for (const std::size_t cell : h.cells) {
      EXPECT_EQ(cells[cell].group(), h.group);
    }
  }
  EXPECT_THAT(found, testing::ElementsAre("cylinder-plane everyday", "cylinder-box everyday",
                                          "all everyday", "cylinder-plane degenerate",
                                          "cylinder-box extreme"));
  EXPECT_EQ(headings(cells, [](std::size_t cell) { return cell == 2; }).size(), 1u);
}

using testing::ElementsAre;
using testing::IsEmpty;

/// A report to which failures are added.
class Failures {
 public:
  Failures& candidate(const char* name, const char* models = "") {
    report_.candidates.push_back({name, name, "1", "", models});
    return *this;
  }
  /// So many of 100 configurations have this outcome, and the rest agree.
  Failures& row(const char* pair, const char* group, const char* candidate, Outcome outcome,
                std::uint64_t times) {
    ResultRow row;
    row.pair = pair;
    row.pose_class = group;
    row.candidate = candidate;
    row.statistics.count = 100;
    row.statistics.outcomes[static_cast<std::size_t>(Outcome::agree)] = 100 - times;
    row.statistics.outcomes[static_cast<std::size_t>(outcome)] += times;
    row.statistics.normal_angle = Quantiles{0, 0, 40.4};
    report_.summary.push_back(row);
    Score score;
    score.outcome = outcome;
    const Configuration any = make_configuration({Pair::plane, "lying", 1, 0});
    report_.worst.push_back({pair,
                             group,
                             "lying",
                             candidate,
                             score,
                             {"", any, std::nullopt, {}, std::string("replay ") + pair}});
    return *this;
  }
  /// Of the last row.
  Failures& split(double of_model, double of_solver) {
    Statistics& s = report_.summary.back().statistics;
    s.model_error = Quantiles{of_model, of_model, of_model};
    s.solver_error = Quantiles{of_solver, of_solver, of_solver};
    return *this;
  }
  Failures& contrast(const char* candidate, const char* modifier, std::uint64_t failed) {
    report_.contrasts.push_back(
        {"cylinder-cylinder",
         candidate,
         "perpendicular-t",
         "perpendicular-t",
         modifier,
         {100, 0},
         {100, failed},
         0,
         true,
         std::string("cylinder-cylinder/perpendicular-t+") + modifier + "/1/3"});
    return *this;
  }
  std::vector<std::string> texts() const {
    std::vector<std::string> result;
    for (const Finding& f : findings(report_)) result.push_back(f.text);
    return result;
  }
  const Report& report() const { return report_; }

 private:
  Report report_;
};

TEST(Findings, TellWhatAModelCostsFromHowWellItIsSolved) {
  const Failures failures = Failures()
                                .candidate("bullet")
                                .row("cylinder-box", "everyday", "bullet", Outcome::missed, 20)
                                .split(0.033, 2e-6);
  EXPECT_THAT(
      failures.texts(),
      ElementsAre("bullet: missed in 20 of 100 everyday poses of cylinder-box; 99%: what it "
                  "models is off by at most 3.3e-02 of the size, and solved to 2.0e-06"));
}

TEST(Findings, AreOfThreeEnginesTheMostFrequentFailuresFirst) {
  const Failures failures =
      Failures()
          .candidate("bullet")
          .candidate("bullet-float")
          .candidate("ode")
          .candidate("fcl")
          .candidate("mujoco")
          .row("cylinder-box", "everyday", "bullet", Outcome::missed, 20)
          .row("cylinder-box", "everyday", "bullet-float", Outcome::missed, 21)
          .row("cylinder-box", "everyday", "ode", Outcome::off_body, 30)
          .row("cylinder-plane", "everyday", "fcl", Outcome::overdeep, 1)
          .row("cylinder-box", "everyday", "mujoco", Outcome::overdeep, 2);
  EXPECT_THAT(failures.texts(),
              ElementsAre("ode: off-body in 30 of 100 everyday poses of cylinder-box",
                          "bullet-float: missed in 21 of 100 everyday poses of cylinder-box",
                          "mujoco: overdeep in 2 of 100 everyday poses of cylinder-box"));
  EXPECT_EQ(findings(failures.report())[0].command, "replay cylinder-box");
}

TEST(Findings, BeginWithWhatFailsOnceTurned) {
  EXPECT_THAT(Failures()
                  .candidate("bullet")
                  .candidate("ode")
                  .row("cylinder-box", "everyday", "bullet", Outcome::missed, 99)
                  .contrast("bullet", "tilted-1e-1", 95)
                  .contrast("ode", "turned", 40)
                  .texts(),
              ElementsAre("ode: cylinder-cylinder/perpendicular-t agrees in 100%, turned in 60%",
                          "bullet: missed in 99 of 100 everyday poses of cylinder-box"));
}

// A capsule is no cylinder: that it fails says nothing of the routine.
TEST(Findings, AreOfModelsWhereNothingElseFails) {
  EXPECT_THAT(Failures()
                  .candidate("capsule", "a capsule")
                  .candidate("ode")
                  .row("cylinder-box", "everyday", "capsule", Outcome::missed, 80)
                  .row("cylinder-box", "everyday", "ode", Outcome::off_body, 3)
                  .texts(),
              ElementsAre("ode: off-body in 3 of 100 everyday poses of cylinder-box",
                          "capsule: missed in 80 of 100 everyday poses of cylinder-box"));
}

// Every other normal than the plane's own is that of an edge between its triangles.
TEST(Findings, NameTheSeamsOfAFloorOfTriangles) {
  EXPECT_THAT(
      Failures()
          .candidate("ode")
          .candidate("bullet-floor:8")
          .row("cylinder-plane", "everyday", "bullet-floor:8", Outcome::wrong_normal, 2)
          .row("cylinder-box", "everyday", "bullet-floor:8", Outcome::wrong_normal, 60)
          .row("cylinder-box", "everyday", "ode", Outcome::missed, 50)
          .contrast("ode", "turned", 40)
          .texts(),
      ElementsAre("bullet-floor:8: at seams normals are up to 40° off, wrong-normal in 2 of 100 "
                  "everyday poses of cylinder-plane",
                  "ode: cylinder-cylinder/perpendicular-t agrees in 100%, turned in 60%",
                  "bullet-floor:8: wrong-normal in 60 of 100 everyday poses of cylinder-box"));
}

TEST(Findings, AreOfEverydayPosesBeforeOthers) {
  EXPECT_THAT(Failures()
                  .candidate("reference")
                  .row("cylinder-plane", "everyday", "reference", Outcome::shallow, 1)
                  .row("cylinder-sphere", "extreme", "reference", Outcome::shallow, 50)
                  .texts(),
              ElementsAre("reference (Touchstone's own): shallow in 1 of 100 everyday poses of "
                          "cylinder-plane",
                          "reference (Touchstone's own): shallow in 50 of 100 extreme poses of "
                          "cylinder-sphere"));
}

TEST(Findings, AreNoneWhereAllAgree) {
  EXPECT_THAT(
      Failures().candidate("ode").row("cylinder-box", "everyday", "ode", Outcome::agree, 0).texts(),
      IsEmpty());
}

}  // namespace
}  // namespace touchstone
