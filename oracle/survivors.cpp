#include "oracle/survivors.hpp"

#include <algorithm>
#include <utility>

#include "oracle/hull.hpp"

namespace touchstone::oracle {
namespace {

/// Appends all critical directions of one site.
void append_directions(const Difference& difference, const CriticalSite& site,
                       CriticalDirections& out) {
  switch (site.kind) {
    case CriticalSite::Kind::disc_axis:
      return append_disc_axis(difference, site, out);
    case CriticalSite::Kind::face:
      return append_face(difference, site, out);
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

}  // namespace

Difference exact_difference(const Configuration& c) {
  Difference difference = make_difference(c);
  if (!difference.hull || has_exact_faces(*difference.hull)) return difference;
  const Convex& body = difference.hull->body;
  return make_difference({c.a, c.pose_a, convex_hull(body.vertices(), body.rounding()), c.pose_b});
}

std::vector<Survivor> all_directions(const Difference& difference, double slack) {
  CriticalDirections directions;
  if (difference.is_plane) {
    directions.push_back(single_direction(difference.plane_normal));
  } else {
    for (const auto& site : critical_sites(difference, slack)) {
      append_directions(difference, site, directions);
    }
  }
  std::vector<Survivor> survivors;
  survivors.reserve(directions.size());
  for (auto& direction : directions) survivors.push_back({std::move(direction), {}});
  return survivors;
}

void enclose(std::vector<Survivor>& survivors, const Difference& difference,
             const BallDifference& balls) {
  for (auto& survivor : survivors) {
    survivor.bounds.clear();
    survivor.direction->enclose(difference, balls, survivor.bounds);
  }
}

Maximum maximum(const std::vector<Survivor>& survivors) {
  Maximum result;
  bool open = false;
  for (const auto& survivor : survivors) {
    for (const auto& bound : survivor.bounds) {
      if (!bound.gap.is_finite()) {
        open = true;
        continue;
      }
      Float hi = bound.gap.upper_end();
      if (!result.hi || *result.hi < hi) result.hi = std::move(hi);
      if (!bound.normal) continue;
      Float lo = bound.gap.lower_end();
      if (!result.lo || *result.lo < lo) result.lo = std::move(lo);
    }
  }
  if (open) result.hi.reset();
  return result;
}

void drop_below(std::vector<Survivor>& survivors, const Float& limit) {
  std::erase_if(survivors, [&](Survivor& survivor) {
    std::erase_if(survivor.bounds, [&](const DirectionBound& bound) {
      return bound.gap.is_finite() && bound.gap.upper_end() < limit;
    });
    return survivor.bounds.empty();
  });
}

bool is_exactly_zero(const std::vector<Survivor>& survivors, const Difference& difference) {
  bool zero = false;
  for (const auto& survivor : survivors) {
    const bool may_reach_zero =
        std::any_of(survivor.bounds.begin(), survivor.bounds.end(),
                    [](const DirectionBound& bound) { return !bound.gap.is_negative(); });
    if (!may_reach_zero) continue;
    const ZeroGap gap = survivor.direction->zero_gap(difference);
    if (gap == ZeroGap::unknown) return false;
    zero = zero || gap == ZeroGap::zero;
  }
  return zero;
}

}  // namespace touchstone::oracle
