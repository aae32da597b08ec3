// Directions with rational coordinates, and the functions that all kinds of directions use.
#include "oracle/critical_direction.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "oracle/real_roots.hpp"

namespace touchstone::oracle {
namespace {

/// Is the gap along n exactly zero? All terms are multiplied by norm.
bool gap_is_zero(const Difference& difference, const IntegerVector& n) {
  Integer a = dot(difference.d, n);
  for (const auto& s : difference.segments) a -= s.half_length * abs(dot(s.frame.axis, n));
  std::vector<Integer> squares;
  for (const auto& disc : difference.discs) {
    const IntegerVector across = cross(disc.frame.axis, n);
    squares.push_back(disc.radius * disc.radius * dot(across, across));
  }
  squares.push_back(difference.inflation * difference.inflation * difference.norm *
                    difference.norm * dot(n, n));
  // With two discs the inflation is zero, so that at most two squares remain.
  std::erase(squares, 0);
  squares.resize(2);
  return is_root_sum(a, squares[0], squares[1]);
}

/// n, and −n unless it is the single direction of a half-space.
class RationalDirection : public CriticalDirection {
 public:
  RationalDirection(IntegerVector n, std::optional<DirectionFamily> family, bool is_single)
      : n_(std::move(n)), family_(std::move(family)), is_single_(is_single) {}

  void enclose(const Difference&, const BallDifference& balls,
               std::vector<DirectionBound>& out) override {
    const BallVector n = to_balls(n_);
    const auto [centre_distance, half_width] = balls.along(n);
    out.push_back({centre_distance - half_width, n});
    if (!is_single_) out.push_back({-centre_distance - half_width, -n});
  }
  ZeroGap zero_gap(const Difference& difference) override {
    const bool forth = is_single_ || dot(difference.d, n_) >= 0;
    return gap_is_zero(difference, forth ? n_ : -n_) ? ZeroGap::zero : ZeroGap::unknown;
  }
  bool is_across(const IntegerVector& v) override { return dot(n_, v) == 0; }
  std::optional<DirectionFamily> family() const override { return family_; }

 private:
  IntegerVector n_;
  std::optional<DirectionFamily> family_;
  bool is_single_;
};

}  // namespace

TurnedFrame turned_frame(const Frame& frame, double heading) {
  if (heading == 0) return {frame, 1};
  const Integer tangent(std::ldexp(heading, heading_bits));
  const Integer one = Integer(1) << heading_bits;
  const Integer cosine = one * one - tangent * tangent, sine = 2 * one * tangent;
  return {{frame.axis, cosine * frame.e + sine * frame.f, cosine * frame.f - sine * frame.e},
          one * one + tangent * tangent};
}

std::vector<IntegerVector> signed_axes(const Difference& difference, unsigned signs,
                                       const Difference::Segment* skipped) {
  std::vector<IntegerVector> result;
  for (std::size_t i = 0; i < difference.segments.size(); ++i) {
    const auto& segment = difference.segments[i];
    if (&segment == skipped) continue;
    result.push_back((signs >> i & 1U) ? segment.frame.axis : -segment.frame.axis);
  }
  return result;
}

DirectionFamily sector(const IntegerVector& line, const std::vector<IntegerVector>& inward) {
  if (inward.empty()) return {NormalFamily::Kind::circle, line, {}};
  const auto inside = [&](const IntegerVector& n) {
    return std::all_of(inward.begin(), inward.end(),
                       [&](const IntegerVector& v) { return dot(v, n) >= 0; });
  };
  DirectionFamily arc{NormalFamily::Kind::arc, line, {}};
  for (const IntegerVector& border : inward) {
    const IntegerVector end = cross(line, border);
    if (is_zero(end)) continue;
    for (const IntegerVector& n : {end, -end}) {
      const bool known = std::any_of(arc.ends.begin(), arc.ends.end(), [&](const IntegerVector& m) {
        return is_zero(cross(m, n)) && dot(m, n) > 0;
      });
      if (!known && inside(n)) arc.ends.push_back(n);
    }
  }
  if (arc.ends.size() != 2) return {NormalFamily::Kind::arc, line, {}};
  const int turn = sgn(dot(cross(arc.ends[0], arc.ends[1]), line));
  const bool forth = turn == 0 ? inside(cross(line, arc.ends[0])) : turn > 0;
  if (!forth) std::swap(arc.ends[0], arc.ends[1]);
  return arc;
}

std::unique_ptr<CriticalDirection> rational_direction(IntegerVector n,
                                                      std::optional<DirectionFamily> family) {
  return std::make_unique<RationalDirection>(std::move(n), std::move(family), false);
}

Certainty at_vertex(const BallDifference& balls, unsigned signs, const BallVector& n,
                    std::optional<unsigned> skipped) {
  Certainty result = Certainty::yes;
  for (unsigned i = 0; i < balls.segments(); ++i) {
    if (i == skipped) continue;
    const Ball along = dot(balls.axis(i), n);
    const bool positive_side = (signs >> i & 1U) != 0;
    if (positive_side ? along.is_negative() : along.is_positive()) return Certainty::no;
    if (!(positive_side ? along.is_positive() : along.is_negative())) result = Certainty::undecided;
  }
  return result;
}

std::unique_ptr<CriticalDirection> plane_direction(const Difference& difference) {
  return std::make_unique<RationalDirection>(difference.plane_normal, std::nullopt, true);
}

}  // namespace touchstone::oracle
