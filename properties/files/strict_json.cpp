#include "properties/files/strict_json.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <iostream>
#include <optional>
#include <set>
#include <sstream>
#include <vector>

#include <nlohmann/json.hpp>

#include "candidates/readable.hpp"
#include "properties/files/disk.hpp"
#include "properties/files/given_text.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {

using nlohmann::json;

std::string shown(const json& value) {
  constexpr std::size_t max_shown = 60;
  return printable(value.dump(-1, ' ', false, json::error_handler_t::replace), max_shown);
}

void check_printable(const std::string& field, const std::string& name) {
  if (readable(name) == name) return;
  throw InvalidInput(field, shown(name),
                     "must be without characters that are not seen, as controls");
}

double number(const json& value, const std::string& field) {
  if (value.is_number()) return value.get<double>();
  if (value.is_string()) {
    if (const auto parsed = parse_double(value.get_ref<const std::string&>())) return *parsed;
  }
  throw InvalidInput(field, shown(value),
                     "must be a finite number, or a string with a decimal or hexadecimal float "
                     "such as \"0x1.8p-1\"");
}

std::optional<double> number_or_null(const json& value, const std::string& field) {
  return value.is_null() ? std::nullopt : std::optional(number(value, field));
}

json or_null(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? json(*value) : json(nullptr);
}

std::uint64_t whole_number(const json& value, const std::string& field, std::uint64_t max) {
  const bool is_whole = value.is_number_integer() && (value.is_number_unsigned() || value >= 0);
  if (is_whole && value.get<std::uint64_t>() <= max) return value.get<std::uint64_t>();
  throw InvalidInput(field, shown(value), fmt::format("must be a whole number from 0 to {}", max));
}

std::string string(const json& value, const std::string& field) {
  if (!value.is_string()) throw InvalidInput(field, shown(value), "must be a string");
  return value.get<std::string>();
}

std::string id_of(const json& object) {
  const json& id = member(object, "id", "");
  if (id.is_string()) return id.get<std::string>();
  if (id.is_primitive()) return id.dump();
  throw InvalidInput("id", shown(id), "must be a string, a number, true, false or null");
}

const json& array(const json& value, const std::string& field) {
  if (!value.is_array()) throw InvalidInput(field, shown(value), "must be an array");
  return value;
}

const json& member(const json& object, const char* name, const std::string& path) {
  if (!object.contains(name)) {
    throw InvalidInput(path.empty() ? name : path + "." + name, "missing", "must be given");
  }
  return object[name];
}

void require_object(const json& value, const std::string& field) {
  if (!value.is_object()) throw InvalidInput(field, shown(value), "must be an object");
}

void refuse_others(const json& object, const std::vector<std::string>& known,
                   const std::string& path) {
  for (const auto& [name, value] : object.items()) {
    bool found = false;
    std::string names;
    for (const std::string& k : known) {
      found = found || name == k;
      names += (names.empty() ? "" : ", ") + k;
    }
    if (!found) {
      throw InvalidInput(path.empty() ? name : path + "." + name, shown(value),
                         "is not known here; known are " + names);
    }
  }
}

void read_numbers(const json& value, const std::string& field, std::span<double> numbers) {
  if (!value.is_array() || value.size() != numbers.size()) {
    throw InvalidInput(field, shown(value),
                       fmt::format("must be an array of {} numbers", numbers.size()));
  }
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    numbers[i] = number(value[i], fmt::format("{}[{}]", field, i));
  }
}

Vec3 vector(const json& value, const std::string& field) {
  const auto v = numbers<3>(value, field);
  return Vec3(v[0], v[1], v[2]);
}

namespace {

using nlohmann::json;

/// Follows the parser through the text; knows where it is and what was given there already.
class Follower {
 public:
  explicit Follower(const std::string& source) : source_(source) {}

  void follow(json::parse_event_t event, const json& parsed) {
    switch (event) {
      case json::parse_event_t::object_start:
        return enter(false);
      case json::parse_event_t::array_start:
        return enter(true);
      case json::parse_event_t::key:
        return take_key(parsed.get_ref<const std::string&>());
      case json::parse_event_t::object_end:
      case json::parse_event_t::array_end:
        levels_.pop_back();
        return pass_value();
      case json::parse_event_t::value:
        return pass_value();
    }
  }

  /// "bodies[3].shape", or the source where that is all of it.
  std::string path() const {
    std::string result;
    for (const Level& level : levels_) {
      if (level.is_array) {
        result += fmt::format("[{}]", level.index);
      } else if (!level.key.empty()) {
        result += (result.empty() ? "" : ".") + level.key;
      }
    }
    return result.empty() ? source_ : result;
  }

 private:
  struct Level {
    bool is_array;
    std::size_t index = 0;  ///< of the element that comes next
    std::string key = {};   ///< of the member that was begun last
    std::set<std::string> keys = {};
  };

