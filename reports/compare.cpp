#include "reports/compare.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "properties/identity.hpp"
#include "reference/invalid_input.hpp"
#include "reports/factors.hpp"

namespace touchstone {
namespace {

using Verdict = Change::Verdict;
using NameSet = std::set<std::string>;
using Groups = std::set<std::pair<std::string, std::string>>;  // pair or "all", group

/// The common ground of two reports, and everything else that a person must know before reading
/// differences into them.
struct Basis {
  bool same_configurations = true;  ///< seed, and count of each class that both have
  bool same_bar = true;             ///< tolerance and threshold
  bool same_judge = true;           ///< outcomes and regrets mean the same
  /// Of other configurations, what a change must be less likely than if nothing has changed.
  double max_chance = 0;
  NameSet others;     ///< classes that have other configurations in each report
  Groups split;       ///< those with such a class, or one that only one report has
  bool times = true;  ///< both have the baseline that times are related to
  std::vector<std::string> remarks;
};

NameSet candidate_names(const Report& report) {
  NameSet result;
  for (const CandidateDescription& c : report.candidates) result.insert(c.name);
  return result;
}

NameSet class_names(const Report& report) {
  NameSet result;
  for (const ResultRow& row : report.results) result.insert(row.pair + '/' + row.pose_class);
  return result;
}

/// The group of a class; all where this version does not know it, for it may be of any.
std::vector<Group> possible_groups(const std::string& pair, const std::string& pose_class) {
  if (const auto known = find_pose_class(pair, pose_class)) return {known->group()};
  return {std::begin(all_groups), std::end(all_groups)};
}

Groups split_groups(const NameSet& old_classes, const NameSet& new_classes, NameSet uncommon) {
  std::set_symmetric_difference(old_classes.begin(), old_classes.end(), new_classes.begin(),
                                new_classes.end(), std::inserter(uncommon, uncommon.end()));
  Groups result;
  for (const std::string& name : uncommon) {
    const std::size_t slash = name.find('/');
    const std::string pair = name.substr(0, slash);
    for (const Group group : possible_groups(pair, name.substr(slash + 1))) {
      result.insert({pair, group_name(group)});
      result.insert({"all", group_name(group)});
    }
  }
  return result;
}

/// "Only in the old report, not compared: …", and likewise of the new one.
void remark_only(Basis& basis, const char* what, const NameSet& old_names,
                 const NameSet& new_names) {
  const auto remark = [&](const NameSet& all, const NameSet& others, const char* where) {
    NameSet only;
    std::set_difference(all.begin(), all.end(), others.begin(), others.end(),
                        std::inserter(only, only.end()));
    if (only.empty()) return;
    constexpr std::size_t max_named = 20;
    const std::size_t unnamed = only.size() - std::min(only.size(), max_named);
    const auto end = std::next(only.begin(), static_cast<std::ptrdiff_t>(only.size() - unnamed));
    basis.remarks.push_back(fmt::format("Only in the {} report, not compared: {} {}{}.", where,
                                        what, fmt::join(only.begin(), end, ", "),
                                        unnamed ? fmt::format(" and {} more", unnamed) : ""));
  };
  remark(old_names, new_names, "old");
  remark(new_names, old_names, "new");
}

void remark_candidates(Basis& basis, const Report& before, const Report& after) {
  for (const CandidateDescription& old : before.candidates) {
    for (const CandidateDescription& now : after.candidates) {
      if (old.name != now.name) continue;
      if (old.version != now.version) {
        basis.remarks.push_back(
            fmt::format("{}: version {} before, {} now.", old.name, old.version, now.version));
      }
      if (old.settings != now.settings) {
        basis.remarks.push_back(fmt::format("{} is called in another way than before.", old.name));
      }
    }
  }
}

using Key = std::tuple<std::string, std::string, std::string>;  // pair, class, candidate
using Rows = std::map<Key, const ResultRow*>;

Rows rows_of(const std::vector<ResultRow>& list) {
  Rows result;
  for (const ResultRow& row : list) result[{row.pair, row.pose_class, row.candidate}] = &row;
  return result;
}

/// The counts of the first class that has another one in each report; those of `others` aside.
std::optional<std::pair<std::uint64_t, std::uint64_t>> other_counts(const Report& before,
                                                                    const Report& after,
                                                                    const NameSet& others) {
  const Rows old_rows = rows_of(before.results);
  for (const ResultRow& row : after.results) {
    const auto old = old_rows.find({row.pair, row.pose_class, row.candidate});
    if (old == old_rows.end() || others.contains(row.pair + '/' + row.pose_class)) continue;
    const std::uint64_t was = old->second->statistics.count, is = row.statistics.count;
    if (was != is) return std::pair(was, is);
  }
  return std::nullopt;
}

/// The rows that `other` lacks, though it has their class and their candidate.
NameSet rows_without(const Report& report, const Report& other) {
  const NameSet names = candidate_names(other), classes = class_names(other);
  const Rows theirs = rows_of(other.results);
  NameSet result;
  for (const auto& [key, row] : rows_of(report.results)) {
    const std::string of_class = row->pair + '/' + row->pose_class;
    if (theirs.contains(key) || !names.contains(row->candidate) || !classes.contains(of_class)) {
      continue;
    }
    result.insert(of_class + " of " + row->candidate);
  }
  return result;
}

/// The classes of a report by name, with what tells their configurations from others.
std::map<std::string, std::string> digests_of(const Report& report) {
  std::map<std::string, std::string> result;
  for (const PoseClassDescription& c : report.classes) {
    result[c.pair + '/' + c.pose_class] = c.digest;
  }
  return result;
}

/// Compares digests of configurations that came in a file, which seed and count do not identify.
void remark_given(Basis& basis, const Report& before, const Report& after) {
  auto old_digests = digests_of(before), new_digests = digests_of(after);
  const NameSet new_classes = class_names(after);
  bool is_any_unknown = false;
  for (const std::string& name : class_names(before)) {
    if (!new_classes.contains(name)) continue;
    const std::string &was = old_digests[name], &is = new_digests[name];
    const bool is_own = name.ends_with('/' + std::string(group_name(Group::given)));
    if (is_own && (was.empty() || is.empty())) {
      is_any_unknown = true;
    } else if (was != is) {
      basis.others.insert(name);
    }
  }
  if (is_any_unknown) {
    basis.remarks.push_back(
        "Configurations of your own are compared as if both reports had the same file, for one of "
        "them is from before reports told.");
  }
  if (!basis.others.empty()) {
    basis.remarks.push_back(fmt::format("Answers to other configurations, not compared: {}.",
                                        fmt::join(basis.others, ", ")));
  }
}

/// A number as report.json has it: "0.0001", "0.0".
std::string number(double value) {
  const bool is_whole = value == std::floor(value) && std::abs(value) < 1e15;
  return is_whole ? fmt::format("{:.1f}", value) : fmt::format("{}", value);
}

void remark_another(Basis& basis, const char* what, const std::string& before,
                    const std::string& after) {
  if (before == after) return;
  basis.remarks.push_back(fmt::format("Another {}: {} before, {} now.", what, before, after));
}

Basis basis_of(const Report& before, const Report& after, const std::string& baseline) {
  Basis basis;
  const NameSet old_names = candidate_names(before), new_names = candidate_names(after);
  const NameSet old_classes = class_names(before), new_classes = class_names(after);
  remark_only(basis, "candidates", old_names, new_names);
  remark_only(basis, "classes", old_classes, new_classes);
  remark_only(basis, "rows", rows_without(before, after), rows_without(after, before));
  remark_given(basis, before, after);
  basis.split = split_groups(old_classes, new_classes, basis.others);
  const auto counts = other_counts(before, after, basis.others);
  basis.same_configurations = before.seed == after.seed && !counts;
  if (!basis.same_configurations) {
    std::string why;
    if (before.seed != after.seed) why = fmt::format("seed {} and {}", before.seed, after.seed);
    if (counts) {
      why += fmt::format("{}{} and {} of a class", why.empty() ? "" : ", ", counts->first,
                         counts->second);
    }
    basis.remarks.push_back(
        fmt::format("The configurations differ ({}): only groups of classes as a whole are "
                    "compared, and only where agreement, depth error or normal regret differs "
                    "beyond chance.",
                    why));
    if (!basis.split.empty()) {
      basis.remarks.push_back("Groups with a class that only one report has are not compared.");
    }
  }
  for (const auto& [report, which] : {std::pair(&before, "old"), std::pair(&after, "new")}) {
    if (!report->is_old) continue;
    basis.remarks.push_back(fmt::format(
        "The {} report is of schema 1, which knows no groups: only classes are compared.", which));
  }
  // Of a thousand comparisons of what has not changed, one finds a change: so much is left for each
  // row, measure (agreement, median and 99th percentile of depth, that of regret) and direction.
  constexpr double of_comparison = 1e-3, tests_of_row = 4 * 2;
  const std::size_t rows =
      after.summary.size() + (basis.same_configurations ? after.results.size() : 0);
  basis.max_chance =
      of_comparison / (tests_of_row * static_cast<double>(std::max<std::size_t>(rows, 1)));
  basis.same_bar = before.tolerance == after.tolerance && before.threshold == after.threshold;
  if (!basis.same_bar) {
    basis.remarks.push_back(fmt::format(
        "The bars differ (tolerance {} and {}, threshold {} and {}): agreement and coverage are "
        "not compared.",
        number(before.tolerance), number(after.tolerance), number(before.threshold),
        number(after.threshold)));
  }
  basis.same_judge = before.is_of_old_judge == after.is_of_old_judge;
  if (!basis.same_judge) {
    basis.remarks.push_back(fmt::format(
        "The {} report is of a schema before 3, where points off the bodies agreed and a normal's "
        "regret grew with a floor: of agreement that in depth alone is compared, normal regret, "
        "point error and coverage are not.",
        before.is_of_old_judge ? "old" : "new"));
  }
  for (const auto& [report, which] : {std::pair(&before, "old"), std::pair(&after, "new")}) {
    if (!report->partial) continue;
    basis.remarks.push_back(
        fmt::format("The {} report is partial: its run was interrupted.", which));
  }
  if (before.version != after.version) {
    basis.remarks.push_back(
        fmt::format("Made by touchstone {} and {}.", before.version, after.version));
  }
  remark_candidates(basis, before, after);
  remark_another(basis, "cpu", before.machine.cpu, after.machine.cpu);
  remark_another(basis, "compiler", before.machine.compiler, after.machine.compiler);
  basis.times = old_names.contains(baseline) && new_names.contains(baseline);
  if (!basis.times) {
    basis.remarks.push_back(fmt::format(
        "Times are not compared: {} is not in both reports to relate them to.", baseline));
  }
  return basis;
}

/// Where a candidate was stopped, rows of the same configurations may tell of others.
void remark_stopped(Basis& basis, const Report& before, const Report& after) {
  std::set<std::string> names;
  for (const Report* report : {&before, &after}) {
    for (const ResultRow& row : report->results) {
      if (row.statistics.is_stopped()) names.insert(row.candidate);
    }
  }
  for (const std::string& name : names) {
    basis.remarks.push_back(fmt::format(
        "{} times out so often that it was not asked all of some classes, which counts against it: "
        "its agreement and errors there are compared beyond chance.",
        name));
  }
}

/// Collects the changes of one row.
class Changes {
 public:
  Changes(const ResultRow& row, std::vector<Change>& list) : row_(row), list_(list) {}

