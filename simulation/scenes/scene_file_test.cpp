// Scene files, which of them are refused, and their schema.
#include "simulation/scenes/scene_file.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <iterator>
#include <numbers>

#include <nlohmann/json.hpp>

#include "properties/files/disk.hpp"
#include "properties/files/json_schema_test.hpp"
#include "reference/error_of_test.hpp"
#include "reference/invalid_input.hpp"
#include "reference/support.hpp"
#include "simulation/scenes/need.hpp"

namespace touchstone {
namespace {

using nlohmann::json, nlohmann::ordered_json;
using testing::HasSubstr;

const std::filesystem::path scene_folder = TOUCHSTONE_SCENES;

json small_scene() {
  return json::parse(R"({
    "duration": 2,
    "materials": {"steel": {"density": 7800, "friction": 0.3}},
    "bodies": [
      {"name": "ground", "shape": {"shape": "plane", "normal": [0, 0, 1], "displacement": 0},
       "fixed": true},
      {"name": "can", "shape": {"shape": "cylinder", "radius": 0.1, "half_length": 0.2},
       "material": "steel", "pose": {"position": [0, 0, 0.2]}, "velocity": [1, 0, 0]}],
    "needs": [{"need": "stands", "body": "can", "degrees": 0.5, "from": 1}]})");
}

std::string scene_refusal(const json& scene) {
  return error_text_of([&] { scene_from_text(scene.dump(), "spoilt.json"); });
}

/// A place in a scene file (JSON pointer), what is put there (JSON), and what is said of that.
struct Spoilt {
  const char *at, *value, *said;
};
void expect_refusals(const json& scene, const std::vector<Spoilt>& spoilt) {
  for (const auto& [at, value, said] : spoilt) {
    json one = scene;
    one[json::json_pointer(at)] = json::parse(value);
    EXPECT_THAT(scene_refusal(one), HasSubstr(said)) << at << ": " << value;
  }
}

TEST(SceneFile, IsReadAsItIsWritten) {
  const SceneFile file = scene_from_text(small_scene().dump(), "folder/small.json");
  ASSERT_EQ(file.scene.bodies.size(), 2U);
  EXPECT_TRUE(file.scene.bodies[0].fixed);
  const Body& can = file.scene.bodies[1];
  EXPECT_EQ(can.density, 7800);
  EXPECT_EQ(can.material.friction, 0.3);
  EXPECT_EQ(can.velocity, Vec3(1, 0, 0));
  EXPECT_EQ(can.pose.position(), Vec3(0, 0, 0.2));
  EXPECT_EQ(file.scene.duration, 2);
  ASSERT_EQ(file.needs.size(), 1U);
  EXPECT_EQ(file.name, "small");
  EXPECT_EQ(file.needs[0]->bodies, std::vector<int>{1});
  EXPECT_EQ(file.needs[0]->text(file.scene), "can stands within 0.5° from 1 s");
}

TEST(SceneFile, ErrorsNameThePathOfTheField) {
  expect_refusals(
      small_scene(),
      {{"/bodies/1/shape/radius", "-1", "bodies[1].shape.radius is -1"},
       {"/bodies/1/materiel", R"("steel")", "bodies[1].materiel"},
       {"/bodies/1/material", R"("wood")",
        "bodies[1].material is \"wood\": must be one of the materials: steel"},
       {"/bodies/1/velocity", "[1, 2]", "bodies[1].velocity"},
       {"/bodies/1/fixed", "1", "bodies[1].fixed is 1"},
       {"/bodies/1/name", R"("ground")", "bodies[1].name"},
       {"/bodies/1/pose/orientation", "[0, 0, 0, 0]", "bodies[1].pose.orientation"},
       {"/bodies", "3", "bodies is 3"},
       {"/materials/steel/restitution", "2",
        "materials.steel.restitution is 2: must lie between 0 and 1"},
       {"/materials/steel/friction", "-1", "steel.friction is -1: must lie between 0 and 1e+06"},
       // By the member that is in the file, not by that of the body which gets it.
       {"/materials/steel/density", "0",
        "materials.steel.density is 0: must lie between 1e-06 and 1e+09"},
       {"/step", "1e-6", "a million steps"},
       {"/camera", R"({"position": [0, 0, 0], "look_at": [0, 0, 0]})", "camera.position"},
       {"/gravitation", "1", "gravitation"}});
  json endless = small_scene();
  endless.erase("duration");
  EXPECT_THAT(scene_refusal(endless), HasSubstr("duration is missing"));
}

TEST(SceneFile, GivesABodyItsInertia) {
  const json inertia = json::parse(R"({"mass": 3, "moments": [0.1, 0.2, 0.25],
    "pose": {"position": [0, 0, -0.15], "orientation": [0, 1, 0, 0]}})");
  json scene = small_scene();
  scene["bodies"][1]["inertia"] = inertia;
  const PosedInertia read =
      scene_from_text(scene.dump(), "small.json").scene.bodies[1].inertia.value();
  EXPECT_EQ(read.inertia.mass, 3);
  EXPECT_EQ(read.inertia.principal, Vec3(0.1, 0.2, 0.25));
  EXPECT_EQ(read.X_BC.position(), Vec3(0, 0, -0.15));
  EXPECT_EQ(read.X_BC.orientation().x(), 1);
  expect_refusals(
      scene, {{"/bodies/1/inertia/mass", R"("heavy")", "bodies[1].inertia.mass is \"heavy\""},
              {"/bodies/1/inertia/mass", "0", "bodies[1].inertia.mass is 0: must lie between"},
              {"/bodies/1/inertia/moments", "[1, 1, 3]", "bodies[1].inertia.moments is [1, 1, 3]"},
              {"/bodies/1/inertia/moments", "1", "bodies[1].inertia.moments is 1"},
              {"/bodies/1/inertia/centre", "[0, 0, 0]", "bodies[1].inertia.centre"},
              {"/bodies/1/inertia", "{}", "bodies[1].inertia.mass is missing"}});
}

