#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "reference/configuration.hpp"

namespace touchstone {

class Draw;

/// A modifier is something that is done to an arrangement of two bodies. Those of one kind exclude
/// each other; a name and an identity list them in this order, in which they are also applied.
enum class ModifierKind { clearance, proportions, hull, tilt, frame, scale, unit, distance };
inline constexpr std::size_t modifier_kinds = 8;

/// How far apart the bodies are; the usual one is the arrangement's own.
enum class Clearance { usual, shallow, apart, touching, deep };
/// Ratios of the bodies' sizes.
enum class Proportions { usual, needle, coin, plate, uneven, needles };
/// What the hull is one of; the usual one is of random points, or where the arrangement is exact a
/// box with corners cut off.
enum class HullForm { usual, regular, of_box, of_prism, triangle, wedge, nearly_coplanar };
/// The frame in which both bodies lie.
enum class Frame { usual, aligned, turned, worn };
enum class Scale { usual, tiny, huge };

struct Modifier {
  ModifierKind kind;
  int value;  ///< of the kind's enumeration; of a tilt the k of 10^-k rad; else 1
  std::string name;
  std::string description;  ///< one sentence
  int suite = 1;            ///< the first touchstone-suite that may have it
};

/// All modifiers, by kind.
const std::vector<Modifier>& all_modifiers();

/// The value of each kind; zero: not modified.
class Modifiers {
 public:
  int operator[](ModifierKind kind) const { return values_[static_cast<std::size_t>(kind)]; }
  int& operator[](ModifierKind kind) { return values_[static_cast<std::size_t>(kind)]; }
  Clearance clearance() const { return static_cast<Clearance>((*this)[ModifierKind::clearance]); }
  Proportions proportions() const {
    return static_cast<Proportions>((*this)[ModifierKind::proportions]);
  }
  HullForm hull() const { return static_cast<HullForm>((*this)[ModifierKind::hull]); }
  Frame frame() const { return static_cast<Frame>((*this)[ModifierKind::frame]); }
  Scale scale() const { return static_cast<Scale>((*this)[ModifierKind::scale]); }
  bool has(const Modifier& m) const { return (*this)[m.kind] == m.value; }

  /// Those that are set, in order.
  std::vector<const Modifier*> list() const;
  int count() const;
  bool operator==(const Modifiers&) const = default;

 private:
  std::array<int, modifier_kinds> values_{};
};

/// Draws a clearance of bodies of this size: an overlap of 1e-6 to 5% of it, log-uniform.
double draw_shallow(Draw& draw, double size);
/// A separation of 1e-6 to 1 of the size, log-uniform.
double draw_apart(Draw& draw, double size);
/// Draws as `clearance` says, which is not deep; the usual one is shallow, or in one of four draws
/// apart.
double draw_clearance(Draw& draw, Clearance clearance, double size);

/// A needle's length over its width, and so on.
inline constexpr std::int64_t extreme_ratio = 1000;
/// What proportions make of a round body: as it comes, long, or flat.
enum class Form { usual, needle, coin };
struct Forms {
  Form a, b;
};
/// The forms of both bodies; what a plate and uneven bodies are is drawn.
Forms forms(Proportions proportions);
/// Which of a plate's or bar's extents are the short ones.
std::array<bool, 3> draw_thin_extents(Draw& draw);
/// The number by which the smaller of two uneven bodies is divided.
std::int64_t draw_uneven_ratio(Draw& draw);

/// What is to be known of an arrangement to modify one of its configurations.
struct Finish {
  bool is_exact;  ///< scaling is to leave it so
  bool across;    ///< B's axis lies along A's x, and a tilt is to be towards it
};
/// Applies the modifiers of a finished configuration: all but clearance, proportions, hull and the
/// world's own frame, which go into its making.
Configuration modified(Draw& draw, const Configuration& made, const Modifiers& modifiers,
                       const Finish& finish);

}  // namespace touchstone
