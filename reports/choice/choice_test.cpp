#include "reports/choice/choice.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <numbers>
#include <sstream>

#include <nlohmann/json.hpp>

#include "candidates/candidates.hpp"
#include "reports/pages/page_data.hpp"
#include "reports/replay.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// A can that stands, slightly tilted, with one need.
SceneFile can_with(const std::string& need) {
  const std::string scene = R"({
    "duration": 0.8,
    "bodies": [
      {"name": "ground", "shape": {"shape": "plane", "normal": [0, 0, 1], "displacement": 0},
       "fixed": true},
      {"name": "can", "shape": {"shape": "cylinder", "radius": 0.1, "half_length": 0.2},
       "pose": {"position": [0, 0, 0.2], "orientation": [1, 0.004, 0.001, 0]}}],
    "needs": [)" + need + "]}";
  return scene_from_text(scene, "can.json");
}
Choice choice_of(const std::string& need,
                 const std::vector<std::string>& candidates = {"capsule", "prism:64"}) {
  return choose(can_with(need), {find_candidates(candidates), 1, {}, {.disturbances = 2}});
}
const char* const stands = R"({"need": "stands", "body": "can", "degrees": 2})";
const char* const elsewhere =
    R"({"need": "stays-in", "body": "can", "lower": [5, 5, 5], "upper": [6, 6, 6]})";

TEST(LongStep, IsSaidWhereAFastBodyWouldPassAThinOne) {
  SceneFile file = can_with(stands);
  Scene& scene = file.scene;
  scene.gravity = Vec3::Zero();
  scene.duration = 0.1;
  scene.bodies[0] = {.name = "plate", .shape = Box({0.01, 1, 1}), .fixed = true};
  scene.bodies[1].pose = Pose(Vec3(-0.42, 0, 0));
  const auto text_at = [&](double speed) {
    scene.bodies[1].velocity = Vec3(speed, 0, 0);
    Processes processes({});
    CandidateModel exact(processes.of(find_candidate("reference")));
    const Trajectory run = run_scene(scene, exact);
    return long_step_text({file, run, PairKinds(scene, run), {}, {}});
  };
  // From the front of the can at the plate to its back behind it: 0.2 m + 0.02 m, at 10 m/s.
  EXPECT_EQ(text_at(10),
            "At 0.03 s can would be through plate in 0.022 s: a longer step may miss it.");
  EXPECT_EQ(text_at(-10), "") << "it flies away";
  EXPECT_EQ(text_at(0), "");
}

TEST(ChoicePage, HoldsItsDataAndLoadsNothing) {
  const Choice choice = choice_of(stands);
  const std::string page = choice_page(choice_json(choice, "touchstone choose can.json", "out"),
                                       choice_motion(choice, {}));
  const json data = data_of(page), &motion = data["motion"];
  EXPECT_EQ(data["scene"]["needs"][0]["text"], "can stands within 2°");
  ASSERT_GE(motion["runs"].size(), 2U);
  // 193 steps at 240 a second, every fourth: 49 poses of seven floats of one body, in base64.
  EXPECT_EQ(motion["runs"][0]["poses"].get<std::string>().size(), (49 * 7 * 4 + 2) / 3 * 4U);
  EXPECT_THAT(page, HasSubstr("function startFrame"));
  EXPECT_EQ(page.find("src=\"http"), std::string::npos);
}

TEST(ChoicePage, ShowsTheExactRunWhereNoOtherIsWorthIt) {
  // Sixty-four spheres serve, and take longer.
  const json motion = choice_motion(choice_of(stands, {"spheres:64"}), {});
  ASSERT_EQ(motion["runs"].size(), 1U);
  EXPECT_EQ(motion["runs"][0]["listed"], true);
}

