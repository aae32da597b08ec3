#pragma once

#include "properties/draw.hpp"
#include "properties/modifiers.hpp"
#include "properties/numbers.hpp"

namespace touchstone {

/// A part of a surface that can be in contact. A cylinder has cap, side and rim; a capsule has end
/// and side; a sphere is an end, a plane a cap; a box and a hull have cap (a face), edge and
/// vertex.
enum class Feature { cap, side, rim, end, edge, vertex };

/// Shapes and orientations, without positions.
struct Bodies {
  Cylinder a;
  Eigen::Quaterniond orientation_a;
  Shape b;
  Eigen::Quaterniond orientation_b;
};

/// The length to which drawn clearances are relative: the smallest half extent of both bodies.
double smaller_size(const Bodies& bodies);

/// Sizes log-uniform in [0.2, 1] metres; proportions and form of hull as the modifiers say.
Cylinder draw_cylinder(Draw& draw);
Bodies draw_bodies(Draw& draw, Pair pair, const Modifiers& modifiers = {});

/// Places A so that the two features face each other with the clearance `distance` (negative:
/// overlap) along their common normal, at a random point of each. For separate bodies `distance` is
/// the signed distance up to rounding; for overlapping ones it is one critical value, and the
/// signed distance unless another feature is nearer. Two vertices, or a rim and a vertex, have no
/// unique common normal: a random one of the common normals is used, and an overlap of them makes
/// the depth at most −distance.
Configuration meet(Draw& draw, const Bodies& bodies, Feature on_a, Feature on_b, double distance);

/// Like meet, at the box's edge along, or face perpendicular to, the local axis number `which`, or
/// at the hull's face or edge of that number. Where another feature of the hull lies in the way, A
/// meets that. For other shapes `which` has no effect.
Configuration meet_at(Draw& draw, const Bodies& bodies, Feature on_a, Feature on_b, double distance,
                      int which);

/// The number of a hull's edge, and a random one of its outward normals, in its frame.
struct EdgeOfHull {
  int number;
  Vec3 along, normal;  ///< unit
};
EdgeOfHull draw_edge(Draw& draw, const Convex& hull);

/// Places A's centre less than the smallest half extent from B's, in a random direction; that of a
/// needle or coin, and over a hull that of any, within the largest ball in B. Over a plane, places
/// A's lowest point 0.1 to 2 half lengths below the surface.
Configuration overlap_deeply(Draw& draw, const Bodies& bodies, Proportions proportions);

/// Bodies that overlap arbitrarily: at clear tilts from an alignment, near coincidences of their
/// sizes, with depths along and across the axes alike.
Numbers draw_entangled(Draw& draw, Pair pair);

/// A random pair of features that determine a common normal.
struct FeaturePair {
  Feature on_a, on_b;
};
FeaturePair draw_feature_pair(Draw& draw, Pair pair);

}  // namespace touchstone
