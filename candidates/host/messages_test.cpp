#include "candidates/host/messages.hpp"

#include <cmath>
#include <cstring>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace touchstone::messages {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

const std::string good_hello =
    R"({"touchstone": 1, "name": "mine", "version": "2", "settings": "s", "precision": "float",)"
    R"( "runs": "wasm", "format": "frames", "pairs": ["cylinder-box"], "later": []})";

std::string hello_with(const std::string& from, const std::string& to) {
  std::string text = good_hello;
  return text.replace(text.find(from), from.size(), to);
}

TEST(Hello, IsReadAndUnknownMembersAreIgnored) {
  const Description hello = read_hello(good_hello);
  EXPECT_TRUE(hello.in_frames);
  EXPECT_STREQ(hello.name, "mine");
  EXPECT_STREQ(hello.precision, "float");
  EXPECT_STREQ(hello.runs, "wasm");
  EXPECT_TRUE(hello.supports[TS_BOX]);
  EXPECT_FALSE(hello.supports[TS_PLANE]);
  EXPECT_FALSE(hello.supports[TS_CONVEX]);
  EXPECT_TRUE(read_hello(hello_with("box", "convex")).supports[TS_CONVEX]);
  EXPECT_FALSE(hello.has_parameter);
}

TEST(Hello, IsRefusedWithTheMemberTheValueAndTheRemedy) {
  const struct {
    std::string from, to, message;
  } cases[] = {
      {"\"touchstone\": 1", "\"touchstone\": 2", "\"touchstone\": \"2\", which must be 1"},
      {"\"mine\"", "\"my engine\"", "\"name\": \"\"my engine\"\", which must be up to 63"},
      {"\"mine\"", "\"../mine\"", "which must be up to 63"},
      {"\"mine\"", "\"-mine\"", "which must be up to 63"},
      {"\"mine\"", "7", "\"name\": \"7\", which must be a text"},
      {"\"version\": \"2\", ", "", "\"version\": nothing, which must be a text"},
      {"\"float\"", "\"half\"", "must be \"double\" or \"float\""},
      {"\"frames\"", "\"xml\"", "must be \"frames\" or \"lines\""},
      {"\"cylinder-box\"", "\"box-box\"", "must be a list of \"cylinder-plane\""},
      {"[\"cylinder-box\"]", "[]", "must be a list of"},
      {"\"later\": []", "\"parameter\": {\"meaning\": \"m\", \"min\": 2, \"max\": 1, \"usual\": 1}",
       "with min <= usual <= max"},
      {"\"later\": []", "\"roundings\": 1", "\"roundings\": \"1\", which must be true or false"},
      {"\"mine\"", "\"mine\", \"name\": \"other\"", "wrote the member \"name\" twice"},
      {"{\"touch", "Welcome!{\"touch", "no JSON object"}};
  for (const auto& c : cases) {
    EXPECT_THAT([&] { read_hello(hello_with(c.from, c.to)); },
                ThrowsMessage<Garbage>(HasSubstr(c.message)))
        << c.to;
  }
}

Poses some_poses(std::uint32_t handle) {
  return {handle,
          {{1, 2, 3}, {1, 0, 0, 0}},
          {{0.1, -1e-300, 1e300}, {0.5, 0.5, 0.5, 0.5}},
          true,
          {0, 0, 1}};
}

