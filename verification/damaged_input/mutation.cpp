#include "verification/damaged_input/mutation.hpp"

#include <cctype>
#include <iterator>
#include <sstream>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace touchstone {
namespace {

using nlohmann::json;

/// Every value of the tree, the outermost first.
void collect(json& value, std::vector<json*>& all) {
  all.push_back(&value);
  for (auto& element : value) {
    if (value.is_structured()) collect(element, all);
  }
}

std::vector<std::string> parts(const std::string& text, char separator) {
  std::vector<std::string> result;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, separator);) result.push_back(part);
  return result;
}

bool is_of_a_number(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' || c == '+';
}

}  // namespace

const std::string& Mutation::nasty() {
  static const std::vector<std::string> tokens = parts(
      "| |null|true|\"\"|[]|{}|[[[[[[[[|{\"a\":|}|]|,|:|\"|\\|\\u0000|\\ud800|\xff|\xc3|"
      "\xe2\x80\xae|\xef\xbb\xbf|\x1b[2J|NaN|Infinity|/|//|../../x|@|@1e-8/1/4|\r|\n|\t|<|</a>|"
      "<!--|&#0;|%s|%n|{}{}|\"0x\"|\"0x1.8p-1z\"|\" 1\"|\"1_0\"|\"\xd9\xa1\"|\"nan\"|\"inf\"|"
      "\"1\\u0000\"",
      '|');
  return tokens[below(tokens.size())];
}

const std::string& Mutation::extreme_number() {
  static const std::vector<std::string> numbers = parts(
      "0 -0 1 -1 1e400 -1e400 1e308 -1e308 1e-308 1e-320 5e-324 1e200 1e154 1e-162 1e30 1e-30 "
      "1e16 1e-300 255 -128 2147483648 4294967296 9223372036854775807 9223372036854775808 "
      "18446744073709551615 18446744073709551616 -9223372036854775809 0.1 1e 01 0x10 +1 "
      "1.7976931348623157e308 1.7976931348623159e308",
      ' ');
  return numbers[below(numbers.size())];
}

std::string Mutation::change_bytes(std::string text) {
  const std::size_t at = below(text.size() + 1);
  const std::size_t length = below(one_in(4) ? text.size() - at + 1 : 8);
  switch (below(6)) {
    case 0:
      if (at < text.size()) text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
      return text;
    case 1:
      if (at < text.size()) text[at] = static_cast<char>(below(256));
      return text;
    case 2:
      return text.insert(at, nasty());
    case 3:
      return text.replace(at, length, nasty());
    case 4:
      return text.insert(at, text.substr(below(text.size() + 1), length));
    default:
      return one_in(2) ? text.substr(0, at) : text.erase(at, length);
  }
}

std::string Mutation::change_number(std::string text) {
  const std::size_t from = below(text.size());
  std::size_t start = from;
  while (start < text.size() && !is_of_a_number(text[start])) ++start;
  std::size_t end = start;
  while (end < text.size() && is_of_a_number(text[end])) ++end;
  return text.replace(start, end - start, extreme_number());
}

std::string Mutation::change_lines(const std::string& text) {
  std::vector<std::string> lines = parts(text, '\n');
  if (lines.empty()) return text + nasty();
  const std::size_t i = below(lines.size()), j = below(lines.size());
  switch (below(4)) {
    case 0:
      lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(i));
      break;
    case 1:
      lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(i), lines[j]);
      break;
    case 2:
      std::swap(lines[i], lines[j]);
      break;
    default:
      lines[i] += lines[j];
  }
  std::string result;
  for (const auto& line : lines) result += line + '\n';
  return result;
}

/// As text: a tree of values has no place for it.
std::string Mutation::repeat_member(std::string text) {
  const std::size_t colon = text.find(':', below(text.size()));
  if (colon == std::string::npos) return text;
  const std::size_t key_end = text.rfind('"', colon);
  const std::size_t key = key_end == std::string::npos || key_end == 0
                              ? std::string::npos
                              : text.rfind('"', key_end - 1);
  if (key == std::string::npos) return text;
  return text.insert(key, text.substr(key, colon + 1 - key) + extreme_number() + ',');
}

std::string Mutation::change_json(const std::string& text) {
  json whole = json::parse(text, nullptr, false);
  if (whole.is_discarded()) return change_bytes(text);
  std::vector<json*> all, numbers;
  collect(whole, all);
  for (json* const value : all) {
    if (value->is_number()) numbers.push_back(value);
  }
  if (!numbers.empty() && one_in(2)) {
    const json parsed = json::parse(extreme_number(), nullptr, false);
    *numbers[below(numbers.size())] = parsed.is_discarded() ? json(1e200) : parsed;
    return whole.dump(-1, ' ', false, json::error_handler_t::replace);
  }
  json& value = *all[below(all.size())];
  const json& other = *all[below(all.size())];
  switch (below(8)) {
    case 0: {
      const json parsed = json::parse(nasty(), nullptr, false);
      value = parsed.is_discarded() ? json(nullptr) : parsed;
      break;
    }
    case 1:
    case 2: {
      const json parsed = json::parse(extreme_number(), nullptr, false);
      value = parsed.is_discarded() ? json(-1) : parsed;
      break;
    }
    case 3:
      value = nasty();
      break;
    case 4:
      value = json(other);
      break;
    case 5:
      if (value.is_object() && !value.empty()) {
        value.erase(std::next(value.begin(), static_cast<std::ptrdiff_t>(below(value.size()))));
      } else if (value.is_array() && !value.empty()) {
        value.erase(below(value.size()));
      }
      break;
    case 6:
      if (value.is_object()) value[one_in(2) ? std::string("x") : nasty()] = json(other);
      if (value.is_array()) value.push_back(json(other));
      break;
    default:
      if (value.is_string()) value = change_bytes(value.get<std::string>());
      if (value.is_number()) value = std::to_string(value.get<double>()) + nasty();
  }
  return whole.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::string Mutation::of(const std::string& text) {
  std::string result = text;
  const std::size_t changes = one_in(2) ? 1 : 1 + below(4);
  const bool as_json = one_in(2);
  for (std::size_t i = 0; i < changes; ++i) {
    if (as_json) {
      result = one_in(10) ? repeat_member(result) : change_json(result);
      continue;
    }
    switch (below(3)) {
      case 0:
        result = change_bytes(result);
        break;
      case 1:
        result = change_number(result);
        break;
      default:
        result = change_lines(result);
    }
  }
  return result;
}

}  // namespace touchstone
