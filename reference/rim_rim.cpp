#include "rim_rim.hpp"

#include <algorithm>
#include <cmath>

namespace touchstone {
namespace {

class Scan {
 public:
  Scan(const FoldedCylinders& pair, const Rims& rims, double& limit, double least_depth,
       LargestGap& best)
      : pair_(pair),
        rims_(rims),
        limit_(limit),
        least_depth_(least_depth),
        best_(best),
        noise_(rims.noise()) {}

  /// The arc of half the rim that can matter, and a little more, because roots at its ends must lie
  /// inside.
  void useful_arc() {
    constexpr double beyond = 0.02;
    const auto [from, to] = rims_.useful_arc(std::max(0.0, -best_.gap), limit_);
    if (!(from <= to)) return;
    arc(at(from - beyond), at(to + beyond));
  }
  /// Begins with a good bound: the rims' stationary normal near n, and the points that it leads to.
  void guess(const Vec3& n) {
    const Vec3 better = rims_.polished(n).normalized();
    if (!(better.z() >= 0)) return;
    best_.offer(pair_.gap(better), better);
    at(std::atan2(better.z(), better.y()));
  }

 private:
  static constexpr double coarse = 0.5;   // rad; longer arcs are always halved
  static constexpr double finest = 1e-7;  // rad; shorter ones never
  static constexpr int most_samples = 400;

  RimSample at(double angle) {
    ++samples_;
    RimSample sample = rims_.at(angle);
    limit_ = std::min(limit_, sample.distance);
    return sample;
  }

  /// The distance changes by at most radius 1 per radian. Further away than the depth, or than the
  /// bodies can be apart, no point of the arc is in contact.
  /// Nor nearer than the depth is at least: those points lie within the sum.
  bool useless(const RimSample& x, const RimSample& y) const {
    const double middle = (x.distance + y.distance) / 2;
    const double reach = rims_.radius1() * (y.angle - x.angle) / 2;
    return middle - reach > std::max(limit_, -best_.gap) || middle + reach < least_depth_;
  }

  void arc(const RimSample& x, const RimSample& y) {
    if (useless(x, y)) return;
    const double width = y.angle - x.angle;
    const RimSample middle = at(x.angle + width / 2);
    if (width > coarse || (!even(x, middle, y) && width > finest && samples_ < most_samples)) {
      arc(x, middle);
      arc(middle, y);
    } else {
      roots(x, middle);
      roots(middle, y);
    }
  }

  /// Whether the cubic through the ends (Hermite) foretells the middle so well that it can be
  /// trusted between them, and shows no root or a single one that it crosses steadily.
  bool even(const RimSample& x, const RimSample& middle, const RimSample& y) const {
    constexpr double trust = 0.1;
    // s + t u + a u² + b u³ for u in [0, 1]
    const double width = y.angle - x.angle;
    const double s = x.slope, t = width * x.curvature, t_end = width * y.curvature;
    const double a = 3 * (y.slope - s) - 2 * t - t_end, b = 2 * (s - y.slope) + t + t_end;
    const auto cubic = [&](double u) { return s + u * (t + u * (a + u * b)); };
    // Flat to rounding, as where bodies are concentric: there is nothing to find.
    if (std::max({std::abs(s), std::abs(y.slope), std::abs(middle.slope)}) <= noise_) return true;
    const double error = std::max(std::abs(middle.slope - cubic(0.5)) - noise_, 0.0);
    const auto same_sign = [](double p, double q) { return (p < 0) == (q < 0); };

    const double vertex = b != 0 ? -a / (3 * b) : -1;  // of its derivative t + 2 a u + 3 b u²
    const bool turns = vertex > 0 && vertex < 1;
    const double discriminant = a * a - 3 * b * t;
    if (same_sign(t, t_end) && (!turns || same_sign(t, t + vertex * a))) {
      if (same_sign(s, y.slope)) return error <= trust * std::min(std::abs(s), std::abs(y.slope));
      double steady = std::min(std::abs(t), std::abs(t_end));
      if (turns) steady = std::min(steady, std::abs(t + vertex * a));
      // An error e at the middle means up to 3.1 e in the derivative, off the middle.
      return 4 * error <= trust * steady;
    }
    double least = std::min(std::abs(s), std::abs(y.slope));
    if (!same_sign(s, y.slope)) return false;
    const double root = std::sqrt(std::max(discriminant, 0.0));
    for (const double sign : {1.0, -1.0}) {
      // The derivative's roots, without cancellation.
      const double sum = -(a + std::copysign(root, a));
      const double u = sign > 0 ? sum / (3 * b) : t / sum;
      if (!(u > 0 && u < 1)) continue;
      if (!same_sign(cubic(u), s)) return false;
      least = std::min(least, std::abs(cubic(u)));
    }
    return error <= trust * least;
  }

