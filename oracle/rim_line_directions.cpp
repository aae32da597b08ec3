// A rim against a side or an edge: directions across a line, in whose projection the disc is an
// ellipse and everything else a point or a disc. The nearest point of an ellipse is a root of a
// quartic; Ericson, "Real-Time Collision Detection"; Eberly, "Distance from a Point to an Ellipse".
//
// With n = e + t f for an orthonormal e, f across the line, n' = f − t e, the disc's unit axis u
// and the reduced point q, the gap is stationary where
//
//   (q·n')² (n·n − (u·n)²) = radius² (u·n)² (u·n')².
#include <utility>

#include "oracle/critical_direction.hpp"
#include "oracle/real_roots.hpp"

namespace touchstone::oracle {
namespace {

class RimLineDirection : public CriticalDirection {
 public:
  RimLineDirection(const Frame& line, RealRoot t) : line_(line), t_(std::move(t)) {}

  void enclose(const BallDifference& difference, std::vector<DirectionBound>& out) override {
    append_bounds(difference, to_balls(line_.e) + t_.enclose() * to_balls(line_.f), out);
  }

 private:
  Frame line_;
  RealRoot t_;
};

/// t = ∞: a root where the degree drops, and harmless elsewhere.
class RimLineEnd : public CriticalDirection {
 public:
  explicit RimLineEnd(IntegerVector n) : n_(std::move(n)) {}
  void enclose(const BallDifference& difference, std::vector<DirectionBound>& out) override {
    append_bounds(difference, to_balls(n_), out);
  }

 private:
  IntegerVector n_;
};

// Scaled: q by norm², u·n by norm², both sides by norm⁴ · norm⁴.
Polynomial stationary_quartic(const Difference& difference, const Frame& line,
                              const Difference::Disc& disc, const IntegerVector& q) {
  const Integer q_e = dot(q, line.e), q_f = dot(q, line.f);
  const Integer u_e = dot(disc.frame.axis, line.e), u_f = dot(disc.frame.axis, line.f);
  const Integer norm_squared = difference.norm * difference.norm;
  const Integer norm_fourth = norm_squared * norm_squared;

  const Polynomial q_slope{q_f, Integer(-q_e)};
  const Polynomial u_n{u_e, u_f};
  const Polynomial u_slope{u_f, Integer(-u_e)};
  const Polynomial n_n{norm_fourth, 0, norm_fourth};
  const Polynomial u_part = u_n * u_n;
  return q_slope * q_slope * (n_n - u_part) -
         Integer(disc.radius * disc.radius) * (u_part * (u_slope * u_slope));
}

}  // namespace

void add_rim_line_directions(const Difference& difference, CriticalDirections& out) {
  const auto& segments = difference.segments;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const Frame& line = segments[i].frame;
    for (const auto& disc : difference.discs) {
      const IntegerVector tilt = cross(line.axis, disc.frame.axis);
      if (tilt.x == 0 && tilt.y == 0 && tilt.z == 0) continue;
      out.push_back(std::make_unique<RimLineEnd>(line.f));
      for (unsigned signs = 0; signs < 1U << segments.size(); ++signs) {
        if (signs >> i & 1U) continue;
        const IntegerVector q = reduced_point(difference, signs, &segments[i]);
        const Polynomial quartic = stationary_quartic(difference, line, disc, q);
        // The gap is then constant between its kinks, which are axial directions.
        if (is_zero(quartic)) continue;
        for (auto& root : real_roots(quartic)) {
          out.push_back(std::make_unique<RimLineDirection>(line, std::move(root)));
        }
      }
    }
  }
}

}  // namespace touchstone::oracle
