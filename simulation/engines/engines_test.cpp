// The engines' own worlds: the adapters' conventions, what the engines' contacts get wrong there,
// and that ours end it.
#include <algorithm>
#include <csignal>
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "reference/error_of_test.hpp"
#include "simulation/each_world.hpp"
#include "simulation/engines/run_engines.hpp"
#include "simulation/experiment.hpp"
#include "simulation/experiment_setup.hpp"

namespace touchstone {
namespace {

using Outcome = ExperimentResult::Outcome;
using testing::HasSubstr;

constexpr double usual_step = 1.0 / 240;

bool is_there(const std::string& engine) {
  const auto all = all_engines();
  return std::find(all.begin(), all.end(), engine) != all.end();
}

EngineResult run_one(const Experiment& experiment, const std::string& engine) {
  return run_engines({{&experiment}, {engine}, usual_step, 1}).results.at(0);
}

/// A cylinder is thrown, spinning about its own leaning axis, beside fixed bodies of all shapes;
/// the error is how far its state is from that of semi-implicit Euler, in m, m/s and rad/s.
Measurement throw_cylinder(const Simulator& simulator, double step) {
  Scene scene;
  scene.step = step;
  const Eigen::Quaterniond turn = about(Vec3::UnitX(), 0.5);
  Body thrown = moving_body("thrown", Cylinder(0.1, 0.3), 0.5, Pose(Vec3(1, 2, 50), turn));
  thrown.velocity = Vec3(1, -2, 3);
  thrown.angular_velocity = turn * Vec3(0, 0, 4);
  scene.bodies = {ground(0.5), fixed_body("sphere", Sphere(1), 0.5, Pose(Vec3(20, 0, 0))), thrown,
                  fixed_body("capsule", Capsule(1, 2), 0.5, Pose(Vec3(30, 0, 0))),
                  fixed_body("box", Box(Vec3(1, 2, 3)), 0.5, Pose(Vec3(40, 0, 0)))};
  Run run(scene, simulator, 0.1);
  while (run.step()) {
  }
  const BodyState& s = run.states()[2];
  const double n = std::round(scene.duration / step);
  const Vec3 g(0, 0, -gravity);
  const Vec3 place =
      Vec3(1, 2, 50) + n * step * thrown.velocity + step * step * n * (n + 1) / 2 * g;
  const double error = std::max({(s.pose.position() - place).norm(),
                                 (s.velocity - thrown.velocity - n * step * g).norm(),
                                 (s.angular_velocity - thrown.angular_velocity).norm(),
                                 (s.pose.axis() - turn * Vec3::UnitZ()).norm()});
  return {error, error, run.tally()};
}

class InsideTheEngines : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (!is_there(GetParam())) GTEST_SKIP() << GetParam() << " is not there";
  }
};

TEST_P(InsideTheEngines, AThrownCylinderFliesAsOnPaper) {
  const auto zero = [](double) { return 0.0; };
  // Bullet keeps a body's rotation as a matrix, which it makes a quaternion in every step.
  const auto rounding = [](double) { return GetParam() == "bullet-float" ? 1e-3 : 1e-6; };
  const Experiment thrown{"thrown", "", "", "", throw_cylinder, zero, rounding};
  const EngineResult result = run_one(thrown, GetParam());
  EXPECT_TRUE(result.own.exact) << result.own.error;
  EXPECT_EQ(result.own.points, 0);
}

TEST_P(InsideTheEngines, ASmallLogLiesStillWithOurContacts) {
  const EngineResult result = run_one(find_experiment("small-log"), GetParam());
  EXPECT_TRUE(result.cured.exact) << to_json(result.cured);
  EXPECT_TRUE(result.cured.comes_to_rest());
  EXPECT_EQ(result.cured.points, 2);
}

TEST_P(InsideTheEngines, ADiscAcrossALogLiesStillWithOurContacts) {
  const EngineResult result = run_one(find_experiment("disc-on-log"), GetParam());
  EXPECT_FALSE(result.own.exact) << to_json(result.own);
  EXPECT_TRUE(result.cured.exact) << to_json(result.cured);
}

TEST_P(InsideTheEngines, ACanSlidesAsFarAsOnPaperWithOurContacts) {
  const EngineResult result = run_one(find_experiment("sliding"), GetParam());
  EXPECT_EQ(result.cure, Cure::held) << to_json(result.cured);
}

// Only Bullet's solver at its best casts what moves; to all others the wall is not there.
TEST_P(InsideTheEngines, AFastCanPassesThroughAThinWallUnlessItIsCast) {
  const Experiment& fast = find_experiment("fast-can");
  EXPECT_NEAR(fast.expected(usual_step), 1.24, 1e-12) << "by our cast, and on paper";
  const EngineResult result = run_one(fast, GetParam());
  EXPECT_GT(result.own.error, 10);
  EXPECT_GT(result.cured.error, 10);
  const bool is_cast = GetParam().starts_with("bullet");
  EXPECT_EQ(result.best->exact, is_cast) << to_json(*result.best);
}

INSTANTIATE_TEST_SUITE_P(, InsideTheEngines,
                         testing::Values("bullet", "bullet-float", "ode", "mujoco"),
                         EachWorld::plain_name);

