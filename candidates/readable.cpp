#include "candidates/readable.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <iterator>

namespace touchstone {
namespace {

struct Character {
  std::size_t length;  ///< in bytes; 0: the byte begins no character of UTF-8
  char32_t code;
};

Character character_at(std::string_view text, std::size_t at) {
  const auto lead = static_cast<unsigned char>(text[at]);
  if (lead < 0x80) return {1, lead};
  const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc0 || lead >= 0xf8 || at + length > text.size()) return {0, 0};
  char32_t code = lead & (0x7fU >> length);
  for (std::size_t k = 1; k < length; ++k) {
    const auto next = static_cast<unsigned char>(text[at + k]);
    if ((next & 0xc0U) != 0x80) return {0, 0};
    code = code << 6 | (next & 0x3fU);
  }
  constexpr char32_t least[] = {0, 0, 0x80, 0x800, 0x10000};  // else it is an overlong form
  const bool is_surrogate = code >= 0xd800 && code <= 0xdfff;
  if (code < least[length] || code > 0x10ffff || is_surrogate) return {0, 0};
  return {length, code};
}

/// Controls, Default_Ignorable_Code_Point (DerivedCoreProperties.txt of Unicode 15), and what ends
/// lines or annotates them.
bool is_hidden(char32_t code) {
  struct Range {
    char32_t first, last;
  };
  constexpr Range hidden[] = {
      {0, 0x1f},        {0x7f, 0x9f},       {0xad, 0xad},       {0x34f, 0x34f},    {0x61c, 0x61c},
      {0x115f, 0x1160}, {0x17b4, 0x17b5},   {0x180b, 0x180f},   {0x200b, 0x200f},  {0x2028, 0x202e},
      {0x2060, 0x206f}, {0x3164, 0x3164},   {0xfe00, 0xfe0f},   {0xfeff, 0xfeff},  {0xffa0, 0xffa0},
      {0xfff0, 0xfffb}, {0x1bca0, 0x1bca3}, {0x1d173, 0x1d17a}, {0xe0000, 0xe0fff}};
  return std::any_of(std::begin(hidden), std::end(hidden),
                     [&](const Range& r) { return code >= r.first && code <= r.last; });
}

/// As JSON has it: beyond the first plane, in two halves.
std::string code_text(char32_t code, std::string_view backslash) {
  const auto number = static_cast<std::uint32_t>(code);
  if (number < 0x10000) return fmt::format("{}u{:04x}", backslash, number);
  return fmt::format("{0}u{1:04x}{0}u{2:04x}", backslash, 0xd7c0 + (number >> 10),
                     0xdc00 + (number & 0x3ffU));
}

/// Whether it begins with a colour as Terminal writes it: "\x1b[31m", "\x1b[0m".
bool is_colour(std::string_view text) {
  const std::size_t end = text.find_first_not_of("0123456789", 2);
  return text.starts_with("\x1b[") && end != text.npos && end > 2 && text[end] == 'm';
}

}  // namespace

std::string readable(const std::string& text) {
  std::string result;
  while (result.size() < text.size()) {
    const std::size_t at = result.size();
    const auto [length, code] = character_at(text, at);
    if (length == 0) {
      result += '?';
    } else if (is_hidden(code)) {
      result.append(length, ' ');
    } else {
      result.append(text, at, length);
    }
  }
  return result;
}

std::string escaped(std::string_view text, Printed printed, std::string_view backslash) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const auto [length, code] = character_at(text, at);
    const bool stays = printed == Printed::lines &&
                       (code == '\n' || code == '\t' || is_colour(text.substr(at, 6)));
    if (length == 0) {
      result += fmt::format("{}x{:02x}", backslash, static_cast<unsigned char>(text[at]));
    } else if (is_hidden(code) && !stays) {
      result += code_text(code, backslash);
    } else {
      result += text.substr(at, length);
    }
    at += std::max<std::size_t>(length, 1);
  }
  return result;
}

}  // namespace touchstone
