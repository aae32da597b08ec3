// Runs of a scene with a candidate for each kind of pairs.
#include "simulation/scenes/scene_judge.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>

#include "candidates/candidates.hpp"
#include "reference/invalid_input.hpp"
#include "simulation/scenes/passing.hpp"
#include "simulation/scenes/trajectory.hpp"

namespace touchstone {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Two cans on the same ground, of different sizes and so of different kinds of pairs, for some
/// steps.
Scene two_cans(int steps, double depth) {
  Scene scene;
  scene.duration = steps * scene.step;
  const auto at = [&](double x) { return Pose(Vec3(x, 0, 0.3 - depth)); };
  scene.bodies = {{"ground", Plane(Vec3::UnitZ(), 0), 1000, {}, {}, {}, {}, true},
                  {"left", Cylinder(0.2, 0.3), 1000, {}, at(-1)},
                  {"right", Cylinder(0.3, 0.3), 1000, {}, at(1)}};
  return scene;
}

TEST(RunScene, CountsThePointsOfAllPairsThatTheSolverGets) {
  Scene scene = two_cans(1, 5e-5);
  Body brick{"brick", Box(Vec3(0.1, 0.2, 0.3))};
  brick.pose = Pose(Vec3(5, 0, 0.3 - 5e-5));
  scene.bodies.push_back(brick);
  Processes processes({});
  CandidateModel model(processes.of(find_candidate("reference")));
  EXPECT_EQ(run_scene(scene, model).points, 3 + 3 + 4);
}

TEST(RunScene, RefusesACandidateWithoutARoutineForAPairThatComesUp) {
  const Scene scene = two_cans(1, 5e-5);
  const Candidate& none = find_candidate("libccd-gjk");  // no half-space
  Processes processes({});
  CandidateModel model(processes.of(none), Unsupported::refused);
  EXPECT_THAT([&] { run_scene(scene, model); },
              testing::ThrowsMessage<InvalidInput>(
                  testing::AllOf(HasSubstr("is \"libccd-gjk\""), HasSubstr("cylinder-plane"))));
}

/// A model that dies with every question.
class Deadly : public ContactModel {
 public:
  void begin() override {}
  std::vector<Answer> answers(std::span<const PairQuestion> questions) override {
    Answer crashed{};
    crashed.status = TS_CRASHED;
    return std::vector<Answer>(questions.size(), crashed);
  }
};

TEST(MotionTable, SaysHowManyQuestionsHadNoAnswer) {
  const Scene scene = two_cans(2, 5e-5);
  Deadly deadly;
  EXPECT_THAT(motion_table(scene, run_scene(scene, deadly)),
              HasSubstr("4 of 4 questions had no answer"));
  Processes processes({});
  CandidateModel exact(processes.of(find_candidate("reference")));
  EXPECT_THAT(motion_table(scene, run_scene(scene, exact)), Not(HasSubstr("no answer")));
}

// The kinds are those of the scene as it is written, whatever the order of the disturbed bodies.
TEST(RunWith, AsksTheCandidateOfEachKindInEveryOrderOfTheBodies) {
  const Scene scene = two_cans(1, 5e-4);
  const Candidate &exact = find_candidate("reference"), &capsule = find_candidate("capsule");
  Processes processes({});
  CandidateModel model(processes.of(exact));
  const PairKinds kinds(scene, run_scene(scene, model));
  ASSERT_EQ(kinds.all().size(), 2U);
  std::set<std::vector<int>> orders;
  for (std::size_t d = 0; d <= 20; ++d) {
    const DisturbedScene disturbed(scene, 1, d);
    orders.insert(disturbed.origin);
    const Trajectory run = run_with(disturbed, kinds, {nullptr, &capsule}, exact, processes);
    ASSERT_GE(run.answers.size(), 2U);
    for (const JudgedAnswer& answer : run.answers) {
      const std::string& name = disturbed.scene.bodies[answer.a].name;
      EXPECT_EQ(answer.points == 1, name == "right") << name << ", disturbance " << d;
    }
  }
  EXPECT_EQ(orders.size(), 6U);
}

TEST(NamedContacts, AreOfAllPairsOrOfKindsOfThem) {
  const Scene scene = two_cans(1, 5e-5);
  const Candidate& capsule = find_candidate("capsule");
  EXPECT_EQ(read_contacts({"capsule"}, scene).for_all, &capsule);
  const NamedContacts one = read_contacts({"cylinder ⌀0.4×0.6 on plane=capsule"}, scene);
  EXPECT_EQ(one.for_all, nullptr);
  Processes processes({});
  const Trajectory run =
      run_with(DisturbedScene(scene, 1, 0), one, find_candidate("reference"), processes);
  ASSERT_GE(run.answers.size(), 2U);
  EXPECT_EQ(run.answers[0].points, 1);  // a round end
  EXPECT_EQ(run.answers[1].points, 3);  // a cap
  for (const std::vector<std::string>& wrong : {std::vector<std::string>{"bulet"},
                                                {"capsule", "prism:8"},
                                                {"cylinder on plane=capsule"},
                                                {"cylinder ⌀0.4×0.6 on plane=bulet"}}) {
    EXPECT_THROW(read_contacts(wrong, scene), InvalidInput) << wrong[0];
  }
}

TEST(LeastStepSeconds, AreThoseOfEachStepInAllRounds) {
  std::vector<std::size_t> order;
  const auto least = least_step_seconds(2, [&](std::size_t run) {
    order.push_back(run);
    const auto made = static_cast<double>(order.size());
    return run == 0 ? std::vector{made, 20 - made} : std::vector{5.0};
  });
  EXPECT_THAT(order, testing::ElementsAre(0, 1, 1, 0, 0, 1, 1, 0, 0, 1));
  EXPECT_THAT(least, testing::ElementsAre(std::vector{1.0, 11.0}, std::vector{5.0}));

  order.clear();
  const auto note = [&](std::size_t run) {
    order.push_back(run);
    return std::vector{1.0};
  };
  least_step_seconds(3, note, 2);
  EXPECT_THAT(order, testing::ElementsAre(0, 1, 2, 1, 2, 0));
}

// What is printed of a run.

/// A can that begins in the origin, beside a floor, and where it ends.
std::string table_of(const Vec3& end, bool is_fixed) {
  Scene scene;
  scene.bodies = {{.name = "floor", .shape = Plane(Vec3::UnitZ(), -1), .fixed = true},
                  {.name = "can", .shape = Cylinder(0.1, 0.2), .fixed = is_fixed}};
  Trajectory run;
  run.step = 0.1;
  for (const Vec3& place : {Vec3(0, 0, 0), end}) {
    run.frames.push_back(
        {{Pose(), Vec3::Zero(), Vec3::Zero()}, {Pose(place), Vec3::Zero(), Vec3::Zero()}});
  }
  return motion_table(scene, run);
}

TEST(MotionTable, TellsMicrometresApart) {
  const std::string text = table_of(Vec3(-1234.567891, 0.000123, 1e-6), false);
  EXPECT_THAT(text, HasSubstr("can    -1234.567891   0.000123   0.000001  1234.567891"));
  EXPECT_THAT(text, testing::Not(HasSubstr("floor")));
}

TEST(MotionTable, SaysThatNothingMoves) {
  EXPECT_EQ(table_of(Vec3(0, 0, 0), true), "  Nothing moves: all is fixed.\n");
}

/// A can of 0.1 m radius that flies along x at 10 m/s, on its side, and is stopped by a plate 2 cm
/// thick, which it first overlaps in frame 1.
Trajectory shot_at(const Scene& scene) {
  Trajectory run;
  run.step = 0.01;
  for (const double x : {-0.15, -0.05}) {
    run.frames.push_back({{scene.bodies[0].pose, Vec3::Zero(), Vec3::Zero()},
                          {Pose(Vec3(x, 0, 0)), Vec3(10, 0, 0), Vec3::Zero()}});
  }
  run.answers = {{0, 1, 0, -0.04, TS_NONE, 0, {}, 0}, {1, 1, 0, 0.06, TS_CONTACT, -0.06, {}, 1}};
  return run;
}

TEST(ShortestPassing, IsAsLongAsBothBodiesOverlapOnAStraightWay) {
  Scene scene;
  scene.bodies = {{.name = "plate", .shape = Box({0.01, 1, 1}), .fixed = true},
                  {.name = "can", .shape = Cylinder(0.1, 0.2)}};
  const auto passing = shortest_passing(scene, shot_at(scene));
  ASSERT_TRUE(passing);
  // From the can's front at the plate to its back behind it: (0.2 m + 0.02 m) / 10 m/s.
  EXPECT_NEAR(passing->seconds, 0.022, 1e-15);
  EXPECT_EQ(passing->time, 0);
  scene.bodies[0].shape = Plane(Vec3(-1, 0, 0), 0);
  EXPECT_FALSE(shortest_passing(scene, shot_at(scene))) << "a half-space has no other side";
  scene.bodies[0].shape = Box({0.01, 1, 1});
  Trajectory resting = shot_at(scene);
  resting.answers[0].depth = 0.01;
  EXPECT_FALSE(shortest_passing(scene, resting)) << "in contact from the start";
}

TEST(ShapeText, TellsHullsApart) {
  const Convex wedge({{0, 0, 0}, {2, 0, 0}, {0, 4, 0}, {0, 0, 0.5}},
                     {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
  EXPECT_EQ(shape_text(wedge), "convex 2×4×0.5 of 4 corners");
}

}  // namespace
}  // namespace touchstone
