// Each law of casts finds the fault that it is there for, and none of our own routine.
#include "properties/laws/cast_laws.hpp"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "properties/simplify.hpp"

namespace touchstone {
namespace {

using Fault = Cast (*)(const CastQuestion&, Cast);

Cast no_fault(const CastQuestion&, Cast right) { return right; }

/// All laws, on everyday casts.
std::vector<LawResult> everyday_results(std::vector<Pair> pairs, const AnswersCasts& answers) {
  CheckOptions options;
  options.pairs = std::move(pairs);
  options.groups = {Group::everyday};
  options.count = 40;
  std::vector<const CastLaw*> laws;
  for (const CastLaw& law : all_cast_laws()) laws.push_back(&law);
  return check_casts(answers, laws, options);
}

/// How often a routine with a fault breaks each law by each name, on casts of two pairs.
std::map<std::string, std::uint64_t> breaches(Fault fault) {
  const auto answer = [&](std::span<const CastQuestion> questions) {
    std::vector<std::optional<CastAnswer>> answers;
    for (const CastQuestion& q : questions) {
      answers.push_back(CastAnswer{fault(q, cast(q.configuration, q.sweep))});
    }
    return answers;
  };
  std::map<std::string, std::uint64_t> result;
  for (const LawResult& r : everyday_results({Pair::cylinder, Pair::box}, answer)) {
    EXPECT_GT(r.tried, 30U) << r.law;
    EXPECT_EQ(r.failures.size(), r.counts.size()) << "one of each name";
    for (const auto& [failure, count] : r.counts) result[r.law + ' ' + failure] += count;
    for (const Failure& f : r.failures) {
      EXPECT_TRUE(is_cast_identity(f.identity)) << f.identity;
      const CastQuestion simple{f.configuration, f.sweep.value()};
      EXPECT_LT(complexity(simple), complexity(make_cast(parse_cast_identity(f.identity))));
      const auto violation = broken(*find_cast_law(f.law), simple, answer, f.bar);
      EXPECT_TRUE(violation.has_value()) << f.identity;
      if (!violation) continue;
      EXPECT_EQ(violation->failure, f.violation.failure);
    }
  }
  return result;
}

TEST(CastLaws, AreKeptByOurRoutineInTheirOwnRoom) {
  for (const auto& [law, count] : breaches(no_fault)) ADD_FAILURE() << law << ' ' << count;
}

TEST(CastLaws, FindATouchThatStopsShort) {
  const auto found = breaches([](const CastQuestion&, Cast c) {
    if (c.status == CastStatus::touch) c.fraction *= 0.9;
    return c;
  });
  EXPECT_GT(found.at("cast-touch early"), 5U);
}

TEST(CastLaws, FindATouchThatComesLate) {
  const auto found = breaches([](const CastQuestion&, Cast c) {
    if (c.status == CastStatus::touch) c.fraction = std::min(1.0, 1.5 * c.fraction);
    return c;
  });
  EXPECT_GT(found.at("cast-touch late"), 5U);
  EXPECT_GT(found.at("cast-free late"), 5U);
}

TEST(CastLaws, FindWhatPassesThrough) {
  const auto found = breaches([](const CastQuestion&, Cast c) {
    if (c.status == CastStatus::touch && c.fraction > 0.5) c = {CastStatus::never, 1, c.normal};
    return c;
  });
  EXPECT_GT(found.at("cast-free missed"), 5U);
  EXPECT_GT(found.at("cast-length not-invariant"), 5U);
}

TEST(CastLaws, FindStepsOfTheSweep) {
  // As a routine that tries 16 poses on the way: the longer the sweep, the coarser.
  const auto found = breaches([](const CastQuestion&, Cast c) {
    if (c.status == CastStatus::touch) c.fraction = std::ceil(16 * c.fraction) / 16;
    return c;
  });
  EXPECT_GT(found.at("cast-length not-invariant"), 5U);
}

TEST(CastLaws, FindWhatDependsOnTheOrderOfTheBodies) {
  const auto found = breaches([](const CastQuestion& q, Cast c) {
    const auto* b = std::get_if<Cylinder>(&q.configuration.b);
    if (b && q.configuration.a.radius() < b->radius() && c.status == CastStatus::touch) {
      c.fraction *= 0.9;
    }
    return c;
  });
  EXPECT_GT(found.at("cast-exchange not-invariant"), 5U);
  EXPECT_FALSE(found.contains("cast-rotation not-invariant"));
}

TEST(CastLaws, FindWhatDependsOnTheWorldsAxes) {
  const auto found = breaches([](const CastQuestion& q, Cast c) {
    if (q.sweep.x() > 0 && c.status == CastStatus::touch) c.fraction *= 0.9;
    return c;
  });
  EXPECT_GT(found.at("cast-rotation not-invariant"), 5U);
}

TEST(CastLaws, TellOfCastsThatFailAndJudgeTheOthers) {
  const auto answer = [&](std::span<const CastQuestion> questions) {
    std::vector<std::optional<CastAnswer>> answers;
    for (const CastQuestion& q : questions) {
      answers.push_back(q.sweep.x() > 0 ? CastAnswer{{}, "Segmentation fault"}
                                        : CastAnswer{cast(q.configuration, q.sweep)});
    }
    return answers;
  };
  for (const LawResult& r : everyday_results({Pair::box}, answer)) {
    EXPECT_EQ(r.broken > 0, r.law == "cast-answers") << r.law;
    EXPECT_LT(r.broken, r.tried);
    for (const Failure& f : r.failures) {
      EXPECT_EQ(f.violation.failure, "failed");
      EXPECT_EQ(f.violation.detail, "Segmentation fault");
      EXPECT_GT(f.sweep.value().x(), 0);
    }
  }
}

TEST(CastLaws, AreFoundByTheirNames) {
  for (const CastLaw& law : all_cast_laws()) EXPECT_EQ(find_cast_law(law.name), &law);
  EXPECT_EQ(find_cast_law("cast-cast"), nullptr);
}

}  // namespace
}  // namespace touchstone
