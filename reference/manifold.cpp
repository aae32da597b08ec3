#include "manifold.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>

#include "contact_plane.hpp"
#include "facing_feature.hpp"

namespace touchstone {

void Contact::shift_points(const Vec3& by, double deeper, double same) {
  std::size_t kept = 0;
  for (const ContactPoint& point : points()) {
    const ContactPoint moved{point.position + by, point.depth + deeper};
    const bool is_known = std::any_of(
        points_.begin(), points_.begin() + static_cast<std::ptrdiff_t>(kept),
        [&](const ContactPoint& p) { return (p.position - moved.position).norm() <= same; });
    if (!is_known) points_[kept++] = moved;
  }
  count_ = kept;
}

namespace {

using Kind = FacingFeature::Kind;

bool is_flat(const FacingFeature& f) {
  return f.kind == Kind::disc || f.kind == Kind::rectangle || f.kind == Kind::polygon;
}

/// Moves points from a rough facet's plane to its faces, and to their place in the world. Those
/// that are no longer within the slack are left out.
[[gnu::noinline, gnu::cold]] void lay_on_faces(Contact& contact, const FacingFeature& rough,
                                               const Vec3& origin, const Margins& margins) {
  const ConvexTables& tables = rough.hull->body.tables();
  const Eigen::Matrix3d to_hull = rough.hull->axes.transpose();
  const Vec3 &n = contact.normal, seen = to_hull * n;
  const Contact before = contact;
  contact.clear_points();
  for (const ContactPoint& p : before.points()) {
    const Vec3 x = to_hull * (p.position + p.depth / 2 * n - rough.hull->centre);
    double above = 0;
    for (const int f : rough.facet->faces) {
      above = std::max(above, tables.height(x, f) / tables.face_normal(f).dot(seen));
    }
    const double depth = p.depth - above;
    if (depth >= -contact.signed_distance - margins.slack - margins.rounding) {
      contact.add_point(origin + (p.position - above / 2 * n), depth);
    }
  }
}

/// Adds the points where two features face each other; by their kinds (the first of A):
///
///   point, any       that point; of two, the one that the normal's rounding moves less
///   segment, segment where they cross, or the ends of what lies side by side (line_contact.cpp)
///   segment, flat    the ends of what lies on it (line_contact.cpp)
///   disc, rectangle  the corners of what they share (flat_contact.cpp)
///   disc, polygon    likewise
///   disc, disc       the same, in the plane of the smaller one (flat_contact.cpp)
void add_points_of_features(Contact& contact, const FacingFeature& a, const FacingFeature& b,
                            const Vec3& origin, const Margins& margins) {
  const bool a_is_point = a.kind == Kind::point, b_is_point = b.kind == Kind::point;
  if (a_is_point || b_is_point) {
    const bool take_a = a_is_point && (!b_is_point || a.sine >= b.sine);
    const Vec3 half = contact.signed_distance / 2 * contact.normal;
    contact.add_point(origin + (take_a ? Vec3(a.middle - half) : Vec3(b.middle + half)),
                      -contact.signed_distance);
    return;
  }
  if (b.kind == Kind::polygon) {
    const bool is_rough = b.facet->is_rough;  // then far from the world's origin, too
    const Vec3 none = Vec3::Zero();
    const Manifold to{contact, is_rough ? none : origin, margins};
    is_flat(a) ? disc_on_polygon(to, a, b) : segment_on_flat(to, a, b, true);
    if (is_rough) lay_on_faces(contact, b, origin, margins);
    return;
  }
  const Manifold to{contact, origin, margins};
  if (!is_flat(a) && !is_flat(b)) {
    if (!segments_crossing(to, a, b)) segment_on_segment(to, a, b);
    return;
  }
  if (!is_flat(a)) return segment_on_flat(to, a, b, true);
  if (!is_flat(b)) return segment_on_flat(to, b, a, false);
  if (b.kind == Kind::rectangle) return disc_on_rectangle(to, a, b);
  const bool a_is_first =
      a.radius != b.radius ? a.radius < b.radius : points_onward(contact.normal);
  a_is_first ? disc_on_disc(to, a, b, true) : disc_on_disc(to, b, a, false);
}

/// The deepest point, the first of several.
const ContactPoint* deepest_point(const Contact& contact) {
  const auto is_less_deep = [](const auto& p, const auto& q) { return p.depth < q.depth; };
  const auto points = contact.points();
  return points.empty() ? nullptr : &*std::max_element(points.begin(), points.end(), is_less_deep);
}

/// The largest depth of a point.
double max_depth(const Contact& contact) {
  double depth = -std::numeric_limits<double>::infinity();
  for (const ContactPoint& p : contact.points()) depth = std::max(depth, p.depth);
  return depth;
}

/// How far a point of a contact with this normal lies off either body, but for what its place in
/// the world is rounded by.
template <class Body>
double off_bodies(const ContactPoint& p, const Vec3& n, const PosedCylinder& a, const Body& b,
                  const Vec3& origin) {
  const Vec3 x = p.position - origin, half = p.depth / 2 * n;
  const double rounding = std::numeric_limits<double>::epsilon() * p.position.cwiseAbs().sum();
  return std::max(outside(a, x - half), outside(b, x + half)) - rounding;
}

/// Of a hull whose faces lie nearly in one plane, or whose vertices nearly coincide, several
/// features are as far along the normal, and `facing` takes one at the first vertex, which A need
/// not meet. Goes through all of them, facets first, and sets `contact` to the points of the first
/// one that are on both bodies. False if there is none.
bool meet_any(Contact& contact, const FacingFeature& on_a, const PosedCylinder& a,
              const PosedConvex& b, const Vec3& origin, const Margins& sharp) {
  const ConvexTables& hull = b.body.tables();
  const Vec3 n = b.axes.transpose() * contact.normal;
  constexpr double as_far = 16;  // roundings, of the normal and of places
  const double level = hull.support(n) - as_far * sharp.rounding;
  const auto is_far = [&](int v) { return hull.vertex(v).dot(n) >= level; };
  Contact trial = contact;
  FacingFeature on_b;
  const auto is_met = [&] {
    trial.clear_points();
    add_points_of_features(trial, on_a, on_b, origin, sharp);
    const ContactPoint* found = deepest_point(trial);
    const bool is_right =
        found && std::abs(found->depth + trial.signed_distance) <= as_far * sharp.rounding &&
        off_bodies(*found, trial.normal, a, b, origin) <= as_far * sharp.rounding;
    if (is_right) contact = trial;
    return is_right;
  };
  for (const ConvexTables::Facet& f : hull.facets) {
    if (!f.is_rough && f.normal.dot(n) > 0 &&
        std::all_of(f.corners.begin(), f.corners.end(), is_far) &&
        (set_facet(on_b, b, f, f.corners.front()), is_met())) {
      return true;
    }
  }
  return std::any_of(hull.edges.begin(), hull.edges.end(), [&](const ConvexTables::Edge& e) {
    return is_far(e.vertices[0]) && is_far(e.vertices[1]) && (set_edge(on_b, b, e), is_met());
  });
}
template <class Body>
bool meet_any(Contact&, const FacingFeature&, const PosedCylinder&, const Body&, const Vec3&,
              const Margins&) {
  return false;
}

/// Adds a point of the whole depth, where those features meet that face each other but for
/// rounding: others, which lean, are carried to each other with an error of the second order, which
/// may part them. Points that this has put off a body are left out.
template <class Body>
[[gnu::noinline, gnu::cold]] void add_deepest(Contact& contact, const PosedCylinder& a,
                                              const Body& b, const Vec3& origin,
                                              const Margins& margins) {
  const Vec3& n = contact.normal;
  Margins sharp = margins;
  sharp.slack = sharp.flat = margins.rounding;
  const FacingFeature on_a = facing(a, -n, sharp.flat), on_b = facing(b, n, sharp.flat);
  Contact before = contact;
  contact.clear_points();
  add_points_of_features(contact, on_a, on_b, origin, sharp);
  const Contact& fuller = max_depth(contact) >= max_depth(before) ? contact : before;
  const ContactPoint* found = deepest_point(fuller);
  if (found && (found->depth < -contact.signed_distance - margins.unseen_depth() ||
                off_bodies(*found, n, a, b, origin) > margins.unseen_depth())) {
    for (const double flat : {sharp.flat, margins.flat}) {
      Contact other = contact;
      if (meet_any(other, facing(a, -n, flat), a, b, origin, sharp)) {
        contact = before = other;  // the other points were of a feature that A does not meet
        found = deepest_point(contact);
        break;
      }
    }
  }
  const Vec3 position =
      found ? found->position : origin + (on_a.middle - contact.signed_distance / 2 * n);
  const double depth = -contact.signed_distance, least = depth - margins.slack - margins.rounding;
  contact.clear_points();
  contact.add_point(position, depth);
  for (const ContactPoint& p : before.points()) {
    const bool is_on_both = off_bodies(p, n, a, b, origin) <= margins.unseen_depth();
    if (p.depth >= least && is_on_both && p.position != position &&
        contact.points().size() < Contact::max_points) {
      contact.add_point(p.position, p.depth);
    }
  }
}

/// Leaves no point that is deeper than the bodies are. What features that lean are carried off by
/// is taken from a point's depth; more than that is no point of both bodies: along a normal that
/// only ties, or where rims are tangent, the features need not reach each other.
[[gnu::noinline, gnu::cold]] void leave_no_deeper(Contact& contact, double depth,
                                                  const Margins& margins) {
  const double most =
      margins.is_near ? depth + margins.unseen_depth() : std::numeric_limits<double>::infinity();
  const Contact before = contact;
  contact.clear_points();
  for (const ContactPoint& p : before.points()) {
    if (p.depth <= most) contact.add_point(p.position, std::min(p.depth, depth));
  }
}

/// Are all points on the hull and on A, but for what those of round bodies that lean are off? Of
/// faces that are nearly in one plane the one that leans least need not be the one that A meets.
/// What is near a vertex or edge of the hull is on it, without a look at all faces.
bool are_on_both(const Contact& contact, const PosedCylinder& a, const PosedConvex& b,
                 const FacingFeature& on_b, const Vec3& origin, const Margins& margins) {
  const double largest = std::max(extents(a).largest, extents(b).largest);
  constexpr double slant = 50;    // slack over size, half squared: 1e-3 is a slant of 1e-2
  constexpr double most = 0.005;  // half of a tenth squared, by which features lean at most
  const double tolerance =
      margins.unseen_depth() +
      std::min(slant * margins.slack * margins.slack / largest, most * largest);
  const auto is_near_feature = [&](const Vec3& x) {
    if (on_b.kind == Kind::polygon) return false;
    Vec3 arm = x - on_b.middle;
    if (on_b.kind == Kind::segment) {
      arm -= std::clamp(arm.dot(on_b.axis), -on_b.half_length, on_b.half_length) * on_b.axis;
    }
    return arm.squaredNorm() <= tolerance * tolerance;
  };
  return std::all_of(contact.points().begin(), contact.points().end(), [&](const ContactPoint& p) {
    const Vec3 x = p.position - origin, half = p.depth / 2 * contact.normal;
    if (is_near_feature(x + half) && outside(a, x - half) <= tolerance) return true;
    return off_bodies(p, contact.normal, a, b, origin) <= tolerance;
  });
}
template <class Body>
bool are_on_both(const Contact&, const PosedCylinder&, const Body&, const FacingFeature&,
                 const Vec3&, const Margins&) {
  return true;
}

/// Sees to a point of the whole depth, and to none that is deeper.
template <class Body>
void hold_depth(Contact& contact, const PosedCylinder& a, const Body& b, const FacingFeature& on_b,
                const Vec3& origin, const Margins& margins) {
  const double depth = -contact.signed_distance;
  double deepest = max_depth(contact);
  if (deepest > depth + margins.rounding) {
    leave_no_deeper(contact, depth, margins);
    deepest = max_depth(contact);
  }
  if (!(depth - deepest <= margins.unseen_depth()) ||
      !are_on_both(contact, a, b, on_b, origin, margins)) {
    add_deepest(contact, a, b, origin, margins);
  }
}

}  // namespace

template <class Body>
void add_facing_points(Contact& contact, const PosedCylinder& a, const Body& b, const Vec3& origin,
                       double contact_threshold, PointRange range) {
  const Vec3 &n = contact.normal, between = a.centre - b.centre;
  double offset = between.cwiseAbs().sum();
  if constexpr (std::is_same_v<Body, PosedConvex>) offset += lengths(b).sum;
  const Margins margins(extents(a), extents(b), offset, contact.signed_distance, contact_threshold,
                        range);
  // A well-known point is all there is to say, whatever the other body turns towards it. Asked
  // first is the body that has one more often.
  const auto is_known = [](const FacingFeature& x) {
    return x.kind == Kind::point && x.sine > 0.5;
  };
  const Vec3 half = contact.signed_distance / 2 * n;
  if constexpr (std::is_same_v<Body, PosedCapsule>) {
    const FacingFeature on_b = facing(b, n, margins.flat);
    if (is_known(on_b)) {
      return contact.add_point(origin + (on_b.middle + half), -contact.signed_distance);
    }
    add_points_of_features(contact, facing(a, -n, margins.flat), on_b, origin, margins);
    hold_depth(contact, a, b, on_b, origin, margins);
  } else {
    const FacingFeature on_a = facing(a, -n, margins.flat);
    if (is_known(on_a)) {
      return contact.add_point(origin + (on_a.middle - half), -contact.signed_distance);
    }
    const FacingFeature on_b = facing(b, n, margins.flat);
    add_points_of_features(contact, on_a, on_b, origin, margins);
    hold_depth(contact, a, b, on_b, origin, margins);
  }
}

template void add_facing_points(Contact&, const PosedCylinder&, const PosedCapsule&, const Vec3&,
                                double, PointRange);
template void add_facing_points(Contact&, const PosedCylinder&, const PosedCylinder&, const Vec3&,
                                double, PointRange);
template void add_facing_points(Contact&, const PosedCylinder&, const PosedBox&, const Vec3&,
                                double, PointRange);
template void add_facing_points(Contact&, const PosedCylinder&, const PosedConvex&, const Vec3&,
                                double, PointRange);

}  // namespace touchstone
