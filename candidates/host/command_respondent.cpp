#include "candidates/host/command_respondent.hpp"

#include <algorithm>

namespace touchstone {
namespace {

using messages::Operation;
using Clock = std::chrono::steady_clock;

/// Questions in one request: no more than take this share of the limit of time.
constexpr double batch_share = 0.1;
/// How long a request may wait for something, as a multiple of the processor time it may use.
constexpr double wait_factor = 10;
/// Seconds for the first request after a start, when a just-in-time compiler has yet to begin.
constexpr double first_request = 10;
/// Failures in a row after which the rest of the questions is not asked.
constexpr int max_failures = 5;

messages::Poses poses_of(const Question& q, std::uint32_t handle) {
  const double* const hint = q.previous_normal;
  return {handle, q.pose_a, q.pose_b, q.has_previous_normal, {hint[0], hint[1], hint[2]}};
}

}  // namespace

CommandRespondent::CommandRespondent(const Candidate& candidate, const Limits& limits)
    : candidate_(candidate),
      limits_(limits),
      request_seconds_(limits.seconds),
      process_(candidate.command()->line, candidate.command()->folder) {}

template <class Entry, class Request, class Read>
auto CommandRespondent::send(Operation operation, const std::vector<Entry>& entries, double seconds,
                             const Request& request, const Read& read) {
  const std::uint64_t ticket = ++ticket_;
  const auto count = static_cast<std::uint32_t>(entries.size());
  const bool in_frames = format_ == messages::Format::frames;
  const std::string text = process_.ask(
      request(format_, ticket, entries), in_frames ? messages::frame_size(operation, count) : 0,
      {seconds, std::max(seconds, wait_factor * limits_.seconds), limits_.mebibytes});
  try {
    return read(format_, ticket, count, text);
  } catch (const messages::Garbage& garbage) {
    process_.refuse(garbage.what());
  }
}

void CommandRespondent::start() {
  if (process_.runs()) return;
  const auto begin = [&] {
    ready_.clear();
    const messages::Hello hello = process_.start();
    format_ = hello.format;
    if (hello.candidate.family != candidate_.family) {
      process_.refuse("its name is " + in_quotes(hello.candidate.family) + " instead of " +
                      in_quotes(candidate_.family));
    }
  };
  begin();
  bool is_warm = true;
  request_seconds_ = std::max(limits_.seconds, first_request);
  try {
    warm_up();
  } catch (const NoAnswer&) {
    is_warm = false;
  }
  request_seconds_ = limits_.seconds;
  if (!is_warm) begin();  // what it did not survive is asked of no one again
}

void CommandRespondent::warm_up() {
  for (const ts_shape_kind kind : {TS_SPHERE, TS_BOX, TS_CYLINDER, TS_CAPSULE, TS_PLANE}) {
    if (!candidate_.supports[kind]) continue;
    Question question{};
    question.a = {TS_CYLINDER, {0.5, 0.5}};
    question.b = {kind, {0.5, 0.5, 0.5}};
    if (kind == TS_PLANE) question.b = {kind, {0, 0, 1, 0}};
    question.pose_a = {{0, 0.1, 0.4}, {0.8, 0.6, 0, 0}};
    question.pose_b = {{0, 0, 0}, {1, 0, 0, 0}};
    std::optional<Answer> answer;
    query({&question, 1}, {&answer, 1});
    return release_all_but(0);
  }
}

std::vector<std::optional<messages::Poses>> CommandRespondent::prepare(
    std::span<const Question> questions) {
  std::vector<messages::PairOfShapes> pairs;  // that are not ready yet
  const auto handle_of = [&](const Question& q) {
    const auto is = [&](const auto& known) {
      return same(known.a, q.a) && same(known.b, q.b) && known.threshold == q.threshold;
    };
    const auto found = std::find_if(ready_.begin(), ready_.end(), is);
    if (found != ready_.end()) {
      std::rotate(found, found + 1, ready_.end());
      return ready_.back().handle;
    }
    const auto wanted = std::find_if(pairs.begin(), pairs.end(), is);
    if (wanted != pairs.end()) return wanted->handle;
    pairs.push_back({next_handle_++, q.threshold, candidate_.value, q.a, q.b});
    return pairs.back().handle;
  };
  std::vector<messages::Poses> all;
  for (const Question& q : questions) all.push_back(poses_of(q, handle_of(q)));
  if (!pairs.empty()) {
    const std::vector<bool> supported = send(Operation::prepare, pairs, request_seconds_,
                                             messages::prepare_request, messages::read_prepared);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const auto& [handle, threshold, parameter, a, b] = pairs[i];
      ready_.push_back({a, b, threshold, handle, supported[i]});
    }
  }
  std::vector<std::optional<messages::Poses>> result;
  for (const messages::Poses& poses : all) {
    const auto is = [&](const Prepared& p) { return p.handle == poses.handle; };
    const bool is_supported = std::find_if(ready_.begin(), ready_.end(), is)->is_supported;
    result.push_back(is_supported ? std::optional(poses) : std::nullopt);
  }
  return result;
}

