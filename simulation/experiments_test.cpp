// The experiments judge contacts; these tests judge the experiments. Exact contacts must pass each,
// and what is known to be wrong must be seen.
#include <gmock/gmock.h>

#include "candidates/candidates.hpp"
#include "reference/invalid_input.hpp"
#include "simulation/resolution.hpp"
#include "simulation/run_experiments.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr double usual_step = 1.0 / 240;

json run_one(const std::string& experiment, const std::string& candidate,
             double step = usual_step) {
  ExperimentOptions options;
  options.experiments = {&find_experiment(experiment)};
  options.candidates = {&find_candidate(candidate)};
  options.steps = {step};
  return run_experiments(options)["results"][0];
}

class EveryExperiment : public testing::TestWithParam<std::string> {};

TEST_P(EveryExperiment, IsPassedByOurContacts) {
  for (const double step : {1.0 / 60, usual_step}) {
    const json result = run_one(GetParam(), "reference", step);
    EXPECT_EQ(result["exact"], true) << result.dump();
    EXPECT_EQ(result["failures"], 0);
  }
}

std::vector<std::string> names() {
  std::vector<std::string> result;
  for (const Experiment& e : all_experiments()) result.push_back(e.name);
  return result;
}
INSTANTIATE_TEST_SUITE_P(, EveryExperiment, testing::ValuesIn(names()), [](const auto& name) {
  std::string plain = name.param;
  std::erase(plain, '-');
  return plain;
});

TEST(Experiments, RollingKeepsToSemiImplicitEuler) {
  const json result = run_one("rolling", "reference");
  EXPECT_LT(result["error"], 1.1e-8);  // two thirds of touching and sinking, in radii
  EXPECT_LT(result["details"]["ripple"], 1e-8);
  EXPECT_EQ(result["points"], 2);
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
      EXPECT_LT(experiment.run(model, usual_step).error, experiment.resolution(usual_step))
          << name << ' ' << share;
    }
  }
}

// What they resolve: depths that are wrong by less than half the layer move nothing further.
TEST(Experiments, DoNotJudgeDepthsWithinTheSurfaceLayer) {
  const Experiment& experiment = find_experiment("stack");
  ChangedModel model([wrong = 2e-5](Answer& answer) mutable {
    wrong = -wrong;
    for (int i = 0; i < answer.point_count; ++i) answer.points[i].depth += wrong;
  });
  EXPECT_LT(experiment.run(model, usual_step).error, experiment.resolution(usual_step));
}

// What is left is the contacts', not the solver's: it has converged, and nothing slips.
TEST(Experiments, LeaveExactContactsNoMoreThanCfmAndTheLayerDo) {
  const double radius = 0.25, weights = 3 + 2 + 1;  // on the three supports of the stack
  EXPECT_LT(run_one("stack", "reference")["error"], weights * sinking(10) / radius);
  EXPECT_LT(run_one("lying", "reference")["error"],
            way_within_layer(1e-4, 1, radius, 0.5) / radius);
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
  EXPECT_NEAR(experiment.run(model, usual_step).error, 2.67e-6, 1e-8);
}

TEST(Experiments, SeeAPrismThatDoesNotRoll) {
  const json result = run_one("rolling", "prism:16");
  EXPECT_EQ(result["exact"], false);
  EXPECT_GT(result["error"], 0.1);
  EXPECT_GT(result["details"]["ripple"], 1e-3);
}

TEST(Experiments, SeeACapsuleThatDoesNotStand) {
  const json result = run_one("standing", "capsule");
  EXPECT_EQ(result["exact"], false);
  EXPECT_GT(result["error"], 1);
}

TEST(Experiments, SeeACoinThatFallsFlatThoughItGoesRoundAsFast) {
  const json result = run_one("coin", "spheres:8", 1.0 / 60);
  EXPECT_EQ(result["exact"], false) << result.dump();
}

TEST(Experiments, SeeOneContactUnderALyingCylinder) {
  try {
    find_candidate("bullet");
  } catch (const InvalidInput&) {
    GTEST_SKIP() << "Bullet is not there";
  }
  const json result = run_one("lying", "bullet");
  EXPECT_GT(result["single"], 0.9);
  EXPECT_GT(result["value"], 1e-6);  // never at rest
  EXPECT_EQ(result["exact"], false);
}

TEST(Experiments, SayWhatACandidateLacks) {
  const json result = run_one("standing", "box-spheres:8");
  EXPECT_EQ(result["outcome"], "unsupported");
}

TEST(Experiments, GiveTheSameResultWithAnyNumberOfWorkers) {
  ExperimentOptions options;
  for (const char* name : {"standing", "tunnelling"}) {
    options.experiments.push_back(&find_experiment(name));
  }
  options.candidates = {&find_candidate("reference"), &find_candidate("capsule")};
  const auto without_times = [&](unsigned workers) {
    options.workers = workers;
    json result = run_experiments(options);
    for (json& row : result["results"]) {
      row.erase("nanoseconds");
      row.erase("microseconds_per_step");
    }
    return result;
  };
  EXPECT_EQ(without_times(1), without_times(3));
}

TEST(Experiments, AreFoundByName) {
  try {
    find_experiment("juggling");
    FAIL();
  } catch (const InvalidInput& e) {
    EXPECT_THAT(e.what(), HasSubstr("must be one of standing, standing-on-box, lying"));
  }
}

}  // namespace
}  // namespace touchstone
