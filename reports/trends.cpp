#include "reports/trends.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "reports/statistics.hpp"

namespace touchstone {
namespace {

/// The directions that a body's features lie along, as unit vectors in the world.
std::vector<Vec3> axes(const Shape& shape, const Pose& pose) {
  if (const auto* plane = std::get_if<Plane>(&shape)) {
    return {pose.rotation() * plane->unit_normal()};
  }
  if (std::holds_alternative<Sphere>(shape)) return {};
  if (std::holds_alternative<Box>(shape)) {
    const Eigen::Matrix3d& r = pose.rotation();
    return {r.col(0), r.col(1), r.col(2)};
  }
  return {pose.axis()};
}

std::optional<double> tilt(const Configuration& c) {
  const Vec3 u = c.pose_a.axis();
  std::optional<double> least;
  for (const Vec3& e : axes(c.b, c.pose_b)) {
    const double sine = std::min(std::abs(u.dot(e)), u.cross(e).norm());
    if (!least || sine < *least) least = sine;
  }
  return least ? std::optional(std::asin(std::min(1.0, *least))) : std::nullopt;
}

double aspect(const Shape& shape) {
  return std::holds_alternative<Plane>(shape)
             ? 1
             : largest_half_extent(shape) / smallest_half_extent(shape);
}

/// The decade of a value; absent for zero and what is lost in rounding.
std::optional<int> decade(double value) {
  return value < 1e-17 ? std::nullopt : std::optional<int>(std::floor(std::log10(value)));
}

/// What one decade of a variable holds.
struct Bin {
  std::vector<double> severity;
  std::size_t missed = 0;
};
/// Zero, as no decade, comes first.
using Bins = std::map<std::optional<int>, Bin>;

std::vector<TrendBin> summary(const Bins& bins) {
  std::vector<TrendBin> result;
  for (const auto& [decade, bin] : bins) {
    const Quantiles q = *quantiles(bin.severity);
    result.push_back({decade, bin.severity.size(), bin.missed, q.median, q.max});
  }
  return result;
}

}  // namespace

const char* variable_name(Variable variable) {
  switch (variable) {
    case Variable::tilt:
      return "tilt";
    case Variable::depth:
      return "depth";
    case Variable::aspect:
      return "aspect";
    case Variable::distance:
      return "distance";
  }
  return "";
}

std::optional<double> value_of(Variable variable, const Configuration& c, double signed_distance) {
  switch (variable) {
    case Variable::tilt:
      return tilt(c);
    case Variable::depth:
      if (signed_distance >= 0) return std::nullopt;
      return -signed_distance / smaller_size(c);
    case Variable::aspect:
      return std::max(aspect(c.a), aspect(c.b));
    case Variable::distance:
      return c.pose_a.position().norm() / larger_size(c);
  }
  return std::nullopt;
}

std::vector<Trend> trends(const Campaign& campaign, const std::vector<CellScores>& scores) {
  const std::vector<Cell> all = cells(campaign);
  std::vector<Trend> result;
  for (const Pair pair : campaign.pairs) {
    std::map<std::pair<std::size_t, Variable>, Bins> bins;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].pair != pair || !scores[i].done()) continue;
      const std::uint64_t done = scores[i].signed_distance.size();  // none if it was interrupted
      for (std::uint64_t index = 0; index < done; ++index) {
        const Configuration c = make_configuration({pair, all[i].pose_class, campaign.seed, index});
        for (const Variable variable : all_variables) {
          const auto value = value_of(variable, c, scores[i].signed_distance[index]);
          if (!value) continue;
          for (std::size_t k = 0; k < campaign.candidates.size(); ++k) {
            const Score& s = scores[i].scores[k][index];
            if (!is_judged(s.outcome)) continue;
            Bin& bin = bins[{k, variable}][decade(*value)];
            bin.severity.push_back(s.severity);
            bin.missed += s.outcome == Outcome::missed;
          }
        }
      }
    }
    for (const auto& [key, of_decade] : bins) {
      result.push_back({pair_name(pair), campaign.candidates[key.first]->name,
                        variable_name(key.second), summary(of_decade)});
    }
  }
  return result;
}

}  // namespace touchstone
