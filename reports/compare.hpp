#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "properties/files/named_members.hpp"
#include "reports/report.hpp"
#include "reports/terminal.hpp"

namespace touchstone {

/// From where on a change is worth telling, and which are regressions.
struct CompareLimits {
  double error_factor = 2;   ///< by which an error may grow
  double time_factor = 1.5;  ///< by which a time, as a multiple of the baseline's, may grow
  double agreement = 1;      ///< share of the old agreement that must be kept
  bool time_counts = false;  ///< is what is slower beyond the limit a regression?
  std::string baseline = "bullet";
};
void members(auto& a, CompareLimits& l) {
  a.named("error_factor", l.error_factor, rule::positive);
  a.named("time_factor", l.time_factor, rule::positive);
  a.named("agreement", l.agreement, rule::share);
  constexpr Rule kinds{.min = 1, .one_of = [] {
                         return std::vector<std::string>{"accuracy", "time"};
                       }};
  std::vector<std::string> fail_on = kinds.one_of();
  if (!l.time_counts) fail_on.pop_back();
  a.named("fail_on", fail_on, kinds);
  a.named("baseline", l.baseline);
}

/// Errors below this, of the smaller size, are rounding: they count as this one.
inline constexpr double negligible_error = 1e-14;

/// One measure of one pair × class × candidate, or pair × group × candidate.
struct Change {
  enum class Verdict { worse, slower, better, faster };
  std::string pair, pose_class, candidate, measure;
  double before, after;
  std::optional<double> factor;  ///< absent where `before` is zero, and for yes or no
  Verdict verdict;
  bool beyond_limits;
};
const char* verdict_name(Change::Verdict verdict);
inline constexpr std::array all_verdicts = {Change::Verdict::worse, Change::Verdict::better,
                                            Change::Verdict::slower, Change::Verdict::faster};
inline const auto& values_of(Change::Verdict) { return all_verdicts; }
inline const char* name_of(Change::Verdict verdict) { return verdict_name(verdict); }

void members(auto& a, Change& c) {
  a.named("pair", c.pair);
  a.named("class", c.pose_class);
  a.named("candidate", c.candidate);
  a.named("measure", c.measure);
  a.named("before", c.before);
  a.named("after", c.after);
  a.named("factor", c.factor, rule::not_negative);
  a.named("verdict", c.verdict);
  a.named("beyond_limits", c.beyond_limits);
}

struct Comparison {
  /// One of the two reports.
  struct Side {
    std::string version;
    std::uint64_t seed, configurations;
    bool partial;
    Machine machine;
  };
  Side before, after;
  CompareLimits limits;
  std::vector<std::string> remarks;  ///< sentences: what else differs, what is not compared
  std::size_t compared = 0;          ///< rows
  std::vector<Change> changes;       ///< the largest first

  bool has_regressed() const;
};
void members(auto& a, Comparison::Side& s) {
  a.named("version", s.version);
  a.named("seed", s.seed);
  a.named("configurations", s.configurations);
  a.named("partial", s.partial);
  a.named("machine", s.machine);
}
void members(auto& a, Comparison& c) {
  a.named("before", c.before);
  a.named("after", c.after);
  a.named("limits", c.limits);
  a.named("remarks", c.remarks);
  a.named("compared", c.compared);
  a.named("changes", c.changes);
}

/// What is better, worse, faster or slower in `after` than in `before` (docs/report.md). Reports
/// on the same configurations are compared class by class; on others by pair and group, and only
/// beyond chance: of a thousand comparisons of what has not changed one finds a change. Times are
/// compared as multiples of the baseline's; they have changed when even the nearest ends of their
/// spreads are farther apart than the limit. Throws InvalidInput when there is nothing in common.
Comparison compare(const Report& before, const Report& after, const CompareLimits& limits);

/// For a terminal of 80 columns.
std::string comparison_text(const Comparison& comparison, const Terminal& terminal = {});
/// One JSON object (docs/comparison.schema.json).
std::string comparison_json(const Comparison& comparison);
/// A page, usable offline: the changes, and both fronts of speed and accuracy one over the other.
std::string comparison_page(const Comparison& comparison, const Report& before,
                            const Report& after);

}  // namespace touchstone
