// Scene files, which of them are refused, and their schema.
#include "simulation/scenes/scene_file.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <iterator>
#include <numbers>

#include <nlohmann/json.hpp>

#include "reference/invalid_input.hpp"
#include "reference/support.hpp"
#include "simulation/scenes/need.hpp"
#include "simulation/scenes/scene_file.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const std::filesystem::path scene_folder = TOUCHSTONE_SCENES;

std::string contents(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

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

template <class Spoil>
std::string refusal_of_spoilt(Spoil spoil) {
  json scene = small_scene();
  spoil(scene);
  try {
    scene_from_text(scene.dump(), "small.json");
  } catch (const InvalidInput& e) {
    return e.what();
  }
  return "accepted";
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
  const auto on_can = [](const char* field, const json& value) {
    return [=](json& s) { s["bodies"][1][field] = value; };
  };
  EXPECT_THAT(refusal_of_spoilt([](json& s) { s["bodies"][1]["shape"]["radius"] = -1; }),
              HasSubstr("bodies[1].shape.radius is -1"));
  EXPECT_THAT(refusal_of_spoilt(on_can("materiel", "steel")), HasSubstr("bodies[1].materiel"));
  EXPECT_THAT(refusal_of_spoilt(on_can("material", "wood")),
              HasSubstr("bodies[1].material is \"wood\": must be one of the materials: steel"));
  EXPECT_THAT(refusal_of_spoilt(on_can("velocity", {1, 2})), HasSubstr("bodies[1].velocity"));
  EXPECT_THAT(refusal_of_spoilt(on_can("fixed", 1)), HasSubstr("bodies[1].fixed is 1"));
  EXPECT_THAT(refusal_of_spoilt(on_can("name", "ground")), HasSubstr("bodies[1].name"));
  EXPECT_THAT(refusal_of_spoilt([](json& s) {
                s["bodies"][1]["pose"]["orientation"] = {0, 0, 0, 0};
              }),
              HasSubstr("bodies[1].pose.orientation"));
  EXPECT_THAT(refusal_of_spoilt([](json& s) { s["bodies"] = 3; }), HasSubstr("bodies is 3"));
  EXPECT_THAT(refusal_of_spoilt([](json& s) { s["materials"]["steel"]["restitution"] = 2; }),
              HasSubstr("materials.steel.restitution is 2: must lie between 0 and 1"));
  EXPECT_THAT(refusal_of_spoilt([](json& s) { s["materials"]["steel"]["friction"] = -1; }),
              HasSubstr("steel.friction is -1: must lie between 0 and 1e+06"));
  // By the member that is in the file, not by that of the body which gets it.
  EXPECT_THAT(refusal_of_spoilt([](json& s) { s["materials"]["steel"]["density"] = 0; }),
              HasSubstr("materials.steel.density is 0: must lie between 1e-06 and 1e+09"));
  EXPECT_THAT(refusal_of_spoilt([](json& s) { s.erase("duration"); }),
              HasSubstr("duration is missing"));
  EXPECT_THAT(refusal_of_spoilt([](json& s) { s["step"] = 1e-6; }), HasSubstr("a million steps"));
  EXPECT_THAT(refusal_of_spoilt([](json& s) {
                s["camera"] = {{"position", {0, 0, 0}}, {"look_at", {0, 0, 0}}};
              }),
              HasSubstr("camera.position"));
  EXPECT_THAT(refusal_of_spoilt([](json& s) { s["gravitation"] = 1; }), HasSubstr("gravitation"));
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
  const auto with = [&](const char* field, const json& value) {
    return refusal_of_spoilt([&](json& s) {
      s["bodies"][1]["inertia"] = inertia;
      s["bodies"][1]["inertia"][field] = value;
    });
  };
  EXPECT_THAT(with("mass", "heavy"), HasSubstr("bodies[1].inertia.mass is \"heavy\""));
  EXPECT_THAT(with("mass", 0), HasSubstr("bodies[1].inertia.mass is 0: must lie between"));
  EXPECT_THAT(with("moments", {1, 1, 3}), HasSubstr("bodies[1].inertia.moments is [1, 1, 3]"));
  EXPECT_THAT(with("moments", 1), HasSubstr("bodies[1].inertia.moments is 1"));
  EXPECT_THAT(with("centre", {0, 0, 0}), HasSubstr("bodies[1].inertia.centre"));
  EXPECT_THAT(refusal_of_spoilt([](json& s) { s["bodies"][1]["inertia"] = json::object(); }),
              HasSubstr("bodies[1].inertia.mass is missing"));
}

TEST(SceneFile, WithMoreBodiesThanCanBeHeldAgainstEachOtherIsRefused) {
  EXPECT_THAT(refusal_of_spoilt([](json& s) {
                for (int i = 0; i < 1000; ++i) {
                  s["bodies"].push_back(s["bodies"][1]);
                  s["bodies"].back()["name"] = std::to_string(i);
                }
              }),
              HasSubstr("bodies is 1002 bodies"));
}

TEST(SceneFile, ErrorsOfNeedsNameThePathOfTheField) {
  const auto need = [](const json& value) { return [=](json& s) { s["needs"][0] = value; }; };
  EXPECT_THAT(refusal_of_spoilt(need({{"need", "flies"}})),
              HasSubstr("needs[0].need is \"flies\": must be one of ends-near, ends-tilted"));
  EXPECT_THAT(refusal_of_spoilt(need({{"need", "stands"}, {"body", "pot"}, {"degrees", 1}})),
              HasSubstr("needs[0].body is \"pot\""));
  EXPECT_THAT(refusal_of_spoilt(need({{"need", "stands"}, {"body", "can"}, {"degrees", -1}})),
              HasSubstr("needs[0].degrees is -1"));
  EXPECT_THAT(refusal_of_spoilt(need({{"need", "rests"}, {"speed", 1}, {"by", 9}})),
              HasSubstr("needs[0].by is 9: must lie within the scene's duration"));
  EXPECT_THAT(refusal_of_spoilt(need({{"need", "normals"}, {"bodies", {"can"}}, {"degrees", 9}})),
              HasSubstr("needs[0].bodies"));
  EXPECT_THAT(refusal_of_spoilt(
                  need({{"need", "penetration"}, {"bodies", {"ground", "ground"}}, {"metres", 1}})),
              HasSubstr("needs[0].bodies is [\"ground\",\"ground\"]: one of them"));
  EXPECT_THAT(
      refusal_of_spoilt(need({{"need", "rolls"}, {"body", "can"}, {"distance", 0}, {"share", 1}})),
      HasSubstr("needs[0].distance is 0"));
  EXPECT_THAT(
      refusal_of_spoilt(need(
          {{"need", "stays-in"}, {"body", "can"}, {"lower", {0, 0, 1}}, {"upper", {1, 1, 0}}})),
      HasSubstr("needs[0].upper"));
}

TEST(SceneFile, RefusesNeedsThatWouldHoldOrBreakWhateverMoves) {
  const auto need = [](const json& value) { return [=](json& s) { s["needs"][0] = value; }; };
  EXPECT_THAT(
      refusal_of_spoilt(
          need({{"need", "stands"}, {"body", "can"}, {"degrees", 1}, {"from", 1}, {"until", 0.5}})),
      HasSubstr("needs[0].until is 0.5: must not lie before from, which is 1"));
  EXPECT_THAT(
      refusal_of_spoilt(need({{"need", "penetration"}, {"bodies", {"can", "can"}}, {"metres", 1}})),
      HasSubstr("needs[0].bodies is [\"can\",\"can\"]: must be two bodies"));
  for (const json& of_ground :
       {json{{"need", "stands"}, {"body", "ground"}, {"degrees", 1}},
        json{{"need", "rolls"}, {"body", "ground"}, {"share", 0.1}},
        json{{"need", "rests"}, {"bodies", {"can", "ground"}}, {"speed", 1}},
        json{{"need", "ends-near"}, {"body", "ground"}, {"metres", 1}},
        json{{"need", "ends-tilted"}, {"body", "ground"}, {"degrees", 1}},
        json{{"need", "falls-in-order"}, {"bodies", {"ground"}}}}) {
    EXPECT_THAT(refusal_of_spoilt(need(of_ground)),
                HasSubstr("must be moved by forces: ground is fixed"))
        << of_ground;
  }
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
  const auto refusal_at = [](const char* pointer, const json& value) {
    json scene = gripper_scene();
    scene[json::json_pointer(pointer)] = value;
    try {
      scene_from_text(scene.dump(), "gripper.json");
    } catch (const InvalidInput& e) {
      return std::string(e.what());
    }
    return std::string("accepted");
  };
  EXPECT_THAT(refusal_at("/bodies/0/velocity", {1, 0, 0}),
              HasSubstr("bodies[0].velocity is not zero: must be zero, for the body is driven"));
  EXPECT_THAT(refusal_at("/bodies/2/velocity", {1, 0, 0}),
              HasSubstr("bodies[2].velocity is not zero: must be zero, for the body is fixed"));
  EXPECT_THAT(refusal_at("/bodies/0/fixed", true), HasSubstr("bodies[0].fixed"));
  EXPECT_THAT(refusal_at("/bodies/0/drive", json::object()),
              HasSubstr("bodies[0].drive is {}: must have one of"));
  EXPECT_THAT(refusal_at("/bodies/0/drive/velocity", {1, 0, 0}), HasSubstr("must have one of"));
  EXPECT_THAT(refusal_at("/bodies/0/drive/waypoints", json::array()),
              HasSubstr("bodies[0].drive.waypoints is empty"));
  EXPECT_THAT(refusal_at("/bodies/0/drive/waypoints/1/time", 0.5),
              HasSubstr("bodies[0].drive.waypoints[1].time is 0.5: must be later than 1"));
  EXPECT_THAT(refusal_at("/bodies/3/drive/oscillation/frequency", -1),
              HasSubstr("frequency is -1: must lie between 0 and"));
  EXPECT_THAT(refusal_at("/bodies/2/surface_velocity", {1, 2}),
              HasSubstr("bodies[2].surface_velocity"));
  EXPECT_THAT(refusal_at("/bodies/3/collides", 1), HasSubstr("bodies[3].collides is 1"));
  EXPECT_THAT(refusal_at("/joints/0/joint", "ball"),
              HasSubstr("joints[0].joint is \"ball\": must be \"fixed\", \"hinge\" or"));
  EXPECT_THAT(refusal_at("/joints/0/bodies", {"finger", "thumb"}),
              HasSubstr("joints[0].bodies[1] is \"thumb\": must be the name of one"));
  EXPECT_THAT(refusal_at("/joints/0/bodies", {"hand", "hand"}), HasSubstr("joints[0] is one body"));
  EXPECT_THAT(refusal_at("/joints/0/bodies", json::array()), HasSubstr("joints[0].bodies is []"));
  EXPECT_THAT(refusal_at("/joints/0/axis", {0, 0, 0}), HasSubstr("must have a direction"));
  EXPECT_THAT(refusal_at("/joints/0/anchor", {0, 0, 0}), HasSubstr("a slider has none"));
  EXPECT_THAT(refusal_at("/joints/0/limits", {0.01, 0.02}), HasSubstr("must hold 0"));
  EXPECT_THAT(refusal_at("/joints/1/limits", {-90, 270}), HasSubstr("accepted"));
  EXPECT_THAT(refusal_at("/joints/1/limits", {-90, 1e9}), HasSubstr("joints[1].upper is"));
  EXPECT_THAT(refusal_at("/joints/0/motor/rate", 1),
              HasSubstr("must have either a rate or a position"));
  EXPECT_THAT(refusal_at("/joints/0/motor/max_force", -1), HasSubstr("motor.max_force is -1"));
  EXPECT_THAT(refusal_at("/joints/0/motor/position", json::array()),
              HasSubstr("joints[0].motor is without a target"));
  EXPECT_THAT(refusal_at("/joints/0/motor/position/1", {-1, 0}),
              HasSubstr("joints[0].motor: time"));
  EXPECT_THAT(refusal_at("/joints/2/axis", {0, 0, 1}), HasSubstr("joints[2].axis"));
  EXPECT_THAT(refusal_at("/joints/2/bodies", {"rod-2", "belt"}), HasSubstr("accepted"));
  EXPECT_THAT(refusal_at("/joints/2/bodies", {"drum", "hand"}),
              HasSubstr("bodies[4].drive is given: must not be: fixed joints make drum one with"));
  EXPECT_THAT(refusal_at("/joints/2/bodies", {"drum", "belt"}), HasSubstr("what is fixed"));
  EXPECT_THAT(refusal_at("/pushes/0/until", 0.25), HasSubstr("pushes[0].until is 0.25"));
  EXPECT_THAT(refusal_at("/pushes/0/force", {1e13, 0, 0}), HasSubstr("pushes[0].force[0]"));
  EXPECT_THAT(refusal_at("/pushes/0/body", "nobody"), HasSubstr("pushes[0].body is \"nobody\""));
  EXPECT_THAT(refusal_at("/drops/0/upper", {-0.2, -0.2, 0.4}),
              HasSubstr("drops[0].count is 20: the box has room for"));
  EXPECT_THAT(refusal_at("/drops/0/upper", {0.3, 0.3, 0.3}), HasSubstr("drops[0].upper"));
  EXPECT_THAT(refusal_at("/drops/0/count", -1), HasSubstr("drops[0].count is -1"));
  EXPECT_THAT(refusal_at("/bodies/3/name", "rod-7"), HasSubstr("bodies[11].name is \"rod-7\""));
  EXPECT_THAT(refusal_at("/drops/0/pose", json::object()), HasSubstr("drops[0].pose"));
}

TEST(SceneFile, AnglesOfNeedsAreSmallerThanTheLargestThereIs) {
  const auto need = [](const json& value) { return [=](json& s) { s["needs"][0] = value; }; };
  EXPECT_THAT(refusal_of_spoilt(need({{"need", "stands"}, {"body", "can"}, {"degrees", 90}})),
              HasSubstr("needs[0].degrees is 90: must be less than 90"));
  EXPECT_EQ(refusal_of_spoilt(need({{"need", "stands"}, {"body", "can"}, {"degrees", 89.9}})),
            "accepted");
  for (const json& of_turns :
       {json{{"need", "falls-in-order"}, {"bodies", {"can"}}, {"degrees", 180}},
        json{{"need", "normals"}, {"bodies", {"can", "ground"}}, {"degrees", 180}},
        json{{"need", "ends-tilted"}, {"body", "can"}, {"degrees", 180}}}) {
    EXPECT_THAT(refusal_of_spoilt(need(of_turns)),
                HasSubstr("needs[0].degrees is 180: must be less than 180"))
        << of_turns;
  }
}

TEST(SceneFile, NeedsOfContactsAreOfWhatMayTouchBeforeTheEnd) {
  const auto with = [](const json& need, bool is_joined) {
    return refusal_of_spoilt([&](json& s) {
      s["bodies"].push_back(s["bodies"][1]);
      s["bodies"][2]["name"] = "lid";
      if (is_joined) {
        s["joints"] = {{{"joint", "hinge"},
                        {"bodies", {"lid", "can"}},
                        {"anchor", {0, 0, 0}},
                        {"axis", {0, 0, 1}}}};
      }
      s["needs"][0] = need;
    });
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
  const auto turned_to = [](const json& orientation) {
    return refusal_of_spoilt([&](json& s) {
      s["bodies"][1].erase("velocity");
      s["bodies"][1]["drive"] = {
          {"waypoints",
           {{{"time", 1}, {"pose", {{"position", {0, 0, 1}}, {"orientation", orientation}}}}}}};
      s["needs"] = json::array();
    });
  };
  EXPECT_THAT(turned_to({0, 0, 0, 1}),
              HasSubstr("bodies[1].drive.waypoints[0].pose.orientation is half a turn from"));
  EXPECT_EQ(turned_to({0.01, 0, 0, 1}), "accepted");
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
  for (const double duration : {0.0, 0.001}) {
    EXPECT_THAT(refusal_of_spoilt([&](json& s) {
                  s["duration"] = duration;
                  s["needs"] = json::array();
                }),
                HasSubstr("duration is " + json(duration).dump() + ": must be at least one step"));
  }
  EXPECT_THAT(refusal_of_spoilt([](json& s) { s["duration"] = -1; }), HasSubstr("duration is -1"));
  EXPECT_THAT(refusal_of_spoilt([](json& s) {
                s["duration"] = 0.25;
                s["step"] = 0.5;
              }),
              HasSubstr("duration is 0.25: must be at least one step"));
}

TEST(SceneFile, NamesAreWithoutControlCharacters) {
  for (const char* name : {"can\n", "\x1b[2J", "\u009b2J"}) {
    EXPECT_THAT(refusal_of_spoilt([&](json& s) { s["bodies"][1]["name"] = name; }),
                HasSubstr("bodies[1].name is "))
        << name;
  }
  for (const char* name : {"", " "}) {
    EXPECT_THAT(refusal_of_spoilt([&](json& s) { s["bodies"][1]["name"] = name; }),
                HasSubstr("must have a letter"));
  }
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
  const std::string found = contents(file), expected = schema_with_needs(found);
  if (std::getenv("TOUCHSTONE_WRITE_SCHEMA")) std::ofstream(file) << expected;
  EXPECT_EQ(contents(file), expected);
}

TEST(SceneSchema, AndTheDocsHaveARowForEachNeed) {
  const std::string docs = contents(std::filesystem::path(TOUCHSTONE_DOCS) / "scenes.md");
  for (const auto& need : all_needs()) {
    EXPECT_THAT(docs, HasSubstr(std::string("\n| `") + need->name + "` |"));
  }
}

}  // namespace
}  // namespace touchstone
