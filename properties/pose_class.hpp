#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "properties/draw.hpp"
#include "properties/identity.hpp"

namespace touchstone {

/// How two bodies lie to each other.
struct Arrangement {
  enum class Orientations {
    random,    ///< at any angle to each other, in any frame
    nearly,    ///< parallel or perpendicular but for rounding, in any frame
    exact,     ///< parallel or perpendicular, in the frame of a Lattice
    pitched,   ///< at 3-4-5 angles, in the frame of a Lattice
    recorded,  ///< as it was: nothing may be changed
    mixed,     ///< everything at once: no modifier adds to it
    given      ///< in a file: nothing is known of it
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
  int suite = 1;  ///< the first touchstone-suite that may have it; the first one's is its pair's

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
/// Exactly parallel bodies on a Lattice, diagonally beyond each other or within each other.
std::vector<Arrangement> parallel_arrangements(Pair pair);
/// What the shipped scenes produced (recorded.hpp); absent where they produced nothing.
std::optional<Arrangement> recorded_arrangement(Pair pair);
/// Combinations of all difficulties.
Arrangement hostile(Pair pair);

/// Whether body B has faces, edges and vertices: it is a box or a hull.
inline bool has_faces(Pair pair) { return pair == Pair::box || pair == Pair::convex; }

/// Why a modifier makes no sense of an arrangement of that pair; absent where it does.
std::optional<std::string_view> nonsense(Pair pair, const Arrangement& arrangement,
                                         const Modifier& modifier);

/// The class of that name, or why the pair has none.
std::variant<PoseClass, std::string> parse_pose_class(Pair pair, std::string_view name);

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
/// arrangement alone and, where it makes sense, aligned, turned and worn, and with each form of
/// hull; "recorded" is the last. `Coverage::suite_1` and `suite_2` are of what there
/// was then.
const std::vector<PoseClass>& covering_classes(Pair pair, Coverage coverage);

}  // namespace touchstone
