#include "properties/files/parse_double.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <string>

namespace touchstone {
namespace {

TEST(ParseDouble, ReadsDecimalsAndHexadecimalFloats) {
  EXPECT_EQ(parse_double("1.5"), 1.5);
  EXPECT_EQ(parse_double("-1.5e-3"), -1.5e-3);
  EXPECT_EQ(parse_double("+2"), 2);
  EXPECT_EQ(parse_double(".5"), 0.5);
  EXPECT_EQ(parse_double("0x1.8p-1"), 0.75);
  EXPECT_EQ(parse_double("-0X1P+4"), -16);
  EXPECT_EQ(parse_double("0x0.0000000000001p-1022"), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(parse_double("5e-324"), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(parse_double("1.7976931348623157e308"), std::numeric_limits<double>::max());
}

TEST(ParseDouble, TakesWhatIsTooSmallForZeroAndRefusesWhatIsTooLarge) {
  EXPECT_EQ(parse_double("1e-400"), 0);
  EXPECT_EQ(parse_double("0x1p-2000"), 0);
  EXPECT_TRUE(std::signbit(*parse_double("-1e-400")));
  for (const char* text :
       {"1e309", "-1e400", "0x1p1024", "inf", "-inf", "nan", "NaN(1)", "infinity"}) {
    EXPECT_FALSE(parse_double(text)) << text;
  }
}

TEST(ParseDouble, RefusesWhateverStandsBesideTheNumber) {
  for (const std::string text :
       {"",    " 1",  "1 ",   "1_0", "1,5",      "0x", "0x1.8p-1z", "0x1p", "1e",  "--1",
        "-+1", "+-1", "0x-1", "1f",  "\xd9\xa1", "e5", ".",         "-",    "\t1", "1\n"}) {
    EXPECT_FALSE(parse_double(text)) << text;
  }
  EXPECT_FALSE(parse_double(std::string_view("1\0", 2)));
  EXPECT_FALSE(parse_double(std::string_view("1\0002", 3)));
}

}  // namespace
}  // namespace touchstone
