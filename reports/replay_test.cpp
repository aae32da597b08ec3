#include "reports/replay.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "properties/files/configuration_json.hpp"
#include "reports/small_report_test.hpp"

namespace touchstone {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

TEST(Replay, IsTheSameOnEveryCall) {
  const Identity id{Pair::cylinder, "rim-rim", 1, 2};
  auto candidates = start(some_configurations().candidates, 0),
       again = start(some_configurations().candidates, 0);
  const auto shown = [&](std::vector<CandidateProcess>& processes) {
    return replay_text(examine(subject(id), pointers(processes), Bar()), "", true);
  };
  const std::string text = shown(candidates);
  EXPECT_EQ(shown(again), text);
  EXPECT_THAT(text, HasSubstr("cylinder-cylinder/rim-rim/1/2"));
  EXPECT_THAT(text, HasSubstr("0x1."));
}

TEST(Replay, InShortIsATableWithTheTruth) {
  const Identity id{Pair::plane, "standing", 1, 2};
  auto candidates = start(some_configurations().candidates, 0);
  const std::string text =
      replay_text(examine(subject(id), pointers(candidates), Bar()), "", false);
  EXPECT_THAT(text, ContainsRegex("\ntruth +-?[0-9.e-]+\n"));
  EXPECT_THAT(text, ContainsRegex("\nreference [(]Touchstone's own[)]\n +agree +-?[0-9]"));
  EXPECT_THAT(text, ContainsRegex("\nprism:8 +[a-z-]+"));
  EXPECT_THAT(text, Not(HasSubstr("  point (")));
}

// solve

TEST(Replay, CommandHasTheNumbersOfAConfigurationWithoutIdentityInHexadecimal) {
  const Configuration c = make_configuration({Pair::sphere, "rim", 1, 0});
  EXPECT_EQ(replay_command(c, {"bullet"}),
            "echo '" + to_hex_json(c).dump() + "' | ./touchstone replay -");
}

}  // namespace
}  // namespace touchstone
