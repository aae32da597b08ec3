// Queries one candidate in sessions of its plug-in's process; exchange.hpp defines the messages.
#include "candidates/host/plugin_sessions.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
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
#include "candidates/readable.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

using Clock = std::chrono::steady_clock;

/// Interval at which a candidate's use of processor time is checked, and that at which its waiting
/// is, which costs a hundred times as much to find out.
constexpr std::chrono::milliseconds check_interval(1), wait_interval(20);

/// The lower limit of processor time of a candidate that has exceeded the full one, and beyond
/// which a configuration is asked again alone: a multiple of the median of its answers, but at
/// least a share of the full one. So many answers must be known, or so many must have timed out: of
/// a candidate that hardly ever answers, the median is never well known. The few answers that are
/// known then came first in their sessions, where they take ten times as long.
constexpr double median_factor = 100, first_median_factor = 10, min_share = 0.1;
constexpr std::size_t min_known = 15, max_known = 255;
constexpr int many_timeouts = 3;

/// Time in which a plug-in's process must fork a session.
constexpr std::chrono::seconds fork_timeout(10);
/// Time in which a session with nothing more to do must end.
constexpr std::chrono::seconds finish_timeout(1);

/// Multiples of the limit of processor time: how long a query may wait at first, and how long it
/// may take by the clock if the kernel does not distinguish waiting for something from waiting for
/// a processor.
constexpr double initial_wait_factor = 10, clock_factor = 100;

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
  switch (signal) {
    case SIGSEGV:
    case SIGBUS:
    case SIGFPE:
    case SIGILL:
    case SIGABRT:
    case SIGTRAP:
    case SIGSYS:
      return false;
    default:
      return true;
  }
}

SessionCommand plain_command(SessionCommand::Kind kind) {
  SessionCommand command{};
  command.kind = kind;
  return command;
}

SessionCommand answer_command(std::uint32_t first, std::uint32_t count, bool release) {
  SessionCommand command = plain_command(SessionCommand::answer);
  command.first = first;
  command.count = count;
  command.release = release;
  return command;
}

/// The only processor that this process may run on, or -1 if there are more.
int only_processor() {
  cpu_set_t set;
  return sched_getaffinity(0, sizeof set, &set) == 0 && CPU_COUNT(&set) == 1 ? sched_getcpu() : -1;
}

}  // namespace

Question question_of(const Configuration& c, double threshold, const Vec3* previous_normal) {
  const Vec3 hint = previous_normal ? *previous_normal : Vec3(Vec3::Zero());
  return {to_ts_shape(c.a),
          to_ts_shape(c.b),
          to_ts_pose(c.pose_a),
          to_ts_pose(c.pose_b),
          threshold,
          previous_normal != nullptr,
          {hint.x(), hint.y(), hint.z()}};
}

PluginSessions::PluginSessions(const Candidate& candidate, double threshold, const Limits& limits)
    : candidate_(candidate),
      threshold_(threshold),
      limits_(limits),
      plugin_(candidate.plugin),
      max_wait_(initial_wait_factor * limits.seconds) {}

std::optional<PluginSessions::SessionFailure> PluginSessions::begin() {
  using Received = PluginProcess::State::Received;
  PluginProcess::State& s = *plugin_.state_;
  if (ftruncate(s.text, 0) != 0) fail("ftruncate");
  bool forked = true;
  for (int attempt = 0; attempt < 2; ++attempt) {
    try {
      if (!s.runs()) s.start(PluginProcess::loading_time);
    } catch (const NoHost&) {
      throw;
    } catch (const InvalidInput& e) {
      return SessionFailure{TS_CRASHED, e.what(), true};
    }
    if (static_cast<std::size_t>(candidate_.index) >= s.candidates.size()) {
      return SessionFailure{TS_CRASHED, "its plug-in no longer has it", true};
    }
    SessionCommand command = plain_command(SessionCommand::begin);
    command.ticket = session_ticket_ = ++ticket_;
    command.index = candidate_.index;
    command.parameter = candidate_.value;
    command.memory = static_cast<std::uint64_t>(limits_.mebibytes * (1 << 20));
    const auto end = Clock::now() + fork_timeout;
    for (bool waits = s.send(command); waits && Clock::now() < end;) {
      Reply reply;
      pid_t sender = -1;
      const Received received = s.receive(&reply, sizeof reply, fork_timeout, &sender);
      waits = received != Received::end;
      if (received != Received::message || reply.kind != Reply::began ||
          reply.ticket != command.ticket) {
        continue;
      }
      forked = reply.value >= 0;
      if (!forked) break;
      session_ = sender;
      return std::nullopt;
    }
    s.stop();
  }
  if (!forked) throw std::runtime_error("no process could be made for " + candidate_.name);
  return SessionFailure{TS_CRASHED, "its plug-in's process, loaded anew, answers no more", true};
}

