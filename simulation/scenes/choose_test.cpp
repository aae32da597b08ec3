// The cheapest models that a scene needs.
#include "simulation/scenes/choose.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include <nlohmann/json.hpp>

#include "candidates/candidates.hpp"
#include "properties/files/configuration_json.hpp"
#include "properties/files/disk.hpp"
#include "reference/invalid_input.hpp"
#include "simulation/scenes/need.hpp"
#include "simulation/scenes/scene_file.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// A can that stands, a little askew.
SceneFile standing_can(const json& need) {
  json scene = json::parse(R"({
    "duration": 0.8,
    "bodies": [
      {"name": "ground", "shape": {"shape": "plane", "normal": [0, 0, 1], "displacement": 0},
       "fixed": true},
      {"name": "can", "shape": {"shape": "cylinder", "radius": 0.1, "half_length": 0.2},
       "pose": {"position": [0, 0, 0.2], "orientation": [1, 0.004, 0.001, 0]}}]})");
  scene["needs"] = {need};
  return scene_from_text(scene.dump(), "can.json");
}
const json stands = {{"need", "stands"}, {"body", "can"}, {"degrees", 2}};
const json stays = {
    {"need", "stays-in"}, {"body", "can"}, {"lower", {-9, -9, 0}}, {"upper", {9, 9, 1}}};

/// As many as tell what breaks in a single one, and what holds.
constexpr Trials few{.disturbances = 2};

Choice chosen(const SceneFile& file, unsigned workers = 1) {
  return choose(
      file, {find_candidates({"capsule", "capsule-circumscribed", "prism:64"}), workers, {}, few});
}

const SceneRun& run_of(const Choice& choice, const std::string& name) {
  for (const SceneRun& run : choice.runs) {
    if (run.name == name) return run;
  }
  throw std::runtime_error("no run " + name);
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
  EXPECT_FALSE(run_of(choice, "capsule-circumscribed").holds());
  EXPECT_EQ(choice.runs[choice.answer].models[0]->family.find("capsule"), std::string::npos);
}

TEST(Choose, TheAnswerHoldsAndNothingCheaperThatWasRunDoes) {
  for (const json& need : {stands, stays}) {
    const Choice choice = chosen(standing_can(need));
    const SceneRun& answer = choice.runs[choice.answer];
    EXPECT_TRUE(answer.holds());
    EXPECT_EQ(answer.held, 1 + choice.trials.of_answer());
    for (const SceneRun& run : choice.runs) {
      if (!run.holds() || run.timing == 0) continue;
      EXPECT_GE(run.seconds(), cheaper_share * answer.seconds()) << run.name;
    }
    ASSERT_EQ(choice.cheaper.size(), 1U);
    if (choice.cheaper[0]) {
      const SceneRun& next = choice.runs[*choice.cheaper[0]];
      EXPECT_TRUE(!next.holds() || next.timing == 0 ||
                  next.seconds() > cheaper_share * answer.seconds());
    }
  }
}

// Among models that take much the same the first one is the answer, whatever the order of
// --candidates.
TEST(ExactFirst, TheOthersAreInTheirOwnOrder) {
  const auto names = [](const std::vector<std::string>& given) {
    std::vector<std::string> result;
    for (const Candidate* c : exact_first(find_candidates(given))) result.push_back(c->name);
    return result;
  };
  const std::vector<std::string> ordered = {"reference", "ode",       "capsule",
                                            "spheres:1", "spheres:2", "box-capsules:1"};
  EXPECT_EQ(names({"ode", "capsule", "spheres:1", "spheres:2", "box-capsules:1"}), ordered);
  EXPECT_EQ(names({"box-capsules:1", "spheres:2", "spheres:1", "reference", "capsule", "ode"}),
            ordered);
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

/// Cans that stand upright on the cap of a fixed cylinder each, and must go on to.
SceneFile cans_on_pedestals(const std::vector<Vec3>& places) {
  json scene = {{"duration", 1}, {"bodies", json::array()}, {"needs", json::array()}};
  const auto add = [&](const std::string& name, double half_length, const Vec3& at, bool fixed) {
    scene["bodies"].push_back(
        {{"name", name},
         {"shape", {{"shape", "cylinder"}, {"radius", 0.03}, {"half_length", half_length}}},
         {"pose", {{"position", {at.x(), at.y(), at.z()}}, {"orientation", {1, 0, 0, 0}}}},
         {"fixed", fixed}});
  };
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::string can = "can-" + std::to_string(i);
    add("pedestal-" + std::to_string(i), 0.1, places[i] - Vec3(0, 0, 0.1), true);
    add(can, 0.06, places[i] + Vec3(0, 0, 0.06), false);
    scene["needs"].push_back({{"need", "stands"}, {"body", can}, {"degrees", 2}});
  }
  return scene_from_text(scene.dump(), "pedestals.json");
}

