#pragma once

#include "properties/pose_class.hpp"

namespace touchstone {

/// Bodies turned against each other by 3-4-5 angles that touch in a point or along an edge:
/// signed distance zero to the last bit, with no cap, side or face aligned with another.
PoseClass touching_tilted(Pair pair);

}  // namespace touchstone
