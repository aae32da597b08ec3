#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <rapidcheck.h>

#include <nlohmann/json.hpp>

#include "candidates/candidates.hpp"
#include "properties/files/disk.hpp"
#include "properties/files/own_folder_test.hpp"
#include "reference/invalid_input.hpp"
#include "reports/campaigns/made_up_test.hpp"
#include "reports/campaigns/shard.hpp"
#include "reports/terminal.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::ThrowsMessage;

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
      const std::uint64_t size = unit.last - unit.first;
      RC_ASSERT(size >= 1u && size <= Unit::max_size);
      RC_ASSERT(size == cut.count / cut.of_cell().units() + (number < cut.first_smaller()));
      reached[unit.cell] = unit.last;
    }
    RC_ASSERT(reached.size() == cut.cells);
    for (const auto& [cell, last] : reached) RC_ASSERT(last == cut.count);
  }));
}

TEST(Units, OfAllRunsAreAllUnitsOnce) {
  EXPECT_TRUE(rc::check([] {
    const Cut cut = arbitrary_cut();
    std::uint64_t first = 0;
    for (std::uint64_t run = 0; run < cut.runs(); ++run) {
      const UnitRun units = cut.run(first);
      RC_ASSERT(!units.empty());
      std::uint64_t size = 0;
      for (const Unit& unit : units) {
        const Unit expected = cut.unit(first);
        RC_ASSERT(unit.cell == expected.cell && unit.first == expected.first &&
                  unit.last == expected.last);
        size += unit.last - unit.first;
        ++first;
      }
      RC_ASSERT(size <= run_size);
      RC_ASSERT(first == cut.units() || units.size() == cut.run_length());
    }
    RC_ASSERT(first == cut.units());
  }));
}

TEST(Units, OfManySmallCellsAreScoredTogether) {
  EXPECT_EQ((Cut{300, 1}.runs()), 1u);
  EXPECT_EQ((Cut{300, 10}.run_length()), 102u);
  EXPECT_EQ((Cut{300, 10}.runs()), 3u);
  EXPECT_EQ((Cut{300, 512}.run_length()), 2u);
  EXPECT_EQ((Cut{300, 520}.run_length()), 3u);  // of 260, not one of 512 and one of 8
  EXPECT_EQ((Cut{300, 1000000}.run_length()), 2u);
}

TEST(Units, AreWholeRunsOrNot) {
  const Cut cut{5, 100};  // ten units of a cell each would make a run
  const Cut pairs{5, 512};
  const auto units = [](std::uint64_t first, std::uint64_t last) {
    UnitSet set;
    set += UnitSet::interval_type(first, last);
    return set;
  };
  EXPECT_TRUE(are_whole_runs(cut, {}));
  EXPECT_TRUE(are_whole_runs(cut, units(0, 5)));
  EXPECT_FALSE(are_whole_runs(cut, units(0, 4)));
  EXPECT_TRUE(are_whole_runs(pairs, units(2, 4)));
  EXPECT_TRUE(are_whole_runs(pairs, units(4, 5)));
  EXPECT_FALSE(are_whole_runs(pairs, units(1, 4)));
  EXPECT_FALSE(are_whole_runs(pairs, units(2, 3)));
}

TEST(Units, OfAllShardsAreAllUnitsOnce) {
  EXPECT_TRUE(rc::check([] {
    const Cut cut = arbitrary_cut();
    const auto of = *rc::gen::inRange<std::uint64_t>(1, 30);
    UnitSet all;
    const std::uint64_t length = cut.run_length();
    std::uint64_t sum = 0, min = cut.runs(), max = 0, smallest = cut.cells * cut.count, largest = 0;
    for (std::uint64_t number = 1; number <= of; ++number) {
      const UnitSet part = Shard{number, of}.units(cut);
      RC_ASSERT(!boost::icl::intersects(all, part));
      RC_ASSERT(are_whole_runs(cut, part));
      all += part;
      sum += configurations(cut, part);
      smallest = std::min(smallest, configurations(cut, part));
      largest = std::max(largest, configurations(cut, part));
      const std::uint64_t runs = (boost::icl::cardinality(part) + length - 1) / length;
      min = std::min(min, runs);
      max = std::max(max, runs);
    }
    RC_ASSERT(all == Shard{}.units(cut));
    RC_ASSERT(sum == cut.cells * cut.count);
    RC_ASSERT(max - min <= 1u);
    RC_ASSERT(largest - smallest <= 2 * run_size + largest / 257);  // the last run may be short
  }));
}

TEST(Units, AreCountedAndNumberedInSets) {
  const Cut cut{2, 601};  // units of 301, 301, 300, 300
  UnitSet set;
  set += UnitSet::interval_type(0, 1);
  set += UnitSet::interval_type(2, 4);
  EXPECT_EQ(configurations(cut, set), 301u + 300 + 300);
  EXPECT_EQ(nth(set, 0), 0u);
  EXPECT_EQ(nth(set, 1), 2u);
  EXPECT_EQ(nth(set, 2), 3u);
  EXPECT_THROW(nth(set, 3), std::logic_error);
  EXPECT_EQ(to_json(set).dump(), "[[0,1],[2,4]]");
  EXPECT_EQ(unit_set_from_json(to_json(set)), set);
}

