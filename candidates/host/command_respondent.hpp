#pragma once

#include <array>
#include <cstdint>

#include "candidates/host/command_process.hpp"
#include "candidates/host/exchange.hpp"
#include "candidates/host/respondent.hpp"

namespace touchstone {

/// A candidate that is a command (docs/process-candidates.md). It keeps running from one call to
/// the next; a session is how long its shapes stay prepared. Questions that it does not survive are
/// found by bisection of the batch.
class CommandRespondent : public Respondent {
 public:
  CommandRespondent(const Candidate& candidate, double threshold, const Limits& limits);

  void ask_within(double threshold) override;
  std::vector<Answer> answers(std::span<const Configuration> configurations) override;
  std::vector<Answer> answers_until_timeout(std::span<const Configuration> configurations,
                                            bool in_new_session) override;
  std::vector<Answer> answer(std::span<const Configuration> configurations,
                             std::span<const Vec3* const> previous_normals,
                             std::span<const double> thresholds) override;
  void restart() override;
  bool prepare_timing(std::span<const Configuration> configurations) override;
  std::optional<QueryCost> cost_per_query() override;

 private:
  using Failure = CommandProcess::Failure;
  template <class T>
  using Result = std::variant<T, Failure>;

  struct Question {
    ts_shape a, b;
    double threshold;
    messages::Poses poses;
  };
  /// Shapes that the child has prepared.
  struct Prepared {
    ts_shape a, b;
    double threshold;
    std::uint32_t handle;
    bool is_supported;
  };

  Question question_of(const Configuration& configuration, double threshold,
                       const Vec3* previous_normal) const;
  std::vector<Answer> answer(std::vector<Question> questions, bool release, bool until_timeout);
  /// Appends the answers to these questions, after bisection where the child does not survive.
  void answer_all(std::span<Question> questions, bool release, std::vector<Answer>& answers);
  /// Asks them at once.
  Result<std::vector<Answer>> ask(std::span<Question> questions, bool release);
  /// Starts the command unless it runs; absent on success.
  std::optional<Failure> start();
  /// Asks an easy question, so that what begins late begins now. Its answer does not count.
  void warm_up();
  /// Prepares the shapes that are not yet, and sets the questions' handles.
  std::optional<Failure> prepare(std::span<Question> questions);
  std::optional<Failure> release_all_but(std::size_t count);
  /// One round of timing: nanoseconds in all.
  Result<double> time(std::span<const messages::Poses> poses, std::uint32_t passes);
  /// Nanoseconds a query once rounds agree.
  std::optional<double> warm_cost(std::span<const messages::Poses> poses);
  /// The child's clock beside ours; absent if it died.
  std::optional<QueryCost::Measured> compare_clocks();
  std::size_t batch() const;
  /// Sends a request; `read` makes the result of the answer's text, and may throw Garbage.
  template <class Read>
  auto send(messages::Operation operation, const std::string& request, std::size_t count,
            double seconds, const Read& read) -> Result<decltype(read(std::string()))>;

  Candidate candidate_;
  double threshold_;
  Limits limits_;
  double request_seconds_;  ///< processor time that a request may use
  CommandProcess process_;
  messages::Format format_ = messages::Format::frames;
  std::uint64_t ticket_ = 0;
  std::uint32_t next_handle_ = 0;
  std::vector<Prepared> ready_;   ///< oldest use first
  double seconds_per_query_ = 0;  ///< by the clock, so far; 0: not known
  int failures_ = 0;              ///< in a row
  std::string last_failure_;
  std::vector<messages::Poses> timed_;           ///< of prepare_timing
  std::uint32_t passes_ = 1;                     ///< of one timed round
  std::optional<QueryCost::Measured> measured_;  ///< absent: nothing is prepared for timing
};

}  // namespace touchstone
