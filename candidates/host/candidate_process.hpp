#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "candidates/answer.hpp"
#include "candidates/candidates.hpp"
#include "reference/configuration.hpp"

namespace touchstone {

class Respondent;
struct Asked;
struct NoAnswer;

/// Resources that one configuration may use before the candidate's process is ended.
struct Limits {
  /// Processor time: three frames of a simulation, thousands of times that of a query. Once a
  /// candidate of a plug-in has exceeded it, it is lower until the candidate is restarted, as by
  /// CandidateProcess::answers: a hundred times the candidate's median there, at least a tenth, as
  /// soon as it has given fifteen answers or exceeded a limit three times. A query may wait for
  /// something else ten times as long; for a candidate of a plug-in that does so repeatedly this is
  /// halved each time, down to the limit itself. Waiting for a processor does not count.
  double seconds = 0.05;
  double mebibytes = 1024;  ///< growth of its memory
};

/// The cost of one query.
struct QueryCost {
  double nanoseconds;
  std::optional<double> instructions;  ///< in user space; absent if they cannot be counted
  /// 95th percentile over the configurations, nanoseconds: each was timed singly, once after every
  /// round, and counts with its least time up to now. Absent where they cannot be timed singly.
  std::optional<double> tail = {};

  /// What is known of a time that a command measured itself.
  struct Measured {
    double floor;      ///< nanoseconds of a query of the same shapes far apart
    double our_clock;  ///< the queries' time by our clock, relative to what the command says
    double processor;  ///< their processor time, likewise
  };
  std::optional<Measured> measured = {};
};

/// One candidate that is asked in processes of its own: sessions of its plug-in's process, or a
/// command (plugin_sessions.hpp). Alone a function of this program is asked in the process that
/// this is used in (Candidate::Function).
///
/// Questions go in batches, and a failure costs one of them. The answers before it count. The
/// question that was in hand, if that is known, is asked once more, alone in a new session, unless
/// it is certain that it was the cause; then the failure is its answer. If it is not known, the
/// questions are asked again in halves, until one stands alone.
class CandidateProcess {
 public:
  CandidateProcess(const Candidate& candidate, double threshold, const Limits& limits = {});
  ~CandidateProcess();
  CandidateProcess(CandidateProcess&&) noexcept;
  CandidateProcess& operator=(CandidateProcess&&) noexcept;

  const Candidate& candidate() const { return candidate_; }

  /// Ends the session. The next one reports contacts up to `threshold` metres apart.
  void ask_within(double threshold);

  /// Answers in a new session, so that the answers depend on these configurations alone.
  std::vector<Answer> answers(std::span<const Configuration> configurations);
  /// Answers the first of these configurations, up to and including one that times out, as
  /// `answers` does: in a new session, or in that of the last call if there is one.
  std::vector<Answer> answers_until_timeout(std::span<const Configuration> configurations,
                                            bool in_new_session);
  /// Answers in the session of the last call, if there is one. `previous_normal` (unit, world
  /// frame, from B to A) is the candidate's hint; null means that there was no contact before.
  Answer answer(const Configuration& configuration, const Vec3* previous_normal = nullptr);
  /// Answers several configurations in that session. `previous_normals` and `thresholds` (metres,
  /// in place of the session's) are empty or have one for each.
  std::vector<Answer> answer(std::span<const Configuration> configurations,
                             std::span<const Vec3* const> previous_normals = {},
                             std::span<const double> thresholds = {});
  /// Ends the session. The next call begins a new one, which knows of no failures.
  void restart();
  /// Before the next call of `answer`, releases the shapes that are kept ready for it, in the same
  /// session: a candidate without other memory answers as if it had been asked nothing before.
  void release_shapes();

  /// Prepares shapes for timing in a session in which nothing is answered and queries them once,
  /// untimed. Keeps as many as take about half a millisecond together, at least ten. False if the
  /// session died, or if there is a routine for none of them.
  bool prepare_timing(std::span<const Configuration> configurations);
  /// Times one round over the prepared shapes: the candidate's process reads the clock around a
  /// loop that contains only calls. Absent if the session died.
  std::optional<QueryCost> cost_per_query();

 private:
  struct Manner {
    bool release;                ///< shapes are released once they are not needed
    bool until_timeout = false;  ///< nothing is answered after a time-out
  };
  std::vector<Answer> ask(std::span<const Configuration> configurations,
                          std::span<const Vec3* const> previous_normals,
                          std::span<const double> thresholds, Manner manner);
  /// Answers in a session of its own; a failure there is the answer.
  Answer answer_alone(const Asked& asked);
  Answer answer_of(const NoAnswer& failure);

  Candidate candidate_;
  double threshold_;
  std::unique_ptr<Respondent> respondent_;
};

/// Starts one process for each candidate.
std::vector<CandidateProcess> start(const std::vector<const Candidate*>& candidates,
                                    double threshold, const Limits& limits = {});
std::vector<CandidateProcess*> pointers(std::vector<CandidateProcess>& processes);

}  // namespace touchstone