TEST(SceneFile, WithMoreBodiesThanCanBeHeldAgainstEachOtherIsRefused) {
  json scene = small_scene();
  for (int i = 0; i < 1000; ++i) {
    scene["bodies"].push_back(scene["bodies"][1]);
    scene["bodies"].back()["name"] = std::to_string(i);
  }
  EXPECT_THAT(scene_refusal(scene), HasSubstr("bodies is 1002 bodies"));
}

TEST(SceneFile, ErrorsOfNeedsNameThePathOfTheField) {
  expect_refusals(
      small_scene(),
      {{"/needs/0", R"({"need": "flies"})",
        "needs[0].need is \"flies\": must be one of ends-near, ends-tilted"},
       {"/needs/0", R"({"need": "stands", "body": "pot", "degrees": 1})",
        "needs[0].body is \"pot\""},
       {"/needs/0", R"({"need": "stands", "body": "can", "degrees": -1})",
        "needs[0].degrees is -1"},
       {"/needs/0", R"({"need": "rests", "speed": 1, "by": 9})",
        "needs[0].by is 9: must lie within the scene's duration"},
       {"/needs/0", R"({"need": "normals", "bodies": ["can"], "degrees": 9})", "needs[0].bodies"},
       {"/needs/0", R"({"need": "ends-near", "body": "can", "metres": 1e9})",
        "needs[0].metres is 1000000000.0: must be a number from 0 to 1e+06"},
       {"/needs/0", R"({"need": "falls-in-order", "bodies": ["can", "can"]})",
        "needs[0].bodies is [\"can\",\"can\"]: must be bodies that differ"},
       {"/needs/0", R"({"need": "rolls", "body": "can", "distance": 0, "share": 1})",
        "needs[0].distance is 0"},
       {"/needs/0",
        R"({"need": "stays-in", "body": "can", "lower": [0, 0, 1], "upper": [1, 1, 0]})",
        "needs[0].upper"}});
}

TEST(SceneFile, RefusesNeedsThatWouldHoldOrBreakWhateverMoves) {
  const char* const of_ground = "must be moved by forces: ground is fixed";
  expect_refusals(
      small_scene(),
      {{"/needs/0", R"({"need": "stands", "body": "can", "degrees": 1, "from": 1, "until": 0.5})",
        "needs[0].until is 0.5: must not lie before from, which is 1"},
       {"/needs/0", R"({"need": "penetration", "bodies": ["can", "can"], "metres": 1})",
        "needs[0].bodies is [\"can\",\"can\"]: must be bodies that differ"},
       {"/needs/0", R"({"need": "stands", "body": "ground", "degrees": 1})", of_ground},
       {"/needs/0", R"({"need": "rolls", "body": "ground", "share": 0.1})", of_ground},
       {"/needs/0", R"({"need": "rests", "bodies": ["can", "ground"], "speed": 1})", of_ground},
       {"/needs/0", R"({"need": "ends-near", "body": "ground", "metres": 1})", of_ground},
       {"/needs/0", R"({"need": "ends-tilted", "body": "ground", "degrees": 1})", of_ground},
       {"/needs/0", R"({"need": "falls-in-order", "bodies": ["ground"]})", of_ground}});
}

