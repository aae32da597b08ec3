#include "oracle/enclosure.hpp"

#include <gtest/gtest.h>

namespace touchstone::oracle {
namespace {

TEST(Decimal, RoundsOutward) {
  const mpq_class third(1, 3);
  EXPECT_EQ(decimal_below(third, 4), "0.3333");
  EXPECT_EQ(decimal_above(third, 4), "0.3334");
  EXPECT_EQ(decimal_below(-third, 4), "-0.3334");
  EXPECT_EQ(decimal_above(-third, 4), "-0.3333");
}

TEST(Decimal, IsExactWhereDigitsSuffice) {
  for (const char* text : {"0", "1", "-2.5", "1024", "0.0078125", "-1.25e-9", "1.5e20"}) {
    const std::string value = text;
    mpq_class exact;
    if (value == "0") exact = 0;
    if (value == "1") exact = 1;
    if (value == "-2.5") exact = mpq_class(-5, 2);
    if (value == "1024") exact = 1024;
    if (value == "0.0078125") exact = mpq_class(1, 128);
    if (value == "-1.25e-9") exact = mpq_class("-125/100000000000");
    if (value == "1.5e20") exact = mpq_class("150000000000000000000");
    exact.canonicalize();
    EXPECT_EQ(decimal_below(exact, 12), value);
    EXPECT_EQ(decimal_above(exact, 12), value);
  }
}

TEST(Decimal, CarriesIntoTheNextPowerOfTen) {
  EXPECT_EQ(decimal_above(mpq_class(9999, 10000), 3), "1");
  EXPECT_EQ(decimal_below(mpq_class(-9999, 10000), 3), "-1");
  EXPECT_EQ(decimal_below(mpq_class(9999, 10000), 3), "0.999");
}

TEST(Enclosure, MidpointAndWidthAreOfItsEnds) {
  const Enclosure e{mpq_class(1, 4), mpq_class(3, 4)};
  EXPECT_EQ(e.midpoint(), 0.5);
  EXPECT_EQ(e.width(), 0.5);
}

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
