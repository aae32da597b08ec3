#pragma once

#include "reduced_pair.hpp"

namespace touchstone {

/// Offers `best` the normals across segment `line` that can be optimal between those across a
/// second segment too. Seen along the line, the sum of segments and discs is a convex region of the
/// plane: its corners are rounded by the discs' ellipses, and each corner has an arc of normals.
void offer_line_normals(const ReducedPair& pair, int line, BestNormal& best);

}  // namespace touchstone
