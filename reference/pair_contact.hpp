#pragma once

#include "contact.hpp"
#include "posed_body.hpp"

namespace touchstone {

/// Sets an empty contact to the whole answer for a known signed distance. `origin` is where the
/// bodies' frame lies in the world; `previous_normal` may be null.
template <class Body>
void make_contact(Contact& result, const PosedCylinder& a, const Body& b, SignedDistance found,
                  double contact_threshold, const Vec3& origin, const Vec3* previous_normal);

}  // namespace touchstone
