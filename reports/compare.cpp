#include "reports/compare.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "reference/invalid_input.hpp"
#include "reports/comparison_basis.hpp"
#include "reports/timing.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using Key = std::tuple<std::string, std::string, std::string>;  // pair, class, candidate
using Rows = std::map<Key, const json*>;

/// Of the configurations that it has a routine for.
double supported(const json& row) {
  return row["count"].get<double>() - row["outcomes"].value("unsupported", 0.0);
}

Rows rows(const json& list) {
  Rows result;
  for (const json& row : list) result[{row["pair"], row["class"], row["candidate"]}] = &row;
  return result;
}

/// Collects the changes of one pair × class × candidate.
class Changes {
 public:
  Changes(const Key& key, json& list) : key_(key), list_(list) {}

  /// Of a quantity of which less is better; what lies below `floor` counts as that.
  void smaller_is_better(const char* measure, double before, double after, double floor,
                         double limit) {
    const double factor = std::max(after, floor) / std::max(before, floor);
    if (factor == 1) return;
    add(measure, before, after, factor, factor > 1 ? "worse" : "better",
        factor > limit || factor < 1 / limit);
  }
  void add(const char* measure, double before, double after, const json& factor,
           const char* verdict, bool beyond) {
    const auto& [pair, pose_class, candidate] = key_;
    list_.push_back({{"pair", pair},
                     {"class", pose_class},
                     {"candidate", candidate},
                     {"measure", measure},
                     {"before", before},
                     {"after", after},
                     {"factor", factor},
                     {"verdict", verdict},
                     {"beyond_limits", beyond}});
  }

 private:
  const Key& key_;
  json& list_;
};

/// Three standard deviations of the difference of two shares of different samples.
double chance(double p, double n, double q, double m) {
  const double mean = (p * n + q * m) / (n + m);
  return 3 * std::sqrt(mean * (1 - mean) * (1 / n + 1 / m));
}

void compare_agreement(Changes& changes, const json& before, const json& after,
                       const ComparisonBasis& basis, const CompareLimits& limits) {
  const double n = supported(before), m = supported(after);
  const double p = before["outcomes"].value("agree", 0.0) / n;
  const double q = after["outcomes"].value("agree", 0.0) / m;
  if (p == q || (!basis.same_configurations && std::abs(p - q) <= chance(p, n, q, m))) return;
  const json factor = p > 0 ? json(q / p) : json(nullptr);
  changes.add("agreement", p, q, factor, q < p ? "worse" : "better",
              q > p || q < limits.agreement * p);
}

void compare_errors(Changes& changes, const json& before, const json& after,
                    const ComparisonBasis& basis, const CompareLimits& limits) {
  constexpr struct {
    const char* member;
    const char* which;
    const char* measure;
    bool of_any_sample;  ///< not a matter of single configurations
  } measures[] = {{"depth_error", "median", "depth error, median", true},
                  {"depth_error", "p99", "depth error, p99", true},
                  {"depth_error", "max", "depth error, max", false},
                  {"normal_regret", "p99", "normal regret, p99", true},
                  {"normal_regret", "max", "normal regret, max", false},
                  {"point_error", "p99", "point error, p99", true},
                  {"point_error", "max", "point error, max", false},
                  {"deepest_error", "p99", "deepest point's error, p99", true},
                  {"deepest_error", "max", "deepest point's error, max", false}};
  for (const auto& m : measures) {
    const json old = before.value(m.member, json()), now = after.value(m.member, json());
    if (old.is_null() || now.is_null() || !(m.of_any_sample || basis.same_configurations)) continue;
    changes.smaller_is_better(m.measure, old[m.which], now[m.which], negligible_error,
                              limits.error_factor);
  }
  if (!basis.same_bar || before["coverage"].is_null() || after["coverage"].is_null()) return;
  constexpr double least_share = 0.01;
  const auto uncovered = [](const json& row) { return 1 - row["coverage"]["mean"].get<double>(); };
  changes.smaller_is_better("patch not covered, mean", uncovered(before), uncovered(after),
                            least_share, limits.error_factor);
}

