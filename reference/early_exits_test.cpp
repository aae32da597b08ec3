// Where a search ends early it rests on a proof (proofs.md, "Where a search ends early"). Each test
// draws pairs of cylinders that attack one of them: it held of most, and was false of some.
//
// TOUCHSTONE_COUNT times a hundred and more pairs are drawn of each kind; by default 100.
#include <cmath>
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

// The search of rims stopped before it had found the best normal of one in two hundred of them, up
// to 8e-7 of the size off, and proved half.
TEST(EarlyExits, AreRightOfCoinsDeepInEachOtherOnNearlyPerpendicularAxes) {
  for (std::uint64_t i = 0; i < count(); ++i) {
    expect_the_truth(RoundingMade(i).deep_coins(), i);
  }
}

}  // namespace
}  // namespace touchstone
