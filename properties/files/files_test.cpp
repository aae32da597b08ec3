#include <cmath>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <streambuf>
#include <string>
#include <sys/stat.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "properties/files/bytes.hpp"
#include "properties/files/configuration_json.hpp"
#include "properties/files/disk.hpp"
#include "properties/files/given_text.hpp"
#include "properties/files/json_members.hpp"
#include "properties/files/json_schema_test.hpp"
#include "properties/files/strict_json.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::ThrowsMessage;

struct Refusal {
  std::string field, text;
};

Refusal refusal(const std::string& text) {
  try {
    parse_json(text, "file");
  } catch (const InvalidInput& e) {
    return {e.field(), e.what()};
  }
  return {"accepted", text};
}

TEST(StrictJson, IsReadAsItWasWritten) {
  const json value = {{"a", {1, 2.5, "x", nullptr, true}},
                      {"b", {{"a", -1}, {"c", json::array()}}}};
  EXPECT_EQ(parse_json(value.dump(), "file"), value);
  EXPECT_EQ(parse_json(" \r\n" + value.dump(2) + "\n\n", "file"), value);
}

TEST(StrictJson, NamesTheMemberThatIsGivenTwice) {
  const Refusal twice = refusal(R"({"bodies":[{"r":1},{"shape":{"r":1,"h":2,"r":1}}]})");
  EXPECT_EQ(twice.field, "bodies[1].shape.r");
  EXPECT_THAT(twice.text, HasSubstr("given twice"));
  EXPECT_EQ(refusal(R"({"a":{"b":1},"c":{"b":1},"a":2})").field, "a");
  EXPECT_EQ(refusal(R"({"a":1,"\u0061":1})").field, "a");  // the same name written otherwise
}

TEST(StrictJson, RefusesWhateverComesAfterTheValue) {
  for (const std::string& tail : {std::string(1, '\0'), std::string("\0x", 2), std::string("}"),
                                  std::string("{}"), std::string(","), std::string("\x1a")}) {
    EXPECT_EQ(refusal("{\"a\":1}" + tail).field, "file") << tail;
    EXPECT_EQ(refusal("{\"a\":1}\n" + tail).field, "file") << tail;
  }
}

TEST(StrictJson, SaysAtWhichLineAndColumnTheTextIsNoJson) {
  EXPECT_THAT(refusal("{\"a\":1,\n \"b\":x}").text, HasSubstr("line 2, column 6"));
  EXPECT_THAT(refusal("{\"a\":x}").text, HasSubstr("is no JSON at column 6"));
  EXPECT_THAT(refusal("{\"a\":1").text, HasSubstr("its end"));
  EXPECT_THAT(refusal("").text, HasSubstr("its end"));
  for (const char* text : {"{\"a\":x}", "", "[1,]", "\"\xff\"", "\"\xc3\"", "1e", "nan", "'a'"}) {
    EXPECT_THAT(refusal(text).text, testing::Not(HasSubstr("json.exception"))) << text;
    EXPECT_EQ(refusal(text).field, "file") << text;
  }
}

// As Python writes it.
TEST(StrictJson, SaysWhatStandsForWhatIsNoNumber) {
  for (const char* text : {"{\"a\":NaN}", "[1,-Infinity]", "[Infinity]"}) {
    EXPECT_THAT(refusal(text).text, HasSubstr("null for what is no number")) << text;
  }
  EXPECT_THAT(refusal("[None]").text, testing::Not(HasSubstr("null")));
}

TEST(StrictJson, NamesTheNumberBeyondAllDoubles) {
  EXPECT_EQ(refusal(R"({"a":{"r":1e400}})").field, "a.r");
  EXPECT_EQ(refusal(R"({"p":[0,-1e999]})").field, "p[1]");
  EXPECT_EQ(refusal("1e400").field, "file");
  EXPECT_EQ(parse_json("[1e-400]", "file")[0], 0.0);
}

