#include "oracle/real_roots.hpp"

#include <ctime>
#include <gtest/gtest.h>
#include <random>

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

TEST(RealRoots, ARootJustBeyondTheIntervalIsNotTakenForTheOneInIt) {
  const mpz_class big = mpz_class(1) << 100U;  // both roots are 1/big from the end
  const Polynomial p = Polynomial{mpz_class(1 - big), big} * Polynomial{mpz_class(-1 - big), big};
  auto roots = real_roots(p, 0, 1);
  ASSERT_EQ(roots.size(), 1u);
  for (const long bits : {64, 80, 128, 256}) {
    const WorkingPrecision precision(bits);
    const Ball root = roots[0].enclose();
    const mpq_class exact(big - 1, big);
    EXPECT_LE(root.lower(), exact);
    EXPECT_GE(root.upper(), exact);
  }
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

mpz_class power_of_two(unsigned long bits) { return mpz_class(1) << bits; }

/// The polynomial whose root that number is.
Polynomial root_at(const mpq_class& x) { return {mpz_class(-x.get_num()), x.get_den()}; }

/// (x − x0)² + radius²: a pair of complex roots.
Polynomial complex_pair(const mpq_class& x0, const mpq_class& radius) {
  const mpz_class m = lcm(x0.get_den(), radius.get_den());
  const mpz_class x = mpz_class(x0 * m), r = mpz_class(radius * m);
  return {mpz_class(x * x + r * r), mpz_class(-2 * x * m), mpz_class(m * m)};
}

void expect_each_isolated(const Polynomial& p, const std::vector<mpq_class>& roots,
                          const mpq_class& lo, const mpq_class& hi) {
  const auto found = isolate_roots(p, lo, hi);
  ASSERT_EQ(found.size(), roots.size());
  for (std::size_t i = 0; i < roots.size(); ++i) {
    EXPECT_LT(found[i].lo, roots[i]);
    EXPECT_GT(found[i].hi, roots[i]);
    EXPECT_NE(sign_at(p, found[i].lo), 0);
    EXPECT_NE(sign_at(p, found[i].hi), 0);
    if (i > 0) {
      EXPECT_LE(found[i - 1].hi, found[i].lo);
    }
  }
}

TEST(RootIsolation, TellsClustersApartHoweverNarrow) {
  for (const unsigned long bits : {5UL, 60UL, 700UL, 3000UL}) {
    SCOPED_TRACE(bits);
    const mpq_class e(mpz_class(1), power_of_two(bits)), third(1, 3);
    expect_each_isolated(root_at(third) * root_at(third + e), {third, third + e}, -1, 1);
    expect_each_isolated(root_at(-e) * root_at(0) * root_at(e), {-e, 0, e}, -1, 1);
    expect_each_isolated(root_at(third - e) * root_at(third) * root_at(third + e) * root_at(e),
                         {e, third - e, third, third + e}, -1, 1);
    // Clusters at both ends, a cluster in a cluster.
    expect_each_isolated(root_at(e) * root_at(2 * e) * root_at(1 - e) * root_at(1 - 2 * e),
                         {e, 2 * e, 1 - 2 * e, 1 - e}, 0, 1);
    expect_each_isolated(root_at(third) * root_at(third + e * e) * root_at(third + e),
                         {third, third + e * e, third + e}, 0, 1);
  }
}

TEST(RootIsolation, IsNotMisledByComplexRootsNearTheLine) {
  for (const unsigned long bits : {5UL, 60UL, 700UL}) {
    SCOPED_TRACE(bits);
    const mpq_class e(mpz_class(1), power_of_two(bits)), third(1, 3);
    expect_each_isolated(complex_pair(third, e), {}, -1, 1);
    expect_each_isolated(complex_pair(third, e) * root_at(third + e * e), {third + e * e}, -1, 1);
    expect_each_isolated(complex_pair(third, e) * root_at(third + e) * root_at(third - e),
                         {third - e, third + e}, -1, 1);
  }
}

TEST(RootIsolation, FindsAllRootsOfRandomProducts) {
  std::mt19937_64 random(5);
  const auto below = [&](std::uint64_t n) { return static_cast<long>(random() % n); };
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    std::vector<mpq_class> roots;
    Polynomial p{1};
    for (long k = 1 + below(5); k > 0; --k) {
      mpq_class root(mpz_class(1 + below(999)), mpz_class(1000 + below(9)));
      root.canonicalize();
      if (!roots.empty() && below(2)) {
        root = roots.back() + mpq_class(mpz_class(1), power_of_two(20 + random() % 400));
      }
      if (std::find(roots.begin(), roots.end(), root) != roots.end()) continue;
      roots.push_back(root);
      p = p * root_at(root);
    }
    if (below(2)) p = p * complex_pair(roots.back(), mpq_class(1, 1 + below(1000000)));
    std::sort(roots.begin(), roots.end());
    expect_each_isolated(p, roots, 0, 2);
  }
}

// Bisection takes a step for each of the 3000 bits.
TEST(RootIsolation, TakesFewStepsToANarrowCluster) {
  const mpq_class e(mpz_class(1), power_of_two(3000)), third(1, 3);
  const Polynomial p = root_at(third) * root_at(third + e) * root_at(third + 2 * e) *
                       complex_pair(third, e) * root_at(2) * complex_pair(5, 1);
  const auto seconds_of = [](const auto& work) {
    const std::clock_t start = std::clock();
    work();
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  };
  constexpr int repetitions = 20;
  const double once = seconds_of([&] {
    for (int i = 0; i < repetitions; ++i)
      EXPECT_EQ(sign_variations(p, third - e, third + 3 * e), 5);
  });
  // Halving would look at 3000 pieces, each of them at about this cost.
  EXPECT_LT(seconds_of([&] { EXPECT_EQ(isolate_roots(p, -1, 1).size(), 3u); }),
            500 * once / repetitions);
}

TEST(RootIsolation, ASquareFreePartHasEachRootOnce) {
  const Polynomial p = Polynomial{-1, 2} * Polynomial{-1, 2} * Polynomial{3, 5};
  EXPECT_EQ(square_free(p), (Polynomial{-1, 2} * Polynomial{3, 5}));
  EXPECT_EQ(without_root(square_free(p), mpq_class(1, 2)), (Polynomial{3, 5}));
  EXPECT_EQ(common_divisor(p, Polynomial{7, 0, 1} * Polynomial{-1, 2}), (Polynomial{-1, 2}));
}

}  // namespace

}  // namespace touchstone::oracle
