#include "candidates/host/command_respondent.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace touchstone {
namespace {

using messages::Operation;
using Clock = std::chrono::steady_clock;

/// Questions in one request: no more than this, and no more than take this share of the limit of
/// time.
constexpr std::size_t max_batch = 64;
constexpr double batch_share = 0.1;
/// How long a request may wait for something, as a multiple of the processor time it may use.
constexpr double wait_factor = 10;
/// Seconds for the first request after a start, when a just-in-time compiler has yet to begin.
constexpr double first_request = 10;
/// Failures in a row after which the rest of the questions is not asked.
constexpr int max_failures = 5;

// Timing
constexpr double min_round = 2e-3;          ///< seconds
constexpr double max_timed_seconds = 5e-4;  ///< of one pass, beyond the first min_timed questions
constexpr std::size_t min_timed = 10;
constexpr std::uint32_t max_passes = 1u << 20;
constexpr int max_warm_rounds = 30;
constexpr int clock_rounds = 3;
constexpr double max_ratio = 1e6;  ///< of clocks
constexpr double steady = 0.05;    ///< relative difference of three rounds of a warm child

/// An upper bound of a shape's extent from its centre; that of a plane's displacement.
double extent(const ts_shape& shape) {
  double sum = 0;
  for (const double size : shape.size) sum += std::abs(size);
  return sum;
}

/// The poses with body A so far from B that every broad phase tells them apart: along +x, or along
/// a plane's normal.
messages::Poses moved_apart(messages::Poses poses, const ts_shape& a, const ts_shape& b) {
  const double distance = 1e3 * (extent(a) + extent(b));
  Vec3 direction(1, 0, 0);
  if (b.kind == TS_PLANE) {
    const double* const q = poses.b.orientation;
    direction = Eigen::Quaterniond(q[0], q[1], q[2], q[3]) * Vec3(b.size[0], b.size[1], b.size[2]);
  }
  for (int i = 0; i < 3; ++i) {
    poses.a.position[i] += distance * direction[i] + (poses.b.position[i] - poses.a.position[i]);
  }
  return poses;
}

}  // namespace

CommandRespondent::CommandRespondent(const Candidate& candidate, double threshold,
                                     const Limits& limits)
    : candidate_(candidate),
      threshold_(threshold),
      limits_(limits),
      request_seconds_(limits.seconds),
      process_(candidate.command, candidate.folder) {}

void CommandRespondent::ask_within(double threshold) {
  restart();
  threshold_ = threshold;
}

void CommandRespondent::restart() {
  if (process_.runs()) release_all_but(0);
  failures_ = 0;
}

template <class Read>
auto CommandRespondent::send(Operation operation, const std::string& request, std::size_t count,
                             double seconds, const Read& read)
    -> Result<decltype(read(std::string()))> {
  const std::size_t size = format_ == messages::Format::frames
                               ? messages::frame_size(operation, static_cast<std::uint32_t>(count))
                               : 0;
  const auto text =
      process_.ask(request, size,
                   {seconds, std::max(seconds, wait_factor * limits_.seconds), limits_.mebibytes});
  if (const auto* const failure = std::get_if<Failure>(&text)) {
    ready_.clear();
    return *failure;
  }
  try {
    return read(std::get<std::string>(text));
  } catch (const messages::Garbage& garbage) {
    ready_.clear();
    return process_.refuse(garbage.what());
  }
}

std::optional<CommandRespondent::Failure> CommandRespondent::start() {
  if (process_.runs()) return std::nullopt;
  ready_.clear();
  const auto hello = process_.start();
  if (const auto* const failure = std::get_if<Failure>(&hello)) return *failure;
  const auto& [told, format] = std::get<messages::Hello>(hello);
  format_ = format;
  if (told.family != candidate_.family) {
    return process_.refuse("its name is \"" + told.family + "\" instead of \"" + candidate_.family +
                           '"');
  }
  warm_up();
  if (!process_.runs()) {  // not by its first question; that is asked of no one again
    const auto again = process_.start();
    if (const auto* const failure = std::get_if<Failure>(&again)) return *failure;
  }
  return std::nullopt;
}

