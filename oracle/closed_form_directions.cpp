// Critical directions with closed forms: rational ones, and the rim against a vertex with one
// square root.
#include <algorithm>
#include <utility>

#include "oracle/critical_direction.hpp"
#include "oracle/root_sum.hpp"

namespace touchstone::oracle {
namespace {

/// Is the gap along n exactly zero? Everything times norm.
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
  // Two discs come without inflation.
  std::erase(squares, 0);
  squares.resize(2);
  return is_root_sum(a, squares[0], squares[1]);
}

/// Both ±n.
class RationalDirection : public CriticalDirection {
 public:
  RationalDirection(IntegerVector n, std::optional<DirectionFamily> family)
      : n_(std::move(n)), family_(std::move(family)) {}

  void enclose(const Difference&, const BallDifference& balls,
               std::vector<DirectionBound>& out) override {
    const BallVector n = to_balls(n_);
    const auto [centre_distance, half_width] = balls.along(n);
    const Ball length = norm(n);
    out.push_back({(centre_distance - half_width) / length, n});
    out.push_back({(-centre_distance - half_width) / length, -n});
  }
  ZeroGap zero_gap(const Difference& difference) override {
    const bool forth = dot(difference.d, n_) >= 0;
    return gap_is_zero(difference, forth ? n_ : -n_) ? ZeroGap::zero : ZeroGap::unknown;
  }
  bool is_across(const IntegerVector& v) const override { return dot(n_, v) == 0; }
  std::optional<DirectionFamily> family() const override { return family_; }

 private:
  IntegerVector n_;
  std::optional<DirectionFamily> family_;
};

class PlaneDirection : public CriticalDirection {
 public:
  explicit PlaneDirection(IntegerVector normal) : normal_(std::move(normal)) {}

  void enclose(const Difference&, const BallDifference& balls,
               std::vector<DirectionBound>& out) override {
    const BallVector n = to_balls(normal_);
    out.push_back({balls.gap(n), n});
  }
  ZeroGap zero_gap(const Difference& difference) override {
    return gap_is_zero(difference, normal_) ? ZeroGap::zero : ZeroGap::unknown;
  }
  bool is_across(const IntegerVector& v) const override { return dot(normal_, v) == 0; }

 private:
  IntegerVector normal_;
};

/// From the nearest point of a rim (about the origin) to a vertex q: n = q − radius · q⊥/|q⊥|.
class RimVertexDirection : public CriticalDirection {
 public:
  RimVertexDirection(IntegerVector q, unsigned signs, const Integer& radius_times_norm,
                     IntegerVector across)
      : q_(std::move(q)), signs_(signs), radius_(radius_times_norm), across_(std::move(across)) {}

  void enclose(const Difference& difference, const BallDifference& balls,
               std::vector<DirectionBound>& out) override {
    const BallVector n = direction();
    // Beyond the rim no direction is zero; at this precision it may look so.
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

IntegerVector off_axis(const IntegerVector& q, const Frame& frame) {
  return dot(q, frame.e) * frame.e + dot(q, frame.f) * frame.f;
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
  return std::make_unique<RationalDirection>(std::move(n), std::move(family));
}

Side at_vertex(const Difference& difference, unsigned signs, const BallVector& n,
               const Difference::Segment* skipped) {
  Side result = Side::yes;
  for (std::size_t i = 0; i < difference.segments.size(); ++i) {
    if (&difference.segments[i] == skipped) continue;
    const Ball along = dot(to_balls(difference.segments[i].frame.axis), n);
    const Ball side = (signs >> i & 1U) ? along : -along;
    if (side.is_negative()) return Side::no;
    if (!side.is_positive()) result = Side::undecided;
  }
  return result;
}

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
  // A vertex on the axis: every radial direction of its sector has the same gap. The sector may be
  // a single direction, or none.
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
    // On the rim, all normals of the rim's point have the gap −inflation.
    std::vector<IntegerVector> inward = signed_axes(difference, site.signs);
    inward.push_back(across);
    DirectionFamily arc = sector(cross(disc.frame.axis, across), inward);
    if (arc.ends.empty()) return;
    const IntegerVector end = arc.ends.front();
    out.push_back(rational_direction(end, std::move(arc)));
  }
  // Only a vertex beyond the rim has a maximum of its own.
  if (beyond <= 0) return;
  out.push_back(std::make_unique<RimVertexDirection>(q, site.signs, radius, std::move(across)));
}

std::unique_ptr<CriticalDirection> plane_direction(const Difference& difference) {
  return std::make_unique<PlaneDirection>(difference.plane_normal);
}

void append_directions(const Difference& difference, const CriticalSite& site,
                       CriticalDirections& out) {
  switch (site.kind) {
    case CriticalSite::Kind::disc_axis:
      return append_disc_axis(difference, site, out);
    case CriticalSite::Kind::crossing:
      return append_crossing(difference, site, out);
    case CriticalSite::Kind::radial:
      return append_radial(difference, site, out);
    case CriticalSite::Kind::rim_vertex:
      return append_rim_vertex(difference, site, out);
    case CriticalSite::Kind::rim_line:
      return append_rim_line(difference, site, out);
    case CriticalSite::Kind::rim_rim:
      return append_rim_rim(difference, site, out);
  }
}

}  // namespace touchstone::oracle
