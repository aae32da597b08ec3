// That the three readers judge answers as the scores of our reports do: answers of our own routines
// to touchstone-suite-1, and such as are wrong in a certain way.
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <numbers>
#include <sstream>

#include "candidates/candidates.hpp"
#include "properties/files/answer_json.hpp"
#include "reports/test_data/given_answers.hpp"
#include "reports/test_data/test_data.hpp"
#include "suite/readers_test.hpp"
#include "suite/touchstone_suite.hpp"

namespace touchstone {
namespace {

/// Of each pose class of the suite the first configuration, of the everyday ones the first five.
Campaign asked() {
  Campaign campaign = suite_1();
  campaign.count = 1;
  campaign.workers = 2;
  return campaign;
}

const std::vector<TestDatum>& data() {
  static const auto all = [] {
    std::vector<TestDatum> result;
    make_test_data(asked(), [&](const TestDatum& datum) { result.push_back(datum); });
    return result;
  }();
  return all;
}

/// The suite as the reader gives it, by id.
std::map<std::string, touchstone_suite::Case> cases_read() {
  std::istringstream in(unpacked("1"));
  std::map<std::string, touchstone_suite::Case> cases;
  for (const auto& c : touchstone_suite::read(in)) cases[c.id] = c;
  return cases;
}

struct PlantedFault {
  const char* name;
  /// Null where the fault need not show, as where several normals are right.
  const char* verdict;
  void (*plant)(ts_answer& answer, const TestDatum& datum);
};

void set(double (&to)[3], const Vec3& v) {
  for (int i = 0; i < 3; ++i) to[i] = v[i];
}

void shift(ts_answer& a, double distance) {
  a.signed_distance += distance;
  for (int i = 0; i < a.point_count; ++i) a.points[i].depth -= distance;
}

/// Turns the best normal, about the axis that costs more, until its regret is so many limits.
void turn_to_regret(ts_answer& a, const TestDatum& d, double limits) {
  const Vec3 best = d.truth.normals.front().n, e = best.unitOrthogonal();
  const auto turned = [&](const Vec3& axis, double angle) {
    return Vec3(Eigen::AngleAxisd(angle, axis) * best);
  };
  const auto regret = [&](const Vec3& axis, double angle) {
    return oracle::normal_regret(d.configuration, d.truth, turned(axis, angle));
  };
  const Vec3 other = best.cross(e);
  const Vec3& axis = regret(e, 1) > regret(other, 1) ? e : other;
  double low = 0, high = 1;
  while (high - low > 1e-15 * high) {
    const double middle = (low + high) / 2;
    if (middle == low || middle == high) break;
    (regret(axis, middle) < limits * d.limits.max_regret ? low : high) = middle;
  }
  set(a.normal, turned(axis, low));
}

/// On an answer that is a contact where one is required.
const PlantedFault faults[] = {
    {"none", "agree", [](ts_answer&, const TestDatum&) {}},
    {"two limits too shallow", "shallow",
     [](ts_answer& a, const TestDatum& d) { shift(a, 2 * d.limits.max_regret); }},
    {"two limits too deep", "overdeep",
     [](ts_answer& a, const TestDatum& d) { shift(a, -2 * d.limits.max_regret); }},
    {"normal turned to 0.95 limits of regret", "agree",
     [](ts_answer& a, const TestDatum& d) { turn_to_regret(a, d, 0.95); }},
    {"normal turned to 1.05 limits of regret", "wrong-normal",
     [](ts_answer& a, const TestDatum& d) { turn_to_regret(a, d, 1.05); }},
    {"normal turned by 20 degrees", nullptr,
     [](ts_answer& a, const TestDatum&) {
       const Vec3 n(a.normal);
       set(a.normal, Eigen::AngleAxisd(std::numbers::pi / 9, n.unitOrthogonal()) * n);
     }},
    {"normal reversed", nullptr,
     [](ts_answer& a, const TestDatum&) { set(a.normal, -Vec3(a.normal)); }},
    {"normal too long", "wrong-normal",
     [](ts_answer& a, const TestDatum&) { set(a.normal, 1.01 * Vec3(a.normal)); }},
    {"no normal", "wrong-normal",
     [](ts_answer& a, const TestDatum&) { set(a.normal, Vec3::Zero()); }},
    {"missed", "missed", [](ts_answer& a, const TestDatum&) { a.status = TS_NONE; }},
    {"no points", "shallow-points", [](ts_answer& a, const TestDatum&) { a.point_count = 0; }},
    {"points two limits too shallow", "shallow-points",
     [](ts_answer& a, const TestDatum& d) {
       for (int i = 0; i < a.point_count; ++i) {
         a.points[i].depth =
             std::min(a.points[i].depth, -d.limits.max_distance) - d.limits.max_regret;
       }
     }},
    {"a point two limits too deep", "overdeep-points",
     [](ts_answer& a, const TestDatum& d) {
       a.points[0].depth = -d.limits.min_distance + d.limits.max_regret;
     }},
    {"a point beyond the threshold", "phantom-points",
     [](ts_answer& a, const TestDatum& d) {
       ts_point& p = a.points[a.point_count++];
       p = a.points[0];
       p.depth = 2 * d.limits.min_point_depth;
     }},
    {"not finite", "not-finite",
     [](ts_answer& a, const TestDatum&) { a.points[0].position[1] = std::nan(""); }},
    {"infinite", "not-finite",
     [](ts_answer& a, const TestDatum&) { a.signed_distance = -INFINITY; }},
    {"failed", "failed", [](ts_answer& a, const TestDatum&) { a.status = TS_FAILED; }},
    {"unsupported", "unsupported",
     [](ts_answer& a, const TestDatum&) { a.status = TS_UNSUPPORTED; }},
};

/// The suite's verdict has a rule of its own, which never changes: normals are judged against the
/// whole bodies, however large, and points by their depths alone.
std::string verdict_of(const TestDatum& d, const ts_answer& a) {
  const Bar bar = suite_1().bar;
  const Score s = score(d.configuration, d.truth, a, bar);
  const bool is_by_points = s.outcome == Outcome::agree || is_of_points(s.outcome);
  if (is_by_points && s.whole_regret.value_or(0) > bar.tolerance) return "wrong-normal";
  if (s.outcome == Outcome::no_points) {
    return d.limits.contact == AnswerLimits::Contact::required ? "shallow-points" : "agree";
  }
  const bool is_right = agrees(s.outcome) || s.outcome == Outcome::off_body;
  return outcome_name(is_right ? Outcome::agree : s.outcome);
}

ts_answer contact_made_up(const TestDatum& d) {
  ts_answer a{};
  a.status = TS_CONTACT;
  a.signed_distance = -d.limits.max_regret / 2;
  set(a.normal, d.truth.normals.front().n);
  return a;
}

touchstone_suite::Answer for_the_reader(const ts_answer& a) {
  touchstone_suite::Answer result{
      status_name(a.status), a.signed_distance, {a.normal[0], a.normal[1], a.normal[2]}, {}};
  for (int i = 0; i < a.point_count; ++i) {
    const ts_point& p = a.points[i];
    result.points.push_back({p.position[0], p.position[1], p.position[2], p.depth});
  }
  return result;
}

/// An answer to each configuration of the suite, with the faults in turns; where there need not be
/// a contact, our own answer and one that is made up.
struct Answers {
  std::vector<ts_answer> all;
  std::vector<const PlantedFault*> planted;  ///< null: none that is in the list
  std::vector<std::string> verdicts;         ///< by the suite's rule
  std::vector<std::string> outcomes;         ///< by score()
  std::string lines;                         ///< of a file of them
};

const Answers& answers() {
  static const Answers result = [] {
    std::vector<Configuration> configurations;
    for (const TestDatum& d : data()) configurations.push_back(d.configuration);
    const auto own = CandidateProcess(find_candidate("reference"), suite_1().bar.threshold)
                         .answers(configurations);
    Answers made;
    made.lines = R"({"candidate": "planted", "version": "1", "settings": "by verdicts_test.cpp"})"
                 "\n";
    for (std::size_t i = 0, turn = 0; i < data().size(); ++i) {
      const TestDatum& d = data()[i];
      ts_answer a = own[i];
      const PlantedFault* fault = nullptr;
      if (d.limits.contact == AnswerLimits::Contact::required && a.status == TS_CONTACT) {
        fault = &faults[turn++ % std::size(faults)];
        fault->plant(a, d);
      } else if (i % 2 == 0) {
        a = contact_made_up(d);
      }
      made.verdicts.push_back(verdict_of(d, a));
      made.outcomes.emplace_back(
          outcome_name(score(d.configuration, d.truth, a, suite_1().bar).outcome));
      made.lines += line_of(to_string(d.identity), for_the_reader(a));
      made.all.push_back(a);
      made.planted.push_back(fault);
    }
    return made;
  }();
  return result;
}

TEST(Verdicts, OfTheScoreNameThePlantedFault) {
  std::map<std::string, int> seen;
  for (std::size_t i = 0; i < data().size(); ++i) {
    const PlantedFault* const fault = answers().planted[i];
    ++seen[answers().verdicts[i]];
    if (fault && fault->verdict) {
      EXPECT_EQ(answers().verdicts[i], fault->verdict)
          << to_string(data()[i].identity) << ' ' << fault->name;
    } else if (!fault && data()[i].limits.contact == AnswerLimits::Contact::forbidden) {
      EXPECT_EQ(answers().verdicts[i], answers().all[i].status == TS_NONE ? "agree" : "phantom");
    }
  }
  for (const char* verdict :
       {"agree", "missed", "phantom", "shallow", "overdeep", "wrong-normal", "not-finite", "failed",
        "unsupported", "shallow-points", "overdeep-points", "phantom-points"}) {
    EXPECT_GT(seen[verdict], 30) << verdict;
  }
}

TEST(Verdicts, OfTheThreeReadersAreThoseOfTheScore) {
  const auto cases = cases_read();
  const auto& first = cases.begin()->second;
  EXPECT_THAT(right(first), testing::HasSubstr("contact " + first.contact + ", signed distance "));
  EXPECT_THAT(right(first), testing::HasSubstr(", normal "));
  for (std::size_t i = 0; i < data().size(); ++i) {
    const auto& c = cases.at(to_string(data()[i].identity));
    EXPECT_EQ(verdict(c, for_the_reader(answers().all[i])), answers().verdicts[i]) << c.id;
  }
  for (const auto& verdicts : verdicts_of_judges(suite_file("1"), answers().lines)) {
    EXPECT_EQ(verdicts, answers().verdicts);
  }
}

TEST(Verdicts, OfTouchstoneScoreAreThoseOfTheScore) {
  std::istringstream in(answers().lines);
  const ReadAnswers read = read_answers(in, {}, {nullptr, identities(asked())});
  EXPECT_TRUE(read.errors.empty());
  const Report report = report_of(read.answers, read.seed, Bar(), 2, "x");
  using Counts = std::map<std::string, std::uint64_t>;
  std::map<std::string, Counts> expected, reported;
  for (std::size_t i = 0; i < data().size(); ++i) {
    const Identity& id = data()[i].identity;
    ++expected[std::string(pair_name(id.pose_class.pair)) + id.pose_class.name()]
              [answers().outcomes[i]];
  }
  for (const ResultRow& row : report.results) {
    EXPECT_EQ(row.candidate, "planted");
    for (const Outcome o : all_outcomes) {
      if (const auto count = row.statistics.of(o)) {
        reported[row.pair + row.pose_class][outcome_name(o)] = count;
      }
    }
  }
  EXPECT_EQ(reported, expected);
}

}  // namespace
}  // namespace touchstone
