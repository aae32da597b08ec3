#include "batch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "closed_forms.hpp"
#include "invalid_input.hpp"
#include "pair.hpp"
#include "rims.hpp"

// The poses of some pairs are copied component by component into a `Block`, and one loop, `look`,
// asks of all of them whether they are apart by more than was asked for, along the first normals
// that the function for one pair tries, and by its arithmetic. What `look` leaves undecided, that
// function answers.
//
// `look` is a plain loop without branches, of which the compiler makes vectors (CMakeLists.txt has
// the options of this file): of two doubles by the instructions that every x86-64 has, and in a
// second copy, which the loader chooses where the processor has them, of four by AVX2. No library
// for vectors is needed for that, and all steps round as they do for one pair: contraction is off.
//
// The distances of planes and spheres are formulas, found at once (closed_forms.hpp).
//
// Rounded bodies are not looked at. Nor is a hull: its first normals are all of its faces', as the
// function for one pair asks them, four at once. Nor is a capsule: along its own first normals that
// saved 6 ns of 45 in `contact` and 1 of 33 in `overlaps`, and there 6 along a normal between near
// points.

#if defined(__x86_64__) && defined(__GLIBC__) && defined(__has_attribute)
// Not under ThreadSanitizer: it instruments what chooses the copy, which may run before the
// sanitizer does.
#if __has_attribute(target_clones) && !defined(__SANITIZE_THREAD__)
#define TOUCHSTONE_CLONES [[gnu::target_clones("avx2", "default")]]
#endif
#endif
#ifndef TOUCHSTONE_CLONES
#define TOUCHSTONE_CLONES
#endif

namespace touchstone {
namespace {

constexpr std::size_t width = 16;  ///< of a block, in pairs; 8 to 128 take about the same time
constexpr double undecided = std::numeric_limits<double>::quiet_NaN();

struct Vectors {
  double x[width] = {}, y[width] = {}, z[width] = {};

  void set(std::size_t i, const Vec3& v) { x[i] = v.x(), y[i] = v.y(), z[i] = v.z(); }
  Vec3 operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
};

/// What `look` finds: gaps above `stop_above` with their normals, as the function for one pair
/// finds them, or `undecided`.
struct Findings {
  double gap[width];
  Vectors normal;

  Vec3 world_normal(std::size_t i, const Pose&) const { return normal[i]; }
};

/// Poses of `width` pairs with the sizes of the shapes, and what is found of them.
template <class Other>
struct Block;

// Cylinder

template <>
struct Block<Cylinder> : Findings {
  /// In the order of `posed_pair`.
  Block(const Cylinder& a, const Cylinder& b)
      : r1(a.radius()), h1(a.half_length()), r2(b.radius()), h2(b.half_length()) {
    if (r1 != r2 ? r1 > r2 : h1 > h2) std::swap(r1, r2), std::swap(h1, h2);
  }
  void load(std::size_t i, const PosedPair<Cylinder>& pair) {
    d.set(i, pair.a.centre - pair.b.centre);
    axis1.set(i, pair.a.axis());
    axis2.set(i, pair.b.axis());
    side[i] = pair.exchanged ? -1 : 1;
  }

  double r1, h1, r2, h2;
  Vectors d, axis1, axis2;
  double side[width] = {};
};

TOUCHSTONE_CLONES void look(Block<Cylinder>& block, double stop_above) {
  const double r1 = block.r1, h1 = block.h1, r2 = block.r2, h2 = block.h2;
  for (std::size_t i = 0; i < width; ++i) {
    const Vec3 d = block.d[i];
    const FoldedAxes f = FoldedAxes::of_crossing_axes(block.axis1[i], block.axis2[i], d);
    const CapsAndSides best(f, r1, h1, r2, h2);
    const StageResult found = best.without_proof();
    // `to_world`, component by component.
    const auto in_world = [&](double e1, double e2, double e3) {
      return block.side[i] * (found.x * e1 + found.y * e2 + found.z * e3);
    };
    block.normal.x[i] = in_world(f.e1.x(), f.e2.x(), f.e3.x());
    block.normal.y[i] = in_world(f.e1.y(), f.e2.y(), f.e3.y());
    block.normal.z[i] = in_world(f.e1.z(), f.e2.z(), f.e3.z());
    const bool crosses = f.crosses(), in_range = is_in_range(d);
    block.gap[i] = (crosses & (found.gap > stop_above) & in_range) ? found.gap : undecided;
  }
}

// Box

template <>
struct Block<Box> : Findings {
  Block(const Cylinder& a, const Box& b) : r(a.radius()), h(a.half_length()), e(b.half_extents()) {}
  void load(std::size_t i, const PosedPair<Box>& pair) {
    const Vec3 arm = pair.a.centre - pair.b.centre;
    far.set(i, arm);
    d.set(i, pair.b.axes.transpose() * arm);
    u.set(i, pair.b.axes.transpose() * pair.a.axis());
  }
  Vec3 world_normal(std::size_t i, const Pose& pose_b) const {
    return pose_b.rotation() * normal[i];
  }

