#pragma once

#include <optional>
#include <string_view>

namespace touchstone {

/// Reads a finite number, "-1.5e-3" or in hexadecimal "0x1.8p-1", to the nearest double; one too
/// small for any is zero. Nothing may stand before or after it, and the locale does not matter.
/// Absent where the text is something else, NaN, infinite, or too large for a double.
std::optional<double> parse_double(std::string_view text);

}  // namespace touchstone
