#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace touchstone {

// What a type consists of is said once, in its own namespace, for all the forms that it takes:
//
//   template <class Archive>
//   void members(Archive& a, Machine& m) {
//     a.named("cpu", m.cpu);
//     a.named("cores", m.cores, rule::rule::from_one);
//     a.named("digest", m.digest, When::filled);
//   }
//
// Archives are JSON both ways (json_members.hpp), its schema (json_schema_test.hpp) and bytes
// (bytes.hpp), which have no names. `Archive::reads` tells which way the values go.

/// An archive of files, for a list that leaves out what only goes between processes, where bytes
/// take the type apart instead.
template <class Archive>
concept OfFiles = !requires {
  Archive::is_bytes;
};

/// What the value of a member must be beyond what its type says.
struct Rule {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool is_above_min = false;   ///< the least value itself is refused
  bool or_null = false;        ///< may be infinite or no number, which JSON writes as null
  const char* must = nullptr;  ///< what errors say: "must be a number from 0 to 1"
  std::vector<std::string> (*one_of)() = nullptr;  ///< the texts that there are
  const char* pattern = nullptr;                   ///< regular expression of a text
  const char* name = nullptr;  ///< of its definition in a schema, where several members have it

  bool allows(double x) const { return (is_above_min ? x > min : x >= min) && x <= max; }
};

namespace rule {
inline constexpr Rule any_or_null{.or_null = true};
inline constexpr Rule not_negative{.min = 0, .must = "must be a number that is not negative"};
inline constexpr Rule positive{.min = 0, .is_above_min = true, .must = "must be a positive number"};
inline constexpr Rule from_one{.min = 1, .must = "must be a whole number from 1"};
inline constexpr Rule share{.min = 0, .max = 1, .must = "must be a number from 0 to 1"};
}  // namespace rule

/// When a file has a member.
enum class When {
  always,
  filled,  ///< where there is something to say: its absence stands for empty, false or nothing
  newer,   ///< always, but files of older versions are without it
};

/// The value of an enumeration that has this name.
template <class Enum>
std::optional<Enum> find_named(std::string_view name) {
  for (const Enum each : values_of(Enum{})) {
    if (name == name_of(each)) return each;
  }
  return std::nullopt;
}
template <class Enum>
std::vector<std::string> names_of_all() {
  std::vector<std::string> names;
  for (const Enum each : values_of(Enum{})) names.push_back(name_of(each));
  return names;
}

}  // namespace touchstone
