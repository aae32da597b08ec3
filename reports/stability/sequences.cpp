#include "reports/stability/sequences.hpp"

#include <algorithm>

#include "candidates/host/progress.hpp"
#include "candidates/host/worker_processes.hpp"
#include "properties/motions/perturbation.hpp"
#include "reports/stability/short_number.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

/// The largest value, and the step at whose end it was.
struct Largest {
  std::optional<double> value;
  int step = 0;
  void take(const std::optional<double>& candidate, int at) {
    if (!candidate || (value && *value >= *candidate)) return;
    value = candidate;
    step = at;
  }
  json to_json() const {
    if (!value) return nullptr;
    return {{"value", short_number(value)}, {"step", step}};
  }
};

json of_candidate(const std::vector<ExaminedPose>& poses, std::size_t k, const Bar& bar) {
  const int steps = static_cast<int>(poses.size()) - 1;
  std::optional<double> amplification;
  Largest jump, hull, hull_excess;
  int points_changed = 0, missed = 0, wrong = 0, unanswered = 0;
  for (int i = 0; i <= steps; ++i) {
    const CandidatePose& pose = poses[static_cast<std::size_t>(i)].of[k];
    missed += pose.score.outcome == Outcome::missed;
    wrong += pose.score.outcome != Outcome::agree;
    unanswered += !pose.is_answered();
    if (i == 0) continue;
    const auto at = static_cast<std::size_t>(i);
    const auto change = step_change(poses[at - 1], poses[at], k, bar);
    if (!change) continue;
    amplification = std::max(amplification.value_or(0), change->amplification);
    jump.take(change->jump, i);
    hull.take(change->hull, i);
    hull_excess.take(change->hull_excess, i);
    points_changed += change->points_changed;
  }
  return {{"amplification", rounded_up(amplification)},
          {"jump", jump.to_json()},
          {"hull", hull.to_json()},
          {"hull_excess", hull_excess.to_json()},
          {"points_changed", points_changed},
          {"missed", missed},
          {"wrong", wrong},
          {"unanswered", unanswered}};
}

json follow(const Motion& motion, int steps, std::vector<CandidateProcess>& candidates,
            const Bar& bar) {
  std::vector<Configuration> asked;
  for (int i = 0; i <= steps; ++i) asked.push_back(pose_at(motion, i, steps));
  const std::vector<ExaminedPose> poses = examine(asked, candidates, bar);
  double displacement = 0, depth = 0, patch = 0;
  const double size = smaller_size(asked[0]);
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const ExaminedPose &from = poses[i - 1], &to = poses[i];
    displacement = std::max(displacement, largest_displacement(asked[i - 1], asked[i]) / size);
    depth = std::max(depth, std::abs(to.truth.signed_distance.midpoint() -
                                     from.truth.signed_distance.midpoint()) /
                                size);
    patch = std::max(patch, patch_movement(from, to));
  }
  json results = json::array();
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    if (poses[0].of[k].score.outcome == Outcome::unsupported) continue;
    json result = of_candidate(poses, k, bar);
    result["candidate"] = candidates[k].candidate().name;
    results.push_back(std::move(result));
  }
  return {{"motion", motion.name},
          {"description", motion.description},
          {"pair", pair_name(pair_of(asked[0]))},
          {"displacement", short_number(displacement)},
          {"truth", {{"depth", short_number(depth)}, {"patch", short_number(patch)}}},
          {"results", results}};
}

}  // namespace

json sequences(const std::vector<const Motion*>& motions, int steps, const Study& study) {
  const auto of_motion = static_cast<std::size_t>(steps) + 1;
  Progress progress("steps", motions.size() * of_motion);
  std::vector<CandidateProcess> candidates;  // each worker starts its own
  const auto results = run_in_processes(
      motions.size(), study.workers,
      [&](std::size_t i) {
        if (candidates.empty()) {
          candidates = start(study.candidates, study.bar.threshold, study.limits);
        }
        return follow(*motions[i], steps, candidates, study.bar).dump();
      },
      [&](std::size_t i) { return "sequence/" + motions[i]->name; },
      [&](std::size_t done) { progress.update(done * of_motion); });
  json list = json::array();
  for (const std::string& text : results) {
    if (!text.empty()) list.push_back(json::parse(text));  // empty: interrupted before
  }
  return {{"steps", steps}, {"motions", list}};
}

}  // namespace touchstone
