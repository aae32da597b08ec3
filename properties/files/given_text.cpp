#include "properties/files/given_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <optional>
#include <string>

#include "candidates/readable.hpp"
#include "reference/invalid_input.hpp"

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

namespace {

/// "12" or "1.2e1". Doubles know every whole number up to 2^53 only.
std::optional<std::uint64_t> whole_number(const std::string& text) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (!text.empty() && std::all_of(text.begin(), text.end(), is_digit)) {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() ? std::optional(value) : std::nullopt;
  }
  if (text.find_first_of("eE") == text.npos || text.starts_with('0')) return std::nullopt;
  const auto value = parse_double(text);
  if (!value || !(*value >= 0 && *value <= 0x1p53) || *value != std::floor(*value)) {
    return std::nullopt;
  }
  return static_cast<std::uint64_t>(*value);
}

}  // namespace

double read_number(const std::string& option, const std::string& text, NumberRange range) {
  const auto value = parse_double(text);
  if (value && *value >= range.min && *value <= range.max) return *value;
  throw InvalidInput(option, in_quotes(text),
                     fmt::format("must be a number from {} to {}", range.min, range.max));
}

std::uint64_t read_count(const std::string& option, const std::string& text, CountRange range) {
  const auto value = whole_number(text);
  if (value && *value >= range.min && *value <= range.max) return *value;
  throw InvalidInput(option, in_quotes(text),
                     fmt::format("must be a whole number from {} to {}", range.min, range.max));
}

namespace {

constexpr std::size_t max_field = 200, max_value = 120;
/// Remedies list what is known here; the longest list is that of all pose classes.
constexpr std::size_t max_remedy = 10000;

bool continues_a_character(char c) { return (static_cast<unsigned char>(c) & 0xc0U) == 0x80U; }

}  // namespace

std::string printable(std::string_view text, std::size_t max_length) {
  constexpr std::string_view cut = "...";
  std::string result = escaped(text.substr(0, max_length + 1), Printed::one_line);
  if (result.size() <= max_length) return result;
  std::size_t end = max_length - cut.size();
  while (end > 0 && continues_a_character(result[end])) --end;
  return result.substr(0, end) + std::string(cut);
}

std::string counted(std::uint64_t count, std::string_view noun) {
  if (count == 1) return fmt::format("1 {}", noun);
  if (noun.ends_with('y')) return fmt::format("{} {}ies", count, noun.substr(0, noun.size() - 1));
  return fmt::format("{} {}{}", count, noun, noun.ends_with('s') ? "es" : "s");
}

std::string error_text(const InvalidInput& error) {
  return printable(error.field(), max_field) + " is " + printable(error.value(), max_value) + ": " +
         printable(error.remedy(), max_remedy);
}

}  // namespace touchstone
