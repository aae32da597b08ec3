#pragma once

#include <rapidcheck.h>
#include <string_view>

#include "properties/identity.hpp"

namespace touchstone {

/// A pose class as a rapidcheck generator, for property tests. make_configuration draws from the
/// same one. Throws InvalidInput when the pair has no such class.
rc::Gen<Configuration> configurations(Pair pair, std::string_view pose_class);

}  // namespace touchstone
