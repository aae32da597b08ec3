#pragma once

#include <vector>

#include "oracle/patch/contact_patch.hpp"

namespace touchstone {

/// How much of a contact patch the hull of contact points spans, seen along the normal: the largest
/// factor, at most 1, by which the patch may be shrunk about its centroid and still lie within the
/// hull. In other words the hull's reach from the patch's centroid relative to the patch's own, in
/// the direction where that is least, which is also how far a body's weight may lean before it
/// tips. A full disc has 1/2 with three points 120° apart, cos 45° with four, cos 22.5° with eight;
/// points that do not surround the centroid have 0.
///
/// A patch that is nowhere wider than `resolution` (metres) counts as a point, and has 1 with any
/// point at all; one that is so in one direction as a segment, of which points must reach both
/// ways. Where a point lies off the patch, or off the plane, is not judged here.
double coverage(const oracle::ContactPatch& patch, const std::vector<Vec3>& points,
                double resolution);

}  // namespace touchstone
