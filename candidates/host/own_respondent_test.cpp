#include "candidates/host/own_respondent.hpp"

#include <algorithm>
#include <gtest/gtest.h>

#include "candidates/candidates.hpp"
#include "candidates/host/candidate_process.hpp"
#include "properties/identity.hpp"

namespace touchstone {
namespace {

bool are_same(const ts_point& x, const ts_point& y) {
  return std::ranges::equal(x.position, y.position) && std::ranges::equal(x.normal, y.normal) &&
         x.depth == y.depth;
}

bool are_same(const Answer& x, const Answer& y) {
  if (x.status != y.status || x.point_count != y.point_count) return false;
  for (int i = 0; i < x.point_count; ++i) {
    if (!are_same(x.points[i], y.points[i])) return false;
  }
  return x.signed_distance == y.signed_distance && std::ranges::equal(x.normal, y.normal) &&
         x.model_distance == y.model_distance && x.reason == y.reason;
}

TEST(OwnRespondent, AnswersAsASessionDoes) {
  std::size_t own = 0, contacts = 0;
  for (const Candidate* candidate : all_candidates()) {
    if (!is_own(*candidate)) continue;
    ++own;
    CandidateProcess process(*candidate, 0.01), here(asked_here(*candidate), 0.01);
    for (const Pair pair : all_pairs) {
      std::vector<Configuration> asked;
      for (const char* pose_class : {"general+shallow", "touching", "general+deep"}) {
        for (std::uint64_t i = 0; i < 10; ++i) {
          asked.push_back(make_configuration({pair, pose_class, 7, i}));
        }
      }
      const auto expected = process.answers(asked), given = here.answers(asked);
      ASSERT_EQ(given.size(), expected.size());
      for (std::size_t i = 0; i < asked.size(); ++i) {
        EXPECT_TRUE(are_same(given[i], expected[i])) << candidate->name << ' ' << i;
        contacts += given[i].status == TS_CONTACT;
      }
    }
  }
  EXPECT_EQ(own, 7U);
  EXPECT_GT(contacts, 500U);
}

TEST(OwnRespondent, TakesHintsAndThresholdsAsASessionDoes) {
  const Candidate& reference = find_candidate("reference");
  CandidateProcess process(reference, 0), here(asked_here(reference), 0);
  const Vec3 up = Vec3::UnitZ(), down = -up;
  std::vector<Configuration> asked;
  std::vector<const Vec3*> hints;
  std::vector<double> thresholds;
  for (std::uint64_t i = 0; i < 30; ++i) {
    asked.push_back(make_configuration({Pair::cylinder, "parallel", 3, i}));
    hints.push_back(i % 3 == 0 ? nullptr : i % 3 == 1 ? &up : &down);
    thresholds.push_back(0.1 * static_cast<double>(i % 4));
  }
  const auto expected = process.answer(asked, hints, thresholds);
  const auto given = here.answer(asked, hints, thresholds);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    EXPECT_TRUE(are_same(given[i], expected[i])) << i;
  }
}

TEST(OwnRespondent, IsNotForEngines) {
  for (const char* name : {"bullet", "ode", "fcl", "mujoco", "bullet-hull:16"}) {
    EXPECT_FALSE(is_own(find_candidate(name))) << name;
  }
  Candidate added = find_candidate("reference");
  added.added = Added{"--load", "touchstone-reference.so"};
  EXPECT_FALSE(is_own(added));
}

}  // namespace
}  // namespace touchstone
