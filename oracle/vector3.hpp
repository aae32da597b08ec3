#pragma once

#include <type_traits>

namespace touchstone::oracle {

/// Three coordinates over any ring: exact integers, balls or double intervals. (Eigen's expression
/// templates and those of GMP's C++ classes do not mix.)
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

}  // namespace touchstone::oracle
