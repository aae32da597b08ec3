// The shapes that stand for cylinders in the engines' own worlds, and the choice among these.
#include "simulation/scenes/engine_choice.hpp"

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>
#include <random>
#include <stdexcept>
#include <sys/mman.h>

#include <nlohmann/json.hpp>

#include "reference/error_of_test.hpp"
#include "reference/invalid_input.hpp"
#include "simulation/each_world.hpp"
#include "simulation/scenes/choose.hpp"
#include "simulation/scenes/exact_motion.hpp"
#include "simulation/scenes/robot_file.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using Kind = EngineShape::Kind;

const Cylinder can(0.05, 0.1);

Body ground() { return {.name = "ground", .shape = Plane(Vec3::UnitZ(), 0), .fixed = true}; }

Body standing_can() { return {.name = "can", .shape = can, .pose = Pose(Vec3(0, 0, 0.1))}; }

class InEngine : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Each, InEngine, testing::ValuesIn(all_engines()), EachWorld::plain_name);

TEST_P(InEngine, WhatStandsForACanHoldsItAtItsOwnHeight) {
  Scene scene;
  scene.duration = 0.4;
  scene.bodies = {ground(), standing_can()};
  const auto height = [&](const EngineShape& shape) {
    const Simulator simulator = in_engine(GetParam(), {.shapes = {{}, shape}});
    return states_of(scene, simulator).back()[1].pose.position().z();
  };
  constexpr double near = 0.002;  // what soft contacts yield, and margins round
  for (const EngineShape shape : {EngineShape{}, {Kind::exact}, {Kind::box}, {Kind::capsule}}) {
    EXPECT_NEAR(height(shape), 0.1, near) << engine_shape_name(shape);
  }
  if (GetParam() != "ode") {
    EXPECT_NEAR(height({Kind::hull, 16}), 0.1, near);
  }
  // Of a single sphere in the middle nothing reaches to the ends: the can sinks to its radius.
  EXPECT_NEAR(height({Kind::spheres, 1}), 0.05, near + 0.006);
}

TEST_P(InEngine, WhatAWorldCannotDoIsRefused) {
  const bool is_mujoco = GetParam() == "mujoco";
  const auto refused = [&](const Scene& scene) {
    return error_text_of([&] { check_engine_scene(GetParam(), scene); });
  };
  Scene loop;
  loop.bodies = {ground(), standing_can()};
  loop.joints = {{.name = "hinge", .kind = JointKind::hinge, .a = 1}};
  EXPECT_EQ(refused(loop), "accepted");
  loop.joints.push_back({.name = "slider", .kind = JointKind::slider, .a = 1, .b = 0});
  Scene belt;
  belt.bodies = {ground(), standing_can()};
  belt.bodies[0].surface_velocity = Vec3(1, 0, 0);
  if (is_mujoco) {
    EXPECT_THAT(refused(loop), HasSubstr("joints[1] is \"slider\""));
    EXPECT_THAT(refused(belt), HasSubstr("no moving surfaces"));
  } else {
    EXPECT_EQ(refused(loop), "accepted");
    EXPECT_EQ(refused(belt), "accepted");
  }
}

TEST_P(InEngine, AGripperGetsAnAnswer) {
  const SceneFile file = read_scene(TOUCHSTONE_SCENES "/gripper.json");
  // With our routines every engine carries the can to the shelf, though ODE's solver lets it rest
  // in some runs alone, the one as written among them, and MuJoCo's soft fingers sink into it.
  const std::size_t disturbances = GetParam() == "ode" ? 5 : 0;
  const EngineChoice choice =
      choose_in_engine(file, GetParam(), {.trials = {.disturbances = disturbances}});
  EXPECT_EQ(choice.default_setting().end, "");
  constexpr std::size_t stands = 0, stays_on_shelf = 1;
  ASSERT_EQ(choice.exact_setting().verdicts.size(), file.needs.size());
  EXPECT_TRUE(choice.exact_setting().verdicts[stands].holds());
  EXPECT_TRUE(choice.exact_setting().verdicts[stays_on_shelf].holds());
  EXPECT_EQ(choice.answer.has_value(), GetParam().starts_with("bullet"));
}

