#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "candidates/candidate.h"

namespace touchstone {

// Shapes of the C interface, as plug-ins, the host and the harness have them.

/// Number of kinds of shapes.
inline constexpr std::size_t shape_kinds = TS_CONVEX + 1;

/// A shape of any kind that has sizes.
constexpr ts_shape sized(ts_shape_kind kind, double first, double second = 0, double third = 0,
                         double fourth = 0) {
  return {kind, {first, second, third, fourth}, nullptr, nullptr, 0, 0, 0};
}

/// Coordinates of a convex body's vertices; else none.
inline std::span<const double> coordinates_of(const ts_shape& shape) {
  return {shape.vertices, 3 * static_cast<std::size_t>(shape.vertex_count)};
}

/// The numbers that a convex body's faces consist of; else none.
inline std::span<const int> face_list_of(const ts_shape& shape) {
  std::size_t size = 0;
  for (int i = 0; i < shape.face_count; ++i) {
    size += 1 + static_cast<std::size_t>(shape.faces[size]);
  }
  return {shape.faces, size};
}

/// The corners of each face, as indices of vertices.
inline std::vector<std::vector<int>> faces_of(const ts_shape& shape) {
  std::vector<std::vector<int>> faces;
  const int* next = shape.faces;
  for (int i = 0; i < shape.face_count; ++i) {
    const int count = *next++;
    faces.emplace_back(next, next + count);
    next += count;
  }
  return faces;
}

/// Are the shapes equal to the bit?
inline bool same(const ts_shape& x, const ts_shape& y) {
  using Bits = std::array<std::uint64_t, 4>;
  const auto bits = [](double coordinate) { return std::bit_cast<std::uint64_t>(coordinate); };
  return x.kind == y.kind && std::bit_cast<Bits>(x.size) == std::bit_cast<Bits>(y.size) &&
         bits(x.rounding) == bits(y.rounding) &&
         std::ranges::equal(coordinates_of(x), coordinates_of(y), {}, bits, bits) &&
         std::ranges::equal(face_list_of(x), face_list_of(y));
}

/// A shape with all that it points to.
class OwnedShape {
 public:
  explicit OwnedShape(const ts_shape& shape)
      : shape_(shape),
        coordinates_(coordinates_of(shape).begin(), coordinates_of(shape).end()),
        face_list_(face_list_of(shape).begin(), face_list_of(shape).end()) {
    if (shape_.kind != TS_CONVEX) return;
    shape_.vertices = coordinates_.data();
    shape_.faces = face_list_.data();
  }
  OwnedShape(OwnedShape&&) noexcept = default;
  OwnedShape& operator=(OwnedShape&&) noexcept = default;

  /// Its pointers outlive moves of this.
  const ts_shape& get() const { return shape_; }

 private:
  ts_shape shape_;
  std::vector<double> coordinates_;
  std::vector<int> face_list_;
};

}  // namespace touchstone