void CommandRespondent::warm_up() {
  for (const ts_shape_kind kind : {TS_SPHERE, TS_BOX, TS_CYLINDER, TS_CAPSULE, TS_PLANE}) {
    if (!candidate_.supports[kind]) continue;
    ts_shape b{kind, {0.5, 0.5, 0.5}};
    if (kind == TS_PLANE) b = {kind, {0, 0, 1, 0}};
    Question question{{TS_CYLINDER, {0.5, 0.5}}, b, threshold_, {}};
    question.poses.a = {{0, 0.1, 0.4}, {0.8, 0.6, 0, 0}};
    question.poses.b = {{0, 0, 0}, {1, 0, 0, 0}};
    request_seconds_ = std::max(limits_.seconds, first_request);
    ask({&question, 1}, true);
    request_seconds_ = limits_.seconds;
    return;
  }
}

std::optional<CommandRespondent::Failure> CommandRespondent::prepare(
    std::span<Question> questions) {
  std::vector<messages::PairOfShapes> pairs;
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
  for (Question& q : questions) q.poses.handle = handle_of(q);
  if (pairs.empty()) return std::nullopt;

  const std::uint64_t ticket = ++ticket_;
  const auto count = static_cast<std::uint32_t>(pairs.size());
  const auto supported = send(Operation::prepare, messages::prepare_request(format_, ticket, pairs),
                              count, request_seconds_, [&](const std::string& text) {
                                return messages::read_prepared(format_, ticket, count, text);
                              });
  if (const auto* const failure = std::get_if<Failure>(&supported)) return *failure;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    ready_.push_back({pairs[i].a, pairs[i].b, pairs[i].threshold, pairs[i].handle,
                      std::get<std::vector<bool>>(supported)[i]});
  }
  return std::nullopt;
}

std::optional<CommandRespondent::Failure> CommandRespondent::release_all_but(std::size_t count) {
  if (ready_.size() <= count) return std::nullopt;
  const auto end = ready_.end() - static_cast<std::ptrdiff_t>(count);
  std::vector<std::uint32_t> handles;
  std::for_each(ready_.begin(), end, [&](const Prepared& p) { handles.push_back(p.handle); });
  ready_.erase(ready_.begin(), end);
  const std::uint64_t ticket = ++ticket_;
  const auto released = static_cast<std::uint32_t>(handles.size());
  const auto done = send(Operation::release, messages::release_request(format_, ticket, handles),
                         released, request_seconds_, [&](const std::string& text) {
                           messages::read_released(format_, ticket, released, text);
                           return true;
                         });
  if (const auto* const failure = std::get_if<Failure>(&done)) return *failure;
  return std::nullopt;
}

CommandRespondent::Result<std::vector<Answer>> CommandRespondent::ask(std::span<Question> questions,
                                                                      bool release) {
  if (auto failure = start()) return *failure;
  if (auto failure = prepare(questions)) return *failure;
  std::vector<messages::Poses> poses;
  std::vector<std::size_t> of_question;
  std::vector<Answer> answers(questions.size());
  for (std::size_t i = 0; i < questions.size(); ++i) {
    const auto is = [&](const Prepared& p) { return p.handle == questions[i].poses.handle; };
    answers[i].status = TS_UNSUPPORTED;
    if (!std::find_if(ready_.begin(), ready_.end(), is)->is_supported) continue;
    poses.push_back(questions[i].poses);
    of_question.push_back(i);
  }
  if (!poses.empty()) {
    const std::uint64_t ticket = ++ticket_;
    const auto count = static_cast<std::uint32_t>(poses.size());
    const std::string request = messages::query_request(format_, ticket, poses);
    const auto start = Clock::now();
    auto given =
        send(Operation::query, request, count, request_seconds_, [&](const std::string& text) {
          return messages::read_answers(format_, ticket, count, text);
        });
    if (const auto* const failure = std::get_if<Failure>(&given)) return *failure;
    const std::chrono::duration<double> taken = Clock::now() - start;
    seconds_per_query_ = taken.count() / count;
    for (std::size_t k = 0; k < of_question.size(); ++k) {
      answers[of_question[k]] = std::move(std::get<std::vector<Answer>>(given)[k]);
    }
  }
  if (auto failure = release_all_but(release ? 0 : max_ready)) return *failure;
  return answers;
}

std::size_t CommandRespondent::batch() const {
  if (seconds_per_query_ <= 0) return 1;
  const double fits = batch_share * limits_.seconds / seconds_per_query_;
  return static_cast<std::size_t>(std::clamp(fits, 1.0, static_cast<double>(max_batch)));
}

