#include "facing_feature.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace touchstone {

using Kind = FacingFeature::Kind;

FacingFeature facing(const PosedCylinder& body, const Vec3& outward, double slack) {
  FacingFeature feature;
  const double along = body.axis().dot(outward);
  const Vec3 across = outward - along * body.axis();
  feature.sine = across.norm();
  if (lies_flat(body.radius, feature.sine, slack)) {
    feature.kind = Kind::disc;
    feature.axis = std::copysign(1, along) * body.axis();
    feature.middle = body.centre + body.half_length * feature.axis;
    feature.mark = body.axes.col(0);
    feature.radius = body.radius;
    return feature;
  }
  const Vec3 arm = (body.radius / feature.sine) * across;
  if (lies_flat(body.half_length, along, slack)) {
    feature.kind = Kind::segment;
    feature.middle = body.centre + arm;
    feature.axis = body.axis();
    feature.half_length = body.half_length;
    feature.radius = body.radius;
    return feature;
  }
  feature.kind = Kind::point;
  feature.middle = body.centre + (std::copysign(body.half_length, along) * body.axis() + arm);
  return feature;
}

FacingFeature facing(const PosedCapsule& body, const Vec3& outward, double slack) {
  FacingFeature feature;
  feature.sine = 1;
  feature.middle = body.centre + body.radius * outward;
  const double along = body.axis().dot(outward);
  // Seen at a slant of θ, balls of its segment lie below its surface by up to θ²/2 of the radius.
  constexpr double slant = 0.01;
  if (lies_flat(body.half_length, along, slack, slant)) {
    feature.kind = Kind::segment;
    feature.axis = body.axis();
    feature.half_length = body.half_length;
    feature.radius = body.radius;
    return feature;
  }
  feature.kind = Kind::point;
  feature.middle += std::copysign(body.half_length, along) * body.axis();
  return feature;
}

FacingFeature facing(const PosedBox& body, const Vec3& outward, double slack) {
  FacingFeature feature;
  feature.kind = Kind::point;
  feature.sine = 1;
  feature.middle = body.centre;
  int free = 0;
  double steepest = 0;
  for (int i = 0; i < 3; ++i) {
    const Vec3 axis = body.axes.col(i);
    const double along = axis.dot(outward);
    if (free < 2 && lies_flat(body.half_extents[i], along, slack)) {
      feature.side[free] = axis;
      feature.half_side[free++] = body.half_extents[i];
      continue;
    }
    feature.middle += std::copysign(body.half_extents[i], along) * axis;
    if (std::abs(along) > std::abs(steepest)) {
      steepest = along;
      feature.axis = std::copysign(1, along) * axis;
    }
  }
  if (free == 1) {
    feature.kind = Kind::segment;
    feature.axis = feature.side[0];
    feature.half_length = feature.half_side[0];
    feature.radius = 0;
  } else if (free == 2) {
    feature.kind = Kind::rectangle;
  }
  return feature;
}

SupportPoint support_point(const PosedCylinder& body, const Vec3& outward) {
  const double along = body.axis().dot(outward);
  const Vec3 across = outward - along * body.axis();
  const double sine = across.norm();
  Vec3 arm = std::copysign(body.half_length, along) * body.axis();
  if (sine > 0) arm += (body.radius / sine) * across;
  return {body.centre + arm, std::min(body.half_length * std::abs(along), body.radius * sine)};
}

SupportPoint support_point(const PosedCapsule& body, const Vec3& outward) {
  const double along = body.axis().dot(outward);
  return {
      body.centre + body.radius * outward + std::copysign(body.half_length, along) * body.axis(),
      body.half_length * std::abs(along)};
}

SupportPoint support_point(const PosedBox& body, const Vec3& outward) {
  SupportPoint point{body.centre, std::numeric_limits<double>::infinity()};
  for (int i = 0; i < 3; ++i) {
    const Vec3 axis = body.axes.col(i);
    const double along = axis.dot(outward);
    point.position += std::copysign(body.half_extents[i], along) * axis;
    point.sharpness = std::min(point.sharpness, body.half_extents[i] * std::abs(along));
  }
  return point;
}

}  // namespace touchstone
