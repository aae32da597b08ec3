#pragma once

#include <gmpxx.h>

#include "reference/configuration.hpp"

namespace touchstone::oracle {

/// A configuration without the digits that no answer can show, and what leaving them out may have
/// changed.
struct Resolved {
  Configuration configuration;
  mpq_class
      error;  ///< Metres: the signed distances differ by no more. Zero if nothing was rounded.
};

/// Bits that every truth and every contact patch keeps. Doubles within a factor of 2^139 of each
/// other lose nothing, nor do tilts of 1e-25.
inline constexpr int resolved_bits = 192;

/// Lengths are rounded to multiples of 2^-bits of the larger size, a size to no less than one of
/// them, and a quaternion's components likewise to 2^-bits of its largest one. Exact polynomials
/// are of short numbers then, whatever exponents the doubles have: a component of 1e-300 beside
/// ordinary ones makes them a hundred times longer, and their roots as much harder to isolate.
///
/// The error follows from Lipschitz bounds of the gap along any one direction: 1 in the offset of
/// the centres and in every size; a rotation of quaternion q to that of q' moves no point by more
/// than 2 |q' − q| / |q| times its distance from the centre, as sin(angle/2) <= |q' − q| / |q|.
///
/// Nothing is rounded where no polynomial arises: against a plane or a sphere.
Resolved resolved(const Configuration& configuration, int bits = resolved_bits);

}  // namespace touchstone::oracle
