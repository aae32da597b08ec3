#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "simulation/scenes/choose.hpp"
#include "simulation/scenes/engine_choice.hpp"
#include "simulation/scenes/robot_file.hpp"
#include "simulation/scenes/scene_file.hpp"

// Outputs of `touchstone choose`. `folder` holds the configurations of failures, one file each,
// for `touchstone replay`; `command` is the command line that a person would repeat.

namespace touchstone {

/// What a run's verdict on a need measured, with its unit: "12.3°".
std::string measured(const Verdict& verdict, const Need& need);

/// "can-1 and table": the bodies that a verdict is about where its need does not say it.
std::string bodies_of(const SceneFile& file, const Verdict& verdict);

/// What a run's verdict on a need came to, by the need's index: "BROKEN can stands within 1°: 3.2°
/// at 0.71 s", with what exact runs differ by if it compares with these.
std::string need_line(const SceneFile& file, const Spreads& spreads, std::size_t need,
                      const Verdict& verdict);
/// A sentence for each need that exact runs do not decide.
std::string undecidable_text(const Spreads& spreads);

/// What the answer does that nobody asked for: the largest overlap, and how far bodies end from
/// where they do with exact contacts, or in an engine with our routines. Empty if that is the
/// answer, or there is none.
std::string unasked_text(const Choice& choice);
std::string unasked_text(const EngineChoice& choice);
/// The longest step that sees each impact of the exact run, if it is below 0.1 s. Where exact
/// contacts fail, also the body that may move furthest in a step, as a share of its width, if that
/// is so far that contacts come late, or further than a broken need lets bodies overlap.
std::string long_step_text(const Choice& choice);
/// Names the engines' routines that meet all needs in less of a step than the answer, if any: they
/// are no models, and so no answer.
std::string cheaper_routines(const Choice& choice);

/// Limits on the errors of contacts between the shapes of a robot or world.
struct PairNeeds {
  double depth = 1e-3;                  ///< error of the depth, metres; a missed contact counts
  double angle = 5;                     ///< error of the normal, degrees
  std::uint64_t count = 200, seed = 1;  ///< sampled poses of each pair
};

/// One candidate on one pair of shapes.
struct PairCandidate {
  std::string name;
  ReplayScore score;
  bool serves;                         ///< keeps all limits
  std::optional<Configuration> worst;  ///< of one that does not serve: where it is worst
};

/// Two shapes and the candidates on them.
struct PairChoice {
  std::string name;                       ///< "cylinder ⌀0.1×0.3 on box 1×1×0.2"
  std::string example;                    ///< names of two such shapes of the file
  int count;                              ///< such pairs in the file
  std::vector<PairCandidate> candidates;  ///< the cheapest first, without those that lack the pair
  std::optional<std::size_t> chosen;      ///< index of the cheapest that serves
};

/// The cheapest models that serve for the pairs of shapes of a robot or world.
struct PairsChoice {
  std::string name;  ///< of the robot or world
  std::size_t shapes;
  std::vector<std::string> ignored;  ///< elements of the file
  PairNeeds needs;
  std::vector<PairChoice> pairs;

  bool all_served() const;
};

/// Scores all candidates on every cylinder of the file against everything that it can touch: shapes
/// of other links without a joint between them, not both of them fixed. Pairs of equal shapes count
/// once. Poses near contact are sampled (any orientation, any two features, up to a twentieth of
/// the smaller size or four times the depth limit), scored against the oracle and timed. The exact
/// candidate is chosen unless another one is cheaper by more than the machine's noise. Throws
/// InvalidInput if no cylinder can touch anything.
PairsChoice choose_for_pairs(const RobotFile& file, const PairNeeds& needs,
                             const std::vector<const Candidate*>& candidates, const Limits& limits);

/// Text for a terminal: the answer, what fails first with cheaper models, and the run of each
/// candidate.
std::string choice_text(const Choice& choice, const std::string& folder, std::size_t columns = 80);
std::string pairs_text(const PairsChoice& choice, const std::string& folder,
                       std::size_t columns = 80);

/// "capsule"; with several sizes "capsule; hull:16".
std::string setting_name(const EngineSetting& setting);
std::string engine_choice_text(const EngineChoice& choice, std::size_t columns = 80);

/// The scene's size, what it says of itself, and how often a run of it is made. `where`: its name,
/// and the engine that it is in.
std::string scene_text(const std::string& where, const SceneFile& file, const Trials& trials);
/// What broke first in a run: "can stands within 0.5°: 12.3° at 0.71 s, disturbance 3", or why it
/// ended.
std::string failure(const SceneFile& file, const RepeatedRun& run);
/// The same in few words: "need 3, 0.71 s, disturbance 3".
std::string first_failure(const RepeatedRun& run);
/// ", disturbance 3"; empty for the scene as it is written.
std::string in_disturbance(const RepeatedRun& run);
/// "16/17": the runs in which all needs held, of those that were made.
std::string share_held(const RepeatedRun& run);
/// A line of a table that a terminal is too narrow for, in words: "spheres:2: 3.1 µs a step, …".
std::string narrow_row(const std::string& name, const std::vector<std::string>& parts);
/// Terminals of less columns get tables in words.
inline constexpr std::size_t columns_of_tables = 80;

/// What choose.json says of any run: the verdicts on it, and in how many of its trials all held.
nlohmann::json run_json(const SceneFile& file, const RepeatedRun& run);

/// What choose.json says of a scene.
nlohmann::json scene_json(const SceneFile& file, const Trials& trials, const Spreads& spreads);

/// choose.json (docs/choose.schema.json).
nlohmann::json choice_json(const Choice& choice, const std::string& command,
                           const std::string& folder);
nlohmann::json pairs_json(const PairsChoice& choice, const std::string& command,
                          const std::string& folder);
nlohmann::json engine_choice_json(const EngineChoice& choice, const std::string& command);

/// Runs the scene again with exact contacts and with others, for a page to show them in motion.
nlohmann::json choice_motion(const Choice& choice, const Limits& limits);
nlohmann::json choice_motion(const EngineChoice& choice);

/// One self-contained page of choose.json and such motions.
std::string choice_page(nlohmann::json choice, nlohmann::json motion);

/// Writes the configurations of failures in place of those of an earlier choice. Throws
/// InvalidInput (field "--out") where that fails.
void write_evidence(const Choice& choice, const std::string& folder);
void write_evidence(const PairsChoice& choice, const std::string& folder);

/// File of the evidence of a run, by its index; of a candidate on a pair of shapes.
std::string evidence_file(const Choice& choice, std::size_t run, const std::string& folder);
std::string evidence_file(const PairsChoice& choice, std::size_t pair,
                          const PairCandidate& candidate, const std::string& folder);
/// Command that makes the worst run of a choice again, and draws it.
std::string render_command(const Choice& choice, const SceneRun& run);
/// Command that shows the evidence.
std::string replay_command(const std::string& file, const std::string& candidate);

}  // namespace touchstone