TEST(StrictJson, RefusesWhatIsNestedTooDeeply) {
  const std::string open(max_json_depth, '['), close(max_json_depth, ']');
  EXPECT_NO_THROW(parse_json(open + close, "file"));
  EXPECT_THAT(refusal('[' + open + close + ']').text, HasSubstr("nested too deeply"));
  EXPECT_THAT(refusal(std::string(1000000, '[')).text, HasSubstr("nested too deeply"));
  std::string objects;
  for (int i = 0; i < 100000; ++i) objects += "{\"a\":";
  EXPECT_THAT(refusal(objects).text, HasSubstr("nested too deeply"));
}

TEST(StrictJson, AByteOrderMarkMayStandBeforeTheValue) {
  const std::string mark = "\xef\xbb\xbf";
  EXPECT_EQ(parse_json(mark + "{\"a\":1}", "file"), json({{"a", 1}}));
  EXPECT_EQ(parse_json_lines(mark + "{}\n{}\n", "file").size(), 2u);
  EXPECT_THROW(parse_json_lines("{}\n" + mark + "{}\n", "file"), InvalidInput);
  std::istringstream in(mark + "{\"a\":1}\n" + mark + "{}\n");
  JsonLines lines(in);
  ASSERT_TRUE(lines.next());
  EXPECT_EQ(lines.parse(), json({{"a", 1}}));
  ASSERT_TRUE(lines.next());
  EXPECT_THROW(lines.parse(), InvalidInput);
  for (const std::string& elsewhere : {mark + mark + "1", "[1," + mark + "2]", "1" + mark}) {
    EXPECT_EQ(refusal(elsewhere).field, "file") << elsewhere;
  }
}

/// A stream of zeros (/dev/zero), after a good line.
class Endless : public std::streambuf {
 public:
  Endless() { setg(first_, first_, first_ + sizeof first_); }

 private:
  int_type underflow() override {
    setg(zeros_, zeros_, zeros_ + sizeof zeros_);
    return 0;
  }
  char first_[2] = {'1', '\n'}, zeros_[1 << 16] = {};
};

TEST(JsonLines, ALineWithoutAnEndEndsTheInputNotTheMemory) {
  Endless zeros;
  std::istream in(&zeros);
  JsonLines lines(in);
  ASSERT_TRUE(lines.next());
  EXPECT_EQ(lines.parse(), 1);
  EXPECT_THAT([&] { lines.next(); },
              ThrowsMessage<InvalidInput>(HasSubstr("line 2 is without an end: must")));
}

TEST(JsonLines, GoesOnAfterALineThatIsTooLong) {
  std::istringstream in(std::string(2 << 20, 'x') + "\n7\n");
  JsonLines lines(in);
  ASSERT_TRUE(lines.next());
  EXPECT_THROW(lines.parse(), InvalidInput);
  ASSERT_TRUE(lines.next());
  EXPECT_EQ(lines.parse(), 7);
  EXPECT_FALSE(lines.next());
}