json gripper_scene() {
  return json::parse(R"({
    "duration": 2,
    "bodies": [
      {"name": "hand", "shape": {"shape": "box", "half_extents": [0.1, 0.1, 0.1]},
       "drive": {"waypoints": [{"time": 1, "pose": {"position": [0, 0, 1]}},
                                {"time": 1.5, "pose": {"position": [1, 0, 1]}}]}},
      {"name": "finger", "shape": {"shape": "box", "half_extents": [0.01, 0.02, 0.05]},
       "pose": {"position": [0, 0, -0.2]}},
      {"name": "belt", "shape": {"shape": "plane", "normal": [0, 0, 1], "displacement": -1},
       "fixed": true, "surface_velocity": [0.5, 0, 0]},
      {"name": "shaker", "shape": {"shape": "box", "half_extents": [0.1, 0.1, 0.1]},
       "pose": {"position": [5, 0, 0]}, "collides": false,
       "drive": {"oscillation": {"amplitude": [0.1, 0, 0], "turn": [0, 0, 90], "frequency": 3}}},
      {"name": "drum", "shape": {"shape": "cylinder", "radius": 0.1, "half_length": 0.2},
       "pose": {"position": [-5, 0, 0]}, "drive": {"angular_velocity": [0, 0, 2]}}],
    "drops": [{"name": "rod", "shape": {"shape": "cylinder", "radius": 0.01, "half_length": 0.05},
               "count": 20, "seed": 3, "lower": [-0.3, -0.3, 0.3], "upper": [0.3, 0.3, 0.9]}],
    "joints": [
      {"joint": "slider", "name": "squeeze", "bodies": ["finger", "hand"], "axis": [0, 3, 0],
       "limits": [-0.01, 0.02], "motor": {"position": [[0, 0], [1, 0.02]], "max_force": 5}},
      {"joint": "hinge", "bodies": ["rod-1"], "anchor": [0, 0, 1], "axis": [0, 0, -2],
       "limits": [-90, 180], "motor": {"rate": 4, "max_force": 1}},
      {"joint": "fixed", "bodies": ["rod-2", "rod-3"]}],
    "pushes": [{"body": "rod-4", "force": [1, 0, 0], "torque": [0, 0, 2], "from": 0.5, "until": 1}]
    })");
}

TEST(SceneFile, HoldsWhatMovesItsBodies) {
  const Scene scene = scene_from_text(gripper_scene().dump(), "gripper.json").scene;
  ASSERT_EQ(scene.bodies.size(), 25U);
  const auto& waypoints = std::get<Waypoints>(*scene.bodies[0].drive);
  ASSERT_EQ(waypoints.size(), 2U);
  EXPECT_EQ(waypoints[1].time, 1.5);
  EXPECT_EQ(waypoints[1].pose.position(), Vec3(1, 0, 1));
  EXPECT_EQ(scene.bodies[2].surface_velocity, Vec3(0.5, 0, 0));
  const auto& shaker = std::get<Oscillation>(*scene.bodies[3].drive);
  EXPECT_FALSE(scene.bodies[3].collides);
  EXPECT_NEAR(shaker.turn.z(), std::numbers::pi / 2, 1e-15);
  EXPECT_EQ(shaker.amplitude.x(), 0.1);
  EXPECT_EQ(shaker.frequency, 3);
  EXPECT_EQ(std::get<SteadyMotion>(*scene.bodies[4].drive).angular_velocity, Vec3(0, 0, 2));
  ASSERT_EQ(scene.joints.size(), 3U);
  const Joint &slider = scene.joints[0], &hinge = scene.joints[1], &rigid = scene.joints[2];
  EXPECT_EQ(slider.kind, JointKind::slider);
  EXPECT_EQ(slider.name, "squeeze");
  EXPECT_EQ(slider.a, 1);
  EXPECT_EQ(slider.b, 0);
  EXPECT_EQ(slider.axis, Vec3(0, 1, 0));
  EXPECT_EQ(slider.upper, 0.02);
  EXPECT_EQ(slider.motor->target, Motor::Target::position);
  EXPECT_EQ(slider.motor->target_at(0.5), 0.01);
  EXPECT_EQ(hinge.b, world_body);
  EXPECT_EQ(hinge.anchor, Vec3(0, 0, 1));
  EXPECT_NEAR(hinge.lower, -std::numbers::pi / 2, 1e-15);
  EXPECT_EQ(hinge.motor->target_at(7), 4);
  EXPECT_EQ(rigid.kind, JointKind::fixed);
  EXPECT_EQ(scene.pushes[0].body, 8);
  EXPECT_EQ(scene.pushes[0].torque, Vec3(0, 0, 2));
  EXPECT_EQ(scene.pushes[0].until, 1);
}

