#include "properties/files/json_fields.hpp"

#include <cmath>
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "properties/files/error_text.hpp"
#include "properties/files/parse_number.hpp"

namespace touchstone {

using nlohmann::json;

std::string shown(const json& value) {
  constexpr std::size_t max_shown = 60;
  return printable(value.dump(-1, ' ', false, json::error_handler_t::replace), max_shown);
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

}  // namespace touchstone
