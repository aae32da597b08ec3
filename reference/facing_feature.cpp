#include "facing_feature.hpp"

#include <cmath>

namespace touchstone {
namespace {

using Kind = FacingFeature::Kind;

}  // namespace

FacingFeature facing(const PosedCylinder& body, const Vec3& outward, double slack) {
  const double along = body.axis.dot(outward);
  const Vec3 across = outward - along * body.axis;
  const double sine = across.norm();
  const Vec3 cap = body.centre + std::copysign(body.half_length, along) * body.axis;
  if (lies_flat(body.radius, sine, slack)) {
    return {.kind = Kind::disc,
            .middle = cap,
            .axis = along < 0 ? Vec3(-body.axis) : body.axis,
            .radius = body.radius};
  }
  const Vec3 arm = (body.radius / sine) * across;
  if (lies_flat(body.half_length, along, slack)) {
    return {.kind = Kind::segment,
            .middle = body.centre + arm,
            .axis = body.axis,
            .half_length = body.half_length,
            .radius = body.radius};
  }
  return {.kind = Kind::point, .middle = cap + arm, .sine = sine};
}

FacingFeature facing(const PosedCapsule& body, const Vec3& outward, double slack) {
  const double along = body.axis.dot(outward);
  const Vec3 arm = body.radius * outward;
  if (lies_flat(body.half_length, along, slack)) {
    return {.kind = Kind::segment,
            .middle = body.centre + arm,
            .axis = body.axis,
            .half_length = body.half_length,
            .radius = body.radius};
  }
  const Vec3 end = std::copysign(body.half_length, along) * body.axis;
  return {.kind = Kind::point, .middle = body.centre + end + arm};
}

FacingFeature facing(const PosedBox& body, const Vec3& outward, double slack) {
  FacingFeature feature{.kind = Kind::point, .middle = body.centre};
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
      feature.axis = along < 0 ? Vec3(-axis) : axis;
    }
  }
  if (free == 1) {
    feature.kind = Kind::segment;
    feature.axis = feature.side[0];
    feature.half_length = feature.half_side[0];
  } else if (free == 2) {
    feature.kind = Kind::rectangle;
  }
  return feature;
}

}  // namespace touchstone
