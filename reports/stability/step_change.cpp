#include "reports/stability/step_change.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "oracle/patch/convex_set.hpp"
#include "properties/motions/motion.hpp"
#include "reports/campaign.hpp"

namespace touchstone {
namespace {

using oracle::ContactPatch;
using oracle::Vec2;

double depth(double signed_distance, const Bar& bar) {
  return std::max(0.0, bar.threshold - signed_distance);
}
double true_depth(const ExaminedPose& pose, const Bar& bar) {
  return depth(pose.truth.signed_distance.midpoint(), bar);
}
double answered_depth(const Answer& answer, const Bar& bar) {
  return answer.status == TS_CONTACT ? depth(answer.signed_distance, bar) : 0;
}

/// Patches of one configuration by their normals; most candidates answer the same normal.
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

/// The change of a depth by rounding alone, metres: four units in the last place of the bodies'
/// coordinates and sizes.
double rounding_of(const Configuration& c) {
  constexpr double units = 4;
  const double coordinates = std::max(c.pose_a.position().cwiseAbs().maxCoeff(),
                                      c.pose_b.position().cwiseAbs().maxCoeff());
  return units * std::numeric_limits<double>::epsilon() * (coordinates + larger_size(c));
}

/// The largest change of the true depth at a step, metres.
double allowance(const Configuration& from, const Configuration& to) {
  return largest_displacement(from, to) + std::max(rounding_of(from), rounding_of(to));
}

double distance_in_space(const Vec3& point, const ContactPatch& patch) {
  const double beside = patch.distance(point);
  return std::hypot(beside, (point - patch.in_world(patch.in_plane(point))).norm());
}

double farthest(const ContactPatch& from, const ContactPatch& to) {
  double max = 0;
  for (const Vec3& point : from.outline()) max = std::max(max, distance_in_space(point, to));
  return max;
}

}  // namespace

std::vector<ExaminedPose> examine_poses(const std::vector<Configuration>& configurations,
                                        std::vector<CandidateProcess>& candidates, const Bar& bar) {
  std::vector<ExaminedPose> poses;
  const auto take = [&](const ScoredConfiguration& scored) {
    ExaminedPose& pose = poses.emplace_back(ExaminedPose{scored.configuration, scored.truth, {}});
    Patches patches(pose.configuration);
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      PoseAnswer& entry =
          pose.answers.emplace_back(PoseAnswer{scored.answers[k], scored.scores[k], {}, {}});
      const Vec3 n(entry.answer.normal);
      if (entry.answer.status == TS_CONTACT && entry.is_answered() &&
          entry.answer.point_count > 0 && !n.isZero(0)) {
        entry.hull = hull_of_points(entry.answer);
        entry.patch = patches.along(patch_normal(pose.truth, n));
      }
    }
  };
  score_configurations(configurations, pointers(candidates), bar, truth_width, take);
  return poses;
}

std::optional<StepChange> step_change(const ExaminedPose& from, const ExaminedPose& to,
                                      std::size_t candidate, const Bar& bar) {
  const PoseAnswer &a = from.answers[candidate], &b = to.answers[candidate];
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

double movement(const ContactPatch& from, const ContactPatch& to) {
  return std::max(farthest(from, to), farthest(to, from));
}

ContactPatch hull_of_points(const ts_answer& answer) {
  Vec3 mean = Vec3::Zero();
  for (int i = 0; i < answer.point_count; ++i) mean += Vec3(answer.points[i].position);
  mean /= answer.point_count;
  const Vec3 n = Vec3(answer.normal).normalized();
  const Vec3 e1 = n.unitOrthogonal();
  const ContactPatch::Plane plane{mean, e1, n.cross(e1)};
  std::vector<Vec2> flat;
  for (int i = 0; i < answer.point_count; ++i) {
    const Vec3 from_mean = Vec3(answer.points[i].position) - mean;
    flat.emplace_back(from_mean.dot(plane.e1), from_mean.dot(plane.e2));
  }
  return {plane, oracle::ConvexSet::polygon(oracle::convex_hull(flat))};
}

}  // namespace touchstone
