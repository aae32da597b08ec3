#include "reports/trends.hpp"

#include <algorithm>
#include <cmath>
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
  std::optional<double> min;
  for (const Vec3& e : axes(c.b, c.pose_b)) {
    const double sine = std::min(std::abs(u.dot(e)), u.cross(e).norm());
    if (!min || sine < *min) min = sine;
  }
  return min ? std::optional(std::asin(std::min(1.0, *min))) : std::nullopt;
}

double aspect(const Shape& shape) {
  return std::holds_alternative<Plane>(shape)
             ? 1
             : largest_half_extent(shape) / smallest_half_extent(shape);
}

std::optional<int> decade(double value) {
  if (value < 1e-17) return std::nullopt;
  return static_cast<int>(std::floor(std::log10(finite(value))));
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

void TrendTally::add(const Configuration& c, double signed_distance,
                     const std::vector<Score>& scores) {
  for (const Variable variable : all_variables) {
    const auto value = value_of(variable, c, signed_distance);
    if (!value) continue;
    for (std::size_t k = 0; k < scores.size(); ++k) {
      if (!is_judged(scores[k].outcome)) continue;
      Bin& bin = bins_[{k, variable, decade(*value)}];
      bin.severity.push_back(scores[k].severity);
      bin.missed += scores[k].outcome == Outcome::missed;
    }
  }
}

void TrendTally::add(const TrendTally& other) {
  for (const auto& [key, added] : other.bins_) {
    Bin& bin = bins_[key];
    bin.severity.insert(bin.severity.end(), added.severity.begin(), added.severity.end());
    bin.missed += added.missed;
  }
}

std::vector<Trend> TrendTally::trends(const std::string& pair, const std::string& group,
                                      const std::vector<std::string>& candidates) const {
  std::vector<Trend> result;
  const Key* last = nullptr;
  for (const auto& [key, bin] : bins_) {
    if (!last || last->candidate != key.candidate || last->variable != key.variable) {
      result.push_back({pair, group, candidates[key.candidate], variable_name(key.variable), {}});
    }
    const Quantiles q = *quantiles(bin.severity);
    result.back().bins.push_back({key.decade, bin.severity.size(), bin.missed, q.median, q.max});
    last = &key;
  }
  return result;
}

void TrendTally::write(ByteWriter& out) const {
  out.put(bins_.size());
  for (const auto& [key, bin] : bins_) {
    out.put(key);
    out.put(bin.severity);
    out.put(bin.missed);
  }
}

TrendTally TrendTally::read(ByteReader& in) {
  TrendTally tally;
  for (auto left = in.get<std::size_t>(); left > 0; --left) {
    Bin& bin = tally.bins_[in.get<Key>()];
    bin.severity = in.get_all<double>();
    bin.missed = in.get<std::uint64_t>();
  }
  return tally;
}

}  // namespace touchstone
