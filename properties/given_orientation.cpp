#include "properties/given_orientation.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

/// Of the products of columns. Matrices of ten digits pass, those of single precision do not: they
/// would move a body of a metre by more than its contacts are deep.
constexpr double max_rotation_error = 1e-9;

std::string row_text(const Eigen::Matrix3d& m, int row) {
  return fmt::format("[{}, {}, {}]", m(row, 0), m(row, 1), m(row, 2));
}

/// What keeps it from being a rotation; empty if nothing does.
std::string fault_of(const Eigen::Matrix3d& m) {
  for (int i = 0; i < 3; ++i) {
    const double length = m.col(i).norm();
    if (!(std::abs(length - 1) <= max_rotation_error)) {
      return fmt::format("column {} has length {}", i + 1, length);
    }
    for (int j = 0; j < i; ++j) {
      const double product = m.col(i).dot(m.col(j));
      if (!(std::abs(product) <= max_rotation_error)) {
        return fmt::format("columns {} and {} are {} degrees apart", j + 1, i + 1,
                           std::acos(std::clamp(product, -1.0, 1.0)) * 180 / std::numbers::pi);
      }
    }
  }
  return m.col(0).cross(m.col(1)).dot(m.col(2)) > 0 ? "" : "it mirrors";
}

/// Times a power of two, which costs no digit; without zeros of negative sign.
template <class Vector>
Vector moderate(const Vector& v) {
  const int exponent = std::ilogb(v.cwiseAbs().maxCoeff());
  return v.unaryExpr([&](double x) { return std::scalbn(x, -exponent) + 0.0; });
}

}  // namespace

Eigen::Quaterniond orientation_of(const Eigen::Matrix3d& rotation) {
  if (const std::string fault = fault_of(rotation); !fault.empty()) {
    throw InvalidInput("rotation",
                       fmt::format("[{}, {}, {}]", row_text(rotation, 0), row_text(rotation, 1),
                                   row_text(rotation, 2)),
                       fmt::format("must be a rotation to {}, but {}", max_rotation_error, fault));
  }
  // A step of Newton's to the nearest rotation (Higham, Functions of Matrices, 8.3): it squares the
  // error. The inverse's transpose is made of the columns' cross products.
  Eigen::Matrix3d inverse;
  for (int i = 0; i < 3; ++i) {
    inverse.col(i) = rotation.col((i + 1) % 3).cross(rotation.col((i + 2) % 3));
  }
  const Eigen::Matrix3d r = (rotation + inverse / inverse.col(0).dot(rotation.col(0))) / 2;
  // Shepperd's method (Quaternion from Rotation Matrix, 1978) without its square root: 4 q_i q,
  // w first, for the largest q_i.
  const double x = r(2, 1) - r(1, 2), y = r(0, 2) - r(2, 0), z = r(1, 0) - r(0, 1);
  const double xy = r(0, 1) + r(1, 0), xz = r(0, 2) + r(2, 0), yz = r(1, 2) + r(2, 1);
  const Eigen::Vector4d squares(1 + r(0, 0) + r(1, 1) + r(2, 2), 1 + r(0, 0) - r(1, 1) - r(2, 2),
                                1 - r(0, 0) + r(1, 1) - r(2, 2), 1 - r(0, 0) - r(1, 1) + r(2, 2));
  const Eigen::Vector4d rows[] = {{squares[0], x, y, z},
                                  {x, squares[1], xy, xz},
                                  {y, xy, squares[2], yz},
                                  {z, xz, yz, squares[3]}};
  Eigen::Index largest = 0;
  squares.maxCoeff(&largest);
  const Eigen::Vector4d q = moderate(rows[largest]);
  return {q[0], q[1], q[2], q[3]};
}

Eigen::Quaterniond orientation_along(const Vec3& axis) {
  if (axis == Vec3::Zero()) {
    throw InvalidInput("axis", "[0, 0, 0]", "must not be the zero vector");
  }
  // The axis of the turn is z × axis; half its angle has the tangent across / (length + z).
  const Vec3 d = moderate(axis);
  if (d.x() == 0 && d.y() == 0 && d.z() < 0) return {0, 1, 0, 0};
  const double length = d.norm(), across = d.x() * d.x() + d.y() * d.y();
  const double w = d.z() >= 0 ? length + d.z() : across / (length - d.z());
  const Eigen::Vector4d q = moderate(Eigen::Vector4d(w, -d.y(), d.x(), 0));
  return {q[0], q[1], q[2], q[3]};
}

}  // namespace touchstone
