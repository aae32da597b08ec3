// Covering arrays, made greedily as by AETG (Cohen, Dalal, Fredman and Patton, "The AETG system",
// IEEE Transactions on Software Engineering 23, 1997), but without randomness.
#include <algorithm>
#include <array>
#include <limits>
#include <set>

#include "properties/pose_class.hpp"

namespace touchstone {
namespace {

/// An arrangement or a modifier.
struct Element {
  const Arrangement* arrangement = nullptr;
  const Modifier* modifier = nullptr;
  std::uint32_t number;  ///< in report order
};

/// Elements of which a class may have one each; arrangements come first.
using Factor = std::vector<Element>;

/// Those that the suite with that number may have.
std::vector<Factor> factors_of(Pair pair, int suite) {
  std::vector<Factor> factors(1 + modifier_kinds);
  std::uint32_t number = 0;
  for (const Arrangement& a : arrangements(pair)) {
    using enum Arrangement::Orientations;
    if (a.orientations == mixed || a.orientations == recorded || a.suite > suite) continue;
    factors[0].push_back({&a, nullptr, ++number});
  }
  for (const Modifier& m : all_modifiers()) {
    if (m.suite > suite) continue;
    factors[1 + static_cast<std::size_t>(m.kind)].push_back({nullptr, &m, ++number});
  }
  return factors;
}

class Covering {
 public:
  Covering(Pair pair, std::size_t strength, int suite)
      : pair_(pair), strength_(strength), factors_(factors_of(pair, suite)) {
    collect({}, 0);
  }

  std::vector<PoseClass> classes() {
    if (factors_[0].empty()) return {};  // of a pair that came after the suite
    for (const PoseClass& c : old_classes(pair_)) add(c);
    for (const Element& e : factors_[0]) add({pair_, e.arrangement, {}});
    for (const ModifierKind kind : {ModifierKind::frame, ModifierKind::hull}) {
      for (const Element& e : factors_[0]) {
        for (const Element& m : factors_[1 + static_cast<std::size_t>(kind)]) {
          if (makes_sense({&e, &m})) add(class_of({&e, &m}));
        }
      }
    }
    while (!uncovered_.empty()) add(class_of(best_row()));
    for (const Arrangement& a : arrangements(pair_)) {
      if (a.orientations == Arrangement::Orientations::recorded)
        classes_.push_back({pair_, &a, {}});
    }
    return std::move(classes_);
  }

 private:
  using Row = std::vector<const Element*>;
  using Combination = std::array<std::uint32_t, 3>;  ///< numbers in order; zero: none

  /// Whether all modifiers make sense of the arrangement or, without one, of any.
  bool makes_sense(const Row& row) const {
    const auto all_fit = [&](const Arrangement& a) {
      return std::all_of(row.begin(), row.end(), [&](const Element* e) {
        return e->modifier == nullptr || !nonsense(pair_, a, *e->modifier);
      });
    };
    for (const Element* e : row) {
      if (e->arrangement != nullptr) return all_fit(*e->arrangement);
    }
    return std::any_of(factors_[0].begin(), factors_[0].end(),
                       [&](const Element& e) { return all_fit(*e.arrangement); });
  }

  static Combination combination(const Row& elements) {
    Combination c{};
    for (std::size_t i = 0; i < elements.size(); ++i) c[i] = elements[i]->number;
    std::sort(c.begin(), c.begin() + static_cast<std::ptrdiff_t>(elements.size()));
    return c;
  }

  /// Calls `each` with every combination of the row's elements that contains those already chosen.
  template <class Each>
  void for_combinations(const Row& row, std::size_t from, Row& chosen, const Each& each) const {
    if (chosen.size() == strength_) {
      each(combination(chosen));
      return;
    }
    for (std::size_t i = from; i < row.size(); ++i) {
      chosen.push_back(row[i]);
      for_combinations(row, i + 1, chosen, each);
      chosen.pop_back();
    }
  }

  /// All sensible combinations that begin with the elements in `chosen`.
  void collect(const Row& chosen, std::size_t from) {
    if (chosen.size() == strength_) {
      if (makes_sense(chosen)) uncovered_.insert(combination(chosen));
      return;
    }
    for (std::size_t f = from; f < factors_.size(); ++f) {
      for (const Element& e : factors_[f]) {
        Row longer = chosen;
        longer.push_back(&e);
        collect(longer, f + 1);
      }
    }
  }

