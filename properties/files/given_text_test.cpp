#include "properties/files/given_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <string>

#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

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

TEST(Printable, KeepsWhatIsShortAndHarmless) {
  EXPECT_EQ(printable("µ is 3", 20), "µ is 3");
  EXPECT_EQ(printable(std::string(20, 'x'), 20), std::string(20, 'x'));
}

TEST(Printable, CutsWhatIsLongBetweenCharacters) {
  EXPECT_EQ(printable(std::string(10000, 'x'), 10), "xxxxxxx...");
  EXPECT_EQ(printable("abcdefµµµµ", 10), "abcdef...");  // byte 7 is the middle of a character
}

TEST(Printable, WritesControlCharactersAsDigits) {
  EXPECT_EQ(printable(std::string_view("a\0\x1b[2J\n\x7f", 8), 40),
            "a\\u0000\\u001b[2J\\u000a\\u007f");
  EXPECT_EQ(printable("left\u202ethgir", 40), "left\\u202ethgir");
}

TEST(CountedText, HasOneThingInTheSingular) {
  EXPECT_EQ(counted(1, "configuration"), "1 configuration");
  EXPECT_EQ(counted(0, "configuration"), "0 configurations");
  EXPECT_EQ(counted(2, "pose class"), "2 pose classes");
  EXPECT_EQ(counted(3, "body"), "3 bodies");
}

TEST(ErrorText, CutsEachPart) {
  const std::string text(100000, 'x');
  EXPECT_LT(error_text({text, text, "must be short"}).size(), 400U);
  EXPECT_EQ(error_text({"radius", "-1", "must be positive"}), "radius is -1: must be positive");
}

}  // namespace
}  // namespace touchstone
