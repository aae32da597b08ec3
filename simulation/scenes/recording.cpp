#include <algorithm>
#include <fmt/format.h>
#include <tuple>

#include <nlohmann/json.hpp>

#include "properties/draw.hpp"
#include "properties/files/configuration_json.hpp"
#include "simulation/scenes/trajectory.hpp"

namespace touchstone {
namespace {

std::vector<JudgedAnswer> near_contact_answers(const Scene& scene, const Trajectory& run,
                                               Pair pair) {
  std::vector<JudgedAnswer> result;
  for (const JudgedAnswer& answer : run.answers) {
    const Configuration c = run.configuration(scene, answer);
    if (pair_of(c) == pair && -answer.depth < near_contact * smaller_size(c)) {
      result.push_back(answer);
    }
  }
  std::sort(result.begin(), result.end(), [](const JudgedAnswer& x, const JudgedAnswer& y) {
    return std::tie(x.a, x.b, x.frame) < std::tie(y.a, y.b, y.frame);
  });
  return result;
}

}  // namespace

std::vector<RecordedQuestion> sample_near_contact(const Scene& scene, const Trajectory& run,
                                                  const RecordingOptions& options) {
  std::vector<RecordedQuestion> result;
  for (const Pair pair : all_pairs) {
    const auto answers = near_contact_answers(scene, run, pair);
    Draw draw(rc::Random(rc::Random::Key{options.seed, static_cast<std::uint64_t>(pair), 0, 0}));
    const std::uint64_t parts = std::min<std::uint64_t>(options.count, answers.size());
    for (std::uint64_t i = 0; i < parts; ++i) {
      const std::uint64_t first = i * answers.size() / parts;
      const std::uint64_t end = (i + 1) * answers.size() / parts;
      const auto drawn =
          draw.integer(static_cast<std::int64_t>(first), static_cast<std::int64_t>(end) - 1);
      result.push_back({answers[static_cast<std::size_t>(drawn)], end - first});
    }
  }
  return result;
}

std::string recording_lines(const std::string& scene_name, const Scene& scene,
                            const Trajectory& run, const std::vector<RecordedQuestion>& questions) {
  std::string lines;
  for (const auto& [answer, weight] : questions) {
    const nlohmann::ordered_json line = {
        {"id", fmt::format("{}/{} and {}/{:g}", scene_name, scene.bodies[answer.a].name,
                           scene.bodies[answer.b].name, run.step * answer.frame)},
        {"scene", scene_name},
        {"weight", weight},
        {"configuration", to_json(run.configuration(scene, answer))}};
    lines += line.dump() + '\n';
  }
  return lines;
}

}  // namespace touchstone
