// Answers that came in a file: what is read of them, what is refused, and their report.
#include "reports/test_data/given_answers.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sstream>

#include <nlohmann/json.hpp>

#include "properties/files/answer_json.hpp"
#include "properties/files/configuration_json.hpp"
#include "reference/invalid_input.hpp"
#include "reports/report_json.hpp"
#include "reports/small_report_test.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::ThrowsMessage;

ReadAnswers read(const std::string& lines, const Wanted& wanted = {},
                 const GivenDescription& description = {"mine", {}, {}}) {
  std::istringstream in(lines);
  return read_answers(in, description, wanted);
}

const std::string id = "cylinder-box/rim-face/1/";

std::string none(const std::string& name) {
  return R"({"id":")" + name + R"(","status":"none"})" + "\n";
}

std::string contact(const std::string& name, const std::string& numbers) {
  return R"({"id":")" + name + R"(","status":"contact",)" + numbers + "}\n";
}

TEST(GivenAnswers, AreInReportOrder) {
  const ReadAnswers r = read(none(id + "7") + none("cylinder-plane/lying/1/0") + none(id + "2"));
  EXPECT_TRUE(r.errors.empty());
  EXPECT_EQ(r.count, 3u);
  ASSERT_EQ(r.answers.cells.size(), 2u);
  EXPECT_EQ(r.answers.cells[0].cell.pair, Pair::plane);
  ASSERT_EQ(r.answers.cells[1].answers.size(), 2u);
  EXPECT_EQ(r.answers.cells[1].answers[0].index, 2u);
  EXPECT_EQ(r.answers.cells[1].answers[1].index, 7u);
}

TEST(GivenAnswers, TheFirstLineSaysWhoseTheyAreUnlessAnOptionDoes) {
  const std::string text = R"({"candidate":"gpu","version":"2","settings":"float"})"
                           "\n" +
                           none(id + "0");
  const Candidate by_line = read(text, {}, {}).answers.candidate;
  EXPECT_EQ(by_line.name + by_line.version + by_line.settings, "gpu2float");
  const Candidate by_option = read(text, {}, {"cpu", {}, "double"}).answers.candidate;
  EXPECT_EQ(by_option.name + by_option.version + by_option.settings, "cpu2double");
  EXPECT_THAT([&] { read(none(id + "0"), {}, {}); },
              ThrowsMessage<InvalidInput>(HasSubstr("--name")));
  EXPECT_THAT(
      [&] {
        read(none(id + "0"), {}, {"a b", {}, {}});
      },
      ThrowsMessage<InvalidInput>(HasSubstr("comma and space")));
  EXPECT_THAT([&] { read(R"({"candidat":"x"})", {}, {}); },
              ThrowsMessage<InvalidInput>(HasSubstr("line 1: candidat")));
}

TEST(GivenAnswers, HaveNumbersThatJsonCannotWrite) {
  const ReadAnswers r =
      read(contact(id + "0", R"("signed_distance":"nan","normal":[0,"inf",1],"points":[])") +
           contact(id + "1", R"("signed_distance":null,"normal":[0,0,"-inf"],"points":[])"));
  const auto& answers = r.answers.cells.at(0).answers;
  EXPECT_TRUE(std::isnan(answers[0].signed_distance));
  EXPECT_EQ(answers[0].normal.y(), INFINITY);
  EXPECT_TRUE(std::isnan(answers[1].signed_distance));
  EXPECT_EQ(answers[1].normal.z(), -INFINITY);
}

TEST(GivenAnswers, PointsWithoutANormalHaveTheAnswers) {
  const ReadAnswers r = read(contact(
      id + "0",
      R"("signed_distance":-1,"normal":[0,1,0],"points":[{"position":[1,2,3],"depth":4}])"));
  const Answer a = r.answers.cells.at(0).answers.at(0).answer();
  EXPECT_EQ(a.status, TS_CONTACT);
  EXPECT_EQ(a.point_count, 1);
  EXPECT_EQ(a.points[0].normal[1], 1);
  EXPECT_EQ(a.points[0].position[2], 3);
  EXPECT_EQ(a.points[0].depth, 4);
}

