#include "rim_rim.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace touchstone {
namespace {

/// A point of rim 1 with the point of rim 2 that is nearest (side +1) or farthest (−1).
struct Sample {
  double angle;
  double slope;      ///< derivative of half the squared distance along rim 1, over
                     ///< radius 1
  double curvature;  ///< derivative of the slope
  double distance;
  Vec3 apart;  ///< point of rim 1 − point of rim 2
  Vec3 tangent1, tangent2;
};

/// Below this sine the product of the axes has too few digits left to fold the scan by it.
constexpr double near_parallel = 1e-5;

class Rims {
 public:
  Rims(const ReducedPair& pair, const Vec3& q) : q_(q) {
    const bool swap = pair.discs[0].radius > pair.discs[1].radius;
    const auto& disc1 = pair.discs[swap ? 1 : 0];
    const auto& disc2 = pair.discs[swap ? 0 : 1];
    radius1_ = disc1.radius;
    radius2_ = disc2.radius;
    axis2_ = disc2.axis;
    const Vec3 across = disc1.axis.cross(disc2.axis);
    tilted_ = across.norm() > near_parallel;
    e_ = tilted_ ? Vec3(across.cross(disc1.axis).normalized()) : disc1.axis.unitOrthogonal();
    f_ = disc1.axis.cross(e_);
    if (f_.dot(pair.d) < 0) f_ = -f_;
  }

  Sample at(double angle, double side) const {
    const double cosine = std::cos(angle), sine = std::sin(angle);
    Sample sample;
    sample.angle = angle;
    const Vec3 radial1 = cosine * e_ + sine * f_;
    sample.tangent1 = cosine * f_ - sine * e_;
    const Vec3 w = radius1_ * radial1 - q_;
    Vec3 across = w - w.dot(axis2_) * axis2_;
    const double length = across.norm();
    across = length > 0 ? Vec3(across / length) : e_;
    sample.tangent2 = axis2_.cross(across);
    sample.apart = w - (side * radius2_) * across;
    sample.distance = sample.apart.norm();
    sample.slope = sample.apart.dot(sample.tangent1);
    // Rim 2's point moves by radius1 · radius2 / |w⊥| times the part of tangent1 along tangent2.
    const double follow = sample.tangent1.dot(sample.tangent2);
    const double moved = length > 0 ? side * radius2_ * follow * follow / length : 0;
    sample.curvature = radius1_ * (1 - moved) - sample.apart.dot(radial1);
    return sample;
  }

  double radius1() const { return radius1_; }
  double radius2() const { return radius2_; }
  bool tilted() const { return tilted_; }
  /// What rounding leaves of a slope.
  double noise() const { return 2e-16 * (radius1_ + radius2_ + q_.norm()); }

 private:
  Vec3 q_, axis2_, e_, f_;
  double radius1_, radius2_;
  bool tilted_;
};

class Scan {
 public:
  Scan(const ReducedPair& pair, const Rims& rims, double side, BestNormal& best)
      : pair_(pair), rims_(rims), side_(side), best_(best), noise_(rims.noise()) {}

  void arc(double lo, double hi) { arc(at(lo), at(hi), 0); }

 private:
  static constexpr int coarse_depth = 3;  // halvings that are always made
  static constexpr int finest_depth = 24;
  static constexpr int most_samples = 400;

  Sample at(double angle) {
    ++samples_;
    Sample sample = rims_.at(angle, side_);
    best_.limit = std::min(best_.limit, sample.distance);
    return sample;
  }

  /// The distance changes by at most radius 1 per radian. Further away than the depth, or than the
  /// bodies can be apart, no point of the arc is in contact.
  bool too_far(const Sample& x, const Sample& y) const {
    const double nearest = (x.distance + y.distance - rims_.radius1() * (y.angle - x.angle)) / 2;
    return nearest > std::max(best_.limit, -best_.gap);
  }

  void arc(const Sample& x, const Sample& y, int depth) {
    if (too_far(x, y)) return;
    const double width = y.angle - x.angle;
    const Sample middle = at(x.angle + width / 2);
    if (depth < coarse_depth ||
        (!even(x, middle, y) && depth < finest_depth && samples_ < most_samples)) {
      arc(x, middle, depth + 1);
      arc(middle, y, depth + 1);
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

    const double vertex = b != 0 ? -a / (3 * b) : -1;  // of its derivative
    const double discriminant = a * a - 3 * b * t;
    if (same_sign(t, t_end) && (discriminant < 0 || !(vertex > 0 && vertex < 1))) {
      if (same_sign(s, y.slope)) return error <= trust * std::min(std::abs(s), std::abs(y.slope));
      double steady = std::min(std::abs(t), std::abs(t_end));
      if (vertex > 0 && vertex < 1) steady = std::min(steady, std::abs(t + vertex * a));
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
    if (too_far(x, y)) return;
    if ((x.slope < 0) != (y.slope < 0)) {
      offer(root(x, y));
    } else if (turns_back(x, y)) {
      close_roots(x, y);
    }
  }

  /// Newton kept inside the bracket; at most 50 steps.
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
      if (previous <= 1e-15 || next == lo || next == hi) return sample;
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

  void offer(const Sample& sample) {
    // Where the rims nearly touch their difference is noise, where tangents are parallel their
    // product.
    offer_normal(pair_, sample.apart, best_);
    offer_normal(pair_, sample.tangent1.cross(sample.tangent2), best_);
  }

  const ReducedPair& pair_;
  const Rims& rims_;
  double side_;
  BestNormal& best_;
  double noise_;
  int samples_ = 0;
};

}  // namespace

void offer_rim_rim_normals(const ReducedPair& pair, const Vec3& q, BestNormal& best) {
  const Rims rims(pair, q);
  if (q.norm() - rims.radius1() - rims.radius2() > std::max(best.limit, -best.gap)) return;
  constexpr double pi = std::numbers::pi;
  // The sum is symmetric across the plane of the axes, so the points on d's side are enough; a
  // little more than half of the rim, because roots on the plane itself must lie inside.
  constexpr double beyond = 0.02;
  for (const double side : {1.0, -1.0}) {
    // Rim 2's far side is in contact only beyond the depth of its radius.
    if (side < 0 && -best.gap <= rims.radius2()) continue;
    Scan scan(pair, rims, side, best);
    if (rims.tilted()) {
      scan.arc(-beyond, pi / 2);
      scan.arc(pi / 2, pi + beyond);
    } else {
      for (int quarter = 0; quarter < 4; ++quarter) {
        scan.arc(quarter * pi / 2, (quarter + 1) * pi / 2);
      }
    }
  }
}

}  // namespace touchstone
