// Queries one candidate in sessions of its plug-in's process; exchange.hpp defines the messages.
#include "candidates/host/plugin_sessions.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <memory>
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

/// The lower limit of processor time of a candidate that has exceeded the full one, and beyond
/// which a configuration is asked again alone: a multiple of the median of its answers, but at
/// least a share of the full one. So many answers must be known, or so many must have timed out: of
/// a candidate that hardly ever answers, the median is never well known. The few answers that are
/// known then came first in their sessions, where they take ten times as long.
constexpr double median_factor = 100, first_median_factor = 10, min_share = 0.1;
constexpr std::size_t min_known = 15, max_known = 255;
constexpr int many_timeouts = 3;

/// Multiples of the limit of processor time: how long a query may wait at first, and how long it
/// may take by the clock if the kernel does not distinguish waiting for something from waiting for
/// a processor.
constexpr double initial_wait_factor = 10, clock_factor = 100;

using Clock = std::chrono::steady_clock;

/// Interval at which a candidate's use of processor time is checked, and that at which its waiting
/// is, which costs a hundred times as much to find out.
constexpr std::chrono::milliseconds check_interval(1), wait_interval(20);
/// Longer for a command: its processor time is the sum over all its processes, which costs as much
/// to read as waiting does.
constexpr std::chrono::milliseconds check_interval_of_command(10);

/// Time in which a plug-in's process must fork a session.
constexpr std::chrono::seconds fork_timeout(10);
/// Time in which a session with nothing more to do must end.
constexpr std::chrono::seconds finish_timeout(1);

/// Slow configurations are queried so often, and prepared once, by warm_up and by time of
/// session.cpp: to warm up and in one measured pass. Passes are repeated only where they take
/// microseconds. Two rounds of a command, which compare its clock with ours, do as much, and need
/// so many seconds at least.
constexpr double queries_per_round = 2, min_rounds_of_command = 0.02;
constexpr int clock_rounds = 3;
constexpr double max_ratio = 1e6;  ///< of clocks

/// Failures of a command in a row after which the rest of the questions is not asked.
constexpr int max_failures = 5;

/// More steps than warming up a command for timing has.
constexpr std::uint32_t max_steps = 1u << 20;

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
      times_(limits.seconds, candidate.plugin() != nullptr),
      is_command_(candidate.command() != nullptr) {}

std::optional<NoAnswer> PluginSessions::begin() {
  const auto failure = [](std::string why) {
    return NoAnswer{TS_CRASHED, std::move(why), true, true};
  };
  bool is_refused = false;
  for (const bool is_first : {true, false}) {
    try {
      if (!plugin_ || !plugin_->runs()) {
        plugin_ = is_command_ ? std::make_unique<PluginProcess>(*candidate_.command())
                              : std::make_unique<PluginProcess>(candidate_.plugin()->file);
      }
    } catch (const NoHost&) {
      throw;
    } catch (const InvalidInput& e) {
      return failure(e.what());
    }
    plugin_->clear_text();
    const auto index = is_command_ ? 0 : static_cast<std::size_t>(candidate_.plugin()->index);
    const std::vector<Candidate>& found = plugin_->candidates();
    if (index >= found.size() || found[index].family != candidate_.family) {
      return failure("its plug-in no longer has it");
    }
    SessionCommand command = plain_command(SessionCommand::begin);
    command.ticket = session_ticket_ = ++ticket_;
    command.index = static_cast<std::int32_t>(index);
    command.parameter = candidate_.value;
    command.memory = static_cast<std::uint64_t>(limits_.mebibytes * (1 << 20));
    command.warm = is_first;  // what it did not survive is asked of no one again
    const bool is_sent = plugin_->send(command);
    pid_t sender = -1;
    const auto reply =
        is_sent ? plugin_->await(Reply::began, command.ticket,
                                 is_command_ ? PluginProcess::loading_time : fork_timeout, &sender)
                : std::nullopt;
    is_refused = reply && reply->value < 0;
    if (reply && !is_refused) {
      session_ = sender;
      return std::nullopt;
    }
    plugin_->stop();
  }
  if (is_refused) throw std::runtime_error("no process could be made for " + candidate_.name);
  return failure("its plug-in's process, loaded anew, answers no more");
}

