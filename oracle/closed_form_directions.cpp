// Critical directions with closed forms: rational ones, and the rim against a vertex with one
// square root.
#include <utility>

#include "oracle/critical_direction.hpp"

namespace touchstone::oracle {
namespace {

bool is_zero(const IntegerVector& v) { return v.x == 0 && v.y == 0 && v.z == 0; }

class RationalDirection : public CriticalDirection {
 public:
  RationalDirection(IntegerVector n, bool of_a_continuum)
      : n_(std::move(n)), of_a_continuum_(of_a_continuum) {}

  void enclose(const BallDifference& difference, std::vector<DirectionBound>& out) override {
    append_bounds(difference, to_balls(n_), out);
  }
  bool of_a_continuum() const override { return of_a_continuum_; }

 private:
  IntegerVector n_;
  bool of_a_continuum_;
};

/// From the nearest point of a rim (about the origin) to a vertex q: n = q − radius · q⊥/|q⊥|.
class RimVertexDirection : public CriticalDirection {
 public:
  RimVertexDirection(IntegerVector q, const Integer& radius_times_norm, IntegerVector across)
      : q_(std::move(q)), radius_(radius_times_norm), across_(std::move(across)) {}

  void enclose(const BallDifference& difference, std::vector<DirectionBound>& out) override {
    const BallVector across = to_balls(across_);
    const Ball length = norm(across);
    append_bounds(difference, to_balls(q_) - (Ball(radius_) / length) * across, out);
  }

 private:
  IntegerVector q_;
  Integer radius_;
  IntegerVector across_;  // along q⊥, not zero
};

}  // namespace

void append_bounds(const BallDifference& difference, const BallVector& n,
                   std::vector<DirectionBound>& out) {
  const Ball length = norm(n);
  if (length.contains_zero()) {
    // No direction yet; with no normal an infinite ball says "refine".
    out.push_back({Ball(1) / Ball(0), std::nullopt});
    return;
  }
  const auto [centre_distance, half_width] = difference.along(n);
  const Ball gap = (abs(centre_distance) - half_width) / length;
  if (!centre_distance.is_negative()) out.push_back({gap, n});
  if (!centre_distance.is_positive()) out.push_back({gap, -n});
}

IntegerVector reduced_point(const Difference& difference, unsigned signs,
                            const Difference::Segment* skipped) {
  IntegerVector q = difference.d;
  for (std::size_t i = 0; i < difference.segments.size(); ++i) {
    const auto& s = difference.segments[i];
    if (&s == skipped) continue;
    const IntegerVector half = s.half_length * s.frame.axis;
    q = (signs >> i & 1U) ? q - half : q + half;
  }
  return q;
}

void add_axial_directions(const Difference& difference, CriticalDirections& out) {
  for (const auto& disc : difference.discs) {
    out.push_back(std::make_unique<RationalDirection>(disc.frame.axis, false));
  }
  const auto& segments = difference.segments;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      out.push_back(std::make_unique<RationalDirection>(
          cross(segments[j].frame.axis, segments[i].frame.axis), false));
    }
  }
}

void add_radial_directions(const Difference& difference, CriticalDirections& out) {
  const auto& disc = difference.discs.front();
  if (difference.discs.size() != 1) return;
  for (const auto& segment : difference.segments) {
    if (!is_zero(cross(segment.frame.axis, disc.frame.axis))) continue;
    const unsigned vertices = 1U << difference.segments.size();
    for (unsigned signs = 0; signs < vertices; ++signs) {
      if (signs >> (&segment - difference.segments.data()) & 1U) continue;
      const IntegerVector q = reduced_point(difference, signs, &segment);
      const auto& frame = segment.frame;
      const IntegerVector across = dot(q, frame.e) * frame.e + dot(q, frame.f) * frame.f;
      // A vertex on the axis: every radial direction of the sector has the same gap. The sector's
      // ends are directions of their own; without other segments it is the full circle.
      const bool on_axis = is_zero(across);
      out.push_back(std::make_unique<RationalDirection>(on_axis ? frame.e : across, on_axis));
    }
  }
}

void add_rim_vertex_directions(const Difference& difference, CriticalDirections& out) {
  if (difference.discs.size() != 1) return;
  const auto& disc = difference.discs.front();
  const auto& frame = disc.frame;
  const Integer radius = disc.radius * difference.norm;
  const Integer norm_squared = difference.norm * difference.norm;
  const unsigned vertices = 1U << difference.segments.size();
  for (unsigned signs = 0; signs < vertices; ++signs) {
    const IntegerVector q = reduced_point(difference, signs);
    const IntegerVector across = dot(q, frame.e) * frame.e + dot(q, frame.f) * frame.f;
    // Only a vertex beyond the rim has a maximum here; across is |norm²| · q⊥. One on the rim
    // touches, and the ends of its fan of normals are directions of their own.
    const Integer reach = norm_squared * radius;
    if (dot(across, across) <= reach * reach) continue;
    out.push_back(std::make_unique<RimVertexDirection>(q, radius, across));
  }
}

}  // namespace touchstone::oracle