void CommandRespondent::release_all_but(std::size_t count) {
  if (ready_.size() <= count) return;
  const auto end = ready_.end() - static_cast<std::ptrdiff_t>(count);
  std::vector<std::uint32_t> handles;
  std::for_each(ready_.begin(), end, [&](const Prepared& p) { handles.push_back(p.handle); });
  ready_.erase(ready_.begin(), end);
  send(Operation::release, handles, request_seconds_, messages::release_request,
       messages::read_released);
}

void CommandRespondent::end_session() {
  try {
    if (process_.runs()) release_all_but(0);
  } catch (const NoAnswer&) {  // the next question is asked of a new process
  }
}

void CommandRespondent::query(std::span<const Question> questions,
                              std::span<std::optional<Answer>> answers) {
  std::vector<messages::Poses> poses;
  std::vector<std::size_t> place;  // of what is asked
  const auto prepared = prepare(questions);
  for (std::size_t i = 0; i < prepared.size(); ++i) {
    if (!prepared[i]) continue;
    poses.push_back(*prepared[i]);
    place.push_back(i);
  }
  std::vector<Answer> given;
  if (!poses.empty()) {
    const auto start = Clock::now();
    given = send(Operation::query, poses, request_seconds_, messages::query_request,
                 messages::read_answers);
    const std::chrono::duration<double> taken = Clock::now() - start;
    seconds_per_query_ = taken.count() / static_cast<double>(poses.size());
  }
  for (std::optional<Answer>& answer : answers) answer.emplace().status = TS_UNSUPPORTED;
  for (std::size_t k = 0; k < given.size(); ++k) answers[place[k]] = std::move(given[k]);
}

std::vector<Question> CommandRespondent::questions_of(std::span<const Asked> asked) {
  std::vector<Question> questions;
  for (const Asked& a : asked) questions.push_back(question_of(a));
  return questions;
}

std::size_t CommandRespondent::batch() const {
  if (seconds_per_query_ <= 0) return 1;
  const double fits = batch_share * limits_.seconds / seconds_per_query_;
  return static_cast<std::size_t>(std::clamp(fits, 1.0, static_cast<double>(batch_size)));
}

std::optional<NoAnswer> CommandRespondent::ask(std::span<const Asked> asked, bool release,
                                               std::span<std::optional<Answer>> answers) {
  if (failures_ >= max_failures) {
    return NoAnswer{TS_CRASHED, "was not asked after failures in a row; the last: " + last_failure_,
                    true, true};
  }
  const bool is_fresh = !process_.runs();
  try {
    start();
    query(questions_of(asked), answers);
    release_all_but(release ? 0 : max_ready);
    failures_ = 0;
    return std::nullopt;
  } catch (NoAnswer& failure) {
    std::ranges::fill(answers, std::nullopt);
    // Otherwise it may come from earlier questions.
    failure.is_certain = is_fresh;
    return failure;
  }
}

void CommandRespondent::judge(const NoAnswer& failure) {
  if (++failures_ <= max_failures) last_failure_ = failure.reason;
}

double CommandRespondent::time(const std::vector<messages::Poses>& poses, std::uint32_t passes) {
  // Every query may take what the limit says; a round has at least one pass.
  const double seconds = limits_.seconds * static_cast<double>(poses.size()) + 10 * min_round;
  const auto request = [&](messages::Format format, std::uint64_t ticket, const auto& entries) {
    return messages::time_request(format, ticket, passes, entries);
  };
  return send(Operation::time, poses, seconds, request, messages::read_time);
}

}  // namespace touchstone
