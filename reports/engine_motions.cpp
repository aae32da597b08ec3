#include <algorithm>
#include <vector>

#include <nlohmann/json.hpp>

#include "properties/files/configuration_json.hpp"
#include "reports/pages/page.hpp"
#include "reports/report_json.hpp"
#include "simulation/experiment.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

/// Looks from a little above at all moving bodies.
json camera_of(const Scene& scene) {
  Vec3 middle = Vec3::Zero();
  int moving = 0;
  for (const Body& b : scene.bodies) {
    if (!b.fixed) middle += b.pose.position(), ++moving;
  }
  middle /= std::max(moving, 1);
  double reach = 0;
  for (const Body& b : scene.bodies) {
    if (b.fixed) continue;
    reach = std::max(reach, (b.pose.position() - middle).norm() + largest_half_extent(b.shape));
  }
  const Vec3 from = middle + 6 * reach * Vec3(0.5, -0.8, 0.33);
  return {{"position", touchstone::to_json(from)}, {"look_at", touchstone::to_json(middle)}};
}

json motion_json(const EngineResult& result, double step) {
  const Experiment& experiment = find_experiment(result.experiment);
  json runs = json::array();
  EngineMotion motion;
  for (const bool cured : {false, true}) {
    motion = record_motion(experiment, result.engine, {.cured = cured}, step);
    runs.push_back({{"poses", base64(motion.poses)}});
  }
  return {{"experiment", result.experiment},
          {"engine", result.engine},
          {"bodies", bodies_json(motion.scene)},
          {"camera", camera_of(motion.scene)},
          {"interval", motion.interval},
          {"duration", motion.scene.duration},
          {"runs", runs}};
}

/// The results whose motion is worth seeing, the most striking first: those that are cured, by how
/// far they were from the answer on paper. Each experiment is shown once.
std::vector<const EngineResult*> worth_seeing(const EngineResults& results) {
  constexpr std::size_t max_shown = 4;
  std::vector<const EngineResult*> all, shown;
  for (const EngineResult& r : results.results) {
    if (is_one_run(find_experiment(r.experiment), results.step)) all.push_back(&r);
  }
  const auto gain = [](const EngineResult& r) { return r.cured.exact ? r.own.error : 0; };
  std::stable_sort(all.begin(), all.end(), [&](const EngineResult* x, const EngineResult* y) {
    return gain(*x) > gain(*y);
  });
  for (const EngineResult* r : all) {
    const bool is_new = std::none_of(shown.begin(), shown.end(), [&](const EngineResult* s) {
      return s->experiment == r->experiment;
    });
    if (is_new && shown.size() < max_shown) shown.push_back(r);
  }
  return shown;
}

}  // namespace

json engine_motions(const EngineResults& results) {
  json motions = json::array();
  for (const EngineResult* r : worth_seeing(results)) {
    const auto ended = [](const ExperimentResult& run) {
      return run.outcome == ExperimentResult::Outcome::crashed ||
             run.outcome == ExperimentResult::Outcome::timed_out;
    };
    if (!ended(r->own) && !ended(r->cured)) motions.push_back(motion_json(*r, results.step));
  }
  return motions;
}

}  // namespace touchstone
