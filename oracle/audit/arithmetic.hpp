#pragma once

#include <CGAL/Interval_nt.h>
#include <boost/multiprecision/eigen.hpp>
#include <boost/multiprecision/mpfr.hpp>

#include <Eigen/Core>

namespace touchstone::audit {

/// Double intervals that round outward while a Protect_FPU_rounding<true> is alive: what they
/// enclose is certain. Brönnimann, Burnikel, Pion, "Interval arithmetic yields efficient dynamic
/// filters for computational geometry", Discrete Applied Mathematics 109, 2001.
using Interval = CGAL::Interval_nt<false>;

/// Floating point of about 400 bits: for searches where doubles do not separate what they must.
using Multiprecision = boost::multiprecision::number<
    boost::multiprecision::mpfr_float_backend<120, boost::multiprecision::allocate_stack>,
    boost::multiprecision::et_off>;

template <class T>
using Vector = Eigen::Matrix<T, 3, 1>;
template <class T>
using Matrix = Eigen::Matrix<T, 3, 3>;

/// The numbers that a certain arithmetic T certifies for: those the search computes in, without
/// any promise of its own.
template <class T>
struct SearchNumber {
  using type = T;
};
template <>
struct SearchNumber<Interval> {
  using type = double;
};
template <class T>
using Real = typename SearchNumber<T>::type;

/// What a value in T is certainly not below (above). Of anything but intervals: the value itself.
template <class T>
const T& lower(const T& x) {
  return x;
}
template <class T>
const T& upper(const T& x) {
  return x;
}
inline double lower(const Interval& x) { return x.inf(); }
inline double upper(const Interval& x) { return x.sup(); }

/// The vector in another arithmetic; exact where that arithmetic is finer.
template <class To, class From>
Vector<To> as(const Vector<From>& v) {
  return {To(v.x()), To(v.y()), To(v.z())};
}

}  // namespace touchstone::audit