/// A brick that lies on a can's side, along the model's parts.
TEST(ChoicePage, DrawsWhatStandsForABox) {
  const std::string scene = R"({
    "duration": 0.1,
    "bodies": [
      {"name": "table", "shape": {"shape": "box", "half_extents": [0.1, 0.4, 0.2]}, "fixed": true,
       "pose": {"position": [0, 0, -0.2]}},
      {"name": "can", "shape": {"shape": "cylinder", "radius": 0.05, "half_length": 0.1},
       "pose": {"position": [0, 0, 0.1]}}],
    "needs": [{"need": "stays-in", "body": "can", "lower": [-1, -1, -9], "upper": [1, 1, 1]}]})";
  Choice choice = choose(scene_from_text(scene, "brick.json"),
                         {find_candidates({"box-capsules:2", "box-spheres:3"}), 1, {}, {1, 1}});
  for (std::size_t i = 0; i < choice.runs.size(); ++i) {
    choice.answer = i;  // what is drawn, whichever is the cheapest here
    const std::string& model = choice.runs[i].models[0]->name;
    const json motion = choice_motion(choice, {});
    const auto shown = std::ranges::find_if(
        motion["runs"], [](const json& run) { return run["name"] == "the answer"; });
    if (i == 0) continue;
    ASSERT_NE(shown, motion["runs"].end()) << model;
    ASSERT_EQ((*shown)["models"].size(), 1U) << model;
    const json &stand = (*shown)["models"][0], &part = stand["parts"][0];
    EXPECT_EQ(stand["body"], 0) << model;
    if (model.starts_with("box-capsules")) {
      EXPECT_EQ(stand["parts"].size(), 2U);
      // Of the smallest half extent, as long as the box along its y, side by side along z.
      EXPECT_EQ(part["shape"]["shape"], "capsule");
      EXPECT_EQ(part["shape"]["radius"], 0.1);
      EXPECT_NEAR(part["shape"]["half_length"].get<double>(), 0.3, 1e-12);
      EXPECT_NEAR(part["centre"][2].get<double>(), -0.1, 1e-12);
      // A quarter turn about x, which takes z to y.
      EXPECT_NEAR(std::abs(part["orientation"][1].get<double>()), std::sqrt(0.5), 1e-12);
    } else {
      EXPECT_EQ(part["shape"], json({{"shape", "sphere"}, {"radius", 0.1}}));
      EXPECT_NEAR(part["centre"][1].get<double>(), -0.3, 1e-12);
    }
  }
}

// Exact contacts hold as the scene is written; what there is to see is the disturbed run that
// fails.
TEST(ChoicePage, ShowsTheDisturbedRunInWhichExactContactsFail) {
  const auto stays_within = [](double metres) {
    return fmt::format(R"({{"need": "stays-in", "body": "can", "lower": [0, 0, 0.2],
                           "upper": [0, 0, 0.2], "metres": {}}})",
                       metres);
  };
  ChooseOptions options{find_candidates({"spheres:64"})};
  options.trials.disturbances = 0;
  const double as_written = choose(can_with(stays_within(1)), options).runs[0].verdicts[0].value;
  options.trials.disturbances = 16;
  const Choice choice = choose(can_with(stays_within(as_written)), options);
  ASSERT_TRUE(choice.impossible);
  ASSERT_GT(choice.runs[0].disturbance, 0U);
  const json runs = choice_motion(choice, {})["runs"];
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs[0]["listed"], false);
  EXPECT_EQ(runs[1]["listed"], true);
  EXPECT_NE(runs[1]["poses"], runs[0]["poses"]);
  const std::string which = fmt::format("disturbance {}", choice.runs[0].disturbance);
  EXPECT_THAT(runs[1]["note"].get<std::string>(), HasSubstr(which));
  EXPECT_THAT(runs[1]["command"].get<std::string>(), HasSubstr("--" + which + " --seed 1"));
  const std::string text = choice_text(choice, "out");
  EXPECT_THAT(text,
              HasSubstr("Not even exact contacts meet the needs of this scene under " + which));
  EXPECT_THAT(text, HasSubstr("--contacts reference --" + which + " --seed 1\n"));
}

