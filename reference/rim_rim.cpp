#include "rim_rim.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace touchstone {
namespace {

/// A point of rim 1 with the point of rim 2 that is nearest (side +1) or farthest (−1).
struct Sample {
  double slope;      ///< derivative of half the squared distance along rim 1, over radius 1
  double curvature;  ///< derivative of the slope
  Vec3 apart;        ///< point of rim 1 − point of rim 2
  Vec3 radial1, tangent1, tangent2;
};

class Rims {
 public:
  Rims(const ReducedPair& pair, const Vec3& q)
      : q_(q),
        axis2_(pair.discs[1].axis),
        radius1_(pair.discs[0].radius),
        radius2_(pair.discs[1].radius) {
    const Vec3& axis1 = pair.discs[0].axis;
    e_ = axis1.unitOrthogonal();
    f_ = axis1.cross(e_);
  }

  Sample at(double cosine, double sine, double side) const {
    Sample sample;
    sample.radial1 = cosine * e_ + sine * f_;
    sample.tangent1 = cosine * f_ - sine * e_;
    const Vec3 w = radius1_ * sample.radial1 - q_;
    Vec3 across = w - w.dot(axis2_) * axis2_;
    const double length = across.norm();
    across = length > 0 ? Vec3(across / length) : e_;
    sample.tangent2 = axis2_.cross(across);
    sample.apart = w - (side * radius2_) * across;
    sample.slope = sample.apart.dot(sample.tangent1);
    // Rim 2's point moves by radius1 · radius2 / |w⊥| times the part of tangent1 along tangent2.
    const double follow = sample.tangent1.dot(sample.tangent2);
    const double moved = length > 0 ? side * radius2_ * follow * follow / length : 0;
    sample.curvature = radius1_ * (1 - moved) - sample.apart.dot(sample.radial1);
    return sample;
  }
  Sample at(double angle, double side) const { return at(std::cos(angle), std::sin(angle), side); }

  double radius1() const { return radius1_; }

 private:
  Vec3 q_, axis2_, e_, f_;
  double radius1_, radius2_;
};

constexpr int samples = 64;
constexpr double step = 2 * std::numbers::pi / samples;

struct Circle {
  std::array<double, samples + 1> cosine, sine;
};

const Circle& sampled_circle() {
  static const Circle circle = [] {
    Circle c;
    for (int i = 0; i <= samples; ++i) {
      c.cosine[i] = std::cos(i * step);
      c.sine[i] = std::sin(i * step);
    }
    return c;
  }();
  return circle;
}

/// Bisection with regula falsi (Illinois), at most 60 steps.
double root_between(const Rims& rims, double side, double lo, double slope_lo, double hi,
                    double slope_hi) {
  double angle = lo;
  for (int i = 0; i < 60 && hi - lo > 1e-15; ++i) {
    angle = i % 8 == 7 ? (lo + hi) / 2 : (lo * slope_hi - hi * slope_lo) / (slope_hi - slope_lo);
    if (!(angle > lo && angle < hi)) angle = (lo + hi) / 2;
    const double slope = rims.at(angle, side).slope;
    if (slope == 0) break;
    if ((slope < 0) == (slope_lo < 0)) {
      lo = angle;
      slope_lo = slope;
      slope_hi /= 2;
    } else {
      hi = angle;
      slope_hi = slope;
      slope_lo /= 2;
    }
  }
  return angle;
}

void offer(const ReducedPair& pair, const Sample& sample, BestNormal& best) {
  // Where the rims nearly touch their difference is noise, where tangents are parallel their
  // product.
  offer_normal(pair, sample.apart, best);
  offer_normal(pair, sample.tangent1.cross(sample.tangent2), best);
}

/// The slope keeps its sign but turns towards zero and away again in between: two roots may hide
/// there.
bool turns_back(const Sample& x, const Sample& y) {
  const double sign = x.slope < 0 ? -1 : 1;
  return sign * x.curvature < 0 && sign * y.curvature > 0;
}

/// Bisects the curvature for the turn, and where the slope has the other sign on the way, finds the
/// roots on both sides. At most 24 steps; a double root is met to rounding.
void offer_close_roots(const ReducedPair& pair, const Rims& rims, double side, double lo, double hi,
                       BestNormal& best) {
  const double start = lo, end = hi;
  const double slope_start = rims.at(start, side).slope, slope_end = rims.at(end, side).slope;
  const double sign = slope_start < 0 ? -1 : 1;
  for (int i = 0; i < 24; ++i) {
    const double middle = (lo + hi) / 2;
    const Sample sample = rims.at(middle, side);
    if (sign * sample.slope < 0) {
      offer(pair, rims.at(root_between(rims, side, start, slope_start, middle, sample.slope), side),
            best);
      offer(pair, rims.at(root_between(rims, side, middle, sample.slope, end, slope_end), side),
            best);
      return;
    }
    (sign * sample.curvature < 0 ? lo : hi) = middle;
  }
  offer(pair, rims.at((lo + hi) / 2, side), best);
}

/// Inside, rim 1's point is in contact along +apart and the gap minus the distance. Where that
/// holds on the whole arc and the arc stays further away than the best depth, it has nothing to
/// offer. The distance changes by at most radius 1 per radian.
bool stays_too_deep(const Sample& x, const Sample& y, double reach, double best_depth) {
  const double distance_x = x.apart.norm(), distance_y = y.apart.norm();
  return x.apart.dot(x.radial1) > reach && y.apart.dot(y.radial1) > reach &&
         std::min(distance_x, distance_y) - reach / 2 > best_depth;
}

}  // namespace

void offer_rim_rim_normals(const ReducedPair& pair, const Vec3& q, BestNormal& best) {
  const Rims rims(pair, q);
  const Circle& circle = sampled_circle();
  const double reach = rims.radius1() * step;
  for (const double side : {1.0, -1.0}) {
    // Rim 2's far side is in contact only beyond the depth of its radius.
    if (side < 0 && -best.gap <= pair.discs[1].radius) continue;
    Sample previous = rims.at(circle.cosine[0], circle.sine[0], side);
    for (int i = 1; i <= samples; ++i) {
      const Sample next = rims.at(circle.cosine[i], circle.sine[i], side);
      const double angle = i * step;
      if (!stays_too_deep(previous, next, reach, -best.gap)) {
        if ((previous.slope < 0) != (next.slope < 0)) {
          offer(pair,
                rims.at(root_between(rims, side, angle - step, previous.slope, angle, next.slope),
                        side),
                best);
        } else if (turns_back(previous, next)) {
          offer_close_roots(pair, rims, side, angle - step, angle, best);
        }
      }
      previous = next;
    }
  }
}

}  // namespace touchstone
