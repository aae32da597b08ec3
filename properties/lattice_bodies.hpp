#pragma once

#include "properties/lattice.hpp"

namespace touchstone {

// Bodies on a Lattice: every length and position is a whole number of its steps.

using Steps = std::int64_t;
using Quaternion = Eigen::Quaterniond;

// Turns within the lattice. None has unit length; the oracle reads them as R(q)/|q|², exactly.
inline const Quaternion upright(1, 0, 0, 0);
inline const Quaternion along_x(1, 0, 1, 0);  ///< local z to the lattice's x, local x to its -z

/// Sizes in steps. For a box radius_b, other_b and half_b are the half extents; for a sphere only
/// radius_b counts; a plane has none.
struct Sizes {
  Steps radius_a, half_a;
  Steps radius_b, half_b, other_b;
};
Sizes draw_sizes(Draw& draw, const Lattice& lattice);

/// Evenly from -most to most.
Steps draw_offset(Draw& draw, Steps most);

/// B's reach along its own z beyond its centre.
Steps reach_b(Pair pair, const Sizes& sizes);

/// Where A's centre lies from B's, and how both are turned within the lattice.
struct Placement {
  Steps x, y, z;
  Quaternion turn_b = upright;
  Quaternion turn_a = upright;
};

/// The configuration. B sits a random number of whole steps from the world's origin, so that
/// positions are exact and not zero. A plane is the lattice's z <= 0 shifted likewise.
Configuration place(Draw& draw, Pair pair, const Lattice& lattice, const Sizes& sizes,
                    const Placement& placement);

}  // namespace touchstone
