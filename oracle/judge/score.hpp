#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "candidates/answer.hpp"
#include "oracle/patch/contact_patch.hpp"
#include "oracle/truth.hpp"
#include "reference/configuration.hpp"

namespace touchstone {

/// Signed distance of a point from a posed body's surface, metres, negative inside; in double, to a
/// few ulp of the coordinates. Ericson, "Real-Time Collision Detection", 2004, ch. 5.
double point_distance(const Shape& shape, const Pose& pose, const Vec3& point);

/// Largest distance of a contact point from the surfaces of the two bodies, minus its own depth,
/// and minus what doubles place a point to (1e-15 of its coordinates); metres. Not positive for an
/// acceptable point: one between the surfaces or on one of them.
double point_excess(const Configuration& configuration, const ts_point& point);

/// How much farther a contact point is outside a body than its own depth allows, likewise. A point
/// within both bodies is on them, wherever between their surfaces.
double point_outside(const Configuration& configuration, const ts_point& point);

/// Judgement of one answer, named after the symptom.
enum class Outcome {
  agree,         ///< within the bar in every respect
  missed,        ///< no contact where the bodies overlap
  phantom,       ///< a contact where they are apart
  shallow,       ///< depth too small
  overdeep,      ///< depth too large
  wrong_normal,  ///< a direction along which the bodies overlap more than along the best one
  not_finite,    ///< a NaN or an infinity in the answer
  failed,        ///< the candidate reports that it could not answer
  crashed,       ///< its process ended: a signal, an exception, too much memory
  timed_out,     ///< its process was ended because it took too long
  unsupported,   ///< the candidate has no routine for the pair
  // Depth and normal are right, but the contact points, on which a solver acts, are not:
  shallow_points,   ///< no point is as deep as the bodies
  overdeep_points,  ///< a point is deeper than the bodies
  phantom_points,   ///< a point is beyond the threshold
  not_asked,        ///< the candidate had been stopped in this class after time-outs
                    ///< (reports/campaign.hpp)
  off_body,         ///< likewise: a point is farther outside a body than its depth
  no_points,        ///< likewise: a contact of bodies that are not apart has no point
  unseen            ///< no contact where the bodies overlap by less than the bar: within it, but a
                    ///< solver feels nothing
};
// Saved files refer to outcomes by name; even so, add new ones at the end.
inline constexpr std::array all_outcomes = {
    Outcome::agree,           Outcome::missed,         Outcome::phantom,
    Outcome::shallow,         Outcome::overdeep,       Outcome::wrong_normal,
    Outcome::not_finite,      Outcome::failed,         Outcome::crashed,
    Outcome::timed_out,       Outcome::unsupported,    Outcome::shallow_points,
    Outcome::overdeep_points, Outcome::phantom_points, Outcome::not_asked,
    Outcome::off_body,        Outcome::no_points,      Outcome::unseen};
/// "agree", "missed", "wrong-normal", …
const char* outcome_name(Outcome outcome);
const char* status_name(ts_status status);
/// Does the outcome belong to an answer that could be judged, so that it has a severity?
bool is_judged(Outcome outcome);

/// Is the answer within the bar in every respect, so that it counts as right in shares?
bool agrees(Outcome outcome);

/// Are depth and normal right, but the contact points wrong?
bool is_of_points(Outcome outcome);

/// Are all numbers of the contact finite?
bool is_finite(const ts_answer& answer);

/// The limits within which an answer agrees with the truth.
struct Bar {
  /// Relative to the smaller size. Drake's published protocol for contact queries overlaps bodies
  /// of 20 cm by 2 mm; 1e-4 of their half extent is one two-hundredth of that overlap.
  double tolerance = 1e-4;
  /// Candidates are asked for contacts up to this distance apart, metres.
  double threshold = 0;
};

/// The length to which errors are relative, metres: the smaller size, but large enough that the
/// tolerance is at least 1e-13 of the larger size, since doubles place a body to about 1e-16 of
/// that. With the default tolerance this is 1e-9 of the larger size. Over a plane, distances from
/// the origins count as sizes, too.
double error_size(const Configuration& configuration, const Bar& bar);

/// One answer compared with the truth. Errors are relative to error_size; errors that the answer
/// does not define are absent.
struct Score {
  Outcome outcome = Outcome::agree;
  std::optional<double> depth_error;  ///< answer's signed distance − true: positive is too shallow
  /// What the answered normal costs (felt_regret), and against the whole bodies: σ − g(n).
  std::optional<double> normal_regret, whole_regret;
  /// Degrees to the nearest optimal normal, of families too (angle_to_optimal).
  std::optional<double> normal_angle;
  /// Largest depth of a point − true depth: negative if a solver sees too little overlap.
  std::optional<double> deepest_error;
  /// Largest point_outside of a contact point, or zero.
  std::optional<double> point_error;
  /// Coverage of the contact patch, if the bodies are in contact and the normal is
  /// within the bar.
  std::optional<double> coverage;
  /// For a simplified model that knows its own signed distance, or an engine that says how it
  /// rounds the bodies: the model's distance − true, and the answer's − that distance. They add up
  /// to the depth error. Of a missed contact, too: where the model is apart, the solver has no part
  /// in it.
  std::optional<double> model_error, solver_error;
  int points = 0;
  /// Size of the failure: the largest of the errors of depth (of the answer or its points) and the
  /// regret. Zero is perfect.
  double severity = 0;
};

/// Coverage refers to the patch within `patch_depth` of the bodies' support planes along the
/// nearest optimal normal. If it is narrower than `patch_resolution`, or only as wide as a rounded,
/// tilted or sharp feature is within that depth, it counts as a point or a segment. Both are
/// relative to the smaller size. The depth is that within which engines make contact points: pe's
/// contact threshold is 1e-6.
inline constexpr double patch_depth = 1e-6;
inline constexpr double patch_resolution = 0.1;

/// The optimal normal along which an answer's contact points are judged: the one nearest to its own
/// normal. Not all members of a continuum are listed; an answer far from all listed ones is judged
/// along its own normal.
Vec3 patch_normal(const oracle::Truth& truth, const Vec3& n);

/// Judges answers to one configuration. What depends on configuration and truth alone (the exact
/// difference of the bodies, the patches along the optimal normals) is made once, at the first
/// answer that needs it. Both must outlive the judge.
class Judge {
 public:
  Judge(const Configuration& configuration, const oracle::Truth& truth, const Bar& bar);
  Judge(Judge&&) noexcept;
  ~Judge();