std::optional<NoAnswer> PluginSessions::hand_over(std::span<const Asked> asked) {
  if (auto failure = session_ < 0 ? begin() : std::nullopt) return failure;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    plugin_->questions().put(i, question_of(asked[i]));
  }
  return std::nullopt;
}

void PluginSessions::forget() {
  times_.forget();
  failures_ = 0;
}

void PluginSessions::end_session() {
  if (is_command_) {
    forgets_ = true;
  } else {
    end(true);
  }
}

void PluginSessions::end(bool gently) {
  if (session_ < 0) return;
  const pid_t session = std::exchange(session_, -1);
  const auto told = [&] {
    return gently ? plugin_->send(plain_command(SessionCommand::finish))
                  : kill(session, SIGKILL) == 0;
  };
  if (!plugin_->is_unforked() && told()) {
    const auto reply = plugin_->await(Reply::ended, session_ticket_, finish_timeout);
    if (reply && !reply->left_behind) return;
  }
  plugin_->stop();
}

std::optional<NoAnswer> PluginSessions::obey(SessionCommand command, double configurations) {
  using Received = PluginProcess::Received;
  command.ticket = ++ticket_;
  plugin_->exchange().progress = progress_of(ticket_, 0);
  const bool is_alone = is_fresh() && command.count == 1;
  const auto stopped = [&](std::string reason) {
    plugin_->stop();
    session_ = -1;
    return NoAnswer{TS_CRASHED, std::move(reason)};
  };
  if (!plugin_->send(command)) return stopped("its plug-in's process ended");

  // Most commands finish before the first check.
  const auto watched = is_command_ ? Watched::descendants_too : Watched::process;
  const auto interval = is_command_ ? check_interval_of_command : check_interval;
  std::optional<double> computed;  // processor time at the last progress
  std::optional<Watch> watch;      // begun later, for commands that take long
  std::uint64_t progress = progress_of(ticket_, 0);
  auto next_check = Clock::now() + interval, next_judgement = next_check;
  for (;;) {
    std::optional<NoAnswer> verdict;
    if (const auto time = Clock::now(); time >= next_check) {
      next_check = time + interval;
      const std::uint64_t now = plugin_->exchange().progress;
      const bool has_advanced = now > progress && now <= progress_of(ticket_, command.count);
      if (has_advanced) progress = now;  // or else it may have been overwritten
      if (!computed || has_advanced) {
        computed = processor_seconds(session_, watched);
        watch.reset();
        next_judgement = time + wait_interval;
      } else if (const auto limit = limit_of(command, progress, is_alone);
                 processor_seconds(session_, watched) - *computed >
                 limit.seconds * configurations) {
        // Processor time alone is no verdict: a busy machine may charge a process that it has just
        // made for much more than it has computed.
        verdict = NoAnswer{TS_TIMED_OUT, limit.exceeded};
      } else if (time >= next_judgement) {
        next_judgement = time + wait_interval;
        if (!watch) {
          watch.emplace(session_, watched);
        } else if (auto reason = times_.waited_too_long(*watch, configurations); !reason.empty()) {
          verdict = NoAnswer{TS_TIMED_OUT, std::move(reason), false, is_alone};
        } else if (is_command_ && watch->resident_mebibytes() > limits_.mebibytes) {
          verdict = NoAnswer{TS_CRASHED,
                             fmt::format("used more than {:.0f} MiB of memory", limits_.mebibytes)};
        }
      }
    }
    // Receive at least once after the check, so that an answer that arrived before it counts.
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(next_check - Clock::now());
    Reply reply;
    const Received received =
        plugin_->receive(&reply, sizeof reply, std::max(verdict ? left * 0 : left, left * 0));
    if (received == Received::end) return stopped("closed its connection to Touchstone");
    if (received == Received::message) {
      if (reply.kind == Reply::finished && reply.ticket == ticket_) return std::nullopt;
      if (auto failure = end_told_by(reply)) return failure;
    }
    if (verdict) {
      end(false);
      return verdict;
    }
  }
}

