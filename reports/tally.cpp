#include "reports/tally.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <map>
#include <tuple>
#include <utility>

#include "reports/statistics.hpp"

namespace touchstone {
namespace {

constexpr std::size_t kept_of_heading = 4;
constexpr std::size_t kept_of_class = 2;

auto rank(const Score& s) {
  const Outcome o = s.outcome;
  const bool answered = o != Outcome::crashed && o != Outcome::timed_out && o != Outcome::failed &&
                        o != Outcome::not_finite;
  return std::tuple(agrees(o), answered, -s.severity);
}

}  // namespace

bool is_worse(const Score& a, const Score& b) { return rank(a) < rank(b); }

bool Case::operator<(const Case& other) const {
  return std::tuple(rank(score), cell, index) <
         std::tuple(rank(other.score), other.cell, other.index);
}

std::vector<Case> worst_of_class(std::vector<Case> cases) {
  std::erase_if(cases, [](const Case& c) {
    return c.score.outcome == Outcome::unsupported || c.score.outcome == Outcome::not_asked;
  });
  std::sort(cases.begin(), cases.end());
  std::map<Outcome, std::size_t> seen;
  std::size_t at = 0;
  std::erase_if(cases, [&](const Case& c) {
    const bool first_of_outcome = seen[c.score.outcome]++ == 0;
    return at++ >= kept_of_class && !first_of_outcome;
  });
  return cases;
}

std::vector<Case> worst_of_heading(std::vector<Case> cases) {
  std::sort(cases.begin(), cases.end());
  // The worst of each outcome stay, then what else is worst.
  std::map<Outcome, std::size_t> seen;
  const auto others = std::stable_partition(
      cases.begin(), cases.end(), [&](const Case& c) { return seen[c.score.outcome]++ == 0; });
  const auto first = static_cast<std::size_t>(others - cases.begin());
  cases.resize(std::min(std::max(kept_of_heading, first), cases.size()));
  std::sort(cases.begin(), cases.end());
  return cases;
}

namespace {

/// Eighths of an octave keep the first 15 bits of a double: sign, exponent, three of the mantissa.
/// The bits of doubles that are not negative ascend with them.
constexpr int dropped_bits = 64 - 15;

double rounded_down(double magnitude) {
  const auto bits = std::bit_cast<std::uint64_t>(magnitude);
  return std::bit_cast<double>(bits >> dropped_bits << dropped_bits);
}

/// Where the next bin begins.
double next_bin(double bin) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(bin) + (1ULL << dropped_bits));
}

/// What is kept of the score of one of the worst cases.
Score essence(const Score& s) {
  Score kept;
  kept.outcome = s.outcome;
  if (s.depth_error) kept.depth_error = finite(*s.depth_error);
  if (s.normal_regret) kept.normal_regret = finite(*s.normal_regret);
  kept.severity = finite(s.severity);
  return kept;
}

}  // namespace

void Magnitudes::add(double value) {
  const double magnitude = std::abs(finite(value));
  max_ = std::max(max_, magnitude);
  const double kept = is_exact() ? magnitude : rounded_down(magnitude);
  const auto at = std::ranges::lower_bound(entries_, kept, {}, &Entry::value);
  if (at != entries_.end() && at->value == kept) {
    ++at->times;
  } else {
    entries_.insert(at, {kept, 1});
  }
}

void Magnitudes::add(const Magnitudes& other) {
  max_ = std::max(max_, other.max_);
  std::vector<Entry> both;
  both.reserve(entries_.size() + other.entries_.size());
  std::ranges::merge(entries_, other.entries_, std::back_inserter(both), {}, &Entry::value,
                     &Entry::value);
  entries_.clear();
  for (const Entry& entry : both) {
    if (entries_.empty() || entries_.back().value != entry.value) {
      entries_.push_back(entry);
    } else {
      entries_.back().times += entry.times;
    }
  }
}

std::uint64_t Magnitudes::count() const {
  std::uint64_t count = 0;
  for (const Entry& entry : entries_) count += entry.times;
  return count;
}

std::optional<Quantiles> Magnitudes::quantiles() const {
  const std::uint64_t n = count();
  if (n == 0) return std::nullopt;
  const Bounds median = ranked((n + 1) / 2), p99 = ranked((99 * n + 99) / 100);
  Quantiles result{median.upper, p99.upper, max_};
  if (!is_exact()) {
    result.median_bounds = median;
    result.p99_bounds = p99;
  }
  return result;
}

Bounds Magnitudes::ranked(std::uint64_t rank) const {
  std::uint64_t seen = 0;
  for (const auto& [value, times] : entries_) {
    seen += times;
    if (seen < rank) continue;
    return {value, is_exact() ? value : std::min(next_bin(value), max_)};
  }
  return {max_, max_};
}

std::optional<LogHistogram> Magnitudes::half_decades() const {
  if (!is_exact() || entries_.empty()) return std::nullopt;
  LogHistogram result;
  for (const auto& [value, times] : entries_) {
    if (value == 0) {
      result.zero = times;
      continue;
    }
    const int bin = half_decade(value);
    if (result.counts.empty()) result.first = bin;
    result.counts.resize(static_cast<std::size_t>(bin - result.first) + 1);
    result.counts.back() += times;
  }
  return result;
}

void CoverageTally::add(double coverage) {
  const double covered = std::clamp(coverage, 0.0, 1.0);
  uncovered.add(1 - covered);
  sum += static_cast<std::uint64_t>(std::llround(covered / unit));
}

void CoverageTally::add(const CoverageTally& other) {
  uncovered.add(other.uncovered);
  sum += other.sum;
}

