#pragma once

#include "contact.hpp"
#include "posed_body.hpp"

namespace touchstone {

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
void offer_normals(const PosedSphere&, const Vec3&, Offer) {}
template <class Offer>
void offer_normals(const PosedBox& s, const Vec3&, Offer offer) {
  for (int i = 0; i < 3; ++i) offer(s.axes.col(i));
}

/// Of the normals whose gap is within `threshold` of the largest, the one nearest to `previous`:
/// an axis or face of a body, radially off one, or the one found; and where all of these are more
/// than 5 degrees away, the previous one itself. Nearer ones are taken for its own motion.
/// `previous_normal` may have any length; zero or not finite, it decides nothing.
template <class Body>
SignedDistance nearest_tie(const PosedCylinder& a, const Body& b, const SignedDistance& found,
                           double threshold, const Vec3& previous_normal) {
  const double largest = previous_normal.cwiseAbs().maxCoeff();
  if (!(largest > 0 && previous_normal.allFinite())) return found;
  const Vec3 previous = (previous_normal / largest).normalized();
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
  constexpr double cosine_of_5_degrees = 0.9962;
  if (nearest < cosine_of_5_degrees) offer(previous);
  return chosen;
}

}  // namespace touchstone