TEST_P(InEngine, HasASceneThatNeedsAnotherShapeThanTheDefault) {
  const bool is_bullet = GetParam().starts_with("bullet");
  const SceneFile file = read_scene(is_bullet ? TOUCHSTONE_SCENES "/rod-on-table.json"
                                              : TOUCHSTONE_SCENES "/three-logs.json");
  const EngineChoice choice = choose_in_engine(file, GetParam(), {.trials = {.disturbances = 1}});
  EXPECT_FALSE(choice.default_setting().holds());
  ASSERT_TRUE(choice.answer);
  EXPECT_NE(*choice.answer, 0U);
  const EngineSetting& answer = choice.settings[*choice.answer];
  EXPECT_TRUE(answer.holds());
  EXPECT_EQ(answer.trials, 6U);  // as written, and five times one
  EXPECT_GT(answer.step_seconds.value(), 0);
  for (const EngineSetting& s : choice.settings) {
    const bool is_own = !s.has(Kind::exact) && s.holds();
    if (!is_own) continue;
    EXPECT_FALSE(answer.has(Kind::exact));
    EXPECT_GE(*s.step_seconds, cheaper_share * cheaper_share * *answer.step_seconds);
  }
}

TEST(EngineChoices, NormalsAreLeftOut) {
  SceneFile file = read_scene(TOUCHSTONE_SCENES "/rod-in-corner.json");
  file.scene.duration = 0.01;
  const EngineChoice choice = choose_in_engine(file, "ode", {.trials = {.disturbances = 0}});
  ASSERT_EQ(choice.left_out.size(), 1U);
  EXPECT_THAT(choice.left_out[0], HasSubstr("normals of rod, floor"));
  EXPECT_EQ(choice.file.needs.size(), file.needs.size() - 1);
}

TEST(EngineChoices, SayThatContactsWithAHullStayTheEngines) {
  SceneFile file = read_scene(TOUCHSTONE_SCENES "/rod-on-table.json");
  EXPECT_EQ(hulls_text("bullet", file.scene), "");
  std::ranges::find(file.scene.bodies, "table", &Body::name)->shape = Convex(
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}}, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}});
  EXPECT_EQ(
      hulls_text("bullet", file.scene),
      "contacts of cylinders with convex bodies, as of rod with table, are bullet's own in all "
      "settings");
  std::ranges::find(file.scene.bodies, "rod", &Body::name)->collides = false;
  EXPECT_EQ(hulls_text("bullet", file.scene), "");
}

TEST(EngineChoices, AnUnknownEngineIsNamed) {
  const SceneFile file = read_scene(TOUCHSTONE_SCENES "/three-logs.json");
  EXPECT_THROW(choose_in_engine(file, "unity", {}), InvalidInput);
}

/// A robot or world with joints that are driven, and an engine that has all it needs.
struct RobotInEngine {
  const char *file, *engine;
  std::vector<std::pair<std::string, double>> rates;
};

/// Settings with other shapes end at once, which spares their runs.
Trajectory with_cylinders_alone(const std::string& engine, const std::vector<EngineShape>& shapes,
                                const Scene& scene, bool with_depths) {
  for (const EngineShape& shape : shapes) {
    if (shape.kind != Kind::cylinder && shape.kind != Kind::exact) {
      throw std::runtime_error("not run");
    }
  }
  return run_in_world(engine, shapes, scene, with_depths);
}