template <class T>
T at(const std::string& bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

TEST(Frames, LieAsSpecified) {
  const PairOfShapes pair{7, 0.25, 16, sized(TS_CYLINDER, 0.5, 1), sized(TS_PLANE, 0, 0, 1, -2)};
  const std::string prepare = prepare_request(Format::frames, 3, pair).text;
  ASSERT_EQ(prepare.size(), 24u + 104);
  EXPECT_EQ(at<std::uint32_t>(prepare, 0), 20u + 104);
  EXPECT_EQ(at<std::uint32_t>(prepare, 4), 1u);
  EXPECT_EQ(at<std::uint64_t>(prepare, 8), 3u);
  EXPECT_EQ(at<std::uint32_t>(prepare, 16), 1u);
  EXPECT_EQ(at<std::uint32_t>(prepare, 20), 0u);
  EXPECT_EQ(at<std::uint32_t>(prepare, 24), 7u);
  EXPECT_EQ(at<double>(prepare, 32), 0.25);
  EXPECT_EQ(at<double>(prepare, 40), 16);
  EXPECT_EQ(at<std::uint32_t>(prepare, 48), 0u);
  EXPECT_EQ(at<double>(prepare, 56), 0.5);
  EXPECT_EQ(at<std::uint32_t>(prepare, 88), 1u);
  EXPECT_EQ(at<std::uint32_t>(prepare, 92), 0u);
  EXPECT_EQ(at<double>(prepare, 96 + 24), -2);

  const Poses poses[] = {some_poses(7), some_poses(8)};
  const std::string query = query_request(Format::frames, 4, poses).text;
  ASSERT_EQ(query.size(), 24u + 2 * 144);
  EXPECT_EQ(at<std::uint32_t>(query, 24 + 144), 8u);
  EXPECT_EQ(at<std::uint32_t>(query, 28), 1u);
  EXPECT_EQ(at<double>(query, 32), 1);
  EXPECT_EQ(at<double>(query, 32 + 56 + 16), 1e300);
  EXPECT_EQ(at<double>(query, 32 + 112 + 16), 1);
  EXPECT_EQ(at<std::uint32_t>(query_request(Format::frames, 5, poses, 640).text, 20), 640u);
  const std::uint32_t handles[] = {7, 8};
  EXPECT_EQ(release_request(Format::frames, 6, handles).text.size(), 24u + 8);
}

constexpr double corners[] = {0, 0, 0, 0.1 + 0.2, 0, 0, 0, -1e-300, 1};
constexpr int both_sides[] = {3, 0, 1, 2, 3, 0, 2, 1};
constexpr ts_shape triangle{TS_CONVEX, {}, corners, both_sides, 3, 2, 0};

TEST(Frames, HaveAConvexBodysVerticesAfterTheEntries) {
  const PairOfShapes pair{7, 0, 0, sized(TS_CYLINDER, 0.5, 1), triangle};
  const std::string prepare = prepare_request(Format::frames, 3, pair).text;
  ASSERT_EQ(prepare.size(), 24u + 104 + 3 * 24);
  EXPECT_EQ(at<std::uint32_t>(prepare, 0), 20u + 104 + 3 * 24);
  EXPECT_EQ(at<std::uint32_t>(prepare, 16), 1u);
  EXPECT_EQ(at<std::uint32_t>(prepare, 88), 5u);
  EXPECT_EQ(at<std::uint32_t>(prepare, 92), 3u);
  EXPECT_EQ(at<double>(prepare, 96), 0);
  for (std::size_t i = 0; i < std::size(corners); ++i) {
    EXPECT_EQ(at<double>(prepare, 128 + 8 * i), corners[i]) << i;
  }
}

TEST(Lines, HaveAConvexBodysVertices) {
  const PairOfShapes pair{7, 0, 0, sized(TS_CYLINDER, 0.5, 1), triangle};
  EXPECT_THAT(prepare_request(Format::lines, 3, pair).text,
              AllOf(HasSubstr(R"("shape":"convex")"),
                    HasSubstr("\"vertices\":[[0.0,0.0,0.0],[0.30000000000000004,0.0,0.0],"
                              "[0.0,-1e-300,1.0]]")));
}

// Of a command that says them, and of no other.
TEST(Roundings, StandAtTheEndOfAPreparedPairAndOfItsAnswer) {
  PairOfShapes pair{7, 0, 0, sized(TS_CYLINDER, 0.5, 1), triangle};
  pair.a.rounding = 0.25;
  const Request silent = prepare_request(Format::frames, 3, pair);
  const Request asked = prepare_request(Format::frames, 3, pair, true);
  ASSERT_EQ(asked.text.size(), silent.text.size() + 16);
  EXPECT_EQ(at<double>(asked.text, silent.text.size()), 0.25);
  EXPECT_EQ(at<double>(asked.text, silent.text.size() + 8), 0);
  ASSERT_EQ(asked.answer_size(), 24u + 4 + 16);
  EXPECT_EQ(silent.answer_size(), 24u + 4);

  std::string answer = asked.text.substr(0, 24) + std::string(20, '\0');
  const std::uint32_t length = 40, supported = 1;
  const double roundings[] = {0.04, 0.02};
  std::memcpy(answer.data(), &length, sizeof length);
  std::memcpy(answer.data() + 24, &supported, sizeof supported);
  std::memcpy(answer.data() + 28, roundings, sizeof roundings);
  const auto prepared = read_prepared(asked, answer);
  ASSERT_TRUE(prepared);
  EXPECT_EQ(prepared->roundings[0], 0.04);
  EXPECT_EQ(prepared->roundings[1], 0.02);

  const Request line = prepare_request(Format::lines, 3, pair, true);
  EXPECT_THAT(line.text, HasSubstr(R"("rounding":0.25)"));
  const auto read =
      read_prepared(line, R"({"ticket": 3, "supported": [true], "roundings": [[0.04, 0.02]]})");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->roundings[1], 0.02);
  EXPECT_THROW(read_prepared(line, R"({"ticket": 3, "supported": [true]})"), Garbage);
  EXPECT_THROW(read_prepared(line, R"({"ticket": 3, "supported": [true], "roundings": [[0.04]]})"),
               Garbage);
}

