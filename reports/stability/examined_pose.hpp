#pragma once

#include <optional>
#include <vector>

#include "oracle/judge/score.hpp"
#include "oracle/patch/contact_patch.hpp"

namespace touchstone {

/// What is studied, and of whom.
struct Study {
  std::vector<const Candidate*> candidates;
  Bar bar;
  Limits limits;
  unsigned workers = 1;  ///< they do not change the result
};

/// One pose with its truth, and what one candidate makes of it.
struct CandidatePose {
  Answer answer;
  Score score;
  /// Of a contact with points: their hull, and the contact patch along the optimal normal that is
  /// nearest to the answered one, within patch_depth of the support planes.
  std::optional<oracle::ContactPatch> hull, patch;

  /// A contact in finite numbers, or none.
  bool is_answered() const {
    return answer.status == TS_NONE ||
           (answer.status == TS_CONTACT && score.outcome != Outcome::not_finite);
  }
};
struct ExaminedPose {
  Configuration configuration;
  oracle::Truth truth;
  std::vector<CandidatePose> of;  ///< in the order of the candidates
};

/// Asks every candidate for all of them in one new session, in this order, and the oracle. Throws
/// like the oracle.
std::vector<ExaminedPose> examine(const std::vector<Configuration>& configurations,
                                  std::vector<CandidateProcess>& candidates, const Bar& bar);

/// What one candidate makes of a step from one pose to another. Lengths are relative to the smaller
/// size.
struct StepChange {
  /// Change of the answered depth over what the step allows: the largest displacement of any of A's
  /// points, plus the rounding of coordinates. The truth's is at most one. A depth is how far the
  /// signed distance is below the threshold of contact, zero without a contact.
  double amplification;
  double jump;  ///< |change of the answered depth − change of the true one|
  // Between two contacts with points:
  bool points_changed;  ///< their number
  /// How far their hull moved, and by how much more than the contact patch along the same normals.
  std::optional<double> hull, hull_excess;
};

/// Absent unless the candidate answered both.
std::optional<StepChange> step_change(const ExaminedPose& from, const ExaminedPose& to,
                                      std::size_t candidate, const Bar& bar);

/// The same of the truth's depth.
double true_amplification(const ExaminedPose& from, const ExaminedPose& to, const Bar& bar);

/// How far the truth's own patch moved, along its first normal at either pose.
double patch_movement(const ExaminedPose& from, const ExaminedPose& to);

/// Metres that rounding alone may change a depth by: four units in the last place of the bodies'
/// coordinates and sizes.
double rounding_of(const Configuration& configuration);

}  // namespace touchstone
