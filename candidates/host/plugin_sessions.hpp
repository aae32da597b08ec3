#pragma once

#include <cstdint>

#include "candidates/host/plugin_process.hpp"
#include "candidates/host/respondent.hpp"

namespace touchstone {

struct SessionCommand;
class Watch;

/// As it is asked of a plug-in. `previous_normal` is null if there was no contact before.
Question question_of(const Configuration& configuration, double threshold,
                     const Vec3* previous_normal);

/// A candidate of a plug-in, which answers in sessions: forks of its plug-in's process, which has
/// loaded the plug-in and done nothing else. A configuration that ends its session is answered with
/// TS_CRASHED or TS_TIMED_OUT, and the next one gets a new session. An end that the configuration
/// may not have caused (a signal that others may have sent, a timeout) counts only if it happens
/// again in another session with that configuration alone.
class PluginSessions : public Respondent {
 public:
  PluginSessions(const Candidate& candidate, double threshold, const Limits& limits);

  void ask_within(double threshold) override;
  std::vector<Answer> answers(std::span<const Configuration> configurations) override;
  std::vector<Answer> answers_until_timeout(std::span<const Configuration> configurations,
                                            bool in_new_session) override;
  std::vector<Answer> answer(std::span<const Configuration> configurations,
                             std::span<const Vec3* const> previous_normals,
                             std::span<const double> thresholds) override;
  void restart() override { end(); }
  void release_shapes() override { forgets_ = true; }
  bool prepare_timing(std::span<const Configuration> configurations) override;
  std::optional<QueryCost> cost_per_query() override;

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
  void put(std::uint32_t slot, const Configuration& configuration, double threshold,
           const Vec3* previous_normal = nullptr);
  /// How a call asks its questions.
  struct Manner {
    bool release;                ///< shapes are released once they are not needed
    bool until_timeout = false;  ///< nothing is answered after a time-out
  };
  std::vector<Answer> answer(std::span<const Configuration> configurations,
                             std::span<const Vec3* const> previous_normals,
                             std::span<const double> thresholds, Manner manner);
  void answer_batch(std::uint32_t count, Manner manner, std::vector<Answer>& answers);
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
  /// Of slot `current` of a command. `alone`: nothing else is asked in the session, so that
  /// exceeding the limit may be its verdict, and no mere reason to ask it again alone.
  TimeLimit time_limit(const SessionCommand& command, std::uint32_t current, bool alone) const;
  /// Notes what limits of time are learnt from.
  void learn(std::uint32_t slot);
  void learn(const SessionFailure& verdict);
  void forget_times();
  /// Why a command that makes no progress has waited too long for so many configurations; empty if
  /// it has not.
  std::string judge(const Watch& watch, std::size_t configurations);
  /// Hands over what is timed and warms up; false if the session died.
  bool keep_for_timing(std::span<const Configuration> configurations);
  /// Kills the session; its plug-in's process, too, if that does not leave a clean one.
  void kill_session();

  Candidate candidate_;
  double threshold_;
  Limits limits_;
  PluginProcess plugin_;
  int session_ = -1;                    ///< process, or -1
  bool forgets_ = false;                ///< shapes kept ready, at the next batch
  std::uint64_t ticket_ = 0;            ///< ticket of the last command
  std::uint64_t session_ticket_ = 0;    ///< ticket of the command that began the session
  double max_wait_;                     ///< seconds that a query may wait
  std::vector<double> answer_seconds_;  ///< that the first answers took
  int timeouts_ = 0;                    ///< verdicts since
  std::size_t timed_ = 0;               ///< configurations of prepare_timing
  std::size_t timings_ = 0;             ///< calls of prepare_timing that the session has served
  std::uint64_t timing_ticket_ = 0;     ///< session_ticket_ of the session that serves them
};

}  // namespace touchstone
