#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "reference/invalid_input.hpp"

namespace touchstone {

/// The element of `all` whose member `name` is that name. Throws InvalidInput (with this field)
/// that lists the existing names.
template <class Range>
const auto& named(const Range& all, std::string_view name, const char* field) {
  std::string names;
  for (const auto& each : all) {
    if (each.name == name) return each;
    names += (names.empty() ? "" : ", ") + each.name;
  }
  throw InvalidInput(field, '"' + std::string(name) + '"', "must be one of " + names);
}

/// The three names that differ in the fewest letters, nearest first: "rim, rim-side or rim-rim".
std::string nearest(std::string_view name, const std::vector<std::string>& known);

}  // namespace touchstone
