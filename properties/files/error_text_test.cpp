#include "properties/files/error_text.hpp"

#include <gtest/gtest.h>

namespace touchstone {
namespace {

TEST(Printable, KeepsWhatIsShortAndHarmless) {
  EXPECT_EQ(printable("µ is 3", 20), "µ is 3");
  EXPECT_EQ(printable(std::string(20, 'x'), 20), std::string(20, 'x'));
}

TEST(Printable, CutsWhatIsLongBetweenCharacters) {
  EXPECT_EQ(printable(std::string(10000, 'x'), 10), "xxxxxxx...");
  EXPECT_EQ(printable("abcdefµµµµ", 10), "abcdef...");  // byte 7 is the middle of a character
}

TEST(Printable, WritesControlCharactersAsDigits) {
  EXPECT_EQ(printable(std::string_view("a\0\x1b[2J\n\x7f", 8), 40), "a\\x00\\x1b[2J\\x0a\\x7f");
}

TEST(ErrorText, CutsEachPart) {
  const std::string text(100000, 'x');
  EXPECT_LT(error_text({text, text, "must be short"}).size(), 400U);
  EXPECT_EQ(error_text({"radius", "-1", "must be positive"}), "radius is -1: must be positive");
}

}  // namespace
}  // namespace touchstone
