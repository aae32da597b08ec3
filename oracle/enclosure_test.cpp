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

}  // namespace
}  // namespace touchstone::oracle