/// A time as a multiple of the baseline's.
std::optional<Spread> relative(const Rows& rows, const Key& key, const std::string& baseline) {
  const json& time = (*rows.at(key))["nanoseconds"];
  const auto other = rows.find({std::get<0>(key), std::get<1>(key), baseline});
  if (time.is_null() || other == rows.end()) return std::nullopt;
  const json& of_baseline = (*other->second)["nanoseconds"];
  if (of_baseline.is_null()) return std::nullopt;
  if (baseline == "bullet" && !time["ratio_to_bullet"].is_null()) {
    return Spread{time["ratio_to_bullet"], time["ratio_low"], time["ratio_high"]};
  }
  const auto value = [](const json& t, const char* name) { return t[name].get<double>(); };
  return Spread{value(time, "median") / value(of_baseline, "median"),
                value(time, "low") / value(of_baseline, "high"),
                value(time, "high") / value(of_baseline, "low")};
}

void compare_times(Changes& changes, const Rows& before, const Rows& after, const Key& key,
                   const CompareLimits& limits) {
  const auto old = relative(before, key, limits.baseline);
  const auto now = relative(after, key, limits.baseline);
  if (old && now) {
    // By the nearest ends of the spreads; less may be the day's memory layout and is no change.
    const bool slower = now->low > limits.time_factor * old->high;
    const bool faster = old->low > limits.time_factor * now->high;
    if (slower || faster) {
      changes.add("time", old->median, now->median, now->median / old->median,
                  slower ? "slower" : "faster", true);
    }
  }
  const json &old_time = (*before.at(key))["nanoseconds"],
             &new_time = (*after.at(key))["nanoseconds"];
  if (old_time.is_null() || new_time.is_null()) return;
  const json &old_count = old_time["instructions"], &new_count = new_time["instructions"];
  if (old_count.is_null() || new_count.is_null()) return;
  const double factor = new_count.get<double>() / old_count.get<double>();
  if (factor > limits.time_factor || factor < 1 / limits.time_factor) {
    changes.add("instructions", old_count, new_count, factor, factor > 1 ? "slower" : "faster",
                true);
  }
}

}  // namespace

json compare(const json& before, const json& after, const CompareLimits& limits) {
  const ComparisonBasis basis = comparison_basis(before, after, limits.baseline);
  json changes = json::array();
  std::size_t compared = 0;
  const auto compare_rows = [&](const char* list, bool errors, bool times) {
    const Rows old_rows = rows(before[list]), new_rows = rows(after[list]);
    for (const auto& [key, old_row] : old_rows) {
      const auto found = new_rows.find(key);
      if (found == new_rows.end()) continue;
      const json &old = *old_row, &now = *found->second;
      const bool had = supported(old) > 0, has = supported(now) > 0;
      if (!had && !has) continue;
      ++compared;
      Changes of_row(key, changes);
      if (had != has) {
        of_row.add("has a routine", had, has, nullptr, has ? "better" : "worse", true);
        continue;
      }
      if (errors && basis.same_bar) compare_agreement(of_row, old, now, basis, limits);
      if (errors) compare_errors(of_row, old, now, basis, limits);
      if (times && basis.times) compare_times(of_row, old_rows, new_rows, key, limits);
    }
  };
  if (basis.same_configurations) compare_rows("results", true, true);
  if (basis.same_classes) compare_rows("summary", !basis.same_configurations, true);
  if (compared == 0) {
    throw InvalidInput("NEW", "of other things",
                       "must have a candidate and a class in common with OLD");
  }
  // The largest first; without a factor before all others.
  const auto size = [](const json& change) {
    const json& factor = change["factor"];
    return factor.is_null() || factor == 0 ? INFINITY : std::abs(std::log(factor.get<double>()));
  };
  std::stable_sort(changes.begin(), changes.end(),
                   [&](const json& a, const json& b) { return size(a) > size(b); });
  const auto about = [](const json& report) {
    return json{{"version", report["version"]},
                {"seed", report["seed"]},
                {"configurations", report["configurations"]},
                {"partial", report["partial"]},
                {"machine", report["machine"]}};
  };
  return {{"schema", "touchstone-comparison-1"},
          {"before", about(before)},
          {"after", about(after)},
          {"limits",
           {{"error_factor", limits.error_factor},
            {"time_factor", limits.time_factor},
            {"agreement", limits.agreement},
            {"baseline", limits.baseline}}},
          {"remarks", basis.remarks},
          {"compared", compared},
          {"changes", changes}};
}

bool has_regressed(const json& comparison) {
  const json& changes = comparison["changes"];
  return std::any_of(changes.begin(), changes.end(), [](const json& c) {
    return c["beyond_limits"].get<bool>() && (c["verdict"] == "worse" || c["verdict"] == "slower");
  });
}

}  // namespace touchstone
