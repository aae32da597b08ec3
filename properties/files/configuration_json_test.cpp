#include "properties/files/configuration_json.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "properties/files/strict_json.hpp"
#include "reference/error_of_test.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

json box_configuration() {
  return json::parse(R"({"id":"c1",
      "a":{"shape":"cylinder","radius":0.5,"half_length":1},
      "pose_a":{"position":[0,0,1.5],"orientation":[1,0,0,0]},
      "b":{"shape":"box","half_extents":[1,2,3]},
      "pose_b":{"position":[0.1,0,0],"orientation":[0.6,0,0,0.8]}})");
}

TEST(ConfigurationJson, ReadsWhatItWrites) {
  const auto given = configuration_from_json(box_configuration());
  EXPECT_FALSE(given.swapped);
  const json written = to_json(given.configuration);
  EXPECT_EQ(to_json(configuration_from_json(written).configuration), written);
  EXPECT_EQ(written["pose_b"]["position"][0], 0.1);
}

TEST(ConfigurationJson, HexFloatsKeepEveryBit) {
  json line = box_configuration();
  line["a"]["radius"] = "0x1.8p-1";
  line["a"]["half_length"] = "0.25";
  line["pose_a"]["position"][0] = std::numeric_limits<double>::denorm_min();
  const Configuration c = configuration_from_json(line).configuration;
  EXPECT_EQ(c.a.radius(), 0.75);
  EXPECT_EQ(c.a.half_length(), 0.25);
  const json hex = to_hex_json(c);
  EXPECT_TRUE(hex["a"]["radius"].is_string());
  EXPECT_EQ(configuration_from_json(hex).configuration.pose_a.position().x(),
            std::numeric_limits<double>::denorm_min());
}

TEST(ConfigurationJson, MissingPoseIsTheIdentity) {
  json line = box_configuration();
  line.erase("pose_a");
  line["pose_b"].erase("orientation");
  const Configuration c = configuration_from_json(line).configuration;
  EXPECT_EQ(c.pose_a.position(), Vec3::Zero());
  EXPECT_EQ(c.pose_b.orientation().w(), 1);
}

TEST(ConfigurationJson, ARotationOrAnAxisStandsInPlaceOfTheQuaternion) {
  const auto quaternion = [](const char* way, const char* value) {
    json line = box_configuration();
    line["pose_a"].erase("orientation");
    line["pose_a"][way] = json::parse(value);
    return configuration_from_json(line).configuration.pose_a.orientation().coeffs();
  };
  const Eigen::Vector4d to_y(-1, 0, 0, 1), to_x(0, 1, 0, 1);  // x, y, z, w
  EXPECT_EQ(quaternion("axis", "\"y\""), to_y);
  EXPECT_EQ(quaternion("axis", "[0, \"0x1p-1\", 0]"), to_y);
  EXPECT_EQ(quaternion("axis", "\"x\""), to_x);
  EXPECT_EQ(quaternion("axis", "\"z\""), Eigen::Vector4d(0, 0, 0, 1));
  EXPECT_EQ(quaternion("rotation", "[[1, 0, 0], [0, 0, 1], [0, -1, 0]]"), to_y) << "by its rows";
}

TEST(ConfigurationJson, EitherBodyMayBeTheCylinder) {
  json line = box_configuration();
  std::swap(line["a"], line["b"]);
  std::swap(line["pose_a"], line["pose_b"]);
  const auto given = configuration_from_json(line);
  EXPECT_TRUE(given.swapped);
  EXPECT_EQ(given.configuration.pose_a.position().z(), 1.5);
}

TEST(ConfigurationJson, AHullIsMadeOfTheVerticesThatAreGiven) {
  json line = box_configuration();
  line["b"] = json::parse(R"({"shape":"convex","vertices":
      [[0,0,0],[1,0,0],[0,1,0],[0,0,"0x1p-1"],[0.1,0.1,0.1],[1,0,0]]})");
  const auto given = configuration_from_json(line);
  const json written = to_json(given.configuration);
  EXPECT_EQ(written["b"].dump(), R"({"shape":"convex","vertices":[[0.0,0.0,0.0],[1.0,0.0,0.0],)"
                                 R"([0.0,1.0,0.0],[0.0,0.0,0.5]]})")
      << "without the inner point and the one that is given twice";
  EXPECT_EQ(to_json(configuration_from_json(written).configuration), written);
  EXPECT_EQ(std::get<Convex>(given.configuration.b).faces().size(), 4U);
  EXPECT_EQ(to_hex_json(given.configuration)["b"]["vertices"][3][2], "0x1p-1");
}

