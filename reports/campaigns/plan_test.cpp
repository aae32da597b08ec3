#include "reports/campaigns/plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <rapidcheck.h>

#include <nlohmann/json.hpp>

#include "reference/invalid_input.hpp"
#include "reports/campaigns/shard.hpp"

namespace touchstone {
namespace {

Cut arbitrary_cut() {
  return {*rc::gen::inRange<std::uint64_t>(1, 7), *rc::gen::inRange<std::uint64_t>(1, 3000)};
}

TEST(Units, HoldEveryConfigurationOnce) {
  EXPECT_TRUE(rc::check([] {
    const Cut cut = arbitrary_cut();
    std::map<std::size_t, std::uint64_t> reached;  // of each cell
    for (std::uint64_t number = 0; number < cut.units(); ++number) {
      const Unit unit = cut.unit(number);
      RC_ASSERT(unit.first == reached[unit.cell]);
      RC_ASSERT(unit.last > unit.first);
      reached[unit.cell] = unit.last;
    }
    RC_ASSERT(reached.size() == cut.cells);
    for (const auto& [cell, last] : reached) RC_ASSERT(last == cut.count);
  }));
}

TEST(Units, OfAllShardsAreAllUnitsOnce) {
  EXPECT_TRUE(rc::check([] {
    const Cut cut = arbitrary_cut();
    const auto of = *rc::gen::inRange<std::uint64_t>(1, 30);
    UnitSet all;
    std::uint64_t sum = 0, min = cut.units(), max = 0;
    for (std::uint64_t number = 1; number <= of; ++number) {
      const UnitSet part = Shard{number, of}.units(cut);
      RC_ASSERT(!boost::icl::intersects(all, part));
      all += part;
      sum += configurations(cut, part);
      min = std::min<std::uint64_t>(min, boost::icl::cardinality(part));
      max = std::max<std::uint64_t>(max, boost::icl::cardinality(part));
    }
    RC_ASSERT(all == Shard{}.units(cut));
    RC_ASSERT(sum == cut.cells * cut.count);
    RC_ASSERT(max - min <= 1u);
  }));
}

TEST(Units, AreCountedAndNumberedInSets) {
  const Cut cut{2, 600};  // units of 512, 512, 88, 88
  UnitSet set;
  set += UnitSet::interval_type(0, 1);
  set += UnitSet::interval_type(2, 4);
  EXPECT_EQ(configurations(cut, set), 512u + 88 + 88);
  EXPECT_EQ(nth(set, 0), 0u);
  EXPECT_EQ(nth(set, 1), 2u);
  EXPECT_EQ(nth(set, 2), 3u);
  EXPECT_THROW(nth(set, 3), std::logic_error);
  EXPECT_EQ(to_json(set).dump(), "[[0,1],[2,4]]");
  EXPECT_EQ(unit_set_from_json(to_json(set)), set);
}

TEST(Plans, HaveRoomForTheCoverageOfAllClasses) {
  Campaign all;
  all.pairs = {std::begin(all_pairs), std::end(all_pairs)};
  const double one = 1 / CoverageTally::unit;
  const double sum = static_cast<double>(Plan::max_count * cells(all).size()) * one;
  EXPECT_LT(sum, 0x1p64);
}

TEST(Shards, AreReadOrRefused) {
  EXPECT_EQ(parse_shard("3/7"), (Shard{3, 7}));
  EXPECT_EQ(to_string(Shard{3, 7}), "3/7");
  for (const char* bad : {"", "3", "3/", "/7", "0/7", "8/7", "3/7/1", "-1/7", "1.5/7", "a/b"}) {
    EXPECT_THROW(parse_shard(bad), InvalidInput) << bad;
  }
}

}  // namespace
}  // namespace touchstone
