// Asks one candidate in sessions of its plug-in's process; exchange.hpp says what goes between
// them.
#include "candidates/candidate_process.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <poll.h>
#include <signal.h>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

#include "candidates/candidates.hpp"
#include "candidates/exchange.hpp"
#include "candidates/plugin_state.hpp"

namespace touchstone {
namespace {

using Clock = std::chrono::steady_clock;

/// How often a candidate's use of time is looked at.
constexpr int poll_milliseconds = 20;

/// Seconds of processor time that a process has used; zero when it is gone.
double processor_seconds(pid_t pid) {
  clockid_t clock;
  timespec time{};
  if (clock_getcpuclockid(pid, &clock) != 0 || clock_gettime(clock, &time) != 0) return 0;
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

CandidateProcess::CandidateProcess(const Candidate& candidate, double threshold,
                                   const Limits& limits)
    : candidate_(candidate), threshold_(threshold), limits_(limits), plugin_(candidate.plugin) {}

void CandidateProcess::begin() {
  const PluginProcess::State& s = *plugin_.state_;
  if (ftruncate(s.text, 0) != 0) fail("ftruncate");
  s.send({Command::begin, 0, 0, candidate_.index, threshold_, candidate_.value,
          static_cast<std::uint64_t>(limits_.mebibytes * (1 << 20))});
  session_ = s.receive().value;
  if (session_ < 0) throw std::runtime_error("no process could be made for " + candidate_.name);
}

void CandidateProcess::end() {
  if (session_ < 0) return;
  plugin_.state_->send({Command::finish, 0, 0, 0, 0, 0, 0});
  plugin_.state_->receive();
  session_ = -1;
}

void CandidateProcess::ask_within(double threshold) {
  end();
  threshold_ = threshold;
}

void CandidateProcess::put(std::uint32_t slot, const Configuration& c,
                           const Vec3* previous_normal) {
  const Vec3 hint = previous_normal ? *previous_normal : Vec3(Vec3::Zero());
  plugin_.state_->exchange->slots[slot].question = {
      to_ts_shape(c.a),     to_ts_shape(c.b),           to_ts_pose(c.pose_a),
      to_ts_pose(c.pose_b), previous_normal != nullptr, {hint.x(), hint.y(), hint.z()}};
}

std::optional<Answer> CandidateProcess::obey(std::uint32_t kind, std::uint32_t first,
                                             std::uint32_t count) {
  const PluginProcess::State& s = *plugin_.state_;
  if (session_ < 0) begin();
  s.exchange->done = first;
  s.send({static_cast<Command::Kind>(kind), first, count, 0, 0, 0, 0});

  // Most commands are done before anyone looks; the watch begins when the first look is over.
  std::optional<std::uint32_t> done;
  double used = 0;
  Clock::time_point since;
  bool killed = false;
  pollfd polled{s.socket, POLLIN, 0};
  while (poll(&polled, 1, poll_milliseconds) <= 0) {  // nothing yet, or a signal
    if (done != s.exchange->done) {
      done = s.exchange->done;
      used = processor_seconds(session_);
      since = Clock::now();
    } else if (!killed &&
               (processor_seconds(session_) - used > limits_.seconds ||
                Clock::now() - since > std::chrono::duration<double>(100 * limits_.seconds))) {
      kill(session_, SIGKILL);
      killed = true;
    }
  }
  Report report = s.receive();
  if (report.kind == Report::finished) {
    if (killed) {  // just too late: the work is done, the session is not
      s.receive();
      session_ = -1;
    }
    return std::nullopt;
  }
  session_ = -1;

  Answer answer{};
  answer.status = killed ? TS_TIMED_OUT : TS_CRASHED;
  const int status = report.value;
  if (killed) {
    char limit[32];
    std::snprintf(limit, sizeof limit, "%g", limits_.seconds);
    answer.reason = std::string("no answer within ") + limit + " s";
  } else if (WIFEXITED(status) && WEXITSTATUS(status) == exit_thrown) {
    answer.reason = "threw " + std::string(s.exchange->thrown,
                                           strnlen(s.exchange->thrown, sizeof s.exchange->thrown));
  } else {
    answer.reason = how_it_ended(status);
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT && !s.last_line().empty()) {
      answer.reason += ": " + s.last_line();
    }
  }
  answer.reason = readable(answer.reason);
  return answer;
}

void CandidateProcess::answer_batch(std::uint32_t count, std::vector<Answer>& answers) {
  Exchange& exchange = *plugin_.state_->exchange;
  std::uint32_t first = 0;
  while (first < count) {
    const std::optional<Answer> misdeed = obey(Command::answer, first, count);
    const std::uint32_t done = misdeed ? std::min<std::uint32_t>(exchange.done, count) : count;
    for (; first < done; ++first) {
      const Slot& slot = exchange.slots[first];
      Answer& answer = answers.emplace_back(Answer{slot.answer, {}, {}});
      if (!std::isnan(slot.model_distance)) answer.model_distance = slot.model_distance;
      // Statuses and points that the interface does not allow are the candidate's failure.
      if (answer.status < TS_CONTACT || answer.status > TS_FAILED || answer.point_count < 0 ||
          answer.point_count > TOUCHSTONE_MAX_POINTS) {
        static_cast<ts_answer&>(answer) = {};
        answer.status = TS_FAILED;
      }
    }
    if (misdeed && first < count) {
      answers.push_back(*misdeed);
      ++first;
    }
  }
}

std::vector<Answer> CandidateProcess::answers(std::span<const Configuration> configurations) {
  end();
  return answer(configurations);
}

std::vector<Answer> CandidateProcess::answer(std::span<const Configuration> configurations,
                                             std::span<const Vec3* const> previous_normals) {
  std::vector<Answer> result;
  for (std::size_t at = 0; at < configurations.size(); at += Exchange::batch) {
    const auto batch = configurations.subspan(
        at, std::min<std::size_t>(Exchange::batch, configurations.size() - at));
    for (std::uint32_t i = 0; i < batch.size(); ++i) {
      put(i, batch[i], previous_normals.empty() ? nullptr : previous_normals[at + i]);
    }
    answer_batch(static_cast<std::uint32_t>(batch.size()), result);
  }
  return result;
}

Answer CandidateProcess::answer(const Configuration& configuration, const Vec3* previous_normal) {
  std::vector<Answer> result;
  put(0, configuration, previous_normal);
  answer_batch(1, result);
  return result.front();
}

bool CandidateProcess::prepare_timing(std::span<const Configuration> configurations) {
  end();
  for (std::size_t at = 0; at < configurations.size(); at += Exchange::batch) {
    const auto batch = configurations.subspan(
        at, std::min<std::size_t>(Exchange::batch, configurations.size() - at));
    for (std::uint32_t i = 0; i < batch.size(); ++i) put(i, batch[i]);
    if (obey(Command::keep, 0, static_cast<std::uint32_t>(batch.size()))) return false;
  }
  return !configurations.empty() && !obey(Command::warm_up, 0, 0);
}

std::optional<QueryCost> CandidateProcess::cost_per_query() {
  if (session_ < 0 || obey(Command::time, 0, 0)) return std::nullopt;
  const Exchange& exchange = *plugin_.state_->exchange;
  if (!std::isfinite(exchange.nanoseconds)) return std::nullopt;
  QueryCost cost{exchange.nanoseconds, std::nullopt};
  if (std::isfinite(exchange.instructions)) cost.instructions = exchange.instructions;
  return cost;
}

std::vector<CandidateProcess> start(const std::vector<const Candidate*>& candidates,
                                    double threshold, const Limits& limits) {
  std::vector<CandidateProcess> processes;
  for (const Candidate* c : candidates) processes.emplace_back(*c, threshold, limits);
  return processes;
}

std::vector<CandidateProcess*> pointers(std::vector<CandidateProcess>& processes) {
  std::vector<CandidateProcess*> result;
  for (CandidateProcess& p : processes) result.push_back(&p);
  return result;
}

}  // namespace touchstone