TEST(GivenAnswers, EveryBadLineIsToldAndTheOthersCount) {
  struct Row {
    std::string line, error;
  };
  const Row rows[] = {
      {none(id + "0"), "id is \"" + id + "0\": must be answered once; line 1 did"},
      {"no JSON\n", "line is no JSON"},
      {"[1]\n", "line is [1]: must be an object"},
      {R"({"status":"none"})"
       "\n",
       "id is missing"},
      {R"({"id":[7],"status":"none"})"
       "\n",
       "id is [7]: must be a string, a number, true, false or null"},
      {R"({"id":7,"status":"none"})"
       "\n",
       "id is \"7\": must read pair/class/seed/index"},
      {none("c1"), "must read pair/class/seed/index"},
      {none("cylinder-box/rim-fase/1/0"), "rim-face"},
      {none("cylinder-box/rim-face/2/0"), "must have the seed 1"},
      {R"({"id":")" + id +
           R"(1"})"
           "\n",
       "status is missing"},
      {R"({"id":")" + id +
           R"(1","status":"maybe"})"
           "\n",
       "status is \"maybe\""},
      {R"({"id":")" + id +
           R"(1","status":"none","depth":3})"
           "\n",
       "depth is 3: is not known here"},
      {contact(id + "1", R"("normal":[0,0,1],"points":[])"), "signed_distance is missing"},
      {contact(id + "1", R"("signed_distance":"x","normal":[0,0,1],"points":[])"),
       "signed_distance is \"x\": must be"},
      {contact(id + "1", R"("signed_distance":1,"normal":[0,1],"points":[])"), "normal is [0,1]"},
      {contact(id + "1", R"("signed_distance":1,"normal":[0,0,1],"points":[{"depth":1}])"),
       "points[0].position is missing"},
      {contact(id + "1", R"("signed_distance":1,"normal":[0,0,1],)"
                         R"("points":[{"position":[0,0,0],"depth":1,"distance":1}])"),
       "points[0].distance is 1: is not known here"},
  };
  std::string text = none(id + "0");
  for (const Row& row : rows) text += row.line;
  text += none(id + "9");
  const ReadAnswers r = read(text);
  EXPECT_EQ(r.count, 2u);
  ASSERT_EQ(r.errors.size(), std::size(rows));
  for (std::size_t i = 0; i < std::size(rows); ++i) {
    EXPECT_EQ(r.errors[i].line, i + 2);
    EXPECT_THAT(r.errors[i].error, HasSubstr(rows[i].error));
  }
}

TEST(GivenAnswers, AConfigurationHasOneAnswerWhateverItsClassIsCalled) {
  const ReadAnswers r = read(none("cylinder-box/side-on-face+tilted-1e-6+turned/1/0") +
                             none("cylinder-box/side-on-face+turned+tilted-1e-6/1/0"));
  EXPECT_EQ(r.count, 1u);
  ASSERT_EQ(r.errors.size(), 1u);
  EXPECT_THAT(r.errors[0].error, HasSubstr("line 1 did"));
}

TEST(GivenAnswers, TellsWhatIsMissingAndWhatWasNotAskedFor) {
  const std::vector<Identity> wanted = {{Pair::box, "rim-face", 1, 0},
                                        {Pair::box, "rim-face", 1, 1}};
  const ReadAnswers r = read(none(id + "1") + none(id + "2"), {nullptr, wanted});
  EXPECT_EQ(r.count, 1u);
  ASSERT_EQ(r.errors.size(), 2u);
  EXPECT_THAT(r.errors[0].error, HasSubstr("of the configurations that were asked for"));
  EXPECT_EQ(r.errors[1].line, 0u);
  EXPECT_THAT(r.errors[1].error, HasSubstr("missing for 1 configuration, as " + id + "0"));
}

// One configuration, with either body first.
const std::string can_on_box =
    R"({"id":"p1","a":{"shape":"cylinder","radius":0.5,"half_length":1},)"
    R"("pose_a":{"position":[0,0,1.9]},"b":{"shape":"box","half_extents":[1,1,1]}})"
    "\n"
    R"({"id":"p2","b":{"shape":"cylinder","radius":0.5,"half_length":1},)"
    R"("pose_b":{"position":[0,0,1.9]},"a":{"shape":"box","half_extents":[1,1,1]}})"
    "\n";

std::string depth_0_1(const std::string& name, const std::string& normal) {
  return contact(name, R"("signed_distance":-0.1,"normal":)" + normal +
                           R"(,"points":[{"position":[0,0,0.95],"depth":0.1}])");
}

Report report_of(const ReadAnswers& read_ones, unsigned workers = 2) {
  return report_of(read_ones.answers, read_ones.seed, Bar(), workers, "x");
}

TEST(GivenConfigurations, AreScoredWithEitherBodyFirst) {
  std::istringstream in(can_on_box);
  const ConfigurationFile file(in);
  const ReadAnswers r = read(depth_0_1("p1", "[0,0,1]") + depth_0_1("p2", "[0,0,-1]"), {&file, {}});
  EXPECT_TRUE(r.errors.empty());
  const Report report = report_of(r);
  ASSERT_EQ(report.results.size(), 1u);
  EXPECT_EQ(report.results[0].pose_class, "given");
  ASSERT_EQ(report.summary.size(), 1u);
  EXPECT_EQ(report.summary[0].pose_class, "given");  // nobody has recorded them
  EXPECT_EQ(report.results[0].statistics.of(Outcome::agree), 2u);
}

TEST(GivenConfigurations, AreNamedInTheReportByTheirIdAndReplayedByTheirNumbers) {
  std::istringstream in(can_on_box);
  const ConfigurationFile file(in);
  const ReadAnswers r = read(none("p2") + depth_0_1("p1", "[0,0,1]"), {&file, {}});
  const Report report = report_of(r);
  const Examination& worst = report.worst.at(0).examination;
  EXPECT_EQ(worst.id, "p2");
  EXPECT_EQ(report.worst[0].group, "given");
  EXPECT_THAT(worst.replay, HasSubstr("replay -"));
  const auto start = worst.replay.find('{'), end = worst.replay.rfind('}');
  EXPECT_EQ(to_hex_json(configuration_from_text(worst.replay.substr(start, end - start + 1), "it")),
            to_hex_json(worst.configuration));
  EXPECT_FALSE(report.results[0].worst_index) << "there is no such identity";
}