void PluginSessions::end() {
  if (session_ < 0) return;
  session_ = -1;
  using Received = PluginProcess::State::Received;
  PluginProcess::State& s = *plugin_.state_;
  if (s.unforked) return s.stop();
  SessionCommand command = plain_command(SessionCommand::finish);
  command.ticket = ++ticket_;
  const auto end = Clock::now() + finish_timeout;
  for (bool waits = s.send(command); waits && Clock::now() < end;) {
    Reply reply;
    const Received received = s.receive(&reply, sizeof reply, finish_timeout);
    waits = received != Received::end;
    if (received == Received::message && reply.kind == Reply::ended &&
        reply.ticket == session_ticket_) {
      if (reply.left_behind) break;
      return;
    }
  }
  s.stop();
}

void PluginSessions::ask_within(double threshold) {
  end();
  forget_times();
  threshold_ = threshold;
}

void PluginSessions::put(std::uint32_t slot, const Configuration& c, double threshold,
                         const Vec3* previous_normal) {
  plugin_.state_->questions->slots[slot] = question_of(c, threshold, previous_normal);
}

std::optional<PluginSessions::SessionFailure> PluginSessions::obey(SessionCommand command,
                                                                   std::size_t configurations) {
  using Received = PluginProcess::State::Received;
  PluginProcess::State& s = *plugin_.state_;
  std::optional<SessionFailure> begin_failure;
  const bool fresh = session_ < 0;
  if (fresh) begin_failure = begin();
  command.ticket = ++ticket_;
  s.exchange->progress = progress_of(ticket_, command.first);
  if (begin_failure) return begin_failure;
  const auto stopped = [&](ts_status status, std::string reason) {
    s.stop();
    session_ = -1;
    return SessionFailure{status, std::move(reason), false};
  };
  if (!s.send(command)) return stopped(TS_CRASHED, "its plug-in's process ended");

  // Most commands finish before the first check.
  std::optional<double> computed;  // processor time at the last progress
  std::optional<Watch> watch;      // begun later, for commands that take long
  std::uint64_t progress = s.exchange->progress;
  const auto limit_now = [&] {
    const auto current = std::min(static_cast<std::uint32_t>(progress), command.count);
    return time_limit(command, current, fresh && command.count == command.first + 1);
  };
  auto next_check = Clock::now() + check_interval, next_judgement = next_check;
  for (;;) {
    std::string too_long;
    bool has_waited = false;
    if (const auto time = Clock::now(); time >= next_check) {
      next_check = time + check_interval;
      const std::uint64_t now = s.exchange->progress;
      if (!computed || (now > progress && now <= progress_of(ticket_, command.count))) {
        progress = now;
        computed = processor_seconds(session_);
        watch.reset();
        next_judgement = time + wait_interval;
      } else if (const auto limit = limit_now();
                 processor_seconds(session_) - *computed >
                 limit.seconds * static_cast<double>(configurations)) {
        too_long = limit.exceeded;
      } else if (time >= next_judgement) {
        next_judgement = time + wait_interval;
        if (watch) {
          too_long = judge(*watch, configurations);
          has_waited = !too_long.empty();
        } else {
          watch.emplace(session_);
        }
      }
    }
    // Receive at least once after the check, so that an answer that arrived before it counts.
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(next_check - Clock::now());
    Reply reply;
    const Received received =
        s.receive(&reply, sizeof reply, std::max(too_long.empty() ? left : left * 0, left * 0));
    if (received == Received::message) {
      if (reply.kind == Reply::finished && reply.ticket == ticket_) return std::nullopt;
      if (reply.kind == Reply::ended && reply.ticket == session_ticket_) {
        session_ = -1;
        SessionFailure failure = end_of_session(reply.value);
        if (reply.left_behind) {
          s.stop();
          failure.certain = false;  // what was left may have answered on
        }
        return failure;
      }
      if (reply.kind == Reply::gone && s.unforked) {
        s.stop();
        session_ = -1;
        return end_of_session(reply.value);
      }
      if (reply.kind == Reply::gone) {
        return stopped(TS_CRASHED, "its plug-in's process: " + how_it_ended(reply.value));
      }
    } else if (received == Received::end) {
      return stopped(TS_CRASHED, "closed its connection to Touchstone");
    }
    if (!too_long.empty()) {
      kill_session();
      // Processor time alone is no verdict: a busy machine may charge a process that it has just
      // made for much more than it has computed.
      const bool is_alone = fresh && static_cast<std::uint32_t>(progress) == command.first;
      return SessionFailure{TS_TIMED_OUT, too_long, has_waited && is_alone};
    }
  }
}

