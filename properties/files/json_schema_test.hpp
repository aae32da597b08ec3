#pragma once

#include <cmath>
#include <map>
#include <ranges>
#include <set>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <typeindex>
#include <utility>

#include <nlohmann/json.hpp>

#include "properties/files/bytes.hpp"
#include "properties/files/named_members.hpp"

namespace touchstone {

/// A schema as it stands in a file: what fits into 120 columns is one line.
std::string schema_text(const nlohmann::ordered_json& schema);

/// JSON Schema (2020-12) of types that list their members by name (named_members.hpp), strict: it
/// names every member, and no other is allowed.
class JsonSchema {
 public:
  using json = nlohmann::ordered_json;

  /// Members `When::filled` that every object of this kind of file has, and that none has.
  JsonSchema(std::set<std::string> present, std::set<std::string> absent)
      : present_(std::move(present)), absent_(std::move(absent)) {}

  /// Types with this definition, which is made when it is needed first.
  template <class T>
  void define(const char* name) {
    names_[typeid(T)] = name;
  }
  /// Types with this schema, which stands elsewhere or is no list of members.
  template <class T>
  void set(json schema) {
    known_[typeid(T)] = std::move(schema);
  }

  template <class T>
  json of(const Rule& rule = {});
  /// Of an object with the members of this one, whatever its values but for those that decide which
  /// members it has.
  template <class T>
  json object(T&& sample);
  const json& definitions() const { return definitions_; }

 private:
  friend class SchemaOut;

  json number(const char* type, const Rule& rule) const;
  json text(const Rule& rule);
  static json or_null(json schema);
  static json reference(const std::string& name) { return {{"$ref", "#/$defs/" + name}}; }

  std::set<std::string> present_, absent_;
  std::map<std::type_index, const char*> names_;
  std::map<std::type_index, json> known_;
  json definitions_ = json::object();
};

/// The archive that lists the members of one object.
class SchemaOut {
 public:
  static constexpr bool reads = false;

  explicit SchemaOut(JsonSchema& all) : all_(all) {}

  template <class T>
  void named(const char* name, T&&, const Rule& rule = {}, When when = When::always) {
    const bool may_be_absent = when == When::filled && !all_.present_.contains(name);
    if (may_be_absent && all_.absent_.contains(name)) return;
    using Value = std::remove_cvref_t<T>;
    if constexpr (requires(Value x) { x.has_value(); }) {
      properties[name] =
          when == When::filled ? all_.of<typename Value::value_type>(rule) : all_.of<Value>(rule);
    } else {
      properties[name] = all_.of<Value>(rule);
    }
    if (may_be_absent && std::is_same_v<Value, bool>) properties[name] = {{"const", true}};
    if (!may_be_absent) required.push_back(name);
  }
  template <class T>
  void named(const char* name, T&& value, When when) {
    named(name, value, {}, when);
  }
  template <class T, class... More>
  void written(const char* name, T&& value, More&&... more) {
    named(name, value, more...);
  }
  template <class T, class... More>
  void elements(T&, More&...) {
    const std::size_t count = 1 + sizeof...(More);
    array = {{"type", "array"}, {"items", all_.of<T>()}, {"minItems", count}, {"maxItems", count}};
  }
  /// Members without names are not of JSON.
  template <class... T>
  void operator()(T&...) {
    throw std::logic_error("the schema of a type with JSON of its own must be set");
  }
  void ascending(std::initializer_list<const char*>) {}
  void require(bool, const char*, const std::string&) {}

  nlohmann::ordered_json properties = nlohmann::ordered_json::object(),
                         required = nlohmann::ordered_json::array(), array;

 private:
  JsonSchema& all_;
};

template <class T>
nlohmann::ordered_json JsonSchema::of(const Rule& rule) {
  if constexpr (requires(T x) { x.has_value(); }) {
    return or_null(of<typename T::value_type>(rule));
  } else if (const auto known = known_.find(typeid(T)); known != known_.end()) {
    return known->second;
  } else if constexpr (std::is_same_v<T, bool>) {
    return {{"type", "boolean"}};
  } else if constexpr (std::is_floating_point_v<T>) {
    return number("number", rule);
  } else if constexpr (std::is_integral_v<T>) {
    return number("integer",
                  std::is_unsigned_v<T> && std::isinf(rule.min) ? rule::not_negative : rule);
  } else if constexpr (std::is_convertible_v<T, std::string_view>) {
    return text(rule);
  } else if constexpr (std::is_enum_v<T>) {
    return text({.one_of = names_of_all<T>, .name = rule.name});
  } else if constexpr (requires { typename T::mapped_type; }) {
    using Key = typename T::key_type;
    json result = {{"type", "object"}};
    if constexpr (std::is_enum_v<Key>) result["propertyNames"] = of<Key>();
    if constexpr (std::is_same_v<Key, int>) result["propertyNames"] = {{"pattern", "^[0-9]+$"}};
    if constexpr (std::is_same_v<Key, char>) result["propertyNames"] = {{"maxLength", 1}};
    result["additionalProperties"] = of<typename T::mapped_type>(rule);
    return result;
  } else if constexpr (std::ranges::range<T>) {
    json result = {{"type", "array"}, {"items", of<std::ranges::range_value_t<T>>(rule)}};
    if (rule.one_of && rule.min > 0) result["minItems"] = rule.min;
    return result;
  } else if (const auto named = names_.find(typeid(T)); named != names_.end()) {
    const std::string name = named->second;
    if (!definitions_.contains(name)) {
      definitions_[name] = nullptr;  // its place, before those that it refers to
      json made = object(blank<T>());
      definitions_[name] = std::move(made);
    }
    return reference(name);
  } else {
    return object(blank<T>());
  }
}

template <class T>
nlohmann::ordered_json JsonSchema::object(T&& sample) {
  SchemaOut out(*this);
  if constexpr (requires { members(out, sample); }) {
    members(out, sample);
  } else {
    throw std::logic_error("the schema of a type without members must be set");
  }
  if (!out.array.is_null()) return out.array;
  return {{"type", "object"},
          {"properties", out.properties},
          {"required", out.required},
          {"additionalProperties", false}};
}

}  // namespace touchstone
