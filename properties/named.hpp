#pragma once

#include <algorithm>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include "reference/invalid_input.hpp"

namespace touchstone {

/// The element of `all` to which `name_of` gives that name. Throws InvalidInput (with this field)
/// that lists the existing names.
template <class Range, class NameOf>
const auto& named(const Range& all, std::string_view name, const char* field,
                  const NameOf& name_of) {
  std::string names;
  for (const auto& each : all) {
    if (name_of(each) == name) return each;
    names += (names.empty() ? "" : ", ") + std::string(name_of(each));
  }
  throw InvalidInput(field, in_quotes(name), "must be one of " + names);
}
/// The element whose member `name` is that name.
template <class Range>
const auto& named(const Range& all, std::string_view name, const char* field) {
  return named(all, name, field, [](const auto& each) -> std::string_view { return each.name; });
}

/// The parts of a name between separators; of a text without any, the text itself.
inline std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(separator, start), text.size());
    parts.push_back(text.substr(start, end - start));
    start = end + 1;
  }
  return parts;
}

/// Levenshtein's distance: how many letters are to be added, left out or replaced.
inline std::size_t letters_between(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row.back();
}

/// The three names that differ in the fewest letters, nearest first: "rim, rim-side or rim-rim".
inline std::string nearest(std::string_view name, const std::vector<std::string>& known) {
  // A long word is not read to its end: nothing is near to it.
  const std::string_view read = name.substr(0, 100);
  std::vector<std::string> sorted = known;
  std::stable_sort(sorted.begin(), sorted.end(), [&](const auto& a, const auto& b) {
    return letters_between(read, a) < letters_between(read, b);
  });
  std::string result;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, sorted.size()); ++i) {
    result += (i == 0 ? "" : i == 1 ? ", " : " or ") + sorted[i];
  }
  return result;
}

}  // namespace touchstone
