#pragma once

#include <gmpxx.h>

#include "oracle/difference.hpp"

namespace touchstone::oracle {

/// A world vector of metres in A's frame, in units and times norm, as Difference::d is.
Vector3<mpq_class> in_units(const Difference& difference, const Vec3& metres);

/// Moves body A by t times `sweep`, exactly. All lengths become multiples of a finer unit where
/// that is needed for integers.
void move_a(Difference& difference, const Vec3& sweep, const mpq_class& t);

}  // namespace touchstone::oracle
