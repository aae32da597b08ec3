#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "properties/arrangement.hpp"
#include "properties/identity.hpp"

namespace touchstone {

/// A named family of configurations of one pair: an arrangement and modifiers that make sense of
/// it.
struct PoseClass {
  Pair pair;
  const Arrangement* arrangement;
  Modifiers modifiers;

  std::string name() const;  ///< "perpendicular-t+turned"
  std::string description() const;
  Group group() const;
  Configuration generate(Draw& draw) const;
};

/// Why a modifier makes no sense of an arrangement of that pair; absent where it does.
std::optional<std::string_view> nonsense(Pair pair, const Arrangement& arrangement,
                                         const Modifier& modifier);

/// Reads a name: modifiers in any order, or a name from before there were modifiers
/// ("near-parallel-1e-6"). Throws InvalidInput (field "identity.class") that says what is nearest
/// to an unknown name, or why a modifier makes no sense.
PoseClass find_pose_class(Pair pair, std::string_view name);

/// Whether the class begins with one of the pair's arrangements.
bool has_arrangement(Pair pair, std::string_view pose_class);
/// The three arrangements of these pairs whose names are nearest.
std::string nearest_arrangements(const std::vector<Pair>& pairs, std::string_view name);

/// The name by which the class's random stream is chosen: an old one where it has one, so that
/// identities of any age keep their bits.
std::string stream_name(const PoseClass& pose_class);

/// The classes that existed before modifiers did, in the order of that time.
const std::vector<PoseClass>& old_classes(Pair pair);

/// A covering array: every sensible combination of `strength` (2 or 3) of an arrangement and
/// modifiers occurs in at least one class. It begins with the old classes, then has every
/// arrangement alone and, where it makes sense, aligned and turned; "recorded" is the last.
const std::vector<PoseClass>& covering_classes(Pair pair, int strength);

}  // namespace touchstone
