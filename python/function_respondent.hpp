#pragma once

#include <chrono>

#include "candidates/host/respondent.hpp"
#include "python/bindings.hpp"

namespace touchstone::python {

/// A Python function that answers a candidate's questions, function(a, pose_a, b, pose_b,
/// threshold), in the process that it is made in. What it raises fails its question alone. One that
/// takes too long is ended by an exception, which cannot end a call of compiled code; one that
/// crashes ends its process. Python's lock must be held throughout.
class FunctionRespondent : public Respondent {
 public:
  /// `seconds` by the clock are allowed for one question, where this is Python's main thread.
  FunctionRespondent(py::function function, double seconds);
  ~FunctionRespondent() override;
  FunctionRespondent(const FunctionRespondent&) = delete;
  FunctionRespondent& operator=(const FunctionRespondent&) = delete;

  /// A function takes no hints.
  std::optional<NoAnswer> ask(std::span<const Asked> asked, bool release,
                              std::span<std::optional<Answer>> answers) override;
  void end_session() override {}
  bool prepare_timing(std::span<const Asked> asked) override;
  std::optional<QueryCost> cost_per_query() override;

 private:
  py::tuple arguments_of(const Asked& asked) const;
  Answer answer_to(const py::tuple& arguments) const;
  /// Calls action(), which an exception ends after so many seconds.
  template <class Action>
  void call_within(double seconds, const Action& action) const;

  py::function function_;
  double seconds_;
  mutable std::chrono::steady_clock::time_point end_;  ///< of the call under way
  py::object previous_handler_;                        ///< of the alarm; null: there is no limit
  std::vector<py::tuple> timed_;  ///< arguments of the questions that are timed
  std::size_t passes_ = 1;        ///< over them, in a round
};

}  // namespace touchstone::python
