#pragma once

#include <vector>

#include "reports/campaign.hpp"
#include "reports/report.hpp"

namespace touchstone {

/// Drake publishes the worst error of its queries for pairs of bodies of about 20 cm that overlap
/// by 2 mm: at chosen points of both surfaces (on a face, an edge, a vertex) the outward normals
/// are made opposite and the points brought 2 mm past each other, in two poses of the whole. These
/// are the same shapes, points and poses, for the pairs with a cylinder; two cylinders in both
/// orders. None for a pair that Drake publishes nothing of. Source: RobotLocomotion/drake,
/// geometry/proximity/test/characterization_utilities.cc (ShapeConfigurations, AlignPlanes, X_WAs).
std::vector<DrakeCase> drake_cases(Pair pair);

/// The worst absolute error of every candidate in signed distance beside those that Drake publishes
/// of itself.
DrakeProtocol drake_protocol(const Campaign& campaign, std::vector<CandidateProcess>& candidates);

}  // namespace touchstone
