#pragma once

#include "candidates/host/candidate_process.hpp"

namespace touchstone {

/// What answers a candidate's questions. CandidateProcess says what the functions do.
class Respondent {
 public:
  virtual ~Respondent() = default;
  virtual void ask_within(double threshold) = 0;
  virtual void go_on_within(double threshold) = 0;
  virtual std::vector<Answer> answers(std::span<const Configuration> configurations) = 0;
  virtual std::vector<Answer> answer(std::span<const Configuration> configurations,
                                     std::span<const Vec3* const> previous_normals) = 0;
  virtual void restart() = 0;
  virtual bool prepare_timing(std::span<const Configuration> configurations) = 0;
  virtual std::optional<QueryCost> cost_per_query() = 0;
};

}  // namespace touchstone
