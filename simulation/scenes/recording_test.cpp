// Recordings of what a run asked near contact.
#include <gmock/gmock.h>
#include <set>
#include <sstream>

#include <nlohmann/json.hpp>

#include "candidates/candidates.hpp"
#include "properties/files/configuration_json.hpp"
#include "properties/files/disk.hpp"
#include "properties/files/strict_json.hpp"
#include "properties/numbers.hpp"
#include "simulation/scenes/choose.hpp"
#include "simulation/scenes/scene_file.hpp"
#include "simulation/scenes/trajectory.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

/// Two cans on the ground, one of which never touches the other, and a ball above all of them.
SceneFile two_cans() {
  return scene_from_text(R"({
    "duration": 0.25,
    "bodies": [
      {"name": "ground", "shape": {"shape": "plane", "normal": [0, 0, 1], "displacement": 0},
       "fixed": true},
      {"name": "near", "shape": {"shape": "cylinder", "radius": 0.1, "half_length": 0.2},
       "pose": {"position": [0, 0, 0.2]}},
      {"name": "beside", "shape": {"shape": "cylinder", "radius": 0.1, "half_length": 0.2},
       "pose": {"position": [0.206, 0, 0.2]}},
      {"name": "ball", "shape": {"shape": "sphere", "radius": 0.1},
       "pose": {"position": [0, 0, 0.52]}, "fixed": true}]})",
                         "cans.json");
}

Trajectory exact_run(const Scene& scene) {
  Processes processes({});
  CandidateModel exact(processes.of(find_candidate("reference")));
  return run_scene(scene, exact);
}

std::string recorded_lines(const SceneFile& file, const RecordingOptions& options) {
  const Trajectory run = exact_run(file.scene);
  return recording_lines(file.name, file.scene, run, sample_near_contact(file.scene, run, options));
}

// The ball hangs a fifth of its radius above the can, though their boxes overlap with round ends;
// the cans stand 6% of the radius apart.
TEST(Recording, KeepsOnlyWhatIsNearContact) {
  SceneFile file = two_cans();
  const Trajectory run = exact_run(file.scene);
  const auto pairs_recorded = [&] {
    std::set<std::string> names;
    for (const auto& [answer, weight] : sample_near_contact(file.scene, run, {})) {
      names.insert(file.scene.bodies[answer.a].name + "-" + file.scene.bodies[answer.b].name);
    }
    return names;
  };
  EXPECT_THAT(pairs_recorded(), testing::ElementsAre("beside-ground", "near-ground"));
}

TEST(Recording, WeightsAddUpToTheQuestionsAndCoverBodiesAndTimeEvenly) {
  const SceneFile file = two_cans();
  const Trajectory run = exact_run(file.scene);
  const std::uint64_t questions = 2 * (run.frames.size() - 1);  // both cans, in every step
  for (const std::uint64_t count : {1, 7, 20, 1000}) {
    const auto sample = sample_near_contact(file.scene, run, {count, 1});
    EXPECT_EQ(sample.size(), std::min(count, questions));
    std::uint64_t sum = 0;
    for (const RecordedQuestion& q : sample) sum += q.weight;
    EXPECT_EQ(sum, questions);
  }
  const auto sample = sample_near_contact(file.scene, run, {20, 1});
  for (std::size_t i = 0; i < 20; ++i) {
    const double time = sample[i].answer.frame / static_cast<double>(run.frames.size() - 1);
    EXPECT_EQ(file.scene.bodies[sample[i].answer.a].name, i < 10 ? "near" : "beside");
    EXPECT_GE(time, static_cast<double>(i % 10) / 10);
    EXPECT_LT(time, static_cast<double>(i % 10 + 1) / 10);
  }
}

TEST(Recording, DependsOnTheSeedAlone) {
  const SceneFile file = two_cans();
  EXPECT_EQ(recorded_lines(file, {20, 1}), recorded_lines(file, {20, 1}));
  EXPECT_NE(recorded_lines(file, {20, 1}), recorded_lines(file, {20, 2}));
}

// Another processor may round ODE's sines otherwise, and a change of our routines the last bits of
// contacts; either can decide in which step a log of 0.15 m has a contact point more. The largest
// difference that such a change has made is 2e-5 m.
constexpr double other_rounding = 1e-4;  // metres

TEST(Recording, TheSampleInTheProgramIsWhatASceneGives) {
  const SceneFile file = read_scene(TOUCHSTONE_SCENES "/log-pile.json");
  const auto lines_of_scene = [&](const std::string& text) {
    std::vector<json> result;
    for (const json& line : parse_json_lines(text, "recorded.jsonl")) {
      if (line["scene"] == file.name) result.push_back(line);
    }
    return result;
  };
  const auto recorded = lines_of_scene(read_file(TOUCHSTONE_RECORDED, "input"));
  const auto given = lines_of_scene(recorded_lines(file, {}));
  ASSERT_EQ(given.size(), recorded.size());
  for (std::size_t i = 0; i < given.size(); ++i) {
    EXPECT_EQ(given[i]["id"], recorded[i]["id"]);
    EXPECT_EQ(given[i]["weight"], recorded[i]["weight"]);
    const auto numbers = [](const json& line) {
      return numbers_of(configuration_from_json(line["configuration"]).configuration);
    };
    Numbers x = numbers(given[i]), y = numbers(recorded[i]);
    const auto all_x = every_number(x), all_y = every_number(y);
    ASSERT_EQ(all_x.size(), all_y.size());
    for (std::size_t k = 0; k < all_x.size(); ++k) {
      EXPECT_NEAR(*all_x[k], *all_y[k], other_rounding) << given[i]["id"];
    }
  }
}

TEST(Recording, LinesHoldTheExactConfigurationsOfTheRun) {
  const SceneFile file = two_cans();
  const Trajectory run = exact_run(file.scene);
  const auto sample = sample_near_contact(file.scene, run, {5, 1});
  std::istringstream lines(recording_lines(file.name, file.scene, run, sample));
  std::string text;
  for (const auto& [answer, weight] : sample) {
    ASSERT_TRUE(std::getline(lines, text));
    const json line = json::parse(text);
    EXPECT_EQ(line["scene"], "cans");
    EXPECT_EQ(line["weight"], weight);
    EXPECT_THAT(line["id"].get<std::string>(),
                testing::StartsWith("cans/" + file.scene.bodies[answer.a].name + " and ground/"));
    EXPECT_EQ(to_hex_json(configuration_from_json(line["configuration"]).configuration),
              to_hex_json(run.configuration(file.scene, answer)));
  }
}

}  // namespace
}  // namespace touchstone
