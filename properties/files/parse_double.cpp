#include "properties/files/parse_double.hpp"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>

namespace touchstone {

std::optional<double> parse_double(std::string_view text) {
  std::string_view rest = text;
  const bool is_negative = rest.starts_with('-');
  if (is_negative || rest.starts_with('+')) rest.remove_prefix(1);
  const bool is_hexadecimal = rest.starts_with("0x") || rest.starts_with("0X");
  if (is_hexadecimal) rest.remove_prefix(2);
  if (rest.starts_with('-')) return std::nullopt;  // from_chars would take a second sign

  double value = 0;
  const char* const end = rest.data() + rest.size();
  const auto [parsed_end, error] =
      std::from_chars(rest.data(), end, value,
                      is_hexadecimal ? std::chars_format::hex : std::chars_format::general);
  if (parsed_end != end) return std::nullopt;
  if (error == std::errc::result_out_of_range) {
    // Too large or too small: from_chars does not say which. The text is known to be a number.
    value = std::strtod((is_hexadecimal ? "0x" + std::string(rest) : std::string(rest)).c_str(),
                        nullptr);
  } else if (error != std::errc()) {
    return std::nullopt;
  }
  if (!std::isfinite(value)) return std::nullopt;
  return is_negative ? -value : value;
}

}  // namespace touchstone
