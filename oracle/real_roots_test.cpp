#include "oracle/real_roots.hpp"

#include <gtest/gtest.h>

#include "oracle/root_sum.hpp"

namespace touchstone::oracle {
namespace {

/// denominator · x − numerator
Polynomial root_at(long numerator, long denominator = 1) { return {-numerator, denominator}; }

mpq_class q(long numerator, long denominator = 1) { return {numerator, denominator}; }
Ball q_ball(long numerator, long denominator = 1) { return Ball(q(numerator, denominator)); }

TEST(RealRoots, FindsEachRootOfTheIntervalOnce) {
  const Polynomial p = root_at(1, 3) * root_at(1, 2) * root_at(5) * Polynomial{1, 0, 1};
  auto one = real_roots(p, 0, q(2, 5));
  ASSERT_EQ(one.size(), 1u);
  EXPECT_TRUE(one[0].is(q(1, 3)));
  EXPECT_FALSE(one[0].is(q(1, 2)));
  EXPECT_EQ(real_roots(p, 0, 1).size(), 2u);
  EXPECT_TRUE(real_roots(p, q(-7), q(-1)).empty());
}

TEST(RealRoots, ARootAtAnEndOfTheIntervalCounts) {
  const Polynomial p = root_at(1, 2) * root_at(3);
  for (const auto& [lo, hi] : {std::pair(q(1, 2), q(1)), std::pair(q(0), q(1, 2))}) {
    const auto roots = real_roots(p, lo, hi);
    ASSERT_EQ(roots.size(), 1u);
    EXPECT_TRUE(roots[0].is(q(1, 2)));
  }
}

TEST(RealRoots, AMultipleRootComesOnce) {
  const Polynomial twice = root_at(1, 3) * root_at(1, 3) * root_at(2);
  const auto roots = real_roots(twice, 0, 1);
  ASSERT_EQ(roots.size(), 1u);
  EXPECT_TRUE(roots[0].is(q(1, 3)));
}

TEST(RealRoots, RootsOnlyTwoToTheMinus100ApartAreToldApart) {
  const mpz_class big = mpz_class(1) << 100U;
  const Polynomial p = Polynomial{-1, 3} * Polynomial{mpz_class(-big - 3), mpz_class(3 * big)};
  auto roots = real_roots(p, 0, 1);
  ASSERT_EQ(roots.size(), 2u);
  const WorkingPrecision precision(200);
  EXPECT_LT(roots[0].enclose().upper(), roots[1].enclose().lower());
}

TEST(RealRoots, EncloseAnIrrationalRootAsNarrowlyAsAsked) {
  auto roots = real_roots({-2, 0, 1}, 1, 2);
  ASSERT_EQ(roots.size(), 1u);
  for (const long bits : {64, 256, 1024}) {
    const WorkingPrecision precision(bits);
    const Ball root = roots[0].enclose();
    EXPECT_LE(root.lower() * root.lower(), 2);
    EXPECT_GE(root.upper() * root.upper(), 2);
    EXPECT_LE((root.upper() - root.lower()) * (mpz_class(1) << static_cast<mp_bitcnt_t>(bits)), 4);
  }
}

TEST(RealRoots, CommonRootsAreExact) {
  const Polynomial two{-2, 0, 1};
  const auto root = real_roots(two * root_at(7), 1, 2).at(0);
  EXPECT_TRUE(root.is_root_of(two * root_at(5)));
  EXPECT_TRUE(root.is_root_of({0}));
  EXPECT_FALSE(root.is_root_of(root_at(7)));  // a common root, but not this one
  // √2 to 30 digits is not √2.
  EXPECT_FALSE(root.is_root_of(Polynomial{mpz_class("-1414213562373095048801688724210"),
                                          mpz_class("1000000000000000000000000000000")}));
}

TEST(RootSum, IsZeroOnlyWhereItIs) {
  EXPECT_TRUE(is_root_sum(5, 4, 9));
  EXPECT_TRUE(is_root_sum(3, 9, 0));
  EXPECT_FALSE(is_root_sum(-5, 4, 9));  // its norm is zero too
  EXPECT_FALSE(is_root_sum(1, 4, 9));   // 1 = √9 − √4
  EXPECT_FALSE(is_root_sum(5, 4, 10));
  EXPECT_TRUE(is_root_sum(0, 0, 0));
}

TEST(RootSum, NormVanishesWithTheSum) {
  // x + 3 − √(4x²) − √(x²) has the zeros 3/2 (with these signs) and −3/4.
  const Polynomial norm = root_sum_norm({3, 1}, {0, 0, 4}, {0, 0, 1});
  EXPECT_TRUE(real_roots(root_at(3, 2), 1, 2).at(0).is_root_of(norm));
  EXPECT_FALSE(real_roots(root_at(1, 2), 0, 1).at(0).is_root_of(norm));
  EXPECT_TRUE(has_no_other_zero(q_ball(9, 2), q_ball(9), q_ball(9, 4)));
  EXPECT_FALSE(has_no_other_zero(0, 0, 0));
}

}  // namespace
}  // namespace touchstone::oracle