  void enter(bool is_array) {
    if (levels_.size() == max_json_depth) {
      throw InvalidInput(path(), "nested too deeply",
                         fmt::format("must be at most {} levels deep", max_json_depth));
    }
    levels_.push_back({is_array});
  }
  void take_key(const std::string& key) {
    Level& level = levels_.back();
    level.key = key;
    if (!level.keys.insert(key).second) {
      throw InvalidInput(path(), "given twice", "must be given once");
    }
  }
  void pass_value() {
    if (!levels_.empty() && levels_.back().is_array) ++levels_.back().index;
  }

  const std::string& source_;
  std::vector<Level> levels_;
};

/// `at`: of the first byte that cannot stand where it does.
[[noreturn]] void refuse_syntax(std::string_view text, std::size_t at, const std::string& source) {
  at = std::min(at, text.size());
  const std::size_t line_start = text.substr(0, at).rfind('\n') + 1;  // npos + 1 is 0
  const auto line = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  std::string where = fmt::format("column {}", at - line_start + 1);
  if (text.find('\n') != text.npos) where = fmt::format("line {}, ", line + 1) + where;

  constexpr std::size_t shown_before = 12, shown_after = 12;
  const std::size_t start = std::max(line_start, at - std::min(at, shown_before));
  const std::string near(text.substr(start, at - start + shown_after));
  // What other writers of JSON make of what is no number.
  const std::string_view here = text.substr(at);
  const bool is_no_number = here.starts_with("NaN") || here.starts_with("Infinity");
  throw InvalidInput(source,
                     fmt::format("no JSON at {} ({})", where,
                                 at == text.size() ? "its end" : "near " + shown(near)),
                     is_no_number ? "must be one whole JSON value, which has null for what is no "
                                    "number, where that is allowed"
                                  : "must be one whole JSON value");
}

}  // namespace

json parse_json(std::string_view text, const std::string& source) {
  // The library takes a NUL for the end.
  if (const auto nul = text.find('\0'); nul != text.npos) refuse_syntax(text, nul, source);
  Follower follower(source);
  try {
    return json::parse(text, [&](int, json::parse_event_t event, const json& parsed) {
      follower.follow(event, parsed);
      return true;
    });
  } catch (const json::parse_error& e) {
    refuse_syntax(text, e.byte > 0 ? e.byte - 1 : 0, source);
  } catch (const json::out_of_range&) {
    throw InvalidInput(follower.path(), "a number beyond all doubles",
                       "must be at most 1.8e308 in size");
  }
}

namespace {

/// A line of several: a byte order mark stands before the first alone.
json parse_line(const std::string& line, std::uint64_t number, const std::string& source) {
  if (number > 1 && line.starts_with("\xef\xbb\xbf")) refuse_syntax(line, 0, source);
  return parse_json(line, source);
}

}  // namespace

std::vector<json> parse_json_lines(const std::string& text, const std::string& source) {
  std::optional<InvalidInput> not_one_value;
  try {
    return {parse_json(text, source)};
  } catch (const InvalidInput& e) {
    not_one_value = e;
  }
  std::vector<json> values;
  std::istringstream lines(text);
  std::string line;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    try {
      values.push_back(parse_line(line, number, fmt::format("{}: line {}", source, number)));
    } catch (const InvalidInput&) {
      if (values.empty()) throw *not_one_value;
      throw;
    }
  }
  if (values.empty()) throw *not_one_value;
  return values;
}

namespace {

/// A thousand times what a configuration takes.
constexpr std::size_t max_line = std::size_t{1} << 20;

}  // namespace

/// Keeps no more than one byte beyond `max_line`.
bool JsonLines::read_line() {
  line_.clear();
  std::streambuf& buffer = *in_.rdbuf();
  int c = buffer.sbumpc();
  if (c == EOF) return false;
  ++number_;
  for (std::size_t length = 0; c != EOF && c != '\n'; c = buffer.sbumpc()) {
    if (++length > max_file_size) {
      throw InvalidInput(fmt::format("line {}", number_), "without an end",
                         fmt::format("must have at most {} bytes", max_line));
    }
    if (line_.size() <= max_line) line_ += static_cast<char>(c);
  }
  return true;
}

bool JsonLines::next() {
  while (read_line()) {
    if (line_.size() > max_line || line_.find_first_not_of(" \t\r") != line_.npos) return true;
  }
  if (ended_by_error(in_)) {
    throw InvalidInput("file", &in_ == &std::cin ? "standard input" : "unreadable",
                       "could not be read to its end");
  }
  return false;
}

json JsonLines::parse() const {
  if (line_.size() > max_line) {
    throw InvalidInput("line", printable(line_, 30),
                       fmt::format("must have at most {} bytes", max_line));
  }
  return parse_line(line_, number_, "line");
}

}  // namespace touchstone
