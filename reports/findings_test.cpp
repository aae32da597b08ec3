#include "reports/findings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "properties/identity.hpp"
#include "reports/tally.hpp"

namespace touchstone {
namespace {

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
