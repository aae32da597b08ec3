#include <algorithm>
#include <cmath>

#include "curves.hpp"

namespace touchstone {
namespace {

/// An angle by its cosine and sine: the ellipse's point is (a c, b s).
struct Anomaly {
  double c, s;

  /// Turned by 2 atan(step / 2), which is `step` to third order and always a rotation.
  Anomaly turned(double step) const {
    const double t = step / 2;
    const double scale = 1 / (1 + t * t);
    const double cosine = (1 - t * t) * scale, sine = 2 * t * scale;
    return {c * cosine - s * sine, s * cosine + c * sine};
  }
};

Anomaly towards(double c, double s) {
  const double squared = c * c + s * s;
  constexpr double vanishing = 1e-250;  // digits are lost
  if (squared < vanishing && (c != 0 || s != 0)) {
    const double largest = std::max(std::abs(c), std::abs(s));
    return towards(c / largest, s / largest);
  }
  const double length = std::sqrt(squared);
  return {c / length, s / length};
}

Anomaly between(const Anomaly& p, const Anomaly& q) { return towards(p.c + q.c, p.s + q.s); }

/// Is q counter-clockwise of p, both within a quarter turn?
bool after(const Anomaly& q, const Anomaly& p) { return p.c * q.s > p.s * q.c; }

constexpr int max_steps = 60;
/// Newton's next step is the square of this: below rounding.
constexpr double small_step = 1e-8;

/// The foot on the point's own side of the major axis: a x s − b y c − (a² − b²) s c, half the
/// derivative of the squared distance, has one root in the quadrant (over s c it is monotone).
/// Newton kept inside the bracket, bisecting when it leaves or is slow.
Anomaly same_side_foot(double ax, double by, double focal, Anomaly t) {
  Anomaly lo{1, 0}, hi{0, 1};
  double previous = 1;
  for (int i = 0; i < max_steps; ++i) {
    const double slope = ax * t.s - by * t.c - focal * t.s * t.c;
    const double rise = ax * t.c + by * t.s - focal * (t.c - t.s) * (t.c + t.s);
    if (slope == 0) return t;
    (slope < 0 ? lo : hi) = t;
    const double step = -slope / rise;
    Anomaly next = t.turned(step);
    // A step that small may leave the bracket by rounding.
    if (rise > 0 && std::abs(step) < small_step) return next;
    const bool good = std::abs(step) <= previous && after(next, lo) && after(hi, next);
    if (!good) next = between(lo, hi);
    previous = good ? std::abs(step) / 2 : 1;
    t = next;
  }
  return t;
}

/// The foot across the major axis (y < 0, by = b |y|): the larger root of the convex function
/// a x / c + b |y| / s − (a² − b²). Newton comes from the right, where it cannot overshoot; once
/// the function rises to the left there is no root.
std::optional<Anomaly> far_side_foot(double ax, double by, double focal) {
  if (!(ax < focal && by < focal)) return std::nullopt;
  Anomaly t{ax / focal, std::sqrt((focal - ax) * (focal + ax)) / focal};
  for (int i = 0; i < max_steps; ++i) {
    if (!(t.c > 0 && t.s > 0)) return t.c <= 0 ? std::optional(Anomaly{0, 1}) : std::nullopt;
    const double value = ax / t.c + by / t.s - focal;
    const double rise = ax * t.s / (t.c * t.c) - by * t.c / (t.s * t.s);
    if (!(rise > 0)) return std::nullopt;
    const double step = -value / rise;
    t = t.turned(std::max(step, -1.0));
    if (std::abs(step) < small_step) return t;
  }
  return t;
}

}  // namespace

std::optional<Eigen::Vector2d> ellipse_normal(double a, double b, double x, double y) {
  if (!(x >= 0)) return std::nullopt;
  // A half axis whose products with the other would vanish is none.
  constexpr double flat = 1e-60;
  if (b < flat * a) b = 0;
  const double ax = a * x, by = b * y, focal = (a - b) * (a + b);
  std::optional<Anomaly> foot;
  if (y > 0) {
    if (by > 0) {
      // The foot is ((a² x)/(a² + τ), (b² y)/(b² + τ)) with τ near 0 at the ellipse.
      const double far = std::sqrt(x * x + y * y) - a;
      const double tau = far > 0 ? a * far : 0;
      foot = x > 0 ? same_side_foot(ax, by, focal, towards(ax * (b * b + tau), by * (a * a + tau)))
                   : Anomaly{0, 1};
    } else {
      // Seen edge on, the ellipse is its major axis: its inside, or its end.
      const double beyond = x - a;
      if (!(beyond > 0)) return Eigen::Vector2d(0, 1);
      const Anomaly n = towards(beyond, y);
      return Eigen::Vector2d(n.c, n.s);
    }
  } else if (x == 0) {
    if (!(-by < focal)) return std::nullopt;
    foot = Anomaly{0, 1};
  } else {
    foot = far_side_foot(ax, -by, focal);
  }
  if (!foot) return std::nullopt;
  // The normal at (a c, b s) is along (b c, a s).
  const Anomaly n = towards(b * foot->c, a * foot->s);
  return Eigen::Vector2d(n.c, n.s);
}

}  // namespace touchstone
