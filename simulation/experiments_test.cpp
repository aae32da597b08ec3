// The experiments judge contacts; these tests judge the experiments. Exact contacts must pass each,
// and what is known to be wrong must be seen.
#include <gmock/gmock.h>

#include "candidates/candidates.hpp"
#include "reference/invalid_input.hpp"
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
  // The contact lies half a depth within the surface, of at most a layer of 1e-4 m: the lever is
  // shorter by 2e-4 of the radius at the most, the acceleration by a third of twice that.
  EXPECT_LT(result["error"], 1.4e-4);
  EXPECT_LT(result["details"]["ripple"], 1e-8);
  EXPECT_EQ(result["points"], 2);
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
