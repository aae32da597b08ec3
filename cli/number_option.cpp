#include "cli/number_option.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <optional>

#include "properties/files/parse_double.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

std::string quoted(const std::string& text) { return '"' + text + '"'; }

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
  throw InvalidInput(option, quoted(text),
                     fmt::format("must be a number from {} to {}", range.min, range.max));
}

std::uint64_t read_count(const std::string& option, const std::string& text, CountRange range) {
  const auto value = whole_number(text);
  if (value && *value >= range.min && *value <= range.max) return *value;
  throw InvalidInput(option, quoted(text),
                     fmt::format("must be a whole number from {} to {}", range.min, range.max));
}

}  // namespace touchstone