TEST(ParseDouble, ReadsDecimalsAndHexadecimalFloats) {
  EXPECT_EQ(parse_double("1.5"), 1.5);
  EXPECT_EQ(parse_double("-1.5e-3"), -1.5e-3);
  EXPECT_EQ(parse_double("+2"), 2);
  EXPECT_EQ(parse_double(".5"), 0.5);
  EXPECT_EQ(parse_double("0x1.8p-1"), 0.75);
  EXPECT_EQ(parse_double("-0X1P+4"), -16);
  EXPECT_EQ(parse_double("0x0.0000000000001p-1022"), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(parse_double("5e-324"), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(parse_double("1.7976931348623157e308"), std::numeric_limits<double>::max());
}

TEST(ParseDouble, TakesWhatIsTooSmallForZeroAndRefusesWhatIsTooLarge) {
  EXPECT_EQ(parse_double("1e-400"), 0);
  EXPECT_EQ(parse_double("0x1p-2000"), 0);
  EXPECT_TRUE(std::signbit(*parse_double("-1e-400")));
  for (const char* text :
       {"1e309", "-1e400", "0x1p1024", "inf", "-inf", "nan", "NaN(1)", "infinity"}) {
    EXPECT_FALSE(parse_double(text)) << text;
  }
}

TEST(ParseDouble, RefusesWhateverStandsBesideTheNumber) {
  for (const std::string text :
       {"",    " 1",  "1 ",   "1_0", "1,5",      "0x", "0x1.8p-1z", "0x1p", "1e",  "--1",
        "-+1", "+-1", "0x-1", "1f",  "\xd9\xa1", "e5", ".",         "-",    "\t1", "1\n"}) {
    EXPECT_FALSE(parse_double(text)) << text;
  }
  EXPECT_FALSE(parse_double(std::string_view("1\0", 2)));
  EXPECT_FALSE(parse_double(std::string_view("1\0002", 3)));
}

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr CountRange to_a_million{1, 1000000};

TEST(NumberOption, CountsAreWrittenInFullOrByPowersOfTen) {
  EXPECT_EQ(read_count("--count", "1000", to_a_million), 1000U);
  EXPECT_EQ(read_count("--count", "0012", to_a_million), 12U);
  EXPECT_EQ(read_count("--count", "1e6", to_a_million), 1000000U);
  EXPECT_EQ(read_count("--count", "1.5E3", to_a_million), 1500U);
  EXPECT_EQ(read_count("--seed", "18446744073709551615", all_counts), UINT64_MAX);
}

TEST(NumberOption, WhatIsNoCountIsRefusedWithTheRange) {
  for (const char* text :
       {"-1", "0", "1000001", "1e30", "1e400", "nan", "inf", "", " 1", "1 ", "0x10", "0x1e3", "1_0",
        "1.5", "1.5e0", "\xd9\xa1", "18446744073709551616"}) {
    EXPECT_THAT([&] { read_count("--count", text, to_a_million); },
                ThrowsMessage<InvalidInput>(AllOf(HasSubstr("--count is \"" + std::string(text)),
                                                  HasSubstr("from 1 to 1000000"))))
        << text;
  }
  // Neighbours of 2^64 and of -1 would be counts if they wrapped round.
  EXPECT_THROW(read_count("--seed", "-1", all_counts), InvalidInput);
  EXPECT_THROW(read_count("--seed", "1e19", all_counts), InvalidInput);  // not exact as a double
}

TEST(NumberOption, NumbersAreThoseOfFilesWithinTheRange) {
  EXPECT_EQ(read_number("--width", "0x1p-4", positive_numbers), 0.0625);
  EXPECT_EQ(read_number("--width", "1e-30", positive_numbers), 1e-30);
  for (const char* text : {"0", "-1", "1e31", "1e400", "nan", "inf", "", " 1", "0x", "1,5", "1z"}) {
    EXPECT_THAT(
        [&] { read_number("--width", text, positive_numbers); },
        ThrowsMessage<InvalidInput>(AllOf(HasSubstr("--width"), HasSubstr("from 1e-30 to 1e+30"))))
        << text;
  }
}

struct WriteFile : testing::Test {
  WriteFile() { std::filesystem::create_directories(folder); }
  ~WriteFile() override { std::filesystem::remove_all(folder); }

  static std::string read(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  long count() const { return std::distance(std::filesystem::directory_iterator(folder), {}); }

  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / ("write_file_test." + std::to_string(getpid()));
};

TEST_F(WriteFile, ReplacesWhatWasThereAndLeavesNothingElse) {
  write_file(folder / "a", "a longer text", "--out");
  write_file(folder / "a", std::string_view("b\n\0c", 4), "--out");
  EXPECT_EQ(read(folder / "a"), std::string("b\n\0c", 4));
  EXPECT_EQ(count(), 1);
}

TEST_F(WriteFile, WhatIsNoOrdinaryFileIsWrittenAsItIs) {
  write_file("/dev/null", "text", "--out");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST_F(WriteFile, APipeIsAFileAndAFolderIsNot) {
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_TRUE(is_file(folder / "pipe"));
  EXPECT_TRUE(is_file("/dev/null"));
  EXPECT_FALSE(is_file(folder));
  EXPECT_FALSE(is_file(folder / "none"));
}

TEST_F(WriteFile, AFullDiskLeavesTheOldFileAndNamesTheOption) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  // The partial file is as full as a disk can be.
  write_file(folder / "a", "old", "--out");
  std::filesystem::create_symlink("/dev/full", folder / "a.partial");
  try {
    write_file(folder / "a", "new", "--html");
    FAIL() << "nothing was thrown";
  } catch (const InvalidInput& e) {
    EXPECT_EQ(e.field(), "--html");
    EXPECT_THAT(e.what(), testing::HasSubstr((folder / "a").string()));
  }
  EXPECT_EQ(read(folder / "a"), "old");
  EXPECT_EQ(count(), 1);
}

TEST_F(WriteFile, AFolderThatDoesNotExistIsBadInput) {
  EXPECT_THAT(
      [&] { write_file(folder / "none" / "a", "text", "--out"); },
      testing::ThrowsMessage<InvalidInput>(testing::HasSubstr("No such file or directory")));
}

TEST_F(WriteFile, AFolderIsMadeOrRefused) {
  check_writable(folder / "x" / "y");
  EXPECT_TRUE(std::filesystem::is_directory(folder / "x" / "y"));
  write_file(folder / "file", "", "--out");
  EXPECT_THROW(check_writable(folder / "file"), InvalidInput);
}

TEST_F(WriteFile, AFolderIsOneRunsOrSharedByParts) {
  using enum OutputFolder::Use;
  {
    const OutputFolder one(folder / "out");
    EXPECT_THROW(OutputFolder(folder / "out" / ".." / "out"), InvalidInput);
    EXPECT_THROW(OutputFolder(folder / "out", "--out", shared), InvalidInput);
    EXPECT_NO_THROW(OutputFolder(folder / "out" / "within"));
  }
  const OutputFolder part(folder / "out", "--out", shared), other(folder / "out", "--out", shared);
  EXPECT_THAT(
      [&] { OutputFolder(folder / "out", "--figures"); },
      testing::ThrowsMessage<InvalidInput>(testing::HasSubstr("name another folder by --figures")));
}

TEST_F(WriteFile, RemovesOlderFilesOfThatNameAlone) {
  for (const char* name : {"log-1.json", "log-12.json", "log.json", "other-1.json", "log-1.txt"}) {
    write_file(folder / name, "", "--out");
  }
  std::filesystem::create_directory(folder / "log-2.json");
  remove_older(folder, "log-", ".json");
  EXPECT_EQ(count(), 4);
  EXPECT_FALSE(is_file(folder / "log-1.json"));
  EXPECT_NO_THROW(remove_older(folder / "none", "", ""));
}

TEST(Printable, KeepsWhatIsShortAndHarmless) {
  EXPECT_EQ(printable("µ is 3", 20), "µ is 3");
  EXPECT_EQ(printable(std::string(20, 'x'), 20), std::string(20, 'x'));
}

TEST(Printable, CutsWhatIsLongBetweenCharacters) {
  EXPECT_EQ(printable(std::string(10000, 'x'), 10), "xxxxxxx...");
  EXPECT_EQ(printable("abcdefµµµµ", 10), "abcdef...");  // byte 7 is the middle of a character
}

TEST(Printable, WritesControlCharactersAsDigits) {
  EXPECT_EQ(printable(std::string_view("a\0\x1b[2J\n\x7f", 8), 40),
            "a\\u0000\\u001b[2J\\u000a\\u007f");
  EXPECT_EQ(printable("left\u202ethgir", 40), "left\\u202ethgir");
}

TEST(CountedText, HasOneThingInTheSingular) {
  EXPECT_EQ(counted(1, "configuration"), "1 configuration");
  EXPECT_EQ(counted(0, "configuration"), "0 configurations");
  EXPECT_EQ(counted(2, "pose class"), "2 pose classes");
  EXPECT_EQ(counted(3, "body"), "3 bodies");
}

TEST(ErrorText, CutsEachPart) {
  const std::string text(100000, 'x');
  EXPECT_LT(error_text({text, text, "must be short"}).size(), 400U);
  EXPECT_EQ(error_text({"radius", "-1", "must be positive"}), "radius is -1: must be positive");
}

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
    try {
      configuration_from_json(parse_json(text, "the line"));
      ADD_FAILURE() << "accepted";
    } catch (const InvalidInput& e) {
      EXPECT_EQ(e.field(), row.field);
    }
  }
}

TEST(ConfigurationJson, AsksForACylinder) {
  const json line = json::parse(
      R"({"a":{"shape":"sphere","radius":1},"b":{"shape":"box","half_extents":[1,1,1]}})");
  EXPECT_THROW(configuration_from_json(line), InvalidInput);
  EXPECT_THROW(configuration_from_json(json::parse("{}")), InvalidInput);
  EXPECT_THROW(configuration_from_json(json::parse("[1]")), InvalidInput);
}

/// A type with a member of every kind that bytes know.
struct Parcel {
  int number = 0;
  double unknown = 0;
  std::string text;
  std::optional<std::string> there, absent;
  std::vector<std::pair<std::string, int>> pairs;
  std::map<std::string, std::vector<double>> map;
  std::vector<Shape> shapes;
  Pose pose;

  template <class Archive>
  friend void members(Archive& a, Parcel& p) {
    a(p.number, p.unknown, p.text, p.there, p.absent, p.pairs, p.map, p.shapes, p.pose);
  }
};

const Parcel& parcel() {
  static const Parcel p{
      7,
      std::numeric_limits<double>::infinity(),
      std::string("a\0b", 3),
      "",
      std::nullopt,
      {{"one", 1}, {"two", 2}},
      {{"none", {}}, {"some", {0.1, -0.0}}},
      {Sphere(1), Box(Vec3(1, 2, 3)), Plane(Vec3(0, 3, 0), -1), Capsule(1, 2), Cylinder(3, 4)},
      Pose(Vec3(1, 2, 3), {0.5, 0, 0.5, 0})};
  return p;
}

TEST(Bytes, AreReadBackAsTheyWere) {
  const auto read = from_bytes<Parcel>(to_bytes(parcel()));
  EXPECT_EQ(to_bytes(read), to_bytes(parcel()));
  EXPECT_EQ(read.unknown, parcel().unknown);
  EXPECT_EQ(read.text, parcel().text);
  EXPECT_EQ(read.there, parcel().there);
  EXPECT_FALSE(read.absent);
  EXPECT_EQ(read.pairs, parcel().pairs);
  EXPECT_EQ(read.map, parcel().map);
  ASSERT_EQ(read.shapes.size(), 5u);
  EXPECT_EQ(std::get<Plane>(read.shapes[2]).displacement(), -1);
  EXPECT_EQ(read.pose.rotation(), parcel().pose.rotation());
}

TEST(Bytes, ThatEndTooEarlyAreRefused) {
  const std::string bytes = to_bytes(parcel());
  EXPECT_THROW(from_bytes<Parcel>(bytes.substr(0, bytes.size() - 1)), std::logic_error);
  EXPECT_THROW(from_bytes<Parcel>(""), std::logic_error);
  const std::string endless = to_bytes(std::size_t{1} << 40);  // of which nothing is there
  EXPECT_THROW(from_bytes<std::vector<double>>(endless), std::logic_error);
}

TEST(Bytes, HaveNoneBetweenTheMembersOfAType) {
  EXPECT_EQ(to_bytes(std::optional<double>()).size(), 1u);
  EXPECT_EQ(to_bytes(std::optional<double>(1)).size(), 9u);
}

/// A type with named members of every kind that JSON and its schema tell apart.
struct Entry {
  std::string name;
  double share = 0;

  template <class Archive>
  friend void members(Archive& a, Entry& e) {
    a.named("name", e.name);
    a.named("share", e.share, rule::share);
  }
};
struct Listing {
  double endless = std::numeric_limits<double>::infinity(), low = 1, high = 2;
  std::uint64_t count = 3;
  std::optional<double> absent;
  std::string note;
  bool marked = false;
  int newer = -1;
  std::vector<Entry> entries = {{"a", 0.5}};

  template <class Archive>
  friend void members(Archive& a, Listing& l) {
    a.named("endless", l.endless, rule::any_or_null);
    a.named("low", l.low, rule::positive);
    a.named("high", l.high);
    a.ascending({"low", "high"});
    a.named("count", l.count);
    a.named("absent", l.absent);
    a.named("note", l.note, When::filled);
    a.named("marked", l.marked, When::filled);
    a.named("newer", l.newer, When::newer);
    a.named("entries", l.entries);
    a.written("twice", 2 * l.low);
  }
};

TEST(NamedMembers, AreJsonAndReadBack) {
  const std::string text =
      R"({"absent":null,"count":3,"endless":null,"entries":[{"name":"a","share":0.5}],)"
      R"("high":2.0,"low":1.0,"newer":-1,"twice":2.0})";
  EXPECT_EQ(json_of(Listing()).dump(), text);
  Listing read;
  read.entries.clear();
  JsonIn(json::parse(text)).read(read);
  EXPECT_TRUE(std::isnan(read.endless));
  EXPECT_EQ(json_of(read).dump(), text);
}

TEST(NamedMembers, ThatAreNotAsTheTypeSaysAreRefusedWithTheirPlace) {
  const struct {
    const char *place, *value, *error;
  } table[] = {
      {"/endless", "true", "endless is true: must be a number"},
      {"/low", "0", "low is 0: must be a positive number"},
      {"/low", "null", "low is null: must be a positive number"},
      {"/high", "0.5", "high is 0.5: must not be less than its low, 1.0"},
      {"/count", "-1", "count is -1: must be a whole number from 0 to 18446744073709551615"},
      {"/newer", "1.5", "newer is 1.5: must be a whole number from -2147483648 to 2147483647"},
      {"/newer", "4294967296",
       "newer is 4294967296: must be a whole number from -2147483648 to 2147483647"},
      {"/marked", "1", "marked is 1: must be true or false"},
      {"/entries", "{}", "entries is {}: must be an array"},
      {"/entries/0", "[]", "entries[0] is []: must be an object"},
      {"/entries/0/name", "7", "entries[0].name is 7: must be a string"},
      {"/entries/0/share", "2", "entries[0].share is 2: must be a number from 0 to 1"}};
  for (const auto& [place, value, error] : table) {
    json listing = json_of(Listing());
    listing[json::json_pointer(place)] = json::parse(value);
    Listing read;
    EXPECT_THAT([&] { JsonIn(listing).read(read); }, ThrowsMessage<InvalidInput>(error));
  }
  json listing = json_of(Listing());
  listing.erase("newer");  // as in a file of an older version
  Listing read;
  JsonIn(listing).read(read);
  listing["entries"][0].erase("name");
  EXPECT_THAT([&] { JsonIn(listing).read(read); },
              ThrowsMessage<InvalidInput>("entries[0].name is missing: must be given"));
}

TEST(NamedMembers, AreAStrictSchema) {
  JsonSchema schema({"note"}, {"marked"});
  schema.define<Entry>("entry");
  EXPECT_EQ(schema.object(Listing()).dump(),
            R"({"type":"object","properties":{"endless":{"type":["number","null"]},)"
            R"("low":{"type":"number","exclusiveMinimum":0},"high":{"type":"number"},)"
            R"("count":{"type":"integer","minimum":0},"absent":{"type":["number","null"]},)"
            R"("note":{"type":"string"},"newer":{"type":"integer"},)"
            R"("entries":{"type":"array","items":{"$ref":"#/$defs/entry"}},)"
            R"("twice":{"type":"number"}},)"
            R"("required":["endless","low","high","count","absent","note","newer","entries",)"
            R"("twice"],"additionalProperties":false})");
  EXPECT_EQ(schema.definitions()["entry"]["properties"]["share"].dump(),
            R"({"type":"number","minimum":0,"maximum":1})");
}

}  // namespace
}  // namespace touchstone
