// The experiments judge contacts; these tests judge the experiments: exact contacts must pass each,
// and contacts known to be wrong must fail.
#include <gmock/gmock.h>
#include <limits>

#include <nlohmann/json.hpp>

#include "candidates/candidates.hpp"
#include "properties/files/bytes.hpp"
#include "reference/error_of_test.hpp"
#include "reference/invalid_input.hpp"
#include "simulation/each_world.hpp"
#include "simulation/experiment.hpp"
#include "simulation/experiment_setup.hpp"
#include "simulation/run_experiments.hpp"
#include "simulation/world.hpp"

namespace touchstone {
namespace {

using Outcome = ExperimentResult::Outcome;
using testing::HasSubstr;

constexpr double experiment_step = 1.0 / 240;

ExperimentResult run_one(const std::string& experiment, const std::string& candidate,
                         double step = experiment_step) {
  ExperimentOptions options;
  options.experiments = {&find_experiment(experiment)};
  options.candidates = {&find_candidate(candidate)};
  options.steps = {step};
  return run_experiments(options).results.at(0);
}

class EveryExperiment : public testing::TestWithParam<std::string> {};

TEST_P(EveryExperiment, IsPassedByOurContacts) {
  for (const double step : {1.0 / 60, experiment_step}) {
    const ExperimentResult result = run_one(GetParam(), "reference", step);
    EXPECT_TRUE(result.exact) << to_json(result);
    EXPECT_EQ(result.failures, 0U);
  }
}

std::vector<std::string> names() {
  std::vector<std::string> result;
  for (const Experiment& e : all_experiments()) result.push_back(e.name);
  // Of those for engines, the others ask more of the solver than QuickStep gives: engines_test.cpp
  // holds them with solvers at their best.
  for (const char* name : {"log", "small-log", "disc-on-log", "sliding", "wheel", "log-over-seams",
                           "wheel-over-seams"}) {
    result.emplace_back(name);
  }
  return result;
}
INSTANTIATE_TEST_SUITE_P(, EveryExperiment, testing::ValuesIn(names()), EachWorld::plain_name);

TEST(Experiments, RollingKeepsToSemiImplicitEuler) {
  const ExperimentResult result = run_one("rolling", "reference");
  EXPECT_LT(result.error, 1.1e-8);  // two thirds of touching and sinking, in radii
  EXPECT_LT(result.details.at("ripple"), 1e-8);
  EXPECT_EQ(result.points, 2);
}

/// Another candidate's contacts, changed.
class ChangedModel : public ContactModel {
 public:
  using Change = std::function<void(Answer&)>;
  explicit ChangedModel(Change change) : change_(std::move(change)) {}
  void begin() override { process_.restart(); }
  std::vector<Answer> answers(std::span<const PairQuestion> questions) override {
    auto result = CandidateModel(process_).answers(questions);
    for (Answer& answer : result) change_(answer);
    return result;
  }