TEST(EngineChoices, AreMadeForRobotsAndWorldsToo) {
  for (const auto& [name, engine, rates] : std::vector<RobotInEngine>{
           {"rover.urdf", "bullet", {{"front_left_wheel_joint", 5}, {"rear_left_wheel_joint", 5}}},
           {"loading-bay.sdf", "ode", {{"cart_1::front_left_wheel_axle", 4}}},
           {"pincer.xml", "mujoco", {{"left", 0.1}, {"right", 0.1}}}}) {
    RobotMotion motion;
    motion.rates = rates;
    motion.duration = 0.1;
    const std::filesystem::path scenes = TOUCHSTONE_SCENES;
    SceneFile file = robot_scene(read_robot(scenes / name), motion);
    add_robot_needs(file, exact_motion_in(engine, file.scene, {1, 1}, 2, file.name));
    const EngineChoice choice = choose_in_engine(
        file, engine, {.workers = 2, .trials = {.disturbances = 0}, .run = with_cylinders_alone});
    EXPECT_EQ(choice.default_setting().end, "") << name;
    EXPECT_EQ(choice.default_setting().verdicts.size(), file.needs.size()) << name;
    EXPECT_GT(choice.default_setting().points, 0) << name;
    EXPECT_EQ(choice.exact_end, "") << name;
    EXPECT_FALSE(choice.sizes.empty()) << name;
  }
}

/// What is made up of an engine: which shape a body stands with, and what a step takes with it.
struct MadeUp {
  std::function<bool(const std::string& body, const EngineShape& shape)> stands;
  std::function<double(const std::vector<EngineShape>& shapes)> seconds =
      [](const std::vector<EngineShape>&) { return 1e-5; };
  bool ends_with_our_routines = false;

  /// Bodies lean by 45° from the start if they do not stand.
  Trajectory operator()(const std::string&, const std::vector<EngineShape>& shapes,
                        const Scene& scene, bool) const {
    Trajectory run;
    run.step = scene.duration;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      if (shapes[i].kind == Kind::exact && ends_with_our_routines) {
        throw std::runtime_error("made-up end");
      }
    }
    for (const double leaning : {0.0, std::numbers::pi / 4}) {
      run.frames.emplace_back();
      for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        const Body& b = scene.bodies[i];
        const bool leans = !b.fixed && shapes[i].kind != Kind::exact && !stands(b.name, shapes[i]);
        const Eigen::Quaterniond lean(Eigen::AngleAxisd(leans ? leaning : 0, Vec3::UnitX()));
        run.frames.back().push_back({Pose(b.pose.position(), b.pose.unit_orientation() * lean),
                                     Vec3::Zero(), Vec3::Zero()});
      }
    }
    run.step_seconds = {seconds(shapes)};
    return run;
  }
};

/// Cylinders of different sizes that have to stand, and this beside.
SceneFile standing(const std::vector<std::string>& names, const std::string& other_need = "") {
  json scene = {{"duration", 1}, {"bodies", json::array()}, {"needs", json::array()}};
  scene["bodies"].push_back(
      {{"name", "ground"},
       {"shape", {{"shape", "plane"}, {"normal", {0, 0, 1}}, {"displacement", 0}}},
       {"fixed", true}});
  double size = 0.1;
  for (const std::string& name : names) {
    scene["bodies"].push_back(
        {{"name", name},
         {"shape", {{"shape", "cylinder"}, {"radius", size}, {"half_length", 2 * size}}},
         {"pose", {{"position", {10 * size, 0, 2 * size}}}}});
    scene["needs"].push_back({{"need", "stands"}, {"body", name}, {"degrees", 5}});
    size *= 2;
  }
  if (!other_need.empty()) scene["needs"].push_back(json::parse(other_need));
  return scene_from_text(scene.dump(), "standing.json");
}

std::vector<std::string> names_of(const EngineChoice& choice) {
  std::vector<std::string> names;
  if (!choice.answer) return names;
  for (const EngineShape& s : choice.settings[*choice.answer].shapes) {
    names.push_back(engine_shape_name(s));
  }
  return names;
}

