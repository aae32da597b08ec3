#pragma once

#include "oracle/patch/contact_patch.hpp"

namespace touchstone::oracle {

/// The plane across the unit vector n, halfway between the two support planes, with its origin
/// where `through` is seen along n and its first direction nearest to `e1` (of any length).
ContactPatch::Plane patch_plane(const Configuration& configuration, const Vec3& n,
                                const Vec3& through, const Vec3& e1);

}  // namespace touchstone::oracle
