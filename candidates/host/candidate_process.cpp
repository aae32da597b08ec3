// The one rule by which candidates are asked, whatever carries the questions: in batches, and what
// a failure leaves without an answer is asked again.
#include "candidates/host/candidate_process.hpp"

#include <algorithm>
#include <utility>

#include "candidates/host/plugin_sessions.hpp"
#include "candidates/readable.hpp"

namespace touchstone {

static_assert(Hull::max_vertices == Convex::max_vertices);

Question question_of(const Asked& asked) {
  const Configuration& c = *asked.configuration;
  const Vec3 hint = asked.previous_normal ? *asked.previous_normal : Vec3(Vec3::Zero());
  return {to_ts_shape(c.a),
          to_ts_shape(c.b),
          to_ts_pose(c.pose_a),
          to_ts_pose(c.pose_b),
          asked.threshold,
          asked.previous_normal != nullptr,
          {hint.x(), hint.y(), hint.z()}};
}

CandidateProcess::CandidateProcess(const Candidate& candidate, double threshold,
                                   const Limits& limits)
    : candidate_(candidate), threshold_(threshold) {
  if (const auto* const function = std::get_if<Candidate::Function>(&candidate.origin)) {
    respondent_ = (*function)(limits);
  } else {
    respondent_ = std::make_unique<PluginSessions>(candidate, limits);
  }
}

CandidateProcess::~CandidateProcess() = default;
CandidateProcess::CandidateProcess(CandidateProcess&&) noexcept = default;
CandidateProcess& CandidateProcess::operator=(CandidateProcess&&) noexcept = default;

void CandidateProcess::ask_within(double threshold) {
  restart();
  threshold_ = threshold;
}

void CandidateProcess::restart() {
  respondent_->end_session();
  respondent_->forget();
}

void CandidateProcess::release_shapes() { respondent_->release_shapes(); }

std::vector<Answer> CandidateProcess::answers(std::span<const Configuration> configurations) {
  restart();
  return ask(configurations, {}, {}, {.release = true});
}

std::vector<Answer> CandidateProcess::answers_until_timeout(
    std::span<const Configuration> configurations, bool in_new_session) {
  if (in_new_session) restart();
  return ask(configurations, {}, {}, {.release = true, .until_timeout = true});
}

Answer CandidateProcess::answer(const Configuration& configuration, const Vec3* previous_normal) {
  return answer({&configuration, 1}, {&previous_normal, 1}, {}).front();
}

std::vector<Answer> CandidateProcess::answer(std::span<const Configuration> configurations,
                                             std::span<const Vec3* const> previous_normals,
                                             std::span<const double> thresholds) {
  return ask(configurations, previous_normals, thresholds, {.release = false});
}

std::vector<Answer> CandidateProcess::ask(std::span<const Configuration> configurations,
                                          std::span<const Vec3* const> previous_normals,
                                          std::span<const double> thresholds, Manner manner) {
  std::vector<Answer> result(configurations.size());
  std::vector<Asked> asked;
  std::vector<std::size_t> place;  // of what is asked
  for (std::size_t i = 0; i < configurations.size(); ++i) {
    result[i].status = TS_UNSUPPORTED;
    if (!candidate_.has_routine_for(pair_of(configurations[i]))) continue;
    asked.push_back({&configurations[i], thresholds.empty() ? threshold_ : thresholds[i],
                     previous_normals.empty() ? nullptr : previous_normals[i]});
    place.push_back(i);
  }

  std::size_t suspects = 0;  // of the next questions one ends the process; which is not known
  for (std::size_t at = 0; at < asked.size();) {
    const std::size_t wanted = suspects > 0 ? (suspects + 1) / 2 : batch_size;
    const auto batch = std::span(asked).subspan(at, std::min(wanted, asked.size() - at));
    std::vector<std::optional<Answer>> given(batch.size());
    const auto failure = respondent_->ask(batch, manner.release, given);
    const std::size_t before = at;
    while (at - before < given.size() && given[at - before]) {
      result[place[at]] = std::move(*given[at - before]);
      ++at;
    }
    suspects -= std::min(suspects, at - before);
    if (at - before == given.size()) continue;
    if (given.size() > 1 && !(failure && failure->is_of_first)) {
      respondent_->end_session();
      suspects = given.size() - (at - before);
      continue;
    }
    Answer& answer = result[place[at]];
    answer = failure && failure->is_certain ? answer_of(*failure) : answer_alone(asked[at]);
    if (manner.until_timeout && answer.status == TS_TIMED_OUT) {
      result.resize(place[at] + 1);
      break;
    }
    ++at;
    suspects = 0;
  }
  for (std::size_t i = 0; i < result.size(); ++i) {
    const Configuration& c = configurations[i];
    const bool is_rounded = c.a.rounding() > 0 || rounding_of(c.b) > 0;
    if (result[i].status == TS_UNSUPPORTED && is_rounded && result[i].reason.empty()) {
      result[i].reason = "does not round bodies in this way";
    }
  }
  return result;
}

Answer CandidateProcess::answer_alone(const Asked& asked) {
  respondent_->end_session();
  std::optional<Answer> given;
  const auto failure = respondent_->ask({&asked, 1}, true, {&given, 1});
  if (given) return std::move(*given);
  return answer_of(failure.value_or(NoAnswer{TS_CRASHED, "wrote over its own answer"}));
}

Answer CandidateProcess::answer_of(const NoAnswer& failure) {
  respondent_->judge(failure);
  Answer answer{};
  answer.status = failure.status;
  answer.reason = readable(failure.reason);
  return answer;
}

bool CandidateProcess::prepare_timing(std::span<const Configuration> configurations) {
  std::vector<Asked> asked;
  for (const Configuration& c : configurations) {
    if (candidate_.has_routine_for(pair_of(c))) asked.push_back({&c, threshold_, nullptr});
  }
  return !asked.empty() && respondent_->prepare_timing(asked);
}

std::optional<QueryCost> CandidateProcess::cost_per_query() {
  return respondent_->cost_per_query();
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