  Score score(const ts_answer& answer);
  /// Adds the errors of model and solver. The signed distance of bodies that the candidate has
  /// rounded in its way is the oracle's, too.
  Score score(const Answer& answer);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// What a Judge says of a single answer.
Score score(const Configuration& configuration, const oracle::Truth& truth, const ts_answer& answer,
            const Bar& bar);
Score score(const Configuration& configuration, const oracle::Truth& truth, const Answer& answer,
            const Bar& bar);

/// Share of a contact patch that the hull of the contact points spans, seen along the normal: the
/// largest factor, at most 1, such that the patch shrunk by it about its centroid lies within the
/// hull. Equivalently, the hull's extent from the patch's centroid relative to the patch's own,
/// minimised over directions: it tells how far a body's weight may lean before it tips. For a full
/// disc, three points on its rim 120° apart give 1/2, four give cos 45°, eight cos 22.5°; points
/// that do not surround the centroid give 0.
///
/// A patch that is nowhere wider than `resolution` (metres) counts as a point, which any contact
/// point covers fully; one that is narrower in one direction only counts as a segment, which points
/// must span on both sides. Points off the patch or off its plane are not penalised here.
double coverage(const oracle::ContactPatch& patch, const std::vector<Vec3>& points,
                double resolution);

/// A contact patch with what its coverage by any points needs.
struct PatchExtent {
  explicit PatchExtent(oracle::ContactPatch patch);

  oracle::ContactPatch patch;
  oracle::Vec2 centre;  ///< centroid
  oracle::Vec2 narrow;  ///< direction in which it is narrowest
  double min_width;     ///< along `narrow`
  double width_across;  ///< perpendicular to it
};
double coverage(const PatchExtent& extent, const std::vector<Vec3>& points, double resolution);

}  // namespace touchstone
