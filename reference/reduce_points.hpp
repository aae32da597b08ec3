#pragma once

#include <algorithm>
#include <limits>

#include "configuration.hpp"
#include "contact.hpp"

namespace touchstone {

/// Keeps at most `max_points` (at least one) of a contact's points, in their order, for an engine
/// whose manifolds hold fewer: of all such subsets with one of the deepest points, the one that
/// spans most across the normal, an area or, of two points, a length. Bodies that lean by no more
/// than `level` count as level, and a later subset has to span more by a thousandth, so that
/// rounding does not exchange the points of a body at rest: an engine in single precision needs
/// some 1e-6. What is kept lacks at most `max_lack` (metres) of the depth, whatever leans: a needle
/// rises by its own width at a small angle. Nothing is done where there are few enough; else it
/// takes at most 1 µs.
void reduce_points(Contact& contact, int max_points, double level = 1e-9,
                   double max_lack = std::numeric_limits<double>::infinity());

/// A `max_lack` for these bodies, in double precision: half a millionth of the smaller size, with
/// which no point lacks a millionth, or rounding.
inline double unseen_lack(const Configuration& bodies) {
  constexpr double rounding = 4e-15;
  return std::max(5e-7 * smaller_size(bodies), rounding * larger_size(bodies));
}

}  // namespace touchstone
