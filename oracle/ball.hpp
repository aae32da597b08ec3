#pragma once

#include <arb.h>
#include <array>
#include <gmpxx.h>
#include <type_traits>

namespace touchstone::oracle {

/// Length of an integer in binary digits, its sign aside.
inline long bits_of(const mpz_class& x) {
  return static_cast<long>(mpz_sizeinbase(x.get_mpz_t(), 2));
}

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

/// Without temporary numbers.
template <>
inline mpz_class dot(const Vector3<mpz_class>& a, const Vector3<mpz_class>& b) {
  mpz_class sum = a.x * b.x;
  mpz_addmul(sum.get_mpz_t(), a.y.get_mpz_t(), b.y.get_mpz_t());
  mpz_addmul(sum.get_mpz_t(), a.z.get_mpz_t(), b.z.get_mpz_t());
  return sum;
}
template <>
inline Vector3<mpz_class> cross(const Vector3<mpz_class>& a, const Vector3<mpz_class>& b) {
  Vector3<mpz_class> result{a.y * b.z, a.z * b.x, a.x * b.y};
  mpz_submul(result.x.get_mpz_t(), a.z.get_mpz_t(), b.y.get_mpz_t());
  mpz_submul(result.y.get_mpz_t(), a.x.get_mpz_t(), b.z.get_mpz_t());
  mpz_submul(result.z.get_mpz_t(), a.y.get_mpz_t(), b.x.get_mpz_t());
  return result;
}

template <class T>
bool is_zero(const Vector3<T>& a) {
  return a.x == 0 && a.y == 0 && a.z == 0;
}

/// Is their cross product zero?
inline bool parallel(const Vector3<mpz_class>& a, const Vector3<mpz_class>& b) {
  return a.y * b.z == a.z * b.y && a.z * b.x == a.x * b.z && a.x * b.y == a.y * b.x;
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

/// A binary floating-point number of any length (FLINT/arb's arf): sums, differences and products
/// are exact.
class Float {
 public:
  Float() { arf_init(value_); }
  Float(const Float& other) : Float() { arf_set(value_, other.value_); }
  Float(Float&& other) noexcept : Float() { arf_swap(value_, other.value_); }
  Float& operator=(const Float& other) {
    arf_set(value_, other.value_);
    return *this;
  }
  Float& operator=(Float&& other) noexcept {
    arf_swap(value_, other.value_);
    return *this;
  }
  ~Float() { arf_clear(value_); }

  explicit Float(double x) : Float() { arf_set_d(value_, x); }
  explicit Float(const mpz_class& x) : Float() { arf_set_mpz(value_, x.get_mpz_t()); }

  arf_ptr get() { return value_; }
  arf_srcptr get() const { return value_; }
  int sign() const { return arf_sgn(value_); }
  mpq_class rational() const;

 private:
  arf_t value_;
};

inline Float operator+(const Float& a, const Float& b) {
  Float r;
  arf_add(r.get(), a.get(), b.get(), ARF_PREC_EXACT, ARF_RND_DOWN);
  return r;
}
inline Float operator-(const Float& a, const Float& b) {
  Float r;
  arf_sub(r.get(), a.get(), b.get(), ARF_PREC_EXACT, ARF_RND_DOWN);
  return r;
}
inline Float operator*(const Float& a, const Float& b) {
  Float r;
  arf_mul(r.get(), a.get(), b.get(), ARF_PREC_EXACT, ARF_RND_DOWN);
  return r;
}
/// a/b as a double, rounded towards zero.
double quotient(const Float& a, const Float& b);
inline bool operator<(const Float& a, const Float& b) { return arf_cmp(a.get(), b.get()) < 0; }

/// A real number known to lie within a radius of a midpoint: FLINT/arb's ball arithmetic, in which
/// every operation encloses the exact result. Johansson, "Arb: efficient arbitrary-precision
/// midpoint-radius interval arithmetic", IEEE Trans. Computers 66(8), 2017.
class Ball {
 public:
  Ball() { arb_init(value_); }
  Ball(const Ball& other) : Ball() { arb_set(value_, other.value_); }
  Ball(Ball&& other) noexcept : Ball() { arb_swap(value_, other.value_); }
  Ball& operator=(const Ball& other) {
    arb_set(value_, other.value_);
    return *this;
  }
  Ball& operator=(Ball&& other) noexcept {
    arb_swap(value_, other.value_);
    return *this;
  }
  ~Ball() { arb_clear(value_); }

  Ball(int exact) : Ball() { arb_set_si(value_, exact); }
  explicit Ball(const mpz_class& exact);
  /// Rounded to that many bits.
  Ball(const mpz_class& value, long bits);
  explicit Ball(const mpq_class& exact);
  /// A ball that contains [lo, hi].
  Ball(const mpq_class& lo, const mpq_class& hi);

  arb_ptr get() { return value_; }
  arb_srcptr get() const { return value_; }

  /// The ends of the enclosure, rounded outward; the ball must be finite.
  Float lower_end() const;
  Float upper_end() const;
  mpq_class lower() const { return lower_end().rational(); }
  mpq_class upper() const { return upper_end().rational(); }
  double midpoint() const;

  bool is_finite() const { return arb_is_finite(value_); }
  bool is_zero() const { return arb_is_zero(value_); }  ///< Exactly zero?
  bool contains_zero() const { return arb_contains_zero(value_); }
  bool is_positive() const { return arb_is_positive(value_); }
  bool is_negative() const { return arb_is_negative(value_); }

 private:
  arb_t value_;
};

/// Sets the working precision, in bits, of all ball operations of this thread for the lifetime of
/// the object. Without one it is 64.
class WorkingPrecision {
 public:
  explicit WorkingPrecision(long bits) : previous_(current_) { current_ = bits; }
  ~WorkingPrecision() { current_ = previous_; }
  WorkingPrecision(const WorkingPrecision&) = delete;
  WorkingPrecision& operator=(const WorkingPrecision&) = delete;

  static long bits() { return current_; }

 private:
  static inline thread_local long current_ = 64;
  long previous_;
};

inline Ball operator+(const Ball& a, const Ball& b) {
  Ball r;
  arb_add(r.get(), a.get(), b.get(), WorkingPrecision::bits());
  return r;
}
inline Ball operator-(const Ball& a, const Ball& b) {
  Ball r;
  arb_sub(r.get(), a.get(), b.get(), WorkingPrecision::bits());
  return r;
}
inline Ball operator-(const Ball& a) {
  Ball r;
  arb_neg(r.get(), a.get());
  return r;
}
inline Ball operator*(const Ball& a, const Ball& b) {
  Ball r;
  arb_mul(r.get(), a.get(), b.get(), WorkingPrecision::bits());
  return r;
}
/// Not finite when b contains zero.
inline Ball operator/(const Ball& a, const Ball& b) {
  Ball r;
  arb_div(r.get(), a.get(), b.get(), WorkingPrecision::bits());
  return r;
}
inline Ball abs(const Ball& a) {
  Ball r;
  arb_abs(r.get(), a.get());
  return r;
}
inline Ball max(const Ball& a, const Ball& b) {
  Ball r;
  arb_max(r.get(), a.get(), b.get(), WorkingPrecision::bits());
  return r;
}
/// Square root of a number known to be non-negative: negative values in the ball are ignored.
inline Ball sqrt(const Ball& a) {
  Ball r;
  arb_sqrtpos(r.get(), a.get(), WorkingPrecision::bits());
  return r;
}
inline Ball square(const Ball& a) {
  Ball r;
  arb_sqr(r.get(), a.get(), WorkingPrecision::bits());
  return r;
}

using BallVector = Vector3<Ball>;

template <>
inline Ball dot(const BallVector& a, const BallVector& b) {
  static_assert(sizeof(BallVector) == 3 * sizeof(arb_struct));
  Ball r;
  arb_dot(r.get(), nullptr, 0, a.x.get(), 1, b.x.get(), 1, 3, WorkingPrecision::bits());
  return r;
}

inline Ball norm(const BallVector& v) { return sqrt(dot(v, v)); }

/// Rounded to the working precision.
BallVector to_balls(const Vector3<mpz_class>& v);

}  // namespace touchstone::oracle
