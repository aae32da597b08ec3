#include "reports/factors.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <map>
#include <set>
#include <utility>

#include "properties/pose_class.hpp"
#include "reports/replay.hpp"

namespace touchstone {
namespace {

using ModifierNames = std::set<std::string>;

/// A class of one pair, taken apart.
struct ClassOfPair {
  const PoseClassDescription* description;
  ModifierNames modifiers;
  /// The modifiers, and "turned" where the arrangement's orientations are random anyway.
  std::string conditions;
  const ResultRow* row = nullptr;  ///< of the candidate in hand, if it has a routine
};

constexpr const char *turned = "turned", *aligned = "aligned";

bool is_tilt(const std::string& modifier) { return modifier.starts_with("tilted-"); }

FailureRate rate_of(const Statistics& s) { return {s.asked(), s.asked() - s.agreeing()}; }

FailureRate operator+(const FailureRate& a, const FailureRate& b) {
  return {a.count + b.count, a.failed + b.failed};
}

/// The rows of one candidate and pair, by class, of what it has a routine for.
class Table {
 public:
  Table(const Report& report, const std::string& pair) : report_(report), pair_(pair) {
    for (const PoseClassDescription& c : report.classes) {
      if (c.pair == pair && c.group != group_name(Group::given)) classes_.push_back(taken_apart(c));
    }
  }

  void take(const std::string& candidate) {
    candidate_ = candidate;
    std::map<std::string, const ResultRow*> rows;
    for (const ResultRow& row : report_.results) {
      if (row.pair != pair_ || row.candidate != candidate) continue;
      if (rate_of(row.statistics).count > 0) rows[row.pose_class] = &row;
    }
    for (ClassOfPair& c : classes_) c.row = rows[c.description->pose_class];
  }

  const std::string& pair() const { return pair_; }
  const std::string& candidate() const { return candidate_; }
  /// All classes, those without a row, too.
  const std::vector<ClassOfPair>& classes() const { return classes_; }

  /// The sum of the rates of the classes for which this holds.
  template <class Holds>
  FailureRate sum(const Holds& holds) const {
    FailureRate result;
    for (const ClassOfPair& c : classes_) {
      if (c.row && holds(c)) result = result + rate_of(c.row->statistics);
    }
    return result;
  }
  /// The identity of the worst failure in these classes: in the class with the highest rate.
  std::string worst(const std::vector<const ClassOfPair*>& classes) const {
    const ResultRow* worst = nullptr;
    for (const ClassOfPair* c : classes) {
      if (!c->row || !c->row->worst_index) continue;
      if (!worst || rate_of(worst->statistics).share() < rate_of(c->row->statistics).share()) {
        worst = c->row;
      }
    }
    if (!worst) return "";
    return fmt::format("{}/{}/{}/{}", pair_, worst->pose_class, report_.seed, *worst->worst_index);
  }

 private:
  static ClassOfPair taken_apart(const PoseClassDescription& c) {
    ClassOfPair result{&c, {c.modifiers.begin(), c.modifiers.end()}, {}};
    ModifierNames conditions = result.modifiers;
    const auto orientations = PoseClass(parse_pair(c.pair), c.pose_class).arrangement->orientations;
    if (orientations == Arrangement::Orientations::random ||
        orientations == Arrangement::Orientations::nearly) {
      conditions.insert(turned);
    }
    result.conditions = fmt::format("{}", fmt::join(conditions, "+"));
    return result;
  }

  const Report& report_;
  std::string pair_, candidate_;
  std::vector<ClassOfPair> classes_;
};

/// The classes that have something, and what they are compared with.
struct Comparison {
  FailureRate with;
  double weighted = 0;  ///< sum of the compared rates, each times the count of its class
  std::vector<const ClassOfPair*> classes;

