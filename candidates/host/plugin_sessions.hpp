#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "candidates/host/plugin_process.hpp"
#include "candidates/host/respondent.hpp"
#include "candidates/host/watch.hpp"

namespace touchstone {

/// How long a candidate may take for one configuration. Its time-outs lower the limits until the
/// next run, for a routine that never returns often does so many times; Limits::seconds of
/// candidate_process.hpp has the rule.
class TimeLimits {
 public:
  /// A limit of processor time, and what to say of one who exceeds it.
  struct Limit {
    double seconds;
    std::string exceeded;
  };

  /// `are_lowered`: by time-outs; else it is not known how long single answers take.
  TimeLimits(double seconds, bool are_lowered) : full_(seconds), are_lowered_(are_lowered) {
    forget();
  }
  void forget();
  /// Processor time of an answer, seconds; not finite: unknown.
  void learn(double seconds);
  /// An answer's verdict is that it timed out.
  void learn_timeout() { ++timeouts_; }

  Limit full() const;
  /// `latest`: seconds that answers took which are not learnt yet. `on_suspicion`: one who exceeds
  /// it is asked again alone, so that a limit is lowered before anything has timed out.
  Limit lowered(const std::vector<double>& latest, bool on_suspicion) const;
  /// Why so many configurations have waited too long since the watch began; empty if they have not.
  /// After that, the candidate may wait half as long.
  std::string waited_too_long(const Watch& watch, double configurations);

 private:
  double full_;  ///< seconds of processor time
  bool are_lowered_;
  double max_wait_;             ///< seconds
  std::vector<double> learnt_;  ///< seconds that the first answers took
  int timeouts_;
};

/// A candidate of a plug-in, which answers in sessions: forks of its plug-in's process, which has
/// loaded the plug-in and done nothing else. Questions and answers lie in shared memory, so that it
/// is known which question a session had in hand when it ended. That question is certainly the
/// cause unless others may have ended the session, too: by a signal, or by keeping the machine
/// busy.
///
/// A command has one session for as long as it runs, whose end only releases its shapes. What ends
/// it may come from any question before, and it is watched with all that it has started.
class PluginSessions : public Respondent {
 public:
  PluginSessions(const Candidate& candidate, const Limits& limits);

  std::optional<NoAnswer> ask(std::span<const Asked> asked, bool release,
                              std::span<std::optional<Answer>> answers) override;
  void judge(const NoAnswer& failure) override;
  void forget() override;
  void end_session() override;
  void release_shapes() override { forgets_ = true; }
  bool prepare_timing(std::span<const Asked> asked) override;
  std::optional<QueryCost> cost_per_query() override;

 private:
  /// Begins a session; absent on success.
  std::optional<NoAnswer> begin();
  /// Begins a session unless there is one, and hands over the questions of one batch.
  std::optional<NoAnswer> hand_over(std::span<const Asked> asked);
  /// Was nothing asked in the session before the last command?
  bool is_fresh() const { return ticket_ == session_ticket_ + 1; }
  /// Ends the session, gently or by killing it; its plug-in's process, too, if that does not leave
  /// a clean one.
  void end(bool gently);
  /// The answer in this slot, if it belongs to the last command.
  std::optional<Answer> answer_in(std::uint32_t slot) const;
  /// Sends a command to the session and waits for its end; absent on success. `configurations`: how
  /// many it may query before it reports progress; each may take as long as the limits say.
  std::optional<NoAnswer> obey(SessionCommand command, double configurations = 1);
  /// How the session has ended, if this message says so.
  std::optional<NoAnswer> end_told_by(const Reply& reply);
  NoAnswer end_of_session(int wait_status) const;
  /// Time limit of the question that a command has come to. `alone`: nothing else is asked in the
  /// session.
  TimeLimits::Limit limit_of(const SessionCommand& command, std::uint64_t progress,
                             bool alone) const;
  /// Hands over what is timed and warms up; false if the session died.
  bool keep_for_timing(std::span<const Asked> asked);
  /// Queries whose time one round of timing may take.
  double queries_of_a_round() const;
  /// Times so many rounds; false if the session died.
  bool time(std::uint32_t rounds);
  /// The command's clock beside ours; false if it died.
  bool compare_clocks();

  Candidate candidate_;
  Limits limits_;
  TimeLimits times_;
  bool is_command_;
  std::unique_ptr<PluginProcess> plugin_;  ///< null until it is asked
  int session_ = -1;                       ///< process, or -1
  bool forgets_ = false;                   ///< shapes kept ready, at the next batch
  std::uint64_t ticket_ = 0;               ///< ticket of the last command
  std::uint64_t session_ticket_ = 0;       ///< ticket of the command that began the session
  std::size_t timed_ = 0;                  ///< configurations of prepare_timing
  std::size_t timings_ = 0;                ///< calls of prepare_timing that the session has served
  std::uint64_t timing_ticket_ = 0;        ///< session_ticket_ of the session that serves them
  int failures_ = 0;                       ///< of a command, in a row
  std::string last_failure_;
  QueryCost::Measured measured_{};  ///< of a command's times
};

}  // namespace touchstone