// Both axes are the same line, on which a capsule's pole stands on the other's.
TEST(Choose, ACapsuleThatBalancesOnItsPoleDoesNotStand) {
  const SceneFile file =
      cans_on_pedestals({Vec3(0.2, 0, 0), Vec3(-0.2, 0, 0), Vec3(0, 0.2, 0), Vec3(0, -0.2, 0)});
  ChooseOptions options{find_candidates({"capsule"}), 2, {}, {.disturbances = 8}};
  const Choice disturbed = choose(file, options);
  options.trials.disturbances = 0;
  const Choice as_written = choose(file, options);
  EXPECT_TRUE(run_of(as_written, "capsule").holds());
  EXPECT_EQ(run_of(as_written, "capsule").trials, 1U);

  const SceneRun& capsule = run_of(disturbed, "capsule");
  EXPECT_FALSE(capsule.holds());
  EXPECT_GT(capsule.disturbance, 0U);
  EXPECT_LT(capsule.held, capsule.trials);
  EXPECT_LT(capsule.trials, 9U);  // it ended early
  ASSERT_TRUE(capsule.evidence);
  EXPECT_EQ(capsule.evidence->candidate, "capsule");
  EXPECT_FALSE(disturbed.impossible);
  EXPECT_EQ(disturbed.answer, 0U);
  EXPECT_EQ(disturbed.runs[0].held, 1 + disturbed.trials.of_answer());
}

/// The model of the first kind of pairs whose bodies' text has this in it.
std::string model_of(const Choice& choice, const std::string& bodies) {
  const auto& kinds = choice.kinds.all();
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    if (kinds[k].bodies.find(bodies) == std::string::npos) continue;
    return choice.runs[choice.answer].models[k]->name;
  }
  throw std::runtime_error("no pair " + bodies);
}

// A can that is pushed along a shelf falls over if its end is round, whatever its side is.
TEST(Choose, ACanThatIsPushedAlongAShelfNeedsItsFlatEnd) {
  const SceneFile file = read_scene(TOUCHSTONE_SCENES "/shelf-push.json");
  const Choice choice = choose(file, {find_candidates({"capsule", "spheres:1"}), 2, {}, few});
  EXPECT_FALSE(choice.impossible);
  EXPECT_EQ(model_of(choice, "shelf"), "reference");
  for (const char* name : {"capsule", "spheres:1"}) {
    EXPECT_FALSE(run_of(choice, name).holds()) << name;
  }
  EXPECT_NE(model_of(choice, "can-1 and can-2"), "reference");  // side by side, anything will do
}

TEST(Choose, TheAnswerDoesNotDependOnTheSeed) {
  const SceneFile file = cans_on_pedestals({Vec3(0, 0, 0)});
  // Of few disturbances, each of which has to throw the capsule over.
  ChooseOptions options{find_candidates({"capsule"}), 2, {}, few};
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    options.trials.seed = seed;
    const Choice choice = choose(file, options);
    EXPECT_FALSE(choice.impossible) << seed;
    EXPECT_EQ(choice.answer, 0U) << seed;
    EXPECT_FALSE(run_of(choice, "capsule").holds()) << seed;
  }
}

