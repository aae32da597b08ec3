#pragma once

#include "contact.hpp"
#include "reduced_pair.hpp"

namespace touchstone {

/// The answer for a known normal: its one contact point halfway between the facing points of the
/// two surfaces, if they are no further apart than the threshold.
Contact with_deepest_point(const Configuration& configuration, const BestNormal& best,
                           double contact_threshold);

}  // namespace touchstone