  void roots(const RimSample& x, const RimSample& y) {
    if (useless(x, y)) return;
    // Only where the distance has a minimum can the sum's surface be nearest to d.
    if (x.slope < 0 && y.slope >= 0) {
      offer(root(x, y));
    } else if ((x.slope < 0) == (y.slope < 0) && turns_back(x, y)) {
      close_roots(x, y);
    }
  }

  /// Newton kept inside the bracket; at most 50 steps. What is left is for `polished`.
  RimSample root(const RimSample& x, const RimSample& y) {
    double lo = x.angle, hi = y.angle;
    double angle = (lo * y.slope - hi * x.slope) / (y.slope - x.slope);
    if (!(angle > lo && angle < hi)) angle = (lo + hi) / 2;
    double previous = hi - lo;
    for (int i = 0;; ++i) {
      RimSample sample = at(angle);
      if (sample.slope == 0 || i == 50) return sample;
      ((sample.slope < 0) == (x.slope < 0) ? lo : hi) = angle;
      double next = angle - sample.slope / sample.curvature;
      if (!(next > lo && next < hi) || std::abs(next - angle) > previous / 2) {
        next = (lo + hi) / 2;
      }
      previous = std::abs(next - angle);
      if (previous <= 1e-9 || next == lo || next == hi) return sample;
      angle = next;
    }
  }

  /// The slope keeps its sign but turns towards zero and away again in between, and its tangents
  /// meet beyond zero: two roots may hide there.
  static bool turns_back(const RimSample& x, const RimSample& y) {
    const double sign = x.slope < 0 ? -1 : 1;
    const double fall = -sign * x.curvature, rise = sign * y.curvature;
    if (!(fall > 0 && rise > 0)) return false;
    const double width = y.angle - x.angle;
    const double meet = (sign * (x.slope - y.slope) + rise * width) / (fall + rise);
    return sign * x.slope - fall * meet <= 0;
  }

  /// Bisects the curvature for the turn, and where the slope has the other sign on the way, finds
  /// the roots on both sides. At most 24 steps; a double root is met to rounding.
  void close_roots(const RimSample& x, const RimSample& y) {
    const double sign = x.slope < 0 ? -1 : 1;
    RimSample lo = x, hi = y;
    for (int i = 0; i < 24; ++i) {
      const RimSample middle = at((lo.angle + hi.angle) / 2);
      if (sign * middle.slope < 0) {
        offer(root(lo, middle));
        offer(root(middle, hi));
        return;
      }
      (sign * middle.curvature < 0 ? lo : hi) = middle;
      if (!turns_back(lo, hi)) return;
    }
    offer(lo);
  }

  void offer(const RimSample& x) {
    // Where the rims nearly touch their difference is noise, where tangents are parallel their
    // product.
    const double c = pair_.axes.c, s = pair_.axes.s;
    offer(x.apart);
    offer(Vec3(c * x.cos1 * x.sin2 - x.sin1 * x.cos2, s * x.cos1 * x.sin2, s * x.sin1 * x.sin2));
  }

