#pragma once

#include <algorithm>
#include <bitset>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "verification/mutation/cases.hpp"
#include "verification/mutation/routines.hpp"

namespace touchstone::mutation {

// The geometry that answers are judged by: supports and surfaces from a configuration's numbers, in
// long double, which holds 1e-19 of every length and no double overflows in. It shares nothing with
// the routines.

using Real = long double;
using Vector = Eigen::Matrix<Real, 3, 1>;
using Matrix = Eigen::Matrix<Real, 3, 3>;

inline Vector vector(const Numbers3& v) { return {v[0], v[1], v[2]}; }

enum PairIndex { plane, sphere, capsule, cylinder, box, convex };

/// The rotation of a quaternion (w, x, y, z) of any length.
inline Matrix rotation(const Numbers4& q) {
  Real length = 0;
  for (const double x : q) length = std::hypot(length, static_cast<Real>(x));
  const Real w = q[0] / length, x = q[1] / length, y = q[2] / length, z = q[3] / length;
  Matrix m;
  m << 1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),  //
      2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),   //
      2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y);
  return m;
}

class Geometry {
 public:
  explicit Geometry(const RawConfiguration& raw)
      : pair(static_cast<int>(raw.pair)),
        position_a(vector(raw.position_a)),
        position_b(vector(raw.position_b)),
        axes_a(rotation(raw.orientation_a)),
        axes_b(rotation(raw.orientation_b)) {
    std::copy(raw.sizes.begin(), raw.sizes.end(), size);
    if (pair == plane) {
      const Vector n = vector(raw.normal);
      const Real length = std::hypot(std::hypot(n.x(), n.y()), n.z());
      plane_normal = axes_b * (n / length);
      displacement = raw.displacement / length;
    }
    if (pair == convex) add_hull(raw);
  }

  /// max over the body of (x − centre)·n.
  Real reach_of_a(const Vector& n) const { return reach_of_cylinder(axes_a, n, size[0], size[1]); }
  Real reach_of_b(const Vector& n) const {
    switch (pair) {
      case sphere:
        return size[2];
      case capsule:
        return size[2] + size[3] * std::abs(axes_b.col(2).dot(n));
      case cylinder:
        return reach_of_cylinder(axes_b, n, size[2], size[3]);
      case convex: {
        const Vector local = axes_b.transpose() * n;
        Real most = -std::numeric_limits<Real>::infinity();
        for (const Vector& v : vertices) most = std::max(most, v.dot(local));
        return most;
      }
      case box:
        break;
    }
    const Vector local = axes_b.transpose() * n;
    return size[2] * std::abs(local.x()) + size[3] * std::abs(local.y()) +
           size[4] * std::abs(local.z());
  }
  /// The clearance along n; of a plane along its own normal.
  Real gap(const Vector& n) const {
    const Vector d = position_a - position_b;
    if (pair == plane) return d.dot(plane_normal) - displacement - reach_of_a(plane_normal);
    return d.dot(n) - reach_of_a(n) - reach_of_b(n);
  }

  /// How far a point lies beyond the surface, negative inside.
  Real outside_a(const Vector& x) const {
    return outside_cylinder(axes_a.transpose() * (x - position_a), size[0], size[1]);
  }
  Real outside_b(const Vector& x) const {
    const Vector local = axes_b.transpose() * (x - position_b);
    switch (pair) {
      case plane:
        return plane_normal.dot(x - position_b) - displacement;
      case sphere:
        return local.norm() - size[2];
      case capsule: {
        const Vector on_axis(0, 0, std::clamp(local.z(), -size[3], size[3]));
        return (local - on_axis).norm() - size[2];
      }
      case cylinder:
        return outside_cylinder(local, size[2], size[3]);
      case convex: {
        Real most = -std::numeric_limits<Real>::infinity();
        for (const Plane& p : planes) most = std::max(most, p.normal.dot(local) - p.offset);
        return most;
      }
      default:
        return (local.cwiseAbs() - Vector(size[2], size[3], size[4])).maxCoeff();
    }
  }

  /// Cosine between a unit vector and the outward direction of a round side at a point on it; 1 on
  /// rims and flat sides, where a cone of normals or another law decides.
  Real facing_a(const Vector& x, const Vector& n) const {
    return facing_cylinder(axes_a.transpose() * (x - position_a), axes_a.transpose() * n, size[0],
                           size[1]);
  }
  Real facing_b(const Vector& x, const Vector& n) const {
    const Vector local = axes_b.transpose() * (x - position_b), way = axes_b.transpose() * n;
    if (pair == cylinder) return facing_cylinder(local, way, size[2], size[3]);
    if (pair != sphere && pair != capsule) return 1;
    const Real half = pair == capsule ? size[3] : 0;
    return (local - Vector(0, 0, std::clamp(local.z(), -half, half))).normalized().dot(way);
  }

  Real smaller_size() const {
    Real result = std::min(size[0], size[1]);
    if (pair == convex) return std::min(result, smallest_of_hull);
    const int last = pair == plane ? 1 : pair == box ? 4 : 2;  // a capsule's radius
    for (int i = 2; i <= last; ++i) result = std::min(result, size[i]);
    return pair == cylinder ? std::min(result, size[3]) : result;
  }
  Real larger_size() const {
    Real result = std::max(size[0], size[1]);
    if (pair == capsule) return std::max(result, size[2] + size[3]);
    if (pair == convex) return std::max(result, half_extents.maxCoeff());
    for (int i = 2; pair != plane && i < 5; ++i) result = std::max(result, size[i]);
    return result;
  }
  /// All lengths together, as bounds of the error count them.
  Real lengths() const {
    Real sum = (position_a - position_b).cwiseAbs().sum() + std::abs(displacement) + far;
    for (const Real x : size) sum += x;
    return sum;
  }

