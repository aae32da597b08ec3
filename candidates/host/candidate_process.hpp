#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "candidates/candidate.hpp"
#include "reference/configuration.hpp"

namespace touchstone {

struct Command;
class Watch;

/// What one configuration may cost a candidate before its process is ended.
struct Limits {
  /// Of processor time: three frames of a simulation, thousands of times what a query takes. For
  /// one that waits, ten times as long, less and less for a candidate that does so again, down to
  /// this; the time in which the machine keeps it waiting for a processor does not count.
  double seconds = 0.05;
  double mebibytes = 1024;  ///< that its memory may grow by
};

/// A candidate's answer, or how it came that there is none.
struct Answer : ts_answer {
  std::string reason;  ///< of TS_CRASHED and TS_TIMED_OUT: "Segmentation fault", "threw …"
  std::optional<double> model_distance;  ///< of what a simplified model stands for, metres
};

/// What one query costs.
struct QueryCost {
  double nanoseconds;
  std::optional<double> instructions;  ///< in user space; absent where they cannot be counted
};

/// A plug-in, loaded in a process of its own: symbols, global state and misdeeds of one plug-in
/// cannot reach another, nor this process. Throws InvalidInput (field "--candidate") when it cannot
/// be loaded.
class PluginProcess {
 public:
  /// For loading it, which may read libraries from a cold disk.
  static constexpr std::chrono::milliseconds loading_time = std::chrono::seconds(30);
  explicit PluginProcess(const std::filesystem::path& file,
                         std::chrono::milliseconds loading = loading_time);
  ~PluginProcess();
  PluginProcess(PluginProcess&&) noexcept;
  PluginProcess& operator=(PluginProcess&&) noexcept;

  const std::vector<Candidate>& candidates() const;

 private:
  friend class CandidateProcess;
  struct State;
  std::unique_ptr<State> state_;
};

/// One candidate, answering in sessions: forks of its plug-in's process, which has loaded the
/// plug-in and done nothing else. A configuration that ends its session is answered with TS_CRASHED
/// or TS_TIMED_OUT, and the next one gets a new session. What need not be its own doing (a signal
/// that anyone may have sent, a timeout) counts only when it comes again in a session of its own.
class CandidateProcess {
 public:
  CandidateProcess(const Candidate& candidate, double threshold, const Limits& limits = {});

  const Candidate& candidate() const { return candidate_; }

  /// Ends the session; the next one reports contacts up to `threshold` metres apart.
  void ask_within(double threshold);

  /// In a new session, so that the answers depend on these configurations alone.
  std::vector<Answer> answers(std::span<const Configuration> configurations);
  /// In the session of the last call, if there is one. `previous_normal`, unit, world frame, from B
  /// to A, is the candidate's hint; null: there was no contact before.
  Answer answer(const Configuration& configuration, const Vec3* previous_normal = nullptr);
  /// Likewise, all of them at once; `previous_normals` is empty or has one for each.
  std::vector<Answer> answer(std::span<const Configuration> configurations,
                             std::span<const Vec3* const> previous_normals = {});
  /// Ends the session, so that the next call begins a new one.
  void restart() { end(); }

  /// Prepares shapes for timing in a new session and queries them once, untimed. Of slow candidates
  /// only as many as take about half a millisecond are kept, at least ten. False if it died of it.
  bool prepare_timing(std::span<const Configuration> configurations);
  /// One round over what was prepared: the clock is read by the candidate's process around a loop
  /// of calls and nothing else. Absent if it died.
  std::optional<QueryCost> cost_per_query();

 private:
  /// How a session came to its end without having done what it was told.
  struct Misdeed {
    ts_status status;
    std::string reason;
    bool certain;  ///< it is the doing of the configuration in hand
  };

  /// Absent when there is a session.
  std::optional<Misdeed> begin();
  void end();
  void put(std::uint32_t slot, const Configuration& configuration,
           const Vec3* previous_normal = nullptr);
  std::vector<Answer> answer(std::span<const Configuration> configurations,
                             std::span<const Vec3* const> previous_normals, bool release);
  void answer_batch(std::uint32_t count, bool release, std::vector<Answer>& answers);
  /// What stands in this slot, if it answers the last command.
  std::optional<Answer> answer_in(std::uint32_t slot) const;
  /// To this slot's question, in a session of its own.
  Answer answer_alone(std::uint32_t slot);
  static Answer answer_of(const Misdeed& misdeed);
  /// Sends a command and waits; absent when it is done.
  std::optional<Misdeed> obey(Command command);
  Misdeed end_of_session(int wait_status) const;
  /// Why it has taken too long; empty if it has not.
  std::string judge(const Watch& watch);

  Candidate candidate_;
  double threshold_;
  Limits limits_;
  PluginProcess plugin_;
  int session_ = -1;                  ///< process, or -1
  std::uint64_t ticket_ = 0;          ///< of the last command
  std::uint64_t session_ticket_ = 0;  ///< of the command that began the session
  double patience_;                   ///< seconds that a query may wait
};

/// One process for each.
std::vector<CandidateProcess> start(const std::vector<const Candidate*>& candidates,
                                    double threshold, const Limits& limits = {});
std::vector<CandidateProcess*> pointers(std::vector<CandidateProcess>& processes);

}  // namespace touchstone
