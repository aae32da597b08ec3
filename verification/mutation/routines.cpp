// The routines of reference/ behind plain numbers; built once as they are and once with faults.
#include "verification/mutation/routines.hpp"

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "reference/batch.hpp"
#include "reference/contact_of.hpp"
#include "reference/invalid_input.hpp"
#include "reference/rims.hpp"
#include "reference/single_precision.hpp"
#include "reference/support.hpp"

namespace touchstone::mutation {
namespace {

Vec3 vector(const Numbers3& v) { return {v[0], v[1], v[2]}; }
template <class Vector>
Numbers3 numbers(const Vector& v) {
  return {v.x(), v.y(), v.z()};
}
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
    case 5: {
      std::vector<Vec3> vertices;
      for (const Numbers3& v : raw.vertices) vertices.push_back(vector(v));
      return Convex(std::move(vertices), raw.faces);
    }
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

template <class Answer>
RawContact raw_contact(const Answer& answer) {
  RawContact raw{answer.signed_distance, numbers(answer.normal), 0, {}};
  for (const auto& p : answer.points()) raw.points[raw.count++] = {numbers(p.position), p.depth};
  return raw;
}
RawContact contact(const void* made, double threshold, const Numbers3* previous_normal) {
  Vec3 previous;
  if (previous_normal) previous = vector(*previous_normal);
  return raw_contact(
      touchstone::contact(of(made), threshold, previous_normal ? &previous : nullptr));
}

void bounds(const void* made, RawBounds& a, RawBounds& b) {
  const Aabb of_a = aabb(of(made).a, of(made).pose_a), of_b = aabb(of(made).b, of(made).pose_b);
  a = {numbers(of_a.lower), numbers(of_a.upper)};
  b = {numbers(of_b.lower), numbers(of_b.upper)};
}
bool bounds_overlap(const void* made) {
  return aabb(of(made).a, of(made).pose_a).overlaps(aabb(of(made).b, of(made).pose_b));
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

/// The types of one precision.
template <class PoseType, class DistanceType, class ContactType, class NumberType>
struct Precision {
  using Number = NumberType;
  using Pose = PoseType;
  using Distance = DistanceType;
  using Contact = ContactType;
  using Vector = Eigen::Matrix<Number, 3, 1>;

  static Pose pose(const touchstone::Pose& p) {
    return Pose(p.position().cast<Number>(), p.orientation().cast<Number>());
  }
};
using Double = Precision<Pose, SignedDistance, Contact, double>;
using Float = Precision<FloatPose, FloatSignedDistance, FloatContact, float>;

template <class In>
void ask_batch(const Configuration& c, std::size_t count, double threshold, RawAnswers* results) {
  const auto pose_a = In::pose(c.pose_a), pose_b = In::pose(c.pose_b);
  std::vector<typename In::Pose> a, b;
  for (std::size_t i = 0; i < count; ++i) {
    a.push_back(i % 2 == 0 ? pose_a : pose_b), b.push_back(i % 2 == 0 ? pose_b : pose_a);
  }
  std::vector<typename In::Distance> distances(count);
  std::vector<typename In::Contact> contacts(count);
  const auto overlap = std::make_unique<bool[]>(count);
  std::visit(
      [&](const auto& shape) {
        touchstone::signed_distance(c.a, a, shape, b, distances);
        touchstone::overlaps(c.a, a, shape, b, std::span(overlap.get(), count));
        touchstone::contact(c.a, a, shape, b, static_cast<typename In::Number>(threshold),
                            contacts);
      },
      c.b);
  for (std::size_t i = 0; i < count; ++i) {
    results[i] = {{distances[i].value, numbers(distances[i].normal), 0},
                  overlap[i],
                  raw_contact(contacts[i])};
  }
}

void ask_in_float(const Configuration& c, std::size_t count, double threshold,
                  const Numbers3* previous_normal, RawAnswers* results) {
  const auto pose_a = Float::pose(c.pose_a), pose_b = Float::pose(c.pose_b);
  Float::Vector previous;
  if (previous_normal) previous = vector(*previous_normal).cast<float>();
  for (std::size_t i = 0; i < count; ++i) {
    const auto &a = i % 2 == 0 ? pose_a : pose_b, &b = i % 2 == 0 ? pose_b : pose_a;
    std::visit(
        [&](const auto& shape) {
          const auto distance = touchstone::signed_distance(c.a, a, shape, b);
          results[i] = {
              {distance.value, numbers(distance.normal), 0},
              touchstone::overlaps(c.a, a, shape, b),
              raw_contact(touchstone::contact(c.a, a, shape, b, static_cast<float>(threshold),
                                              previous_normal ? &previous : nullptr))};
        },
        c.b);
  }
}

void batch(const void* made, Batch how, std::size_t count, double threshold,
           const Numbers3* previous_normal, RawAnswers* results) {
  const Configuration& c = of(made);
  if (how == Batch::in_double) return ask_batch<Double>(c, count, threshold, results);
  if (how == Batch::in_float) return ask_batch<Float>(c, count, threshold, results);
  ask_in_float(c, count, threshold, previous_normal, results);
}

template <class In>
void ask_lengths(const Configuration& c, int question, std::size_t count_b, std::size_t count) {
  const std::vector<typename In::Pose> a(3), b(count_b);
  std::vector<typename In::Distance> distances(count);
  std::vector<typename In::Contact> contacts(count);
  const auto overlap = std::make_unique<bool[]>(count);
  std::visit(
      [&](const auto& shape) {
        if (question == 0) touchstone::signed_distance(c.a, a, shape, b, distances);
        if (question == 1) touchstone::overlaps(c.a, a, shape, b, std::span(overlap.get(), count));
        if (question == 2) touchstone::contact(c.a, a, shape, b, 0, contacts);
      },
      c.b);
}
const char* refused_batch(const void* made, Batch how, int question, std::size_t poses_b,
                          std::size_t results) {
  static std::string name;
  name.clear();
  try {
    if (how == Batch::in_double) ask_lengths<Double>(of(made), question, poses_b, results);
    if (how == Batch::in_float) ask_lengths<Float>(of(made), question, poses_b, results);
  } catch (const InvalidInput& error) {
    name = error.field();
  }
  return name.c_str();
}

const Routines routines = {make,     release, signed_distance, certified_distance,
                           overlaps, contact, bounds,          bounds_overlap,
                           arc,      batch,   refused_batch};

}  // namespace
}  // namespace touchstone::mutation

const touchstone::mutation::Routines* touchstone_routines() {
  return &touchstone::mutation::routines;
}
