#pragma once

#include <array>

#include "oracle/audit/bodies.hpp"

namespace touchstone::audit {

/// The directions through a dyadic square on a face of the cube [−1, 1]³. All coordinates are exact
/// in R as long as the level is below its number of bits.
template <class R>
struct DirectionCell {
  int face;   ///< 2 k for the face where coordinate k is +1, 2 k + 1 where it is −1.
  int level;  ///< 0: the whole face.
  R u, v;     ///< Lowest corner in coordinates k + 1 and k + 2 (cyclically).
  R size;     ///< Side: 2^(1 − level).

  Vector<R> at(const R& x, const R& y) const {
    const int k = face / 2;
    Vector<R> m;
    m[k] = R(face % 2 == 0 ? 1 : -1);
    m[(k + 1) % 3] = x;
    m[(k + 2) % 3] = y;
    return m;
  }
  Vector<R> centre() const { return at(u + size / 2, v + size / 2); }

  /// The vectors that span the cell's cone; they lie on the cube and are not unit.
  std::array<Vector<R>, 4> corners() const {
    return {at(u, v), at(u + size, v), at(u, v + size), at(u + size, v + size)};
  }

  /// Quarter 0 to 3: bit 0 is the upper half in u, bit 1 in v.
  DirectionCell child(int quarter) const {
    const R half = size / 2;
    return {face, level + 1, quarter & 1 ? R(u + half) : u, quarter & 2 ? R(v + half) : v, half};
  }

  static DirectionCell whole_face(int face) { return {face, 0, R(-1), R(-1), R(2)}; }
};

}  // namespace touchstone::audit
