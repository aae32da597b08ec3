#pragma once

#include <iosfwd>
#include <rapidcheck.h>
#include <string_view>

#include "properties/identity.hpp"

namespace touchstone {

/// A pose class as a rapidcheck generator, for property tests; make_configuration draws the same
/// values. It ignores rapidcheck's size, and shrinks as in simplify.hpp, which may leave the class.
/// Throws InvalidInput if the pair has no such class.
rc::Gen<Configuration> configurations(Pair pair, std::string_view pose_class);

/// Prints a failing configuration for rapidcheck: every number as a hexadecimal float, so that no
/// bit is lost, with the names of the JSON contract. Orientations are w, x, y, z.
void showValue(const Configuration& configuration, std::ostream& out);

}  // namespace touchstone
