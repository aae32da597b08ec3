#pragma once

#include "oracle/optimal_normal.hpp"

namespace touchstone {

/// An optimal normal whose alignment with the bodies' axes is decided in double: parallel or
/// perpendicular within 1e-12.
oracle::OptimalNormal with_rounded_alignment(const Configuration& configuration, const Vec3& n);

}  // namespace touchstone
