#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "reference/configuration.hpp"

namespace touchstone {

/// The name of one sampled configuration: "cylinder-box/near-parallel-1e-6/42/137".
struct Identity {
  Pair pair;
  std::string pose_class;
  std::uint64_t seed;
  std::uint64_t index;

  bool operator==(const Identity&) const = default;
};

std::string to_string(const Identity& identity);

/// Reads what to_string wrote. Throws InvalidInput that names the part and its value and, for pairs
/// and classes, lists the existing ones.
Identity parse_identity(std::string_view text);

/// Reads a pair's name; throws InvalidInput that lists the existing ones.
Pair parse_pair(std::string_view name);

/// Names of the pose classes of a pair, in report order, without those that run only when named
/// ("hostile").
const std::vector<std::string>& pose_classes(Pair pair);

/// The wanted ones of a pair's pose classes, in report order; if none are wanted,
/// pose_classes(pair).
std::vector<std::string> pose_classes(Pair pair, const std::vector<std::string>& wanted);

/// Throws InvalidInput (field "--class") that lists the existing classes, unless every class
/// belongs to at least one of the pairs.
void check_pose_classes(const std::vector<Pair>& pairs, const std::vector<std::string>& classes);

/// One sentence: the geometry that the class makes and why it is hard.
std::string_view describe_pose_class(Pair pair, std::string_view pose_class);

/// The configuration of that identity: the same bits on every call, in constant time.
Configuration make_configuration(const Identity& identity);

/// Makes a configuration from the random numbers on the tape, which is extended as needed: an empty
/// tape becomes the identity's own, a changed one gives another configuration of the same class.
Configuration make_configuration(const Identity& identity, std::vector<std::uint64_t>& tape);

/// Reads a whole number in a name. Throws InvalidInput (with this field).
std::uint64_t parse_number(const char* field, std::string_view text);

/// A configuration with its name.
struct Subject {
  std::string name;         ///< an identity, or a file
  std::string description;  ///< of its pose class; empty without one
  Configuration configuration;
};
Subject subject(const Identity& identity);

}  // namespace touchstone
