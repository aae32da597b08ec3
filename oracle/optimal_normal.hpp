#pragma once

#include <array>
#include <vector>

#include "reference/configuration.hpp"

namespace touchstone::oracle {

/// How an optimal normal lies to one of a body's own axes, exactly: not a matter of tolerance.
enum class Alignment { oblique, parallel, perpendicular };

/// One direction that reaches the signed distance.
struct OptimalNormal {
  Vec3 n;  ///< Unit vector from B to A in world coordinates, to within a few ulp.
  /// To body A's axis, and to body B's x, y and z axes. A shape of revolution about z has only z;
  /// the others, and a plane's and a sphere's, stay oblique.
  Alignment to_a = Alignment::oblique;
  std::array<Alignment, 3> to_b{};
};

/// A continuous family of optimal normals. World coordinates, unit vectors.
struct NormalFamily {
  enum class Kind {
    circle,  ///< all normals across `axis`
    arc,     ///< of that circle, right-handed about `axis` from ends[0] to ends[1]
    curve    ///< of a pair of rims whose points keep their distance; no closed form is given
  };
  Kind kind;
  Vec3 axis = Vec3::Zero();
  std::vector<Vec3> ends;
};

}  // namespace touchstone::oracle