TEST(ChoiceText, SaysInHowManyRunsAModelHeld) {
  const Choice choice = choice_of(stands);
  const SceneRun* capsule = nullptr;
  for (const SceneRun& run : choice.runs) {
    if (run.name == "capsule") capsule = &run;
  }
  ASSERT_TRUE(capsule);
  const std::string held = fmt::format("{}/{}", capsule->held, capsule->trials);
  const std::string wide = choice_text(choice, "out", 80), narrow = choice_text(choice, "out", 40);
  EXPECT_THAT(wide, testing::ContainsRegex("\n  capsule +[0-9.]+ +" + held + "  need 1, "));
  EXPECT_THAT(narrow,
              testing::ContainsRegex("\n  capsule: breaks need 1, [^:]*held in[ \n]+" + held));
}

// Within noise of the cheapest the simplest is the answer; a row that takes less must not
// contradict.
TEST(ChoiceText, DoesNotCallCheapestWhatARowTakesLessThan) {
  Choice choice = choice_of(stands, {"prism:64", "spheres:64"});
  for (SceneRun& run : choice.runs) {
    run.timing = 1;
    run.verdicts = {{0, 1, 0}};
    run.nanoseconds = 0;
    run.solver_seconds = run.name == "prism:64" ? 0.009 : run.name == "spheres:64" ? 0.0085 : 0.02;
  }
  const auto answer =
      std::ranges::find_if(choice.runs, [](const auto& run) { return run.name == "prism:64"; });
  ASSERT_NE(answer, choice.runs.end());
  choice.answer = static_cast<std::size_t>(answer - choice.runs.begin());
  EXPECT_THAT(
      choice_text(choice, "out", 200),
      HasSubstr("\nThe simplest of the cheapest models that meet all needs save 55% of a "));
  for (SceneRun& run : choice.runs) {
    if (run.name == "spheres:64") run.verdicts = {{2, 1, 0}};
  }
  EXPECT_THAT(choice_text(choice, "out", 200),
              HasSubstr("\nThe cheapest models that meet all needs save 55% of a step:"));
}

TEST(ChoiceText, SaysWhereACapsuleIsASphere) {
  SceneFile file = can_with(stands);
  file.scene.bodies[1].shape = Cylinder(0.1, 0.1);
  file.scene.bodies[1].pose = Pose(Vec3(0, 0, 0.1));
  const Choice both = choose(file, {find_candidates({"capsule", "spheres:1"}), 1, {}, {0, 1}});
  EXPECT_THAT(choice_text(both, "out"), HasSubstr("\n  capsule               is spheres:1 here\n"));
  EXPECT_EQ(choice_json(both, "", "out")["same_as_sphere"], json({"capsule"}));
  Choice choice = choose(file, {find_candidates({"capsule"}), 1, {}, {0, 1}});
  choice.answer = 1;  // whichever is the answer here
  ASSERT_EQ(choice.runs[1].name, "capsule");
  EXPECT_THAT(choice_text(choice, "out"), HasSubstr("): capsule (a sphere here)\n"));
  EXPECT_EQ(choice_json(choice, "", "out")["kinds"][0]["is_sphere"], true);
}

// An engine's routine answers for the cylinder itself: it stands for nothing, and is no answer,
// however little it takes.
TEST(ChoiceText, SetsEnginesRoutinesApartFromModels) {
  Choice choice = choice_of(stands, {"capsule", "ode", "prism:64"});
  choice.answer = 0;
  for (SceneRun& run : choice.runs) {
    if (run.name != "ode") continue;
    ASSERT_TRUE(run.holds());
    EXPECT_FALSE(choice.has_models_alone(run));
    run.nanoseconds = run.solver_seconds = 0;
    // Times of a run by itself are no others' times.
    run.timing = 0;
    EXPECT_EQ(cheaper_routines(choice), "");
    run.timing = choice.runs[0].timing;
  }
  const std::string text = choice_text(choice, "out", 200);
  const auto at = [&](const char* part) { return text.find(part); };
  EXPECT_THAT(text, HasSubstr("(Beside models: the routines of ode for the cylinder itself met all "
                              "needs in the first runs, and took less.)\n"));
  ASSERT_NE(at("\nRoutines, not models "), text.npos);
  EXPECT_LT(at("\n  capsule "), at("\nRoutines, not models "));
  EXPECT_LT(at("\n  prism:64 "), at("\nRoutines, not models "));
  EXPECT_GT(at("\n  ode "), at("\nRoutines, not models "));
  const json written = choice_json(choice, "", "out");
  for (const json& run : written["runs"]) {
    EXPECT_EQ(run["models_alone"], run["name"] != "ode");
  }
  EXPECT_THAT(choice_text(choice_of(stands), "out"), testing::Not(HasSubstr("outines")));
}

