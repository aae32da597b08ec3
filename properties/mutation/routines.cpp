// The routines of reference/ behind plain numbers; built once as they are and once with faults.
#include "properties/mutation/routines.hpp"

#include <string>

#include "reference/contact_of.hpp"
#include "reference/invalid_input.hpp"
#include "reference/rims.hpp"
#include "reference/support.hpp"

namespace touchstone::mutation {
namespace {

Vec3 vector(const Numbers3& v) { return {v[0], v[1], v[2]}; }
Numbers3 numbers(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
Pose pose(const Numbers3& position, const Numbers4& q) {
  return Pose(vector(position), Eigen::Quaterniond(q[0], q[1], q[2], q[3]));
}
const Configuration& of(const void* made) { return *static_cast<const Configuration*>(made); }

Shape body_b(const RawConfiguration& raw) {
  const auto& s = raw.sizes;
  switch (static_cast<int>(raw.pair)) {
    case 0:
      return Plane(vector(raw.normal), raw.displacement);
    case 1:
      return Sphere(s[2]);
    case 2:
      return Capsule(s[2], s[3]);
    case 3:
      return Cylinder(s[2], s[3]);
    default:
      return Box({s[2], s[3], s[4]});
  }
}

const void* make(const RawConfiguration& raw, const char** field) {
  try {
    const Cylinder a(raw.sizes[0], raw.sizes[1]);
    const Pose pose_a = pose(raw.position_a, raw.orientation_a);
    const Shape b = body_b(raw);
    return new Configuration{a, pose_a, b, pose(raw.position_b, raw.orientation_b)};
  } catch (const InvalidInput& error) {
    static std::string name;
    name = error.field();
    *field = name.c_str();
    return nullptr;
  }
}

void release(const void* made) { delete static_cast<const Configuration*>(made); }

RawDistance signed_distance(const void* made) {
  const SignedDistance d = touchstone::signed_distance(of(made));
  return {d.value, numbers(d.normal), 0};
}
RawDistance certified_distance(const void* made) {
  const CertifiedDistance d = touchstone::certified_distance(of(made));
  return {d.value, numbers(d.normal), d.error_bound};
}
bool overlaps(const void* made) { return touchstone::overlaps(of(made)); }

RawContact contact(const void* made, double threshold, const Numbers3* previous_normal) {
  Vec3 previous;
  if (previous_normal) previous = vector(*previous_normal);
  const Contact answer =
      touchstone::contact(of(made), threshold, previous_normal ? &previous : nullptr);
  RawContact raw{answer.signed_distance, numbers(answer.normal), 0, {}};
  for (const ContactPoint& p : answer.points()) {
    raw.points[raw.count++] = {numbers(p.position), p.depth};
  }
  return raw;
}

double gap(const void* made, const Numbers3& n) { return touchstone::gap(of(made), vector(n)); }
double support_of_a(const void* made, const Numbers3& n) {
  return support(of(made).a, of(made).pose_a, vector(n));
}

void bounds(const void* made, RawBounds& a, RawBounds& b) {
  const Aabb of_a = aabb(of(made).a, of(made).pose_a), of_b = aabb(of(made).b, of(made).pose_b);
  a = {numbers(of_a.lower), numbers(of_a.upper)};
  b = {numbers(of_b.lower), numbers(of_b.upper)};
}
bool bounds_overlap(const void* made) {
  return aabb(of(made).a, of(made).pose_a).overlaps(aabb(of(made).b, of(made).pose_b));
}

std::array<double, 9> rows(const Eigen::Matrix3d& m) {
  return {m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)};
}
RawFacts facts(const void* made) {
  const Configuration& c = of(made);
  return {smaller_size(c),          larger_size(c),  static_cast<double>(pair_of(c)),
          pair_name(pair_of(c)),    shape_name(c.b), rows(c.pose_a.rotation()),
          rows(c.pose_b.rotation())};
}

RawArc arc(const void* made, double end1, double end2, double angle, double half_width) {
  const Configuration& c = of(made);
  const Cylinder& other = std::get<Cylinder>(c.b);
  const bool in_order = c.a.radius() <= other.radius();
  const Cylinder &one = in_order ? c.a : other, &two = in_order ? other : c.a;
  const Pose &pose1 = in_order ? c.pose_a : c.pose_b, &pose2 = in_order ? c.pose_b : c.pose_a;
  const FoldedAxes axes(pose1.rotation().col(2), pose2.rotation().col(2),
                        pose1.position() - pose2.position());
  const FoldedCylinders pair{axes, one.radius(), one.half_length(), two.radius(),
                             two.half_length()};
  const Rims rims(pair, end1, end2);
  const RimSample x = rims.at(angle);
  const Passage p = rims.passage(x, half_width);
  const Vec3 q =
      axes.d() - end1 * pair.h1 * Vec3(1, 0, 0) - end2 * pair.h2 * Vec3(axes.c, axes.s, 0);
  return {axes.c,
          axes.s,
          numbers(q),
          pair.r1,
          pair.r2,
          p.min_speed,
          p.max_speed,
          p.min_radial,
          p.max_radial,
          p.turn,
          p.max_rate,
          p.max_second,
          rims.max_bend(x, half_width, p),
          rims.has_only_maxima_beside_axis(x, half_width, p),
          rims.points_inward(x, half_width, p),
          rims.may_meet(x, -1, half_width, p),
          rims.may_meet(x, 1, half_width, p)};
}

const Routines routines = {
    make, release,      signed_distance, certified_distance, overlaps, contact,
    gap,  support_of_a, bounds,          bounds_overlap,     facts,    arc};

}  // namespace
}  // namespace touchstone::mutation

const touchstone::mutation::Routines* touchstone_routines() {
  return &touchstone::mutation::routines;
}
