#pragma once

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "candidates/host/candidate_process.hpp"

namespace touchstone {

/// Runs task(0) … task(count − 1) in `workers` child processes, each of which takes the next free
/// task, and returns the results in the order of the tasks. An exception in a task, or the death of
/// a worker, ends the run with std::runtime_error that begins with name(index). `done` is called in
/// the parent after each task with the number finished. On an interruption (interruption.hpp) the
/// workers are ended at once, and unfinished tasks have an empty string as result.
std::vector<std::string> run_in_processes(std::size_t count, unsigned workers,
                                          const std::function<std::string(std::size_t)>& task,
                                          const std::function<std::string(std::size_t)>& name,
                                          const std::function<void(std::size_t)>& done);

/// A task threw, or the worker that had it died.
struct TaskFailure : std::runtime_error {
  explicit TaskFailure(const std::string& text, int worker_status = 0)
      : std::runtime_error(text), wait_status(worker_status) {}
  int wait_status;  ///< of the worker that died; zero: it did not
};

/// Like run_in_processes, for runs whose results do not fit into memory: passes each result to
/// `take` as it arrives, in any order, and keeps none. Ends early, dropping unfinished tasks, when
/// `go_on` (called at least every 100 ms) returns false. Returns whether all tasks were done. Where
/// it ends early or a task fails, what workers have finished is passed first. `forget` is called
/// first in each worker: it frees memory that tasks do not need, so that the forks of workers copy
/// fewer page tables.
bool stream_from_processes(
    std::uint64_t count, unsigned workers, const std::function<std::string(std::uint64_t)>& task,
    const std::function<std::string(std::uint64_t)>& name,
    const std::function<void(std::uint64_t, std::string)>& take, const std::function<bool()>& go_on,
    const std::function<void()>& forget = [] {});

/// Likewise, but passes the results in the order of the tasks. Those that come before their turn
/// wait, and are dropped where it does not come.
bool stream_in_order(std::uint64_t count, unsigned workers,
                     const std::function<std::string(std::uint64_t)>& task,
                     const std::function<std::string(std::uint64_t)>& name,
                     const std::function<void(std::string)>& take,
                     const std::function<bool()>& go_on);

/// Candidates of a worker: started at the first use, which is after the fork, so that each worker
/// has its own.
class WorkerCandidates {
 public:
  WorkerCandidates(std::vector<const Candidate*> candidates, double threshold, Limits limits)
      : candidates_(std::move(candidates)), threshold_(threshold), limits_(limits) {}

  std::vector<CandidateProcess>& get() {
    if (processes_.empty()) processes_ = start(candidates_, threshold_, limits_);
    return processes_;
  }

 private:
  std::vector<const Candidate*> candidates_;
  double threshold_;
  Limits limits_;
  std::vector<CandidateProcess> processes_;
};

}  // namespace touchstone