TEST(ChoiceText, OfTheUnaskedIsOfAllRunsOfTheAnswer) {
  Choice choice = choice_of(stands);
  choice.answer = 1;
  choice.runs[1].straying = {0.25, 0.5, "can", 12, "can"};
  choice.exact_spread = {0, 0.75, "", 8, ""};
  const std::string unasked = unasked_text(choice);
  EXPECT_THAT(unasked, HasSubstr("bodies overlap by up to 0.25 m (with exact contacts: "));
  EXPECT_THAT(unasked,
              HasSubstr("can ends up to 0.5 m from where it does with exact contacts under "
                        "the same disturbance (exact runs differ by 0.75 m); can ends up "
                        "to 12° from its tilt there (exact runs differ by 8°)."));
  EXPECT_THAT(choice_text(choice, "out", 400), HasSubstr(unasked));
  EXPECT_EQ(choice_json(choice, "", "out")["unasked"], unasked);
}

// What falls by its own width in a step is deep in the ground before a contact is found.
TEST(ChoiceText, SaysThatStepsAreLongWhereExactContactsFail) {
  const auto text = [](const char* needs, double step) {
    SceneFile file = can_with(needs);
    file.scene.step = step;
    return choice_text(choose(file, {find_candidates({"capsule"}), 1, {}, {0, 1}}), "out", 200);
  };
  EXPECT_THAT(
      text(elsewhere, 0.2),
      HasSubstr("In a step of 0.2 s can may move by 0.39 m, 2 of its smallest width, before "
                "its contacts are found again: a shorter step may do.\n"));
  EXPECT_THAT(text(elsewhere, 1.0 / 240), testing::Not(HasSubstr("shorter step")));
  const char* overlaps = R"({"need": "penetration", "metres": 1e-9})";
  EXPECT_THAT(text(overlaps, 1.0 / 240), HasSubstr("shorter step"));
}

TEST(ChoiceText, AndJsonNameTheCommandThatMakesAFailureAgain) {
  Choice choice = choice_of(stands);
  choice.arguments = "can.json";
  const json data = choice_json(choice, "", "out");
  for (std::size_t i = 0; i < choice.runs.size(); ++i) {
    const SceneRun& run = choice.runs[i];
    const std::string which =
        run.disturbance == 0 ? "" : fmt::format(" --disturbance {} --seed 1", run.disturbance);
    EXPECT_EQ(data["runs"][i]["render"],
              fmt::format("./touchstone simulate can.json --povray out/render --contacts {}{}",
                          shell_quoted(run.models[0]->name), which));
  }
}

TEST(ChoiceText, AndJsonSayWhichNeedsExactRunsDoNotDecide) {
  Choice choice =
      choice_of(std::string(stands) + R"(, {"need": "ends-near", "body": "can", "metres": 1})");
  choice.spreads.undecidable = {{"can ends within 0.01 m of the exact place", " m", 0.01, 0.28}};
  const std::string text = choice_text(choice, "out", 200);
  EXPECT_THAT(text, testing::ContainsRegex(
                        "\nUndecidable, for exact runs that are hardly disturbed differ by "
                        "0.28 m: can ends within 0.01 m of the exact place\n"));
  EXPECT_THAT(text, testing::ContainsRegex("\n  2. holds  can ends within 1 m of the exact place: "
                                           "[0-9.e-]+ m \\(exact runs differ by [0-9.e-]+ m\\)\n"));
  const json scene = choice_json(choice, "", "out")["scene"];
  ASSERT_EQ(scene["undecidable"].size(), 1U);
  EXPECT_EQ(scene["undecidable"][0]["limit"], 0.01);
  EXPECT_EQ(scene["undecidable"][0]["spread"], 0.28);
  EXPECT_EQ(scene["undecidable"][0]["unit"], " m");
  EXPECT_EQ(scene["needs"][0]["spread"], nullptr);
  EXPECT_GT(scene["needs"][1]["spread"], 0);
}

