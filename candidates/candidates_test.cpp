#include "candidates/candidates.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> names(const std::vector<std::string>& asked) {
  std::vector<std::string> result;
  for (const Candidate* c : find_candidates(asked)) result.push_back(c->name);
  return result;
}

TEST(FindCandidate, NamesThoseThereAre) {
  EXPECT_THAT([] { find_candidate("bulet"); },
              testing::ThrowsMessage<InvalidInput>(
                  AllOf(HasSubstr("bulet"), HasSubstr("reference, bullet, "))));
}

TEST(FindCandidate, KeepsToWhatAParameterMayBe) {
  EXPECT_EQ(find_candidate("prism:12").value, 12);
  EXPECT_EQ(find_candidate("prism").name, "prism:16");
  for (const char* wrong : {"prism:2", "prism:8.5", "prism:", "prism:x", "prism:1e9"}) {
    EXPECT_THAT([&] { find_candidate(wrong); },
                testing::ThrowsMessage<InvalidInput>(
                    AllOf(HasSubstr(wrong), HasSubstr("number of sides"))));
  }
  EXPECT_THAT([] { find_candidate("reference:3"); },
              testing::ThrowsMessage<InvalidInput>(HasSubstr("takes no number")));
}

TEST(FindCandidates, ReadSweeps) {
  EXPECT_THAT(names({"bullet", "prism:8", "16", "32", "reference"}),
              ElementsAre("bullet", "prism:8", "prism:16", "prism:32", "reference"));
  EXPECT_THAT(names({"spheres:1..8"}),
              ElementsAre("spheres:1", "spheres:2", "spheres:4", "spheres:8"));
  EXPECT_THAT(names({"spheres:3..13"}), ElementsAre("spheres:3", "spheres:6", "spheres:12"));
  EXPECT_THAT(names({"libccd-gjk:1e-6..0.001"}), ElementsAre("libccd-gjk:1e-06", "libccd-gjk:1e-05",
                                                             "libccd-gjk", "libccd-gjk:0.001"));
  EXPECT_THAT(names({"bullet", "bullet"}), ElementsAre("bullet"));
  EXPECT_THROW(names({"spheres:8..1"}), InvalidInput);
  EXPECT_THROW(names({"spheres:1..inf"}), InvalidInput);
  EXPECT_THROW(names({"spheres:1..1e6"}), InvalidInput);
  EXPECT_THROW(names({"spheres:.."}), InvalidInput);
  EXPECT_THROW(names({"8"}), InvalidInput);
}

TEST(FindCandidate, ListsANameOnceThatACommandHasTaken) {
  add_command(R"(echo '{"touchstone": 1, "name": "havok", "version": "1", "settings": "mine",)"
              R"( "precision": "float", "runs": "script", "format": "lines",)"
              R"( "pairs": ["cylinder-plane"]}')");
  try {
    find_candidate("no-such-candidate");
    FAIL();
  } catch (const InvalidInput& e) {
    const auto first = e.remedy().find("havok");
    EXPECT_NE(first, std::string::npos);
    EXPECT_EQ(e.remedy().find("havok", first + 1), std::string::npos) << e.remedy();
  }
}

TEST(Candidates, EveryStandardPluginIsThereWhereItsEngineIs) {
  for (const Skipped& s : skipped_plugins()) {
    EXPECT_THAT(s.reason, HasSubstr("was not built")) << s.name;
  }
}

TEST(Candidates, PlaneNormalIsPassedWithUnitLength) {
  const ts_shape plane = to_ts_shape(Plane({0, 3, 4}, 10));
  EXPECT_EQ(plane.size[1], 0.6);
  EXPECT_EQ(plane.size[2], 0.8);
  EXPECT_EQ(plane.size[3], 2);
}

TEST(Candidates, QuaternionsAndNormalsThatOverflowWhenSquaredArePassedWithUnitLength) {
  for (const double length : {5e-324, 1e-320, 1e-162, 1e154, 1e308}) {
    const ts_pose pose = to_ts_pose(Pose(Vec3::Zero(), Eigen::Quaterniond(length, 0, -length, 0)));
    EXPECT_DOUBLE_EQ(pose.orientation[0], std::sqrt(0.5)) << length;
    EXPECT_DOUBLE_EQ(pose.orientation[2], -std::sqrt(0.5)) << length;
    const ts_shape plane = to_ts_shape(Plane({0, 0, -length}, 0));
    EXPECT_EQ(plane.size[2], -1) << length;
  }
}

}  // namespace
}  // namespace touchstone
