#include "properties/files/parse_number.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <string>

#include "reference/invalid_input.hpp"

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

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr CountRange to_a_million{1, 1000000};

TEST(NumberOption, CountsAreWrittenInFullOrByPowersOfTen) {
  EXPECT_EQ(read_count("--count", "1000", to_a_million), 1000U);
  EXPECT_EQ(read_count("--count", "0012", to_a_million), 12U);
  EXPECT_EQ(read_count("--count", "1e6", to_a_million), 1000000U);
  EXPECT_EQ(read_count("--count", "1.5E3", to_a_million), 1500U);
  EXPECT_EQ(read_count("--seed", "18446744073709551615", all_counts), UINT64_MAX);
}

TEST(NumberOption, WhatIsNoCountIsRefusedWithTheRange) {
  for (const char* text :
       {"-1", "0", "1000001", "1e30", "1e400", "nan", "inf", "", " 1", "1 ", "0x10", "0x1e3", "1_0",
        "1.5", "1.5e0", "\xd9\xa1", "18446744073709551616"}) {
    EXPECT_THAT([&] { read_count("--count", text, to_a_million); },
                ThrowsMessage<InvalidInput>(AllOf(HasSubstr("--count is \"" + std::string(text)),
                                                  HasSubstr("from 1 to 1000000"))))
        << text;
  }
  // Neighbours of 2^64 and of -1 would be counts if they wrapped round.
  EXPECT_THROW(read_count("--seed", "-1", all_counts), InvalidInput);
  EXPECT_THROW(read_count("--seed", "1e19", all_counts), InvalidInput);  // not exact as a double
}

TEST(NumberOption, NumbersAreThoseOfFilesWithinTheRange) {
  EXPECT_EQ(read_number("--width", "0x1p-4", positive_numbers), 0.0625);
  EXPECT_EQ(read_number("--width", "1e-30", positive_numbers), 1e-30);
  for (const char* text : {"0", "-1", "1e31", "1e400", "nan", "inf", "", " 1", "0x", "1,5", "1z"}) {
    EXPECT_THAT(
        [&] { read_number("--width", text, positive_numbers); },
        ThrowsMessage<InvalidInput>(AllOf(HasSubstr("--width"), HasSubstr("from 1e-30 to 1e+30"))))
        << text;
  }
}

}  // namespace
}  // namespace touchstone
