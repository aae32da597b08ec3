#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "simulation/world.hpp"

namespace touchstone {

/// Normal regret, as a share of the smaller size, below which a normal separates the bodies as well
/// as the true one, and is none that is wrong.
inline constexpr double equal_regret = 1e-6;

/// One answer of a contact model during a run, with its errors.
struct JudgedAnswer {
  int frame;     ///< index of the states that were asked about
  int a, b;      ///< bodies as in PairQuestion
  double depth;  ///< true depth, metres; negative apart
  ts_status status;
  double signed_distance;  ///< as answered, metres; zero without a contact
  /// The answered normal, where it separates the bodies less than the true one does.
  std::optional<Vec3> wrong_normal;
  int points;

  /// Error of the answered depth, metres; zero for bodies rightly found apart.
  double depth_error() const;
};
template <class Archive>
void members(Archive& a, JudgedAnswer& j) {
  a(j.frame, j.a, j.b, j.depth, j.status, j.signed_distance, j.wrong_normal, j.points);
}
/// The motion of a scene, and what its contact model answered.
struct Trajectory {
  double step = 0;                             ///< s
  std::vector<std::vector<BodyState>> frames;  ///< the start, then one for each step
  std::vector<JudgedAnswer> answers;           ///< in order of time
  bool sound = true;  ///< false: the motion left all bounds, and the frames end there
  double points = 0;  ///< contact points given to the solver, of all pairs, mean of a step
  /// Wall-clock time of each step: in our world without the contact model, in an engine's all.
  std::vector<double> step_seconds = {};

  double end() const { return step * static_cast<double>(frames.size() - 1); }
  Configuration configuration(const Scene& scene, const JudgedAnswer& answer) const;
};
/// Runs the scene to its duration. The true depths and normals are those of our own routines (held
/// to 1e-13).
Trajectory run_scene(const Scene& scene, ContactModel& model);

/// A line for each body that moves: where it ends, to a micrometre, how far that is from its start,
/// and the largest true depth of its contacts with or as a cylinder; or that nothing moves. Says
/// how many questions had no answer.
std::string motion_table(const Scene& scene, const Trajectory& run);

/// Runs the scene in another world, such as an engine's, which finds its own contacts. The answers,
/// if they are asked for, have the true depths of pairs with a cylinder, and no contact.
Trajectory run_scene(const Scene& scene, const Simulator& simulator, bool with_depths);

/// All body pairs of a scene whose shapes have the same kind and, to six digits, the same sizes:
/// they share a contact model.
struct PairKind {
  std::string name;                   ///< "cylinder ⌀0.1×0.3 on box 1×1×0.2"
  std::string bodies;                 ///< "can-1 and ground", "6 pairs, as can-1 and can-2"
  Pair pair;                          ///< which shape meets the cylinder
  std::vector<JudgedAnswer> answers;  ///< in order of time
};

/// The kinds of pairs that a run asked about, in the order of their first question.
class PairKinds {
 public:
  PairKinds(const Scene& scene, const Trajectory& run);
  const std::vector<PairKind>& all() const { return kinds_; }
  /// Index of the kind of two bodies, in either order; −1 if no pair like them was asked about.
  int of(int a, int b) const;

 private:
  std::vector<std::string> shapes_;  ///< by body
  std::map<std::pair<std::string, std::string>, int> index_;
  std::vector<PairKind> kinds_;
};

/// "cylinder ⌀0.1×0.3" (diameter and full length), "box 1×2×0.5", "sphere ⌀0.2", "plane".
std::string shape_text(const Shape& shape);

/// How much of a run is kept.
struct RecordingOptions {
  std::uint64_t count = 40;  ///< configurations of each pair of shapes, at most
  std::uint64_t seed = 1;
};

/// A configuration near contact that occurred in a run, for others like it.
struct RecordedQuestion {
  JudgedAnswer answer;
  std::uint64_t weight;  ///< number of questions that it stands for
};

/// Signed distance, as a share of the smaller size, below which bodies are near contact: what
/// overlaps, and what will in the next steps. A narrow phase is also asked about bodies that are
/// far apart, because their boxes overlap; these say nothing about contacts.
inline constexpr double near_contact = 0.05;

/// Samples the questions near contact of a run. Those of each pair of shapes, ordered by bodies and
/// then by time, are divided into equal parts, and one of each part is drawn: every question is
/// equally likely, and the sample is spread evenly over pairs of bodies and over time.
std::vector<RecordedQuestion> sample_near_contact(const Scene& scene, const Trajectory& run,
                                                  const RecordingOptions& options);

/// JSON Lines of {"id": "log-pile/left and upper/0.25", "scene", "weight", "configuration"}; the id
/// has the bodies' names and the time in seconds.
std::string recording_lines(const std::string& scene_name, const Scene& scene,
                            const Trajectory& run, const std::vector<RecordedQuestion>& questions);

}  // namespace touchstone