// No shape serves for all sizes.
TEST(EngineChoices, FindAShapeForEachSize) {
  const std::vector<std::pair<std::string, EngineShape>> serving = {
      {"can", {Kind::capsule}}, {"pot", {Kind::cylinder}}, {"tin", {Kind::spheres, 8}}};
  for (const std::size_t sizes : {std::size_t{2}, std::size_t{3}}) {
    std::vector<std::string> names, expected;
    for (std::size_t i = 0; i < sizes; ++i) {
      names.push_back(serving[i].first);
      expected.push_back(engine_shape_name(serving[i].second));
    }
    const MadeUp engine{.stands = [&](const std::string& body, const EngineShape& shape) {
      return std::ranges::count(serving, std::pair(body, shape)) > 0;
    }};
    const EngineChoice choice = choose_in_engine(
        standing(names), "ode", {.workers = 2, .trials = {.disturbances = 1}, .run = engine});
    EXPECT_EQ(names_of(choice), expected);
  }
}

// Of a can as wide as high the capsule and spheres are one sphere, which is tried once, by that
// name.
TEST(EngineChoices, TryWhatIsOneSphereInAShortCylinderOnce) {
  SceneFile file = standing({"can", "pot"});
  file.scene.bodies[1].shape = Cylinder(0.1, 0.1);
  const MadeUp engine{.stands = [](const std::string&, const EngineShape& shape) {
    return shape.kind == Kind::capsule || shape == EngineShape{Kind::spheres, 1};
  }};
  const EngineChoice choice =
      choose_in_engine(file, "ode", {.trials = {.disturbances = 0}, .run = engine});
  for (const EngineSetting& s : choice.settings) {
    EXPECT_NE(s.shapes[0].kind, Kind::capsule);
    EXPECT_TRUE(s.shapes[0].kind != Kind::spheres || s.shapes[0].count == 1);
  }
  EXPECT_EQ(names_of(choice), (std::vector<std::string>{"spheres:1", "capsule"}));
}

TEST(EngineChoices, EndWhereNoShapeServesForASize) {
  const MadeUp engine{
      .stands = [](const std::string& body, const EngineShape&) { return body != "tin"; }};
  const EngineChoice choice =
      choose_in_engine(standing({"can", "pot", "tin"}), "ode",
                       {.workers = 2, .trials = {.disturbances = 0}, .run = engine});
  ASSERT_TRUE(choice.answer);
  EXPECT_TRUE(choice.settings[*choice.answer].has(Kind::exact));
  EXPECT_LT(choice.settings.size(), 400U);
}

/// Between 0 and 1, another one each time.
double noise() {
  static thread_local std::mt19937 random(std::random_device{}());
  return std::uniform_real_distribution<double>(0, 1)(random);
}

// The default fails, and what the others take differs by less than noise.
TEST(EngineChoices, DoNotDependOnNoise) {
  constexpr double share_of_noise = 0.05;  // half of what a cheaper setting has to save
  const MadeUp engine{
      .stands = [](const std::string&,
                   const EngineShape& shape) { return shape.kind != Kind::cylinder; },
      .seconds =
          [](const std::vector<EngineShape>&) { return 1e-5 * (1 + share_of_noise * noise()); }};
  for (int i = 0; i < 10; ++i) {
    const EngineChoice choice = choose_in_engine(
        standing({"can"}), "ode", {.workers = 2, .trials = {.disturbances = 0}, .run = engine});
    EXPECT_EQ(names_of(choice), std::vector<std::string>{"capsule"});
  }
}

TEST(EngineChoices, TakeWhatIsCheaperByMoreThanNoise) {
  const MadeUp engine{.stands = [](const std::string&, const EngineShape&) { return true; },
                      .seconds =
                          [](const std::vector<EngineShape>& shapes) {
                            const bool has_box =
                                std::ranges::count(shapes, EngineShape{Kind::box}) > 0;
                            return has_box ? 0.8e-5 : 1e-5;
                          }};
  const EngineChoice choice =
      choose_in_engine(standing({"can"}), "ode", {.trials = {.disturbances = 0}, .run = engine});
  EXPECT_EQ(names_of(choice), std::vector<std::string>{"box"});
}

