#pragma once

#include <vector>

#include "oracle/patch/contact_patch.hpp"

namespace touchstone {

/// Share of a contact patch that the hull of the contact points spans, seen along the normal: the
/// largest factor, at most 1, such that the patch shrunk by it about its centroid lies within the
/// hull. Equivalently, the hull's extent from the patch's centroid relative to the patch's own,
/// minimised over directions: it tells how far a body's weight may lean before it tips. For a full
/// disc, three points on its rim 120° apart give 1/2, four give cos 45°, eight cos 22.5°; points
/// that do not surround the centroid give 0.
///
/// A patch that is nowhere wider than `resolution` (metres) counts as a point, which any contact
/// point covers fully; one that is narrower in one direction only counts as a segment, which points
/// must span on both sides. Points off the patch or off its plane are not penalised here.
double coverage(const oracle::ContactPatch& patch, const std::vector<Vec3>& points,
                double resolution);

}  // namespace touchstone
