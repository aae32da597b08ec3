#include "rim_rim.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

namespace touchstone {
namespace {

/// A point of rim 1 with the nearest point of rim 2.
struct Sample {
  double angle;
  double slope;      ///< derivative of half the squared distance along rim 1, over its radius
  double curvature;  ///< derivative of the slope
  double distance;
  Vec3 apart;                     ///< from rim 1's point to rim 2's
  double cos1, sin1, cos2, sin2;  ///< where on the rims, from e2 and k2 to e3
};

/// Rim 1 about the origin and rim 2 about q: their sum's surface is where d lies in contact.
class Rims {
 public:
  Rims(const FoldedCylinders& pair, double end1, double end2)
      : pair_(pair), end1_(end1), end2_(end2) {
    const FoldedAxes& f = pair.axes;
    q_ = f.d() - end1 * pair.h1 * Vec3(1, 0, 0) - end2 * pair.h2 * Vec3(f.c, f.s, 0);
    size_ = pair.r1 + pair.r2 + q_.norm();
  }

  Sample at(double angle) const {
    const double c = pair_.axes.c, s = pair_.axes.s, r1 = pair_.r1, r2 = pair_.r2;
    Sample x;
    x.angle = angle;
    x.cos1 = std::cos(angle);
    x.sin1 = std::sin(angle);
    const double v2 = q_.y() - r1 * x.cos1, v3 = q_.z() - r1 * x.sin1;
    const double height = c * q_.x() + s * v2, k = c * v2 - s * q_.x();
    const double radial = std::sqrt(k * k + v3 * v3);
    x.cos2 = radial > 0 ? k / radial : 1;
    x.sin2 = radial > 0 ? v3 / radial : 0;
    const double beside = radial - r2;
    const double a_k = beside * x.cos2, a3 = beside * x.sin2;
    x.apart = Vec3(c * height - s * a_k, s * height + c * a_k, a3);
    x.distance = std::sqrt(height * height + beside * beside);
    x.slope = x.apart.y() * x.sin1 - a3 * x.cos1;
    // Rim 2's point moves by r1 r2 / radial times the part of rim 1's tangent along its own.
    const double follow = c * x.sin1 * x.sin2 + x.cos1 * x.cos2;
    const double moved = radial > 0 ? r2 * follow * follow / radial : 0;
    x.curvature = r1 * (1 - moved) + (x.apart.y() * x.cos1 + a3 * x.sin1);
    return x;
  }

  /// Can these ends meet at a gap above −depth? A normal has n·u >= 0 towards both ends, and q is a
  /// sum of rim points to within the depth against it. So q lies no further back along an axis than
  /// the other rim reaches and, as the rims' planes cross, no further off.
  bool may_meet(double depth, double limit) const {
    const FoldedAxes& f = pair_.axes;
    const double along1 = end1_ * q_.x(), along2 = end2_ * f.along_u2(q_);
    if (along1 < -(pair_.r2 * f.s + depth) || along2 < -(pair_.r1 * f.s + depth)) return false;
    const double nearest = std::max(
        {along1 - pair_.r2 * f.s, along2 - pair_.r1 * f.s, q_.norm() - pair_.r1 - pair_.r2});
    return nearest <= std::max(limit, depth);
  }

  /// Newton's method for the stationary normal of these ends, in whose neighbourhood
  /// G(n) = q·n − r1 |n − n·u1 u1| − r2 |n − n·u2 u2| is smooth. On the sphere G has the gradient
  /// q − p1 − p2 less its part along n, and the Hessian −(r1/ρ1) t1 t1ᵀ − (r2/ρ2) t2 t2ᵀ − G. The
  /// components of n that are small keep their digits. A step is at most half of n's distance from
  /// an axis, where G has its kinks; few steps are taken but where rims nearly touch along nearly
  /// parallel axes, in a valley that n has to go down by orders of magnitude.
  Vec3 polished(Vec3 n) const {
    const double c = pair_.axes.c, s = pair_.axes.s;
    constexpr int steps = 40;
    for (int i = 0; i < steps; ++i) {
      n /= n.norm();
      const double m = c * n.y() - s * n.x();  // n along k2
      const double rho1 = std::sqrt(n.y() * n.y() + n.z() * n.z());
      const double rho2 = std::sqrt(m * m + n.z() * n.z());
      if (!(rho1 > 0 && rho2 > 0)) break;
      const double k1 = pair_.r1 / rho1, k2 = pair_.r2 / rho2;
      const Vec3 residual(q_.x() + k2 * s * m, q_.y() - k1 * n.y() - k2 * c * m,
                          q_.z() - (k1 + k2) * n.z());
      const double value = residual.dot(n);
      const Vec3 t1 = Vec3(0, -n.z(), n.y()) / rho1;
      const Vec3 other = n.cross(t1);
      const Vec3 t2 = Vec3(s * n.z(), -c * n.z(), m) / rho2;
      const double x = t2.dot(t1), y = t2.dot(other);
      const double a = k1 + k2 * x * x + value, b = k2 * x * y, e = k2 * y * y + value;
      const double determinant = a * e - b * b;
      if (!(a > 0 && determinant > 0)) break;
      const double g1 = residual.dot(t1), g2 = residual.dot(other);
      const double step1 = (e * g1 - b * g2) / determinant;
      const double step2 = (a * g2 - b * g1) / determinant;
      const double length = std::sqrt(step1 * step1 + step2 * step2);
      const double most = std::min(rho1, rho2) / 2;
      const double scale = length > most ? most / length : 1;
      n += scale * step1 * t1 + scale * step2 * other;
      constexpr double small_part = 1e-8;
      if (length <= small_part * most) break;
    }
    return n;
  }

