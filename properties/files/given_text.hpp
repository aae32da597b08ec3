#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "reference/invalid_input.hpp"

namespace touchstone {

/// Reads a finite number, "-1.5e-3" or in hexadecimal "0x1.8p-1", to the nearest double; one too
/// small for any is zero. Nothing may stand before or after it, and the locale does not matter.
/// Absent where the text is something else, NaN, infinite, or too large for a double.
std::optional<double> parse_double(std::string_view text);

// How numbers on the command line are read, everywhere alike: a decimal or hexadecimal float as in
// files, or a whole number, of which 1e6 is one too. What is none or out of range is InvalidInput
// that names the option, the text and the range.

struct NumberRange {
  double min, max;
};
/// Range of positive numbers whose products and quotients stay finite.
inline constexpr NumberRange positive_numbers{1e-30, 1e30};

struct CountRange {
  std::uint64_t min, max;
};
/// Seeds.
inline constexpr CountRange all_counts{0, std::numeric_limits<std::uint64_t>::max()};

double read_number(const std::string& option, const std::string& text, NumberRange range);
std::uint64_t read_count(const std::string& option, const std::string& text, CountRange range);

/// The text for one line of a terminal or log: escaped, and at most `max_length` bytes, of which
/// the last are "..." where some were cut. UTF-8 stays whole.
std::string printable(std::string_view text, std::size_t max_length);

/// "1 configuration", "2 configurations", "0 pose classes", "3 bodies": a count and the English
/// noun that it counts, which is given in the singular.
std::string counted(std::uint64_t count, std::string_view noun);

/// "radius is -1: must be positive and finite", printable, whatever a file or command line held.
std::string error_text(const InvalidInput& error);

}  // namespace touchstone
