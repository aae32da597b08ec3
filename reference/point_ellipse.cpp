#include "point_ellipse.hpp"

#include <cmath>
#include <numbers>

namespace touchstone {
namespace {

/// a x sin t − b y cos t − (a² − b²) sin t cos t: half the derivative of the squared distance.
struct Slope {
  double ax, by, focal;
  double operator()(double t) const {
    const double s = std::sin(t), c = std::cos(t);
    return ax * s - by * c - focal * s * c;
  }
  double derivative(double t) const {
    const double s = std::sin(t), c = std::cos(t);
    return ax * c + by * s - focal * (c * c - s * s);
  }
};

/// Newton kept inside a bracket, bisecting when it leaves or is slow; at most 60 steps.
double bracketed_root(const Slope& f, double lo, double hi) {
  double f_lo = f(lo);
  double t = (lo + hi) / 2;
  double previous = hi - lo;
  for (int i = 0; i < 60; ++i) {
    const double value = f(t);
    if (value == 0) return t;
    if ((value < 0) == (f_lo < 0)) {
      lo = t;
      f_lo = value;
    } else {
      hi = t;
    }
    const double step = value / f.derivative(t);
    const double newton = t - step;
    const bool good = newton > lo && newton < hi && std::abs(step) < previous / 2;
    const double next = good ? newton : (lo + hi) / 2;
    previous = std::abs(next - t);
    if (previous <= 4e-16) return next;
    t = next;
  }
  return t;
}

}  // namespace

EllipseFeet feet_on_ellipse(double a, double b, double x, double y) {
  constexpr double quarter = std::numbers::pi / 2;
  const Slope f{a * std::abs(x), b * std::abs(y), (a - b) * (a + b)};
  EllipseFeet feet;
  const auto add = [&](double t) {
    // Unfold: mirror across the minor axis, then the major one.
    if (x < 0) t = std::numbers::pi - t;
    feet.angle[feet.count++] = y < 0 ? -t : t;
  };
  if (f.by == 0 && f.ax < f.focal) {
    // On the major axis between the centres of curvature: both sides are nearest.
    const double t = std::acos(f.ax / f.focal);
    add(t);
    add(-t);
    return feet;
  }
  add(f.by == 0 ? 0 : f.ax == 0 ? quarter : bracketed_root(f, 0, quarter));
  // Across the major axis: −a x/cos t' − b y/sin t' + focal is concave in t' = −t with its top at
  // tan³ t' = b y / (a x).
  const double top = std::atan2(std::cbrt(f.by), std::cbrt(f.ax));
  if (f(-top) > 0 && top > 0 && top < quarter) {
    add(-bracketed_root({-f.ax, f.by, -f.focal}, top, quarter));
    add(-bracketed_root({-f.ax, f.by, -f.focal}, 0, top));
  } else if (f.ax == 0 && f.focal > f.by) {
    add(-quarter);
  }
  return feet;
}

}  // namespace touchstone
