#include "cli/number_option.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

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
