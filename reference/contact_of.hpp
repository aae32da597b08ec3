#pragma once

#include "configuration.hpp"
#include "contact.hpp"

namespace touchstone {

// The pair's own routines (cylinder_plane.hpp and its siblings) for a configuration.

SignedDistance signed_distance(const Configuration& configuration);
CertifiedDistance certified_distance(const Configuration& configuration);
bool overlaps(const Configuration& configuration);
Contact contact(const Configuration& configuration, double contact_threshold,
                const Vec3* previous_normal = nullptr);

}  // namespace touchstone
