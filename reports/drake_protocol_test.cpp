#include <gtest/gtest.h>
#include <map>

#include "oracle/truth.hpp"
#include "reports/make_report.hpp"
#include "reports/small_report_test.hpp"

namespace touchstone {
namespace {

/// Poses some 26 m from the origin, rounded to doubles.
constexpr double rounding = 26 * 0x1p-50;

TEST(DrakeProtocol, EveryPairIsTwoMillimetresDeep) {
  for (const Pair pair : all_pairs) {
    for (const DrakeCase& c : drake_cases(pair)) {
      EXPECT_EQ(pair_of(c.configuration), pair);
      EXPECT_NEAR(oracle::truth(c.configuration).signed_distance.midpoint(), -2e-3, rounding)
          << pair_name(pair) << ": " << c.description;
    }
  }
}

TEST(DrakeProtocol, HasDrakesNumberOfPoses) {
  // Two worlds; an edge or a vertex meets no other edge or vertex.
  EXPECT_EQ(drake_cases(Pair::plane).size(), 2u * 3);
  EXPECT_EQ(drake_cases(Pair::sphere).size(), 2u * 6);
  EXPECT_EQ(drake_cases(Pair::capsule).size(), 2u * 6);
  EXPECT_EQ(drake_cases(Pair::cylinder).size(), 2u * 8 * 2);
  EXPECT_EQ(drake_cases(Pair::box).size(), 2u * 7);
}

TEST(DrakeProtocol, ReportsTheWorstErrorAndItsPose) {
  Campaign campaign{.pairs = {Pair::plane, Pair::box},
                    .candidates = find_candidates({"reference", "bullet"})};
  auto candidates = start(campaign.candidates, campaign.bar.threshold, campaign.limits);
  const DrakeProtocol protocol = drake_protocol(campaign, candidates);
  ASSERT_EQ(protocol.results.size(), 4u);
  EXPECT_EQ(protocol.pairs[1].penetration, 1e-3);
  const DrakeProtocol::Result& ours = protocol.results[2];
  EXPECT_EQ(ours.candidate, "reference");
  EXPECT_EQ(ours.outcomes, (std::map<Outcome, std::uint64_t>{{Outcome::agree, 14}}));
  EXPECT_LT(ours.max_error, rounding);
  // Bullet rounds edges by its margin: more than Drake's published error, less than its margin.
  const DrakeProtocol::Result& bullet = protocol.results[3];
  EXPECT_GT(bullet.max_error, 1e-5);
  EXPECT_LT(bullet.max_error, 0.04);
  EXPECT_LT(bullet.worst, protocol.pairs[1].configurations.size());
}

}  // namespace
}  // namespace touchstone
