#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <random>
#include <rapidcheck.h>

#include <nlohmann/json.hpp>

#include "candidates/candidates.hpp"
#include "properties/files/disk.hpp"
#include "reference/invalid_input.hpp"
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
  Campaign all;
  all.pairs = {std::begin(all_pairs), std::end(all_pairs)};
  all.coverage = Coverage::triples;
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

ScoreTally tally_of(const std::vector<Score>& scores, std::size_t first, std::size_t last) {
  ScoreTally tally(Precision::binned);
  for (std::size_t i = first; i < last; ++i) tally.add(3, i, scores[i]);
  return tally;
}
ScoreTally tally_of(const std::vector<Score>& scores) { return tally_of(scores, 0, scores.size()); }

/// Every outcome, errors of any magnitude and sign, present or not.
Score some_score(std::mt19937_64& random) {
  const auto maybe = [&]() -> std::optional<double> {
    if (random() % 2 == 0) return std::nullopt;
    const double fraction = static_cast<double>(random() % 2001) / 1000 - 1;
    return std::ldexp(fraction, static_cast<int>(random() % 90) - 70);
  };
  Score s;
  s.outcome = all_outcomes[random() % all_outcomes.size()];
  for (const ScoreTally::Quantity& quantity : ScoreTally::quantities) s.*quantity.value = maybe();
  if (random() % 2 == 0) s.coverage = static_cast<double>(random() % 101) / 100;
  s.points = static_cast<int>(random() % 9);
  s.severity = static_cast<double>(random() % 4);  // many ties
  return s;
}

TEST(TallyJson, IsReadBackToTheLastBitAndAddsUp) {
  std::mt19937_64 random(1);
  std::vector<Score> scores(300);
  for (Score& s : scores) s = some_score(random);
  ScoreTally sum(Precision::binned);
  for (std::size_t first = 0; first < scores.size(); first += 100) {
    const ScoreTally part = tally_of(scores, first, first + 100);
    sum.add(tally_from_json(json::parse(to_json(part).dump()), 3));
  }
  const json whole = to_json(tally_of(scores));
  EXPECT_EQ(to_json(sum).dump(), whole.dump());
  EXPECT_GT(whole["outcomes"]["not-asked"], 0);
}

TEST(TallyJson, OfAFileWithoutTheDeepestPointHasTheRest) {
  Score s;
  s.depth_error = 0.25;
  json old = to_json(tally_of({s, s}));
  old.erase("deepest_error");
  const Statistics read = tally_from_json(old, 3).statistics();
  EXPECT_FALSE(read.deepest_error);
  EXPECT_EQ(read.depth_error->max, 0.25);
  old.erase("depth_error");
  EXPECT_THROW(tally_from_json(old, 3), InvalidInput);
}

TEST(TallyJson, HasTheLargestDoubleForWhatIsBeyond) {
  Score s;
  s.outcome = Outcome::overdeep;
  s.depth_error = -std::numeric_limits<double>::infinity();
  s.normal_regret = std::numeric_limits<double>::quiet_NaN();
  s.severity = std::numeric_limits<double>::infinity();
  constexpr double largest = std::numeric_limits<double>::max();
  const json written = to_json(tally_of({s}));
  EXPECT_EQ(written["depth_error"]["max"], largest);
  EXPECT_EQ(written["worst"][0]["depth_error"], -largest);
  EXPECT_EQ(written["worst"][0]["severity"], largest);
  EXPECT_EQ(tally_of({s}).statistics().normal_regret->median, largest);
}

/// A plan without plug-ins: parts are made up, not run.
json plan(std::uint64_t seed = 1) {
  return {{"version", "0"},
          {"command", "./touchstone campaign"},
          {"program", "./touchstone"},
          {"seed", seed},
          {"count", 1000},
          {"unit_size", Unit::max_size},
          {"run_size", run_size},
          {"tolerance", 1e-4},
          {"threshold", 0},
          {"classes",
           {{{"pair", "cylinder-sphere"}, {"class", "general-shallow"}},
            {{"pair", "cylinder-box"}, {"class", "rim-face"}}}},
          {"candidates", {{{"name", "one"}}, {{"name", "two"}, {"runs", "wasm"}}}}};
}

/// Units first … last − 1 of it, with scores that follow from their indices.
ShardState part_of(const json& plan, std::uint64_t first, std::uint64_t last) {
  ShardState p(plan_from_json(plan), Shard{});
  for (std::uint64_t number = first; number < last; ++number) {
    const Unit unit = p.plan.cut.unit(number);
    std::vector<ScoreTally> tallies(p.tallies.size(), ScoreTally(Precision::binned));
    for (std::uint64_t i = unit.first; i < unit.last; ++i) {
      for (std::size_t k = 0; k < 2; ++k) {
        Score s;
        s.depth_error = 1e-9 * static_cast<double>((i * 7919 + k) % 1009);
        s.severity = *s.depth_error;
        s.outcome = i % 5 == k ? Outcome::shallow : Outcome::agree;
        tallies[unit.cell * 2 + k].add(unit.cell, i, s);
      }
    }
    UnitSet done;
    done += UnitSet::interval_type(number, number + 1);
    p.add(done, tallies);
  }
  return p;
}