std::optional<Shares> CoverageTally::shares() const {
  const auto q = uncovered.quantiles();
  if (!q) return std::nullopt;
  double covered = static_cast<double>(sum) * unit;
  if (uncovered.is_exact()) {
    covered = 0;
    for (const auto& [value, times] : uncovered.entries()) {
      covered += (1 - value) * static_cast<double>(times);
    }
  }
  Shares result{covered / static_cast<double>(uncovered.count()), 1 - q->median, 1 - q->p99,
                1 - q->max};
  const auto rest = [](const Bounds& b) { return Bounds{1 - b.upper, 1 - b.lower}; };
  if (q->median_bounds) result.median_bounds = rest(*q->median_bounds);
  if (q->p99_bounds) result.p1_bounds = rest(*q->p99_bounds);
  return result;
}

void SignedTally::add(double value) { (value < 0 ? negative : positive).add(value); }

void SignedTally::add(const SignedTally& other) {
  negative.add(other.negative);
  positive.add(other.positive);
}

std::optional<SignedMedian> SignedTally::median() const {
  const std::uint64_t below = negative.count(), count = below + positive.count();
  if (count == 0) return std::nullopt;
  const std::uint64_t rank = (count + 1) / 2;
  if (rank > below) {
    const Bounds b = positive.ranked(rank - below);
    return SignedMedian{b.upper, positive.is_exact() ? std::nullopt : std::optional(b)};
  }
  // The smallest negative value has the largest magnitude.
  const Bounds magnitude = negative.ranked(below + 1 - rank), b{-magnitude.upper, -magnitude.lower};
  return SignedMedian{b.lower, negative.is_exact() ? std::nullopt : std::optional(b)};
}

Magnitudes SignedTally::magnitudes() const {
  Magnitudes result = negative;
  result.add(positive);
  return result;
}

std::optional<std::uint64_t> worst_failure(const ScoreTally& tally) {
  // Worst first: if this one agrees, all do.
  if (tally.worst.empty() || agrees(tally.worst.front().score.outcome)) return {};
  return tally.worst.front().index;
}

ScoreTally::ScoreTally(Resolution resolution)
    : depth_error{Magnitudes(resolution), Magnitudes(resolution)},
      severity(resolution),
      coverage{Magnitudes(resolution)} {
  errors.fill(Magnitudes(resolution));
}

void ScoreTally::add(std::size_t cell, std::uint64_t index, const Score& s) {
  ++count;
  ++outcomes[static_cast<std::size_t>(s.outcome)];
  if (s.points > 0) ++points[s.points];
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    if (const auto& error = s.*quantities[i].value) errors[i].add(*error);
  }
  if (s.depth_error) depth_error.add(*s.depth_error);
  if (is_judged(s.outcome)) severity.add(s.severity);
  if (s.coverage) coverage.add(*s.coverage);
  const Case added{cell, index, essence(s)};
  // Most are not among the worst, which is cheap to tell.
  const auto worse = [&](const Case& c) { return c < added; };
  const bool has_worse_like_it = std::any_of(worst.begin(), worst.end(), [&](const Case& c) {
    return c.score.outcome == s.outcome && worse(c);
  });
  const auto worse_ones = std::count_if(worst.begin(), worst.end(), worse);
  if (has_worse_like_it && worse_ones >= static_cast<std::ptrdiff_t>(kept_of_class)) return;
  worst.push_back(added);
  worst = worst_of_class(std::move(worst));
}

void ScoreTally::add(const ScoreTally& other) {
  count += other.count;
  for (std::size_t i = 0; i < outcomes.size(); ++i) outcomes[i] += other.outcomes[i];
  for (const auto& [number, times] : other.points) points[number] += times;
  for (std::size_t i = 0; i < errors.size(); ++i) errors[i].add(other.errors[i]);
  depth_error.add(other.depth_error);
  severity.add(other.severity);
  coverage.add(other.coverage);
  worst.insert(worst.end(), other.worst.begin(), other.worst.end());
  worst = worst_of_class(std::move(worst));
}

Statistics ScoreTally::statistics() const {
  Statistics result;
  result.count = count;
  result.outcomes = outcomes;
  result.points = points;
  const Magnitudes depth = depth_error.magnitudes();
  result.depth_error = depth.quantiles();
  result.depth_histogram = depth.half_decades();
  result.bias = depth_error.median();
  for (std::size_t i = 0; i < errors.size(); ++i) {
    result.*quantities[i].quantiles = errors[i].quantiles();
  }
  result.regret_histogram = errors[0].half_decades();
  result.severity = severity.quantiles();
  result.coverage = coverage.shares();
  return result;
}

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
  if (const auto* hull = std::get_if<Convex>(&shape)) {
    std::vector<Vec3> normals;
    for (const Convex::Face& face : hull->faces()) {
      normals.emplace_back(pose.rotation() * face.normal);
    }
    return normals;
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
  constexpr std::array names = {"tilt", "depth", "aspect", "distance"};
  return names[static_cast<std::size_t>(variable)];
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
      bin.severity.add(scores[k].severity);
      bin.missed += scores[k].outcome == Outcome::missed;
    }
  }
}

void TrendTally::add(const TrendTally& other) {
  for (const auto& [key, added] : other.bins_) {
    Bin& bin = bins_[key];
    bin.severity.add(added.severity);
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
    const Quantiles q = *bin.severity.quantiles();
    result.back().bins.push_back({key.decade, bin.severity.count(), bin.missed, q.median, q.max});
    last = &key;
  }
  return result;
}

}  // namespace touchstone
