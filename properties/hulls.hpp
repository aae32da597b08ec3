#pragma once

#include <vector>

#include "properties/draw.hpp"
#include "properties/modifiers.hpp"

namespace touchstone {

/// Points whose hull is a body B of that kind and of these proportions: of up to a metre, with
/// their mean at the origin of its frame but for rounding.
std::vector<Vec3> draw_hull_points(Draw& draw, HullForm form,
                                   Proportions proportions = Proportions::usual);

/// Whether the points have a hull: they are not all on one line.
bool has_hull(const std::vector<Vec3>& points);

}  // namespace touchstone
