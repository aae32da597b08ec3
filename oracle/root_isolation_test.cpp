#include "oracle/root_isolation.hpp"

#include <ctime>
#include <gtest/gtest.h>
#include <random>

#include "oracle/real_roots.hpp"

namespace touchstone::oracle {
namespace {

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
  const std::clock_t start = std::clock();
  EXPECT_EQ(isolate_roots(p, -1, 1).size(), 3u);
  EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 0.25);
}

TEST(RootIsolation, ASquareFreePartHasEachRootOnce) {
  const Polynomial p = Polynomial{-1, 2} * Polynomial{-1, 2} * Polynomial{3, 5};
  EXPECT_EQ(square_free(p), (Polynomial{-1, 2} * Polynomial{3, 5}));
  EXPECT_EQ(without_root(square_free(p), mpq_class(1, 2)), (Polynomial{3, 5}));
  EXPECT_EQ(common_divisor(p, Polynomial{7, 0, 1} * Polynomial{-1, 2}), (Polynomial{-1, 2}));
}

}  // namespace
}  // namespace touchstone::oracle