std::optional<NoAnswer> PluginSessions::end_told_by(const Reply& reply) {
  const bool has_ended = reply.kind == Reply::ended && reply.ticket == session_ticket_;
  if (!has_ended && reply.kind != Reply::gone) return std::nullopt;
  session_ = -1;
  NoAnswer failure = end_of_session(reply.value);
  if (has_ended && !reply.left_behind) return failure;
  plugin_->stop();
  // What was left behind may have answered on.
  if (has_ended) failure.is_certain = false;
  if (has_ended || plugin_->is_unforked()) return failure;
  return NoAnswer{TS_CRASHED, "its plug-in's process: " + how_it_ended(reply.value)};
}

TimeLimits::Limit PluginSessions::limit_of(const SessionCommand& command, std::uint64_t progress,
                                           bool alone) const {
  if (command.kind != SessionCommand::answer) return times_.full();
  std::vector<double> latest;
  for (std::uint32_t i = 0; progress_of(ticket_, i) < progress; ++i) {
    latest.push_back(plugin_->exchange().slots[i].seconds);
  }
  // A session that others rely on (it keeps shapes) is not ended on suspicion.
  return times_.lowered(latest, !alone && command.release);
}

NoAnswer PluginSessions::end_of_session(int status) const {
  NoAnswer failure{TS_CRASHED, how_it_ended(status), false, true};
  if (WIFEXITED(status) && WEXITSTATUS(status) == exit_thrown) {
    failure.reason = (is_command_ ? "" : "threw ") + text_of(plugin_->exchange().text);
  }
  if (WIFSIGNALED(status)) {
    failure.is_certain = !may_come_from_elsewhere(WTERMSIG(status));
    if (WTERMSIG(status) == SIGABRT && !plugin_->last_line().empty()) {
      failure.reason += ": " + plugin_->last_line();
    }
  }
  return failure;
}

std::optional<Answer> PluginSessions::answer_in(std::uint32_t i) const {
  const Slot slot = plugin_->exchange().slots[i];
  if (slot.seal != seal_of(slot, ticket_)) return std::nullopt;
  Answer answer{slot.answer, {}, {}, {}};
  slot.modelled.copy_to(answer);
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
  if (failures_ >= max_failures) {
    return NoAnswer{TS_CRASHED, "was not asked after failures in a row; the last: " + last_failure_,
                    true, true};
  }
  if (auto failure = hand_over(asked)) return failure;
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
    if (answers[i]) times_.learn(plugin_->exchange().slots[i].seconds);
  }
  if (in_hand > 0) failures_ = 0;
  if (!failure) return failure;
  failure->is_of_first = plugin_->exchange().progress == progress_of(ticket_, in_hand);
  if (is_command_) {
    failure->is_certain &= is_fresh();
    if (const std::string line = plugin_->last_line(); !line.empty()) {
      failure->reason += "; standard error: " + line;
    }
  }
  return failure;
}

void PluginSessions::judge(const NoAnswer& failure) {
  if (failure.status == TS_TIMED_OUT) times_.learn_timeout();
  if (is_command_ && ++failures_ <= max_failures) last_failure_ = failure.reason;
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
    SessionCommand keep = plain_command(SessionCommand::keep);
    keep.count = static_cast<std::uint32_t>(batch.size());
    keep.release = at == 0;
    keep.processor = only_processor();
    if (hand_over(batch) || obey(keep)) return false;
  }
  SessionCommand warm_up = plain_command(SessionCommand::warm_up);
  warm_up.count = is_command_ ? max_steps : 0;
  return !obey(warm_up, queries_of_a_round()) && (!is_command_ || compare_clocks());
}

double PluginSessions::queries_of_a_round() const {
  return queries_per_round * static_cast<double>(timed_) +
         (is_command_ ? min_rounds_of_command / limits_.seconds : 0);
}