TEST(Units, AreCountedByCells) {
  EXPECT_TRUE(rc::check([] {
    const Cut cut = arbitrary_cut();
    UnitSet set;
    std::vector<std::uint64_t> expected(cut.cells);
    for (std::uint64_t number = 0; number < cut.units(); ++number) {
      if (*rc::gen::inRange(0, 4) == 0) continue;
      set += UnitSet::interval_type(number, number + 1);
      const Unit unit = cut.unit(number);
      expected[unit.cell] += unit.last - unit.first;
    }
    RC_ASSERT(configurations_by_cell(cut, set) == expected);
  }));
}

TEST(Plans, HaveRoomForTheCoverageOfAllClasses) {
  Campaign all{.pairs = {std::begin(all_pairs), std::end(all_pairs)},
               .coverage = Coverage::triples};
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

/// Units first … last − 1.
ShardState part_of(const json& plan, std::uint64_t first, std::uint64_t last) {
  return made_up_part(plan, Shard{}, UnitSet(UnitSet::interval_type(first, last)));
}
ShardState part(std::uint64_t first, std::uint64_t last, std::uint64_t seed = 1) {
  return part_of(made_up_plan(1000, seed), first, last);
}

std::string merged(const std::vector<ShardState>& parts) {
  Merge merge;
  for (const ShardState& p : parts) merge.add(p, "part");
  return campaign_json(merge.whole(false));
}

TEST(Merge, DoesNotDependOnTheSplitNorOnTheOrder) {
  const std::string whole = merged({part(0, 4)});
  EXPECT_EQ(merged({part(0, 2), part(2, 4)}), whole);
  EXPECT_EQ(merged({part(3, 4), part(1, 3), part(0, 1)}), whole);
  EXPECT_EQ(json::parse(whole)["configurations"], 2000);
  EXPECT_EQ(json::parse(whole)["summary"][4]["outcomes"]["shallow"], 400);
}

TEST(Merge, OfACandidateThatHangsIsTheSameForEverySplit) {
  add_file(TOUCHSTONE_TEST_PLUGINS "/touchstone-sabotage.so");
  Campaign campaign{.pairs = {Pair::sphere},
                    .classes = {"touching", "cap"},
                    .candidates = find_candidates({"reference", "misdeed:5"})};
  campaign.limits.seconds = 0.01;
  campaign.count = Unit::max_size + 20;
  const Plan plan = make_plan(campaign, "x");
  const OwnFolder own;
  const auto split = [&](std::uint64_t shards, unsigned workers) {
    campaign.workers = workers;
    Merge merge;
    for (std::uint64_t number = 1; number <= shards; ++number) {
      ShardState state(plan, {number, shards});
      const std::filesystem::path file = own.path / "shard";
      EXPECT_TRUE(run_shard(campaign, state, file, {.progress = false}, [] { return true; }));
      merge.add(read_shard(file, "file"), "file");
    }
    return campaign_json(merge.whole(false));
  };
  const std::string whole = split(1, 2);
  EXPECT_EQ(split(3, 1), whole);
  for (const json& row : json::parse(whole)["results"]) {
    if (row["candidate"] == "reference") continue;
    // Three in each of two units.
    EXPECT_EQ(row["outcomes"], json({{"timed-out", 6}, {"not-asked", 526}}));
  }
}

TEST(Merge, ReadsAShardThatIsLargerThanOtherFiles) {
  Campaign campaign{.pairs = {Pair::sphere},
                    .classes = {"cap"},
                    .candidates = find_candidates({"reference"}),
                    .count = 1};
  std::string text = to_text(ShardState(make_plan(campaign, "x"), {}));
  text.resize(text.size() - 9);  // without its checksum
  text.insert(text.find('\n'), max_file_size, ' ');
  text += checksum(text) + '\n';
  const OwnFolder own;
  EXPECT_EQ(read_shard(own.with("large", text), "file").plan.candidates,
            std::vector<std::string>{"reference"});
  EXPECT_THROW(read_shard("/dev/zero", "file"), InvalidInput);
}

TEST(Merge, SumsUpByGroupsAlone) {
  const json result = json::parse(merged({part(0, 4)}));
  ASSERT_EQ(result["summary"].size(), 6u);
  for (const json& row : result["summary"]) EXPECT_EQ(row["class"], "everyday");
  EXPECT_EQ(result["classes"][1]["arrangement"], "rim-face");
  for (const json& worst : result["worst"]) EXPECT_EQ(worst["group"], "everyday");
}

TEST(Merge, RefusesWhatOverlapsWhatIsMissingAndWhatIsForeign) {
  const auto expect_refused = [](const std::vector<ShardState>& parts, const char* why) {
    EXPECT_THAT([&] { merged(parts); }, ThrowsMessage<InvalidInput>(HasSubstr(why)));
  };
  expect_refused({part(0, 3), part(2, 4)},
                 "cylinder-sphere/general+shallow, configurations 500 to 999");
  expect_refused({part(0, 1), part(2, 4)},
                 "500 of 2000 configurations are missing, the first of them cylinder-box/rim-face");
  expect_refused({part(0, 1), part(1, 4, 2)}, "seed is 2, not 1");
  expect_refused({}, "");
}

TEST(Merge, RefusesPartsThatAreCutIntoUnitsOfAnotherSize) {
  json other = made_up_plan();
  other["unit_size"] = 2 * Unit::max_size;
  EXPECT_THAT([&] { plan_from_json(other); },
              ThrowsMessage<InvalidInput>(HasSubstr("campaign.unit_size is 1024")));
  other = made_up_plan();
  other.erase("run_size");  // one of before units were joined to runs
  EXPECT_THAT([&] { plan_from_json(other); },
              ThrowsMessage<InvalidInput>(HasSubstr("campaign.run_size")));
}

TEST(Merge, MarksWhatDoesNotRunAsNativeCode) {
  const Report report = campaign_result(part(0, 4));
  EXPECT_EQ(report.candidates[0].runs, "native");
  EXPECT_EQ(report.candidates[1].runs, "wasm");
  EXPECT_THAT(terminal_table(report), HasSubstr("two* "));
}

TEST(Merge, MarksWhatIsPartial) {
  Merge merge;
  merge.add(part(1, 3), "part");
  const json result = json::parse(campaign_json(merge.whole(true)));
  EXPECT_EQ(result["complete"], false);
  EXPECT_EQ(result["configurations"], 500 + 500);
}

TEST(ShardFile, IsReadBackToTheLastBit) {
  const std::string text = to_text(part(0, 2));
  EXPECT_EQ(to_text(shard_from_text(text, "file")), text);
}

TEST(ShardFile, IsRefusedWhenCountsBelongToAnotherClass) {
  json three = made_up_plan();
  three["classes"].push_back({{"pair", "cylinder-plane"}, {"class", "lying"}});
  // Two runs: both units of the first class, one of the others.
  ShardState state = part_of(three, 0, 4);
  EXPECT_EQ(to_text(shard_from_text(to_text(state), "file")), to_text(state));
  std::swap(state.samples[0], state.samples[1]);
  EXPECT_THAT([&] { shard_from_text(to_text(state), "file"); },
              ThrowsMessage<InvalidInput>(HasSubstr("counts of something else than what is done")));
}

// Answers of its units would come from another session than in a campaign that was never stopped.
TEST(ShardFile, IsRefusedWhenItHasAPartOfARun) {
  EXPECT_THAT([] { shard_from_text(to_text(part(0, 3)), "file"); },
              ThrowsMessage<InvalidInput>(HasSubstr("a run done in part")));
}

TEST(ShardFile, IsRefusedWhenAnythingInItHasChanged) {
  const std::string text = to_text(part(0, 2));
  const auto refused = [](const std::string& damaged) {
    EXPECT_THAT([&] { shard_from_text(damaged, "file"); },
                ThrowsMessage<InvalidInput>(HasSubstr("\"file\" is damaged")));
  };
  for (std::size_t size = 0; size < text.size(); size += 1 + text.size() / 200) {
    refused(text.substr(0, size));
  }
  refused(text.substr(0, text.size() - 1));
  for (std::size_t at = 0; at < text.size(); at += 1 + text.size() / 200) {
    std::string damaged = text;
    damaged[at] = static_cast<char>(damaged[at] ^ 1);
    refused(damaged);
  }
  refused(text + "\n");
  refused(text + text);
  refused("{\"schema\":1}\n");
}

TEST(ShardFile, IsRefusedWhenItIsIntactButSomethingElse) {
  const std::string text = to_text(part(0, 2));
  const std::string whole = text.substr(0, text.size() - 9);  // without its checksum
  const std::string head = whole.substr(0, whole.find('\n') + 1);
  for (const std::string& body :
       {std::string("{\"schema\":\"touchstone-shard-9\"}\n"), std::string("{}\n"),
        std::string("[]\n"), std::string("no JSON\n"),
        std::string("{\"schema\":\"touchstone-shard-4\",\"shard\":[1,1],") +
            "\"done\":[],\"campaign\":{}}\n",
        head, head + std::string(64, '\xff'), whole + 'x'}) {
    EXPECT_THROW(shard_from_text(body + checksum(body) + '\n', "file"), InvalidInput) << body;
  }
}

TEST(Checksum, IsTheOneOfZipAndPng) { EXPECT_EQ(checksum("123456789"), "cbf43926"); }

}  // namespace
}  // namespace touchstone