void PluginSessions::kill_session() {
  using Received = PluginProcess::State::Received;
  PluginProcess::State& s = *plugin_.state_;
  if (s.unforked) {
    session_ = -1;
    return s.stop();
  }
  const auto end = Clock::now() + finish_timeout;
  for (bool waits = kill(std::exchange(session_, -1), SIGKILL) == 0; waits && Clock::now() < end;) {
    Reply reply;
    const Received received = s.receive(&reply, sizeof reply, finish_timeout);
    waits = received != Received::end;
    if (received != Received::message || reply.kind != Reply::ended ||
        reply.ticket != session_ticket_) {
      continue;
    }
    if (reply.left_behind) break;
    return;
  }
  s.stop();
}

PluginSessions::TimeLimit PluginSessions::time_limit(const SessionCommand& command,
                                                     std::uint32_t current, bool alone) const {
  TimeLimit full = {limits_.seconds, "no answer within " + seconds_text(limits_.seconds)};
  if (command.kind != SessionCommand::answer) return full;
  // A session that others rely on (it keeps shapes) is not ended on suspicion.
  const bool is_suspicion = !alone && command.release;
  if (timeouts_ == 0 && !is_suspicion) return full;
  std::vector<double> sorted = answer_seconds_;
  for (std::uint32_t i = command.first; i < current; ++i) {
    const double seconds = plugin_.state_->exchange->slots[i].seconds;
    if (std::isfinite(seconds)) sorted.push_back(seconds);
  }
  const bool are_few = sorted.size() < min_known;
  if (are_few && timeouts_ < many_timeouts) return full;
  const double least = min_share * limits_.seconds;
  if (sorted.empty()) {
    return {least, "no answer within " + seconds_text(least) + ", as others within " +
                       seconds_text(limits_.seconds)};
  }
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  const double learnt = (are_few ? first_median_factor : median_factor) * *middle;
  if (learnt >= limits_.seconds) return full;
  // Without the number, which is measured and differs from run to run.
  return {std::max(least, learnt), "no answer within " + seconds_text(least) + " and " +
                                       (are_few ? "ten" : "a hundred") + " times its median"};
}

void PluginSessions::learn(std::uint32_t i) {
  const double seconds = plugin_.state_->exchange->slots[i].seconds;
  if (answer_seconds_.size() < max_known && std::isfinite(seconds)) {
    answer_seconds_.push_back(seconds);
  }
}

void PluginSessions::learn(const SessionFailure& verdict) {
  timeouts_ += verdict.status == TS_TIMED_OUT;
}

void PluginSessions::forget_times() {
  answer_seconds_.clear();
  timeouts_ = 0;
  max_wait_ = initial_wait_factor * limits_.seconds;
}

std::string PluginSessions::judge(const Watch& watch, std::size_t configurations) {
  const Watch::TimeUse spent = watch.spent();
  const double seconds = limits_.seconds * static_cast<double>(configurations);
  const double max_wait = max_wait_ * static_cast<double>(configurations);
  if (!spent.waiting) {
    const double limit = clock_factor * seconds;
    if (spent.by_the_clock > limit)
      return "no answer within " + seconds_text(limit) + " by the clock";
  } else if (*spent.waiting > max_wait) {
    std::string text = "no answer, having waited for " + seconds_text(max_wait);
    max_wait_ = std::max(limits_.seconds, max_wait_ / 2);
    return text;
  }
  return "";
}

PluginSessions::SessionFailure PluginSessions::end_of_session(int status) const {
  const PluginProcess::State& s = *plugin_.state_;
  if (WIFEXITED(status) && WEXITSTATUS(status) == exit_thrown) {
    const char* const text = s.exchange->thrown;
    return {TS_CRASHED, "threw " + std::string(text, strnlen(text, sizeof s.exchange->thrown)),
            true};
  }
  SessionFailure failure{TS_CRASHED, how_it_ended(status), true};
  if (WIFSIGNALED(status)) {
    failure.certain = !may_come_from_elsewhere(WTERMSIG(status));
    if (WTERMSIG(status) == SIGABRT && !s.last_line().empty()) {
      failure.reason += ": " + s.last_line();
    }
  }
  return failure;
}

Answer PluginSessions::answer_of(const SessionFailure& failure) {
  Answer answer{};
  answer.status = failure.status;
  answer.reason = readable(failure.reason);
  return answer;
}

