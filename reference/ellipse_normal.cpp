#include <algorithm>
#include <cmath>

#include "curves.hpp"
#include "largest_gap.hpp"

// The foot of the normal through a point is found by Newton's method, which converges from wherever
// it starts (proofs.md, "A point against an ellipse"), and next to the foot by a method of the
// fourth order, as nothing else waits so long for roots and divisions. It starts where five steps
// are enough, next to the ellipse mostly one, but for a point across the major axis, of which two
// normals may nearly coincide.

namespace touchstone {
namespace {

/// An angle by its cosine and sine: the ellipse's point is (a c, b s).
struct Anomaly {
  double c, s;
};

/// c, s >= 0
inline Anomaly towards(double c, double s) {
  double squared = c * c + s * s;
  constexpr double vanishing = 1e-250;  // digits are lost
  if (squared < vanishing && (c > 0 || s > 0)) [[unlikely]] {
    const double largest = std::max(c, s);
    c /= largest, s /= largest;
    squared = c * c + s * s;
  }
  const double inverse = 1 / std::sqrt(squared);
  return {inverse * c, inverse * s};
}

Anomaly with_cosine(double c) { return {c, std::sqrt((1 - c) * (1 + c))}; }

/// The point (x, y) as (a x, b y), and a² − b²: the ellipse's normal at (c, s) is the line
/// a x s − b y c = (a² − b²) s c. Also a x − (a² − b²), how far the point lies beyond the cusp.
struct ScaledPoint {
  double a, b, x, y;
  double ax = a * x, by = b * y, focal = (a - b) * (a + b), beyond = a * (x - a) + b * b;

  /// a x − focal c³; where that cancels, from what is beyond the cusp.
  double along(const Anomaly& t) const {
    constexpr double cancels = 1e-3;  // more than half of the digits
    if (t.s > cancels) return ax - focal * (t.c * t.c * t.c);
    return beyond + focal * (t.s * t.s) * (1 + t.c + t.c * t.c) / (1 + t.c);
  }

