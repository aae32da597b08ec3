#include "facing_feature.hpp"

#include <algorithm>
#include <cmath>

namespace touchstone {

using Kind = FacingFeature::Kind;

FacingFeature facing(const PosedCylinder& body, const Vec3& outward, double slack) {
  // Component by component: Eigen would load in pairs what was just stored singly, which stalls.
  const auto u = body.axis();
  const Vec3& c = body.centre;
  const double along = u.x() * outward.x() + u.y() * outward.y() + u.z() * outward.z();
  const double x = outward.x() - along * u.x(), y = outward.y() - along * u.y();
  const double z = outward.z() - along * u.z();
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
    // A face may be far longer than what it shares with the other body, over which it is drawn.
    constexpr double max_sine = 0.1, all_up_to = 0.5;
    const double part =
        free < 2 ? facing_part(body.half_extents[i], along, slack, max_sine, all_up_to) : 0;
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

}  // namespace touchstone
