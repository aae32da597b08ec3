// Our own routines (reference/), called through their public headers: in double precision, or
// (-DTOUCHSTONE_SINGLE_PRECISION, the candidate reference-float) with poses and answers in float.
//
// Calls        touchstone::contact, one overload for each pair.
// Conventions  Those of candidate.h: normal from B to A, points halfway between the surfaces.
// Threshold    Passed on; a distance beyond it is answered with none, and then signed_distance is
//              the clearance along the first direction that proves it.
// Hint         Passed on; it decides between normals whose gaps are within the threshold.
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include "candidates/adapter.hpp"
#include "reference/touchstone.hpp"

using touchstone::Cylinder;
using touchstone::Sphere;
using touchstone::adapter::copy, touchstone::adapter::release, touchstone::adapter::supports_all;

#ifdef TOUCHSTONE_SINGLE_PRECISION
using Scalar = float;
using Pose = touchstone::FloatPose;
using Vec3 = Eigen::Vector3f;
using Contact = touchstone::FloatContact;
constexpr const char* name = "reference-float";
constexpr const char* settings =
    "Touchstone's own routines, poses and answers in single precision; points halfway between the "
    "surfaces";
#else
using Scalar = double;
using touchstone::Contact;
using touchstone::Pose;
using touchstone::Vec3;
constexpr const char* name = "reference";
constexpr const char* settings =
    "Touchstone's own routines, double precision; points halfway between the surfaces";
#endif

/// One class per pair, so that a query needs no switch over the shape's kind.
struct ts_prepared {
  virtual ~ts_prepared() = default;
  virtual void query(const ts_pose& a, const ts_pose& b, const Vec3* previous_normal,
                     ts_answer& answer) const = 0;
  double threshold = 0;
  double rounding_a = 0, rounding_b = 0;
};

namespace {

Vec3 to_vector(const double (&x)[3]) {
  return {static_cast<Scalar>(x[0]), static_cast<Scalar>(x[1]), static_cast<Scalar>(x[2])};
}

template <class Shape>
Pose to_pose(const ts_pose& p) {
  const Vec3 position = to_vector(p.position);
#ifndef TOUCHSTONE_SINGLE_PRECISION
  if constexpr (std::is_same_v<Shape, Sphere>) {  // a sphere's orientation does not matter
    return Pose(position);
  }
#endif
  const double* q = p.orientation;
  return Pose(position,
              Eigen::Quaternion<Scalar>(static_cast<Scalar>(q[0]), static_cast<Scalar>(q[1]),
                                        static_cast<Scalar>(q[2]), static_cast<Scalar>(q[3])));
}

void fill(const Contact& contact, double threshold, ts_answer& answer) {
  answer.status = contact.signed_distance <= threshold ? TS_CONTACT : TS_NONE;
  copy(contact.normal, answer.normal);
  answer.signed_distance = contact.signed_distance;
  answer.point_count = 0;
  for (const auto& point : contact.points()) {
    ts_point& out = answer.points[answer.point_count++];
    copy(point.position, out.position);
    copy(contact.normal, out.normal);
    out.depth = point.depth;
  }
}

template <class Other>
struct PreparedPair : ts_prepared {
  PreparedPair(const Cylinder& cylinder, Other shape) : a(cylinder), b(std::move(shape)) {}
  void query(const ts_pose& pose_a, const ts_pose& pose_b, const Vec3* previous_normal,
             ts_answer& answer) const override {
    fill(contact(a, to_pose<Cylinder>(pose_a), b, to_pose<Other>(pose_b),
                 static_cast<Scalar>(threshold), previous_normal),
         threshold, answer);
  }
  Cylinder a;
  Other b;
};

touchstone::Convex to_convex(const ts_shape& shape) {
  using Vertex = touchstone::Vec3;
  std::vector<Vertex> vertices;
  for (int i = 0; i < shape.vertex_count; ++i) {
    vertices.emplace_back(Eigen::Map<const Vertex>(shape.vertices + std::ptrdiff_t{3} * i));
  }
  return {std::move(vertices), touchstone::faces_of(shape), shape.rounding};
}

ts_prepared* prepare(void*, const ts_shape* a, const ts_shape* b, double threshold, double) {
  const Cylinder cylinder(a->size[0], a->size[1], a->rounding);
  const double* s = b->size;
  ts_prepared* prepared = nullptr;
  switch (b->kind) {
    case TS_PLANE:
      prepared = new PreparedPair(cylinder, touchstone::Plane({s[0], s[1], s[2]}, s[3]));
      break;
    case TS_SPHERE:
      prepared = new PreparedPair(cylinder, Sphere(s[0]));
      break;
    case TS_CAPSULE:
      prepared = new PreparedPair(cylinder, touchstone::Capsule(s[0], s[1]));
      break;
    case TS_CYLINDER:
      prepared = new PreparedPair(cylinder, Cylinder(s[0], s[1], b->rounding));
      break;
    case TS_BOX:
      prepared = new PreparedPair(cylinder, touchstone::Box({s[0], s[1], s[2]}, b->rounding));
      break;
    case TS_CONVEX:
      prepared = new PreparedPair(cylinder, to_convex(*b));
      break;
  }
  if (!prepared) return nullptr;
  prepared->threshold = threshold;
  prepared->rounding_a = a->rounding;
  prepared->rounding_b = b->rounding;
  return prepared;
}

/// They are answered as they were given.
void roundings(const ts_prepared* prepared, double* of_a, double* of_b) {
  *of_a = prepared->rounding_a;
  *of_b = prepared->rounding_b;
}

void query(ts_prepared* prepared, const ts_pose* a, const ts_pose* b, const double* previous_normal,
           ts_answer* answer) try {
  if (previous_normal) {
    const Vec3 previous = to_vector({previous_normal[0], previous_normal[1], previous_normal[2]});
    prepared->query(*a, *b, &previous, *answer);
  } else {
    prepared->query(*a, *b, nullptr, *answer);
  }
} catch (const touchstone::InvalidInput&) {
  answer->status = TS_FAILED;  // a position beyond what float holds
}

const ts_candidate candidates[] = {{name, TOUCHSTONE_VERSION, settings, nullptr, nullptr,
                                    supports_all, prepare, query, release, nullptr, nullptr}};
const ts_plugin plugin = touchstone::adapter::plugin_of(candidates, roundings);

}  // namespace

const ts_plugin* touchstone_plugin() { return &plugin; }
