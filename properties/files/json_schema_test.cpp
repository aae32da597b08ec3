#include "properties/files/json_schema_test.hpp"

namespace touchstone {
namespace {

using nlohmann::ordered_json;

/// `before` is the width of what stands before the value on its line, or after it.
void add(std::string& text, const ordered_json& value, std::size_t indent, std::size_t before) {
  constexpr std::size_t max_width = 120;
  const std::string line = value.dump(-1, ' ', false);
  std::string spaced;  // as people write it: blanks after colons and commas outside of texts
  bool in_text = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    spaced += line[i];
    if (line[i] == '"' && (i == 0 || line[i - 1] != '\\')) in_text = !in_text;
    if (!in_text && (line[i] == ':' || line[i] == ',')) spaced += ' ';
  }
  if (!value.is_structured() || value.empty() || before + spaced.size() <= max_width) {
    text += spaced;
    return;
  }
  const std::string next(indent + 1, ' ');
  text += value.is_object() ? "{\n" : "[\n";
  bool is_first = true;
  std::size_t column = 0;
  for (const auto& [name, entry] : value.items()) {
    std::string part;
    if (value.is_object()) part = ordered_json(name).dump() + ": ";
    add(part, entry, indent + 1, indent + 2 + part.size());
    // Words of a list fill lines.
    const bool goes_on = !is_first && value.is_array() && entry.is_primitive() &&
                         column + part.size() + 3 <= max_width;
    text += is_first ? next : goes_on ? ", " : ",\n" + next;
    column = (goes_on ? column + 2 : next.size()) + part.size();
    text += part;
    is_first = false;
  }
  text += '\n' + std::string(indent, ' ') + (value.is_object() ? '}' : ']');
}

}  // namespace

std::string schema_text(const ordered_json& schema) {
  std::string text;
  add(text, schema, 0, 0);
  return text + '\n';
}

ordered_json JsonSchema::number(const char* type, const Rule& rule) const {
  ordered_json result = {{"type", type}};
  const auto bound = [](double x) {
    return x == std::round(x) && std::abs(x) <= 0x1p53 ? ordered_json(std::llround(x))
                                                       : ordered_json(x);
  };
  if (std::isfinite(rule.min)) {
    result[rule.is_above_min ? "exclusiveMinimum" : "minimum"] = bound(rule.min);
  }
  if (std::isfinite(rule.max)) result["maximum"] = bound(rule.max);
  return rule.or_null ? or_null(result) : result;
}

ordered_json JsonSchema::text(const Rule& rule) {
  ordered_json result = {{"type", "string"}};
  if (rule.one_of) result = {{"enum", rule.one_of()}};
  if (rule.pattern) result["pattern"] = rule.pattern;
  if (!rule.name) return result;
  definitions_[rule.name] = result;
  return reference(rule.name);
}

ordered_json JsonSchema::or_null(ordered_json schema) {
  if (schema.contains("type") && schema["type"] == "null") return schema;
  if (!schema.contains("type") || schema["type"] == "object") {
    return {{"oneOf", ordered_json::array({schema, {{"type", "null"}}})}};
  }
  schema["type"] = ordered_json::array({schema["type"], "null"});
  return schema;
}

}  // namespace touchstone
