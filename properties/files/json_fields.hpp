#pragma once

#include <array>
#include <cstdint>
#include <fmt/format.h>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "reference/invalid_input.hpp"
#include "reference/shape.hpp"

namespace touchstone {

// Reads what a person wrote as JSON. Every function throws InvalidInput with the full path of the
// field ("bodies[3].shape.radius"), what stood there and what would be right.

/// The value as the person wrote it, cut where it is long.
std::string shown(const nlohmann::json& value);

/// A JSON number, or a string with a decimal or hexadecimal float.
double number(const nlohmann::json& value, const std::string& field);

/// From 0 to `max`.
std::uint64_t whole_number(const nlohmann::json& value, const std::string& field,
                           std::uint64_t max = UINT64_MAX);

std::string string(const nlohmann::json& value, const std::string& field);

/// The member of that name; `path` is that of the object, empty for the whole text.
const nlohmann::json& member(const nlohmann::json& object, const char* name,
                             const std::string& path);

void require_object(const nlohmann::json& value, const std::string& field);

/// Refuses members that are not known.
void refuse_others(const nlohmann::json& object, const std::vector<std::string>& known,
                   const std::string& path);

template <std::size_t N>
std::array<double, N> numbers(const nlohmann::json& value, const std::string& field) {
  if (!value.is_array() || value.size() != N) {
    throw InvalidInput(field, shown(value), fmt::format("must be an array of {} numbers", N));
  }
  std::array<double, N> result;
  for (std::size_t i = 0; i < N; ++i) {
    result[i] = number(value[i], fmt::format("{}[{}]", field, i));
  }
  return result;
}

Vec3 vector(const nlohmann::json& value, const std::string& field);

/// The constructors name the field within the shape; the path in front of it is added here.
template <class Make>
auto at_path(const std::string& path, Make make) {
  try {
    return make();
  } catch (const InvalidInput& e) {
    throw e.within(path);
  }
}

}  // namespace touchstone
