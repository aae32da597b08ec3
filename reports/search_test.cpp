// Climbs: what they find that sampling does not, and that they find it again.
#include "reports/search.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "candidates/host/candidate_process.hpp"
#include "properties/laws/failure_file.hpp"
#include "reference/invalid_input.hpp"
#include "reports/small_report_test.hpp"

namespace touchstone {
namespace {

const Candidate& planted(const char* name) {
  add_test_plugin("touchstone-sabotage.so");
  return find_candidate(name);
}

/// Two climbs, from sampled poses only, in which nothing is aligned.
Search over_planes() {
  Search s;
  s.pairs = {Pair::plane};
  s.goals = {Goal::distance};
  s.starts.names = {"general-shallow"};
  s.budget = 2 * max_climb;
  return s;
}

SearchResult found(const Candidate& candidate, const Search& s) {
  return search(candidate, s, [](std::uint64_t, std::uint64_t) {});
}

/// How many of as many sampled configurations break the law.
int broken_by_samples(const Candidate& candidate, const Search& s) {
  CandidateProcess process(candidate, s.bar.threshold);
  int count = 0;
  for (std::uint64_t i = 0; i < s.budget; ++i) {
    const auto c = make_configuration({s.pairs[0], s.starts.names[0], s.seed, i});
    const Law* const law[] = {&find_law("agreement")};
    count += broken_in_session(law, c, process, s.bar).front().has_value();
  }
  return count;
}

// The ridge is a billionth wide, but its foot is seen from afar.
TEST(Search, ClimbsToAFaultThatSamplingMisses) {
  Search s = over_planes();
  s.bar.tolerance = 1e-5;
  EXPECT_EQ(broken_by_samples(planted("ridged"), s), 0);
  const SearchResult result = found(planted("ridged"), s);
  ASSERT_EQ(result.failures.size(), 1u);
  EXPECT_EQ(result.failures[0].law, "agreement");
  EXPECT_EQ(result.failures[0].violation.failure, "shallow");
  EXPECT_EQ(result.failures[0].met, 2u);
  EXPECT_GT(result.goals[0].summit->value, 1e3 * result.goals[0].summit->sampled);
}

// No slope leads to the fault: the axis is in the plane to within a billionth.
TEST(Search, StepsToWhereCasesMeet) {
  Search s = over_planes();
  s.bar.tolerance = 1e-9;
  EXPECT_EQ(broken_by_samples(planted("declining"), s), 0);
  EXPECT_EQ(found(planted("declining"), s).failures.size(), 1u);
}

TEST(Search, FindsTheSameWhateverTheWorkers) {
  Search s = over_planes();
  s.bar.tolerance = 1e-5;
  s.goals = {Goal::distance, Goal::normal};
  const nlohmann::json alone = to_json(found(planted("ridged"), s));
  s.workers = 2;
  EXPECT_EQ(to_json(found(planted("ridged"), s)), alone);
  s.seed = 2;
  EXPECT_NE(to_json(found(planted("ridged"), s)), alone);
}

TEST(Search, CountsEvaluationsAndKeepsToTheBudget) {
  Search s = over_planes();
  for (const std::uint64_t budget : {std::uint64_t{1}, max_climb + 7}) {
    s.budget = budget;
    const GoalResult r = found(find_candidate("reference"), s).goals.at(0);
    EXPECT_EQ(r.evaluations, budget);
    EXPECT_EQ(r.climbs, budget == 1 ? 1u : 2u);
    EXPECT_EQ(r.broken, 0u);
  }
}

// A finding is a failure like those of check: simple, and read back by what replays it.
TEST(Search, FindsAreSimplifiedFailures) {
  Search s = over_planes();
  s.bar.tolerance = 1e-5;
  const Failure f = found(planted("ridged"), s).failures.at(0);
  EXPECT_EQ(f.configuration.pose_b.position(), Vec3::Zero());
  CandidateProcess process(planted("ridged"), s.bar.threshold);
  const auto violation = broken(find_law(f.law), f.configuration, process, s.bar);
  ASSERT_TRUE(violation);
  EXPECT_EQ(violation->failure, f.violation.failure);
  const Failure read = failure_from_json(to_json(f));
  EXPECT_EQ(to_json(read), to_json(f));
}

// A crash is the highest place of all, whatever the goal.
TEST(Search, EndsAtACrash) {
  Search s = over_planes();
  s.goals = {Goal::points};
  const SearchResult result = found(planted("misdeed:1"), s);
  EXPECT_TRUE(std::isinf(result.goals[0].summit->value));
  ASSERT_EQ(result.failures.size(), 1u);
  EXPECT_EQ(result.failures[0].law, "answers");
  EXPECT_EQ(result.failures[0].violation.failure, "crashed");
}

TEST(Search, LeavesOutPairsWithoutARoutine) {
  Search s = over_planes();
  EXPECT_TRUE(found(find_candidate("libccd-gjk"), s).goals.empty());
}

TEST(Search, MeasuresTimeInMediansOfWhatIsSampled) {
  Search s = over_planes();
  s.goals = {Goal::time};
  s.budget = 128;
  const Summit slowest = *found(find_candidate("reference"), s).goals.at(0).summit;
  EXPECT_GE(slowest.sampled, 1);
  EXPECT_GE(slowest.value, slowest.sampled);
}

TEST(Search, NamesGoals) {
  for (const Goal goal : all_goals) EXPECT_EQ(parse_goal(goal_name(goal)), goal);
  EXPECT_THROW(parse_goal("depth"), InvalidInput);
}

}  // namespace
}  // namespace touchstone
