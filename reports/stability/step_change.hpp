#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "candidates/host/candidate_process.hpp"
#include "oracle/judge/score.hpp"
#include "oracle/patch/contact_patch.hpp"

namespace touchstone {

/// One candidate's answer to a pose.
struct PoseAnswer {
  Answer answer;
  Score score;
  /// For a contact with points: their hull, and the number of the contact patch along the optimal
  /// normal nearest to the answered one.
  std::optional<oracle::ContactPatch> hull;
  std::optional<std::size_t> patch;

  /// A contact in finite numbers, or none.
  bool is_answered() const {
    return answer.status == TS_NONE ||
           (answer.status == TS_CONTACT && score.outcome != Outcome::not_finite);
  }
};

/// One pose with its truth and the answers, in the order of the candidates.
struct ExaminedPose {
  Configuration configuration;
  oracle::Truth truth;
  std::vector<PoseAnswer> answers;
  /// Within patch_depth of the support planes. Most answers have the same one.
  std::vector<oracle::ContactPatch> patches;
};

/// Asks every candidate for all of them in one new session, in this order, and the oracle. Throws
/// like the oracle.
std::vector<ExaminedPose> examine_poses(const std::vector<Configuration>& configurations,
                                        std::vector<CandidateProcess>& candidates, const Bar& bar);

/// How one candidate's answer changes at a step from one pose to another. Lengths are relative to
/// the smaller size.
struct StepChange {
  /// Change of the answered depth over what the step allows: the largest displacement of any of A's
  /// points, plus the rounding of coordinates. The truth's is at most one. The depth is by how much
  /// the signed distance is below the threshold of contact, zero without a contact.
  double amplification;
  double jump;  ///< |change of the answered depth − change of the true one|
  // Between two contacts with points:
  bool points_changed;  ///< their number
  /// How far their hull moved, and by how much more than the contact patch along the same normals.
  std::optional<double> hull, hull_excess;
};

/// A step between two poses, which must outlive it. What the candidates' changes have in common is
/// found once: how far a patch moves takes a thousand distances.
class Step {
 public:
  Step(const ExaminedPose& from, const ExaminedPose& to, const Bar& bar);

  /// Absent unless the candidate answered both.
  std::optional<StepChange> change(std::size_t candidate);
  /// Amplification of the true depth.
  double true_amplification() const;

 private:
  /// How far the contact patch moved between two optimal normals, by their numbers; metres.
  double patch_movement(std::size_t from, std::size_t to);

  const ExaminedPose &from_, &to_;
  Bar bar_;
  double true_change_;  ///< of the depth, metres
  double allowance_;    ///< largest change of the true depth, metres
  std::map<std::pair<std::size_t, std::size_t>, double> patch_movements_;
};

/// The patch along the first optimal normal.
oracle::ContactPatch true_patch(const ExaminedPose& pose);

}  // namespace touchstone
