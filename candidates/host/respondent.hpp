#pragma once

#include <algorithm>

#include "candidates/host/candidate_process.hpp"

namespace touchstone {

/// What answers a candidate's questions. CandidateProcess says what the functions do.
class Respondent {
 public:
  virtual ~Respondent() = default;
  virtual void ask_within(double threshold) = 0;
  virtual std::vector<Answer> answers(std::span<const Configuration> configurations) = 0;
  virtual std::vector<Answer> answers_until_timeout(std::span<const Configuration> configurations,
                                                    bool in_new_session) = 0;
  virtual std::vector<Answer> answer(std::span<const Configuration> configurations,
                                     std::span<const Vec3* const> previous_normals,
                                     std::span<const double> thresholds) = 0;
  virtual void restart() = 0;
  virtual void release_shapes() { restart(); }
  virtual bool prepare_timing(std::span<const Configuration> configurations) = 0;
  virtual std::optional<QueryCost> cost_per_query() = 0;
};

/// Drops the answers after the first one that timed out. Returns whether there is such a one.
inline bool end_after_timeout(std::vector<Answer>& answers) {
  const auto timeout = std::find_if(answers.begin(), answers.end(),
                                    [](const Answer& a) { return a.status == TS_TIMED_OUT; });
  if (timeout == answers.end()) return false;
  answers.erase(timeout + 1, answers.end());
  return true;
}

}  // namespace touchstone
