// Queries one candidate in sessions of its plug-in's process; exchange.hpp defines the messages.
#include "candidates/host/plugin_sessions.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <sched.h>
#include <signal.h>
#include <stdexcept>
#include <sys/wait.h>
#include <type_traits>
#include <unistd.h>
#include <utility>

#include "candidates/candidates.hpp"
#include "candidates/host/exchange.hpp"
#include "candidates/host/guard.hpp"
#include "candidates/host/watch.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

using Clock = std::chrono::steady_clock;

/// Interval at which a candidate's use of processor time is checked, and that at which its waiting
/// is, which costs a hundred times as much to find out.
constexpr std::chrono::milliseconds check_interval(1), wait_interval(20);

/// Time in which a plug-in's process must fork a session.
constexpr std::chrono::seconds fork_timeout(10);
/// Time in which a session with nothing more to do must end.
constexpr std::chrono::seconds finish_timeout(1);

/// Slow configurations are queried so often, and prepared once, by warm_up and by time of
/// session.cpp: to warm up and in one measured pass. Passes are repeated only where they take
/// microseconds.
constexpr std::size_t queries_per_round = 2;

/// Calls of prepare_timing that one session serves: a new session takes longer than a timed round,
/// and a routine that leaks must not end all of them.
constexpr std::size_t max_timings = 16;

/// Can the signal come from a timer, another process or the kernel, and not only from the routine
/// that dies of it?
bool may_come_from_elsewhere(int signal) {
  constexpr int own[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP, SIGSYS};
  return std::ranges::find(own, signal) == std::end(own);
}

SessionCommand plain_command(SessionCommand::Kind kind) {
  SessionCommand command{};
  command.kind = kind;
  return command;
}

/// The only processor that this process may run on, or -1 if there are more.
int only_processor() {
  cpu_set_t set;
  return sched_getaffinity(0, sizeof set, &set) == 0 && CPU_COUNT(&set) == 1 ? sched_getcpu() : -1;
}

}  // namespace

PluginSessions::PluginSessions(const Candidate& candidate, const Limits& limits)
    : candidate_(candidate),
      limits_(limits),
      times_(limits.seconds),
      plugin_(candidate.plugin()->file) {}

std::optional<NoAnswer> PluginSessions::begin() {
  plugin_.clear_text();
  const auto failure = [](std::string why) {
    return NoAnswer{TS_CRASHED, std::move(why), true, true};
  };
  bool is_refused = false;
  for (int attempt = 0; attempt < 2; ++attempt) {
    try {
      if (!plugin_.runs()) plugin_.start();
    } catch (const NoHost&) {
      throw;
    } catch (const InvalidInput& e) {
      return failure(e.what());
    }
    if (static_cast<std::size_t>(candidate_.plugin()->index) >= plugin_.candidates().size()) {
      return failure("its plug-in no longer has it");
    }
    SessionCommand command = plain_command(SessionCommand::begin);
    command.ticket = session_ticket_ = ++ticket_;
    command.index = candidate_.plugin()->index;
    command.parameter = candidate_.value;
    command.memory = static_cast<std::uint64_t>(limits_.mebibytes * (1 << 20));
    const bool is_sent = plugin_.send(command);
    pid_t sender = -1;
    const auto reply =
        is_sent ? plugin_.await(Reply::began, command.ticket, fork_timeout, &sender) : std::nullopt;
    is_refused = reply && reply->value < 0;
    if (reply && !is_refused) {
      session_ = sender;
      return std::nullopt;
    }
    plugin_.stop();
  }
  if (is_refused) throw std::runtime_error("no process could be made for " + candidate_.name);
  return failure("its plug-in's process, loaded anew, answers no more");
}

void PluginSessions::end(bool gently) {
  if (session_ < 0) return;
  const pid_t session = std::exchange(session_, -1);
  const auto told = [&] {
    return gently ? plugin_.send(plain_command(SessionCommand::finish))
                  : kill(session, SIGKILL) == 0;
  };
  if (!plugin_.is_unforked() && told()) {
    const auto reply = plugin_.await(Reply::ended, session_ticket_, finish_timeout);
    if (reply && !reply->left_behind) return;
  }
  plugin_.stop();
}

