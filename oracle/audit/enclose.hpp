#pragma once

#include <optional>

#include "reference/configuration.hpp"

namespace touchstone::audit {

/// The accuracy wanted of an enclosure, and the effort allowed.
struct Budget {
  double width = 1e-9;  ///< wanted hi − lo, relative to the larger size
  int cells = 20000;    ///< bounds at most this many cells of directions, but at least six
};

/// A certain enclosure [lo, hi] of the signed distance (metres; positive apart).
struct Enclosure {
  double lo, hi;
  Vec3 normal;  ///< unit, from B to A: the gap along it is lo up to rounding
  /// Distance of a point of A and a point of B, of cores less the roundings, rounded up. It is at
  /// least σ >= lo: for separate bodies a proof that needs a single direction.
  double pair_distance;
  int cells;  ///< number of cells bounded; zero if the pair suffices
};

/// Branch and bound over directions (see oracle/audit/README.md): shares no code and no theorem
/// with the oracle. For families of optimal normals the budget is exhausted and the enclosure stays
/// wide. Throws InvalidInput unless the budget's width is positive and finite.
Enclosure enclose(const Configuration& configuration, const Budget& budget = {});

}  // namespace touchstone::audit