  void offer(Vec3 n) {
    const double length = n.norm();
    if (!(length > 0)) return;
    // Of ±n the one towards A has the larger gap, and of mirror images the one on A's side of the
    // plane of the axes. Rims that overlap by a hair show the other.
    if (n.dot(pair_.axes.d()) < 0) n = -n;
    n.z() = std::abs(n.z());
    n /= length;
    best_.offer(pair_.gap(n), n);
    const Vec3 better = rims_.polished(n).normalized();
    best_.offer(pair_.gap(better), better);
  }

  const FoldedCylinders& pair_;
  const Rims& rims_;
  double& limit_;
  double least_depth_;
  LargestGap& best_;
  double noise_;
  int samples_ = 0;
};

/// The largest balls within a cylinder are as wide as it; their centres fill a segment or a disc.
/// How far two such balls, near each other, overlap: the bodies do so no less. Negative if they do
/// not.
double overlap_of_balls(const FoldedCylinders& pair) {
  const FoldedAxes& f = pair.axes;
  const Vec3 u1(1, 0, 0), u2(f.c, f.s, 0);
  const auto nearest_centre = [](const Vec3& u, double r, double h, const Vec3& x) -> Vec3 {
    const double along = x.dot(u);
    if (h >= r) return std::clamp(along, r - h, h - r) * u;
    const Vec3 across = x - along * u;
    const double length = across.norm();
    return length > r - h ? Vec3((r - h) / length * across) : across;
  };
  Vec3 x = f.d();  // A's ball, about B's centre
  Vec3 y = Vec3::Zero();
  constexpr int rounds = 3;
  for (int i = 0; i < rounds; ++i) {
    y = nearest_centre(u2, pair.r2, pair.h2, x);
    x = f.d() + nearest_centre(u1, pair.r1, pair.h1, y - f.d());
  }
  return std::min(pair.r1, pair.h1) + std::min(pair.r2, pair.h2) - (x - y).norm();
}

/// With parallel axes the sum of two cylinders is a cylinder; its rim has this normal.
void offer_parallel_rim_normal(const FoldedCylinders& pair, LargestGap& best) {
  const FoldedAxes& f = pair.axes;
  const double beyond_cap = std::abs(f.d1) - pair.h1 - pair.h2;
  const double radial = std::sqrt(f.d2 * f.d2 + f.d3 * f.d3);
  const double beyond_side = radial - pair.r1 - pair.r2;
  if (!(beyond_cap > 0 && beyond_side > 0)) return;
  const Vec3 n = Vec3(std::copysign(beyond_cap, f.d1), beyond_side * f.d2 / radial,
                      beyond_side * f.d3 / radial)
                     .normalized();
  best.offer(pair.gap(n), n);
}

}  // namespace

void offer_rim_rim_normals(const FoldedCylinders& pair, const Vec3& apart, double enough,
                           LargestGap& best) {
  // Tilts that only rounding makes cost no more than rounding.
  constexpr double parallel = 2e-16;
  offer_parallel_rim_normal(pair, best);
  if (pair.axes.s <= parallel) return;
  const double rounding = 2e-16 * (pair.axes.d().norm() + pair.h1 + pair.h2 + pair.r1 + pair.r2);
  const double least_depth = overlap_of_balls(pair) - rounding;
  if (-best.gap <= least_depth) return;

  double limit = apart.norm();  // of points of both bodies: they are not further apart
  const Vec3 likely = limit > 0 ? Vec3(apart / limit) : best.normal;
  const double likely1 = likely.x() < 0 ? -1 : 1;
  const double likely2 = pair.axes.along_u2(likely) < 0 ? -1 : 1;
  for (int other = 0; other < 4; ++other) {
    const Rims rims(pair, (other & 1) ? -likely1 : likely1, (other & 2) ? -likely2 : likely2);
    if (!rims.may_meet(std::max(0.0, -best.gap), limit)) continue;
    Scan scan(pair, rims, limit, least_depth, best);
    // Apart by the gap, with points no further apart: nothing is better.
    const auto done = [&] { return best.gap > enough || best.gap >= limit - rounding; };
    if (other == 0) scan.guess(likely);
    if (done()) return;
    scan.useful_arc();
    if (done()) return;
  }
}

}  // namespace touchstone