 private:
  CandidateProcess process_{find_candidate("reference"), simulation_threshold};
  Change change_;
};

/// Moves all points from halfway between the surfaces by a share of the depth.
ChangedModel::Change moved(double share) {
  return [share](Answer& answer) {
    for (int i = 0; i < answer.point_count; ++i) {
      ts_point& p = answer.points[i];
      for (int k = 0; k < 3; ++k) p.position[k] += share * p.depth * p.normal[k];
    }
  };
}

// Engines put points on one body, on the other, or between: that is a convention.
TEST(Experiments, DoNotJudgeWhereInTheOverlapPointsLie) {
  for (const char* name : {"rolling", "coin", "lying"}) {
    const Experiment& experiment = find_experiment(name);
    for (const double share : {-0.5, 0.5}) {
      ChangedModel model(moved(share));
      EXPECT_LT(experiment.run(in_our_world(model), experiment_step).error,
                experiment.resolution(experiment_step))
          << name << ' ' << share;
    }
  }
}

// The resolution covers the surface layer: depths wrong by a fifth of it do no harm.
TEST(Experiments, DoNotJudgeDepthsWithinTheSurfaceLayer) {
  const Experiment& experiment = find_experiment("stack");
  ChangedModel model([wrong = 2e-5](Answer& answer) mutable {
    wrong = -wrong;
    for (int i = 0; i < answer.point_count; ++i) answer.points[i].depth += wrong;
  });
  EXPECT_LT(experiment.run(in_our_world(model), experiment_step).error,
            experiment.resolution(experiment_step));
}

// The solver has converged and nothing slips: only CFM and the layer leave an error.
TEST(Experiments, LeaveExactContactsNoMoreThanCfmAndTheLayerDo) {
  const double radius = 0.25, weights = 3 + 2 + 1;  // on the three supports of the stack
  EXPECT_LT(run_one("stack", "reference").error, weights * sinking(10) / radius);
  EXPECT_LT(run_one("lying", "reference").error,
            displacement_within_layer(1e-4, 1, radius, 0.5) / radius);
}

TEST(Experiments, JudgeALeverThatIsWrong) {
  const Experiment& experiment = find_experiment("rolling");
  ChangedModel model([](Answer& answer) {
    for (int i = 0; i < answer.point_count; ++i) {
      for (int k = 0; k < 3; ++k) {
        answer.points[i].position[k] += 1e-6 * answer.points[i].normal[k];
      }
    }
  });
  // Shorter by 4e-6 radii, of which two thirds are seen.
  EXPECT_NEAR(experiment.run(in_our_world(model), experiment_step).error, 2.67e-6, 1e-8);
}

TEST(Experiments, SeeAPrismThatDoesNotRoll) {
  const ExperimentResult result = run_one("rolling", "prism:16");
  EXPECT_FALSE(result.exact);
  EXPECT_GT(result.error, 0.1);
  EXPECT_GT(result.details.at("ripple"), 1e-3);
}

TEST(Experiments, SeeACapsuleThatDoesNotStand) {
  const ExperimentResult result = run_one("standing", "capsule");
  EXPECT_FALSE(result.exact);
  EXPECT_GT(result.error, 1);
}

TEST(Experiments, SeeACoinThatFallsFlatThoughItGoesRoundAsFast) {
  const ExperimentResult result = run_one("coin", "spheres:8", 1.0 / 60);
  EXPECT_FALSE(result.exact) << to_json(result);
}

TEST(Experiments, SeeOneContactUnderALyingCylinder) {
  try {
    find_candidate("bullet");
  } catch (const InvalidInput&) {
    GTEST_SKIP() << "Bullet is not there";
  }
  const ExperimentResult result = run_one("lying", "bullet");
  EXPECT_GT(result.single, 0.9);
  EXPECT_GT(result.value, 1e-6);  // never at rest
  EXPECT_FALSE(result.exact);
}

TEST(Experiments, SayWhatACandidateLacks) {
  const ExperimentResult result = run_one("standing", "box-spheres:8");
  EXPECT_EQ(result.outcome, Outcome::unsupported);
}

TEST(Experiments, GiveTheSameResultWithAnyNumberOfWorkers) {
  ExperimentOptions options;
  for (const char* name : {"standing", "tunnelling"}) {
    options.experiments.push_back(&find_experiment(name));
  }
  options.candidates = {&find_candidate("reference"), &find_candidate("capsule")};
  const auto without_times = [&](unsigned workers) {
    options.workers = workers;
    ExperimentResults all = run_experiments(options);
    for (ExperimentResult& result : all.results) {
      result.nanoseconds.reset();
      result.microseconds_per_step = 0;
    }
    return to_json(all);
  };
  EXPECT_EQ(without_times(1), without_times(3));
}

TEST(ExperimentResults, SurviveTheWayBetweenProcesses) {
  ExperimentResult result;
  result.experiment = "coin";
  result.candidate = "bullet";
  result.outcome = Outcome::unsound;
  result.value = std::numeric_limits<double>::infinity();
  result.details = {{"lean", 0.1}};
  result.nanoseconds = 1.0 / 3;
  const ExperimentResult copy = from_bytes<ExperimentResult>(to_bytes(result));
  EXPECT_EQ(copy.outcome, Outcome::unsound);
  EXPECT_EQ(copy.value, result.value);
  EXPECT_EQ(to_json(copy), to_json(result));
}

TEST(ExperimentResults, OfAnUnsupportedPairHaveNoFigures) {
  ExperimentResult result;
  result.outcome = Outcome::unsupported;
  const nlohmann::json row = to_json(ExperimentResults{{}, {}, {result}})["results"][0];
  EXPECT_EQ(row["outcome"], "unsupported");
  EXPECT_FALSE(row.contains("value"));
}

TEST(Experiments, AreFoundByName) {
  EXPECT_THAT(error_of([] { find_experiment("juggling"); }).remedy(),
              HasSubstr("must be one of standing, standing-on-box, lying"));
}

TEST(Resolution, SinkingIsTheSpeedThatCfmLeavesUnderAWeight) {
  EXPECT_DOUBLE_EQ(sinking(3), 3 * 9.81e-10);
}

TEST(Resolution, LayerLetsABodyOnTwoPointsSinkAndLean) {
  // Points 0.4 m apart, one at the layer's top and one at its bottom.
  EXPECT_DOUBLE_EQ(lean_within_layer(1e-4, 0.4), 2.5e-4);
  EXPECT_DOUBLE_EQ(displacement_within_layer(1e-4, 0.4, 0.5, 0.1), 1e-4 + 2.5e-4 * 0.6);
}

TEST(Resolution, LandingIsAsFastAsTheFallOfALeaningBody) {
  constexpr double gyration = 0.6, arm = 0.25, across = 0.5, lean = 0.01, tick = 1e-7;
  double angle = lean, rate = 0;
  while (angle > 0) {
    rate += tick * 9.81 * arm / (gyration * gyration);
    angle -= tick * rate;
  }
  EXPECT_NEAR(displacement_of_late_landing(lean, arm, gyration, across, 1e-3), across * rate * 1e-3,
              1e-9);
}

TEST(Resolution, BisectionLeavesHalfOfTheLastInterval) {
  EXPECT_EQ(bisected(1), 0.25);
  EXPECT_EQ(bisected(12), 0.5 / 4096);
}

}  // namespace
}  // namespace touchstone