  /// About the foot of a point on its own side of the major axis, y > 0.
  Anomaly same_side_start() const {
    if (const auto t = next_to_ellipse()) return *t;
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

  /// With the foot at (a² x / (a² + λ), b² y / (b² + λ)), λ from its equation's first terms, where
  /// it is small.
  std::optional<Anomaly> next_to_ellipse() const {
    const double bx = b * x, ay = a * y, ab = a * b, squared_bx = b * bx * (b * bx);
    const double squared_ay = a * ay * (a * ay), inverse = 1 / (squared_bx + squared_ay);
    const double off = (bx * bx + ay * ay - ab * ab) * inverse;
    const double bends = (b * b * squared_bx + a * a * squared_ay) * inverse * off;
    const double lambda = off * (0.5 + bends * (0.375 + 0.25 * bends));  // over a² b²
    constexpr double small = 0.3;
    if (!(a * a * std::abs(lambda) < small && std::abs(bends) < 2 * small)) return std::nullopt;
    return towards(bx * (1 + a * a * lambda), ay * (1 + b * b * lambda));
  }

  /// One step, not of unit length, and whether that is all.
  struct Step {
    double c, s;
    bool is_last;
  };
  /// Turns t by the angle whose tangent τ solves τ dot − cross + 3/2 p τ² + m/2 τ³ = 0 (Newton: the
  /// first two terms; Householder's third method), p = focal s c, m = focal (c² − s²).
  Step step(const Anomaly& t, double c, double s) const {
    const double cross = t.c * s - t.s * c, dot = t.c * c + t.s * s, turn = std::abs(cross);
    const double bend = 3 * focal * (t.s * t.c) * cross, smaller = std::min(t.c, t.s);
    const auto is_within = [&](double part) {
      return (turn <= part * smaller * dot) & (std::abs(bend) <= part * (dot * dot));
    };
    constexpr double near = 0.3, last = 3e-4;
    const bool is_near = is_within(near);
    const double ahead = is_near ? 2 * dot * dot + bend : 1;
    const double rest =
        is_near ? bend * dot + focal * (t.c * t.c - t.s * t.s) * (cross * cross) : 0;
    // Of a flat ellipse the normal depends on the smaller one's digits. Where two normals nearly
    // coincide, steps become small only one by one.
    constexpr double small_step = 1e-8, small_part = 2e-7, part_that_squared_is_small = 1e-4;
    const double small =
        std::max(small_part * smaller, std::min(small_step, part_that_squared_is_small * smaller));
    return {ahead * c + rest * t.c, ahead * s + rest * t.s, is_within(last) || turn < small * dot};
  }

  /// The foot on the point's own side, or, y <= 0, across the major axis the one further from it:
  /// the smaller c, if there is one. Not of unit length.
  std::optional<Anomaly> foot() const {
    const bool same_side = by > 0;
    if (!same_side && !(ax - by < focal)) return std::nullopt;
    Anomaly t = same_side ? same_side_start() : with_cosine(ax / focal);
    const int max_steps = same_side ? 8 : 60;
    for (int i = 0; i < max_steps; ++i) {
      const double c = along(t), s = by + focal * (t.s * t.s * t.s);
      if (!same_side && !(c > 0 && s > 0)) return std::nullopt;
      const Step next = step(t, std::max(c, 0.0), s);
      if (next.is_last) return Anomaly{next.c, next.s};
      t = towards(next.c, next.s);
    }
    return t;
  }
};

/// A half axis that is so small a part of the other is none: their products would vanish.
constexpr double flat = 1e-60;

}  // namespace

std::optional<Vec2> ellipse_normal(double a, double b, double x, double y) {
  if (!(x >= 0)) return std::nullopt;
  if (b < flat * a) b = 0;
  if (y > 0 && !(b * y > 0)) {
    // Seen edge on, the ellipse is its major axis: its inside, or its end.
    if (!(x > a)) return Vec2(0, 1);
    const Anomaly n = towards(x - a, y);
    return Vec2(n.c, n.s);
  }
  const ScaledPoint p{a, b, x, y};
  if (x == 0) {
    if (!(-p.by < p.focal)) return std::nullopt;
    return Vec2(0, 1);
  }
  const auto foot = p.foot();
  if (!foot) return std::nullopt;
  // The normal at (a c, b s) is along (b c, a s).
  const Anomaly n = towards(b / a * foot->c, foot->s);
  return Vec2(n.c, n.s);
}

// W(θ) = x cos θ + y sin θ − √(…) + depth has W'' + W = depth − ρ with the ellipse's radius of
// curvature ρ = a² b² / h³, which grows with θ; h is the root. Where ρ >= depth, W is at most the
// sinusoid with its value and slope at any m; where ρ <= depth, at most its values at both ends.
double ellipse_excess(double a, double b, double x, double y, const std::optional<Vec2>& n,
                      double depth, const NormalArc& arc) {
  const double rounding = 16 * unit_roundoff * (x + std::abs(y) + a + std::abs(depth));
  if (is_beyond_evolute(a, b, x, y)) return rounding;
  const auto is_before = [](const Vec2& m, const Vec2& other) { return cross2(m, other) > 0; };
  if (b < flat * a) {  // a segment, whose end counts: a sinusoid of the angle
    const Vec2 top(x - a, y);
    const bool is_on_arc = top.x() > 0 && top.y() > 0 && !is_before(top, arc.first) &&
                           !(arc.last && is_before(*arc.last, top));
    const double gap = is_on_arc ? top.norm() : arc.last ? -depth : y;
    return std::max(0.0, gap + depth) + rounding;
  }
  const double focal = (a - b) * (a + b), squared = a * b * (a * b);
  const auto reach = [&](const Vec2& m) {
    return std::sqrt(a * m.x() * (a * m.x()) + b * m.y() * (b * m.y()));
  };
  const auto slope = [&](const Vec2& m, double h) {
    return y * m.x() - x * m.y() + focal * m.x() * m.y() / h;
  };
  // Where W falls so steeply at the first normal, it stays below zero whatever ρ is.
  const double h_first = reach(arc.first), falling = slope(arc.first, h_first);
  if (falling + std::max(0.0, depth - squared / (h_first * h_first * h_first)) <= 0) {
    return rounding;
  }
  const auto above_best = [&](const Vec2& m, double h) {
    return x * m.x() + y * m.y() - h + depth;
  };
  // The most of the sinusoid with this value, not above zero, and slope at m on the way to an end.
  const auto risen = [](const Vec2& m, double value, double up, const Vec2& end) {
    return std::max(0.0, m.dot(end) * value + std::abs(cross2(m, end)) * std::max(0.0, up));
  };
  const Vec2 last = arc.last.value_or(Vec2(0, 1));
  if (n) {
    const bool is_early = is_before(*n, arc.first), is_late = arc.last && is_before(*arc.last, *n);
    const Vec2& m = is_early ? arc.first : is_late ? *arc.last : *n;
    const double h = reach(m), cube = h * h * h, room = squared - depth * cube;  // (ρ − depth) h³
    if (room > 0) {
      const double up = slope(m, h);
      if (is_early || is_late) {  // m was tried
        const double value = std::min(0.0, above_best(m, h));
        return risen(m, value, is_early ? up : -up, is_early ? last : arc.first) + rounding;
      }
      if (std::abs(up) <= rounding) return 2 * rounding;
      // On an arc before m at least half of ρ − depth is left: ρ falls by no more than the part
      // 3 (a² − b²) m_y / h² of itself per radian.
      const double steepest = std::abs(up) + rounding, rest = room / (2 * squared);  // of ρ
      const double fall = 3 * focal * m.y(), needed = steepest * cube * fall;
      constexpr double wide = 1.5, chord = 0.45;  // sin(w / 2) >= 0.45 w
      const bool is_held = chord * squared * rest * std::min(wide * fall, rest * h * h) > needed;
      return (is_held ? steepest * steepest * cube / room : steepest) + rounding;
    }
  }
  // Where ρ is the depth but for rounding, or the end of the arc that is next to there.
  const double h = depth > 0 ? std::min(a, std::cbrt(squared / depth)) : a;
  const double cosine = h > b ? std::sqrt((h - b) * (h + b) / focal) : 0;
  const Vec2 even(cosine, std::sqrt(std::max(0.0, (1 - cosine) * (1 + cosine))));
  const double all_rounding = rounding + 24 * unit_roundoff * std::abs(depth);
  if (arc.last && is_before(*arc.last, even)) return all_rounding;
  const Vec2& m = is_before(even, arc.first) ? arc.first : even;
  const double h_there = reach(m), value = above_best(m, h_there);
  return std::max(0.0, value) + risen(m, std::min(0.0, value), slope(m, h_there), last) +
         all_rounding;
}

}  // namespace touchstone
