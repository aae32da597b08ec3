#include "campaigns/score_tally.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

/// Coverage is summed as an integer: a sum of doubles depends on its order.
constexpr double covered_unit = 0x1p-24;

json bounds(const Magnitudes::Bounds& b) { return {b.lower, b.upper}; }

/// Of magnitudes, of which less is better.
json quantiles(const Magnitudes& h) {
  const auto median = h.percentile(50), p99 = h.percentile(99);
  if (!median) return nullptr;
  return {{"median", median->upper},
          {"median_bounds", bounds(*median)},
          {"p99", p99->upper},
          {"p99_bounds", bounds(*p99)},
          {"max", h.max()}};
}

json shares(const Magnitudes& uncovered, std::uint64_t covered_sum) {
  const auto median = uncovered.percentile(50), p99 = uncovered.percentile(99);
  if (!median) return nullptr;
  const auto rest = [](const Magnitudes::Bounds& b) { return json{1 - b.upper, 1 - b.lower}; };
  return {{"mean", static_cast<double>(covered_sum) * covered_unit /
                       static_cast<double>(uncovered.count())},
          {"median", 1 - median->upper},
          {"median_bounds", rest(*median)},
          {"p1", 1 - p99->upper},
          {"p1_bounds", rest(*p99)},
          {"min", 1 - uncovered.max()}};
}

json or_null(const std::optional<double>& value) { return value ? json(*value) : json(nullptr); }

std::optional<double> number_or_null(const json& value) {
  return value.is_null() ? std::nullopt : std::optional(value.get<double>());
}

Outcome parse_outcome(const std::string& name) {
  for (const Outcome outcome : all_outcomes) {
    if (name == outcome_name(outcome)) return outcome;
  }
  throw InvalidInput("outcome", '"' + name + '"', "must be one that a score has");
}

json to_json(const Case& c) {
  return {{"index", c.index},
          {"outcome", outcome_name(c.score.outcome)},
          {"depth_error", or_null(c.score.depth_error)},
          {"normal_regret", or_null(c.score.normal_regret)},
          {"severity", c.score.severity}};
}

Case case_from_json(const json& j, std::size_t cell) {
  Score score;
  score.outcome = parse_outcome(j.at("outcome"));
  score.depth_error = number_or_null(j.at("depth_error"));
  score.normal_regret = number_or_null(j.at("normal_regret"));
  score.severity = j.at("severity");
  return {cell, j.at("index"), score};
}

/// JSON knows no infinity.
double finite(double value) {
  constexpr double largest = std::numeric_limits<double>::max();
  return std::isnan(value) ? largest : std::clamp(value, -largest, largest);
}

/// What of a score is kept of the worst.
Score essence(const Score& s) {
  Score kept;
  kept.outcome = s.outcome;
  if (s.depth_error) kept.depth_error = finite(*s.depth_error);
  if (s.normal_regret) kept.normal_regret = finite(*s.normal_regret);
  kept.severity = finite(s.severity);
  return kept;
}

}  // namespace

void ScoreTally::add(std::size_t cell, std::uint64_t index, const Score& s) {
  ++count_;
  ++outcomes_[static_cast<std::size_t>(s.outcome)];
  if (s.points > 0) ++points_[s.points];
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    if (const auto& error = s.*quantities[i].value) errors_[i].add(*error);
  }
  if (is_judged(s.outcome)) severity_.add(s.severity);
  if (s.coverage) {
    const double covered = std::clamp(*s.coverage, 0.0, 1.0);
    uncovered_.add(1 - covered);
    covered_sum_ += static_cast<std::uint64_t>(std::llround(covered / covered_unit));
  }
  worst_.push_back({cell, index, essence(s)});
  select_worst();
}

void ScoreTally::add(const ScoreTally& other) {
  count_ += other.count_;
  for (std::size_t i = 0; i < outcomes_.size(); ++i) outcomes_[i] += other.outcomes_[i];
  for (const auto& [number, count] : other.points_) points_[number] += count;
  for (std::size_t i = 0; i < errors_.size(); ++i) errors_[i].add(other.errors_[i]);
  severity_.add(other.severity_);
  uncovered_.add(other.uncovered_);
  covered_sum_ += other.covered_sum_;
  worst_.insert(worst_.end(), other.worst_.begin(), other.worst_.end());
  select_worst();
}

void ScoreTally::select_worst() { worst_ = worst_of_class(std::move(worst_)); }

json ScoreTally::summary() const {
  json outcomes = json::object(), points = json::object();
  for (const Outcome outcome : all_outcomes) {
    const std::uint64_t count = outcomes_[static_cast<std::size_t>(outcome)];
    if (count > 0) outcomes[outcome_name(outcome)] = count;
  }
  for (const auto& [number, count] : points_) points[std::to_string(number)] = count;
  json result = {{"count", count_},
                 {"outcomes", outcomes},
                 {"points", points},
                 {"severity", quantiles(severity_)},
                 {"coverage", shares(uncovered_, covered_sum_)}};
  for (std::size_t i = 0; i < errors_.size(); ++i) {
    result[quantities[i].name] = quantiles(errors_[i]);
  }
  return result;
}

json ScoreTally::to_json() const {
  json outcomes = json::object(), points = json::array(), worst = json::array();
  for (const Outcome outcome : all_outcomes) {
    outcomes[outcome_name(outcome)] = outcomes_[static_cast<std::size_t>(outcome)];
  }
  for (const auto& [number, count] : points_) points.push_back({number, count});
  for (const Case& c : worst_) worst.push_back(touchstone::to_json(c));
  json result = {{"count", count_},
                 {"outcomes", outcomes},
                 {"points", points},
                 {"severity", severity_.to_json()},
                 {"uncovered", uncovered_.to_json()},
                 {"covered_sum", covered_sum_},
                 {"worst", worst}};
  for (std::size_t i = 0; i < errors_.size(); ++i) {
    result[quantities[i].name] = errors_[i].to_json();
  }
  return result;
}

ScoreTally ScoreTally::from_json(const json& j, std::size_t cell) {
  ScoreTally t;
  t.count_ = j.at("count");
  for (const auto& [name, count] : j.at("outcomes").items()) {
    t.outcomes_[static_cast<std::size_t>(parse_outcome(name))] = count;
  }
  for (const json& entry : j.at("points")) t.points_[entry.at(0)] = entry.at(1);
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    // Files of before the deepest point was measured do without it.
    if (j.contains(quantities[i].name) || quantities[i].value != &Score::deepest_error) {
      t.errors_[i] = Magnitudes::from_json(j.at(quantities[i].name));
    }
  }
  t.severity_ = Magnitudes::from_json(j.at("severity"));
  t.uncovered_ = Magnitudes::from_json(j.at("uncovered"));
  t.covered_sum_ = j.at("covered_sum");
  for (const json& entry : j.at("worst")) t.worst_.push_back(case_from_json(entry, cell));
  return t;
}

}  // namespace touchstone
