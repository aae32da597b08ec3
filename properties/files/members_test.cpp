#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "properties/files/bytes.hpp"
#include "properties/files/json_members.hpp"
#include "properties/files/json_schema_test.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using testing::ThrowsMessage;

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
      {Sphere(1), Box(Vec3(1, 2, 3), 0.5), Plane(Vec3(0, 3, 0), -1), Capsule(1, 2),
       Cylinder(3, 4, 1), Convex({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {2, 1, 0}}, 0.25)},
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
  ASSERT_EQ(read.shapes.size(), 6u);
  EXPECT_EQ(std::get<Plane>(read.shapes[2]).displacement(), -1);
  EXPECT_EQ(std::get<Convex>(read.shapes[5]).edges().size(), 3u);
  for (std::size_t i = 0; i < read.shapes.size(); ++i) {
    EXPECT_EQ(rounding_of(read.shapes[i]), rounding_of(parcel().shapes[i]));
  }
  EXPECT_EQ(read.pose.rotation(), parcel().pose.rotation());
}

/// Bytes of a truth once lacked the vertices that touch, for a list had not grown with its type.
TEST(Bytes, HaveEveryMemberOfAnAggregate) {
  oracle::OptimalNormal normal{Vec3(0, 0, 1)};
  normal.support_b = {3, 5};
  const auto read = from_bytes<std::vector<oracle::OptimalNormal>>(to_bytes(std::vector{normal}));
  EXPECT_EQ(read.at(0).support_b, normal.support_b);
  const Configuration c{{1, 2}, Pose(), Sphere(3), Pose()};  // which has no default
  EXPECT_EQ(std::get<Sphere>(from_bytes<Configuration>(to_bytes(c)).b).radius(), 3);
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
