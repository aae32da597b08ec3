// Critical directions with closed forms: the rational ones, and a rim against a vertex, which needs
// one square root.
#include <algorithm>
#include <utility>

#include "oracle/critical_direction.hpp"
#include "oracle/real_roots.hpp"

namespace touchstone::oracle {
namespace {

/// From the nearest point of a rim (about the origin) to a vertex q: n = q − radius · q⊥/|q⊥|.
class RimVertexDirection : public CriticalDirection {
 public:
  RimVertexDirection(IntegerVector q, unsigned signs, const Integer& radius_times_norm,
                     IntegerVector across)
      : q_(std::move(q)), signs_(signs), radius_(radius_times_norm), across_(std::move(across)) {}

  void enclose(const Difference& difference, const BallDifference& balls,
               std::vector<DirectionBound>& out) override {
    const BallVector n = direction();
    // Outside the rim no direction is zero, although its ball may contain zero at this precision.
    if (at_vertex(difference, signs_, n) != Side::no) out.push_back({balls.gap(n), n});
  }

  // |n| = inflation, that is |q|² + radius² − inflation² = 2 radius |q⊥|.
  ZeroGap zero_gap(const Difference& difference) override {
    const Integer inflation = difference.inflation * difference.norm;
    const Integer rest = dot(q_, q_) + radius_ * radius_ - inflation * inflation;
    const Integer norm_squared = difference.norm * difference.norm;
    if (rest < 0 || rest * rest * norm_squared * norm_squared !=
                        4 * radius_ * radius_ * dot(across_, across_)) {
      return ZeroGap::unknown;
    }
    return at_vertex(difference, signs_, direction()) == Side::yes ? ZeroGap::zero
                                                                   : ZeroGap::at_most_zero;
  }

  // n·v = q·v − radius (across·v) / |across|
  bool is_across(const IntegerVector& v) const override {
    const Integer whole = dot(q_, v), part = radius_ * dot(across_, v);
    return sgn(whole) == sgn(part) && whole * whole * dot(across_, across_) == part * part;
  }

 private:
  BallVector direction() const {
    const BallVector across = to_balls(across_);
    return to_balls(q_) - (Ball(radius_) / norm(across)) * across;
  }

  IntegerVector q_;
  unsigned signs_;
  Integer radius_;
  IntegerVector across_;  // norm² q⊥, not zero
};

}  // namespace

void append_disc_axis(const Difference& difference, const CriticalSite& site,
                      CriticalDirections& out) {
  out.push_back(rational_direction(difference.discs[site.first].frame.axis));
}

void append_crossing(const Difference& difference, const CriticalSite& site,
                     CriticalDirections& out) {
  out.push_back(rational_direction(cross(difference.segments[site.first].frame.axis,
                                         difference.segments[site.second].frame.axis)));
}

void append_radial(const Difference& difference, const CriticalSite& site,
                   CriticalDirections& out) {
  const auto& segment = difference.segments[site.first];
  const IntegerVector n = off_axis(reduced_point(difference, site.signs, &segment), segment.frame);
  if (!is_zero(n)) {
    out.push_back(rational_direction(n));
    return;
  }
  // The vertex lies on the axis: all radial directions of its sector have the same gap. The sector
  // may be a single direction, or empty.
  DirectionFamily family =
      sector(segment.frame.axis, signed_axes(difference, site.signs, &segment));
  if (family.kind == NormalFamily::Kind::circle) {
    out.push_back(rational_direction(segment.frame.e, std::move(family)));
  } else if (!family.ends.empty()) {
    const IntegerVector end = family.ends.front();
    out.push_back(rational_direction(end, std::move(family)));
  }
}

void append_rim_vertex(const Difference& difference, const CriticalSite& site,
                       CriticalDirections& out) {
  const auto& disc = difference.discs.front();
  const Integer radius = disc.radius * difference.norm;
  const IntegerVector q = reduced_point(difference, site.signs);
  IntegerVector across = off_axis(q, disc.frame);
  // across is norm² q⊥.
  const Integer reach = difference.norm * difference.norm * radius;
  const int beyond = cmp(dot(across, across), reach * reach);
  if (beyond == 0 && dot(q, disc.frame.axis) == 0) {
    // The vertex lies on the rim: all normals of that rim point have the gap −inflation.
    std::vector<IntegerVector> inward = signed_axes(difference, site.signs);
    inward.push_back(across);
    DirectionFamily arc = sector(cross(disc.frame.axis, across), inward);
    if (arc.ends.empty()) return;
    const IntegerVector end = arc.ends.front();
    out.push_back(rational_direction(end, std::move(arc)));
  }
  // Only a vertex outside the rim is a separate maximum.
  if (beyond <= 0) return;
  out.push_back(std::make_unique<RimVertexDirection>(q, site.signs, radius, std::move(across)));
}

}  // namespace touchstone::oracle