TEST(GivenConfigurations, HaveIdsThatDifferAndAnswersToAll) {
  std::istringstream twice(can_on_box + can_on_box);
  EXPECT_THAT([&] { ConfigurationFile file(twice); },
              ThrowsMessage<InvalidInput>(HasSubstr("line 3: id")));
  std::istringstream in(can_on_box);
  const ConfigurationFile file(in);
  const ReadAnswers r = read(none("p1") + none("p3"), {&file, {}});
  ASSERT_EQ(r.errors.size(), 2u);
  EXPECT_THAT(r.errors[0].error, HasSubstr("an id of the configurations' file"));
  EXPECT_THAT(r.errors[1].error, HasSubstr("as p2"));
}

// Whatever `solve` takes and gives back names a configuration here, too.
TEST(GivenConfigurations, MayHaveAnyScalarAsId) {
  const auto named = [](std::string lines, const std::string& id) {
    const std::string first = R"("id":"p1")";
    return lines.replace(lines.find(first), first.size(), R"("id":)" + id);
  };
  for (const char* id : {"0", "-7", "1.5", "18446744073709551615", "\"0\"", "true", "null"}) {
    std::istringstream in(named(can_on_box, id));
    const ConfigurationFile file(in);
    const ReadAnswers r =
        read(named(depth_0_1("p1", "[0,0,1]"), id) + depth_0_1("p2", "[0,0,-1]"), {&file, {}});
    EXPECT_TRUE(r.errors.empty()) << id << ": " << r.errors[0].error;
    EXPECT_EQ(r.count, 2u) << id;
  }
  std::istringstream in(named(can_on_box, "[0]"));
  EXPECT_THAT([&] { ConfigurationFile file(in); },
              ThrowsMessage<InvalidInput>(
                  HasSubstr("line 1: id is [0]: must be a string, a number, true")));
}

TEST(ReportOfGivenAnswers, TellsItsConfigurationsFromOthers) {
  const auto digest = [](const std::string& lines, const Wanted& wanted = {}) {
    return report_of(read(lines, wanted)).classes.at(0).digest;
  };
  EXPECT_EQ(digest(none(id + "1") + none(id + "0")), "") << "the first of the class";
  const std::string others = digest(none(id + "1") + none(id + "2"));
  EXPECT_EQ(others, digest(none(id + "2") + none(id + "1")));
  EXPECT_NE(others, digest(none(id + "1") + none(id + "3")));
  EXPECT_NE(others, digest(none(id + "1")));
  const auto of_file = [&](const std::string& lines) {
    std::istringstream in(lines);
    const ConfigurationFile file(in);
    return digest(none("p1") + none("p2"), {&file, {}});
  };
  std::string moved = can_on_box;
  const std::size_t digit = moved.find("1.9");
  ASSERT_NE(digit, moved.npos) << moved;
  moved.replace(digit, 3, "1.8");
  EXPECT_EQ(of_file(can_on_box), of_file(can_on_box));
  EXPECT_NE(of_file(can_on_box), of_file(moved));
}

TEST(ReportOfGivenAnswers, IsThatOfTheCandidateThatGaveThem) {
  Campaign campaign{
      .pairs = {Pair::capsule, Pair::box},
      .classes = {"general-shallow", "side-on-face", "touching", "side-on-face+turned"},
      .candidates = find_candidates({"bullet"}),
      .count = 5,
      .seed = 4};
  std::string lines;
  auto processes = start(campaign.candidates, 0);
  for (const PoseClass& cell : cells(campaign)) {
    for (std::uint64_t i = campaign.count; i-- > 0;) {
      const Identity identity{cell, 4, i};
      const Answer a = processes[0].answer(make_configuration(identity));
      json line = to_json(a, Score());
      line.erase("score");
      line["id"] = to_string(identity);
      lines += line.dump() + '\n';
    }
  }
  const ReadAnswers r = read(lines, {}, {"bullet", "3.24", {}});
  EXPECT_TRUE(r.errors.empty());
  const json asked = to_json(make_report(campaign, "x")), given = to_json(report_of(r, 3));
  json expected = without_times(asked), actual = without_times(given);
  for (json* report : {&expected, &actual}) {
    for (const char* member : {"drake_protocol", "candidates"}) report->erase(member);
    (*report)["completed"].erase("timed_classes");
  }
  for (const auto& [member, value] : actual.items()) {
    EXPECT_TRUE(value == expected.at(member)) << member;
  }
  EXPECT_EQ(given["candidates"][0]["given"], true);
  EXPECT_FALSE(asked["candidates"][0].contains("given"));
}

}  // namespace
}  // namespace touchstone
