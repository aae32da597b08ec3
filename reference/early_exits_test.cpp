// Where a search ends early it rests on a proof (proofs.md, "Where a search ends early"). Each test
// draws pairs of cylinders that attack one of them: it held of most, and was false of some.
//
// TOUCHSTONE_COUNT times a hundred and more pairs are drawn of each kind; by default 100.
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <string>

#include "oracle/truth.hpp"
#include "reference/contact_of.hpp"
#include "reference/rounding_made_test.hpp"

namespace touchstone {
namespace {

std::uint64_t count() { return tried_of_each(100); }

void expect_the_truth(const Configuration& c, std::uint64_t index) {
  const oracle::Truth truth = oracle::truth(c);
  const double sigma = truth.signed_distance.midpoint(), rounding = promised * scale_of(c);
  const SignedDistance answer = signed_distance(c);
  EXPECT_NEAR(answer.value, sigma, rounding) << index;
  EXPECT_LE(oracle::normal_regret(c, truth, answer.normal), rounding) << index;
  EXPECT_NEAR(certified_distance(c).value, sigma, rounding) << index;
}

/// Against `certified_distance`, which takes no early exit.
void expect_no_short_cut_is_wrong(const Configuration& c, std::uint64_t index) {
  const double sigma = certified_distance(c).value, rounding = promised * scale_of(c);
  EXPECT_NEAR(signed_distance(c).value, sigma, rounding) << index;
  for (const double threshold : {0.0, 0.9 * sigma, 1.1 * sigma}) {
    if (std::abs(sigma - threshold) <= rounding) continue;
    EXPECT_EQ(contact(c, threshold).points().empty(), sigma > threshold) << index;
  }
  if (std::abs(sigma) > rounding) {
    EXPECT_EQ(overlaps(c), sigma < 0) << index;
  }
}

// The point of a cap that faces the other body was looked for in the direction of the product of
// the axes, and as far off as that is long; of axes that are parallel but for rounding, that is
// noise. A point that was not on the rim at all proved a cap the best of bodies beyond each other's
// cap and side, up to 3e-3 of the size too near.
TEST(EarlyExits, AreRightOfWhatRoundingMakes) {
  for (std::uint64_t i = 0; i < 500 * count(); ++i) {
    const Configuration c = RoundingMade(i).arrangement();
    expect_no_short_cut_is_wrong(c, i);
    if (i % 1000 == 0) expect_the_truth(c, i);
    expect_no_short_cut_is_wrong(RoundingMade(i).diagonal(), i);
  }
}

// Along a normal that is the coin's own axis but for rounding every point of its cap is the
// furthest. The one that the formula took lay within the post, the one that faces it beyond its
// end: the cap's normal was taken for the best, up to 5e-6 of the size too deep.
TEST(EarlyExits, AreRightOfPostsAlongACoinsRim) {
  for (std::uint64_t i = 0; i < 5 * count(); ++i) {
    expect_the_truth(RoundingMade(i).post_along_rim(), i);
  }
}

// Bounds on arcs fail where the gap is flat, and the search gave up after 20,000 samples with most
// of the rim left: one in four was wrong, by up to 1e-8 of the size.
TEST(EarlyExits, AreRightOfEqualCoinsThroughEachOthersCentres) {
  for (std::uint64_t i = 0; i < 2 * count(); ++i) {
    expect_the_truth(RoundingMade(i).equal_coins(), i);
  }
}

// Sines next to one, rounded down on one side and up on the other, left an empty range of normals:
// up to 1e-11 of the size too near.
TEST(EarlyExits, AreRightOfNeedlesOverAFarLargerRim) {
  for (std::uint64_t i = 0; i < 200 * count(); ++i) {
    expect_no_short_cut_is_wrong(RoundingMade(i).needle_over_rim(), i);
  }
}

// The error of a certified distance is within its bound, however close to a tie: each generator
// makes the poses in which a search hardly sees the difference. README.md has the rates.
TEST(CertifiedDistance, BoundsHoldOfWhatAttacksProofs) {
  const struct {
    const char* name;
    Configuration (RoundingMade::*make)();
    double min_proven_part;
  } generators[] = {{"arrangement", &RoundingMade::arrangement, 1},
                    {"diagonal", &RoundingMade::diagonal, 1},
                    {"post_along_rim", &RoundingMade::post_along_rim, 0.7},
                    {"equal_coins", &RoundingMade::equal_coins, 0.7},
                    {"needle_over_rim", &RoundingMade::needle_over_rim, 1}};
  for (const auto& generator : generators) {
    double largest_bound = 0;
    std::uint64_t proven = 0;
    for (std::uint64_t i = 0; i < count(); ++i) {
      RoundingMade random(i);
      const Configuration c = (random.*generator.make)();
      const CertifiedDistance certified = certified_distance(c);
      const double sigma = oracle::truth(c, 1e-20).signed_distance.midpoint();
      EXPECT_LE(std::abs(certified.value - sigma), certified.error_bound)
          << generator.name << " " << i;
      const double bound = certified.error_bound / scale_of(c);
      proven += bound <= promised;
      largest_bound = std::max(largest_bound, bound);
    }
    const double share = static_cast<double>(proven) / static_cast<double>(count());
    EXPECT_GE(share, generator.min_proven_part) << generator.name;
    std::printf("%s: proven %.2f%%, largest bound %.1g\n", generator.name, 100 * share,
                largest_bound);
  }
}

}  // namespace
}  // namespace touchstone
