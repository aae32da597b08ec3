// Simplified models of the cylinder, answered exactly up to rounding: the error of an answer is
// that of the model.
//
// Models       Every cylinder of the pair, A and B, is replaced; other shapes are kept.
//              capsule, capsule-circumscribed, spheres:N and prism:N are described in model.hpp.
// Calls        model.hpp: closest points of cores, or separating axes where they overlap.
//              Straightforward rather than fast: a prism's cost grows with the square of N against
//              another one.
// Conventions  Those of candidate.h.
// Points       Halfway between the surfaces: one, or for spheres one for each that touches.
// Threshold    Passed on. Separate prisms and boxes are answered with the largest gap, which is
//              less than their distance if vertices are closest.
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "candidates/adapter.hpp"
#include "candidates/model.hpp"

using touchstone::ModelPair;
using touchstone::Separation;
using touchstone::adapter::copy, touchstone::adapter::release, touchstone::adapter::supports_all;

struct ts_prepared {
  ModelPair pair;
  double threshold;
  std::vector<Separation> parts = {};
  /// Poses and distance of the last query, whose model_distance is asked for next.
  ts_pose pose_a = {}, pose_b = {};
  double distance = 0;
};

namespace {

using Make = std::vector<touchstone::RoundedPolytope> (*)(double, double);
using MakeMany = std::vector<touchstone::RoundedPolytope> (*)(int, double, double);

template <Make make>
ts_prepared* prepare(void*, const ts_shape* a, const ts_shape* b, double threshold, double) {
  return new ts_prepared{ModelPair(*a, *b, make), threshold};
}

template <MakeMany make>
ts_prepared* prepare_many(void*, const ts_shape* a, const ts_shape* b, double threshold,
                          double number) {
  const auto model = [number](double radius, double half_length) {
    return make(static_cast<int>(number), radius, half_length);
  };
  return new ts_prepared{ModelPair(*a, *b, model), threshold};
}

void query(ts_prepared* p, const ts_pose* a, const ts_pose* b, const double*, ts_answer* answer) {
  p->parts.clear();
  const Separation nearest = p->pair.separation(*a, *b, &p->parts);
  p->pose_a = *a;
  p->pose_b = *b;
  p->distance = nearest.distance;
  answer->status = nearest.distance <= p->threshold ? TS_CONTACT : TS_NONE;
  answer->point_count = 0;
  if (answer->status == TS_NONE) return;
  answer->signed_distance = nearest.distance;
  copy(nearest.normal, answer->normal);
  const auto deeper = [](const Separation& x, const Separation& y) {
    return x.distance < y.distance;
  };
  if (p->parts.size() > TOUCHSTONE_MAX_POINTS) {
    std::nth_element(p->parts.begin(), p->parts.begin() + TOUCHSTONE_MAX_POINTS, p->parts.end(),
                     deeper);
    p->parts.resize(TOUCHSTONE_MAX_POINTS);
  }
  for (const Separation& s : p->parts) {
    if (s.distance > p->threshold) continue;
    ts_point& point = answer->points[answer->point_count++];
    copy(touchstone::Vec3((s.on_a + s.on_b) / 2), point.position);
    copy(s.normal, point.normal);
    point.depth = -s.distance;
  }
}

bool same(const ts_pose& x, const ts_pose& y) {
  using Bits = std::array<std::uint64_t, sizeof(ts_pose) / sizeof(std::uint64_t)>;
  return std::bit_cast<Bits>(x) == std::bit_cast<Bits>(y);
}

/// A pose that is all zeros, as that of no query, is none: its orientation is no rotation.
double model_distance(ts_prepared* p, const ts_pose* a, const ts_pose* b) {
  if (same(*a, p->pose_a) && same(*b, p->pose_b)) return p->distance;
  return p->pair.separation(*a, *b).distance;
}

const ts_parameter spheres = {"number of spheres", 1, 256, 8, 1, 0};
const ts_parameter sides = {"number of sides", 3, 128, 16, 1, 0};

const ts_candidate candidates[] = {
    {"capsule", TOUCHSTONE_VERSION, "double precision; exact for its model",
     "every cylinder as the largest capsule of its length inside it", nullptr, supports_all,
     prepare<touchstone::inscribed_capsule>, query, release, model_distance, nullptr},
    {"capsule-circumscribed", TOUCHSTONE_VERSION, "double precision; exact for its model",
     "every cylinder as a capsule of its radius around it, round ends on top", nullptr,
     supports_all, prepare<touchstone::circumscribed_capsule>, query, release, model_distance,
     nullptr},
    {"spheres", TOUCHSTONE_VERSION, "double precision; exact for its model",
     "every cylinder as spheres inside it, in a row along the axis, or in a ring when it is flat",
     &spheres, supports_all, prepare_many<touchstone::inscribed_spheres>, query, release,
     model_distance, nullptr},
    {"prism", TOUCHSTONE_VERSION,
     "double precision; separating axes, closest features where a sphere or capsule is apart; "
     "exact for its model; one point",
     "every cylinder as the regular prism with its corners on the rims", &sides, supports_all,
     prepare_many<touchstone::inscribed_prism>, query, release, model_distance, nullptr}};
const ts_plugin plugin = touchstone::adapter::plugin_of(candidates);

}  // namespace

const ts_plugin* touchstone_plugin() { return &plugin; }
