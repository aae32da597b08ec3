#include <algorithm>
#include <array>
#include <cmath>

#include "properties/recorded.hpp"
#include "reference/contact_of.hpp"

namespace touchstone {
namespace {

/// Largest tilt, rad, with which bodies still count as lying in an aligned arrangement.
constexpr double max_tilt = 0.1;
/// Likewise where no cap, side or face says that they are meant to be aligned: at random, axes are
/// perpendicular within this angle in 1% of all cases.
constexpr double max_chance = 0.01;
/// Largest angle, rad, that is rounding: the normal of a contact inside a cap is the cap's own.
constexpr double rounding = 1e-6;
/// Largest offset of centres, as a share of the smaller size, that counts as centred.
constexpr double centred = 0.01;

// Angles of unit vectors, accurate where they are small.

/// Between the lines along both.
double from_parallel(const Vec3& u, const Vec3& v) {
  return std::atan2(u.cross(v).norm(), std::abs(u.dot(v)));
}
double from_perpendicular(const Vec3& u, const Vec3& v) {
  return std::atan2(std::abs(u.dot(v)), u.cross(v).norm());
}

NearestArrangement tilted(std::string_view name, double tilt) {
  const double decade = tilt > 0 ? std::round(-std::log10(tilt)) : NearestArrangement::exact;
  return {name, std::min(static_cast<int>(decade), NearestArrangement::exact)};
}

NearestArrangement of_features(std::string_view name) { return {name, std::nullopt}; }

/// How a body's axis lies to the normal, and so which of its features faces the other body: a cap
/// or round end, the side, or a rim.
enum class Facing { cap, side, rim };

Facing facing(const Vec3& axis, const Vec3& normal, double max_angle) {
  if (from_parallel(axis, normal) <= max_angle) return Facing::cap;
  return from_perpendicular(axis, normal) <= max_angle ? Facing::side : Facing::rim;
}

/// A configuration as this file sees it.
struct View {
  Vec3 axis_A, normal, offset;  ///< offset of A's centre from B's
  double size;                  ///< the smaller one
  Facing near_A, exact_A;       ///< within `max_tilt`, and but for rounding

