#include "oracle/patch/support_feature.hpp"

#include <algorithm>
#include <cmath>

#include "oracle/vector3.hpp"

namespace touchstone::oracle {

RationalVector exact(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Vec3 rounded(const RationalVector& v) { return {v.x.get_d(), v.y.get_d(), v.z.get_d()}; }

ExactPose::ExactPose(const Pose& pose) : position(exact(pose.position())) {
  const Eigen::Quaterniond& q = pose.orientation();
  const ExactRotation<mpq_class> rotation(q.w(), q.x(), q.y(), q.z());
  axes = rotation.columns;
  norm = rotation.norm;
}

namespace {

using Kind = SupportFeature::Kind;

/// Below this sine or cosine between axis and normal, the normal's rounding of 1e-16 moves a rim
/// point by more than 1e-4 of its radius.
constexpr double nearly_aligned = 1e-12;

/// The direction out of a body, towards the other one.
struct Outward {
  RationalVector direction;  ///< of any length
  bool is_exact;
  Vec3 unit;
};

struct PosedShape {
  const Pose& pose;
  const ExactPose exact;
  const Outward& out;
  const std::array<Alignment, 3>& alignment;  ///< to the body's axes

  Vec3 unit_axis(int i) const { return rounded(exact.axes[i]) / exact.norm.get_d(); }
  /// +1 or −1: the end of an axis, not perpendicular to the normal, that is farther out.
  int end(int i) const { return sgn(dot(exact.axes[i], out.direction)) < 0 ? -1 : 1; }
  bool is_certain(int i) const {
    const Vec3 axis = unit_axis(i);
    return out.is_exact || (std::abs(axis.dot(out.unit)) > nearly_aligned &&
                            axis.cross(out.unit).norm() > nearly_aligned);
  }
  SupportFeature centred(Kind kind) const {
    SupportFeature f;
    f.kind = kind;
    f.centre = exact.position;
    f.norm = exact.norm;
    f.u = exact.axes[2];
    return f;
  }
};

SupportFeature feature(const Cylinder& shape, const PosedShape& body) {
  switch (body.alignment[2]) {
    case Alignment::parallel: {
      SupportFeature f = body.centred(Kind::disc);
      f.radius = shape.radius();
      return f;
    }
    case Alignment::perpendicular: {
      SupportFeature f = body.centred(Kind::segment);
      f.half_u = shape.half_length();
      return f;
    }
    case Alignment::oblique:
      break;
  }
  SupportFeature f;
  // The component perpendicular to the axis is exact, so that a small tilt loses no digits.
  const RationalVector &n = body.out.direction, &axis = body.exact.axes[2];
  const mpq_class along = dot(axis, n) / (body.exact.norm * body.exact.norm);
  const Vec3 radial = rounded(n - along * axis);
  f.point = body.pose.position() + body.end(2) * shape.half_length() * body.unit_axis(2);
  if (!radial.isZero(0)) f.point += shape.radius() * radial.normalized();
  f.point_is_certain = body.is_certain(2);
  return f;
}

SupportFeature feature(const Capsule& shape, const PosedShape& body) {
  if (body.alignment[2] == Alignment::perpendicular) {
    SupportFeature f = body.centred(Kind::segment);
    f.half_u = shape.half_length();
    return f;
  }
  SupportFeature f;
  f.point = body.pose.position() + body.end(2) * shape.half_length() * body.unit_axis(2) +
            shape.radius() * body.out.unit;
  f.point_is_certain = body.is_certain(2);
  return f;
}

SupportFeature feature(const Sphere& shape, const PosedShape& body) {
  SupportFeature f;
  f.point = body.pose.position() + shape.radius() * body.out.unit;
  return f;
}

SupportFeature feature(const Box& shape, const PosedShape& body) {
  SupportFeature f = body.centred(Kind::point);
  f.point = body.pose.position();
  std::vector<int> across;
  for (int i = 0; i < 3; ++i) {
    if (body.alignment[i] == Alignment::perpendicular) {
      across.push_back(i);
      continue;
    }
    const double half = body.end(i) * shape.half_extents()[i];
    f.point += half * body.unit_axis(i);
    f.centre = f.centre + mpq_class(half) / f.norm * body.exact.axes[i];
    f.point_is_certain = f.point_is_certain && body.is_certain(i);
  }
  if (across.empty()) return f;
  f.kind = across.size() == 1 ? Kind::segment : Kind::rectangle;
  f.u = body.exact.axes[across[0]];
  f.half_u = shape.half_extents()[across[0]];
  if (across.size() == 1) return f;
  f.v = body.exact.axes[across[1]];
  f.half_v = shape.half_extents()[across[1]];
  return f;
}

SupportFeature feature(const Plane&, const PosedShape& body) { return body.centred(Kind::plane); }

/// The normal as an exact vector of any length if it is parallel to an axis or a plane's normal;
/// otherwise its doubles.
Outward from_b_to_a(const Configuration& c, const OptimalNormal& normal, const ExactPose& a,
                    const ExactPose& b) {
  const auto towards_a = [&](const RationalVector& axis) {
    const bool same_way = rounded(axis).dot(normal.n) > 0;
    return Outward{same_way ? axis : -axis, true, normal.n};
  };
  if (const auto* plane = std::get_if<Plane>(&c.b)) {
    const RationalVector local = exact(plane->normal());
    return towards_a(local.x * b.axes[0] + local.y * b.axes[1] + local.z * b.axes[2]);
  }
  if (normal.to_a == Alignment::parallel) return towards_a(a.axes[2]);
  for (int i = 0; i < 3; ++i) {
    if (normal.to_b[i] == Alignment::parallel) return towards_a(b.axes[i]);
  }
  return {exact(normal.n), false, normal.n};
}

}  // namespace

SupportFeatures support_features(const Configuration& c, const OptimalNormal& normal) {
  const ExactPose a(c.pose_a), b(c.pose_b);
  const Outward out_of_b = from_b_to_a(c, normal, a, b);
  const Outward out_of_a{-out_of_b.direction, out_of_b.is_exact, -out_of_b.unit};
  const std::array<Alignment, 3> to_a{Alignment::oblique, Alignment::oblique, normal.to_a};
  const PosedShape body_a{c.pose_a, a, out_of_a, to_a};
  const PosedShape body_b{c.pose_b, b, out_of_b, normal.to_b};
  return {feature(c.a, body_a),
          std::visit([&](const auto& shape) { return feature(shape, body_b); }, c.b)};
}

}  // namespace touchstone::oracle
