#pragma once

#include "contact.hpp"

namespace touchstone {

/// Keeps at most `max_points` (at least one) of a contact's points, in their order, for an engine
/// whose manifolds hold fewer: of all such subsets with one of the deepest points, the one that
/// spans most across the normal, an area or, of two points, a length. Points count as equally deep
/// within a millionth of the patch's length, and a later subset has to span more by a thousandth,
/// so that rounding does not exchange the points of a body at rest. Nothing is done where there
/// are few enough; else at most 0.4 µs.
void reduce_points(Contact& contact, int max_points);

}  // namespace touchstone
