#include <algorithm>
#include <cmath>

#include "curves.hpp"

// The foot of the normal through a point is found by Newton's method, which converges from wherever
// it starts (proofs.md, "A point against an ellipse"). It starts where six steps are enough, but
// for a point across the major axis, of which two normals may nearly coincide.

namespace touchstone {
namespace {

/// An angle by its cosine and sine: the ellipse's point is (a c, b s).
struct Anomaly {
  double c, s;
};

/// c, s >= 0
Anomaly towards(double c, double s) {
  const double squared = c * c + s * s;
  constexpr double vanishing = 1e-250;  // digits are lost
  if (squared < vanishing && (c > 0 || s > 0)) {
    const double largest = std::max(c, s);
    return towards(c / largest, s / largest);
  }
  const double inverse = 1 / std::sqrt(squared);
  return {inverse * c, inverse * s};
}

Anomaly with_cosine(double c) { return {c, std::sqrt((1 - c) * (1 + c))}; }

/// The point (x, y) as (a x, b y), and a² − b²: the ellipse's normal at (c, s) is the line
/// a x s − b y c = (a² − b²) s c. Also a x − (a² − b²), how far the point lies beyond the cusp.
struct ScaledPoint {
  double ax, by, focal, beyond;

  /// a x − focal c³; where that cancels, from what is beyond the cusp.
  double along(const Anomaly& t) const {
    constexpr double cancels = 1e-3;  // more than half of the digits
    if (t.s > cancels) return ax - focal * (t.c * t.c * t.c);
    return beyond + focal * (t.s * t.s) * (1 + t.c + t.c * t.c) / (1 + t.c);
  }

  /// About the foot of a point on its own side of the major axis, y > 0.
  Anomaly same_side_start() const {
    constexpr double far = 1.7;
    if (ax * ax + by * by > far * focal * focal) return towards(ax, by);
    constexpr double next_to_the_cusp = 0.9;
    const double c = ax / (focal + by);  // the foot's is no larger
    if (c < next_to_the_cusp) return with_cosine(c);
    // With s small: (a x − focal) s + focal s³ / 2 = b y.
    const double y = by / focal, x = beyond / focal, cubic = std::cbrt(2 * y);
    constexpr double max_sine = 0.9;
    const double s = x > 0 ? std::min(cubic, y / x) : std::max(cubic, std::sqrt(-2 * x));
    const Anomaly t = with_cosine(std::min(s, max_sine));
    return {t.s, t.c};
  }

  /// The foot on the point's own side, or, y <= 0, across the major axis the one further from it:
  /// the smaller c, if there is one.
  std::optional<Anomaly> foot() const {
    const bool same_side = by > 0;
    if (!same_side && !(ax - by < focal)) return std::nullopt;
    Anomaly t = same_side ? same_side_start() : with_cosine(ax / focal);
    const int max_steps = same_side ? 8 : 60;
    for (int i = 0; i < max_steps; ++i) {
      const double c = along(t), s = by + focal * (t.s * t.s * t.s);
      if (!same_side && !(c > 0 && s > 0)) return std::nullopt;
      const Anomaly next = towards(std::max(c, 0.0), s);
      const double step = t.c * next.s - t.s * next.c;
      t = next;
      // The next step would be about the square of this over the smaller one, of which it must be
      // a small part: of a flat ellipse the normal depends on that.
      constexpr double small_step = 1e-8, small_part = 2e-7, part_that_squared_is_small = 1e-4;
      const double smaller = std::min(t.c, t.s);
      if (std::abs(step) < std::max(small_part * smaller,
                                    std::min(small_step, part_that_squared_is_small * smaller)))
        break;
    }
    return t;
  }
};

}  // namespace

std::optional<Vec2> ellipse_normal(double a, double b, double x, double y) {
  if (!(x >= 0)) return std::nullopt;
  // A half axis whose products with the other would vanish is none.
  constexpr double flat = 1e-60;
  if (b < flat * a) b = 0;
  if (y > 0 && !(b * y > 0)) {
    // Seen edge on, the ellipse is its major axis: its inside, or its end.
    if (!(x > a)) return Vec2(0, 1);
    const Anomaly n = towards(x - a, y);
    return Vec2(n.c, n.s);
  }
  const ScaledPoint p{a * x, b * y, (a - b) * (a + b), a * (x - a) + b * b};
  if (x == 0) {
    if (!(-p.by < p.focal)) return std::nullopt;
    return Vec2(0, 1);
  }
  const auto foot = p.foot();
  if (!foot) return std::nullopt;
  // The normal at (a c, b s) is along (b c, a s).
  const Anomaly n = towards(b * foot->c, a * foot->s);
  return Vec2(n.c, n.s);
}

}  // namespace touchstone
