#include "simulation/scenes/scene_file.hpp"

#include <filesystem>
#include <gmock/gmock.h>

#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using testing::HasSubstr;

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
std::string refusal(Spoil spoil) {
  json scene = small_scene();
  spoil(scene);
  try {
    scene_from_json(scene, "small");
  } catch (const InvalidInput& e) {
    return e.what();
  }
  return "accepted";
}

TEST(SceneFile, IsReadAsItIsWritten) {
  const SceneFile file = scene_from_json(small_scene(), "small");
  ASSERT_EQ(file.scene.bodies.size(), 2U);
  EXPECT_TRUE(file.scene.bodies[0].fixed);
  const Body& can = file.scene.bodies[1];
  EXPECT_EQ(can.density, 7800);
  EXPECT_EQ(can.material.friction, 0.3);
  EXPECT_EQ(can.velocity, Vec3(1, 0, 0));
  EXPECT_EQ(can.pose.position(), Vec3(0, 0, 0.2));
  EXPECT_EQ(file.scene.duration, 2);
  ASSERT_EQ(file.needs.size(), 1U);
  const Stands& need = std::get<Stands>(file.needs[0]);
  EXPECT_EQ(need.body, 1);
  EXPECT_EQ(need.degrees, 0.5);
  EXPECT_EQ(need.from, 1);
  EXPECT_EQ(need.until, 2);
}

TEST(SceneFile, ErrorsNameThePathOfTheField) {
  const auto on_can = [](const char* field, const json& value) {
    return [=](json& s) { s["bodies"][1][field] = value; };
  };
  EXPECT_THAT(refusal([](json& s) { s["bodies"][1]["shape"]["radius"] = -1; }),
              HasSubstr("bodies[1].shape.radius is -1"));
  EXPECT_THAT(refusal(on_can("materiel", "steel")), HasSubstr("bodies[1].materiel"));
  EXPECT_THAT(refusal(on_can("material", "wood")),
              HasSubstr("bodies[1].material is \"wood\": must be one of the materials: steel"));
  EXPECT_THAT(refusal(on_can("velocity", {1, 2})), HasSubstr("bodies[1].velocity"));
  EXPECT_THAT(refusal(on_can("fixed", 1)), HasSubstr("bodies[1].fixed is 1"));
  EXPECT_THAT(refusal(on_can("name", "ground")), HasSubstr("bodies[1].name"));
  EXPECT_THAT(refusal([](json& s) {
                s["bodies"][1]["pose"]["orientation"] = {0, 0, 0, 0};
              }),
              HasSubstr("bodies[1].pose.orientation"));
  EXPECT_THAT(refusal([](json& s) { s["bodies"] = 3; }), HasSubstr("bodies is 3"));
  EXPECT_THAT(refusal([](json& s) { s["materials"]["steel"]["restitution"] = 2; }),
              HasSubstr("materials.steel.restitution is 2: must lie between 0 and 1"));
  EXPECT_THAT(refusal([](json& s) { s.erase("duration"); }), HasSubstr("duration is missing"));
  EXPECT_THAT(refusal([](json& s) { s["step"] = 1e-6; }), HasSubstr("a million steps"));
  EXPECT_THAT(refusal([](json& s) {
                s["camera"] = {{"position", {0, 0, 0}}, {"look_at", {0, 0, 0}}};
              }),
              HasSubstr("camera.position"));
  EXPECT_THAT(refusal([](json& s) { s["gravitation"] = 1; }), HasSubstr("gravitation"));
}

TEST(SceneFile, WithMoreBodiesThanCanBeHeldAgainstEachOtherIsRefused) {
  EXPECT_THAT(refusal([](json& s) {
                for (int i = 0; i < 1000; ++i) {
                  s["bodies"].push_back(s["bodies"][1]);
                  s["bodies"].back()["name"] = std::to_string(i);
                }
              }),
              HasSubstr("bodies is 1002 bodies"));
}

TEST(SceneFile, ErrorsOfNeedsNameThePathOfTheField) {
  const auto need = [](const json& value) { return [=](json& s) { s["needs"][0] = value; }; };
  EXPECT_THAT(refusal(need({{"need", "flies"}})),
              HasSubstr("needs[0].need is \"flies\": must be one of ends-near, ends-tilted"));
  EXPECT_THAT(refusal(need({{"need", "stands"}, {"body", "pot"}, {"degrees", 1}})),
              HasSubstr("needs[0].body is \"pot\""));
  EXPECT_THAT(refusal(need({{"need", "stands"}, {"body", "can"}, {"degrees", -1}})),
              HasSubstr("needs[0].degrees is -1"));
  EXPECT_THAT(refusal(need({{"need", "rests"}, {"speed", 1}, {"by", 9}})),
              HasSubstr("needs[0].by is 9: must lie within the scene's duration"));
  EXPECT_THAT(refusal(need({{"need", "normals"}, {"bodies", {"can"}}, {"degrees", 9}})),
              HasSubstr("needs[0].bodies"));
  EXPECT_THAT(
      refusal(need({{"need", "penetration"}, {"bodies", {"ground", "ground"}}, {"metres", 1}})),
      HasSubstr("needs[0].bodies is [\"ground\",\"ground\"]: one of them"));
  EXPECT_THAT(refusal(need({{"need", "rolls"}, {"body", "can"}, {"distance", 0}, {"share", 1}})),
              HasSubstr("needs[0].distance is 0"));
  EXPECT_THAT(
      refusal(need(
          {{"need", "stays-in"}, {"body", "can"}, {"lower", {0, 0, 1}}, {"upper", {1, 1, 0}}})),
      HasSubstr("needs[0].upper"));
}

TEST(SceneFile, ThatIsNoneIsRefused) {
  EXPECT_THROW(read_scene("/nowhere/scene.json"), InvalidInput);
  EXPECT_THROW(read_scene("/etc"), InvalidInput);
  EXPECT_THROW(read_scene("/etc/passwd"), InvalidInput);
  EXPECT_THROW(read_scene(std::string(10000, 'x')), InvalidInput);
}

TEST(SceneFile, ShippedScenesAreReadAndSayWhatTheyNeed) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(TOUCHSTONE_SCENES)) {
    if (entry.path().extension() != ".json") continue;
    SCOPED_TRACE(entry.path());
    const SceneFile file = read_scene(entry.path());
    EXPECT_FALSE(file.needs.empty());
    EXPECT_FALSE(file.description.empty());
    ++count;
  }
  EXPECT_EQ(count, 7);
}

}  // namespace
}  // namespace touchstone
