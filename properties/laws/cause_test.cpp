// Causes of failures: which features meet, what is known, with what to start.
#include "properties/laws/cause.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>

#include "candidates/candidates.hpp"
#include "properties/identity.hpp"

namespace touchstone {
namespace {

std::string features(Pair pair, const char* pose_class) {
  return meeting_features(make_configuration({pair, pose_class, 1, 0}));
}

TEST(MeetingFeatures, AreThoseThatTheArrangementMakes) {
  EXPECT_EQ(features(Pair::plane, "standing"), "cap-plane");
  EXPECT_EQ(features(Pair::plane, "lying"), "side-plane");
  EXPECT_EQ(features(Pair::box, "side-on-face"), "side-face");
  EXPECT_EQ(features(Pair::box, "cap-on-face-centred"), "cap-face");
  EXPECT_EQ(features(Pair::box, "rim-face"), "rim-face");
  EXPECT_EQ(features(Pair::cylinder, "rim-rim"), "rim-rim");
  EXPECT_EQ(features(Pair::capsule, "cap-end"), "cap-end");
  EXPECT_EQ(features(Pair::sphere, "side"), "side-sphere");
}

TEST(MeetingFeatures, AreThoseOfAnExactPoseTurnedByRounding) {
  EXPECT_EQ(features(Pair::box, "side-on-face+turned"), "side-face");
  EXPECT_EQ(features(Pair::box, "side-on-face+tilted-1e-9"), "side-face");
}

TEST(MeetingFeatures, OfTiedNormalsAreTied) {
  const Configuration ball_in_can{Cylinder(1, 2), Pose(), Sphere(0.1), Pose()};
  EXPECT_EQ(meeting_features(ball_in_can), "tied");
}

CheckOptions options(const std::vector<const char*>& laws) {
  CheckOptions o;
  for (const char* law : laws) o.laws.push_back(&find_law(law));
  o.pairs = {Pair::box};
  o.classes = {"rim-face", "edge-cap", "edge-side"};
  o.count = 3;
  o.by_features = true;
  return o;
}

std::vector<LawResult> failures_of_bullet(const std::vector<const char*>& laws) {
  CandidateProcess bullet(find_candidate("bullet"), 0);
  return check(bullet, options(laws), [](auto, auto) {});
}

TEST(Causes, EachHasOneFailureWithItsOwnFeaturesAndAllAreCounted) {
  const auto results = failures_of_bullet({"agreement"});
  ASSERT_EQ(results.size(), 1u);
  std::set<Cause> causes;
  std::uint64_t met = 0;
  for (const Failure& f : results[0].failures) {
    EXPECT_TRUE(causes.insert(cause_of(f)).second) << to_string(cause_of(f));
    EXPECT_EQ(cause_of(f).features, f.features) << "simplified into something else";
    met += f.met;
  }
  EXPECT_GE(causes.size(), 2u);
  EXPECT_EQ(met, results[0].broken);
}

TEST(Causes, KnownOnesAreNotNew) {
  const auto results = failures_of_bullet({"agreement"});
  std::vector<Failure> known = in_order(results);
  EXPECT_EQ(new_ones(results, known).at(0).broken, 0u);
  EXPECT_TRUE(new_ones(results, known).at(0).failures.empty());
  const Failure missing = known.back();
  known.pop_back();
  const LawResult left = new_ones(results, known).at(0);
  ASSERT_EQ(left.failures.size(), 1u);
  EXPECT_EQ(cause_of(left.failures[0]), cause_of(missing));
  EXPECT_EQ(left.broken, missing.met);
  EXPECT_EQ(left.counts.at(missing.violation.failure), missing.met);
  // Of another law it is another cause.
  for (Failure& f : known) f.law = "points";
  EXPECT_EQ(new_ones(results, known).at(0).broken, results[0].broken);
}

TEST(Causes, StartWithTheFirstLawAndItsMostFrequentOne) {
  const auto all = in_order(failures_of_bullet({"points", "agreement"}));
  ASSERT_GE(all.size(), 2u);
  EXPECT_EQ(all.front().law, "agreement");
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (all[i].law == all[i - 1].law) {
      EXPECT_LE(all[i].met, all[i - 1].met);
    }
  }
}

}  // namespace
}  // namespace touchstone