TEST(ChoiceText, SaysWhenExactContactsDoNotServe) {
  EXPECT_THAT(choice_text(choice_of(elsewhere), "out"), HasSubstr("Not even exact contacts"));
}

TEST(ChoiceText, ShowsOfManyNeedsThoseNearestToTheirLimits) {
  std::string many;
  for (int degrees = 20; degrees > 0; --degrees) {
    many += (many.empty() ? "" : ", ") +
            fmt::format(R"({{"need": "stands", "body": "can", "degrees": {}}})", degrees);
  }
  const std::string text = choice_text(choice_of(many), "out");
  EXPECT_THAT(text, HasSubstr("and 8 more, in choose.html, which take at most "));
  EXPECT_THAT(text, HasSubstr(" 20. holds  can stands within 1°"));
  EXPECT_THAT(text, HasSubstr("\n  9. holds  can stands within 12°"));
  EXPECT_THAT(text, testing::Not(HasSubstr("can stands within 13°")));
  EXPECT_THAT(choice_text(choice_of(stands), "out"), testing::Not(HasSubstr(" more")));
}

TEST(ChoiceText, AndJsonNameTheSameReplayOfAFailure) {
  const Choice choice = choice_of(stands);
  const json data = choice_json(choice, "", "out");
  for (const json& run : data["runs"]) {
    if (run["name"] != "capsule") continue;
    EXPECT_EQ(run["holds"], false);
    EXPECT_THAT(run["evidence"]["replay"].get<std::string>(),
                HasSubstr("./touchstone replay out/can-"));
    return;
  }
  FAIL() << "no run with capsules";
}

TEST(ChoiceText, FitsIntoTheTerminalButForCommandsToPaste) {
  const Choice choice = choice_of(stands);
  for (const std::size_t columns : {std::size_t{40}, std::size_t{80}}) {
    std::istringstream lines(choice_text(choice, "out", columns));
    for (std::string line; std::getline(lines, line);) {
      const bool is_command = line.find("./touchstone") != line.npos;
      const auto letters =
          std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xc0) != 0x80; });
      EXPECT_TRUE(is_command || static_cast<std::size_t>(letters) <= columns) << line;
    }
  }
  EXPECT_THAT(choice_text(choice, "out"),
              HasSubstr("under 2 disturbances, the answer under 10 (seed 1)\n"));
}

/// Of an engine: in a run a can leans by this with some shapes, and by more with the others.
Trajectory leaning(const std::vector<EngineShape>& shapes, const Scene& scene) {
  using Kind = EngineShape::Kind;
  const Kind kind = std::ranges::max_element(shapes, {}, &EngineShape::kind)->kind;
  const double degrees = kind == Kind::exact ? 4 : kind == Kind::box ? 3 : 30;
  Trajectory run;
  run.step = scene.duration;
  run.step_seconds = {1e-5};
  for (const double lean : {0.0, degrees}) {
    run.frames.emplace_back();
    for (const Body& b : scene.bodies) {
      const Eigen::AngleAxisd by(b.fixed ? 0 : lean * std::numbers::pi / 180, Vec3::UnitX());
      run.frames.back().push_back(
          {Pose(b.pose.position(), Eigen::Quaterniond(by)), Vec3::Zero(), Vec3::Zero()});
    }
  }
  return run;
}

