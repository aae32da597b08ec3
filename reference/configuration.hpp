#pragma once

#include "pose.hpp"
#include "shape.hpp"

namespace touchstone {

/// Two shapes with their poses in one world frame. Body A is the cylinder, body B the other one;
/// normals point from B to A.
struct Configuration {
  Cylinder a;
  Pose pose_a;
  Shape b;
  Pose pose_b;
};

/// Which shape meets the cylinder.
enum class Pair { plane, sphere, capsule, cylinder, box, convex };
inline constexpr Pair all_pairs[] = {Pair::plane,    Pair::sphere, Pair::capsule,
                                     Pair::cylinder, Pair::box,    Pair::convex};

Pair pair_of(const Configuration& configuration);
/// "cylinder-plane", "cylinder-sphere", "cylinder-capsule", "cylinder-cylinder", "cylinder-box",
/// "cylinder-convex".
const char* pair_name(Pair pair);

/// The smallest half extent of both bodies: the length to which depth errors are relative.
double smaller_size(const Configuration& configuration);
/// The largest half extent of both bodies: the length to which rounding errors are relative.
double larger_size(const Configuration& configuration);

}  // namespace touchstone
