#include "reports/campaigns/score_tally.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <utility>

#include "properties/files/json_fields.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

/// Coverage is summed as an integer: a sum of doubles depends on its order.
constexpr double covered_unit = 0x1p-24;

/// Of magnitudes, of which less is better.
std::optional<Quantiles> quantiles(const Magnitudes& h) {
  const auto median = h.percentile(50), p99 = h.percentile(99);
  if (!median) return std::nullopt;
  return Quantiles{median->upper, p99->upper, h.max(), median, p99};
}

std::optional<Shares> shares(const Magnitudes& uncovered, std::uint64_t covered_sum) {
  const auto median = uncovered.percentile(50), p99 = uncovered.percentile(99);
  if (!median) return std::nullopt;
  const auto rest = [](const Bounds& b) { return Bounds{1 - b.upper, 1 - b.lower}; };
  const double mean =
      static_cast<double>(covered_sum) * covered_unit / static_cast<double>(uncovered.count());
  return Shares{mean,          1 - median->upper, 1 - p99->upper, 1 - uncovered.max(),
                rest(*median), rest(*p99)};
}

json or_null(const std::optional<double>& value) { return value ? json(*value) : json(nullptr); }

std::optional<double> number_or_null(const json& object, const char* name) {
  const json& value = member(object, name, "");
  return value.is_null() ? std::nullopt : std::optional(number(value, name));
}

const json& array(const json& object, const char* name) {
  const json& value = member(object, name, "");
  if (!value.is_array()) throw InvalidInput(name, shown(value), "must be an array");
  return value;
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
  score.outcome = parse_outcome(string(member(j, "outcome", ""), "outcome"));
  score.depth_error = number_or_null(j, "depth_error");
  score.normal_regret = number_or_null(j, "normal_regret");
  score.severity = number(member(j, "severity", ""), "severity");
  return {cell, whole_number(member(j, "index", ""), "index"), score};
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

Statistics ScoreTally::statistics() const {
  Statistics result;
  result.count = count_;
  result.outcomes = outcomes_;
  result.points = points_;
  result.severity = quantiles(severity_);
  result.coverage = shares(uncovered_, covered_sum_);
  for (std::size_t i = 0; i < errors_.size(); ++i) {
    result.*quantities[i].quantiles = quantiles(errors_[i]);
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
  t.count_ = whole_number(member(j, "count", ""), "count", Magnitudes::max_count);
  std::uint64_t left = t.count_;  // every configuration has one outcome
  const json& outcomes = member(j, "outcomes", "");
  require_object(outcomes, "outcomes");
  for (const auto& [name, count] : outcomes.items()) {
    auto& number = t.outcomes_[static_cast<std::size_t>(parse_outcome(name))];
    number = whole_number(count, "outcomes." + name, left);
    left -= number;
  }
  if (left != 0) throw InvalidInput("outcomes", shown(outcomes), "must add up to the count");
  for (const json& entry : array(j, "points")) {
    if (!entry.is_array() || entry.size() != 2) {
      throw InvalidInput("points", shown(entry), "must be an array of pairs");
    }
    const auto points = whole_number(entry[0], "points", TOUCHSTONE_MAX_POINTS);
    t.points_[static_cast<int>(points)] = whole_number(entry[1], "points", t.count_);
  }
  const auto magnitudes = [&](const char* name) {
    const json& value = member(j, name, "");
    return at_path(name, [&] {
      const Magnitudes read = Magnitudes::from_json(value);
      if (read.count() > t.count_) {
        throw InvalidInput("bins", fmt::format("{} values", read.count()),
                           "must hold no more than the count");
      }
      return read;
    });
  };
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    // Files of before the deepest point was measured do without it.
    if (j.contains(quantities[i].name) || quantities[i].value != &Score::deepest_error) {
      t.errors_[i] = magnitudes(quantities[i].name);
    }
  }
  t.severity_ = magnitudes("severity");
  t.uncovered_ = magnitudes("uncovered");
  const auto one = static_cast<std::uint64_t>(1 / covered_unit);
  t.covered_sum_ =
      whole_number(member(j, "covered_sum", ""), "covered_sum", t.uncovered_.count() * one);
  for (const json& entry : array(j, "worst")) {
    t.worst_.push_back(at_path("worst", [&] { return case_from_json(entry, cell); }));
  }
  t.select_worst();
  return t;
}

}  // namespace touchstone