  bool is_centred(const Vec3& axis) const { return offset.cross(axis).norm() <= centred * size; }
};

NearestArrangement on_plane(const View& v) {
  if (v.near_A == Facing::cap) return tilted("standing", from_parallel(v.axis_A, v.normal));
  if (v.near_A == Facing::side) return tilted("lying", from_perpendicular(v.axis_A, v.normal));
  return of_features("general");
}

NearestArrangement on_sphere(const View& v) {
  if (v.exact_A == Facing::side) return of_features("side");
  if (v.exact_A == Facing::rim) return of_features("rim");
  return of_features(v.is_centred(v.axis_A) ? "cap-on-axis" : "cap");
}

/// "parallel" or "perpendicular" if the axes nearly are; otherwise the features.
NearestArrangement askew(double parallel, double perpendicular, std::string_view features) {
  if (parallel <= max_chance) return tilted("parallel", parallel);
  if (perpendicular <= max_chance) return tilted("perpendicular", perpendicular);
  return of_features(features);
}

std::string_view capsule_features(Facing a, bool side_B) {
  switch (a) {
    case Facing::cap:
      return "cap-end";
    case Facing::side:
      return side_B ? "side-side" : "side-end";
    case Facing::rim:
      break;
  }
  return side_B ? "rim-side" : "rim-end";
}

std::string_view cylinder_features(Facing a, Facing b) {
  if (a == Facing::cap || b == Facing::cap) return "rim-face";
  if (a == Facing::side && b == Facing::side) return "side-side";
  return a == Facing::side || b == Facing::side ? "rim-side" : "rim-rim";
}

NearestArrangement on_axis(const View& v, const Vec3& axis_B, bool is_capsule) {
  const double parallel = from_parallel(v.axis_A, axis_B);
  const double perpendicular = from_perpendicular(v.axis_A, axis_B);
  const Facing a = v.near_A, b = facing(axis_B, v.normal, max_tilt);
  if (a == Facing::cap && b == Facing::cap) {
    if (v.is_centred(v.axis_A)) {
      return tilted(is_capsule ? "cap-on-end-centred" : "cap-on-cap-centred", parallel);
    }
    return tilted(is_capsule ? "cap-on-end-offset" : "cap-on-cap-offset", parallel);
  }
  if (a == Facing::cap && b == Facing::side) return tilted("cap-on-side", perpendicular);
  if (a == Facing::side && b == Facing::cap) return tilted("perpendicular-t", perpendicular);
  if (a == Facing::side && b == Facing::side) {
    if (parallel <= max_tilt) return tilted("parallel-side", parallel);
    if (perpendicular <= max_tilt) return tilted("perpendicular-x", perpendicular);
  }
  const Facing exact_B = facing(axis_B, v.normal, rounding);
  return askew(parallel, perpendicular,
               is_capsule ? capsule_features(v.exact_A, exact_B == Facing::side)
                          : cylinder_features(v.exact_A, exact_B));
}

/// `components`: how many of the normal's in the box's frame are not zero: one on a face, two on an
/// edge, three on a vertex.
std::string_view box_features(Facing a, Eigen::Index components) {
  constexpr std::array<std::array<const char*, 3>, 3> names = {
      {{"cap-on-face-offset", "side-on-face", "rim-face"},
       {"edge-cap", "edge-side", "edge-rim"},
       {"vertex-cap", "vertex-side", "vertex-rim"}}};
  return names[static_cast<std::size_t>(components - 1)][static_cast<std::size_t>(a)];
}

NearestArrangement on_box(const View& v, const Eigen::Matrix3d& axes_B) {
  const Vec3 local = (axes_B.transpose() * v.normal).cwiseAbs();
  Eigen::Index along, across;
  local.maxCoeff(&along);
  local.minCoeff(&across);
  const Vec3 face = axes_B.col(along), edge = axes_B.col(across);
  if (from_parallel(face, v.normal) <= max_tilt) {
    if (v.near_A == Facing::cap) {
      return tilted(v.is_centred(face) ? "cap-on-face-centred" : "cap-on-face-offset",
                    from_parallel(v.axis_A, face));
    }
    if (v.near_A == Facing::side) {
      return tilted("side-on-face", from_perpendicular(v.axis_A, face));
    }
  } else if (from_perpendicular(edge, v.normal) <= max_tilt) {
    const double parallel = from_parallel(v.axis_A, edge);
    const double perpendicular = from_perpendicular(v.axis_A, edge);
    if (v.near_A == Facing::cap) return tilted("edge-cap", perpendicular);
    if (v.near_A == Facing::side && parallel <= max_tilt) return tilted("parallel", parallel);
    if (v.near_A == Facing::side && perpendicular <= max_tilt) {
      return tilted("perpendicular-x", perpendicular);
    }
  }
  const Eigen::Index components = (local.array() > rounding).count();
  const std::string_view features = box_features(v.exact_A, components);
  if (components != 2) return of_features(features);
  return askew(from_parallel(v.axis_A, edge), from_perpendicular(v.axis_A, edge), features);
}

}  // namespace

NearestArrangement nearest_arrangement(const Configuration& c) {
  const Vec3 axis_A = c.pose_a.axis(), normal = signed_distance(c).normal;
  const View view{axis_A,
                  normal,
                  c.pose_a.position() - c.pose_b.position(),
                  smaller_size(c),
                  facing(axis_A, normal, max_tilt),
                  facing(axis_A, normal, rounding)};
  switch (pair_of(c)) {
    case Pair::plane:
      return on_plane(view);
    case Pair::sphere:
      return on_sphere(view);
    case Pair::capsule:
      return on_axis(view, c.pose_b.axis(), true);
    case Pair::cylinder:
      return on_axis(view, c.pose_b.axis(), false);
    case Pair::box:
      break;
  }
  return on_box(view, c.pose_b.rotation());
}

}  // namespace touchstone