// No shape keeps the can within two degrees; a box leaves it nearer than the default, which a user
// would otherwise keep.
TEST(EngineChoiceText, SaysWhatComesNearestWhereNothingHolds) {
  SceneFile file = can_with(stands);
  file.scene.bodies[1].pose = Pose(Vec3(0, 0, 0.2));
  const auto run = [](const std::string&, const std::vector<EngineShape>& shapes,
                      const Scene& scene, bool) { return leaning(shapes, scene); };
  const EngineChoice choice =
      choose_in_engine(file, "ode", {.trials = {.disturbances = 0}, .run = run});
  ASSERT_FALSE(choice.answer);
  const std::string text = engine_choice_text(choice, 200);
  EXPECT_THAT(text,
              HasSubstr("No shape in ode meets all needs, not even with our routines installed. "
                        "box comes nearest, and breaks 1 of 1:\n"
                        "  1. BROKEN can stands within 2°: 3° at 0.80 s\n"
                        "     with cylinder: 30°\n"
                        "     with cylinder + touchstone: 4°\n"));
  EXPECT_THAT(text, HasSubstr("dCreateBox(space, 0.2, 0.2, 0.4)"));
  const json data = engine_choice_json(choice, "");
  EXPECT_EQ(data["answer"], nullptr);
  EXPECT_EQ(data["settings"][data["nearest"].get<std::size_t>()]["name"], "box");
  EXPECT_EQ(data["sizes"][0]["shape"], "box");
}

// What holds the can within four degrees is the box, which ends a degree from where our routines
// do.
TEST(EngineChoiceText, OfTheUnaskedComparesWithOurRoutines) {
  SceneFile file = can_with(R"({"need": "stands", "body": "can", "degrees": 4.5})");
  file.scene.bodies[1].pose = Pose(Vec3(0, 0, 0.2));
  const auto run = [](const std::string&, const std::vector<EngineShape>& shapes,
                      const Scene& scene, bool) { return leaning(shapes, scene); };
  const EngineChoice choice =
      choose_in_engine(file, "ode", {.trials = {.disturbances = 0}, .run = run});
  ASSERT_TRUE(choice.answer);
  const std::string unasked = unasked_text(choice);
  EXPECT_THAT(unasked, testing::StartsWith(
                           "Asked for or not, in all its runs: bodies overlap by up to 0 m (with "
                           "our routines: 0 m); can ends up to 1° from its tilt there"));
  EXPECT_THAT(engine_choice_text(choice, 400), HasSubstr('\n' + unasked + '\n'));
  EXPECT_EQ(engine_choice_json(choice, "")["unasked"], unasked);
}

// Which of several bodies it was has to be said where a need names them all, or none.
TEST(ChoiceText, AndJsonSayWhichBodiesAVerdictIsAbout) {
  Choice choice = choice_of(R"({"need": "penetration", "metres": 0.1})");
  EXPECT_THAT(choice_text(choice, "out", 200),
              testing::ContainsRegex("1. holds  bodies overlap by less than 0.1 m: [0-9.e-]+ m, "
                                     "can and ground\n"));
  choice.runs[0].verdicts[0] = {0.25, 0.1, 0.5, {1, 0}};
  choice.answer = 0;
  choice.impossible = true;
  EXPECT_THAT(
      choice_text(choice, "out", 200),
      HasSubstr("BROKEN bodies overlap by less than 0.1 m: 0.25 m at 0.50 s, can and ground "
                "first\n"));
  const json verdict = choice_json(choice, "", "out")["runs"][0]["verdicts"][0];
  EXPECT_EQ(verdict["bodies"], "can and ground");
}

TEST(ChoiceText, SaysWhereNoModelMeetsAllNeeds) {
  Choice choice = choice_of(stands);
  choice.answer = 0;
  for (SceneRun& run : choice.runs) {
    if (&run != &choice.runs[0]) run.verdicts[0].value = 90;
  }
  EXPECT_THAT(choice_text(choice, "out", 200), HasSubstr("\nExact: no model meets all needs:\n"));
}

PairsChoice pairs_of_file(const char* name) {
  PairNeeds needs;
  needs.count = 20;
  const std::filesystem::path file = std::filesystem::path(TOUCHSTONE_SCENES) / name;
  return choose_for_pairs(read_robot(file), needs, find_candidates({"capsule"}), {});
}

