#pragma once

#include "reference/configuration.hpp"

namespace touchstone::audit {

/// A power of two near the configuration's largest length, metres: in multiples of it nothing
/// overflows.
double unit_of(const Configuration& configuration);

/// Throws InvalidInput unless the width is positive and finite.
void check_width(double width);

}  // namespace touchstone::audit