TEST(Choose, SavesOfAStepWhatItsContactsAndItsSolverTakeLess) {
  constexpr double rounding = 1e-12;
  Choice choice = chosen(standing_can(stays));
  choice.runs.resize(3);
  for (SceneRun& run : choice.runs) {
    run.timing = 1;
    run.verdicts = {{0, 1, 0}};
  }
  choice.runs[0].nanoseconds = 1e6;
  choice.runs[0].solver_seconds = 0.009;
  choice.runs[1].nanoseconds = 2e6;
  choice.runs[1].solver_seconds = 0.006;
  choice.runs[2].nanoseconds = 1e6;
  choice.runs[2].solver_seconds = 0.008;
  choice.answer = 2;
  EXPECT_NEAR(choice.step_saved(), 0.1, rounding);
  choice.answer = 0;  // what the cheapest other run would save
  EXPECT_NEAR(choice.step_saved(), 0.2, rounding);
  choice.runs[1].timing = 0;
  EXPECT_NEAR(choice.step_saved(), 0.1, rounding);
  choice.runs[2].verdicts[0] = {2, 1, 0};  // breaks the need
  EXPECT_EQ(choice.step_saved(), 0);
}

// A capsule's query takes longer than ours, but on its side it is one point instead of two.
TEST(Choose, TakesADearerQueryThatSparesTheSolverMore) {
  SceneFile file = read_scene(TOUCHSTONE_SCENES "/rod-on-table.json");
  file.needs.pop_back();
  const Choice choice = choose(file, {find_candidates({"capsule", "spheres:16"}), 2, {}, few});
  const Candidate &exact = find_candidate("reference"), &capsule = find_candidate("capsule");
  ASSERT_EQ(choice.runs[choice.answer].models, std::vector{&capsule});
  EXPECT_GT(choice.nanoseconds(0, capsule), choice.nanoseconds(0, exact));
  EXPECT_LT(choice.runs[choice.answer].points, choice.runs[0].points);
  EXPECT_GT(choice.step_saved(), noise_of_step);
  EXPECT_EQ(choice.runs[choice.answer].held, 1 + choice.trials.of_answer());
}

// Were one timed in more rounds than another, it would have the better chance of a quiet moment.
TEST(Choose, TimesWhatItComparesTogether) {
  json scene = json::parse(read_file(TOUCHSTONE_SCENES "/rod-on-table.json", "file"));
  scene["duration"] = 0.5;
  for (const double radius : {0.02, 0.03, 0.04}) {
    json rod = scene["bodies"][1];
    rod["name"] = std::to_string(radius);
    rod["shape"]["radius"] = radius;
    rod["pose"]["position"] = {10 * radius, 0, radius};
    scene["bodies"].push_back(rod);
  }
  scene["needs"].erase(1);
  const auto candidates = find_candidates({"capsule", "spheres:1..8", "prism:8..16"});
  std::size_t timings = 0;
  for (std::uint64_t seed = 1; seed <= 10 && timings < 2; ++seed) {
    const Trials trials{.disturbances = 2, .seed = seed};
    const Choice choice =
        choose(scene_from_text(scene.dump(), "rods.json"), {candidates, 2, {}, trials});
    timings = choice.runs[0].timing;
    for (const SceneRun& run : choice.runs) {
      EXPECT_TRUE(run.timing == timings || run.timing == 0 || !run.holds()) << run.name;
    }
  }
  EXPECT_GE(timings, 2U);  // the model of each rod is found first, then both together
}

// Cans that fall through the table still stand upright.
TEST(Choose, SaysHowFarARunStraysFromTheExactOne) {
  SceneFile file = read_scene(TOUCHSTONE_SCENES "/stack-of-cans.json");
  file.needs.pop_back();
  const Choice choice = choose(file, {find_candidates({"box-capsules:2"}), 2, {}, few});
  EXPECT_EQ(choice.runs[0].straying.distance, 0);
  EXPECT_LT(choice.runs[0].straying.overlap, 5e-4);
  const SceneRun& through = run_of(choice, "box-capsules:2");
  EXPECT_TRUE(through.holds());
  EXPECT_GT(through.straying.overlap, 0.1);
  EXPECT_NEAR(through.straying.distance, 0.5 * 9.81 * 2 * 2, 2);  // a free fall
  EXPECT_EQ(through.straying.body.substr(0, 4), "can-");
}

