#include "reports/json_fields.hpp"

#include <cctype>
#include <cstdlib>

namespace touchstone {

using nlohmann::json;

std::string shown(const json& value) {
  std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
  if (text.size() > 60) text = text.substr(0, 57) + "...";
  return text;
}

double number(const json& value, const std::string& field) {
  if (value.is_number()) return value.get<double>();
  if (value.is_string()) {
    const std::string text = value.get<std::string>();
    char* end = nullptr;
    const double parsed = std::strtod(text.c_str(), &end);
    const bool blank = text.empty() || std::isspace(static_cast<unsigned char>(text[0]));
    if (!blank && *end == '\0') return parsed;
  }
  throw InvalidInput(field, shown(value),
                     "must be a number, or a string with a decimal or hexadecimal float such as "
                     "\"0x1.8p-1\"");
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

void refuse_others(const json& object, std::initializer_list<const char*> known,
                   const std::string& path) {
  for (const auto& [name, value] : object.items()) {
    bool found = false;
    std::string names;
    for (const char* k : known) {
      found = found || name == k;
      names += (names.empty() ? "" : ", ") + std::string(k);
    }
    if (!found) {
      throw InvalidInput(path.empty() ? name : path + "." + name, shown(value),
                         "is not known here; known are " + names);
    }
  }
}

Vec3 vector(const json& value, const std::string& field) {
  const auto v = numbers<3>(value, field);
  return Vec3(v[0], v[1], v[2]);
}

}  // namespace touchstone
