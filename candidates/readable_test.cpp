#include "candidates/readable.hpp"

#include <gtest/gtest.h>
#include <string>

#include <nlohmann/json.hpp>

namespace touchstone {
namespace {

TEST(Readable, KeepsTheLettersOfAllLanguages) {
  const std::string text = "µ ≤ 3, Zylinder groß, גליל, цилиндр, 円柱, 🛢";
  EXPECT_EQ(readable(text), text);
  EXPECT_EQ(escaped(text, Printed::one_line), text);
}

TEST(Readable, IsAsLongWithoutWhatIsNotSeen) {
  EXPECT_EQ(readable("a\x1b[2J\nb\x7f"), "a [2J b ");
  EXPECT_EQ(readable("left\u202ethgir"), "left   thgir");
  EXPECT_EQ(readable("ode\u200b, \u2066x\u2069"), "ode   ,    x   ");
}

TEST(Readable, HasAQuestionMarkForEachByteThatIsNoUtf8) {
  // Cut short, overlong, a surrogate, beyond U+10FFFF, a byte that leads nothing.
  EXPECT_EQ(readable("\xe2\x82|\xc0\x80|\xed\xa0\x80|\xf4\x90\x80\x80|\xff"), "??|??|???|????|?");
}

TEST(Escaped, WritesWhatTurnsTheDirectionOrIsNotSeenAsDigits) {
  for (const auto& [text, digits] : {std::pair("\u202e", "\\u202e"), std::pair("\u202a", "\\u202a"),
                                     std::pair("\u2066", "\\u2066"), std::pair("\u2069", "\\u2069"),
                                     std::pair("\u200e", "\\u200e"), std::pair("\u200f", "\\u200f"),
                                     std::pair("\u061c", "\\u061c"), std::pair("\u200b", "\\u200b"),
                                     std::pair("\u00ad", "\\u00ad"), std::pair("\ufeff", "\\ufeff"),
                                     std::pair("\u2028", "\\u2028"), std::pair("\u009b", "\\u009b"),
                                     std::pair("\U000e0041", "\\udb40\\udc41")}) {
    EXPECT_EQ(escaped(text), digits);
    EXPECT_EQ(escaped(text, Printed::one_line), digits);
    EXPECT_EQ(nlohmann::json::parse('"' + escaped(text) + '"'), text);
  }
  EXPECT_EQ(escaped("caf\xe9"), "caf\\xe9");
}

TEST(Escaped, KeepsLinesAndOurColoursButNoOtherControls) {
  EXPECT_EQ(escaped("\x1b[32mgood\x1b[0m\n\tx"), "\x1b[32mgood\x1b[0m\n\tx");
  EXPECT_EQ(escaped("\x1b[2J\r\x1b]0;title\x07\x1b[m"),
            "\\u001b[2J\\u000d\\u001b]0;title\\u0007\\u001b[m");
  EXPECT_EQ(escaped("\x1b[32mgood\n", Printed::one_line), "\\u001b[32mgood\\u000a");
}

}  // namespace
}  // namespace touchstone