// As written a can stands on a capsule's pole; a shift of a hair throws it over. The needs allow
// both.
TEST(Choose, SaysHowFarTheWorstOfARunsTrialsStrays) {
  const SceneFile file = scene_from_text(R"({
    "duration": 1.2,
    "bodies": [
      {"name": "ground", "shape": {"shape": "plane", "normal": [0, 0, 1], "displacement": 0},
       "fixed": true},
      {"name": "can", "shape": {"shape": "cylinder", "radius": 0.03, "half_length": 0.06},
       "pose": {"position": [0, 0, 0.06]}}],
    "needs": [{"need": "penetration", "metres": 1}]})",
                                         "can.json");
  const Choice choice = choose(file, {find_candidates({"capsule"}), 1, {}, few});
  const SceneRun& on_pole = run_of(choice, "capsule");
  ASSERT_GT(on_pole.trials, 1U);
  EXPECT_GT(on_pole.straying.tilt, 60);
  EXPECT_EQ(on_pole.straying.tilted_body, "can");
  EXPECT_GT(on_pole.straying.distance, 0.03);
  EXPECT_EQ(choice.runs[0].straying.tilt, 0);
  // Exact runs end where they began, but for the disturbances.
  ASSERT_NE(choice.answer, 0U);
  EXPECT_GT(choice.exact_spread.distance, 0);
  EXPECT_LT(choice.exact_spread.distance, 0.003);
  EXPECT_LT(choice.exact_spread.tilt, 0.2);
}

// An ending that is compared with the exact run is compared with the same disturbance of it.
TEST(Choose, ExactContactsAreAlwaysWhereTheyEndThemselves) {
  SceneFile file = standing_can(stands);
  file.needs = {ends_near_need(1, 1e-9)};  // nearer than a file may ask for
  const Choice choice = chosen(file, 2);
  EXPECT_FALSE(choice.impossible);
  EXPECT_EQ(choice.runs[0].held, 1 + few.of_answer());
}

// Exact contacts are held to as many disturbances as any answer: a can must not start further from
// its place than in the first disturbances, and does in a later one.
TEST(Choose, ExactContactsThatFailUnderAFurtherDisturbanceDoNotServe) {
  SceneFile file = standing_can(stands);
  file.scene.duration = 0.02;
  const ChooseOptions options{{}, 2, {}, few};  // the exact one alone
  std::vector<double> distances;                // by disturbance, the largest of the run
  Processes processes({});
  CandidateModel exact(processes.of(find_candidate("reference")));
  const Vec3 place = file.scene.bodies[1].pose.position();
  for (std::size_t d = 0; d <= options.trials.of_answer(); ++d) {
    const DisturbedScene disturbed(file.scene, options.trials.seed, d);
    distances.push_back(0);
    for (const auto& frame : disturbed.turned_back(run_scene(disturbed.scene, exact)).frames) {
      distances.back() = std::max(distances.back(), (frame[1].pose.position() - place).norm());
    }
  }
  const auto further = distances.begin() + 3;
  const double early = *std::max_element(distances.begin(), further);
  const double late = *std::max_element(further, distances.end());
  ASSERT_LT(early, late);
  const json near = {{"need", "stays-in"},
                     {"body", "can"},
                     {"lower", {place.x(), place.y(), place.z()}},
                     {"upper", {place.x(), place.y(), place.z()}},
                     {"metres", (early + late) / 2}};
  SceneFile near_place = standing_can(near);
  near_place.scene.duration = file.scene.duration;
  const Choice choice = choose(near_place, options);
  EXPECT_TRUE(choice.impossible);
  EXPECT_EQ(choice.answer, 0U);
  EXPECT_GT(choice.runs[0].disturbance, 2U);
  EXPECT_EQ(distances[choice.runs[0].disturbance] > (early + late) / 2, true);
}