ShardState part(std::uint64_t first, std::uint64_t last, std::uint64_t seed = 1) {
  return part_of(plan(seed), first, last);
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
  Campaign campaign;
  campaign.pairs = {Pair::sphere};
  campaign.classes = {"touching", "cap"};
  campaign.candidates = find_candidates({"reference", "misdeed:5"});
  campaign.limits.seconds = 0.01;
  campaign.count = Unit::max_size + 20;
  const Plan plan = make_plan(campaign, "x");
  const auto split = [&](std::uint64_t shards, unsigned workers) {
    campaign.workers = workers;
    Merge merge;
    for (std::uint64_t number = 1; number <= shards; ++number) {
      ShardState state(plan, {number, shards});
      const std::filesystem::path file = testing::TempDir() + "shard of a candidate that hangs";
      EXPECT_TRUE(run_shard(campaign, state, file, {.progress = false}, [] { return true; }));
      merge.add(read_shard(file, "file"), "file");
      std::filesystem::remove(file);
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
  Campaign campaign;
  campaign.pairs = {Pair::sphere};
  campaign.classes = {"cap"};
  campaign.candidates = find_candidates({"reference"});
  campaign.count = 1;
  std::string text = to_text(ShardState(make_plan(campaign, "x"), {}));
  text.erase(text.rfind('\n', text.size() - 2) + 1);  // its checksum
  text.insert(text.find('\n'), max_file_size, ' ');
  text += json{{"crc32", checksum(text)}}.dump() + '\n';
  const std::filesystem::path file = testing::TempDir() + "a large shard";
  write_file(file, text, "file");
  EXPECT_EQ(read_shard(file, "file").plan.candidates, std::vector<std::string>{"reference"});
  std::filesystem::remove(file);
  EXPECT_THROW(read_shard("/dev/zero", "file"), InvalidInput);
}

TEST(Merge, SumsUpByGroupsAlone) {
  const json result = json::parse(merged({part(0, 4)}));
  ASSERT_EQ(result["summary"].size(), 6u);
  for (const json& row : result["summary"]) EXPECT_EQ(row["class"], "everyday");
  EXPECT_EQ(result["classes"][1]["arrangement"], "rim-face");
  for (const json& worst : result["worst"]) EXPECT_EQ(worst["group"], "everyday");
}

TEST(TallyJson, OfAFileWithoutSignsKnowsNoBias) {
  const ShardState p = part(0, 1);
  json tally = to_json(p.tallies[0]);
  EXPECT_TRUE(tally_from_json(tally, 0).statistics().bias);
  tally.erase("too_deep");
  const Statistics s = tally_from_json(tally, 0).statistics();
  EXPECT_FALSE(s.bias);
  EXPECT_TRUE(s.depth_error);
}

TEST(Merge, RefusesWhatOverlapsWhatIsMissingAndWhatIsForeign) {
  EXPECT_THAT(
      [] {
        merged({part(0, 3), part(2, 4)});
      },
      ThrowsMessage<InvalidInput>(
          HasSubstr("cylinder-sphere/general+shallow, configurations 500 to 999")));
  EXPECT_THAT(
      [] {
        merged({part(0, 1), part(2, 4)});
      },
      ThrowsMessage<InvalidInput>(HasSubstr("500 of 2000 configurations are missing, the "
                                            "first of them cylinder-box/rim-face")));
  EXPECT_THAT(
      [] {
        merged({part(0, 1), part(1, 4, 2)});
      },
      ThrowsMessage<InvalidInput>(HasSubstr("seed is 2, not 1")));
  EXPECT_THROW(merged({}), InvalidInput);
}

TEST(Merge, RefusesPartsThatAreCutIntoUnitsOfAnotherSize) {
  json other = plan();
  other["unit_size"] = 2 * Unit::max_size;
  EXPECT_THAT([&] { plan_from_json(other); },
              ThrowsMessage<InvalidInput>(HasSubstr("campaign.unit_size is 1024")));
  other = plan();
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

TEST(ShardFile, IsWrittenAgainFromTheLinesThatHaveChanged) {
  ShardState state = part(0, 3);
  ShardLines lines(state);
  const auto text = [&] {
    std::string result;
    for (const std::string& line : lines.all()) result += line;
    return result;
  };
  EXPECT_EQ(text(), to_text(state));
  const ShardState more = part(3, 4);  // of the second class alone
  state.add(more.done, more.tallies);
  lines.renew(1);
  EXPECT_EQ(text(), to_text(state));
}

TEST(ShardFile, IsRefusedWhenCountsBelongToAnotherClass) {
  json three = plan();
  three["classes"].push_back({{"pair", "cylinder-plane"}, {"class", "lying"}});
  // Two runs: both units of the first class, one of the others.
  ShardState state = part_of(three, 0, 4);
  EXPECT_EQ(to_text(shard_from_text(to_text(state), "file")), to_text(state));
  for (std::size_t k = 0; k < 2; ++k) std::swap(state.tally(0, k), state.tally(1, k));
  EXPECT_THAT([&] { shard_from_text(to_text(state), "file"); },
              ThrowsMessage<InvalidInput>(HasSubstr("counts of less than what is done")));
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
  const auto with_checksum = [](const std::string& body) {
    return body + json{{"crc32", checksum(body)}}.dump() + '\n';
  };
  for (const std::string body :
       {"{\"schema\":\"touchstone-shard-9\"}\n", "{}\n", "[]\n", "no JSON\n",
        "{\"schema\":\"touchstone-shard-3\",\"shard\":[1,1],\"done\":[],\"campaign\":{}}\n"}) {
    EXPECT_THROW(shard_from_text(with_checksum(body), "file"), InvalidInput) << body;
  }
}

TEST(Checksum, IsTheOneOfZipAndPng) { EXPECT_EQ(checksum("123456789"), "cbf43926"); }

}  // namespace
}  // namespace touchstone