  Row row_of(const PoseClass& c) const {
    Row row;
    for (const Factor& factor : factors_) {
      for (const Element& e : factor) {
        const bool has =
            e.arrangement ? e.arrangement == c.arrangement : c.modifiers.has(*e.modifier);
        if (has) row.push_back(&e);
      }
    }
    return row;
  }

  PoseClass class_of(const Row& row) const {
    PoseClass c{pair_, nullptr, {}};
    for (const Element* e : row) {
      if (e->arrangement != nullptr) {
        c.arrangement = e->arrangement;
      } else {
        c.modifiers[e->modifier->kind] = e->modifier->value;
      }
    }
    return c;
  }

  void add(const PoseClass& c) {
    const auto same = [&](const PoseClass& other) {
      return other.arrangement == c.arrangement && other.modifiers == c.modifiers;
    };
    if (std::any_of(classes_.begin(), classes_.end(), same)) return;
    Row chosen;
    for_combinations(row_of(c), 0, chosen, [&](const Combination& k) { uncovered_.erase(k); });
    classes_.push_back(c);
  }

  /// How many combinations that are not covered yet `element` would cover beside the row's.
  std::size_t gain(const Row& row, const Element& element) const {
    std::size_t count = 0;
    Row chosen = {&element};
    for_combinations(row, 0, chosen, [&](const Combination& k) { count += uncovered_.count(k); });
    return count;
  }

  bool has_factor(const Row& row, const Factor& factor) const {
    return std::any_of(factor.begin(), factor.end(), [&](const Element& e) {
      return std::find(row.begin(), row.end(), &e) != row.end();
    });
  }

  /// Begins with the first combination that is not covered, and adds what covers most. With few
  /// modifiers in a class, what makes a candidate fail in it can be told.
  Row best_row() const {
    Row row = first_uncovered();
    const std::size_t max_modifiers = strength_ + 1;
    for (;;) {
      const Element* best = nullptr;
      std::size_t most = 0;
      const bool needs_arrangement = !has_factor(row, factors_[0]);
      const std::size_t modifiers = row.size() - (needs_arrangement ? 0 : 1);
      for (std::size_t f = 0; f < factors_.size(); ++f) {
        if (has_factor(row, factors_[f]) || (f > 0 && modifiers == max_modifiers)) continue;
        for (const Element& e : factors_[f]) {
          Row longer = row;
          longer.push_back(&e);
          if (!makes_sense(longer)) continue;
          const std::size_t g = gain(row, e);
          if (g > most || (best == nullptr && needs_arrangement && f == 0)) {
            best = &e;
            most = g;
          }
        }
      }
      if (best == nullptr) return row;
      row.push_back(best);
    }
  }

  Row first_uncovered() const {
    Row row;
    for (const std::uint32_t number : *uncovered_.begin()) {
      for (const Factor& factor : factors_) {
        for (const Element& e : factor) {
          if (e.number == number) row.push_back(&e);
        }
      }
    }
    return row;
  }

  Pair pair_;
  std::size_t strength_;
  std::vector<Factor> factors_;
  std::set<Combination> uncovered_;
  std::vector<PoseClass> classes_;
};

/// Made when it is first asked for.
template <std::size_t strength, int suite = std::numeric_limits<int>::max()>
const std::vector<PoseClass>& covering(Pair pair) {
  static const auto all = [] {
    std::array<std::vector<PoseClass>, std::size(all_pairs)> result;
    for (const Pair p : all_pairs) {
      result[static_cast<std::size_t>(p)] = Covering(p, strength, suite).classes();
    }
    return result;
  }();
  return all[static_cast<std::size_t>(pair)];
}

}  // namespace

const std::vector<PoseClass>& covering_classes(Pair pair, Coverage coverage) {
  if (coverage == Coverage::suite_1) return covering<2, 1>(pair);
  if (coverage == Coverage::suite_2) return covering<2, 3>(pair);
  return coverage == Coverage::triples ? covering<3>(pair) : covering<2>(pair);
}

}  // namespace touchstone