bool PluginSessions::time(std::uint32_t rounds) {
  SessionCommand command = plain_command(SessionCommand::time);
  command.count = rounds;
  return session_ >= 0 && !obey(command, queries_of_a_round()) &&
         std::isfinite(plugin_->exchange().nanoseconds);
}

bool PluginSessions::compare_clocks() {
  // What a request costs besides its queries is in both of two rounds of different length.
  double told = 0, ours = 0, computing = 0;
  for (int i = 0; i < clock_rounds; ++i) {
    for (const int sign : {-1, 1}) {
      const Watch watch(session_, Watched::descendants_too);
      if (!time(sign > 0 ? 2 : 1)) return false;
      const Watch::TimeUse spent = watch.spent();
      const Exchange& exchange = plugin_->exchange();
      told += sign * 1e-9 * exchange.nanoseconds * exchange.queries;
      ours += sign * spent.by_the_clock;
      computing += sign * spent.computing;
    }
  }
  ours = std::max(ours, 0.0);  // a busy machine may make the longer round the faster one
  computing = std::max(computing, 0.0);
  told = std::max({told, ours / max_ratio, 1e-12});  // of a child that tells nothing
  measured_ = {plugin_->exchange().floor, ours / told, computing / told};
  return true;
}

std::optional<QueryCost> PluginSessions::cost_per_query() {
  if (!time(1)) return std::nullopt;
  const Exchange& exchange = plugin_->exchange();
  QueryCost cost{std::max(exchange.nanoseconds, 1 / exchange.queries), std::nullopt};
  if (std::isfinite(exchange.instructions)) cost.instructions = exchange.instructions;
  if (std::isfinite(exchange.tail_nanoseconds)) cost.tail = exchange.tail_nanoseconds;
  if (is_command_) cost.measured = measured_;
  return cost;
}

void TimeLimits::forget() {
  max_wait_ = initial_wait_factor * full_;
  learnt_.clear();
  timeouts_ = 0;
}

void TimeLimits::learn(double seconds) {
  if (learnt_.size() < max_known && std::isfinite(seconds)) learnt_.push_back(seconds);
}

TimeLimits::Limit TimeLimits::full() const {
  return {full_, "no answer within " + seconds_text(full_)};
}

TimeLimits::Limit TimeLimits::lowered(const std::vector<double>& latest, bool on_suspicion) const {
  if (!are_lowered_ || (timeouts_ == 0 && !on_suspicion)) return full();
  std::vector<double> known = learnt_;
  std::copy_if(latest.begin(), latest.end(), std::back_inserter(known),
               [](double seconds) { return std::isfinite(seconds); });
  const bool are_few = known.size() < min_known;
  if (are_few && timeouts_ < many_timeouts) return full();
  const double least = min_share * full_;
  const std::string reason = "no answer within " + seconds_text(least);
  if (known.empty()) return {least, reason + ", as others within " + seconds_text(full_)};
  const auto middle = known.begin() + static_cast<std::ptrdiff_t>(known.size() / 2);
  std::nth_element(known.begin(), middle, known.end());
  const double limit = (are_few ? first_median_factor : median_factor) * *middle;
  if (limit >= full_) return full();
  // Without the number, which is measured and differs from run to run.
  return {std::max(least, limit),
          reason + " and " + (are_few ? "ten" : "a hundred") + " times its median"};
}

std::string TimeLimits::waited_too_long(const Watch& watch, double configurations) {
  const double max_wait = configurations * max_wait_,
               max_time = configurations * clock_factor * full_;
  const Watch::TimeUse spent = watch.spent();
  if (!spent.waiting && spent.by_the_clock > max_time) {
    return "no answer within " + seconds_text(max_time) + " by the clock";
  }
  if (spent.waiting.value_or(0) <= max_wait) return "";
  if (are_lowered_) max_wait_ = std::max(full_, max_wait_ / 2);
  return "no answer, having waited for " + seconds_text(max_wait);
}

}  // namespace touchstone