TEST(SceneFile, DropsItsBodiesApartWithinTheirBoxBySeed) {
  json file = gripper_scene();
  const auto poses = [&] {
    std::vector<Body> rods = scene_from_text(file.dump(), "drop.json").scene.bodies;
    rods.erase(rods.begin(), rods.begin() + 5);
    return rods;
  };
  const std::vector<Body> rods = poses();
  EXPECT_EQ(rods.front().name, "rod-1");
  EXPECT_EQ(rods.back().name, "rod-20");
  for (std::size_t i = 0; i < rods.size(); ++i) {
    const Aabb box = aabb(rods[i].shape, rods[i].pose);
    EXPECT_GE((box.lower - Vec3(-0.3, -0.3, 0.3)).minCoeff(), 0);
    EXPECT_LE((box.upper - Vec3(0.3, 0.3, 0.9)).maxCoeff(), 0);
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_FALSE(box.overlaps(aabb(rods[j].shape, rods[j].pose)));
    }
  }
  EXPECT_EQ(poses()[7].pose.position(), rods[7].pose.position());
  file["drops"][0]["seed"] = 4;
  EXPECT_NE(poses()[7].pose.position(), rods[7].pose.position());
}

TEST(SceneFile, DropsNothingBelowAPlane) {
  json file = gripper_scene();
  json& tilted = file["bodies"][2];
  tilted["shape"] = {{"shape", "plane"}, {"normal", {0, 3, 4}}, {"displacement", 0.5}};
  tilted["pose"] = {{"position", {0, 0, 0.5}}};
  file["drops"][0]["count"] = 10;
  const Scene scene = scene_from_text(file.dump(), "drop.json").scene;
  const Vec3 normal(0, 0.6, 0.8);
  for (std::size_t i = 5; i < scene.bodies.size(); ++i) {
    const Body& rod = scene.bodies[i];
    EXPECT_GE(-support(rod.shape, rod.pose, -normal), 0.1 + 0.8 * 0.5) << rod.name;
  }
  tilted["pose"] = {{"position", {0, 0, 2}}};
  EXPECT_THAT([&] { scene_from_text(file.dump(), "drop.json"); },
              testing::ThrowsMessage<InvalidInput>(HasSubstr("the box has room for 0")));
}