  void add(const ClassOfPair& c, const FailureRate& of_class, const FailureRate& others) {
    if (others.count == 0) return;
    with = with + of_class;
    weighted += others.share() * static_cast<double>(of_class.count);
    classes.push_back(&c);
  }
  double without() const { return weighted / static_cast<double>(with.count); }
  /// By how much the rate is higher, less two standard errors of the rate of as many
  /// configurations. Half a failure is added to either kind, so that a rate of zero or one has an
  /// error, too (Agresti and Coull, "Approximate is better than exact", 1998, in spirit).
  double surplus() const {
    const auto n = static_cast<double>(with.count);
    const double p = (static_cast<double>(with.failed) + 0.5) / (n + 1);
    return with.share() - without() - 2 * std::sqrt(p * (1 - p) / n);
  }
};

FailureRate rate_without(const Table& table, const ClassOfPair& c, const std::string& modifier) {
  ModifierNames rest = c.modifiers;
  rest.erase(modifier);
  const auto difference = [&](const ClassOfPair& other) {
    const auto common = std::count_if(rest.begin(), rest.end(), [&](const std::string& each) {
      return other.modifiers.contains(each);
    });
    return rest.size() + other.modifiers.size() - 2 * static_cast<std::size_t>(common);
  };
  const auto is_without = [&](const ClassOfPair& other) {
    return other.description->arrangement == c.description->arrangement &&
           !other.modifiers.contains(modifier);
  };
  std::size_t least = SIZE_MAX;
  for (const ClassOfPair& other : table.classes()) {
    if (other.row && is_without(other)) least = std::min(least, difference(other));
  }
  return table.sum(
      [&](const ClassOfPair& other) { return is_without(other) && difference(other) == least; });
}

FailureRate rate_of_others(const Table& table, const ClassOfPair& c) {
  return table.sum([&](const ClassOfPair& other) {
    return other.description->arrangement != c.description->arrangement &&
           other.conditions == c.conditions;
  });
}

/// Adds the one with the largest surplus, if any has one.
void add_strongest(std::vector<Factor>& result, const Table& table, const std::string& group,
                   Factor::Kind kind, const std::map<std::string, Comparison>& by_name) {
  const auto strongest = std::max_element(
      by_name.begin(), by_name.end(),
      [](const auto& a, const auto& b) { return a.second.surplus() < b.second.surplus(); });
  if (strongest == by_name.end() || strongest->second.surplus() <= 0) return;
  const auto& [name, comparison] = *strongest;
  result.push_back({table.pair(), table.candidate(), group, kind, name, comparison.with,
                    comparison.without(), table.worst(comparison.classes)});
}

void add_factors(std::vector<Factor>& result, const Table& table, const std::string& group) {
  std::map<std::string, Comparison> arrangements, modifiers;
  for (const ClassOfPair& c : table.classes()) {
    if (!c.row || c.description->group != group) continue;
    const FailureRate rate = rate_of(c.row->statistics);
    arrangements[c.description->arrangement].add(c, rate, rate_of_others(table, c));
    for (const std::string& modifier : c.modifiers) {
      modifiers[modifier].add(c, rate, rate_without(table, c, modifier));
    }
  }
  for (auto* by_name : {&arrangements, &modifiers}) {
    std::erase_if(*by_name, [](const auto& entry) { return entry.second.with.count == 0; });
  }
  add_strongest(result, table, group, Factor::Kind::arrangement, arrangements);
  add_strongest(result, table, group, Factor::Kind::modifier, modifiers);
}

/// Adds the contrast of a class and the same with one modifier.
void add_contrast(std::vector<Contrast>& result, const Table& table, const ClassOfPair& plain,
                  const ClassOfPair& modified) {
  const FailureRate before = rate_of(plain.row->statistics);
  const FailureRate after = rate_of(modified.row->statistics);
  // A candidate that fails one in five of the plain ones does not pass them. Of the thousands of
  // contrasts of a report, less than one in a thousand is to be pointed out by chance. Ten in a
  // hundred is what a reader should care for, however sure it is in a long run.
  constexpr double passes = 0.2, max_chance = 1e-3, min_surplus = 0.1;
  const double p_value = chance(before, after);
  const bool fails = before.share() <= passes && p_value < max_chance &&
                     after.share() - before.share() >= min_surplus;
  result.push_back({table.pair(), table.candidate(), plain.description->arrangement,
                    plain.description->pose_class, *modified.modifiers.begin(), before, after,
                    p_value, fails, table.worst({&modified})});
}

/// Turned ones are compared with those along the world's axes, where there are such: a frame of
/// integers is as good as turned to many engines.
void add_contrasts(std::vector<Contrast>& result, const Table& table) {
  const auto find = [&](const std::string& arrangement, const ModifierNames& modifiers) {
    const auto& all = table.classes();
    const auto found = std::find_if(all.begin(), all.end(), [&](const ClassOfPair& c) {
      return c.row && c.description->arrangement == arrangement && c.modifiers == modifiers;
    });
    return found == all.end() ? nullptr : &*found;
  };
  std::set<std::string> done;
  for (const ClassOfPair& each : table.classes()) {
    const std::string& arrangement = each.description->arrangement;
    if (!done.insert(arrangement).second) continue;
    const ClassOfPair* const alone = find(arrangement, {});
    const ClassOfPair* const along_axes = find(arrangement, {aligned});
    const ClassOfPair* const plain = along_axes ? along_axes : alone;
    const ClassOfPair* const in_any_frame = find(arrangement, {turned});
    if (plain && in_any_frame) add_contrast(result, table, *plain, *in_any_frame);
    const ClassOfPair* tilted = nullptr;
    for (const ClassOfPair& c : table.classes()) {
      if (!c.row || c.description->arrangement != arrangement) continue;
      if (c.modifiers.size() != 1 || !is_tilt(*c.modifiers.begin())) continue;
      const auto share = [](const ClassOfPair& t) { return rate_of(t.row->statistics).share(); };
      if (!tilted || share(*tilted) < share(c)) tilted = &c;
    }
    if (alone && tilted) add_contrast(result, table, *alone, *tilted);
  }
}

/// Of every pair and candidate, in report order.
template <class Act>
void each_table(const Report& report, const Act& act) {
  std::vector<std::string> pairs;
  for (const PoseClassDescription& c : report.classes) {
    if (pairs.empty() || pairs.back() != c.pair) pairs.push_back(c.pair);
  }
  for (const std::string& pair : pairs) {
    Table table(report, pair);
    for (const CandidateDescription& candidate : report.candidates) {
      table.take(candidate.name);
      act(table);
    }
  }
}

}  // namespace

double chance(const FailureRate& without, const FailureRate& with) {
  // Hypergeometric: of n = with.count drawn from N configurations, K of which failed, at least
  // with.failed failed. By logarithms of factorials, which do not overflow.
  const auto log_choose = [](std::uint64_t n, std::uint64_t k) {
    const auto log_factorial = [](std::uint64_t m) {
      return std::lgamma(static_cast<double>(m) + 1);
    };
    return log_factorial(n) - log_factorial(k) - log_factorial(n - k);
  };
  const std::uint64_t total = without.count + with.count, failed = without.failed + with.failed;
  const std::uint64_t min_failed = failed > without.count ? failed - without.count : 0;
  const double mean =
      static_cast<double>(with.count) * static_cast<double>(failed) / static_cast<double>(total);
  double sum = 0;
  for (std::uint64_t k = std::max(with.failed, min_failed); k <= std::min(with.count, failed);
       ++k) {
    const double term = std::exp(log_choose(with.count, k) + log_choose(without.count, failed - k) -
                                 log_choose(total, failed));
    sum += term;
    // Above the mean terms fall: of a million configurations few count.
    if (static_cast<double>(k) > mean && term <= 1e-17 * sum) break;
  }
  return std::min(1.0, sum);
}

std::vector<Factor> factors(const Report& report) {
  std::vector<Factor> result;
  each_table(report, [&](const Table& table) {
    for (const Group group : all_groups) add_factors(result, table, group_name(group));
  });
  return result;
}

std::vector<Contrast> contrasts(const Report& report) {
  std::vector<Contrast> result;
  each_table(report, [&](const Table& table) { add_contrasts(result, table); });
  return result;
}

/// Every moving body is turned, few are exactly symmetric, and few are tilted by just so much.
int rarity(const Contrast& c) {
  if (c.modifier != turned) return 2;
  const Group group = PoseClass(parse_pair(c.pair), c.arrangement + '+' + c.modifier).group();
  return group == Group::everyday ? 0 : 1;
}

std::vector<const Contrast*> failing_contrasts(const Report& report) {
  std::vector<const Contrast*> result;
  for (const CandidateDescription& candidate : report.candidates) {
    std::vector<const Contrast*> of_candidate;
    for (const Contrast& c : report.contrasts) {
      if (c.candidate == candidate.name && c.fails) of_candidate.push_back(&c);
    }
    const auto rise = [](const Contrast* c) { return c->modified.share() - c->plain.share(); };
    std::stable_sort(of_candidate.begin(), of_candidate.end(),
                     [&](const Contrast* a, const Contrast* b) { return rise(a) > rise(b); });
    std::map<std::pair<int, std::string>, int> seen;
    std::multimap<std::pair<int, int>, const Contrast*> in_turns;  // equal keys stay in order
    for (const Contrast* c : of_candidate) {
      const int rank = rarity(*c);
      in_turns.insert({{rank, seen[{rank, c->pair}]++}, c});
    }
    for (const auto& [turn, c] : in_turns) result.push_back(c);
  }
  return result;
}

std::string contrast_text(const Contrast& c) {
  const auto agrees = [](const FailureRate& rate) {
    return 100 * (rate.count - rate.failed) / rate.count;
  };
  return fmt::format("{}/{} agrees in {}%, {} in {}%", c.pair, c.plain_class, agrees(c.plain),
                     c.modifier, agrees(c.modified));
}

std::string contrast_command(const Contrast& c) { return replay_command(c.worst, {c.candidate}); }

}  // namespace touchstone
