#include "properties/files/error_text.hpp"

#include <fmt/format.h>

namespace touchstone {
namespace {

constexpr std::size_t max_field = 200, max_value = 120;
/// Remedies list what is known here; the longest list is that of all pose classes.
constexpr std::size_t max_remedy = 10000;

bool continues_a_character(char c) { return (static_cast<unsigned char>(c) & 0xc0U) == 0x80U; }

}  // namespace

std::string printable(std::string_view text, std::size_t max_length) {
  constexpr std::string_view cut = "...";
  std::string result;
  for (const char c : text.substr(0, max_length + 1)) {
    const bool is_control = static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
    if (is_control) {
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    } else {
      result += c;
    }
  }
  if (result.size() <= max_length) return result;
  std::size_t end = max_length - cut.size();
  while (end > 0 && continues_a_character(result[end])) --end;
  return result.substr(0, end) + std::string(cut);
}

std::string error_text(const InvalidInput& error) {
  return printable(error.field(), max_field) + " is " + printable(error.value(), max_value) + ": " +
         printable(error.remedy(), max_remedy);
}

}  // namespace touchstone