void CommandRespondent::answer_all(std::span<Question> questions, bool release,
                                   std::vector<Answer>& answers) {
  const auto add_failed = [&](ts_status status, const std::string& reason) {
    Answer& answer = answers.emplace_back();
    static_cast<ts_answer&>(answer) = {};
    answer.status = status;
    answer.reason = reason;
  };
  if (failures_ >= max_failures) {
    for (std::size_t i = 0; i < questions.size(); ++i) {
      add_failed(TS_CRASHED, "was not asked after failures in a row; the last: " + last_failure_);
    }
    return;
  }
  const bool was_fresh = !process_.runs();
  auto given = ask(questions, release);
  // A failure may come from earlier questions, or from outside: once more, alone and anew.
  if (std::holds_alternative<Failure>(given) && questions.size() == 1 && !was_fresh) {
    given = ask(questions, release);
  }
  if (auto* const all = std::get_if<std::vector<Answer>>(&given)) {
    std::move(all->begin(), all->end(), std::back_inserter(answers));
    failures_ = 0;
  } else if (questions.size() == 1) {
    const auto& [status, reason] = std::get<Failure>(given);
    add_failed(status, reason);
    last_failure_ = reason;
    ++failures_;
  } else {
    const std::size_t half = questions.size() / 2;
    answer_all(questions.first(half), release, answers);
    answer_all(questions.subspan(half), release, answers);
  }
}

CommandRespondent::Question CommandRespondent::question_of(const Configuration& c, double threshold,
                                                           const Vec3* previous_normal) const {
  Question question{to_ts_shape(c.a), to_ts_shape(c.b), threshold, {}};
  question.poses.a = to_ts_pose(c.pose_a);
  question.poses.b = to_ts_pose(c.pose_b);
  question.poses.has_previous_normal = previous_normal != nullptr;
  for (int i = 0; i < 3; ++i) {
    question.poses.previous_normal[i] = previous_normal ? (*previous_normal)[i] : 0;
  }
  return question;
}

std::vector<Answer> CommandRespondent::answers(std::span<const Configuration> configurations) {
  restart();
  std::vector<Question> questions;
  for (const Configuration& c : configurations)
    questions.push_back(question_of(c, threshold_, nullptr));
  return answer(std::move(questions), true, false);
}

std::vector<Answer> CommandRespondent::answers_until_timeout(
    std::span<const Configuration> configurations, bool in_new_session) {
  if (in_new_session) restart();
  std::vector<Question> questions;
  for (const Configuration& c : configurations)
    questions.push_back(question_of(c, threshold_, nullptr));
  return answer(std::move(questions), true, true);
}

std::vector<Answer> CommandRespondent::answer(std::span<const Configuration> configurations,
                                              std::span<const Vec3* const> previous_normals,
                                              std::span<const double> thresholds) {
  std::vector<Question> questions;
  for (std::size_t i = 0; i < configurations.size(); ++i) {
    questions.push_back(question_of(configurations[i],
                                    thresholds.empty() ? threshold_ : thresholds[i],
                                    previous_normals.empty() ? nullptr : previous_normals[i]));
  }
  return answer(std::move(questions), false, false);
}

std::vector<Answer> CommandRespondent::answer(std::vector<Question> questions, bool release,
                                              bool until_timeout) {
  std::vector<Answer> result;
  for (std::span<Question> left = questions; !left.empty();) {
    if (!candidate_.supports[left.front().b.kind]) {
      result.emplace_back().status = TS_UNSUPPORTED;
      left = left.subspan(1);
      continue;
    }
    std::size_t size = 1;
    const std::size_t max_size = std::min(batch(), left.size());
    while (size < max_size && candidate_.supports[left[size].b.kind]) ++size;
    answer_all(left.first(size), release, result);
    if (until_timeout && end_after_timeout(result)) break;
    left = left.subspan(size);
  }
  return result;
}

CommandRespondent::Result<double> CommandRespondent::time(std::span<const messages::Poses> poses,
                                                          std::uint32_t passes) {
  const std::uint64_t ticket = ++ticket_;
  const auto count = static_cast<std::uint32_t>(poses.size());
  // Every query may take what the limit says; a round has at least one pass.
  const double seconds = limits_.seconds * count + 10 * min_round;
  return send(
      Operation::time, messages::time_request(format_, ticket, passes, poses), count, seconds,
      [&](const std::string& text) { return messages::read_time(format_, ticket, count, text); });
}

