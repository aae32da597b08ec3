#pragma once

#include "contact.hpp"

namespace touchstone {

/// Keeps at most `max_points` (at least one) of a contact's points, in their order, for an engine
/// whose manifolds hold fewer: of all such subsets with one of the deepest points, the one that
/// spans most across the normal, an area or, of two points, a length. Bodies that lean by no more
/// than `level` count as level, and a later subset has to span more by a thousandth, so that
/// rounding does not exchange the points of a body at rest: an engine in single precision needs
/// some 1e-6. Nothing is done where there are few enough; else it takes at most 1 µs.
void reduce_points(Contact& contact, int max_points, double level = 1e-9);

}  // namespace touchstone