// A can between fingers of STL, beside a column of COLLADA.
TEST(PairsOfAGripper, AreThoseWithItsMeshesToo) {
  const PairsChoice choice = pairs_of_file("can-gripper.urdf");
  std::vector<std::string> names;
  for (const PairChoice& pair : choice.pairs) names.push_back(pair.name);
  EXPECT_THAT(names, testing::UnorderedElementsAre(HasSubstr(" on convex 0.28×0.05×0.4"),
                                                   HasSubstr(" on convex 0.03×0.024×0.08"),
                                                   HasSubstr(" on box ")));
  EXPECT_TRUE(choice.all_served());
}

struct WarehousePairs : testing::Test {
  static PairsChoice choose() { return pairs_of_file("warehouse.sdf"); }
};

// Not the wheel with the tray, which a joint holds, nor the rollers with what is as fixed as they.
TEST_F(WarehousePairs, AreThoseThatCanTouch) {
  const PairsChoice choice = choose();
  for (const PairChoice& pair : choice.pairs) {
    const auto names = [&](const char* part) {
      return pair.example.find(part) != std::string::npos;
    };
    EXPECT_FALSE(names("tyre") && names("deck")) << pair.example;
    EXPECT_FALSE(names("roller") && names("ground")) << pair.example;
  }
}

TEST_F(WarehousePairs, AreServedByTheExactCylinderAndScoredAlikeEachTime) {
  const PairsChoice choice = choose(), again = choose();
  EXPECT_TRUE(choice.all_served());
  const auto errors = [](const PairChoice& pair) {
    std::map<std::string, double> result;
    for (const PairCandidate& c : pair.candidates) result[c.name] = c.score.depth_error;
    return result;
  };
  for (std::size_t i = 0; i < choice.pairs.size(); ++i) {
    EXPECT_LT(errors(choice.pairs[i])["reference"], 1e-12);
    EXPECT_EQ(errors(choice.pairs[i]), errors(again.pairs[i]));
  }
}

TEST_F(WarehousePairs, NameTheConfigurationOfWhatDoesNotServe) {
  const PairsChoice choice = choose();
  const json data = pairs_json(choice, "", "out");
  int failures = 0;
  for (std::size_t i = 0; i < choice.pairs.size(); ++i) {
    for (std::size_t k = 0; k < choice.pairs[i].candidates.size(); ++k) {
      const PairCandidate& c = choice.pairs[i].candidates[k];
      EXPECT_EQ(c.worst.has_value(), !c.serves);
      if (c.serves) continue;
      ++failures;
      EXPECT_EQ(data["pairs"][i]["candidates"][k]["worst"]["file"],
                evidence_file(choice, i, c, "out"));
    }
  }
  EXPECT_GT(failures, 0);
  EXPECT_THAT(pairs_text(choice, "out"), HasSubstr("./touchstone replay out/warehouse-"));
  EXPECT_THAT(pairs_text(choice, "my out"), HasSubstr("./touchstone replay 'my out/warehouse-"));
}

// MuJoCo's masks and exclusions: of four cans only the first two and the last two may touch.
TEST(Pairs, AreNotThoseThatAFileKeepsApart) {
  RobotFile file;
  file.name = "cans";
  const CollisionMask others{2, 2};
  for (int i = 0; i < 4; ++i) {
    const std::string name = fmt::format("can-{}", i);
    const LinkShape can{
        name, Cylinder(0.1 * (i + 1), 0.2), {}, {}, i < 3 ? CollisionMask{} : others};
    file.links.push_back({.name = name, .shapes = {can}});
  }
  file.links[2].shapes[0].mask = {3, 3};
  file.apart = {{2, 1}, {0, 2}};
  PairNeeds needs;
  needs.count = 2;
  std::vector<std::string> names;
  for (const PairChoice& pair :
       choose_for_pairs(file, needs, find_candidates({"capsule"}), {}).pairs) {
    names.push_back(pair.example);
  }
  EXPECT_THAT(names, testing::UnorderedElementsAre("can-0 and can-1", "can-2 and can-3"));
}

}  // namespace
}  // namespace touchstone