// A machine that becomes twice as fast when the search comes to a box beside a capsule: what was
// timed before is still what takes least.
TEST(EngineChoices, FollowTheSpeedOfTheMachine) {
  void* const shared = mmap(nullptr, sizeof(std::atomic<bool>), PROT_READ | PROT_WRITE,
                            MAP_SHARED | MAP_ANONYMOUS, -1, 0);  // runs are made in processes
  ASSERT_NE(shared, MAP_FAILED);
  auto& is_fast = *new (shared) std::atomic<bool>(false);
  const MadeUp engine{.stands = [](const std::string&, const EngineShape&) { return true; },
                      .seconds =
                          [&](const std::vector<EngineShape>& shapes) {
                            const Kind first = shapes[1].kind, second = shapes[2].kind;
                            if (first == Kind::capsule && second == Kind::box) is_fast = true;
                            const bool is_cheap =
                                first == Kind::capsule && second == Kind::cylinder;
                            return (is_fast ? 1e-5 : 2e-5) * (is_cheap ? 0.8 : 1);
                          }};
  const EngineChoice choice = choose_in_engine(standing({"can", "pot"}), "ode",
                                               {.trials = {.disturbances = 0}, .run = engine});
  EXPECT_TRUE(is_fast);
  EXPECT_EQ(names_of(choice), (std::vector<std::string>{"capsule", "cylinder"}));
  EXPECT_NEAR(*choice.settings[*choice.answer].step_seconds, 0.8e-5, 1e-12);
  EXPECT_NEAR(*choice.default_setting().step_seconds, 1e-5, 1e-12);
  munmap(shared, sizeof(std::atomic<bool>));
}

// Needs that ask how the run with our routines ends have nothing to be compared with.
TEST(EngineChoices, JudgeTheOtherNeedsWhereTheEngineEndsARunWithOurRoutines) {
  const std::string relative = R"({"need": "ends-near", "body": "can", "metres": 0.1})";
  MadeUp engine{.stands = [](const std::string&, const EngineShape&) { return true; },
                .ends_with_our_routines = true};
  const EngineChoiceOptions options{.workers = 2, .trials = {.disturbances = 1}, .run = engine};
  const EngineChoice choice = choose_in_engine(standing({"can"}, relative), "ode", options);
  EXPECT_EQ(choice.exact_end, "made-up end");
  EXPECT_THAT(choice.not_judged, testing::ElementsAre(HasSubstr("can ends within 0.1 m")));
  EXPECT_EQ(choice.file.needs.size(), 1U);
  EXPECT_EQ(names_of(choice), std::vector<std::string>{"cylinder"});
  EXPECT_EQ(choice.exact_setting().end, "made-up end");

  SceneFile relative_alone = standing({"can"}, relative);
  relative_alone.needs.erase(relative_alone.needs.begin());
  try {
    choose_in_engine(relative_alone, "ode", options);
    FAIL() << "was judged";
  } catch (const std::runtime_error& e) {
    EXPECT_THAT(e.what(), HasSubstr("ended a run with our routines (made-up end)"));
  }
  engine.ends_with_our_routines = false;
  EXPECT_TRUE(
      choose_in_engine(relative_alone, "ode", {.trials = {.disturbances = 1}, .run = engine})
          .not_judged.empty());
}

TEST(EngineLines, MakeTheShapeInTheEnginesOwnWords) {
  EXPECT_THAT(engine_lines("bullet", {Kind::no_margin}, can), HasSubstr("setMargin(0)"));
  EXPECT_EQ(engine_lines("bullet", {Kind::capsule}, can),
            "auto* shape = new btCapsuleShapeZ(0.05, 0.1);");
  EXPECT_EQ(engine_lines("ode", {Kind::capsule}, can),
            "dGeomID geom = dCreateCapsule(space, 0.05, 0.1);\ndGeomSetBody(geom, body);");
  EXPECT_EQ(engine_lines("mujoco", {Kind::capsule}, can),
            R"(<geom type="capsule" size="0.05 0.05"/>)");
  EXPECT_THAT(engine_lines("mujoco", {Kind::multipoint}, can), HasSubstr("multiccd"));
}

}  // namespace
}  // namespace touchstone
