#include "simulation/scenes/choose.hpp"

#include <gmock/gmock.h>

#include "candidates/candidates.hpp"
#include "properties/files/configuration_json.hpp"
#include "reference/invalid_input.hpp"
#include "reports/choice/choice_json.hpp"
#include "reports/choice/choice_page.hpp"
#include "reports/choice/choice_text.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// A can that stands, a little askew, and a ball far from it on the same ground.
SceneFile standing_can(const json& need) {
  json scene = json::parse(R"({
    "duration": 0.8,
    "bodies": [
      {"name": "ground", "shape": {"shape": "plane", "normal": [0, 0, 1], "displacement": 0},
       "fixed": true},
      {"name": "can", "shape": {"shape": "cylinder", "radius": 0.1, "half_length": 0.2},
       "pose": {"position": [0, 0, 0.2], "orientation": [1, 0.004, 0.001, 0]}}]})");
  scene["needs"] = {need};
  return scene_from_json(scene, "can");
}
const json stands = {{"need", "stands"}, {"body", "can"}, {"degrees", 2}};
const json stays = {
    {"need", "stays-in"}, {"body", "can"}, {"lower", {-9, -9, 0}}, {"upper", {9, 9, 1}}};

Choice chosen(const SceneFile& file, unsigned workers = 1) {
  return choose(file, {find_candidates({"capsule", "capsule-circumscribed", "prism:64"}), workers});
}

const SceneRun& run_of(const Choice& choice, const std::string& name) {
  for (const SceneRun& run : choice.runs) {
    if (run.name == name) return run;
  }
  throw std::runtime_error("no run " + name);
}

// Two cans on the same ground, of different sizes and so of different kinds of pairs.
TEST(RunWith, AsksTheCandidateOfEachKindOfPairs) {
  Scene scene;
  scene.duration = 2 * scene.step;
  const auto at = [](double x) { return Pose(Vec3(x, 0, 0.29995)); };
  scene.bodies = {{"ground", Plane(Vec3::UnitZ(), 0), 1000, {}, {}, {}, {}, true},
                  {"left", Cylinder(0.2, 0.3), 1000, {}, at(-1)},
                  {"right", Cylinder(0.3, 0.3), 1000, {}, at(1)}};
  const Candidate &exact = find_candidate("reference"), &capsule = find_candidate("capsule");
  Processes processes({});
  CandidateModel model(processes.of(exact));
  const PairKinds kinds(scene, run_scene(scene, model));
  ASSERT_EQ(kinds.all().size(), 2U);
  const Trajectory run = run_with(scene, kinds, {nullptr, &capsule}, exact, processes);
  ASSERT_GE(run.asked.size(), 2U);
  EXPECT_EQ(run.asked[0].points, 3);  // a cap
  EXPECT_EQ(run.asked[1].points, 1);  // a round end
}

TEST(Choose, CapsulesCannotStand) {
  const Choice choice = chosen(standing_can(stands));
  EXPECT_TRUE(choice.runs[0].holds());
  ASSERT_FALSE(run_of(choice, "capsule").holds());
  const auto& evidence = run_of(choice, "capsule").evidence;
  ASSERT_TRUE(evidence);
  EXPECT_EQ(evidence->candidate, "capsule");
  EXPECT_EQ(evidence->bodies, "can and ground");
  // The rim sinks in: 0.1 m · sin 2° when the need breaks, and the rounded end knows nothing of it.
  EXPECT_THAT(evidence->wrong, HasSubstr("shallow by 0.003"));
  EXPECT_EQ(choice.runs[choice.answer].models[0]->name, "reference");
}

TEST(Choose, TheAnswerHoldsAndNothingCheaperThatWasRunDoes) {
  for (const json& need : {stands, stays}) {
    const Choice choice = chosen(standing_can(need));
    const SceneRun& answer = choice.runs[choice.answer];
    EXPECT_TRUE(answer.holds());
    for (const SceneRun& run : choice.runs) {
      if (!run.holds()) continue;
      EXPECT_GE(run.nanoseconds, cheaper_share * answer.nanoseconds) << run.name;
    }
    ASSERT_EQ(choice.cheaper.size(), 1U);
    if (choice.cheaper[0]) {
      EXPECT_FALSE(choice.runs[*choice.cheaper[0]].holds());
    }
  }
}

TEST(Choose, RunsDoNotDependOnTheNumberOfWorkers) {
  const SceneFile file = standing_can(stands);
  const Choice one = chosen(file, 1), two = chosen(file, 2);
  for (const char* name : {"exact", "capsule", "capsule-circumscribed", "prism:64"}) {
    const SceneRun &a = run_of(one, name), &b = run_of(two, name);
    EXPECT_EQ(a.verdicts[0].value, b.verdicts[0].value) << name;
    EXPECT_EQ(a.verdicts[0].time, b.verdicts[0].time) << name;
    ASSERT_EQ(a.evidence.has_value(), b.evidence.has_value()) << name;
    if (a.evidence) {
      EXPECT_EQ(to_json(a.evidence->configuration), to_json(b.evidence->configuration)) << name;
    }
  }
}

TEST(Choose, SaysWhenExactContactsDoNotServe) {
  const SceneFile file = standing_can(
      {{"need", "stays-in"}, {"body", "can"}, {"lower", {5, 5, 5}}, {"upper", {6, 6, 6}}});
  const Choice choice = chosen(file);
  EXPECT_TRUE(choice.impossible);
  EXPECT_THAT(choice_text(to_json(choice, file, "", "out")), HasSubstr("Not even exact contacts"));
}

TEST(Choose, RefusesScenesWithoutNeedsOrContacts) {
  SceneFile file = standing_can(stands);
  file.needs.clear();
  EXPECT_THROW(chosen(file), InvalidInput);
  file = standing_can(stays);
  file.scene.bodies[1].pose = Pose(Vec3(0, 0, 50), Eigen::Quaterniond::Identity());
  EXPECT_THROW(chosen(file), InvalidInput);
}

TEST(Choose, PageHoldsItsDataAndLoadsNothing) {
  const SceneFile file = standing_can(stands);
  const Choice choice = chosen(file);
  json data = to_json(choice, file, "touchstone choose can.json", "out/choose");
  data["motion"] = motion_json(choice, file, {});
  const json& motion = data["motion"];
  ASSERT_GE(motion["runs"].size(), 2U);
  // 193 steps at 240 a second, every fourth: 49 poses of seven floats of one body, in base64.
  EXPECT_EQ(motion["runs"][0]["poses"].get<std::string>().size(), (49 * 7 * 4 + 2) / 3 * 4U);
  const std::string page = choice_page(data);
  EXPECT_THAT(page, HasSubstr("can stands within 2"));
  EXPECT_THAT(page, HasSubstr("WebGLRenderer"));
  EXPECT_EQ(page.find("src=\"http"), std::string::npos);
  EXPECT_EQ(page.find("/* choose.json */"), std::string::npos);
}

}  // namespace
}  // namespace touchstone
