#pragma once

#include <optional>

#include "oracle/truth.hpp"
#include "reference/configuration.hpp"

// How far an answered normal is from the optimal ones, as an angle and in what it costs.

namespace touchstone {

/// Degrees between two directions of any length.
double angle_between(const Vec3& n, const Vec3& m);

/// The optimal normal nearest to a direction: one of those listed, or a member of a family that is
/// a circle or an arc.
Vec3 nearest_normal(const oracle::Truth& truth, const Vec3& n);

/// Degrees to the nearest optimal normal, of a direction with this regret (metres). Zero where the
/// regret is within what unit vectors of doubles cost. Absent where the optimal normals are a curve
/// that has no closed form, of which no listed one is near.
std::optional<double> angle_to_optimal(const Configuration& configuration,
                                       const oracle::Truth& truth, const Vec3& n, double regret);

/// What a unit normal costs in depth, metres: σ − g(n), but no more than it costs either body that
/// touches a half-space along an optimal normal (of those listed), of which the body feels what its
/// circumsphere reaches. So a large body, as a floor, is to a small one no more than a plane,
/// however far away it ends. `whole_regret`: σ − g(n). In double, to a few ulp of the smaller
/// body's sizes.
double felt_regret(const Configuration& configuration, const oracle::Truth& truth, const Vec3& n,
                   double whole_regret);

}  // namespace touchstone
