#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "candidates/candidates.hpp"
#include "reference/configuration.hpp"

namespace touchstone {

struct SessionCommand;
class Watch;

/// Resources that one configuration may use before the candidate's process is ended.
struct Limits {
  /// Processor time: three frames of a simulation, thousands of times that of a query. Once a
  /// candidate has exceeded it within one call of CandidateProcess::answers, it is lower for the
  /// rest of the call: a thousand times the candidate's median there, at least a tenth. A query may
  /// wait for something else ten times as long; for a candidate that does so repeatedly within one
  /// call of CandidateProcess::answers this is halved each time, down to the limit itself. Waiting
  /// for a processor does not count.
  double seconds = 0.05;
  double mebibytes = 1024;  ///< growth of its memory
};

/// A candidate's answer, or the reason why there is none.
struct Answer : ts_answer {
  std::string reason;  ///< for TS_CRASHED and TS_TIMED_OUT: "Segmentation fault", "threw …"
  std::optional<double> model_distance;  ///< signed distance of a simplified model's shapes, metres
};

/// The cost of one query.
struct QueryCost {
  double nanoseconds;
  std::optional<double> instructions;  ///< in user space; absent if they cannot be counted
};

/// A plug-in, loaded in a process of its own: its symbols, global state and crashes affect neither
/// other plug-ins nor this process. Throws InvalidInput (field "--candidate") when it cannot be
/// loaded.
class PluginProcess {
 public:
  /// Time allowed for loading it, which may read libraries from a cold disk.
  static constexpr std::chrono::milliseconds loading_time = std::chrono::seconds(30);
  explicit PluginProcess(const std::filesystem::path& file,
                         std::chrono::milliseconds loading = loading_time);
  ~PluginProcess();
  PluginProcess(PluginProcess&&) noexcept;
  PluginProcess& operator=(PluginProcess&&) noexcept;

  const std::vector<Candidate>& candidates() const;

 private:
  friend class CandidateProcess;
  struct State;
  std::unique_ptr<State> state_;
};

/// One candidate, which answers in sessions: forks of its plug-in's process, which has loaded the
/// plug-in and done nothing else. A configuration that ends its session is answered with TS_CRASHED
/// or TS_TIMED_OUT, and the next one gets a new session. An end that the configuration may not have
/// caused (a signal that others may have sent, a timeout) counts only if it happens again in a
/// session with that configuration alone.
class CandidateProcess {
 public:
  CandidateProcess(const Candidate& candidate, double threshold, const Limits& limits = {});

  const Candidate& candidate() const { return candidate_; }

  /// Ends the session. The next one reports contacts up to `threshold` metres apart.
  void ask_within(double threshold);

  /// Answers in a new session, so that the answers depend on these configurations alone.
  std::vector<Answer> answers(std::span<const Configuration> configurations);
  /// Answers in the session of the last call, if there is one. `previous_normal` (unit, world
  /// frame, from B to A) is the candidate's hint; null means that there was no contact before.
  Answer answer(const Configuration& configuration, const Vec3* previous_normal = nullptr);
  /// Answers several configurations in that session; `previous_normals` is empty or has one for
  /// each.
  std::vector<Answer> answer(std::span<const Configuration> configurations,
                             std::span<const Vec3* const> previous_normals = {});
  /// Ends the session. The next call begins a new one.
  void restart() { end(); }

  /// Prepares shapes for timing in a new session and queries them once, untimed. Keeps as many as
  /// take about half a millisecond together, at least ten. False if the session died.
  bool prepare_timing(std::span<const Configuration> configurations);
  /// Times one round over the prepared shapes: the candidate's process reads the clock around a
  /// loop that contains only calls. Absent if the session died.
  std::optional<QueryCost> cost_per_query();

 private:
  /// The premature end of a session.
  struct SessionFailure {
    ts_status status;
    std::string reason;
    bool certain;  ///< the current configuration is certainly the cause
  };

  /// Begins a session; absent on success.
  std::optional<SessionFailure> begin();
  void end();
  void put(std::uint32_t slot, const Configuration& configuration,
           const Vec3* previous_normal = nullptr);
  std::vector<Answer> answer(std::span<const Configuration> configurations,
                             std::span<const Vec3* const> previous_normals, bool release);
  void answer_batch(std::uint32_t count, bool release, std::vector<Answer>& answers);
  /// The answer in this slot, if it belongs to the last command.
  std::optional<Answer> answer_in(std::uint32_t slot) const;
  /// Answers this slot's question in a session of its own.
  Answer answer_alone(std::uint32_t slot);
  static Answer answer_of(const SessionFailure& failure);
  /// Sends a command and waits for its end; absent on success. `configurations`: how many it may
  /// query before it reports progress; each may take as long as the limits say.
  std::optional<SessionFailure> obey(SessionCommand command, std::size_t configurations = 1);
  SessionFailure end_of_session(int wait_status) const;
  /// Processor time that a configuration may use, and what to say of one that uses more.
  struct TimeLimit {
    double seconds;
    std::string exceeded;
  };
  /// Of slot `current` of a command. `alone`: the session has answered nothing before it, so that
  /// exceeding the limit is its verdict, and no mere reason to ask it again alone.
  TimeLimit time_limit(const SessionCommand& command, std::uint32_t current, bool alone) const;
  /// Notes what limits of time are learnt from.
  void learn(std::uint32_t slot);
  void learn(const SessionFailure& verdict);
  void forget_times();
  /// Why a command that makes no progress has waited too long for so many configurations; empty if
  /// it has not.
  std::string judge(const Watch& watch, std::size_t configurations);
  /// Kills the session; its plug-in's process, too, if that does not leave a clean one.
  void kill_session();

  Candidate candidate_;
  double threshold_;
  Limits limits_;
  PluginProcess plugin_;
  int session_ = -1;                    ///< process, or -1
  std::uint64_t ticket_ = 0;            ///< ticket of the last command
  std::uint64_t session_ticket_ = 0;    ///< ticket of the command that began the session
  double max_wait_;                     ///< seconds that a query may wait
  std::vector<double> answer_seconds_;  ///< that the first answers took
  bool has_timed_out_ = false;
  std::size_t timed_ = 0;  ///< configurations of prepare_timing
};

/// Starts one process for each candidate.
std::vector<CandidateProcess> start(const std::vector<const Candidate*>& candidates,
                                    double threshold, const Limits& limits = {});
std::vector<CandidateProcess*> pointers(std::vector<CandidateProcess>& processes);

}  // namespace touchstone
