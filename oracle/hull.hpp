#pragma once

#include <vector>

#include "reference/shape.hpp"

namespace touchstone::oracle {

/// The convex hull of the points, found exactly: no rounding decides which of them are vertices or
/// which faces are plane. The vertices keep the points' order; points inside, on a face or on an
/// edge and repeated ones are dropped. Points in one plane give a polygon with two faces.
///
/// Throws InvalidInput of the field "vertices" for points that are not finite or all on one line,
/// or more than Convex::max_vertices corners; and as Convex does for its rounding.
Convex convex_hull(const std::vector<Vec3>& points, double rounding = 0);

}  // namespace touchstone::oracle
