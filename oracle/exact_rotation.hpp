#pragma once

#include <array>

#include "oracle/vector3.hpp"

namespace touchstone::oracle {

/// The rotation of the quaternion (w, x, y, z), not zero, times `norm` = its squared length: the
/// columns are exactly orthogonal and of exactly that length (Euler–Rodrigues, without the
/// division). Over the integers or the rationals.
template <class T>
struct ExactRotation {
  ExactRotation(const T& w, const T& x, const T& y, const T& z) {
    const T ww = w * w, xx = x * x, yy = y * y, zz = z * z;
    const T wx = w * x, wy = w * y, wz = w * z, xy = x * y, xz = x * z, yz = y * z;
    columns = {Vector3<T>{ww + xx - yy - zz, 2 * (xy + wz), 2 * (xz - wy)},
               Vector3<T>{2 * (xy - wz), ww - xx + yy - zz, 2 * (yz + wx)},
               Vector3<T>{2 * (xz + wy), 2 * (yz - wx), ww - xx - yy + zz}};
    norm = ww + xx + yy + zz;
  }

  Vector3<T> apply(const Vector3<T>& v) const {
    return v.x * columns[0] + v.y * columns[1] + v.z * columns[2];
  }
  Vector3<T> apply_inverse(const Vector3<T>& v) const {
    return {dot(columns[0], v), dot(columns[1], v), dot(columns[2], v)};
  }

  std::array<Vector3<T>, 3> columns;
  T norm;
};

}  // namespace touchstone::oracle
