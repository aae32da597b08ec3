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

/// Reads what to_string wrote. Throws InvalidInput that names the part, its value and, for pairs
/// and classes, those there are.
Identity parse_identity(std::string_view text);

/// Reads a pair's name; throws InvalidInput that lists those there are.
Pair parse_pair(std::string_view name);

/// Names of the pose classes of a pair, in report order, without those that are asked for by name
/// only ("hostile").
const std::vector<std::string>& pose_classes(Pair pair);

/// Those of a pair's pose classes that are wanted, in report order; of none wanted, the same as
/// without.
std::vector<std::string> pose_classes(Pair pair, const std::vector<std::string>& wanted);

/// Throws InvalidInput (field "--class") that lists those there are, unless each class is one of at
/// least one of the pairs.
void check_pose_classes(const std::vector<Pair>& pairs, const std::vector<std::string>& classes);

/// One sentence: which geometry the class makes and why it is hard.
std::string_view describe_pose_class(Pair pair, std::string_view pose_class);

/// The configuration of that identity: the same bits on every call, alone, in constant time.
Configuration make_configuration(const Identity& identity);

/// The same from the random numbers on the tape, which is prolonged as need be: an empty one
/// becomes the identity's own, and a changed one gives another configuration of the same class.
Configuration make_configuration(const Identity& identity, std::vector<std::uint64_t>& tape);

/// A whole number in a name. Throws InvalidInput (with this field).
std::uint64_t parse_number(const char* field, std::string_view text);

/// A configuration to be shown, and what to call it.
struct Subject {
  std::string name;         ///< An identity, or a file.
  std::string description;  ///< Of its pose class; empty without one.
  Configuration configuration;
};
Subject subject(const Identity& identity);

}  // namespace touchstone