// Of a can as wide as high the capsule and several spheres are the sphere inside; of a flatter one
// spheres lie in a ring.
TEST(Choose, LeavesOutWhatIsOneSphereByAnotherName) {
  SceneFile file = standing_can(stays);
  file.scene.duration = 0.05;
  const auto names_with = [&](const std::vector<std::string>& names) {
    std::vector<std::string> result;
    const Choice choice = choose(file, {find_candidates(names), 1, {}, {0, 1}});
    for (const Candidate* c : choice.candidates) result.push_back(c->name);
    return result;
  };
  using testing::UnorderedElementsAre;
  const std::vector<std::string> all = {"capsule", "spheres:1..2"};
  EXPECT_THAT(names_with(all),
              UnorderedElementsAre("reference", "capsule", "spheres:1", "spheres:2"));
  file.scene.bodies[1].shape = Cylinder(0.1, 0.1);
  file.scene.bodies[1].pose = Pose(Vec3(0, 0, 0.1));
  EXPECT_THAT(names_with(all), UnorderedElementsAre("reference", "spheres:1"));
  EXPECT_THAT(names_with({"capsule"}), UnorderedElementsAre("reference", "capsule"));
  file.scene.bodies[1].shape = Cylinder(0.2, 0.1);
  EXPECT_THAT(names_with(all), UnorderedElementsAre("reference", "spheres:1", "spheres:2"));
}

TEST(Choose, AModelsBytesAreThoseOfAllItsParts) {
  SceneFile file = standing_can(stands);
  file.scene.duration = 0.01;
  file.scene.bodies[0].shape = Box(Vec3(0.4, 0.2, 0.1));
  file.scene.bodies[0].pose = Pose(Vec3(0, 0, -0.1));
  ChooseOptions options{find_candidates({"capsule"})};
  options.trials.disturbances = 0;
  const Choice choice = choose(file, options);
  const auto numbers = [&](const char* name) {
    return choice.model_bytes(0, find_candidate(name)) / sizeof(double);
  };
  EXPECT_EQ(numbers("reference"), 2U);
  EXPECT_EQ(numbers("capsule"), 2U);
  EXPECT_EQ(numbers("spheres:8"), 8U * 4);
  EXPECT_EQ(numbers("prism:16"), 2U * 16 * 3);
  EXPECT_EQ(numbers("box-capsules:3"), 3U * 7);
  // Four along the longest axis, 0.2 m apart; in two rows as far apart.
  EXPECT_EQ(numbers("box-spheres:4"), 2U * 4 * 4);
}

// What is printed to make a run again makes it again, to the last bit of what broke.
TEST(Choose, ARunIsMadeAgainByTheNamesOfItsContacts) {
  const SceneFile file = cans_on_pedestals({Vec3(0, 0, 0), Vec3(0.5, 0, 0)});
  const Choice choice = choose(file, {find_candidates({"capsule", "spheres:2"}), 2, {}, few});
  Processes processes({});
  int broken = 0;
  for (const SceneRun& run : choice.runs) {
    if (run.holds()) continue;
    ++broken;
    const DisturbedScene scene(file.scene, choice.trials.seed, run.disturbance);
    const NamedContacts contacts = read_contacts(choice.contacts_of(run), file.scene);
    const Trajectory again =
        scene.turned_back(run_with(scene, contacts, find_candidate("reference"), processes));
    for (std::size_t i = 0; i < file.needs.size(); ++i) {
      const Verdict verdict = file.needs[i]->judge({file.scene, again, again});
      EXPECT_EQ(verdict.value, run.verdicts[i].value) << run.name;
      EXPECT_EQ(verdict.time, run.verdicts[i].time) << run.name;
    }
  }
  EXPECT_GT(broken, 0);
}

TEST(Choose, SaysWhenExactContactsDoNotServe) {
  const SceneFile file = standing_can(
      {{"need", "stays-in"}, {"body", "can"}, {"lower", {5, 5, 5}}, {"upper", {6, 6, 6}}});
  const Choice choice = chosen(file);
  EXPECT_TRUE(choice.impossible);
  EXPECT_EQ(choice.answer, 0U);
  EXPECT_EQ(choice.runs.size(), 1U);
}

