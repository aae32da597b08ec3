#include "reports/campaigns/merge.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// A plan without plug-ins: parts are made up, not run.
json plan(std::uint64_t seed = 1) {
  return {{"version", "0"},
          {"command", "./touchstone campaign"},
          {"program", "./touchstone"},
          {"seed", seed},
          {"count", 1000},
          {"tolerance", 1e-4},
          {"threshold", 0},
          {"classes",
           {{{"pair", "cylinder-sphere"}, {"class", "general-shallow"}},
            {{"pair", "cylinder-box"}, {"class", "rim-face"}}}},
          {"candidates", {{{"name", "one"}}, {{"name", "two"}}}}};
}

/// Units first … last − 1 of it, with scores that follow from their indices.
ShardState part(std::uint64_t first, std::uint64_t last, std::uint64_t seed = 1) {
  ShardState p(plan_from_json(plan(seed)), Shard{});
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
          HasSubstr("cylinder-sphere/general-shallow, configurations 512 to 999")));
  EXPECT_THAT(
      [] {
        merged({part(0, 1), part(2, 4)});
      },
      ThrowsMessage<InvalidInput>(HasSubstr("512 of 2000 configurations are missing, the "
                                            "first of them cylinder-box/rim-face")));
  EXPECT_THAT(
      [] {
        merged({part(0, 1), part(1, 4, 2)});
      },
      ThrowsMessage<InvalidInput>(HasSubstr("seed is 2, not 1")));
  EXPECT_THROW(merged({}), InvalidInput);
}

TEST(Merge, MarksWhatIsPartial) {
  Merge merge;
  merge.add(part(1, 3), "part");
  const json result = json::parse(campaign_json(merge.whole(true)));
  EXPECT_EQ(result["complete"], false);
  EXPECT_EQ(result["configurations"], 512 + 488);
}

TEST(ShardFile, IsReadBackToTheLastBit) {
  const std::string text = to_text(part(0, 3));
  EXPECT_EQ(to_text(shard_from_text(text, "file")), text);
}

TEST(ShardFile, IsRefusedWhenAnythingInItHasChanged) {
  const std::string text = to_text(part(0, 3));
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
        "{\"schema\":\"touchstone-shard-1\",\"shard\":[1,1],\"done\":[],\"campaign\":{}}\n"}) {
    EXPECT_THROW(shard_from_text(with_checksum(body), "file"), InvalidInput) << body;
  }
}

TEST(Checksum, IsTheOneOfZipAndPng) { EXPECT_EQ(checksum("123456789"), "cbf43926"); }

}  // namespace
}  // namespace touchstone
