#pragma once

#include "configuration.hpp"
#include "contact.hpp"

namespace touchstone {

/// The pair's own `contact` (cylinder_plane.hpp and its siblings) for a configuration.
Contact contact(const Configuration& configuration, double contact_threshold);

}  // namespace touchstone
