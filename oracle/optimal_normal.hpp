#pragma once

#include <array>
#include <vector>

#include "reference/configuration.hpp"

namespace touchstone::oracle {

/// Exact relation of an optimal normal to one of a body's own axes; no tolerance is involved.
enum class Alignment { oblique, parallel, perpendicular };

/// One direction that reaches the signed distance.
struct OptimalNormal {
  Vec3 n;  ///< unit, from B to A, in world coordinates, to within a few ulp
  /// Relation to body A's axis, and to body B's x, y and z axes. A shape of revolution has only z;
  /// all others, and those of planes and spheres, stay oblique.
  Alignment to_a = Alignment::oblique;
  std::array<Alignment, 3> to_b{};
};

/// A continuous family of optimal normals. World coordinates, unit vectors.
struct NormalFamily {
  enum class Kind {
    circle,  ///< all normals perpendicular to `axis`
    arc,     ///< the part of that circle from ends[0] to ends[1], right-handed about `axis`
    curve    ///< normals of two rims at constant distance; no closed form is given
  };
  Kind kind;
  Vec3 axis = Vec3::Zero();
  std::vector<Vec3> ends;
};

}  // namespace touchstone::oracle
