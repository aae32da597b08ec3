#include "pair_contact.hpp"

#include <algorithm>

#include "manifold.hpp"
#include "nearest_tie.hpp"

namespace touchstone {
namespace {

double largest(const PosedCylinder& s) { return std::max(s.radius, s.half_length); }
double largest(const PosedCapsule& s) { return s.half_length + s.radius; }
double largest(const PosedBox& s) { return s.half_extents.maxCoeff(); }

}  // namespace

template <class Body>
void make_contact(Contact& result, const PosedCylinder& a, const Body& b, SignedDistance found,
                  double contact_threshold, const Vec3& origin, const Vec3* previous_normal) {
  if (previous_normal && found.value <= contact_threshold) {
    found = nearest_tie(a, b, found, contact_threshold, *previous_normal);
  }
  result.normal = found.normal;
  result.signed_distance = found.value;
  if (found.value > contact_threshold) return;
  const Vec3 between = a.centre - b.centre;
  const double slack = manifold_slack(largest(a), largest(b), between.cwiseAbs().sum(), found.value,
                                      contact_threshold);
  add_manifold(result, facing(a, -found.normal, slack), facing(b, found.normal, slack), origin,
               slack);
}

template void make_contact(Contact&, const PosedCylinder&, const PosedCapsule&, SignedDistance,
                           double, const Vec3&, const Vec3*);
template void make_contact(Contact&, const PosedCylinder&, const PosedCylinder&, SignedDistance,
                           double, const Vec3&, const Vec3*);
template void make_contact(Contact&, const PosedCylinder&, const PosedBox&, SignedDistance, double,
                           const Vec3&, const Vec3*);

}  // namespace touchstone
