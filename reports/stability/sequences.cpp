#include <algorithm>
#include <cmath>

#include "oracle/judge/hull.hpp"
#include "properties/files/bytes.hpp"
#include "reports/stability/measure.hpp"
#include "reports/stability/step_change.hpp"

namespace touchstone {
namespace {

/// One motion, as one candidate answered it.
struct Course {
  bool is_supported = true;
  std::optional<double> amplification;
  std::optional<Sequences::Peak> jump, hull, hull_excess;
  int points_changed = 0, missed = 0, wrong = 0, unanswered = 0;
};

/// The truth along a motion: largest changes at one step.
struct TrueCourse {
  double displacement = 0, depth = 0, patch = 0;
};

/// Keeps the first of equal values.
void raise(std::optional<Sequences::Peak>& peak, const std::optional<double>& value, int step) {
  if (value && !(peak && peak->value >= *value)) peak = {*value, step};
}

/// `steps`: between these poses.
Course course(const std::vector<ExaminedPose>& poses, std::vector<Step>& steps, std::size_t k) {
  Course result;
  result.is_supported = poses[0].answers[k].score.outcome != Outcome::unsupported;
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

TrueCourse true_course(const std::vector<ExaminedPose>& poses) {
  TrueCourse result;
  const double size = smaller_size(poses[0].configuration);
  const auto depth = [](const ExaminedPose& p) { return p.truth.signed_distance.midpoint(); };
  std::vector<oracle::ContactPatch> patches;
  for (const ExaminedPose& pose : poses) patches.push_back(true_patch(pose));
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const ExaminedPose &from = poses[i - 1], &to = poses[i];
    const double displacement = largest_displacement(from.configuration, to.configuration);
    result.displacement = std::max(result.displacement, displacement / size);
    result.depth = std::max(result.depth, std::abs(depth(to) - depth(from)) / size);
    result.patch = std::max(result.patch, movement(patches[i - 1], patches[i]) / size);
  }
  return result;
}

/// The truth's course, then those of the candidates in their order.
std::string follow(const Motion& motion, int steps, std::vector<CandidateProcess>& candidates,
                   const Bar& bar) {
  std::vector<Configuration> asked;
  for (int i = 0; i <= steps; ++i) asked.push_back(pose_at(motion, i, steps));
  const std::vector<ExaminedPose> poses = examine_poses(asked, candidates, bar);
  std::vector<Step> between;
  for (std::size_t i = 1; i < poses.size(); ++i) between.emplace_back(poses[i - 1], poses[i], bar);
  std::vector<Course> courses;
  for (std::size_t k = 0; k < candidates.size(); ++k) courses.push_back(course(poses, between, k));
  return to_bytes(true_course(poses), courses);
}

Sequences::Course collected(const Motion& motion, const std::string& bytes,
                            const std::vector<const Candidate*>& candidates) {
  BytesIn in(bytes);
  const auto truth = in.next<TrueCourse>();
  const auto courses = in.next<std::vector<Course>>();
  Sequences::Course result{motion.name,
                           motion.description,
                           pair_name(pair_of(pose_at(motion, 0, 1))),
                           truth.displacement,
                           truth.depth,
                           truth.patch,
                           {}};
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const Course& c = courses[k];
    if (!c.is_supported) continue;
    result.results.push_back({candidates[k]->name, c.amplification, c.jump, c.hull, c.hull_excess,
                              c.points_changed, c.missed, c.wrong, c.unanswered});
  }
  return result;
}

}  // namespace

Measure<Sequences> sequences(const std::vector<const Motion*>& motions, int steps,
                             const Study& study) {
  return {{motions.size(), static_cast<std::size_t>(steps) + 1,
           [=](std::size_t i) { return "sequence/" + motions[i]->name; },
           [=, bar = study.bar](std::size_t i, std::vector<CandidateProcess>& candidates) {
             return follow(*motions[i], steps, candidates, bar);
           }},
          [=, candidates = study.candidates](std::span<const std::string> texts) {
            Sequences sequences{steps, {}};
            for (std::size_t i = 0; i < texts.size(); ++i) {
              if (texts[i].empty()) continue;  // interrupted before
              sequences.motions.push_back(collected(*motions[i], texts[i], candidates));
            }
            return sequences;
          }};
}

}  // namespace touchstone