TEST(Choose, RefusesScenesWithoutNeedsOrContacts) {
  SceneFile file = standing_can(stands);
  file.needs.clear();
  EXPECT_THROW(chosen(file), InvalidInput);
  file = standing_can(stays);
  file.scene.bodies[1].pose = Pose(Vec3(0, 0, 50), Eigen::Quaterniond::Identity());
  EXPECT_THROW(chosen(file), InvalidInput);
}

// Which of several choices that all serve is the answer.

constexpr double any_time = std::numeric_limits<double>::infinity();

TEST(SimplestOfCheapest, IsTheCheapestWhereNothingElseIsMuchTheSame) {
  EXPECT_EQ(simplest_of_cheapest({{3, 1.0, 9}, {4, 1.2, 1}, {5, 5.0, 0}}, any_time), 3U);
}

// Two models within a tenth of each other: whichever of them the machine finds cheaper, the simpler
// one is the answer.
TEST(SimplestOfCheapest, IsTheSimplerOfTwoWhicheverNoiseMakesCheaper) {
  for (const double simpler : {0.92, 0.99, 1.0, 1.01, 1.1}) {
    EXPECT_EQ(simplest_of_cheapest({{3, 1.0, 9}, {4, simpler, 2}}, any_time), 4U) << simpler;
    EXPECT_EQ(simplest_of_cheapest({{4, simpler, 2}, {3, 1.0, 9}}, any_time), 4U) << simpler;
  }
  EXPECT_EQ(simplest_of_cheapest({{3, 1.0, 9}, {4, 1.12, 2}}, any_time), 3U);
}

// It is the cheapest with which all are compared, and not the simplest so far: 1.08 is within a
// tenth of 1.0, 1.16 is within a tenth of 1.08 alone.
TEST(SimplestOfCheapest, ComparesWithTheCheapestAlone) {
  EXPECT_EQ(simplest_of_cheapest({{1, 1.16, 0}, {2, 1.08, 1}, {3, 1.0, 2}}, any_time), 2U);
}

TEST(SimplestOfCheapest, IsTheFirstOfEquallySimpleOnes) {
  EXPECT_EQ(simplest_of_cheapest({{7, 1.05, 1}, {8, 1.0, 1}}, any_time), 7U);
}

// The limit is what the exact model takes, less noise: the simplest must keep to it as well.
TEST(SimplestOfCheapest, KeepsToTheLimit) {
  EXPECT_EQ(simplest_of_cheapest({{1, 1.0, 1}, {2, 1.04, 0}}, 1.03), 1U);
  EXPECT_EQ(simplest_of_cheapest({{1, 1.0, 1}, {2, 1.04, 0}}, 1.0), 1U);
  EXPECT_EQ(simplest_of_cheapest({{1, 1.0, 1}, {2, 1.04, 0}}, 0.99), std::nullopt);
  EXPECT_EQ(simplest_of_cheapest({}, any_time), std::nullopt);
}

// Within twice the noise of the cheapest: 1 / 0.81 of it.
TEST(Finalists, AreTheCheapestAndThenTheSimplestThatMayCostMuchTheSame) {
  const std::vector<Finalist> promising = {{3, 1.23, 1}, {4, 1.24, 0}, {5, 1.0, 9}, {6, 1.1, 0}};
  EXPECT_EQ(finalists(promising), (std::vector<std::size_t>{5, 6, 3}));
  EXPECT_TRUE(finalists({}).empty());
}

TEST(Finalists, AreSixAtMost) {
  std::vector<Finalist> alike;
  for (std::size_t i = 0; i < 9; ++i) alike.push_back({i, 1, 9 - i});
  EXPECT_EQ(finalists(alike), (std::vector<std::size_t>{0, 8, 7, 6, 5, 4}));
}

}  // namespace
}  // namespace touchstone
