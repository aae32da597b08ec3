#pragma once

#include <array>
#include <type_traits>

namespace touchstone::oracle {

/// Three coordinates over any ring: exact integers, rationals, balls or double intervals. (Eigen's
/// expression templates and those of GMP's C++ classes do not mix.)
template <class T>
struct Vector3 {
  T x, y, z;
};

template <class T>
Vector3<T> operator+(const Vector3<T>& a, const Vector3<T>& b) {
  return {T(a.x + b.x), T(a.y + b.y), T(a.z + b.z)};
}
template <class T>
Vector3<T> operator-(const Vector3<T>& a, const Vector3<T>& b) {
  return {T(a.x - b.x), T(a.y - b.y), T(a.z - b.z)};
}
template <class T>
Vector3<T> operator-(const Vector3<T>& a) {
  return {T(-a.x), T(-a.y), T(-a.z)};
}
template <class T>
Vector3<T> operator*(const std::type_identity_t<T>& s, const Vector3<T>& a) {
  return {T(s * a.x), T(s * a.y), T(s * a.z)};
}
template <class T>
T dot(const Vector3<T>& a, const Vector3<T>& b) {
  return T(a.x * b.x + a.y * b.y + a.z * b.z);
}
template <class T>
Vector3<T> cross(const Vector3<T>& a, const Vector3<T>& b) {
  return {T(a.y * b.z - a.z * b.y), T(a.z * b.x - a.x * b.z), T(a.x * b.y - a.y * b.x)};
}

template <class T>
bool is_zero(const Vector3<T>& a) {
  return a.x == 0 && a.y == 0 && a.z == 0;
}

/// The rotation of a quaternion (w, x, y, z) other than zero, times its squared length `norm`: the
/// columns are exactly orthogonal and of exactly the length `norm` (Euler–Rodrigues, without the
/// division). T is the integers or the rationals.
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
