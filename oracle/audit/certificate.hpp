#pragma once

#include <array>
#include <gmpxx.h>
#include <optional>
#include <string>
#include <vector>

#include "oracle/audit/enclose.hpp"

namespace touchstone::audit {

using RationalVector = std::array<mpq_class, 3>;

/// A point of A and a point of B, each in its own body frame, metres.
struct RationalPair {
  RationalVector a, b;
};

/// A proof of lo <= signed distance <= hi that rational arithmetic can follow (docs/certificate.md;
/// oracle/check_certificate.py does).
struct Certificate {
  mpq_class lo, hi;  ///< Metres.
  /// lo and hi are multiples of it, and no narrower multiples follow from this proof.
  mpq_class grain;
  RationalVector normal;  ///< World, any length: the gap along it is not below lo.
  /// If hi >= 0, or B is a plane: points no farther apart than hi (of a plane: along its normal).
  std::optional<RationalPair> pair;
  struct Cell {
    /// The face of the cube, 0 to 5, then a quarter, 0 to 3, for each level (direction_cell.hpp).
    std::string path;
    RationalPair pair;  ///< Bounds the gap by hi along the cell's directions.
  };
  std::vector<Cell> cells;  ///< Otherwise: they cover the cube.
};

/// Proves an enclosure no wider than the budget's width times the larger size, or, where families
/// of optimal normals exhaust its cells, the width reached by then. The search runs in 400 bits,
/// which is enough down to a width of 1e-60; what proves hi is checked in rationals before it is
/// returned (std::logic_error if it fails). Throws InvalidInput unless the width is positive and
/// finite.
Certificate certify(const Configuration& configuration, const Budget& budget);

}  // namespace touchstone::audit
