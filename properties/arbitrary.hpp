#pragma once

#include <iosfwd>
#include <rapidcheck.h>
#include <string_view>

#include "properties/identity.hpp"

namespace touchstone {

/// A pose class as a rapidcheck generator, for property tests. make_configuration draws from the
/// same one. The size that rapidcheck passes is ignored; values shrink as in simplify.hpp, which
/// may leave the class. Throws InvalidInput when the pair has no such class.
rc::Gen<Configuration> configurations(Pair pair, std::string_view pose_class);

/// What rapidcheck prints of a failing configuration: every number as a hexadecimal float, so that
/// no bit is lost, in the words of the JSON contract. Orientations are w, x, y, z.
void showValue(const Configuration& configuration, std::ostream& out);

}  // namespace touchstone