  /// The angles of rim 1 at which the rims may meet. Rim 1's point lies above rim 2's plane by a
  /// height that its angle alone gives, at most the distance of the rims: on the far side of the
  /// plane where the bodies are apart, on the near side where they overlap.
  std::pair<double, double> useful_arc(double depth, double limit) const {
    const double lean = pair_.axes.s * pair_.r1, height = pair_.axes.along_u2(q_);
    const double lowest = end2_ > 0 ? -depth : -limit, highest = end2_ > 0 ? limit : depth;
    const double margin = 4 * noise();
    const double least = (height - highest - margin) / lean;
    const double most = (height - lowest + margin) / lean;
    // Where the ends' cones of normals share only one quarter, that quarter.
    const double from = end1_ != end2_ && end2_ < 0 ? 0.0 : 1.0;
    const double to = end1_ != end2_ && end2_ > 0 ? 0.0 : -1.0;
    const double first = std::min(most, from), last = std::max(least, to);
    if (first < last) return {1, 0};
    return {std::acos(std::max(first, -1.0)), std::acos(std::min(last, 1.0))};
  }

  double radius1() const { return pair_.r1; }
  /// What rounding leaves of a slope.
  double noise() const { return 2e-16 * size_; }

 private:
  const FoldedCylinders& pair_;
  double end1_, end2_;
  Vec3 q_;
  double size_;
};

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

  Sample at(double angle) {
    ++samples_;
    Sample sample = rims_.at(angle);
    limit_ = std::min(limit_, sample.distance);
    return sample;
  }

  /// The distance changes by at most radius 1 per radian. Further away than the depth, or than the
  /// bodies can be apart, no point of the arc is in contact.
  /// Nor nearer than the depth is at least: those points lie within the sum.
  bool useless(const Sample& x, const Sample& y) const {
    const double middle = (x.distance + y.distance) / 2;
    const double reach = rims_.radius1() * (y.angle - x.angle) / 2;
    return middle - reach > std::max(limit_, -best_.gap) || middle + reach < least_depth_;
  }

  void arc(const Sample& x, const Sample& y) {
    if (useless(x, y)) return;
    const double width = y.angle - x.angle;
    const Sample middle = at(x.angle + width / 2);
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
  bool even(const Sample& x, const Sample& middle, const Sample& y) const {
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

  void roots(const Sample& x, const Sample& y) {
    if (useless(x, y)) return;
    // Only where the distance has a minimum can the sum's surface be nearest to d.
    if (x.slope < 0 && y.slope >= 0) {
      offer(root(x, y));
    } else if ((x.slope < 0) == (y.slope < 0) && turns_back(x, y)) {
      close_roots(x, y);
    }
  }

  /// Newton kept inside the bracket; at most 50 steps. What is left is for `polished`.
  Sample root(const Sample& x, const Sample& y) {
    double lo = x.angle, hi = y.angle;
    double angle = (lo * y.slope - hi * x.slope) / (y.slope - x.slope);
    if (!(angle > lo && angle < hi)) angle = (lo + hi) / 2;
    double previous = hi - lo;
    for (int i = 0;; ++i) {
      Sample sample = at(angle);
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
  static bool turns_back(const Sample& x, const Sample& y) {
    const double sign = x.slope < 0 ? -1 : 1;
    const double fall = -sign * x.curvature, rise = sign * y.curvature;
    if (!(fall > 0 && rise > 0)) return false;
    const double width = y.angle - x.angle;
    const double meet = (sign * (x.slope - y.slope) + rise * width) / (fall + rise);
    return sign * x.slope - fall * meet <= 0;
  }

  /// Bisects the curvature for the turn, and where the slope has the other sign on the way, finds
  /// the roots on both sides. At most 24 steps; a double root is met to rounding.
  void close_roots(const Sample& x, const Sample& y) {
    const double sign = x.slope < 0 ? -1 : 1;
    Sample lo = x, hi = y;
    for (int i = 0; i < 24; ++i) {
      const Sample middle = at((lo.angle + hi.angle) / 2);
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

  void offer(const Sample& x) {
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

double FoldedCylinders::gap(const Vec3& n) const {
  const double m = axes.along_k2(n);
  return axes.d().dot(n) - h1 * std::abs(n.x()) - h2 * std::abs(axes.along_u2(n)) -
         r1 * std::sqrt(n.y() * n.y() + n.z() * n.z()) - r2 * std::sqrt(m * m + n.z() * n.z());
}

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
