#pragma once

// The switches behind which mutation_score.py plants faults, so that one build holds all of them
// and each costs a run only. The environment variable TOUCHSTONE_FAULT says which one is active;
// none is where it is not set. Included before everything else by the compiler's command line.
//
// A binary operator is replaced without knowing where its operands end: `a + b` is written as
// `a + Replaced{7} + b`, which has the same precedence, and is a - b where fault 7 is active.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <initializer_list>

namespace touchstone::planted {

inline int active_fault() {
  static const int fault = [] {
    const char* text = std::getenv("TOUCHSTONE_FAULT");
    return text ? std::atoi(text) : 0;
  }();
  return fault;
}
inline bool is(int fault) { return active_fault() == fault; }

/// The vector or matrix that an expression of Eigen's stands for; anything else itself.
template <class T>
auto plain(const T& x) {
  if constexpr (requires { x.eval(); }) {
    return x.eval();
  } else {
    return x;
  }
}

/// Another operator: - for +, / for *, > for <, and so on.
struct Replaced {
  int fault;
};
/// The same operator with its operands exchanged.
struct Exchanged {
  int fault;
};

template <class T, class How>
struct Sum {
  const T& left;
  int fault;
};
template <class T, class How>
struct Difference {
  const T& left;
  int fault;
};
template <class T, class How>
struct Product {
  const T& left;
  int fault;
};
template <class T, class How>
struct Quotient {
  const T& left;
  int fault;
};
template <class T, class How>
struct Less {
  const T& left;
  int fault;
};
template <class T, class How>
struct LessEqual {
  const T& left;
  int fault;
};
template <class T, class How>
struct Greater {
  const T& left;
  int fault;
};
template <class T, class How>
struct GreaterEqual {
  const T& left;
  int fault;
};
template <class T, class How>
struct Equal {
  const T& left;
  int fault;
};
template <class T, class How>
struct NotEqual {
  const T& left;
  int fault;
};

#define PLANTED(Name, op, other)                                             \
  template <class T>                                                         \
  Name<T, Replaced> operator op(const T& left, const Replaced& how) {        \
    return {left, how.fault};                                                \
  }                                                                          \
  template <class T>                                                         \
  Name<T, Exchanged> operator op(const T& left, const Exchanged& how) {      \
    return {left, how.fault};                                                \
  }                                                                          \
  template <class T, class U>                                                \
  auto operator op(const Name<T, Replaced>& x, const U& right) {             \
    return is(x.fault) ? plain(x.left other right) : plain(x.left op right); \
  }                                                                          \
  template <class T, class U>                                                \
  auto operator op(const Name<T, Exchanged>& x, const U& right) {            \
    return is(x.fault) ? plain(right op x.left) : plain(x.left op right);    \
  }
PLANTED(Sum, +, -)
PLANTED(Difference, -, +)
PLANTED(Quotient, /, *)
PLANTED(Less, <, >)
PLANTED(LessEqual, <=, >=)
PLANTED(Greater, >, <)
PLANTED(GreaterEqual, >=, <=)
PLANTED(Equal, ==, !=)
PLANTED(NotEqual, !=, ==)
#undef PLANTED

template <class T>
Product<T, Replaced> operator*(const T& left, const Replaced& how) {
  return {left, how.fault};
}
/// Without its factor where the right one is a vector, by which nothing can be divided.
template <class T, class U>
auto operator*(const Product<T, Replaced>& x, const U& right) {
  if constexpr (requires { x.left / right; }) {
    return is(x.fault) ? plain(x.left / right) : plain(x.left * right);
  } else {
    return is(x.fault) ? plain(right) : plain(x.left * right);
  }
}

inline double abs(int fault, double x) { return is(fault) ? x : std::abs(x); }
inline double sqrt(int fault, double x) { return is(fault) ? x : std::sqrt(x); }
inline double sin(int fault, double x) { return is(fault) ? std::cos(x) : std::sin(x); }
inline double cos(int fault, double x) { return is(fault) ? std::sin(x) : std::cos(x); }
inline double acos(int fault, double x) { return is(fault) ? std::asin(x) : std::acos(x); }
inline double atan2(int fault, double y, double x) {
  return is(fault) ? std::atan2(x, y) : std::atan2(y, x);
}
inline double copysign(int fault, double x, double sign) {
  return std::copysign(x, is(fault) ? -sign : sign);
}
template <class T>
T min(int fault, const T& x, const T& y) {
  return is(fault) ? std::max(x, y) : std::min(x, y);
}
template <class T>
T max(int fault, const T& x, const T& y) {
  return is(fault) ? std::min(x, y) : std::max(x, y);
}
inline double min(int fault, std::initializer_list<double> all) {
  return is(fault) ? std::max(all) : std::min(all);
}
inline double max(int fault, std::initializer_list<double> all) {
  return is(fault) ? std::min(all) : std::max(all);
}
template <class T>
T clamp(int fault, const T& x, const T& lo, const T& hi) {
  return is(fault) ? x : std::clamp(x, lo, hi);
}
/// A number times a factor.
inline double scaled(int fault, double factor, double x) { return is(fault) ? factor * x : x; }
/// Plus or minus one.
inline double sign(int fault) { return is(fault) ? 1 : -1; }

}  // namespace touchstone::planted
