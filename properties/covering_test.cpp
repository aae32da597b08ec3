// The covering array of pose classes, counted from their names alone.
#include <algorithm>
#include <gtest/gtest.h>
#include <set>

#include "properties/pose_classes_test.hpp"

namespace touchstone {
namespace {

TEST(CoveringArray, HasEverySensibleCombination) {
  for (const Pair pair : all_pairs) {
    for (const Coverage coverage : {Coverage::pairs, Coverage::triples}) {
      using Combination = std::set<std::string>;
      std::set<Combination> covered;
      for (const auto& name : pose_classes(pair, coverage)) {
        ClassParts parts = parts_of(pair, name);
        std::vector<std::string> all = parts.modifiers;
        all.push_back(parts.arrangement);
        for (const auto& x : all) {
          for (const auto& y : all) {
            for (const auto& z : all) covered.insert({x, y, z});
          }
        }
      }
      const std::size_t strength = coverage == Coverage::triples ? 3 : 2;
      std::size_t sensible = 0;
      const auto expect = [&](const Arrangement& a, const std::vector<const Modifier*>& modifiers) {
        PoseClass c{pair, &a, {}};
        Combination names = {a.name};
        for (const Modifier* m : modifiers) {
          const int set = c.modifiers[m->kind];
          if (nonsense(pair, a, *m) || (set != 0 && set != m->value)) return;
          c.modifiers[m->kind] = m->value;
          names.insert(m->name);
        }
        ++sensible;
        if (names.size() <= strength) {
          EXPECT_TRUE(covered.contains(names)) << pair_name(pair) << " " << c.name();
        }
        names.erase(a.name);
        EXPECT_TRUE(covered.contains(names)) << pair_name(pair) << " " << c.name();
      };
      for (const Arrangement& a : arrangements(pair)) {
        for (const Modifier& x : all_modifiers()) {
          for (const Modifier& y : all_modifiers()) {
            expect(a, {&x, &y});
            if (coverage == Coverage::pairs) continue;
            for (const Modifier& z : all_modifiers()) expect(a, {&x, &y, &z});
          }
        }
      }
      EXPECT_GT(sensible, 500u) << pair_name(pair);
    }
  }
}

// touchstone-suite-1 has nothing that came after it.
TEST(CoveringArray, OfSuite1IsAsItWas) {
  const struct {
    Pair pair;
    std::size_t count;
  } table[] = {{Pair::plane, 159},
               {Pair::sphere, 146},
               {Pair::capsule, 320},
               {Pair::cylinder, 316},
               {Pair::box, 285}};
  for (const auto& [pair, count] : table) {
    const auto& names = pose_classes(pair, Coverage::suite_1);
    EXPECT_EQ(names.size(), count);
    for (const std::string& name : names) {
      for (const char* later : {"diagonal", "contained", "worn", "needles"}) {
        EXPECT_EQ(name.find(later), name.npos) << name;
      }
    }
  }
}

TEST(CoveringArray, HasEveryArrangementAloneTurnedAndWorn) {
  for (const Pair pair : all_pairs) {
    const auto& names = pose_classes(pair);
    const auto has = [&](const std::string& name) {
      return std::find(names.begin(), names.end(), name) != names.end();
    };
    for (const Arrangement& a : arrangements(pair)) {
      if (a.name == "hostile") continue;
      EXPECT_TRUE(has(a.name)) << a.name;
      for (const char* frame : {"+turned", "+worn"}) {
        EXPECT_NE(has(a.name + frame), !has_class(pair, a.name + frame)) << a.name;
      }
    }
  }
}

}  // namespace
}  // namespace touchstone
