#pragma once

#include <cstdint>
#include <limits>
#include <string>

namespace touchstone {

// How numbers on the command line are read, everywhere alike: a decimal or hexadecimal float as in
// files, or a whole number, of which 1e6 is one too. What is none or out of range is InvalidInput
// that names the option, the text and the range.

struct NumberRange {
  double min, max;
};
/// Of what must be positive. The ends leave products and quotients finite.
inline constexpr NumberRange positive_numbers{1e-30, 1e30};

struct CountRange {
  std::uint64_t min, max;
};
/// Seeds.
inline constexpr CountRange all_counts{0, std::numeric_limits<std::uint64_t>::max()};

double read_number(const std::string& option, const std::string& text, NumberRange range);
std::uint64_t read_count(const std::string& option, const std::string& text, CountRange range);

}  // namespace touchstone