TEST(SceneFile, ErrorsOfWhatMovesItsBodiesNameThePathOfTheField) {
  expect_refusals(
      gripper_scene(),
      {{"/needs", R"([{"need": "penetration", "bodies": ["hand", "finger"], "metres": 1}])",
        "needs[0].bodies is [\"hand\",\"finger\"]: one of them must be a cylinder"},
       {"/bodies/0/velocity", "[1, 0, 0]",
        "bodies[0].velocity is not zero: must be zero, for the body is driven"},
       {"/bodies/2/velocity", "[1, 0, 0]",
        "bodies[2].velocity is not zero: must be zero, for the body is fixed"},
       {"/bodies/0/fixed", "true", "bodies[0].fixed"},
       {"/bodies/0/drive", "{}", "bodies[0].drive is {}: must have one of"},
       {"/bodies/0/drive/velocity", "[1, 0, 0]", "must have one of"},
       {"/bodies/0/drive/waypoints", "[]", "bodies[0].drive.waypoints is empty"},
       {"/bodies/0/drive/waypoints/1/time", "0.5",
        "bodies[0].drive.waypoints[1].time is 0.5: must be later than 1"},
       {"/bodies/3/drive/oscillation/frequency", "-1", "frequency is -1: must lie between 0 and"},
       {"/bodies/2/surface_velocity", "[1, 2]", "bodies[2].surface_velocity"},
       {"/bodies/3/collides", "1", "bodies[3].collides is 1"},
       {"/joints/0/joint", R"("ball")",
        "joints[0].joint is \"ball\": must be \"fixed\", \"hinge\" or"},
       {"/joints/0/bodies", R"(["finger", "thumb"])",
        "joints[0].bodies[1] is \"thumb\": must be the name of one"},
       {"/joints/0/bodies", R"(["hand", "hand"])", "joints[0] is one body"},
       {"/joints/0/bodies", "[]", "joints[0].bodies is []"},
       {"/joints/0/axis", "[0, 0, 0]", "must have a direction"},
       {"/joints/0/anchor", "[0, 0, 0]", "a slider has none"},
       {"/joints/0/limits", "[0.01, 0.02]", "must hold 0"},
       {"/joints/1/limits", "[-90, 270]", "accepted"},
       {"/joints/1/limits", "[-90, 1e9]", "joints[1].upper is"},
       {"/joints/0/motor/rate", "1", "must have either a rate or a position"},
       {"/joints/0/motor/max_force", "-1", "motor.max_force is -1"},
       {"/joints/0/motor/position", "[]", "joints[0].motor is without a target"},
       {"/joints/0/motor/position/1", "[-1, 0]", "joints[0].motor: time"},
       {"/joints/2/axis", "[0, 0, 1]", "joints[2].axis"},
       {"/joints/2/bodies", R"(["rod-2", "belt"])", "accepted"},
       {"/joints/2/bodies", R"(["drum", "hand"])",
        "bodies[4].drive is given: must not be: fixed joints make drum one with"},
       {"/joints/2/bodies", R"(["drum", "belt"])", "what is fixed"},
       {"/pushes/0/until", "0.25", "pushes[0].until is 0.25"},
       {"/pushes/0/force", "[1e13, 0, 0]", "pushes[0].force[0]"},
       {"/pushes/0/body", R"("nobody")", "pushes[0].body is \"nobody\""},
       {"/drops/0/upper", "[-0.2, -0.2, 0.4]", "drops[0].count is 20: the box has room for"},
       {"/drops/0/upper", "[0.3, 0.3, 0.3]", "drops[0].upper"},
       {"/drops/0/count", "-1", "drops[0].count is -1"},
       {"/bodies/3/name", R"("rod-7")", "bodies[11].name is \"rod-7\""},
       {"/drops/0/pose", "{}", "drops[0].pose"}});
}

TEST(SceneFile, AnglesOfNeedsAreSmallerThanTheLargestThereIs) {
  const char* const of_turns = "needs[0].degrees is 180: must be less than 180";
  expect_refusals(
      small_scene(),
      {{"/needs/0", R"({"need": "stands", "body": "can", "degrees": 90})",
        "needs[0].degrees is 90: must be less than 90"},
       {"/needs/0", R"({"need": "stands", "body": "can", "degrees": 89.9})", "accepted"},
       {"/needs/0", R"({"need": "falls-in-order", "bodies": ["can"], "degrees": 180})", of_turns},
       {"/needs/0", R"({"need": "normals", "bodies": ["can", "ground"], "degrees": 180})",
        of_turns},
       {"/needs/0", R"({"need": "ends-tilted", "body": "can", "degrees": 180})", of_turns}});
}

TEST(SceneFile, NeedsOfContactsAreOfWhatMayTouchBeforeTheEnd) {
  const auto with = [](const json& need, bool is_joined) {
    json scene = small_scene();
    scene["bodies"].push_back(scene["bodies"][1]);
    scene["bodies"][2]["name"] = "lid";
    if (is_joined) {
      scene["joints"] = {{{"joint", "hinge"},
                          {"bodies", {"lid", "can"}},
                          {"anchor", {0, 0, 0}},
                          {"axis", {0, 0, 1}}}};
    }
    scene["needs"][0] = need;
    return scene_refusal(scene);
  };
  const json depth = {{"need", "penetration"}, {"bodies", {"can", "lid"}}, {"metres", 1e-3}};
  const json angle = {{"need", "normals"}, {"bodies", {"can", "lid"}}, {"degrees", 1}};
  for (const json& need : {depth, angle}) {
    EXPECT_EQ(with(need, false), "accepted");
    EXPECT_THAT(with(need, true),
                HasSubstr("needs[0].bodies is can and lid: must be able to touch"));
  }
  json late = depth;
  late["from"] = 2;
  EXPECT_THAT(with(late, false),
              HasSubstr("needs[0].from is 2: must be at least a step before the end"));
  late["from"] = 2 - 1.0 / 240;
  EXPECT_EQ(with(late, false), "accepted");
}

