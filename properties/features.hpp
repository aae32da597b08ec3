#pragma once

#include "properties/draw.hpp"

namespace touchstone {

/// A part of a surface that can be in contact. The cylinder has cap, side and rim; a capsule end
/// and side; a sphere is an end; a plane a cap; a box has cap (a face), edge and vertex.
enum class Feature { cap, side, rim, end, edge, vertex };

/// Shapes and orientations chosen, positions not yet.
struct Bodies {
  Cylinder a;
  Eigen::Quaterniond orientation_a;
  Shape b;
  Eigen::Quaterniond orientation_b;
};

/// The length to which drawn clearances are relative: the smallest half extent of both.
double smaller_size(const Bodies& bodies);

/// Sizes log-uniform in [0.2, 1] metres.
Cylinder draw_cylinder(Draw& draw);
Shape draw_other(Draw& draw, Pair pair);
Bodies draw_bodies(Draw& draw, Pair pair);

/// Moves A so that the two features meet with the clearance `distance` (negative: overlap) along
/// their common normal, at a random place of each. Apart, that is the signed distance exactly but
/// for rounding; inside, it is one critical depth, and the signed distance unless another feature
/// is nearer. Two vertices, or a rim and a vertex, have no common normal of their own: a random one
/// between their neighbours is taken, and overlapping them makes a depth of at most −distance.
Configuration meet(Draw& draw, const Bodies& bodies, Feature on_a, Feature on_b, double distance);

/// The same at the box's edge or face number `axis`, the local axis along or across which it lies.
/// Other shapes have no choice.
Configuration meet_at(Draw& draw, const Bodies& bodies, Feature on_a, Feature on_b, double distance,
                      int axis);

/// A's centre less than `most` from B's, in a random direction; over a plane, A's lowest point 0.1
/// to 2 half lengths below the surface.
Configuration overlap_deeply(Draw& draw, const Bodies& bodies, double most);

/// A random pair of features with a common normal of their own.
struct FeaturePair {
  Feature on_a, on_b;
};
FeaturePair draw_feature_pair(Draw& draw, Pair pair);

}  // namespace touchstone
