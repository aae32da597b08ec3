#include "facing_feature.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace touchstone {

using Kind = FacingFeature::Kind;

namespace {

/// Of a face or edge: it may be far longer than what it shares with the other body, over which it
/// is drawn.
double part_of_flat(double half_length, double sine, double slack) {
  constexpr double max_sine = 0.1, all_up_to = 0.5;
  return facing_part(half_length, sine, slack, max_sine, all_up_to);
}

}  // namespace

FacingFeature facing(const PosedCylinder& body, const Vec3& outward, double slack) {
  // Component by component: Eigen would load in pairs what was just stored singly, which stalls.
  const auto u = body.axis();
  const Vec3& c = body.centre;
  const double along = u.x() * outward.x() + u.y() * outward.y() + u.z() * outward.z();
  double x = outward.x() - along * u.x(), y = outward.y() - along * u.y();
  double z = outward.z() - along * u.z();
  const double end = std::copysign(body.half_length, along);
  FacingFeature feature;
  feature.sine = std::sqrt(x * x + y * y + z * z);
  const auto place_middle = [&](double axial, double radial) {
    feature.middle =
        Vec3(c.x() + (axial * u.x() + radial * x), c.y() + (axial * u.y() + radial * y),
             c.z() + (axial * u.z() + radial * z));
  };
  if (const double part = facing_part(body.radius, feature.sine, slack); part > 0) {
    feature.kind = Kind::disc;
    feature.part = part;
    feature.axis = u;
    feature.mark = body.axes.col(0);
    feature.radius = body.radius;
    place_middle(end, 0);
    return feature;
  }
  // Of so short a vector rounding is no small part, along the axis, too.
  constexpr double all_but_level = 1e-4;
  if (feature.sine < all_but_level) {
    const double rest = x * u.x() + y * u.y() + z * u.z();
    x -= rest * u.x(), y -= rest * u.y(), z -= rest * u.z();
  }
  const double arm = body.radius / feature.sine;
  if (const double part = facing_part(body.half_length, along, slack); part > 0) {
    feature.kind = Kind::segment;
    feature.part = part;
    feature.left_out[0] = -std::copysign(2 * (1 - part) * body.half_length, along);
    feature.axis = u;
    feature.half_length = body.half_length;
    feature.radius = body.radius;
    place_middle(0, arm);
    return feature;
  }
  place_middle(end, arm);
  return feature;
}

FacingFeature facing(const PosedCapsule& body, const Vec3& outward, double slack) {
  FacingFeature feature;
  feature.sine = 1;
  feature.middle = body.centre + body.radius * outward;
  const double along = body.axis().dot(outward);
  // Seen at a slant of θ, balls of its segment lie below its surface by up to θ²/2 of the radius.
  constexpr double slant = 0.01;
  const double part = facing_part(body.half_length, along, slack, slant);
  if (part > 0) {
    feature.kind = Kind::segment;
    feature.part = part;
    feature.left_out[0] = -std::copysign(2 * (1 - part) * body.half_length, along);
    feature.axis = body.axis();
    feature.half_length = body.half_length;
    feature.radius = body.radius;
    return feature;
  }
  feature.middle += std::copysign(body.half_length, along) * body.axis();
  return feature;
}

FacingFeature facing(const PosedBox& body, const Vec3& outward, double slack) {
  FacingFeature feature;
  feature.sine = 1;
  feature.middle = body.centre;
  int free = 0;
  for (int i = 0; i < 3; ++i) {
    const Vec3 axis = body.axes.col(i);
    const double along = axis.dot(outward);
    const double part = free < 2 ? part_of_flat(body.half_extents[i], along, slack) : 0;
    const double left_out = (1 - part) * body.half_extents[i];
    if (left_out > 0) feature.middle += std::copysign(left_out, along) * axis;
    if (part > 0) {
      feature.side[free] = axis;
      feature.left_out[free] = left_out > 0 ? -std::copysign(2 * left_out, along) : 0;
      feature.half_side[free++] = body.half_extents[i] - left_out;
    } else {
      feature.axis = axis;  // of a rectangle there is one that is no side
    }
  }
  if (free == 1) {
    feature.kind = Kind::segment;
    feature.axis = feature.side[0];
    feature.half_length = feature.half_side[0] + std::abs(feature.left_out[0]) / 2;
    feature.middle += feature.left_out[0] / 2 * feature.axis;
    feature.part = feature.half_side[0] / feature.half_length;
    feature.radius = 0;
  } else if (free == 2) {
    feature.kind = Kind::rectangle;
  }
  return feature;
}

