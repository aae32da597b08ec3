#pragma once

#include "oracle/first_touch.hpp"

namespace touchstone::oracle {

/// The first touch of a body that turns, too: first_touch calls it.
FirstTouch touch_of_turning(const Configuration& configuration, const Sweep& sweep);

}  // namespace touchstone::oracle
