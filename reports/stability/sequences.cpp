#include <algorithm>
#include <cmath>

#include "oracle/judge/hull.hpp"
#include "reports/stability/measure.hpp"
#include "reports/stability/step_change.hpp"

namespace touchstone {
namespace {

/// Keeps the first of equal values.
void raise(std::optional<Sequences::Peak>& peak, const std::optional<double>& value, int step) {
  if (value && !(peak && peak->value >= *value)) peak = {*value, step};
}

/// The course of candidate k. `steps`: between these poses.
Sequences::Row course(const std::vector<ExaminedPose>& poses, std::vector<Step>& steps,
                      std::size_t k) {
  Sequences::Row result;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const PoseAnswer& pose = poses[i].answers[k];
    result.missed += pose.score.outcome == Outcome::missed;
    result.wrong += !agrees(pose.score.outcome);
    result.unanswered += !pose.is_answered();
    if (i == 0) continue;
    const auto change = steps[i - 1].change(k);
    if (!change) continue;
    const int step = static_cast<int>(i);
    result.amplification = std::max(result.amplification.value_or(0), change->amplification);
    raise(result.jump, change->jump, step);
    raise(result.hull, change->hull, step);
    raise(result.hull_excess, change->hull_excess, step);
    result.points_changed += change->points_changed;
  }
  return result;
}

/// The truth along a motion: largest changes at one step.
void follow_truth(const std::vector<ExaminedPose>& poses, Sequences::Course& course) {
  const double size = smaller_size(poses[0].configuration);
  const auto depth = [](const ExaminedPose& p) { return p.truth.signed_distance.midpoint(); };
  std::vector<oracle::ContactPatch> patches;
  for (const ExaminedPose& pose : poses) patches.push_back(true_patch(pose));
  const auto raise_to = [&](double& max, double change) { max = std::max(max, change / size); };
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const ExaminedPose &from = poses[i - 1], &to = poses[i];
    raise_to(course.displacement, largest_displacement(from.configuration, to.configuration));
    raise_to(course.true_depth_change, std::abs(depth(to) - depth(from)));
    raise_to(course.true_patch_movement, movement(patches[i - 1], patches[i]));
  }
}

Sequences::Course follow(const Motion& motion, int steps, const Study& study,
                         std::vector<CandidateProcess>& candidates) {
  std::vector<Configuration> asked;
  for (int i = 0; i <= steps; ++i) asked.push_back(pose_at(motion, i, steps));
  const std::vector<ExaminedPose> poses = examine_poses(asked, candidates, study.bar);
  std::vector<Step> between;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    between.emplace_back(poses[i - 1], poses[i], study.bar);
  }
  Sequences::Course result{
      motion.name, motion.description, pair_name(pair_of(asked.front())), 0, 0, 0, {}};
  follow_truth(poses, result);
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    if (poses[0].answers[k].score.outcome == Outcome::unsupported) continue;
    result.results.push_back(course(poses, between, k));
    result.results.back().candidate = study.candidates[k]->name;
  }
  return result;
}

}  // namespace

Measure<Sequences> sequences(const std::vector<const Motion*>& motions, int steps,
                             const Study& study) {
  return {{motions.size(), static_cast<std::size_t>(steps) + 1,
           [=](std::size_t i) { return "sequence/" + motions[i]->name; },
           [=](std::size_t i, std::vector<CandidateProcess>& candidates) {
             return to_bytes(follow(*motions[i], steps, study, candidates));
           }},
          [=](std::span<const std::string> texts) {
            return Sequences{steps, finished<Sequences::Course>(texts)};
          }};
}

}  // namespace touchstone