  int pair;
  Real size[5];  ///< zero where a shape has fewer
  Vector position_a, position_b;
  Matrix axes_a, axes_b;
  Vector plane_normal = Vector::Zero();
  Real displacement = 0;
  /// Of a hull: the planes of its faces, and at each edge the one halfway between these.
  struct Plane {
    Vector normal;
    Real offset;
  };
  std::vector<Vector> vertices;
  std::vector<Plane> planes;
  Vector half_extents = Vector::Zero();
  Real smallest_of_hull = 0;
  Real far = 0;  ///< the largest sum of a vertex's coordinates

 private:
  void add_hull(const RawConfiguration& raw) {
    for (const Numbers3& v : raw.vertices) vertices.push_back(vector(v));
    if (vertices.empty()) return;  // refused
    Vector low = vertices.front(), high = low;
    for (const Vector& v : vertices) {
      low = low.cwiseMin(v), high = high.cwiseMax(v);
      far = std::max(far, v.cwiseAbs().sum());
    }
    half_extents = (high - low) / 2;
    smallest_of_hull = half_extents.minCoeff();
    std::map<std::pair<int, int>, Vector> beside;  // the normal left of an edge
    for (const std::vector<int>& face : raw.faces) {
      const auto at = [&](std::size_t i) -> const Vector& {
        return vertices[static_cast<std::size_t>(face[i % face.size()])];
      };
      Vector area = Vector::Zero();
      for (std::size_t i = 2; i < face.size(); ++i) {
        area += (at(i - 1) - at(0)).cross(at(i) - at(0));
      }
      if (raw.faces.size() == 2) smallest_of_hull = std::sqrt(area.norm() / 2) / 2;
      const Vector n = area.stableNormalized();
      planes.push_back({n, n.dot(at(0))});
      for (std::size_t i = 0; i < face.size(); ++i) {
        const int from = face[i], to = face[(i + 1) % face.size()];
        beside[{from, to}] = n;
        const auto other = beside.find({to, from});
        if (other == beside.end()) continue;
        const Vector along = (at(i + 1) - at(i)).stableNormalized();
        const Vector middle =
            (n + other->second + along.cross(n - other->second)).stableNormalized();
        planes.push_back({middle, middle.dot(at(i))});
      }
    }
  }
  static Real reach_of_cylinder(const Matrix& axes, const Vector& n, Real radius, Real half) {
    const Vector axis = axes.col(2);
    return half * std::abs(axis.dot(n)) + radius * axis.cross(n).norm();
  }
  static Real facing_cylinder(const Vector& x, const Vector& n, Real radius, Real half) {
    constexpr Real rim = 1e-6L;
    const Real radial = std::hypot(x.x(), x.y());
    if (std::abs(x.z()) > half - rim * radius || radial < (1 - rim) * radius) return 1;
    return (x.x() * n.x() + x.y() * n.y()) / radial;
  }
  static Real outside_cylinder(const Vector& x, Real radius, Real half) {
    return std::max(std::hypot(x.x(), x.y()) - radius, std::abs(x.z()) - half);
  }
};

/// What an answer can be wrong in.
enum class Check {
  finite,      ///< finite numbers and unit normals
  distance,    ///< within 1e-13 of the larger size
  regret,      ///< of the normal, likewise
  certified,   ///< the true distance lies within the bound, and that is rounding
  overlaps,    ///< says what the signed distance says
  threshold,   ///< points exactly where the signed distance is within the threshold
  clearance,   ///< beyond it, a clearance along the normal that is above it and not too large
  points,      ///< one is as deep as the bodies, none deeper, none beyond the threshold
  surfaces,    ///< a point lies halfway between both surfaces
  coverage,    ///< their hull spans the contact patch
  steadiness,  ///< a motion that nobody sees moves no point
  hint,        ///< the previous normal decides between normals that tie, and nothing else
  exchange,    ///< cylinders exchanged have the mirrored answer, to the last bit
  bounds,      ///< axis-aligned boxes
  agreement,   ///< among the routines themselves, the proven one being right
  refusal,     ///< a batch of spans of different lengths is refused, and no configuration
  batch,       ///< batches have the bits of single pairs
  in_float     ///< answers in single precision are those in double, rounded
};
constexpr int check_count = 18;
const char* check_name(int check);

/// Each check is made at most this many times of one case, at different thresholds or hints.
constexpr int max_variants = 8;
using Findings = std::bitset<std::size_t{check_count} * max_variants>;

Findings judge(const Case& c, const Routines& routines);

/// What the search of rims proves of its arcs, held against rims in long double: calls
/// expect(whether it holds, which of the checks). `index` decides on the ends.
enum class ArcCheck { passage, derivatives, minima, directions };
void judge_arcs(const void* made, const Routines& routines, std::size_t index,
                const std::function<void(bool, ArcCheck)>& expect);

/// Batches and single precision, held against the answers in double one by one: calls
/// expect(whether it holds, the check, its variant).
void judge_batches(const Case& c, const void* made, const Routines& routines,
                   const std::function<void(bool, Check, int)>& expect);

RawConfiguration with_poses_exchanged(RawConfiguration raw);

/// Without a truth: do the routines agree with each other, and is the proven one sure? Finds only
/// `agreement` and `certified`.
Findings judge_agreement(const Case& c, const Routines& routines);

/// Checks that batches whose lengths differ are refused; independent of the cases. What is no shape
/// or pose the unit tests hold.
Findings judge_refusals(const Routines& routines);

}  // namespace touchstone::mutation