std::optional<NoAnswer> PluginSessions::obey(SessionCommand command, std::size_t configurations) {
  using Received = PluginProcess::Received;
  const bool is_fresh = session_ < 0;
  std::optional<NoAnswer> begin_failure = is_fresh ? begin() : std::nullopt;
  command.ticket = ++ticket_;
  plugin_.exchange().progress = progress_of(ticket_, 0);
  if (begin_failure) return begin_failure;
  const bool is_alone = is_fresh && command.count == 1;
  const auto stopped = [&](std::string reason) {
    plugin_.stop();
    session_ = -1;
    return NoAnswer{TS_CRASHED, std::move(reason)};
  };
  if (!plugin_.send(command)) return stopped("its plug-in's process ended");

  // Most commands finish before the first check.
  std::optional<double> computed;  // processor time at the last progress
  std::optional<Watch> watch;      // begun later, for commands that take long
  std::uint64_t progress = progress_of(ticket_, 0);
  auto next_check = Clock::now() + check_interval, next_judgement = next_check;
  for (;;) {
    std::string too_long;
    bool has_waited = false;
    if (const auto time = Clock::now(); time >= next_check) {
      next_check = time + check_interval;
      const std::uint64_t now = plugin_.exchange().progress;
      const auto number = static_cast<double>(configurations);
      const bool has_advanced = now > progress && now <= progress_of(ticket_, command.count);
      if (has_advanced) progress = now;  // or else it may have been overwritten
      if (!computed || has_advanced) {
        computed = processor_seconds(session_);
        watch.reset();
        next_judgement = time + wait_interval;
      } else if (const auto limit = limit_of(command, progress, is_alone);
                 processor_seconds(session_) - *computed > limit.seconds * number) {
        too_long = limit.exceeded;
      } else if (time >= next_judgement) {
        next_judgement = time + wait_interval;
        if (watch) too_long = times_.waited_too_long(*watch, configurations);
        if (!watch) watch.emplace(session_);
        has_waited = !too_long.empty();
      }
    }
    // Receive at least once after the check, so that an answer that arrived before it counts.
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(next_check - Clock::now());
    Reply reply;
    const Received received = plugin_.receive(
        &reply, sizeof reply, std::max(too_long.empty() ? left : left * 0, left * 0));
    if (received == Received::end) return stopped("closed its connection to Touchstone");
    if (received == Received::message) {
      if (reply.kind == Reply::finished && reply.ticket == ticket_) return std::nullopt;
      if (auto failure = end_told_by(reply)) return failure;
    }
    if (!too_long.empty()) {
      end(false);
      // Processor time alone is no verdict: a busy machine may charge a process that it has just
      // made for much more than it has computed.
      return NoAnswer{TS_TIMED_OUT, too_long, false, has_waited && is_alone};
    }
  }
}

std::optional<NoAnswer> PluginSessions::end_told_by(const Reply& reply) {
  const bool has_ended = reply.kind == Reply::ended && reply.ticket == session_ticket_;
  if (!has_ended && reply.kind != Reply::gone) return std::nullopt;
  session_ = -1;
  NoAnswer failure = end_of_session(reply.value);
  if (has_ended && !reply.left_behind) return failure;
  plugin_.stop();
  // What was left behind may have answered on.
  if (has_ended) failure.is_certain = false;
  if (has_ended || plugin_.is_unforked()) return failure;
  return NoAnswer{TS_CRASHED, "its plug-in's process: " + how_it_ended(reply.value)};
}

TimeLimits::Limit PluginSessions::limit_of(const SessionCommand& command, std::uint64_t progress,
                                           bool alone) const {
  if (command.kind != SessionCommand::answer) return times_.full();
  std::vector<double> latest;
  for (std::uint32_t i = 0; progress_of(ticket_, i) < progress; ++i) {
    latest.push_back(plugin_.exchange().slots[i].seconds);
  }
  // A session that others rely on (it keeps shapes) is not ended on suspicion.
  return times_.lowered(latest, !alone && command.release);
}

NoAnswer PluginSessions::end_of_session(int status) const {
  NoAnswer failure{TS_CRASHED, how_it_ended(status), false, true};
  if (WIFEXITED(status) && WEXITSTATUS(status) == exit_thrown) {
    const char* const text = plugin_.exchange().thrown;
    failure.reason = "threw " + std::string(text, strnlen(text, sizeof plugin_.exchange().thrown));
  }
  if (WIFSIGNALED(status)) {
    failure.is_certain = !may_come_from_elsewhere(WTERMSIG(status));
    if (WTERMSIG(status) == SIGABRT && !plugin_.last_line().empty()) {
      failure.reason += ": " + plugin_.last_line();
    }
  }
  return failure;
}