TEST(Lines, HoldDoublesExactly) {
  Poses poses = some_poses(7);
  poses.a.position[0] = 0.1 + 0.2;
  poses.has_previous_normal = false;
  const Request request = query_request(Format::lines, 4, {&poses, 1});
  const std::string& line = request.text;
  EXPECT_THAT(line, HasSubstr("0.30000000000000004"));
  EXPECT_THAT(line, HasSubstr("\"hint\":null"));
  EXPECT_EQ(line.find('\n'), line.size() - 1);
  const std::string answer =
      R"({"ticket": 4, "answers": [{"status": "contact", "signed_distance": -0.30000000000000004,)"
      R"( "normal": ["nan", "inf", "-inf"], "points": [{"position": [1, 2, 3], "normal": [0, 0, 1],)"
      R"( "depth": 5e-324}]}]})";
  const Answer read = read_answer(request, answer);
  EXPECT_EQ(read.signed_distance, -(0.1 + 0.2));
  EXPECT_TRUE(std::isnan(read.normal[0]));
  EXPECT_EQ(read.normal[2], -std::numeric_limits<double>::infinity());
  EXPECT_EQ(read.points[0].depth, 5e-324);
}

const Request a_query{Format::lines, Operation::query, 4, 1, ""};

TEST(Lines, NestedTooDeeplyAreRefused) {
  const auto nested = [](std::size_t levels) {
    return R"({"ticket": 4, "answers": )" + std::string(levels, '[') + std::string(levels, ']') +
           '}';
  };
  for (const std::size_t levels :
       {std::size_t{64}, std::size_t{100'000}, std::size_t{10'000'000}}) {
    EXPECT_THAT([&] { read_answer(a_query, nested(levels)); },
                ThrowsMessage<Garbage>(HasSubstr("more than 64 levels deep")))
        << levels;
  }
  // One less is within the limit, and no answer.
  EXPECT_THAT([&] { read_answer(a_query, nested(63)); },
              ThrowsMessage<Garbage>(testing::Not(HasSubstr("levels"))));
}

// Whatever a child writes is refused or read; bytes that are cut, doubled, swapped or changed do no
// harm (under the sanitizers, too).
class Fuzz {
 public:
  explicit Fuzz(std::uint64_t seed) : random_(seed) {}
  std::string mutated(std::string text) {
    for (int changes = 1 + static_cast<int>(random_() % 4); changes > 0 && !text.empty();
         --changes) {
      const std::size_t i = random_() % text.size();
      switch (random_() % 6) {
        case 0:
          text[i] = static_cast<char>(random_());
          break;
        case 1:
          text.resize(i);
          break;
        case 2:
          text.insert(i, text.substr(i, random_() % 40));
          break;
        case 3:
          text.erase(i, random_() % 9);
          break;
        case 4:
          std::swap(text[i], text[random_() % text.size()]);
          break;
        default:
          text.insert(i, pieces[random_() % std::size(pieces)]);
      }
    }
    return text;
  }

 private:
  static constexpr const char* pieces[] = {"[",    "]",       "{",  "}", "1e999",
                                           "null", "\"nan\"", "-0", ","};
  std::mt19937_64 random_;
};

TEST(Messages, ACastHasItsSweepWhereAQueryHasItsHint) {
  const Poses poses{7, {{1, 2, 3}, {1, 0, 0, 0}}, {{0, 0, 0}, {1, 0, 0, 0}}, true, {4, 5, 6}};
  const Request line = cast_request(Format::lines, 3, poses);
  EXPECT_THAT(line.text, testing::HasSubstr(R"("op":"cast")"));
  EXPECT_THAT(line.text, testing::HasSubstr(R"("sweep":[4.0,5.0,6.0])"));
  const Request frame = cast_request(Format::frames, 3, poses);
  EXPECT_EQ(frame.text.size(), query_request(Format::frames, 3, {&poses, 1}).text.size());
  EXPECT_EQ(frame.answer_size(), 24U + 40U);
}

TEST(Messages, ACastIsReadFromBothFormats) {
  const Request line{Format::lines, Operation::cast, 4, 1, ""},
      frame{Format::frames, Operation::cast, 4, 1, ""};
  const auto of_line = [&](const std::string& cast) {
    return read_cast(line, R"({"ticket": 4, "casts": [)" + cast + "]}");
  };
  const auto touch = of_line(R"({"status": "touch", "fraction": 0.25, "normal": [0, 0, 1]})");
  ASSERT_TRUE(touch);
  EXPECT_EQ(touch->status, TS_CAST_TOUCH);
  EXPECT_EQ(touch->fraction, 0.25);
  EXPECT_EQ(touch->normal[2], 1);
  EXPECT_EQ(of_line(R"({"status": "never"})")->status, TS_CAST_NEVER);
  EXPECT_EQ(of_line(R"({"status": "unsupported"})")->status, TS_CAST_UNSUPPORTED);
  EXPECT_FALSE(of_line(R"({"status": "failed"})"));
  EXPECT_THROW(of_line(R"({"status": "late"})"), Garbage);
  EXPECT_THROW(of_line(R"({"status": "touch", "fraction": 0.25})"), Garbage);
  EXPECT_THROW(of_line("5"), Garbage);

  std::string bytes(frame.answer_size(), '\0');
  const std::uint32_t head[] = {60, 5, 4, 0, 1, 0, 1};
  std::memcpy(bytes.data(), head, sizeof head);
  EXPECT_EQ(read_cast(frame, bytes)->status, TS_CAST_NEVER);
  bytes[24] = 3;
  EXPECT_FALSE(read_cast(frame, bytes));
  bytes[24] = 4;
  EXPECT_THROW(read_cast(frame, bytes), Garbage);
}

TEST(Messages, AHundredThousandBrokenOnesAreReadOrRefused) {
  const Request in_frames{Format::frames, Operation::query, 4, 1, ""},
      prepares{Format::lines, Operation::prepare, 4, 1, ""},
      times{Format::lines, Operation::time, 4, 1, ""};
  std::string frame(in_frames.answer_size(), '\0');
  const std::uint32_t head[] = {static_cast<std::uint32_t>(frame.size() - 4), 2, 4, 0, 1, 0};
  std::memcpy(frame.data(), head, sizeof head);
  const std::string line =
      R"({"ticket": 4, "answers": [{"status": "contact", "signed_distance": 1, "normal": [0, 0, 1],)"
      R"( "points": [{"position": [1, 2, 3], "normal": [0, 0, 1], "depth": 5}]}]})";
  ASSERT_EQ(read_answer(in_frames, frame).status, TS_CONTACT);
  ASSERT_EQ(read_answer(a_query, line).points[0].depth, 5);

  Fuzz fuzz(1);
  int read = 0, refused = 0;
  const auto attempt = [&](const std::function<void()>& reader) {
    try {
      reader();
      ++read;
    } catch (const Garbage& garbage) {
      EXPECT_STRNE(garbage.what(), "");
      ++refused;
    }
  };
  for (int i = 0; i < 20000; ++i) {
    const std::string bytes = fuzz.mutated(frame), text = fuzz.mutated(line);
    attempt([&] { read_answer(in_frames, bytes); });
    attempt([&] { read_answer(a_query, text); });
    attempt([&] { read_hello(fuzz.mutated(good_hello)); });
    attempt([&] { read_prepared(prepares, fuzz.mutated(R"({"ticket":4,"supported":[true]})")); });
    attempt([&] { read_time(times, fuzz.mutated(R"({"ticket":4,"nanoseconds":12.5})")); });
  }
  EXPECT_EQ(read + refused, 100000);
  EXPECT_GT(read, 2000);
  EXPECT_GT(refused, 50000);
}

}  // namespace
}  // namespace touchstone::messages
