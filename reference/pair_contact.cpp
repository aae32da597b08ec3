#include "pair_contact.hpp"

#include <algorithm>
#include <limits>
#include <type_traits>

#include "manifold.hpp"
#include "nearest_tie.hpp"

namespace touchstone {
namespace {

Extents extents(const PosedCylinder& s) {
  return {std::min(s.radius, s.half_length), std::max(s.radius, s.half_length)};
}
Extents extents(const PosedCapsule& s) { return {s.radius, s.half_length + s.radius}; }
Extents extents(const PosedBox& s) {
  return {s.half_extents.minCoeff(), s.half_extents.maxCoeff()};
}

/// Adds a point of the whole depth to a contact whose `deepest` point misses some of it: features
/// that lean are carried to each other with an error of the second order, which may part them. If
/// it is their lean, one body has one deepest point; else rounding, in whose frame the deepest
/// point that there is will do.
template <class Body>
void add_deepest(Contact& contact, const PosedCylinder& a, const Body& b, const Vec3& origin,
                 const Margins& margins, const ContactPoint& deepest) {
  const double depth = -contact.signed_distance;
  const SupportPoint on_a = support_point(a, -contact.normal);
  const SupportPoint on_b = support_point(b, contact.normal);
  Vec3 position = deepest.position;
  if (contact.points().empty() ||
      std::max(on_a.sharpness, on_b.sharpness) > depth - deepest.depth) {
    const Vec3 half = depth / 2 * contact.normal;
    position = origin + (on_a.sharpness >= on_b.sharpness ? Vec3(on_a.position + half)
                                                          : Vec3(on_b.position - half));
  }
  const Contact before = contact;
  contact.clear_points();
  contact.add_point(position, depth);
  for (const ContactPoint& p : before.points()) {
    const bool is_near = p.depth >= depth - margins.slack - margins.rounding;
    if (is_near && p.position != position && contact.points().size() < Contact::max_points) {
      contact.add_point(p.position, p.depth);
    }
  }
}

/// Sees to a point of the whole depth.
template <class Body>
void hold_depth(Contact& contact, const PosedCylinder& a, const Body& b, const Vec3& origin,
                const Margins& margins) {
  const ContactPoint* deepest = nullptr;
  for (const ContactPoint& p : contact.points()) {
    if (!deepest || p.depth > deepest->depth) deepest = &p;
  }
  constexpr double none = -std::numeric_limits<double>::infinity();
  const ContactPoint there = deepest ? *deepest : ContactPoint{Vec3::Zero(), none};
  if (!(-contact.signed_distance - there.depth <= margins.unseen_depth())) {
    add_deepest(contact, a, b, origin, margins, there);
  }
}

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
  const Margins margins(extents(a), extents(b), between.cwiseAbs().sum(), found.value,
                        contact_threshold);
  // A well-known point is all there is to say, whatever the other body turns towards it. Asked
  // first is the body that has one more often.
  const auto is_known = [](const FacingFeature& x) {
    return x.kind == FacingFeature::Kind::point && x.sine > 0.5;
  };
  const Vec3 half = found.value / 2 * found.normal;
  if constexpr (std::is_same_v<Body, PosedCapsule>) {
    const FacingFeature on_b = facing(b, found.normal, margins.flat);
    if (is_known(on_b)) return result.add_point(origin + (on_b.middle + half), -found.value);
    add_manifold(result, facing(a, -found.normal, margins.flat), on_b, origin, margins);
  } else {
    const FacingFeature on_a = facing(a, -found.normal, margins.flat);
    if (is_known(on_a)) return result.add_point(origin + (on_a.middle - half), -found.value);
    add_manifold(result, on_a, facing(b, found.normal, margins.flat), origin, margins);
  }
  hold_depth(result, a, b, origin, margins);
}

template void make_contact(Contact&, const PosedCylinder&, const PosedCapsule&, SignedDistance,
                           double, const Vec3&, const Vec3*);
template void make_contact(Contact&, const PosedCylinder&, const PosedCylinder&, SignedDistance,
                           double, const Vec3&, const Vec3*);
template void make_contact(Contact&, const PosedCylinder&, const PosedBox&, SignedDistance, double,
                           const Vec3&, const Vec3*);

}  // namespace touchstone