void set_facet(FacingFeature& feature, const PosedConvex& body, const ConvexTables::Facet& facet,
               int corner) {
  const Vec3& v = body.body.tables().vertex(corner);
  feature.sine = 1;
  feature.kind = Kind::polygon;
  feature.axis = body.axes * facet.normal;
  feature.middle = body.centre + body.axes * v;
  feature.middle += (facet.offset - facet.normal.dot(v)) * feature.axis;
  feature.hull = &body;
  feature.facet = &facet;
}
void set_edge(FacingFeature& feature, const PosedConvex& body, const ConvexTables::Edge& edge) {
  feature.sine = 1;
  feature.kind = Kind::segment;
  feature.left_out[0] = 0;
  feature.axis = body.axes * edge.along;
  feature.half_length = edge.length / 2;
  feature.radius = 0;
  feature.middle = body.centre + body.axes * (edge.from + edge.length / 2 * edge.along);
}

/// Of the facets and edges at the farthest vertex, those that lean least. Rough facets are none
/// where only what is sharp is asked for.
FacingFeature facing(const PosedConvex& body, const Vec3& outward, double slack) {
  const ConvexTables& hull = body.body.tables();
  const Vec3 n = body.axes.transpose() * outward;
  const int top = hull.farthest_vertex(n);
  FacingFeature feature;
  feature.sine = 1;
  const ConvexTables::Facet* facet = nullptr;
  double least = std::numeric_limits<double>::infinity();
  constexpr double leans_too_far = 0.99;  // for `part_of_flat`
  constexpr double sharp = 1e-3;          // of what makes a facet rough
  const bool takes_rough = slack > sharp * ConvexTables::rough_part * hull.far;
  for (const int f : (takes_rough ? hull.vertex_flats : hull.vertex_facets).of(top)) {
    const ConvexTables::Facet& other = hull.facets[static_cast<std::size_t>(f)];
    if (!(other.normal.dot(n) > leans_too_far)) continue;
    const double sine = other.normal.cross(n).norm();
    if (sine < least) least = sine, facet = &other;
  }
  if (facet) {
    const Vec3 rises = n - n.dot(facet->normal) * facet->normal;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const int v : facet->corners) {
      const double height = rises.dot(hull.vertex(v));
      low = std::min(low, height), high = std::max(high, height);
    }
    // Half of its width where it leans, as far as there is one.
    const double half = least > 0 ? (high - low) / 2 / least : 0;
    if (const double part = part_of_flat(half, least, slack); part > 0) {
      set_facet(feature, body, *facet, top);
      feature.part = part;
      return feature;
    }
  }
  const ConvexTables::Edge* edge = nullptr;
  least = std::numeric_limits<double>::infinity();
  for (const int e : hull.vertex_edges.of(top)) {
    const ConvexTables::Edge& other = hull.edges[static_cast<std::size_t>(e)];
    const double sine = std::abs(other.along.dot(n));
    edge = sine < least ? &other : edge;  // branch-free: the winner is unpredictable
    least = std::min(least, sine);
  }
  const double along = edge->along.dot(n), half = edge->length / 2;
  if (const double part = part_of_flat(half, along, slack); part > 0) {
    set_edge(feature, body, *edge);
    feature.part = part;
    feature.left_out[0] = -std::copysign(2 * (1 - part) * half, along);
    return feature;
  }
  feature.middle = body.centre + body.axes * hull.vertex(top);
  return feature;
}

}  // namespace touchstone
