#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "properties/modifiers.hpp"
#include "reference/configuration.hpp"
#include "reference/sweep.hpp"

namespace touchstone {

struct Arrangement;  // pose_class.hpp

/// What a user meets of a class: no figure is given over all groups.
enum class Group {
  everyday,    ///< sizes within 1:20, turned at random, shallow, resting or apart
  degenerate,  ///< exact, near-exact and symmetric
  extreme,     ///< aspect, scale, distance from the origin, depth of the order of the size
  recorded,    ///< as simulated scenes produced it, as often as they did
  given        ///< of given_class alone
};
/// Those whose classes can be drawn.
inline constexpr Group all_groups[] = {Group::everyday, Group::degenerate, Group::extreme,
                                       Group::recorded};
/// Those that a report may have, in its order.
inline constexpr Group reported_groups[] = {Group::everyday, Group::degenerate, Group::extreme,
                                            Group::recorded, Group::given};
const char* group_name(Group group);
/// Throws InvalidInput with this field that lists the groups whose classes can be drawn.
Group parse_group(std::string_view name, const char* field = "--group");

/// The parts of a class's name.
struct ClassParts {
  std::string arrangement;
  std::vector<std::string> modifiers;
};

/// A named family of configurations of one pair: an arrangement and modifiers that make sense of
/// it.
struct PoseClass {
  PoseClass(Pair of, const Arrangement* arranged, const Modifiers& modified)
      : pair(of), arrangement(arranged), modifiers(modified) {}
  /// Reads a name: modifiers in any order, or a name from before there were modifiers
  /// ("near-parallel-1e-6"). Throws InvalidInput (field "identity.class") that says what is nearest
  /// to an unknown name, or why a modifier makes no sense.
  PoseClass(Pair pair, std::string_view name);

  std::string name() const;  ///< "perpendicular-t+turned"
  /// Sentences: the geometry that the class makes, why it is hard, and how it is modified.
  std::string description() const;
  Group group() const;
  ClassParts parts() const;
  Configuration generate(Draw& draw) const;
  bool operator==(const PoseClass&) const = default;

  Pair pair;
  const Arrangement* arrangement;
  Modifiers modifiers;
};

/// The class of that name; absent if the pair has none.
std::optional<PoseClass> find_pose_class(Pair pair, std::string_view name);
/// Likewise of names in a report, which may also be given_class.
std::optional<PoseClass> find_pose_class(std::string_view pair, std::string_view name);

/// The class in a report of configurations that came in a file: "given". It has no identities, and
/// is the only one of its group, which has the same name.
PoseClass given_class(Pair pair);

/// The name of one sampled configuration: "cylinder-box/parallel+tilted-1e-6/42/137".
struct Identity {
  Identity(const PoseClass& c, std::uint64_t s, std::uint64_t i)
      : pose_class(c), seed(s), index(i) {}
  /// Finds the class by its name. Throws like PoseClass.
  Identity(Pair pair, std::string_view name, std::uint64_t s, std::uint64_t i)
      : Identity(PoseClass(pair, name), s, i) {}

  PoseClass pose_class;
  std::uint64_t seed;
  std::uint64_t index;

  bool operator==(const Identity&) const = default;
};

std::string to_string(const Identity& identity);

/// Reads what to_string wrote; a class may have an old name or its modifiers in another order.
/// Throws InvalidInput that names the part and its value, and for pairs and classes what is near.
Identity parse_identity(std::string_view text);

/// Reads a pair's name; throws InvalidInput with this field that lists the existing ones.
Pair parse_pair(std::string_view name, const char* field = "identity.pair");

/// How many of an arrangement and its modifiers occur together in every sensible combination.
enum class Coverage {
  pairs,
  triples,
  suite_1,  ///< pairs, of the arrangements and modifiers that touchstone-suite-1 may have
  suite_2   ///< likewise touchstone-suite-2, for which they are called of suites 1 to 3
};

/// Names of the pose classes of a pair that cover so much, in report order: without those that run
/// only when named ("hostile").
const std::vector<std::string>& pose_classes(Pair pair, Coverage coverage = Coverage::pairs);

/// Which pose classes are meant.
struct ClassSelection {
  std::vector<std::string> names = {};  ///< in this order; empty: all of the coverage
  std::vector<Group> groups = {};       ///< and of these groups; empty: of all
  Coverage coverage = Coverage::pairs;
};
/// Those of the selected classes that a pair has, each once; and their names.
std::vector<PoseClass> selected(Pair pair, const ClassSelection& selection);
std::vector<std::string> selected_classes(Pair pair, const ClassSelection& selection);

/// Throws InvalidInput (field "--class") that says what is near, unless every class belongs to at
/// least one of the pairs.
void check_pose_classes(const std::vector<Pair>& pairs, const std::vector<std::string>& classes);
/// Likewise (field "--group") unless some class of the pairs belongs to one of the groups.
void check_groups(const std::vector<Pair>& pairs, const ClassSelection& selection);

/// Arrangement and modifiers of a class by its name. Throws like PoseClass.
ClassParts parts_of(Pair pair, std::string_view pose_class);

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
  std::string id = {};  ///< that the line in the file gives itself; empty for one without
  std::optional<Sweep> sweep = {};  ///< of body A, where the line has one: a cast
};
Subject subject(const Identity& identity);

}  // namespace touchstone
