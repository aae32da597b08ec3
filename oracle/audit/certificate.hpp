#pragma once

#include <array>
#include <gmpxx.h>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "oracle/audit/enclose.hpp"

namespace touchstone::audit {

using RationalVector = std::array<mpq_class, 3>;

/// A point of A and a point of B, of their cores if they are rounded, each in its own body frame,
/// metres.
struct RationalPair {
  RationalVector a, b;
  /// In a hull, instead of `b`: weights of vertices, none negative, whose mean is the point.
  std::vector<std::pair<int, mpq_class>> weights;
};

/// A proof of lo <= signed distance <= hi that can be checked in rational arithmetic
/// (oracle/truth.md; oracle/check_certificate.py does so).
struct Certificate {
  mpq_class lo, hi;  ///< metres
  /// lo and hi are multiples of the grain, and this proof implies no narrower multiples.
  mpq_class grain;
  RationalVector normal;  ///< world, any length: the gap along it is at least lo
  /// Present if the cores do not overlap or B is a plane: points at most hi apart, with the
  /// roundings added (for a plane: along its normal).
  std::optional<RationalPair> pair;
  struct Cell {
    /// The face of the cube, 0 to 5, then for each level the quarter, 0 to 3 (DirectionCell).
    std::string path;
    RationalPair pair;  ///< bounds the gap by hi along the cell's directions
  };
  std::vector<Cell> cells;  ///< otherwise; they cover the cube
};

/// Proves an enclosure no wider than the budget's width times the larger size. If families of
/// optimal normals exhaust the budget's cells, the enclosure has the width reached by then. The
/// search runs in 400 bits, which suffices down to a width of 1e-60; the proof of hi is checked in
/// rationals before it is returned (std::logic_error if it fails). Throws InvalidInput unless the
/// width is positive and finite.
Certificate certify(const Configuration& configuration, const Budget& budget);

}  // namespace touchstone::audit
