#pragma once

#include <cstdint>

#include "candidates/host/command_process.hpp"
#include "candidates/host/exchange.hpp"
#include "candidates/host/respondent.hpp"

namespace touchstone {

/// A candidate that is a command (docs/process-candidates.md). It keeps running from one call to
/// the next; a session is how long its shapes stay prepared. It is not known how far it is with
/// what it was sent, so that a failure is that of one question only where that was sent alone.
class CommandRespondent : public Respondent {
 public:
  CommandRespondent(const Candidate& candidate, const Limits& limits);

  /// No more than take a small share of the limit of time.
  std::size_t batch() const override;
  std::optional<NoAnswer> ask(std::span<const Asked> asked, bool release,
                              std::span<std::optional<Answer>> answers) override;
  void judge(const NoAnswer& failure) override;
  void forget() override { failures_ = 0; }
  void end_session() override;
  bool prepare_timing(std::span<const Asked> asked) override;
  std::optional<QueryCost> cost_per_query() override;

 private:
  /// Shapes that the child has prepared.
  struct Prepared {
    ts_shape a, b;
    double threshold;
    std::uint32_t handle;
    bool is_supported;
  };

  static constexpr double min_round = 2e-3;  ///< seconds that a round of timing takes at least

  static std::vector<Question> questions_of(std::span<const Asked> asked);

  // All of these throw NoAnswer.

  /// Starts the command unless it runs.
  void start();
  /// Asks an easy question, so that what begins late begins now. Its answer does not count.
  void warm_up();
  /// Prepares the shapes that are not yet. Returns the poses with their handles; absent where the
  /// pair is not supported.
  std::vector<std::optional<messages::Poses>> prepare(std::span<const Question> questions);
  /// Asks them at once.
  void query(std::span<const Question> questions, std::span<std::optional<Answer>> answers);
  void release_all_but(std::size_t count);
  /// One round of timing: nanoseconds in all.
  double time(const std::vector<messages::Poses>& poses, std::uint32_t passes);
  /// Nanoseconds a query once rounds agree.
  double warm_cost(const std::vector<messages::Poses>& poses);
  /// The child's clock beside ours, and this floor.
  QueryCost::Measured compare_clocks(double floor);
  /// Sends a request and reads its answer, by functions of messages.hpp.
  template <class Entry, class Request, class Read>
  auto send(messages::Operation operation, const std::vector<Entry>& entries, double seconds,
            const Request& request, const Read& read);

  Candidate candidate_;
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
