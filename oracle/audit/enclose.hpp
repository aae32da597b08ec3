#pragma once

#include <optional>

#include "reference/configuration.hpp"

namespace touchstone::audit {

/// What may be spent on an enclosure.
struct Budget {
  double width = 1e-9;  ///< Wanted hi − lo, relative to the larger size.
  int cells =
      20000;  ///< At most so many cells of directions are bounded, but the cube's six faces.
};

/// The signed distance (metres; positive apart) lies in [lo, hi]: certain, whatever the width.
struct Enclosure {
  double lo, hi;
  Vec3 normal;  ///< Unit, from B to A: the gap along it is lo, but for rounding.
  /// Distance of a point of A and a point of B, rounded up. Bodies that are apart by σ have
  /// distance >= σ >= lo: a proof that needs no directions but one.
  double pair_distance;
  int cells;  ///< Bounded; none where the pair suffices.
};

/// Branch and bound over directions (see oracle/audit/README.md): shares no code and no theorem
/// with the oracle. Families of optimal normals exhaust the budget and leave the enclosure wide.
/// Throws InvalidInput unless the budget's width is positive and finite.
Enclosure enclose(const Configuration& configuration, const Budget& budget = {});

}  // namespace touchstone::audit
