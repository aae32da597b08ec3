#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "properties/modifiers.hpp"

namespace touchstone {

/// How two bodies lie to each other.
struct Arrangement {
  enum class Orientations {
    random,    ///< at any angle to each other, in any frame
    nearly,    ///< parallel or perpendicular but for rounding, in any frame
    exact,     ///< parallel or perpendicular, in the frame of a Lattice
    pitched,   ///< at 3-4-5 angles, in the frame of a Lattice
    recorded,  ///< as it was: nothing may be changed
    mixed      ///< everything at once: no modifier adds to it
  };

  std::string name;
  std::string description;  ///< one sentence: the geometry, and why it is hard
  Orientations orientations;
  std::vector<Clearance> clearances;  ///< that can be asked for, besides its own
  std::function<Configuration(Draw&, const Modifiers&)> generate;
  Clearance own = Clearance::usual;  ///< what its own clearance is called, if it has a name
  bool across = false;               ///< B's axis lies along A's x, at a right angle to A's
  bool is_symmetric = false;         ///< centres or axes coincide
  bool touches = false;              ///< whatever clearance is asked for

  /// Whether nothing in it is rounded.
  bool is_exact() const {
    return orientations == Orientations::exact || orientations == Orientations::pitched;
  }
};

/// All arrangements of a pair in report order; one that is used only when named comes last.
const std::vector<Arrangement>& arrangements(Pair pair);

// The parts of that list, by how the geometry is made.

/// Random orientations, with chosen features in contact; nearly aligned bodies.
std::vector<Arrangement> feature_arrangements(Pair pair);
/// Exactly parallel, perpendicular and touching bodies on a Lattice.
std::vector<Arrangement> lattice_arrangements(Pair pair);
/// Bodies turned by 3-4-5 angles against each other that touch in a point or along an edge: signed
/// distance zero to the last bit, no cap, side or face aligned with another.
Arrangement touching_tilted(Pair pair);
/// What the shipped scenes produced (recorded.hpp); absent where they produced nothing.
std::optional<Arrangement> recorded_arrangement(Pair pair);
/// Combinations of all difficulties.
Arrangement hostile(Pair pair);

}  // namespace touchstone
