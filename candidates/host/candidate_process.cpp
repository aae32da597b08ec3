#include "candidates/host/candidate_process.hpp"

#include "candidates/host/command_respondent.hpp"
#include "candidates/host/plugin_sessions.hpp"

namespace touchstone {

CandidateProcess::CandidateProcess(const Candidate& candidate, double threshold,
                                   const Limits& limits)
    : candidate_(candidate) {
  if (candidate.respondent) {
    respondent_ = candidate.respondent(threshold, limits);
  } else if (candidate.command.empty()) {
    respondent_ = std::make_unique<PluginSessions>(candidate, threshold, limits);
  } else {
    respondent_ = std::make_unique<CommandRespondent>(candidate, threshold, limits);
  }
}

CandidateProcess::~CandidateProcess() = default;
CandidateProcess::CandidateProcess(CandidateProcess&&) noexcept = default;
CandidateProcess& CandidateProcess::operator=(CandidateProcess&&) noexcept = default;

void CandidateProcess::ask_within(double threshold) { respondent_->ask_within(threshold); }

std::vector<Answer> CandidateProcess::answers(std::span<const Configuration> configurations) {
  return respondent_->answers(configurations);
}

std::vector<Answer> CandidateProcess::answers_until_timeout(
    std::span<const Configuration> configurations, bool in_new_session) {
  return respondent_->answers_until_timeout(configurations, in_new_session);
}

Answer CandidateProcess::answer(const Configuration& configuration, const Vec3* previous_normal) {
  return respondent_->answer({&configuration, 1}, {&previous_normal, 1}, {}).front();
}

std::vector<Answer> CandidateProcess::answer(std::span<const Configuration> configurations,
                                             std::span<const Vec3* const> previous_normals,
                                             std::span<const double> thresholds) {
  return respondent_->answer(configurations, previous_normals, thresholds);
}

void CandidateProcess::restart() { respondent_->restart(); }

void CandidateProcess::release_shapes() { respondent_->release_shapes(); }

bool CandidateProcess::prepare_timing(std::span<const Configuration> configurations) {
  return respondent_->prepare_timing(configurations);
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
