#include "properties/files/strict_json.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <set>
#include <sstream>
#include <vector>

#include <nlohmann/json.hpp>

#include "properties/files/json_fields.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
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
  throw InvalidInput(source,
                     fmt::format("no JSON at {} ({})", where,
                                 at == text.size() ? "its end" : "near " + shown(near)),
                     "must be one whole JSON value");
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
      values.push_back(parse_json(line, fmt::format("line {}", number)));
    } catch (const InvalidInput&) {
      if (values.empty()) throw *not_one_value;
      throw;
    }
  }
  if (values.empty()) throw *not_one_value;
  return values;
}

}  // namespace touchstone
