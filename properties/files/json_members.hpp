#pragma once

#include <cmath>
#include <concepts>
#include <cstdint>
#include <fmt/format.h>
#include <initializer_list>
#include <limits>
#include <optional>
#include <ranges>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "candidates/readable.hpp"
#include "properties/files/named_members.hpp"
#include "properties/files/strict_json.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {

// JSON of types that list their members by name (named_members.hpp), both ways. A type whose JSON
// is not a list of its members has a function to_json of its own.
//
// JSON has no number for a double that is not finite: it is written as null. Null is read as
// nothing where a member may be absent (an optional), as NaN where its rule is `or_null`, and is
// refused elsewhere.

/// The JSON of any value.
template <class T>
nlohmann::json json_of(const T& x);
/// That of a type that lists its members.
template <class T>
nlohmann::json object_of(const T& x);

/// Writes an object.
class JsonOut {
 public:
  static constexpr bool reads = false;

  explicit JsonOut(nlohmann::json& object) : object_(object) { object_ = nlohmann::json::object(); }

  template <class T>
  void named(const char* name, T&& value, const Rule& = {}, When when = When::always) {
    if (when == When::filled && !is_filled(value)) return;
    object_[name] = json_of(value);
  }
  template <class T>
  void named(const char* name, T&& value, When when) {
    named(name, value, {}, when);
  }
  /// The same of a member that is not read again.
  template <class... More>
  void written(const char* name, More&&... more) {
    named(name, more...);
  }
  /// Instead of an object, an array of these.
  template <class... T>
  void elements(T&... values) {
    object_ = nlohmann::json::array({json_of(values)...});
  }
  void ascending(std::initializer_list<const char*>) {}
  void require(bool, const char*, const std::string&) {}

 private:
  template <class T>
  static bool is_filled(const T& x) {
    if constexpr (requires { x.has_value(); }) {
      return x.has_value();
    } else if constexpr (std::is_same_v<T, bool>) {
      return x;
    } else if constexpr (requires { x.empty(); }) {
      return !x.empty();
    } else {
      return true;
    }
  }

  nlohmann::json& object_;
};

/// The text of a map's key.
template <class Key>
std::string key_text(const Key& key) {
  if constexpr (std::is_enum_v<Key>) {
    return name_of(key);
  } else {
    return fmt::format("{}", key);
  }
}

template <class T>
nlohmann::json json_of(const T& x) {
  using nlohmann::json;
  if constexpr (std::is_same_v<T, double>) {
    return or_null(x);
  } else if constexpr (std::is_arithmetic_v<T> || std::is_convertible_v<T, std::string_view>) {
    return x;
  } else if constexpr (std::is_enum_v<T>) {
    return name_of(x);
  } else if constexpr (requires { x.has_value(); }) {
    return x ? json_of(*x) : json(nullptr);
  } else if constexpr (requires { to_json(x); }) {
    return to_json(x);
  } else if constexpr (requires { typename T::mapped_type; }) {
    json result = json::object();
    for (const auto& [key, value] : x) result[key_text(key)] = json_of(value);
    return result;
  } else if constexpr (std::ranges::range<T>) {
    json result = json::array();
    for (const auto& each : x) result.push_back(json_of(each));
    return result;
  } else {
    return object_of(x);
  }
}

template <class T>
nlohmann::json object_of(const T& x) {
  nlohmann::json result;
  JsonOut out(result);
  members(out, const_cast<T&>(x));  // which reads it alone, as `reads` says
  return result;
}

/// Reads a value with its place in the file ("results[3].count"). What it is not is refused by
/// InvalidInput with both; members that no type lists are passed over.
class JsonIn {
 public:
  static constexpr bool reads = true;

  explicit JsonIn(const nlohmann::json& value, std::string place = "")
      : value_(value), place_(std::move(place)) {}

  bool has(const char* name) const { return value_.is_object() && value_.contains(name); }
  JsonIn at(const std::string& name) const;
  const nlohmann::json& value() const { return value_; }

  template <class T>
  void named(const char* name, T&& value, const Rule& rule = {}, When when = When::always) const {
    if (when == When::always || has(name)) at(name).read(value, rule);
  }
  template <class T>
  void named(const char* name, T&& value, When when) const {
    named(name, value, {}, when);
  }
  template <class... More>
  void written(const char*, More&&...) const {}
  /// Refuses numbers of an object that do not ascend in this order. Older files are without some.
  void ascending(std::initializer_list<const char*> names) const;
  /// Refuses a member of which something does not hold.
  void require(bool holds, const char* name, const std::string& must) const {
    if (!holds) at(name).refuse(must);
  }

  template <class T>
  void read(T& x, const Rule& rule = {}) const;
  [[noreturn]] void refuse(const std::string& must) const;

 private:
  JsonIn at(std::size_t i) const { return JsonIn(value_[i], fmt::format("{}[{}]", place_, i)); }
  double number(const Rule& rule) const;

  const nlohmann::json& value_;
  std::string place_;
};

template <class T>
void JsonIn::read(T& x, const Rule& rule) const {
  if constexpr (requires { x.has_value(); }) {
    if (value_.is_null()) return x.reset();
    read(x ? *x : x.emplace(), rule);
  } else if constexpr (std::is_same_v<T, bool>) {
    if (!value_.is_boolean()) refuse("must be true or false");
    x = value_.get<bool>();
  } else if constexpr (std::is_floating_point_v<T>) {
    x = number(rule);
  } else if constexpr (std::is_integral_v<T>) {
    const bool fits =
        value_.is_number_unsigned()
            ? std::in_range<T>(value_.get<std::uint64_t>())
            : value_.is_number_integer() && std::in_range<T>(value_.get<std::int64_t>());
    if (!fits) {
      refuse(fmt::format("must be a whole number from {} to {}", std::numeric_limits<T>::min(),
                         std::numeric_limits<T>::max()));
    }
    number(rule);
    x = value_.get<T>();
  } else if constexpr (std::is_same_v<T, std::string>) {
    if (!value_.is_string()) refuse("must be a string");
    x = readable(value_.get_ref<const std::string&>());
  } else if constexpr (requires { typename T::mapped_type; }) {
    if (!value_.is_object()) refuse("must be an object");
    for (const auto& [name, value] : value_.items()) {
      const JsonIn entry = at(name);
      const auto key = find_named<typename T::key_type>(name);
      if (!key) {
        entry.refuse(fmt::format("must be of one of {}",
                                 fmt::join(names_of_all<typename T::key_type>(), ", ")));
      }
      entry.read(x[*key], rule);
    }
  } else if constexpr (std::ranges::range<T>) {
    if (!value_.is_array()) refuse("must be an array");
    x.resize(value_.size());
    for (std::size_t i = 0; i < value_.size(); ++i) at(i).read(x[i], rule);
  } else {
    members(*this, x);
  }
}

}  // namespace touchstone
