#pragma once

#include <array>
#include <optional>

#include "candidates/host/candidate_process.hpp"
#include "oracle/truth.hpp"

namespace touchstone {

/// What became of one answer, named after the symptom.
enum class Outcome {
  agree,         ///< within the bar in every respect
  missed,        ///< no contact where the bodies overlap
  phantom,       ///< a contact where they are apart
  shallow,       ///< depth too small
  overdeep,      ///< depth too large
  wrong_normal,  ///< a direction along which the bodies are deeper than need be
  not_finite,    ///< a NaN or an infinity in the answer
  failed,        ///< the candidate says that it could not answer
  crashed,       ///< its process ended: a signal, an exception, too much memory
  timed_out,     ///< it was ended for taking too long
  unsupported,   ///< the candidate has no routine for the pair
  // Depth and normal are right, but not what a solver is given to act on:
  shallow_points,   ///< no point as deep as the bodies are
  overdeep_points,  ///< a point deeper than they are
  phantom_points    ///< a point beyond the threshold
};
// Saved files know outcomes by name; a new one goes to the end all the same.
inline constexpr std::array all_outcomes = {
    Outcome::agree,           Outcome::missed,        Outcome::phantom,     Outcome::shallow,
    Outcome::overdeep,        Outcome::wrong_normal,  Outcome::not_finite,  Outcome::failed,
    Outcome::crashed,         Outcome::timed_out,     Outcome::unsupported, Outcome::shallow_points,
    Outcome::overdeep_points, Outcome::phantom_points};
/// "agree", "missed", "wrong-normal", …
const char* outcome_name(Outcome outcome);
const char* status_name(ts_status status);
/// Has an answer of that outcome a severity: was there an answer to be judged?
bool is_judged(Outcome outcome);

/// Are depth and normal right, and what is wrong are the points?
bool is_of_points(Outcome outcome);

/// Are all numbers that belong to a contact finite?
bool is_finite(const ts_answer& answer);

/// Where an answer stops agreeing with the truth.
struct Bar {
  /// Relative to the smaller size. Drake's published protocol for contact queries overlaps bodies
  /// of 20 cm by 2 mm; 1e-4 of their half extent is one two-hundredth of that overlap.
  double tolerance = 1e-4;
  /// Contacts up to this distance apart are asked for, metres.
  double threshold = 0;
};

/// The length to which errors are relative, metres: the smaller size. Doubles place a body to some
/// 1e-16 of the larger one, so that it is no less than what makes the tolerance 1e-13 of that: by
/// default, 1e-9 of the larger size. Over a plane, distances from the origins are sizes too.
double error_size(const Configuration& configuration, const Bar& bar);

/// One answer held against the truth. Errors are relative to error_size; those that the answer does
/// not define are absent.
struct Score {
  Outcome outcome = Outcome::agree;
  std::optional<double> depth_error;  ///< answer's signed distance − true: positive is too shallow
  std::optional<double> normal_regret;  ///< σ − g(n)
  std::optional<double> normal_angle;   ///< degrees to the nearest optimal normal
  /// The largest depth of a point − the true depth: negative where a solver sees too little of it.
  std::optional<double> deepest_error;
  /// By how much the worst of the contact points is farther from a body's surface than its own
  /// depth; zero when none is. It does not decide the outcome.
  std::optional<double> point_error;
  /// How much of the contact patch the points span, where the bodies are in contact and the normal
  /// is within the bar.
  std::optional<double> coverage;
  /// Of a simplified model that knows the signed distance of what it models: that distance − true,
  /// and the answer's − that distance. They add up to the depth error.
  std::optional<double> model_error, solver_error;
  int points = 0;
  /// How bad the failure is: the depth or gap that was got wrong, by the answer or its points, or
  /// the regret. Zero: perfect.
  double severity = 0;
};

/// Coverage is of the patch within `patch_depth` of the bodies' support planes along the nearest
/// optimal normal. Where it is narrower than `patch_resolution`, or only as wide as a rounded,
/// tilted or sharp feature is within that depth, it counts as a point or a segment. Both are
/// relative to the smaller size. The depth is what engines make contact points within: pe's contact
/// threshold is 1e-6.
inline constexpr double patch_depth = 1e-6;
inline constexpr double patch_resolution = 0.1;

/// The optimal normal along which an answer's contact points are judged: the nearest one to its
/// normal. Of a continuum not every member is listed: an answer that is far from all of those
/// stands for itself.
Vec3 patch_normal(const oracle::Truth& truth, const Vec3& n);

Score score(const Configuration& configuration, const oracle::Truth& truth, const ts_answer& answer,
            const Bar& bar);
/// The same, with the errors of model and solver.
Score score(const Configuration& configuration, const oracle::Truth& truth, const Answer& answer,
            const Bar& bar);

}  // namespace touchstone