  /// Adds a quantity of which less is better; what lies below `floor` counts as that.
  void smaller_is_better(const char* measure, double before, double after, double floor,
                         double limit) {
    const double factor = finite(std::max(after, floor) / std::max(before, floor));
    if (factor == 1) return;
    add(measure, before, after, factor, factor > 1 ? Verdict::worse : Verdict::better,
        factor > limit || factor < 1 / limit);
  }
  void add(const char* measure, double before, double after, std::optional<double> factor,
           Verdict verdict, bool beyond) {
    list_.push_back({row_.pair, row_.pose_class, row_.candidate, measure, before, after, factor,
                     verdict, beyond});
  }

 private:
  const ResultRow& row_;
  std::vector<Change>& list_;
};

/// Are failures so much more frequent in the second sample that chance does not explain it?
bool rises_beyond_chance(const FailureRate& from, const FailureRate& to, double max_chance) {
  return from.share() < to.share() && chance(from, to) < max_chance;
}

/// A quantile of few errors, or near which there are few, is another one in each sample. So it is
/// the share of errors above the smaller one that must have changed.
bool differ_beyond_chance(const std::optional<LogHistogram>& before,
                          const std::optional<LogHistogram>& after, double quantile_before,
                          double quantile_after, double max_chance) {
  if (!before || !after) return false;
  const double smaller = std::max(std::min(quantile_before, quantile_after), negligible_error);
  const auto above = [&](const LogHistogram& h) {
    return FailureRate{h.count(), h.above(smaller)};
  };
  return quantile_before < quantile_after
             ? rises_beyond_chance(above(*before), above(*after), max_chance)
             : rises_beyond_chance(above(*after), above(*before), max_chance);
}

/// On how many of those supported the answer is right in depth, whatever a judge finds of its
/// normal and points.
std::uint64_t right_in_depth(const Statistics& s) {
  std::uint64_t sum = s.agreeing();
  for (const Outcome outcome : all_outcomes) {
    if (outcome != Outcome::wrong_normal && !is_of_points(outcome)) continue;
    sum += s.of(outcome);
  }
  return sum;
}

void compare_agreement(Changes& changes, const Statistics& before, const Statistics& after,
                       bool same_configurations, const Basis& basis, const CompareLimits& limits) {
  const auto failing = [&](const Statistics& s) {
    const std::uint64_t right = basis.same_judge ? s.agreeing() : right_in_depth(s);
    return FailureRate{s.supported(), s.supported() - right};
  };
  const FailureRate old = failing(before), now = failing(after);
  if (old.share() == now.share()) return;
  if (!same_configurations && !rises_beyond_chance(old, now, basis.max_chance) &&
      !rises_beyond_chance(now, old, basis.max_chance)) {
    return;
  }
  const double p = 1 - old.share(), q = 1 - now.share();
  changes.add(basis.same_judge ? "agreement" : "agreement in depth", p, q,
              p > 0 ? std::optional(q / p) : std::nullopt, q < p ? Verdict::worse : Verdict::better,
              q > p || q < limits.agreement * p);
}

void compare_errors(Changes& changes, const Statistics& before, const Statistics& after,
                    const Basis& basis, bool same_configurations, const CompareLimits& limits) {
  constexpr struct {
    std::optional<Quantiles> Statistics::*member;
    double Quantiles::*which;
    const char* measure;
    /// What tells a change from chance; null: compared on the same configurations alone.
    std::optional<LogHistogram> Statistics::*histogram = nullptr;
  } measures[] = {
      {&Statistics::depth_error, &Quantiles::median, "depth error, median",
       &Statistics::depth_histogram},
      {&Statistics::depth_error, &Quantiles::p99, "depth error, p99", &Statistics::depth_histogram},
      {&Statistics::depth_error, &Quantiles::max, "depth error, max"},
      {&Statistics::normal_regret, &Quantiles::p99, "normal regret, p99",
       &Statistics::regret_histogram},
      {&Statistics::normal_regret, &Quantiles::max, "normal regret, max"},
      {&Statistics::point_error, &Quantiles::p99, "point error, p99"},
      {&Statistics::point_error, &Quantiles::max, "point error, max"},
      {&Statistics::deepest_error, &Quantiles::p99, "deepest point's error, p99"},
      {&Statistics::deepest_error, &Quantiles::max, "deepest point's error, max"}};
  for (const auto& m : measures) {
    const auto &old = before.*m.member, &now = after.*m.member;
    if (!old || !now) continue;
    const bool is_judged_anew =
        m.member == &Statistics::normal_regret || m.member == &Statistics::point_error;
    if (is_judged_anew && !basis.same_judge) continue;
    const double was = (*old).*m.which, is = (*now).*m.which;
    if (!same_configurations &&
        !(m.histogram && differ_beyond_chance(before.*m.histogram, after.*m.histogram, was, is,
                                              basis.max_chance))) {
      continue;
    }
    changes.smaller_is_better(m.measure, was, is, negligible_error, limits.error_factor);
  }
  if (!same_configurations || !basis.same_bar || !basis.same_judge) return;
  if (!before.coverage || !after.coverage) return;
  constexpr double min_share = 0.01;
  changes.smaller_is_better("patch not covered, mean", 1 - before.coverage->mean,
                            1 - after.coverage->mean, min_share, limits.error_factor);
}

/// The row's time as a multiple of the baseline's.
std::optional<Spread> relative_time(const Rows& rows, const ResultRow& row,
                                    const std::string& baseline) {
  const auto found = rows.find({row.pair, row.pose_class, baseline});
  if (!row.time || found == rows.end() || !found->second->time) return std::nullopt;
  if (baseline == "bullet" && row.time->ratio_to_bullet) return row.time->ratio_to_bullet;
  const Spread &time = row.time->nanoseconds, &of_baseline = found->second->time->nanoseconds;
  return Spread{time.median / of_baseline.median, time.low / of_baseline.high,
                time.high / of_baseline.low};
}

void compare_times(Changes& changes, const std::optional<Spread>& before,
                   const std::optional<Spread>& after, double limit) {
  if (!before || !after) return;
  // By the nearest ends of the spreads; less may be the day's memory layout and is no change.
  const bool is_slower = after->low > limit * before->high;
  const bool is_faster = before->low > limit * after->high;
  if (!is_slower && !is_faster) return;
  changes.add("time", before->median, after->median, after->median / before->median,
              is_slower ? Verdict::slower : Verdict::faster, true);
}

void compare_instructions(Changes& changes, const ResultRow& before, const ResultRow& after,
                          double limit) {
  if (!before.time || !after.time) return;
  const auto &old = before.time->instructions, &now = after.time->instructions;
  if (!old || !now) return;
  const double factor = *now / *old;
  if (factor <= limit && factor >= 1 / limit) return;
  changes.add("instructions", *old, *now, factor, factor > 1 ? Verdict::slower : Verdict::faster,
              true);
}

/// Compares the rows that both lists have and that cover the same classes.
void compare_rows(Comparison& comparison, const std::vector<ResultRow>& before,
                  const std::vector<ResultRow>& after, const Basis& basis, bool with_errors) {
  const CompareLimits& limits = comparison.limits;
  const Rows old_rows = rows_of(before), new_rows = rows_of(after);
  for (const auto& [key, old_row] : old_rows) {
    const auto found = new_rows.find(key);
    const auto& [pair, name, candidate] = key;  // the name of a class, or of a group
    if (found == new_rows.end() || basis.others.contains(pair + '/' + name) ||
        basis.split.contains({pair, name})) {
      continue;
    }
    const ResultRow &old = *old_row, &now = *found->second;
    const bool had = old.statistics.supported() > 0, has = now.statistics.supported() > 0;
    const bool same_configurations =
        basis.same_configurations && !old.statistics.is_stopped() && !now.statistics.is_stopped();
    if (!had && !has) continue;
    ++comparison.compared;
    Changes changes(old, comparison.changes);
    if (had != has) {
      changes.add("has a routine", had, has, {}, has ? Verdict::better : Verdict::worse, true);
      continue;
    }
    if (with_errors) {
      if (basis.same_bar) {
        compare_agreement(changes, old.statistics, now.statistics, same_configurations, basis,
                          limits);
      }
      compare_errors(changes, old.statistics, now.statistics, basis, same_configurations, limits);
    }
    if (basis.times) {
      compare_times(changes, relative_time(old_rows, old, limits.baseline),
                    relative_time(new_rows, now, limits.baseline), limits.time_factor);
      compare_instructions(changes, old, now, limits.time_factor);
    }
  }
}

/// By how much a change differs from none, either way; a change without a factor is the largest.
double size_of(const Change& change) {
  return change.factor.value_or(0) == 0 ? INFINITY : std::abs(std::log(*change.factor));
}

Comparison::Side side(const Report& report) {
  return {report.version, report.seed, report.configurations, report.partial, report.machine};
}

}  // namespace

const char* verdict_name(Verdict verdict) {
  constexpr std::array names = {"worse", "slower", "better", "faster"};
  return names[static_cast<std::size_t>(verdict)];
}

bool Comparison::has_regressed() const {
  return std::any_of(changes.begin(), changes.end(), [this](const Change& c) {
    return c.beyond_limits &&
           (c.verdict == Verdict::worse || (c.verdict == Verdict::slower && limits.time_counts));
  });
}

Comparison compare(const Report& before, const Report& after, const CompareLimits& limits) {
  Basis basis = basis_of(before, after, limits.baseline);
  remark_stopped(basis, before, after);
  Comparison result{side(before), side(after), limits, basis.remarks, 0, {}};
  if (basis.same_configurations) compare_rows(result, before.results, after.results, basis, true);
  compare_rows(result, before.summary, after.summary, basis, !basis.same_configurations);
  if (result.compared == 0 && (before.is_old || after.is_old) && !basis.same_configurations) {
    throw InvalidInput(before.is_old ? "OLD" : "NEW", "of schema 1",
                       "must be made again with this version of touchstone, for it knows no groups "
                       "and has another seed or count");
  }
  const auto is_scored = [](const ResultRow& row) { return row.statistics.supported() > 0; };
  if (result.compared == 0 && std::ranges::none_of(before.results, is_scored) &&
      std::ranges::none_of(after.results, is_scored)) {
    throw InvalidInput("NEW", "without a scored answer, as OLD is",
                       "must have a candidate with a routine for a pair that was asked");
  }
  if (result.compared == 0) {
    throw InvalidInput("NEW", "of other things",
                       basis.same_configurations
                           ? "must have a candidate and a class in common with OLD, with the same "
                             "configurations"
                           : "must have a candidate and all classes of a group of some pair in "
                             "common with OLD, for its seed or count is another");
  }
  std::stable_sort(result.changes.begin(), result.changes.end(),
                   [](const Change& a, const Change& b) { return size_of(a) > size_of(b); });
  return result;
}

}  // namespace touchstone