/// What an engine's own contacts get wrong, by more than this error, and ours mend: alone, or once
/// the solver is at its best.
struct KnownFault {
  const char *engine, *experiment;
  double min_error;
  Cure cure;
};
void PrintTo(const KnownFault& fault, std::ostream* out) {
  *out << fault.engine << ' ' << fault.experiment;
}
class KnownFaults : public testing::TestWithParam<KnownFault> {};

TEST_P(KnownFaults, AreMended) {
  const auto& [engine, name, min_error, cure] = GetParam();
  if (!is_there(engine)) GTEST_SKIP() << engine << " is not there";
  const Experiment& experiment = find_experiment(name);
  const EngineResult result = run_one(experiment, engine);
  EXPECT_GT(result.own.error, min_error);
  EXPECT_FALSE(result.own.comes_to_rest());
  EXPECT_EQ(result.cure, cure);
  EXPECT_EQ(result.best.has_value(), cure == Cure::solver);
  if (!experiment.rests) return;
  const ExperimentResult& mended = result.best ? *result.best : result.cured;
  EXPECT_TRUE(mended.comes_to_rest());
  EXPECT_LT(mended.value, 1e-20) << "to the last digit";
}

INSTANTIATE_TEST_SUITE_P(
    , KnownFaults,
    testing::Values(KnownFault{"bullet", "small-log", 1000, Cure::held},
                    KnownFault{"bullet", "rolling", 0.01, Cure::held},
                    KnownFault{"mujoco", "stack-of-five", 1, Cure::held},
                    KnownFault{"ode", "stack-of-ten", 0.1, Cure::solver},
                    KnownFault{"ode", "settling", 0.01, Cure::held},
                    KnownFault{"ode", "stack", 0.005, Cure::solver},
                    // On triangles, where ours know the box.
                    KnownFault{"bullet", "wheel-over-seams", 1e-3, Cure::nearer},
                    KnownFault{"mujoco", "log-over-seams", 5e-3, Cure::nearer}),
    [](const auto& fault) {
      std::string plain = fault.param.engine + (std::string("_") + fault.param.experiment);
      std::ranges::replace(plain, '-', '_');
      return plain;
    });

TEST(InsideAnEngine, ACrashIsAResult) {
  if (!is_there("ode")) GTEST_SKIP();
  const auto zero = [](double) { return 0.0; };
  const auto crash = [](const Simulator&, double) -> Measurement {
    std::raise(SIGSEGV);
    return {};
  };
  const EngineResult result = run_one({"crash", "", "", "", crash, zero, zero}, "ode");
  EXPECT_EQ(result.own.outcome, Outcome::crashed);
  EXPECT_EQ(result.own.reason, "Segmentation fault");
  EXPECT_EQ(result.cure, Cure::open);
}

TEST(InsideAnEngine, ResultsDoNotDependOnTheWorkers) {
  if (!is_there("ode")) GTEST_SKIP();
  const auto without_times = [](unsigned workers) {
    EngineResults all = run_engines(
        {{&find_experiment("stack"), &find_experiment("rolling")}, {"ode"}, usual_step, workers});
    for (EngineResult& r : all.results) {
      r.own.microseconds_per_step = r.cured.microseconds_per_step = 0;
      if (r.best) r.best->microseconds_per_step = 0;
    }
    return to_json(all);
  };
  EXPECT_EQ(without_times(1), without_times(3));
}

TEST(InsideAnEngine, SaysThatAnEngineIsNotThere) {
  EXPECT_THAT(error_of([] {
                run_engines({{&find_experiment("rolling")}, {"havok"}, usual_step, 1});
              }).remedy(),
              HasSubstr("must be one of bullet"));
}

TEST(InsideAnEngine, AMotionHasAFrameForEverySixtiethOfASecond) {
  if (!is_there("ode")) GTEST_SKIP();
  const EngineMotion motion =
      record_motion(find_experiment("rolling"), "ode", {.cured = true}, usual_step);
  EXPECT_DOUBLE_EQ(motion.interval, 1.0 / 60);
  EXPECT_EQ(motion.poses.size(), 7U * (3 * 60 + 1));
  EXPECT_FALSE(is_one_run(find_experiment("tipping"), usual_step));
}

ExperimentResult with_error(double error, bool exact = false) {
  ExperimentResult r;
  r.error = error;
  r.exact = exact;
  return r;
}

TEST(Cure, IsJudgedByTheErrors) {
  const ExperimentResult held = with_error(1e-3, true);
  EXPECT_EQ(cure_of(with_error(1), held, {}), Cure::held);
  EXPECT_EQ(cure_of(with_error(0.5), with_error(0.05), {}), Cure::nearer);
  EXPECT_EQ(cure_of(with_error(100), with_error(2), {}), Cure::open);  // both are lost
  EXPECT_EQ(cure_of(with_error(0.5), with_error(0.3), held), Cure::solver);
  EXPECT_EQ(cure_of(with_error(0.5), with_error(0.4), with_error(0.3)), Cure::alike);
  EXPECT_EQ(cure_of(with_error(0.5), with_error(0.2), with_error(0.1)), Cure::open);
  EXPECT_EQ(cure_of(with_error(0.1), with_error(0.5), {}), Cure::open);  // worse
  ExperimentResult unsound = with_error(0.1);
  unsound.outcome = Outcome::unsound;
  EXPECT_EQ(cure_of(unsound, with_error(0.5), {}), Cure::nearer);
  EXPECT_EQ(cure_of(with_error(0.5), unsound, {}), Cure::open);
}

}  // namespace
}  // namespace touchstone
