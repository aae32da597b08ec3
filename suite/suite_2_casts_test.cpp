// The casts of touchstone-suite-2: that the committed file is the one that `touchstone export
// --suite-2 casts` writes, that its limits are those of our scores, and that the three readers
// judge by them.
#include "reports/test_data/suite_2_casts.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <set>

#include "oracle/judge/cast_score.hpp"
#include "reports/test_data/small_numbers.hpp"
#include "suite/readers_test.hpp"
#include "suite/touchstone_suite.hpp"

namespace touchstone {
namespace {

using Required = AnswerLimits::Contact;

const std::vector<CastDatum>& casts_made() {
  static const auto all = suite_2_casts();
  return all;
}

std::vector<touchstone_suite::Cast> casts_read() {
  std::istringstream in(unpacked("2-casts"));
  return touchstone_suite::read_casts(in);
}

TEST(SuiteOfCasts, IsWhatExportWritesToTheByte) {
  EXPECT_TRUE(cast_csv(casts_made()) == unpacked("2-casts"));
}

TEST(SuiteOfCasts, IsExactInSinglePrecisionAndHasAllPairsAndOutcomes) {
  std::map<std::string, int> pairs;
  std::set<std::string> outcomes, ids;
  std::set<Required> kinds;
  std::set<Group> groups;
  for (const CastDatum& d : casts_made()) {
    EXPECT_TRUE(is_in_floats(d.cast.configuration)) << d.id;
    EXPECT_EQ(d.cast.sweep.cast<float>().cast<double>(), d.cast.sweep) << d.id;
    ++pairs[pair_name(pair_of(d.cast.configuration))];
    outcomes.insert(status_name(d.truth.status));
    EXPECT_TRUE(ids.insert(d.id).second) << d.id;
    kinds.insert(d.limits.touch);
    groups.insert(d.group);
    // No case is one that anything answers.
    if (d.limits.touch == Required::required) {
      EXPECT_EQ(d.float_limits.touch, Required::required) << d.id;
    }
  }
  EXPECT_EQ(pairs.size(), std::size(all_pairs));
  for (const auto& [pair, count] : pairs) EXPECT_GE(count, 19) << pair;
  EXPECT_THAT(outcomes, testing::ElementsAre("from-start", "never", "touch"));
  EXPECT_EQ(kinds.size(), 3u);
  EXPECT_EQ(groups.size(), 3u);
  EXPECT_TRUE(ids.contains("cylinder-capsule/jolt-2103"));
}

/// The normal of the pose at t.
Vec3 normal_at(const CastDatum& d, double t) {
  return oracle::truth_at(d.cast.configuration, d.cast.sweep, mpq_class(t)).normals.front().n;
}

touchstone_suite::CastAnswer for_the_reader(const Cast& a) {
  return {status_name(a.status), a.fraction, {a.normal.x(), a.normal.y(), a.normal.z()}};
}

TEST(LimitsOfCasts, AreThoseAtWhichScoresChange) {
  const auto cases = casts_read();
  ASSERT_EQ(cases.size(), casts_made().size());
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const CastDatum& d = casts_made()[i];
    const Sweep sweep(d.cast.sweep);
    const auto expect_same = [&](const Cast& answer) {
      const auto outcome = score_cast(d.cast.configuration, sweep, d.truth, answer, Bar()).outcome;
      EXPECT_EQ(verdict(cases[i], for_the_reader(answer)), outcome_name(outcome))
          << d.id << ' ' << answer.fraction;
    };
    expect_same({CastStatus::never, 1, Vec3::UnitZ()});
    // Beyond each limit by what moves A by the tolerance, and within it by a fifth of that: where
    // bodies graze, their distance changes by less, and limits are exact to a thousandth of it.
    const double step = d.limits.tolerance / sweep.translation().norm();
    const double first = d.limits.min_fraction, last = d.limits.max_fraction;
    for (const double t :
         {first - step, first + step / 5, (first + last) / 2, last - step / 5, last + step}) {
      if (t < 0 || t > 1) continue;
      expect_same({CastStatus::touch, t, normal_at(d, t)});
    }
    // At the touch normals whose regret is less and more than the tolerance.
    for (const double angle : {1e-3, 3e-3, 1e-2, 3e-2, 0.1}) {
      if (!d.truth.there) break;
      const Vec3 n = d.truth.there->normals.front().n;
      const Vec3 turned = Eigen::AngleAxisd(angle, n.unitOrthogonal()) * n;
      expect_same({CastStatus::touch, cases[i].fraction, turned});
    }
  }
}

// Answers: those of our own routine, and such as are wrong in a certain way.

struct CastFault {
  const char* verdict;
  Required asked;  ///< of casts of this kind alone
  void (*plant)(Cast& answer, const CastDatum& datum);
};

/// Twice the tolerance, as a fraction.
double two_limits(const CastDatum& d) { return 2 * d.limits.tolerance / d.cast.sweep.norm(); }

const CastFault cast_faults[] = {
    {"late", Required::required,
     [](Cast& a, const CastDatum& d) {
       a.status = CastStatus::touch, a.fraction = d.limits.max_fraction + two_limits(d);
     }},
    {"early", Required::required,
     [](Cast& a, const CastDatum& d) {
       a.status = CastStatus::touch, a.fraction = d.limits.min_fraction - two_limits(d);
     }},
    {"missed", Required::required, [](Cast& a, const CastDatum&) { a.status = CastStatus::never; }},
    {"made-up", Required::forbidden,
     [](Cast& a, const CastDatum&) { a.status = CastStatus::touch, a.fraction = 0.5; }},
    {"made-up", Required::forbidden,
     [](Cast& a, const CastDatum&) { a.status = CastStatus::from_start; }},
    {"wrong-normal", Required::required, [](Cast& a, const CastDatum&) { a.normal = -a.normal; }},
    {"wrong-normal", Required::required, [](Cast& a, const CastDatum&) { a.normal *= 1.01; }},
    {"wrong-normal", Required::required,
     [](Cast& a, const CastDatum&) {
       a.normal = (a.normal + a.normal.unitOrthogonal() / 2).normalized();
     }},
    {"agree", Required::required, [](Cast& a, const CastDatum&) { a.normal.setZero(); }},
    {"not-finite", Required::required,
     [](Cast& a, const CastDatum&) { a.status = CastStatus::touch, a.fraction = NAN; }}};

TEST(ReadersOfCasts, PassOurRoutineAndNameThePlantedFault) {
  const auto cases = casts_read();
  std::string lines;
  std::vector<std::string> expected;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const CastDatum& d = casts_made()[i];
    const Cast own = cast(d.cast.configuration, d.cast.sweep);
    const auto add = [&](const Cast& answer, const char* right) {
      EXPECT_EQ(verdict(cases[i], for_the_reader(answer)), right) << d.id;
      lines += line_of(d.id, for_the_reader(answer));
      expected.emplace_back(right);
    };
    add(own, "agree");
    for (const CastFault& fault : cast_faults) {
      if (fault.asked != d.limits.touch) continue;
      Cast answer = own;
      fault.plant(answer, d);
      add(answer, fault.verdict);
    }
  }
  EXPECT_THAT(verdicts_of_judges(suite_file("2-casts"), lines), testing::Each(expected));
}

/// An answer that is late in double precision by what single precision is allowed.
TEST(ReadersOfCasts, AllowRoutinesInFloatWhatFloatsCost) {
  const auto cases = casts_read();
  std::string lines;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const CastDatum& d = casts_made()[i];
    if (d.limits.touch != Required::required) continue;
    const double t = (d.limits.max_fraction + d.float_limits.max_fraction) / 2;
    const Cast late{CastStatus::touch, t, normal_at(d, t)};
    lines += line_of(d.id, for_the_reader(late));
    EXPECT_EQ(verdict(cases[i], for_the_reader(late)), "late") << d.id;
    EXPECT_EQ(verdict(in_float(cases[i]), for_the_reader(late)), "agree") << d.id;
  }
  expect_right_in_float_alone("2-casts", lines, "late");
}

}  // namespace
}  // namespace touchstone
