#pragma once

#include <vector>

#include "oracle/difference.hpp"

namespace touchstone::oracle {

/// Where a critical direction may lie: which parts of the difference make it, and for the root of
/// a polynomial the piece of its parameter that could not be ruled out.
struct CriticalSite {
  enum class Kind {
    disc_axis,   ///< ± the axis of disc `first`
    crossing,    ///< ± the cross product of segments `first` and `second`
    radial,      ///< across segment `first`, towards the vertex `signs`; the one disc is flat on
    rim_vertex,  ///< from the one disc's rim to the vertex `signs`
    rim_line,  ///< across segment `first`, disc `second` seen as an ellipse, at the vertex `signs`
    rim_rim    ///< between the rims of both discs, at the vertex `signs`
  };
  Kind kind;
  unsigned first = 0, second = 0;
  unsigned signs = 0;  ///< Bit i: the direction is on the positive side of segment i's axis.
  /// rim_line: the direction is x e + y f over the segment's frame, with (x, y) = (1, t) turned by
  /// `turn` quarters. rim_rim: the point of the first rim is at the angle 2 atan t, half a circle
  /// further when `turn` is 1. In both, lo <= t <= hi within [-1, 1].
  unsigned turn = 0;
  double lo = 0, hi = 0;
};

/// Every site that could hold a direction whose gap is within `slack` (metres, >= 0) of the signed
/// distance: those that double intervals cannot exclude. Complete (oracle/README.md); a site that
/// holds no maximum does no harm. Not for a plane.
std::vector<CriticalSite> critical_sites(const Difference& difference, double slack);

}  // namespace touchstone::oracle