  double r, h;
  Vec3 e;
  Vectors far, d, u;  ///< centre to centre in the world; in the box's frame; the axis there
};

/// `BoxSides` (box_sides.hpp), of which the first of equal ones counts.
TOUCHSTONE_CLONES void look(Block<Box>& block, double stop_above) {
  const double r = block.r, h = block.h, ex = block.e.x(), ey = block.e.y(), ez = block.e.z();
  constexpr double none = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < width; ++i) {
    const double dx = without_vanishing(block.d.x[i]), ux = without_vanishing(block.u.x[i]);
    const double dy = without_vanishing(block.d.y[i]), uy = without_vanishing(block.u.y[i]);
    const double dz = without_vanishing(block.d.z[i]), uz = without_vanishing(block.u.z[i]);
    const double lx = std::abs(ux), ly = std::abs(uy), lz = std::abs(uz);
    const double sx = std::sqrt(uy * uy + uz * uz), sy = std::sqrt(uz * uz + ux * ux);
    const double sz = std::sqrt(ux * ux + uy * uy);

    const double face_x = std::abs(dx) - ex - h * lx - r * sx;
    const double face_y = std::abs(dy) - ey - h * ly - r * sy;
    const double face_z = std::abs(dz) - ez - h * lz - r * sz;
    const double face = std::max(std::max(face_x, face_y), face_z);
    const double is_x = face_x == face ? 1 : 0, is_y = face_y == face ? 1 - is_x : 0;
    const double is_z = 1 - is_x - is_y;
    const double face_side = std::copysign(1, is_x * dx + is_y * dy + is_z * dz);

    const double along_x = dz * uy - dy * uz, along_y = dx * uz - dz * ux;
    const double along_z = dy * ux - dx * uy;
    const double edge_x = sx > 0 ? (std::abs(along_x) - ey * lz - ez * ly) / sx - r : none;
    const double edge_y = sy > 0 ? (std::abs(along_y) - ez * lx - ex * lz) / sy - r : none;
    const double edge_z = sz > 0 ? (std::abs(along_z) - ex * ly - ey * lx) / sz - r : none;
    const double edge = std::max(std::max(edge_x, edge_y), edge_z);
    const auto of_edge = [&](double x, double y, double z) {
      return edge_x == edge ? x : edge_y == edge ? y : z;
    };
    const double outwards =
        std::copysign(1 / of_edge(sx, sy, sz), of_edge(along_x, along_y, along_z));
    const double edge_nx = of_edge(0, uz * outwards, -uy * outwards);
    const double edge_ny = of_edge(-uz * outwards, 0, ux * outwards);
    const double edge_nz = of_edge(uy * outwards, -ux * outwards, 0);

    const double along = dx * ux + dy * uy + dz * uz;
    const double cap = std::abs(along) - h - ex * lx - ey * ly - ez * lz;
    const double cap_side = std::copysign(1, along);

    const double plain = std::max(face, cap);
    const auto of_kind = [&](double at_edge, double at_cap, double at_face) {
      return edge > plain ? at_edge : cap > face ? at_cap : at_face;
    };
    block.normal.x[i] = of_kind(edge_nx, cap_side * ux, face_side * is_x);
    block.normal.y[i] = of_kind(edge_ny, cap_side * uy, face_side * is_y);
    block.normal.z[i] = of_kind(edge_nz, cap_side * uz, face_side * is_z);
    const double gap = std::max(edge, plain);
    const bool in_range = is_in_range(block.far[i]);
    block.gap[i] = ((gap > stop_above) & in_range) ? gap : undecided;
  }
}

template <class Other>
bool sizes_in_range(const Cylinder& a, const Other& b) {
  const Pose anywhere;
  const auto pair = posed_pair(a, anywhere, b, anywhere);
  return are_in_range(lengths(pair.a), lengths(pair.b));
}

template <class Other>
constexpr bool is_formula = std::is_same_v<Other, Plane> || std::is_same_v<Other, Sphere>;

template <class Other>
constexpr bool is_looked_at = std::is_same_v<Other, Cylinder> || std::is_same_v<Other, Box>;

/// Calls answer(i, gap, normal) of each pair in turn with what is found of it, a gap above
/// `stop_above` or that of a formula, or `undecided`; normal() is then the normal.
template <class Other, class Answer>
void look_at_each(const Cylinder& a, std::span<const Pose> poses_a, const Other& b,
                  std::span<const Pose> poses_b, double stop_above, Answer answer) {
  const std::size_t all = poses_a.size();
  if (a.rounding() > 0 || rounding_in(b) > 0) {
    for (std::size_t i = 0; i < all; ++i) {
      answer(i, undecided, [] { return Vec3(Vec3::Zero()); });
    }
    return;
  }
  if constexpr (is_formula<Other>) {
    const bool in_range = sizes_in_range(a, b);
    for (std::size_t i = 0; i < all; ++i) {
      const auto pair = posed_pair(a, poses_a[i], b, poses_b[i]);
      const SignedDistance found = closed_form(pair.a, pair.b, stop_above);
      const bool is_found = in_range && is_in_range(pair.a.centre - pair.b.centre);
      answer(i, is_found ? found.value : undecided, [&] { return found.normal; });
    }
    return;
  } else if constexpr (is_looked_at<Other>) {
    if (sizes_in_range(a, b) && stop_above < no_early_exit) {
      Block<Other> block(a, b);
      for (std::size_t first = 0; first < all; first += width) {
        const std::size_t count = std::min(width, all - first);
        for (std::size_t i = 0; i < count; ++i) {
          block.load(i, posed_pair(a, poses_a[first + i], b, poses_b[first + i]));
        }
        look(block, stop_above);
        for (std::size_t i = 0; i < count; ++i) {
          const auto normal = [&] { return block.world_normal(i, poses_b[first + i]); };
          answer(first + i, block.gap[i], normal);
        }
      }
      return;
    }
  }
  for (std::size_t i = 0; i < all; ++i) {
    answer(i, undecided, [] { return Vec3(Vec3::Zero()); });
  }
}

}  // namespace

