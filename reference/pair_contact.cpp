#include "pair_contact.hpp"

#include <algorithm>

#include "manifold.hpp"

namespace touchstone {
namespace {

double largest(const PosedCylinder& s) { return std::max(s.radius, s.half_length); }
double largest(const PosedCapsule& s) { return s.half_length + s.radius; }
double largest(const PosedBox& s) { return s.half_extents.maxCoeff(); }

/// Calls `offer` with the unit vectors along a body's axes and, of bodies of revolution, radially
/// along `v`.
template <class Revolved, class Offer>
void offer_normals(const Revolved& s, const Vec3& v, Offer offer) {
  offer(s.axis);
  const Vec3 radial = v - v.dot(s.axis) * s.axis;
  constexpr double noise = 1e-12, vanishing = 1e-100;
  if (const double length = radial.norm(); length > noise * v.norm() + vanishing) {
    offer(radial / length);
  }
}
template <class Offer>
void offer_normals(const PosedBox& s, const Vec3&, Offer offer) {
  for (int i = 0; i < 3; ++i) offer(s.axes.col(i));
}

/// Of the normals whose gap is within `threshold` of the largest, the one nearest to `previous`:
/// an axis or face of a body, radially off one, or the one found.
template <class Body>
SignedDistance nearest_tie(const PosedCylinder& a, const Body& b, const SignedDistance& found,
                           double threshold, const Vec3& previous) {
  const Vec3 d = a.centre - b.centre;
  SignedDistance chosen = found;
  double nearest = found.normal.dot(previous);
  const auto offer = [&](const Vec3& axis) {
    const Vec3 n = axis.dot(previous) < 0 ? Vec3(-axis) : axis;
    if (!(n.dot(previous) > nearest)) return;
    const double gap = d.dot(n) - reach(a, n) - reach(b, n);
    if (!(gap >= found.value - threshold)) return;
    chosen = {gap, n};
    nearest = n.dot(previous);
  };
  for (const Vec3& v : {d, previous}) {
    offer_normals(a, v, offer);
    offer_normals(b, v, offer);
  }
  return chosen;
}

}  // namespace

template <class Body>
Contact with_manifold(const PosedCylinder& a, const Body& b, SignedDistance found,
                      double contact_threshold, const Vec3& origin, const Vec3* previous_normal) {
  Contact result;
  if (previous_normal && found.value <= contact_threshold) {
    found = nearest_tie(a, b, found, contact_threshold, *previous_normal);
  }
  result.normal = found.normal;
  result.signed_distance = found.value;
  if (found.value > contact_threshold) return result;
  const ManifoldRule rule(largest(a), largest(b), (a.centre - b.centre).norm(), found.value,
                          contact_threshold);
  add_manifold(result, facing(a, -found.normal, rule.slack), facing(b, found.normal, rule.slack),
               origin, rule);
  return result;
}

template Contact with_manifold(const PosedCylinder&, const PosedCapsule&, SignedDistance, double,
                               const Vec3&, const Vec3*);
template Contact with_manifold(const PosedCylinder&, const PosedCylinder&, SignedDistance, double,
                               const Vec3&, const Vec3*);
template Contact with_manifold(const PosedCylinder&, const PosedBox&, SignedDistance, double,
                               const Vec3&, const Vec3*);

}  // namespace touchstone