std::optional<double> CommandRespondent::warm_cost(std::span<const messages::Poses> poses) {
  const auto round = [&]() -> std::optional<double> {
    const auto total = time(poses, passes_);
    if (!std::holds_alternative<double>(total)) return std::nullopt;
    return std::get<double>(total) / (passes_ * static_cast<double>(poses.size()));
  };
  std::array<double, 3> last{};
  for (int i = 0; i < max_warm_rounds; ++i) {
    const auto cost = round();
    if (!cost) return std::nullopt;
    std::rotate(last.begin(), last.begin() + 1, last.end());
    last.back() = *cost;
    const auto [min, max] = std::minmax_element(last.begin(), last.end());
    if (i >= 2 && *max <= (1 + steady) * *min) break;
  }
  std::sort(last.begin(), last.end());
  return last[1];
}

bool CommandRespondent::prepare_timing(std::span<const Configuration> configurations) {
  restart();
  timed_.clear();
  measured_.reset();
  std::vector<Question> questions;
  for (const Configuration& c : configurations) {
    if (candidate_.supports[to_ts_shape(c.b).kind])
      questions.push_back(question_of(c, threshold_, nullptr));
  }
  if (questions.empty() || start()) return false;
  // Handles stay prepared until the next call, however many.
  std::vector<messages::Poses> all, apart;
  for (std::span<Question> left = questions; !left.empty();) {
    const auto part = left.first(std::min(max_batch, left.size()));
    if (prepare(part)) return false;
    left = left.subspan(part.size());
  }
  for (const Question& q : questions) {
    const auto is = [&](const Prepared& p) { return p.handle == q.poses.handle; };
    if (!std::find_if(ready_.begin(), ready_.end(), is)->is_supported) continue;
    all.push_back(q.poses);
    apart.push_back(moved_apart(q.poses, q.a, q.b));
  }
  if (all.empty()) return false;

  // As many as take half a millisecond, by the time of the first ones.
  const std::span<const messages::Poses> first(all.data(), std::min(min_timed, all.size()));
  const auto total = time(first, 1);
  if (!std::holds_alternative<double>(total)) return false;
  const double each =
      std::max(1e-9 * std::get<double>(total), 1e-9) / static_cast<double>(first.size());
  const auto count =
      std::clamp(static_cast<std::size_t>(max_timed_seconds / each), first.size(), all.size());
  timed_.assign(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count));
  apart.resize(count);

  for (passes_ = 1; passes_ < max_passes; passes_ *= 2) {
    const auto round = time(timed_, passes_);
    if (!std::holds_alternative<double>(round)) return false;
    if (1e-9 * std::get<double>(round) >= min_round) break;
  }
  const std::optional<double> floor = warm_cost(apart);
  if (!floor || !warm_cost(timed_)) return false;
  measured_ = compare_clocks();
  if (measured_) measured_->floor = *floor;
  return measured_.has_value();
}

std::optional<QueryCost::Measured> CommandRespondent::compare_clocks() {
  // What a request costs besides its queries is in both of two rounds of different length.
  double told = 0, ours = 0, computing = 0;
  for (int i = 0; i < clock_rounds; ++i) {
    for (const int sign : {-1, 1}) {
      const Watch watch = process_.watch();
      const auto total = time(timed_, sign > 0 ? 2 * passes_ : passes_);
      if (!std::holds_alternative<double>(total)) return std::nullopt;
      const Watch::TimeUse spent = watch.spent();
      told += sign * 1e-9 * std::get<double>(total);
      ours += sign * spent.by_the_clock;
      computing += sign * spent.computing;
    }
  }
  ours = std::max(ours, 0.0);  // a busy machine may make the longer round the faster one
  computing = std::max(computing, 0.0);
  told = std::max({told, ours / max_ratio, 1e-12});  // of a child that tells nothing
  return QueryCost::Measured{0, ours / told, computing / told};
}

std::optional<QueryCost> CommandRespondent::cost_per_query() {
  if (!measured_ || !process_.runs()) return std::nullopt;
  const auto total = time(timed_, passes_);
  if (!std::holds_alternative<double>(total)) return std::nullopt;
  const double queries = passes_ * static_cast<double>(timed_.size());
  QueryCost cost{std::max(std::get<double>(total), 1.0) / queries, std::nullopt};
  cost.measured = measured_;
  return cost;
}

}  // namespace touchstone