void check_lengths(std::size_t poses_a, std::size_t poses_b, std::size_t results) {
  const auto check = [&](const char* name, std::size_t length) {
    if (length == poses_a) return;
    throw InvalidInput(std::string(name) + ".size()", std::to_string(length),
                       "must be that of poses_a, " + std::to_string(poses_a));
  };
  check("poses_b", poses_b);
  check("results", results);
}

void signed_distance(const Cylinder& a, std::span<const Pose> poses_a, const Shape& b,
                     std::span<const Pose> poses_b, std::span<SignedDistance> results) {
  check_lengths(poses_a.size(), poses_b.size(), results.size());
  const auto answer_all = [&](const auto& other) {
    const auto answer = [&](std::size_t i, double gap, const auto& normal) {
      results[i] = std::isnan(gap) ? signed_distance(a, poses_a[i], other, poses_b[i])
                                   : SignedDistance{gap, normal()};
    };
    look_at_each(a, poses_a, other, poses_b, no_early_exit, answer);
  };
  std::visit(answer_all, b);
}

void overlaps(const Cylinder& a, std::span<const Pose> poses_a, const Shape& b,
              std::span<const Pose> poses_b, std::span<bool> results) {
  check_lengths(poses_a.size(), poses_b.size(), results.size());
  const auto answer_all = [&](const auto& other) {
    const auto answer = [&](std::size_t i, double gap, const auto&) {
      results[i] = std::isnan(gap) ? overlaps(a, poses_a[i], other, poses_b[i]) : gap <= 0;
    };
    look_at_each(a, poses_a, other, poses_b, 0, answer);
  };
  std::visit(answer_all, b);
}

void contact(const Cylinder& a, std::span<const Pose> poses_a, const Shape& b,
             std::span<const Pose> poses_b, double contact_threshold, std::span<Contact> results,
             PointRange range) {
  check_lengths(poses_a.size(), poses_b.size(), results.size());
  const auto answer_all = [&](const auto& other) {
    const auto answer = [&](std::size_t i, double gap, const auto& normal) {
      if (!(gap > contact_threshold)) {
        results[i] = contact(a, poses_a[i], other, poses_b[i], contact_threshold, nullptr, range);
        return;
      }
      results[i].normal = normal();
      results[i].signed_distance = gap;
      results[i].clear_points();
    };
    look_at_each(a, poses_a, other, poses_b, contact_threshold, answer);
  };
  std::visit(answer_all, b);
}

}  // namespace touchstone
