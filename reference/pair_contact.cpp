#include "pair_contact.hpp"

#include <algorithm>
#include <type_traits>

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
  // A well-known point is all there is to say, whatever the other body turns towards it. Asked
  // first is the body that has one more often.
  const auto is_known = [](const FacingFeature& x) {
    return x.kind == FacingFeature::Kind::point && x.sine > 0.5;
  };
  const Vec3 half = found.value / 2 * found.normal;
  if constexpr (std::is_same_v<Body, PosedCapsule>) {
    const FacingFeature on_b = facing(b, found.normal, slack);
    if (is_known(on_b)) return result.add_point(origin + (on_b.middle + half), -found.value);
    add_manifold(result, facing(a, -found.normal, slack), on_b, origin, slack);
  } else {
    const FacingFeature on_a = facing(a, -found.normal, slack);
    if (is_known(on_a)) return result.add_point(origin + (on_a.middle - half), -found.value);
    add_manifold(result, on_a, facing(b, found.normal, slack), origin, slack);
  }
}

template void make_contact(Contact&, const PosedCylinder&, const PosedCapsule&, SignedDistance,
                           double, const Vec3&, const Vec3*);
template void make_contact(Contact&, const PosedCylinder&, const PosedCylinder&, SignedDistance,
                           double, const Vec3&, const Vec3*);
template void make_contact(Contact&, const PosedCylinder&, const PosedBox&, SignedDistance, double,
                           const Vec3&, const Vec3*);

}  // namespace touchstone
