#pragma once

#include <cstdint>

#include "candidates/host/plugin_process.hpp"
#include "candidates/host/respondent.hpp"
#include "candidates/host/time_limits.hpp"

namespace touchstone {

/// A candidate of a plug-in, which answers in sessions: forks of its plug-in's process, which has
/// loaded the plug-in and done nothing else. Questions and answers lie in shared memory, so that it
/// is known which question a session had in hand when it ended. That question is certainly the
/// cause unless others may have ended the session, too: by a signal, or by keeping the machine
/// busy.
class PluginSessions : public Respondent {
 public:
  PluginSessions(const Candidate& candidate, const Limits& limits);

  std::optional<NoAnswer> ask(std::span<const Asked> asked, bool release,
                              std::span<std::optional<Answer>> answers) override;
  void judge(const NoAnswer& failure) override;
  void forget() override { times_.forget(); }
  void end_session() override { end(true); }
  void release_shapes() override { forgets_ = true; }
  bool prepare_timing(std::span<const Asked> asked) override;
  std::optional<QueryCost> cost_per_query() override;

 private:
  /// Begins a session; absent on success.
  std::optional<NoAnswer> begin();
  /// Ends the session, gently or by killing it; its plug-in's process, too, if that does not leave
  /// a clean one.
  void end(bool gently);
  /// The answer in this slot, if it belongs to the last command.
  std::optional<Answer> answer_in(std::uint32_t slot) const;
  /// Sends a command and waits for its end; absent on success. `configurations`: how many it may
  /// query before it reports progress; each may take as long as the limits say.
  std::optional<NoAnswer> obey(SessionCommand command, std::size_t configurations = 1);
  /// How the session has ended, if this message says so.
  std::optional<NoAnswer> end_told_by(const Reply& reply);
  NoAnswer end_of_session(int wait_status) const;
  /// Of the question that a command has come to. `alone`: nothing else is asked in the session.
  TimeLimits::Limit limit_of(const SessionCommand& command, std::uint64_t progress,
                             bool alone) const;
  /// Hands over what is timed and warms up; false if the session died.
  bool keep_for_timing(std::span<const Asked> asked);

  Candidate candidate_;
  Limits limits_;
  TimeLimits times_;
  PluginProcess plugin_;
  int session_ = -1;                  ///< process, or -1
  bool forgets_ = false;              ///< shapes kept ready, at the next batch
  std::uint64_t ticket_ = 0;          ///< ticket of the last command
  std::uint64_t session_ticket_ = 0;  ///< ticket of the command that began the session
  std::size_t timed_ = 0;             ///< configurations of prepare_timing
  std::size_t timings_ = 0;           ///< calls of prepare_timing that the session has served
  std::uint64_t timing_ticket_ = 0;   ///< session_ticket_ of the session that serves them
};

}  // namespace touchstone