std::optional<Answer> PluginSessions::answer_in(std::uint32_t i) const {
  const Slot slot = plugin_.exchange().slots[i];
  if (slot.seal != seal_of(slot, ticket_)) return std::nullopt;
  Answer answer{slot.answer, {}, {}};
  if (!std::isnan(slot.model_distance)) answer.model_distance = slot.model_distance;
  // A status or number of points that the interface does not allow is a failure of the candidate.
  // Read as an integer: an enumeration must not even be looked at with another value in it.
  std::underlying_type_t<ts_status> status;
  std::memcpy(&status, &slot.answer.status, sizeof status);
  if (status < TS_CONTACT || status > TS_FAILED || answer.point_count < 0 ||
      answer.point_count > TOUCHSTONE_MAX_POINTS) {
    static_cast<ts_answer&>(answer) = {};
    answer.status = TS_FAILED;
  }
  return answer;
}

std::optional<NoAnswer> PluginSessions::ask(std::span<const Asked> asked, bool release,
                                            std::span<std::optional<Answer>> answers) {
  for (std::size_t i = 0; i < asked.size(); ++i)
    plugin_.questions().slots[i] = question_of(asked[i]);
  SessionCommand command = plain_command(SessionCommand::answer);
  command.count = static_cast<std::uint32_t>(asked.size());
  command.release = release;
  command.forget = std::exchange(forgets_, false);
  std::optional<NoAnswer> failure = obey(command);
  std::uint32_t in_hand = command.count;  // the first without an answer
  for (std::uint32_t i = command.count; i-- > 0;) {
    if (!(answers[i] = answer_in(i))) in_hand = i;
  }
  for (std::uint32_t i = 0; i < command.count; ++i) {
    if (answers[i]) times_.learn(plugin_.exchange().slots[i].seconds);
  }
  if (failure) failure->is_of_first = plugin_.exchange().progress == progress_of(ticket_, in_hand);
  return failure;
}

void PluginSessions::judge(const NoAnswer& failure) {
  if (failure.status == TS_TIMED_OUT) times_.learn_timeout();
}

bool PluginSessions::prepare_timing(std::span<const Asked> asked) {
  if (session_ticket_ != timing_ticket_ || timings_ == max_timings) end_session();
  const bool is_reused = session_ >= 0;
  timings_ = is_reused ? timings_ + 1 : 1;
  bool is_ready = keep_for_timing(asked);
  if (!is_ready && is_reused) {  // what the session did before may be the cause
    end_session();
    timings_ = 1;
    is_ready = keep_for_timing(asked);
  }
  timing_ticket_ = session_ticket_;
  return is_ready;
}

bool PluginSessions::keep_for_timing(std::span<const Asked> asked) {
  timed_ = asked.size();
  for (std::size_t at = 0; at < asked.size(); at += batch_size) {
    const auto batch = asked.subspan(at, std::min<std::size_t>(batch_size, asked.size() - at));
    for (std::size_t i = 0; i < batch.size(); ++i) {
      plugin_.questions().slots[i] = question_of(batch[i]);
    }
    SessionCommand keep = plain_command(SessionCommand::keep);
    keep.count = static_cast<std::uint32_t>(batch.size());
    keep.release = at == 0;
    keep.processor = only_processor();
    if (obey(keep)) return false;
  }
  return !obey(plain_command(SessionCommand::warm_up), queries_per_round * timed_);
}

std::optional<QueryCost> PluginSessions::cost_per_query() {
  if (session_ < 0 || obey(plain_command(SessionCommand::time), queries_per_round * timed_)) {
    return std::nullopt;
  }
  const Exchange& exchange = plugin_.exchange();
  if (!std::isfinite(exchange.nanoseconds)) return std::nullopt;
  QueryCost cost{exchange.nanoseconds, std::nullopt};
  if (std::isfinite(exchange.instructions)) cost.instructions = exchange.instructions;
  if (std::isfinite(exchange.tail_nanoseconds)) cost.tail = exchange.tail_nanoseconds;
  return cost;
}

}  // namespace touchstone
