#include "properties/files/strict_json.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sstream>
#include <streambuf>
#include <string>

#include <nlohmann/json.hpp>

#include "reference/error_of_test.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::ThrowsMessage;

InvalidInput refusal(const std::string& text) {
  return error_of([&] { parse_json(text, "file"); });
}

TEST(StrictJson, IsReadAsItWasWritten) {
  const json value = {{"a", {1, 2.5, "x", nullptr, true}},
                      {"b", {{"a", -1}, {"c", json::array()}}}};
  EXPECT_EQ(parse_json(value.dump(), "file"), value);
  EXPECT_EQ(parse_json(" \r\n" + value.dump(2) + "\n\n", "file"), value);
}

TEST(StrictJson, NamesTheMemberThatIsGivenTwice) {
  const InvalidInput twice = refusal(R"({"bodies":[{"r":1},{"shape":{"r":1,"h":2,"r":1}}]})");
  EXPECT_EQ(twice.field(), "bodies[1].shape.r");
  EXPECT_THAT(twice.what(), HasSubstr("given twice"));
  EXPECT_EQ(refusal(R"({"a":{"b":1},"c":{"b":1},"a":2})").field(), "a");
  EXPECT_EQ(refusal(R"({"a":1,"\u0061":1})").field(), "a");  // the same name written otherwise
}

TEST(StrictJson, RefusesWhateverComesAfterTheValue) {
  for (const std::string& tail : {std::string(1, '\0'), std::string("\0x", 2), std::string("}"),
                                  std::string("{}"), std::string(","), std::string("\x1a")}) {
    EXPECT_EQ(refusal("{\"a\":1}" + tail).field(), "file") << tail;
    EXPECT_EQ(refusal("{\"a\":1}\n" + tail).field(), "file") << tail;
  }
}

TEST(StrictJson, SaysAtWhichLineAndColumnTheTextIsNoJson) {
  EXPECT_THAT(refusal("{\"a\":1,\n \"b\":x}").what(), HasSubstr("line 2, column 6"));
  EXPECT_THAT(refusal("{\"a\":x}").what(), HasSubstr("is no JSON at column 6"));
  EXPECT_THAT(refusal("{\"a\":1").what(), HasSubstr("its end"));
  EXPECT_THAT(refusal("").what(), HasSubstr("its end"));
  for (const char* text : {"{\"a\":x}", "", "[1,]", "\"\xff\"", "\"\xc3\"", "1e", "nan", "'a'"}) {
    EXPECT_THAT(refusal(text).what(), testing::Not(HasSubstr("json.exception"))) << text;
    EXPECT_EQ(refusal(text).field(), "file") << text;
  }
}

// As Python writes it.
TEST(StrictJson, SaysWhatStandsForWhatIsNoNumber) {
  for (const char* text : {"{\"a\":NaN}", "[1,-Infinity]", "[Infinity]"}) {
    EXPECT_THAT(refusal(text).what(), HasSubstr("null for what is no number")) << text;
  }
  EXPECT_THAT(refusal("[None]").what(), testing::Not(HasSubstr("null")));
}

TEST(StrictJson, NamesTheNumberBeyondAllDoubles) {
  EXPECT_EQ(refusal(R"({"a":{"r":1e400}})").field(), "a.r");
  EXPECT_EQ(refusal(R"({"p":[0,-1e999]})").field(), "p[1]");
  EXPECT_EQ(refusal("1e400").field(), "file");
  EXPECT_EQ(parse_json("[1e-400]", "file")[0], 0.0);
}

TEST(StrictJson, RefusesWhatIsNestedTooDeeply) {
  const std::string open(max_json_depth, '['), close(max_json_depth, ']');
  EXPECT_NO_THROW(parse_json(open + close, "file"));
  EXPECT_THAT(refusal('[' + open + close + ']').what(), HasSubstr("nested too deeply"));
  EXPECT_THAT(refusal(std::string(1000000, '[')).what(), HasSubstr("nested too deeply"));
  std::string objects;
  for (int i = 0; i < 100000; ++i) objects += "{\"a\":";
  EXPECT_THAT(refusal(objects).what(), HasSubstr("nested too deeply"));
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
    EXPECT_EQ(refusal(elsewhere).field(), "file") << elsewhere;
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

}  // namespace
}  // namespace touchstone
