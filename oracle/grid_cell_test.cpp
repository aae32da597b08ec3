#include "oracle/grid_cell.hpp"

#include <gtest/gtest.h>

namespace touchstone::oracle {
namespace {

TEST(GridCell, IsTheSameHoweverNarrowlyTheNumberIsKnown) {
  const GridCell cell(1, 0.125);
  const auto wide = cell.around(mpq_class(30, 100), mpq_class(33, 100));
  const auto narrow = cell.around(mpq_class(32, 100), mpq_class(32, 100));
  ASSERT_TRUE(wide && narrow);
  EXPECT_EQ(wide->lo, narrow->lo);
  EXPECT_EQ(wide->hi, narrow->hi);
  EXPECT_LE(narrow->lo, mpq_class(32, 100));
  EXPECT_GE(narrow->hi, mpq_class(32, 100));
  EXPECT_EQ(narrow->hi - narrow->lo, mpq_class(1, 8));
}

TEST(GridCell, IsNoWiderThanAskedFor) {
  const auto cell = GridCell(3, 0.1).around(5, 5);  // 0.3 → 1/4
  ASSERT_TRUE(cell);
  EXPECT_EQ(cell->hi - cell->lo, mpq_class(1, 4));
}

TEST(GridCell, DyadicNumbersAreNeverOnItsBorders) {
  const GridCell cell(1, 0.125);
  for (int i = -64; i <= 64; ++i) {
    if (i == 0) continue;
    const mpq_class x(i, 16), epsilon(1, 1L << 40);
    EXPECT_TRUE(cell.around(x - epsilon, x + epsilon)) << i;
  }
}

TEST(GridCell, NeverReachesZero) {
  const GridCell cell(1, 1);
  for (const mpq_class& x : {mpq_class(1, 1000), mpq_class(-1, 1000)}) {
    const auto around = cell.around(x, x);
    ASSERT_TRUE(around);
    EXPECT_GT(around->lo * around->hi, 0);
    EXPECT_LE(around->lo, x);
    EXPECT_GE(around->hi, x);
  }
  EXPECT_FALSE(cell.around(-1, 1));
  EXPECT_FALSE(cell.around(0, 0));
  EXPECT_EQ(GridCell(3, 1).nearly_zero(10).hi, mpq_class(1, 512));
}

TEST(GridCell, ScalesWithPowersOfTwo) {
  const mpq_class x(-37, 100);
  const auto one = GridCell(1.5, 1e-3).around(x, x),
             eight = GridCell(12, 1e-3).around(8 * x, 8 * x);
  ASSERT_TRUE(one && eight);
  EXPECT_EQ(8 * one->lo, eight->lo);
  EXPECT_EQ(8 * one->hi, eight->hi);
}

}  // namespace
}  // namespace touchstone::oracle
