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

/// Both ±n are tried.
class RationalDirection : public CriticalDirection {
 public:
  explicit RationalDirection(IntegerVector n, std::optional<DirectionFamily> family = {})
      : n_(std::move(n)), family_(std::move(family)) {}

  void enclose(const BallDifference& difference, std::vector<DirectionBound>& out) override {
    const BallVector n = to_balls(n_);
    const auto [centre_distance, half_width] = difference.along(n);
    const Ball gap = (abs(centre_distance) - half_width) / norm(n);
    if (!centre_distance.is_negative()) out.push_back({gap, n});
    if (!centre_distance.is_positive()) out.push_back({gap, -n});
  }
  ZeroGap zero_gap(const Difference& difference, const BallDifference&) override {
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

  void enclose(const BallDifference& difference, std::vector<DirectionBound>& out) override {
    const BallVector n = to_balls(normal_);
    out.push_back({difference.gap(n), n});
  }
  ZeroGap zero_gap(const Difference& difference, const BallDifference&) override {
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

  void enclose(const BallDifference& difference, std::vector<DirectionBound>& out) override {
    const BallVector n = direction();
    // Beyond the rim no direction is zero; at this precision it may look so.
    out.push_back({difference.gap(n), n});
  }

  // |n| = inflation, that is |q|² + radius² − inflation² = 2 radius |q⊥|.
  ZeroGap zero_gap(const Difference& difference, const BallDifference&) override {
    const Integer inflation = difference.inflation * difference.norm;
    const Integer rest = dot(q_, q_) + radius_ * radius_ - inflation * inflation;
    const Integer norm_squared = difference.norm * difference.norm;
    if (rest < 0 || rest * rest * norm_squared * norm_squared !=
                        4 * radius_ * radius_ * dot(across_, across_)) {
      return ZeroGap::unknown;
    }
    return is_at_vertex(difference, signs_, direction()) ? ZeroGap::zero : ZeroGap::at_most_zero;
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

/// A vertex on the axis: every radial direction of its sector has the same gap.
DirectionFamily sector(const Difference& difference, const CriticalSite& site) {
  const auto& segments = difference.segments;
  const Frame& frame = segments[site.first].frame;
  if (segments.size() == 1) return {NormalFamily::Kind::circle, frame.axis, {}};
  DirectionFamily family{NormalFamily::Kind::arc, {0, 0, 0}, {}};
  const auto in_sector = [&](const IntegerVector& n) {
    for (std::size_t i = 0; i < segments.size(); ++i) {
      if (i == site.first) continue;
      const int side = sgn(dot(segments[i].frame.axis, n));
      if (side != 0 && (side > 0) != ((site.signs >> i & 1U) != 0)) return false;
    }
    return true;
  };
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (i == site.first) continue;
    const IntegerVector end = cross(frame.axis, segments[i].frame.axis);
    for (const IntegerVector& n : {end, -end}) {
      if (in_sector(n)) family.ends.push_back(n);
    }
  }
  return family;
}

IntegerVector off_axis(const IntegerVector& q, const Frame& frame) {
  return dot(q, frame.e) * frame.e + dot(q, frame.f) * frame.f;
}

}  // namespace

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

bool is_at_vertex(const Difference& difference, unsigned signs, const BallVector& n,
                  const Difference::Segment* skipped) {
  for (std::size_t i = 0; i < difference.segments.size(); ++i) {
    if (&difference.segments[i] == skipped) continue;
    const Ball side = dot(to_balls(difference.segments[i].frame.axis), n);
    if (!((signs >> i & 1U) ? side.is_positive() : side.is_negative())) return false;
  }
  return true;
}

void append_disc_axis(const Difference& difference, const CriticalSite& site,
                      CriticalDirections& out) {
  out.push_back(std::make_unique<RationalDirection>(difference.discs[site.first].frame.axis));
}

void append_crossing(const Difference& difference, const CriticalSite& site,
                     CriticalDirections& out) {
  out.push_back(std::make_unique<RationalDirection>(
      cross(difference.segments[site.first].frame.axis,
            difference.segments[site.second].frame.axis)));
}

void append_radial(const Difference& difference, const CriticalSite& site,
                   CriticalDirections& out) {
  const auto& segment = difference.segments[site.first];
  const IntegerVector n =
      off_axis(reduced_point(difference, site.signs, &segment), segment.frame);
  if (!is_zero(n)) {
    out.push_back(std::make_unique<RationalDirection>(n));
    return;
  }
  DirectionFamily family = sector(difference, site);
  const IntegerVector sample = family.ends.empty() ? segment.frame.e : family.ends.front();
  out.push_back(std::make_unique<RationalDirection>(sample, std::move(family)));
}

void append_rim_vertex(const Difference& difference, const CriticalSite& site,
                       CriticalDirections& out) {
  const auto& disc = difference.discs.front();
  const Integer radius = disc.radius * difference.norm;
  const IntegerVector q = reduced_point(difference, site.signs);
  IntegerVector across = off_axis(q, disc.frame);
  // Only a vertex beyond the rim has a maximum here; across is norm² q⊥. One on the rim touches,
  // and the ends of its fan of normals are directions of their own.
  const Integer reach = difference.norm * difference.norm * radius;
  if (dot(across, across) <= reach * reach) return;
  out.push_back(
      std::make_unique<RimVertexDirection>(q, site.signs, radius, std::move(across)));
}

std::unique_ptr<CriticalDirection> plane_direction(const Difference& difference) {
  return std::make_unique<PlaneDirection>(difference.plane_normal);
}

void append_directions(const Difference& difference, const CriticalSite& site,
                       CriticalDirections& out) {
  switch (site.kind) {
    case CriticalSite::Kind::disc_axis: return append_disc_axis(difference, site, out);
    case CriticalSite::Kind::crossing: return append_crossing(difference, site, out);
    case CriticalSite::Kind::radial: return append_radial(difference, site, out);
    case CriticalSite::Kind::rim_vertex: return append_rim_vertex(difference, site, out);
    case CriticalSite::Kind::rim_line: return append_rim_line(difference, site, out);
    case CriticalSite::Kind::rim_rim: return append_rim_rim(difference, site, out);
  }
}

}  // namespace touchstone::oracle
