#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "shape.hpp"

namespace touchstone {

/// An offset whose square would lose its digits is nothing against any body's size
/// (`powers_in_range`).
inline double without_vanishing(double offset) {
  constexpr double vanishing = 1e-100;
  return std::abs(offset) < vanishing ? 0.0 : offset;
}

/// A `stop_above` for the largest clearance, and no other.
inline constexpr double no_early_exit = std::numeric_limits<double>::infinity();

/// A sum, product, quotient or square root is rounded by at most this part of itself.
inline constexpr double unit_roundoff = std::numeric_limits<double>::epsilon() / 2;

/// Rounding moves a clearance, of bodies as they are given, by at most this part of all lengths
/// together (proofs.md, "Rounding of a certified distance").
inline constexpr double rounding_part = 64 * unit_roundoff;

/// Gaps that differ by this part of all lengths together may be one.
inline constexpr double tie_part = 2 * unit_roundoff;

/// What early exits leave for the rounding of a point of a body: this part of all lengths together.
inline constexpr double proof_part = 8 * unit_roundoff;

/// What rounding leaves of a clearance is far less than this part of all lengths together. No
/// answer may hang on what it makes of a touch, so a normal that is not always tried must part the
/// bodies by more than that.
inline constexpr double clear_part = 1e-9;

/// How deep bodies with this gap lie in each other; zero apart.
inline double depth(double gap) { return std::max(0.0, -gap); }

/// The largest clearance met so far and its normal, in whatever frame the pair is solved in.
struct LargestGap {
  double gap = -std::numeric_limits<double>::infinity();
  Vec3 normal = Vec3::UnitZ();

  /// Of normals that tie the first one stays. What is not of unit length is no normal, whatever
  /// its gap: a vector that vanished by cancellation has the gap 0.
  void offer(double other, const Vec3& n) {
    if (other > gap && is_unit(n)) gap = other, normal = n;
  }
  static bool is_unit(const Vec3& n) {
    constexpr double rounding = 1e-12;
    return std::abs(n.squaredNorm() - 1) < rounding;
  }
};

/// What a stage of a search has found: a normal with its gap, and whether that is proven to be the
/// largest of all. Without a normal the gap is minus infinity.
struct StageResult {
  double gap = -std::numeric_limits<double>::infinity();
  double x = 0, y = 0, z = 1;  ///< the normal's; one by one they stay in registers
  bool is_proven = false;

  Vec3 normal() const { return {x, y, z}; }
  /// Keeps the better of both.
  void improve(const StageResult& later) {
    if (!(later.gap > gap)) return;
    gap = later.gap;
    x = later.x, y = later.y, z = later.z;
    is_proven = later.is_proven;
  }
};

/// When a search ends before all kinds of normals are tried.
struct EarlyExit {
  double stop_above;          ///< at the first gap above this
  bool trusts_proofs = true;  ///< at a gap that is proven to be the largest

  bool ends_with(const StageResult& best) const {
    return best.gap > stop_above || (trusts_proofs && best.is_proven);
  }
};
inline constexpr EarlyExit no_short_cuts{no_early_exit, false};

}  // namespace touchstone