TEST(ConfigurationJson, ARoundingIsReadAndWrittenWhereThereIsOne) {
  json line = box_configuration();
  EXPECT_FALSE(to_json(configuration_from_json(line).configuration)["a"].contains("rounding"));
  line["a"]["rounding"] = "0x1p-3";
  line["b"]["rounding"] = 0.0625;
  const Configuration c = configuration_from_json(line).configuration;
  EXPECT_EQ(c.a.rounding(), 0.125);
  EXPECT_EQ(std::get<Box>(c.b).rounding(), 0.0625);
  EXPECT_EQ(to_hex_json(c)["a"]["rounding"], "0x1p-3");
  EXPECT_EQ(to_json(configuration_from_json(to_json(c)).configuration), to_json(c));
  line["b"] =
      json::parse(R"({"shape":"convex","vertices":[[0,0,0],[1,0,0],[0,1,0]],"rounding":9})");
  EXPECT_EQ(std::get<Convex>(configuration_from_json(line).configuration.b).rounding(), 9);
}

TEST(ConfigurationJson, MoreVerticesThanThereMayBeAreRefused) {
  json line = box_configuration();
  line["b"] = {{"shape", "convex"}, {"vertices", json::array()}};
  for (std::size_t i = 0; i <= Convex::max_vertices; ++i) {
    line["b"]["vertices"].push_back({0.0, 0.0, i % 7});
  }
  EXPECT_EQ(error_text_of([&] { configuration_from_json(line); }),
            "b.vertices is 4097 points: must be at most 4096");
}

TEST(ConfigurationJson, NamesTheFieldThatIsWrong) {
  const struct {
    const char* pointer;
    const char* value;
    const char* field;
  } table[] = {
      {"/a/radius", "-1", "a.radius"},
      {"/a/radius", "null", "a.radius"},
      {"/a/radius", "\"one\"", "a.radius"},
      {"/a/radius", "\"nan\"", "a.radius"},
      {"/a/radius", "\"\"", "a.radius"},
      {"/a/radius", "\"1 \"", "a.radius"},
      {"/a/radius", "\"0x\"", "a.radius"},
      {"/a/radius", "\"0x1.8p-1z\"", "a.radius"},
      {"/a/radius", "\"1\\u00002\"", "a.radius"},
      {"/a/radius", "1e999", "a.radius"},
      {"/a/half_length", "0", "a.half_length"},
      {"/a/length", "1", "a.length"},
      {"/a", "3", "a"},
      {"/a/shape", "\"cone\"", "a.shape"},
      {"/a/shape", "7", "a.shape"},
      {"/b/half_extents", "[1,2]", "b.half_extents"},
      {"/b/half_extents/1", "0", "b.half_extents[1]"},
      {"/b/half_extents/1", "[]", "b.half_extents[1]"},
      {"/a/rounding", "-1", "a.rounding"},
      {"/a/rounding", "1000", "a.rounding"},
      {"/a/rounding", "null", "a.rounding"},
      {"/b/rounding", "\"inf\"", "b.rounding"},
      {"/b", R"({"shape":"sphere","radius":1,"rounding":1})", "b.rounding"},
      {"/b", R"({"shape":"capsule","radius":1,"half_length":1,"rounding":1})", "b.rounding"},
      {"/b", R"({"shape":"convex","vertices":[[0,0,0],[1,0,0],[0,1,0]],"rounding":-1})",
       "b.rounding"},
      {"/b", R"({"shape":"convex"})", "b.vertices"},
      {"/b", R"({"shape":"convex","vertices":3})", "b.vertices"},
      {"/b", R"({"shape":"convex","vertices":[[0,0,0],[1,0,0],[0,1]]})", "b.vertices[2]"},
      {"/b", R"({"shape":"convex","vertices":[[0,0,0],[1,0,0],[0,1,null]]})", "b.vertices[2][2]"},
      {"/b", R"({"shape":"convex","vertices":[[0,0,0],[1,0,0]]})", "b.vertices"},
      {"/b", R"({"shape":"convex","vertices":[[0,0,0],[1,1,1],[2,2,2]]})", "b.vertices"},
      {"/b", R"({"shape":"convex","vertices":[[0,0,0],[1,0,0],[0,1,0]],"faces":[]})", "b.faces"},
      {"/pose_a/orientation", "[0,0,0,0]", "pose_a.orientation"},
      {"/pose_a/orientation", "[1,0,0]", "pose_a.orientation"},
      {"/pose_a/position/2", "\"inf\"", "pose_a.position[2]"},
      {"/pose_a/rotation", "[[1,0,0],[0,1,0],[0,0,1]]", "pose_a.rotation"},  // beside another
      {"/pose_a/turn", "1", "pose_a.turn"},
      {"/pose_b", R"({"axis":"y","rotation":[[1,0,0],[0,1,0],[0,0,1]]})", "pose_b.axis"},
      {"/pose_b", R"({"axis":"up"})", "pose_b.axis"},
      {"/pose_b", R"({"axis":[0,0,0]})", "pose_b.axis"},
      {"/pose_b", R"({"axis":[0,0,null]})", "pose_b.axis[2]"},
      {"/pose_b", R"({"rotation":[1,0,0,0]})", "pose_b.rotation"},
      {"/pose_b", R"({"rotation":[[1,0,0],[0,1],[0,0,1]]})", "pose_b.rotation[1]"},
      {"/pose_b", R"({"rotation":[[1,0,0],[0,1,0],[0,0,"x"]]})", "pose_b.rotation[2][2]"},
      {"/pose_b", R"({"rotation":[[1,0,0],[0,1,0],[0,0,2]]})", "pose_b.rotation"},
      {"/pose_b", "[]", "pose_b"},
      {"/pose_c", "{}", "pose_c"},
  };
  for (const auto& row : table) {
    SCOPED_TRACE(std::string(row.pointer) + " = " + row.value);
    json line = box_configuration();
    line[json::json_pointer(row.pointer)] = "the value";
    std::string text = line.dump();
    const std::string placeholder = "\"the value\"";
    text.replace(text.find(placeholder), placeholder.size(), row.value);
    const auto read = [&] { configuration_from_json(parse_json(text, "the line")); };
    EXPECT_EQ(error_of(read).field(), row.field);
  }
}

