#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>

#include "properties/features.hpp"
#include "properties/moves.hpp"
#include "properties/pose_class.hpp"

namespace touchstone {
namespace {

using enum Feature;
using Quaternion = Eigen::Quaterniond;

constexpr std::array<double, 16> power_of_ten = {1,     1e-1,  1e-2,  1e-3, 1e-4,  1e-5,
                                                 1e-6,  1e-7,  1e-8,  1e-9, 1e-10, 1e-11,
                                                 1e-12, 1e-13, 1e-14, 1e-15};

const Quaternion upright(1, 0, 0, 0);
const Quaternion along_x(0.5, 0.5, 0.5, 0.5);  // z to x, x to y, y to z

/// Tilts A by `tilt` radians (to second order) about a random axis perpendicular to its own z. If
/// B's z lies along A's x, only the y component of that axis tilts the two towards each other: it
/// is at least 0.5.
Quaternion draw_tilt(Draw& draw, const Quaternion& base, double tilt) {
  for (;;) {
    const Vec3 axis = draw.direction_across(Vec3(0, 0, 1));
    if (base.x() != 0 && std::abs(axis.y()) < 0.5) continue;
    return Quaternion(1, tilt / 2 * axis.x(), tilt / 2 * axis.y(), 0);
  }
}

/// Cap or side of A against B, whose orientation relative to A is `base` and a tilt; placed as if
/// the tilt were zero.
Configuration nearly(Draw& draw, Pair pair, const Quaternion& base, double tilt) {
  Bodies bodies = draw_bodies(draw, pair);
  if (pair == Pair::plane) bodies.b = Plane(Vec3(0, 0, 1), draw.uniform(-1, 1));
  bodies.orientation_b = product(product(bodies.orientation_a, base), draw.turn_about_z());
  const double distance = draw_near(draw, smaller_size(bodies));
  const bool cap_first = draw.coin();
  const Feature on_a = pair == Pair::plane ? rim : cap_first ? cap : side;
  const Feature on_b = pair == Pair::plane      ? cap
                       : pair == Pair::capsule  ? (draw.coin() ? side : end)
                       : pair == Pair::cylinder ? (draw.coin() ? side : rim)
                                                : (draw.coin() ? edge : vertex);
  const Configuration straight = meet(draw, bodies, on_a, on_b, distance);
  const Quaternion tilted = product(bodies.orientation_a, draw_tilt(draw, base, tilt));
  return {straight.a, Pose(straight.pose_a.position(), tilted), straight.b, straight.pose_b};
}

/// Bodies with A a needle or a coin: its long half extent is 1000 times the short one.
Bodies draw_extreme(Draw& draw, Pair pair, bool needle) {
  Bodies bodies = draw_bodies(draw, pair);
  constexpr double ratio = 1000;
  const double size = bodies.a.radius();
  bodies.a = needle ? Cylinder(size / ratio, size) : Cylinder(size, size / ratio);
  return bodies;
}

Configuration extreme_aspect(Draw& draw, Pair pair, bool needle) {
  const Bodies bodies = draw_extreme(draw, pair, needle);
  const FeaturePair features = draw_feature_pair(draw, pair);
  const double distance = draw_near(draw, smaller_size(bodies));
  return meet(draw, bodies, features.on_a, features.on_b, distance);
}

/// Places A's centre in the largest ball within B.
Configuration extreme_aspect_deep(Draw& draw, Pair pair, bool needle) {
  const Bodies bodies = draw_extreme(draw, pair, needle);
  return overlap_deeply(draw, bodies, smallest_half_extent(bodies.b));
}

Configuration general_near(Draw& draw, Pair pair) {
  const Bodies bodies = draw_bodies(draw, pair);
  const FeaturePair features = draw_feature_pair(draw, pair);
  const double distance = draw_near(draw, smaller_size(bodies));
  return meet(draw, bodies, features.on_a, features.on_b, distance);
}

/// One class for each tilt of 10^-k rad, k = 1..15, away from the exact pose `base`.
void add_tilts(Pair pair, const std::string& name, const Quaternion& base, const std::string& what,
               std::vector<PoseClass>& out) {
  for (std::size_t k = 1; k <= 15; ++k) {
    const std::string tilt = "1e-" + std::to_string(k);
    out.push_back(
        {fmt::format("{}-{}", name, tilt), fmt::format("{} {} rad.", what, tilt),
         [pair, base, k](Draw& draw) { return nearly(draw, pair, base, power_of_ten[k]); }});
  }
}

void add_all_tilts(Pair pair, std::vector<PoseClass>& out) {
  if (pair == Pair::plane) {
    // The plane's normal is B's z axis, so a lying cylinder is parallel to the plane's surface.
    add_tilts(pair, "near-parallel", along_x, "The axis is tilted from lying by half to all of",
              out);
    add_tilts(pair, "near-perpendicular", upright, "The axis is tilted from standing by", out);
    return;
  }
  add_tilts(pair, "near-parallel", upright,
            "Cross products lose their digits: the axes (or the axis and a box edge) miss being "
            "parallel by",
            out);
  add_tilts(pair, "near-perpendicular", along_x,
            "Discs are seen edge on: the axes (or the axis and a box edge) miss being "
            "perpendicular by half to all of",
            out);
}

}  // namespace

std::vector<PoseClass> limit_classes(Pair pair) {
  std::vector<PoseClass> out;
  if (pair != Pair::sphere) add_all_tilts(pair, out);
  out.push_back({"aspect-needle", "A is a needle, 1000 times longer than wide.",
                 [pair](Draw& draw) { return extreme_aspect(draw, pair, true); }});
  out.push_back({"aspect-coin", "A is a coin, 1000 times wider than thick.",
                 [pair](Draw& draw) { return extreme_aspect(draw, pair, false); }});
  out.push_back({"aspect-needle-deep",
                 "A needle, 1000 times longer than wide, sticks deep in B: the way out is sideways "
                 "and much shorter than the overlap is long.",
                 [pair](Draw& draw) { return extreme_aspect_deep(draw, pair, true); }});
  out.push_back({"aspect-coin-deep",
                 "A coin, 1000 times wider than thick, is deep in B: its caps and its rim ask for "
                 "opposite ways out.",
                 [pair](Draw& draw) { return extreme_aspect_deep(draw, pair, false); }});
  out.push_back({"scale-tiny", "All lengths are times 1e-6: absolute tolerances show.",
                 [pair](Draw& draw) { return scaled(general_near(draw, pair), 1e-6); }});
  out.push_back({"scale-huge", "All lengths are times 1e6: absolute tolerances show.",
                 [pair](Draw& draw) { return scaled(general_near(draw, pair), 1e6); }});
  out.push_back(
      {"far-from-origin",
       "Both bodies are a million metres away: positions must be subtracted before anything "
       "else.",
       [pair](Draw& draw) {
         const Configuration near = general_near(draw, pair);
         return translated(near, 1e6 * draw.direction());
       }});
  return out;
}

}  // namespace touchstone