std::optional<Answer> PluginSessions::answer_in(std::uint32_t i) const {
  const Slot slot = plugin_.state_->exchange->slots[i];
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

Answer PluginSessions::answer_alone(std::uint32_t i) {
  end();
  const auto failure = obey(answer_command(i, i + 1, true));
  if (const auto answer = answer_in(i)) return *answer;
  if (failure) learn(*failure);
  return answer_of(failure.value_or(SessionFailure{TS_CRASHED, "wrote over its own answer", true}));
}

void PluginSessions::answer_batch(std::uint32_t count, Manner manner,
                                  std::vector<Answer>& answers) {
  std::vector<std::optional<Answer>> given(count);
  for (std::uint32_t first = 0; first < count;) {
    SessionCommand command = answer_command(first, count, manner.release);
    command.forget = std::exchange(forgets_, false);
    const auto failure = obey(command);
    for (std::uint32_t i = first; i < count; ++i) {
      if ((given[i] = answer_in(i))) learn(i);
    }
    const auto none = std::find(given.begin(), given.end(), std::nullopt);
    const auto in_hand = static_cast<std::uint32_t>(none - given.begin());
    if (in_hand == count) break;
    if (failure && plugin_.state_->exchange->progress == progress_of(ticket_, in_hand)) {
      if (failure->certain) learn(*failure);
      given[in_hand] = failure->certain ? answer_of(*failure) : answer_alone(in_hand);
      first = in_hand + 1;
      if (manner.until_timeout && given[in_hand]->status == TS_TIMED_OUT) {
        given.resize(first);
        break;
      }
      continue;
    }
    // An unknown query has overwritten answers.
    for (std::uint32_t i = in_hand; i < count; ++i) {
      if (!given[i]) given[i] = answer_alone(i);
    }
    break;
  }
  for (auto& answer : given) answers.push_back(std::move(*answer));
}

std::vector<Answer> PluginSessions::answers(std::span<const Configuration> configurations) {
  end();
  forget_times();
  return answer(configurations, {}, {}, Manner{.release = true});
}

std::vector<Answer> PluginSessions::answers_until_timeout(
    std::span<const Configuration> configurations, bool in_new_session) {
  if (in_new_session) {
    end();
    forget_times();
  }
  return answer(configurations, {}, {}, Manner{.release = true, .until_timeout = true});
}

std::vector<Answer> PluginSessions::answer(std::span<const Configuration> configurations,
                                           std::span<const Vec3* const> previous_normals,
                                           std::span<const double> thresholds) {
  return answer(configurations, previous_normals, thresholds, Manner{.release = false});
}

std::vector<Answer> PluginSessions::answer(std::span<const Configuration> configurations,
                                           std::span<const Vec3* const> previous_normals,
                                           std::span<const double> thresholds, Manner manner) {
  std::vector<Answer> result;
  result.reserve(configurations.size());
  for (std::size_t at = 0; at < configurations.size(); at += batch_size) {
    const auto batch =
        configurations.subspan(at, std::min<std::size_t>(batch_size, configurations.size() - at));
    for (std::uint32_t i = 0; i < batch.size(); ++i) {
      put(i, batch[i], thresholds.empty() ? threshold_ : thresholds[at + i],
          previous_normals.empty() ? nullptr : previous_normals[at + i]);
    }
    answer_batch(static_cast<std::uint32_t>(batch.size()), manner, result);
    if (manner.until_timeout && end_after_timeout(result)) break;
  }
  return result;
}

bool PluginSessions::prepare_timing(std::span<const Configuration> configurations) {
  if (session_ticket_ != timing_ticket_ || timings_ == max_timings) end();
  const bool is_reused = session_ >= 0;
  timings_ = is_reused ? timings_ + 1 : 1;
  bool is_ready = keep_for_timing(configurations);
  if (!is_ready && is_reused) {  // what the session did before may be the cause
    end();
    timings_ = 1;
    is_ready = keep_for_timing(configurations);
  }
  timing_ticket_ = session_ticket_;
  return is_ready;
}

bool PluginSessions::keep_for_timing(std::span<const Configuration> configurations) {
  timed_ = configurations.size();
  for (std::size_t at = 0; at < configurations.size(); at += batch_size) {
    const auto batch =
        configurations.subspan(at, std::min<std::size_t>(batch_size, configurations.size() - at));
    for (std::uint32_t i = 0; i < batch.size(); ++i) put(i, batch[i], threshold_);
    SessionCommand keep = plain_command(SessionCommand::keep);
    keep.count = static_cast<std::uint32_t>(batch.size());
    keep.release = at == 0;
    keep.processor = only_processor();
    if (obey(keep)) return false;
  }
  return !configurations.empty() &&
         !obey(plain_command(SessionCommand::warm_up), queries_per_round * timed_);
}

std::optional<QueryCost> PluginSessions::cost_per_query() {
  if (session_ < 0 || obey(plain_command(SessionCommand::time), queries_per_round * timed_)) {
    return std::nullopt;
  }
  const Exchange& exchange = *plugin_.state_->exchange;
  if (!std::isfinite(exchange.nanoseconds)) return std::nullopt;
  QueryCost cost{exchange.nanoseconds, std::nullopt};
  if (std::isfinite(exchange.instructions)) cost.instructions = exchange.instructions;
  if (std::isfinite(exchange.tail_nanoseconds)) cost.tail = exchange.tail_nanoseconds;
  return cost;
}

}  // namespace touchstone