TEST(SceneFile, ADriveDoesNotTurnByHalfATurnBetweenTwoWaypoints) {
  const char* const turn = "/bodies/0/drive/waypoints/0/pose/orientation";
  expect_refusals(
      gripper_scene(),
      {{turn, "[0, 0, 0, 1]", "bodies[0].drive.waypoints[0].pose.orientation is half a turn from"},
       {turn, "[0.01, 0, 0, 1]", "accepted"}});
}

TEST(SceneFile, ADropOfTooManyBodiesIsRefusedBeforeTheyAreDrawn) {
  json scene = gripper_scene();
  scene["drops"][0]["count"] = 999;
  EXPECT_THAT([&] { scene_from_text(scene.dump(), "drop.json"); },
              testing::ThrowsMessage<InvalidInput>(
                  HasSubstr("drops[0].count is 999: must be less: a scene has at most 1000")));
}

TEST(SceneFile, ThatIsXmlIsRefusedWithTheEndingsOfRobots) {
  for (const char* text : {"<?xml version=\"1.0\"?><robot/>", "\xef\xbb\xbf <sdf/>"}) {
    EXPECT_THAT([&] { scene_from_text(text, "G.URDF"); },
                testing::ThrowsMessage<InvalidInput>(HasSubstr("must end in .urdf")));
  }
}

TEST(SceneFile, IsAtLeastAStepLong) {
  json scene = small_scene();
  scene["needs"] = json::array();
  expect_refusals(scene, {{"/duration", "0.0", "duration is 0.0: must be at least one step"},
                          {"/duration", "0.001", "duration is 0.001: must be at least one step"},
                          {"/duration", "-1", "duration is -1"}});
  scene["step"] = 0.5;
  expect_refusals(scene, {{"/duration", "0.25", "duration is 0.25: must be at least one step"}});
}

TEST(SceneFile, NamesAreWithoutControlCharacters) {
  const char* const name = "/bodies/1/name";
  expect_refusals(small_scene(), {{name, R"("can\n")", "bodies[1].name is "},
                                  {name, R"("\u001b[2J")", "bodies[1].name is "},
                                  {name, R"("\u009b2J")", "bodies[1].name is "},
                                  {name, R"("")", "must have a letter"},
                                  {name, R"(" ")", "must have a letter"}});
  // A file's name may be of any bytes; what is shown of it is text.
  EXPECT_EQ(scene_from_text(small_scene().dump(), "caf\xe9\n.json").name, "caf? ");
}

TEST(SceneFile, ThatIsNoneIsRefused) {
  EXPECT_THROW(read_scene("/nowhere/scene.json"), InvalidInput);
  EXPECT_THROW(read_scene("/etc"), InvalidInput);
  EXPECT_THROW(read_scene("/etc/passwd"), InvalidInput);
  EXPECT_THROW(read_scene(std::string(10000, 'x')), InvalidInput);
}

TEST(SceneFile, ShippedScenesAreReadAndSayWhatTheyNeed) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(scene_folder)) {
    if (entry.path().extension() != ".json") continue;
    SCOPED_TRACE(entry.path());
    const SceneFile file = read_scene(entry.path());
    EXPECT_FALSE(file.needs.empty());
    EXPECT_FALSE(file.description.empty());
    ++count;
  }
  EXPECT_EQ(count, 15);
}

// TOUCHSTONE_WRITE_SCHEMA=1 writes the file.
TEST(SceneSchema, DescribesTheNeedsThatAreRead) {
  const std::filesystem::path file = std::filesystem::path(TOUCHSTONE_DOCS) / "scene-schema.json";
  const std::string found = read_file(file, "file"),
                    expected = schema_text(ordered_json::parse(schema_with_needs(found)));
  if (std::getenv("TOUCHSTONE_WRITE_SCHEMA")) std::ofstream(file) << expected;
  EXPECT_EQ(read_file(file, "file"), expected);
}

TEST(SceneSchema, AndTheDocsHaveARowForEachNeed) {
  const std::string docs = read_file(std::filesystem::path(TOUCHSTONE_DOCS) / "scenes.md", "file");
  for (const auto& need : all_needs()) {
    EXPECT_THAT(docs, HasSubstr(std::string("\n| `") + need->name + "` |"));
  }
}

}  // namespace
}  // namespace touchstone
