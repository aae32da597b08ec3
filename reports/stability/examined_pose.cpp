#include "reports/stability/examined_pose.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "properties/motions/perturbation.hpp"
#include "reports/stability/movement.hpp"

namespace touchstone {
namespace {

using oracle::ContactPatch;

double depth(double signed_distance, const Bar& bar) {
  return std::max(0.0, bar.threshold - signed_distance);
}
double true_depth(const ExaminedPose& pose, const Bar& bar) {
  return depth(pose.truth.signed_distance.midpoint(), bar);
}
double answered_depth(const Answer& answer, const Bar& bar) {
  return answer.status == TS_CONTACT ? depth(answer.signed_distance, bar) : 0;
}

/// Patches of one configuration by their normals: most candidates answer the same one.
class Patches {
 public:
  explicit Patches(const Configuration& c) : c_(c), depth_(patch_depth * smaller_size(c)) {}
  const ContactPatch& along(const Vec3& n) {
    for (const auto& [normal, patch] : known_) {
      if (normal == n) return patch;
    }
    return known_.emplace_back(n, oracle::contact_patch(c_, n, depth_)).second;
  }

 private:
  const Configuration& c_;
  double depth_;
  std::vector<std::pair<Vec3, ContactPatch>> known_;
};

/// What a step may change a depth by, metres.
double allowance(const Configuration& from, const Configuration& to) {
  return largest_displacement(from, to) + std::max(rounding_of(from), rounding_of(to));
}

}  // namespace

std::vector<ExaminedPose> examine(const std::vector<Configuration>& configurations,
                                  std::vector<CandidateProcess>& candidates, const Bar& bar) {
  std::vector<std::vector<Answer>> answers;
  for (CandidateProcess& candidate : candidates) {
    answers.push_back(candidate.answers(configurations));
  }
  std::vector<ExaminedPose> poses;
  for (std::size_t i = 0; i < configurations.size(); ++i) {
    const Configuration& c = configurations[i];
    ExaminedPose pose{c, oracle::truth(c), {}};
    Patches patches(c);
    for (const auto& of_candidate : answers) {
      CandidatePose made{of_candidate[i], score(c, pose.truth, of_candidate[i], bar), {}, {}};
      const Vec3 n(made.answer.normal);
      if (made.answer.status == TS_CONTACT && made.is_answered() && made.answer.point_count > 0 &&
          !n.isZero(0)) {
        made.hull = hull_of_points(made.answer);
        made.patch = patches.along(patch_normal(pose.truth, n));
      }
      pose.of.push_back(std::move(made));
    }
    poses.push_back(std::move(pose));
  }
  return poses;
}

double rounding_of(const Configuration& c) {
  constexpr double units = 4;
  const double coordinates = std::max(c.pose_a.position().cwiseAbs().maxCoeff(),
                                      c.pose_b.position().cwiseAbs().maxCoeff());
  return units * std::numeric_limits<double>::epsilon() * (coordinates + larger_size(c));
}

std::optional<StepChange> step_change(const ExaminedPose& from, const ExaminedPose& to,
                                      std::size_t candidate, const Bar& bar) {
  const CandidatePose &a = from.of[candidate], &b = to.of[candidate];
  if (!a.is_answered() || !b.is_answered()) return std::nullopt;
  const double size = smaller_size(from.configuration);
  const double change = answered_depth(b.answer, bar) - answered_depth(a.answer, bar);
  const double true_change = true_depth(to, bar) - true_depth(from, bar);
  StepChange result{};
  result.amplification = std::abs(change) / allowance(from.configuration, to.configuration);
  result.jump = std::abs(change - true_change) / size;
  if (a.hull && b.hull) {
    result.points_changed = a.score.points != b.score.points;
    result.hull = movement(*a.hull, *b.hull) / size;
    result.hull_excess = std::max(0.0, *result.hull - movement(*a.patch, *b.patch) / size);
  }
  return result;
}

double true_amplification(const ExaminedPose& from, const ExaminedPose& to, const Bar& bar) {
  return std::abs(true_depth(to, bar) - true_depth(from, bar)) /
         allowance(from.configuration, to.configuration);
}

double patch_movement(const ExaminedPose& from, const ExaminedPose& to) {
  const auto patch = [](const ExaminedPose& pose) {
    const Configuration& c = pose.configuration;
    return oracle::contact_patch(c, pose.truth.normals.front().n, patch_depth * smaller_size(c));
  };
  return movement(patch(from), patch(to)) / smaller_size(from.configuration);
}

}  // namespace touchstone
