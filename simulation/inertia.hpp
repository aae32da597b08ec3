#pragma once

#include "reference/shape.hpp"

namespace touchstone {

/// Of a solid body of even density, about its centre.
struct Inertia {
  double mass;     ///< kg
  Vec3 principal;  ///< kg m², about the shape's own axes
};

/// Closed forms of the solid shapes. A plane has none: zeros.
Inertia inertia(const Shape& shape, double density);

}  // namespace touchstone