TEST(ConfigurationJson, ACastHasASweepAndASpin) {
  json line = box_configuration();
  EXPECT_FALSE(cast_from_json(line).sweep);
  line["sweep"] = {1, "0x1p-1", -3};
  const auto given = cast_from_json(line);
  ASSERT_TRUE(given.sweep);
  EXPECT_EQ(given.sweep->translation(), Vec3(1, 0.5, -3));
  EXPECT_FALSE(given.sweep->turns());
  line["spin"] = {0, 0, 2};
  const auto turning = cast_from_json(line);
  EXPECT_EQ(turning.sweep->spin(), Vec3(0, 0, 2));
  const json written = to_hex_json(turning.configuration, turning.sweep);
  EXPECT_EQ(written["sweep"][1], "0x1p-1");
  EXPECT_EQ(cast_from_json(written).sweep->spin(), Vec3(0, 0, 2));
  EXPECT_EQ(to_json(given.configuration, std::nullopt), to_json(given.configuration));
  line.erase("sweep");
  EXPECT_EQ(cast_from_json(line).sweep->translation(), Vec3::Zero()) << "a turn in its place";
}

TEST(ConfigurationJson, OfTheOtherBodyASweepIsSeenFromTheCylinder) {
  json line = box_configuration();
  std::swap(line["a"], line["b"]);
  std::swap(line["pose_a"], line["pose_b"]);
  line["sweep"] = {1, 2, 3};
  EXPECT_EQ(cast_from_json(line).sweep->translation(), Vec3(-1, -2, -3));
}

TEST(ConfigurationJson, SaysWhatIsWrongWithASweep) {
  const struct {
    const char* name;
    const char* value;
    const char* what;
  } table[] = {
      {"sweep", "[1,2]", "sweep is [1,2]: must be an array of 3 numbers"},
      {"sweep", "[1,2,\"inf\"]", "sweep[2] is \"inf\": must be"},
      {"sweep", "4", "sweep is 4: must be an array of 3 numbers"},
      {"spin", "[0,null,0]", "spin[1] is null: must be"},
  };
  for (const auto& row : table) {
    json line = box_configuration();
    line[row.name] = json::parse(row.value);
    EXPECT_THAT(error_text_of([&] { cast_from_json(line); }), testing::StartsWith(row.what));
  }
}

TEST(ConfigurationJson, IsNoCastWhereNoneIsKnown) {
  json line = box_configuration();
  line["sweep"] = {1, 2, 3};
  const InvalidInput error = error_of([&] { configuration_from_json(line); });
  EXPECT_EQ(error.field(), "sweep");
  EXPECT_EQ(error.remedy(), "must be left out: casts are known to solve and replay alone");
  EXPECT_THROW(configuration_from_text(line.dump(), "a file"), InvalidInput);
}

TEST(ConfigurationJson, AsksForACylinder) {
  const json line = json::parse(
      R"({"a":{"shape":"sphere","radius":1},"b":{"shape":"box","half_extents":[1,1,1]}})");
  EXPECT_THROW(configuration_from_json(line), InvalidInput);
  EXPECT_THROW(configuration_from_json(json::parse("{}")), InvalidInput);
  EXPECT_THROW(configuration_from_json(json::parse("[1]")), InvalidInput);
}

}  // namespace
}  // namespace touchstone
