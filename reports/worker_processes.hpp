#pragma once

#include <functional>
#include <string>
#include <vector>

namespace touchstone {

/// Runs task(0) … task(count − 1) in `workers` child processes, each taking the next one that is
/// free, and returns what they returned in the order of the tasks. An exception in a task, or the
/// death of a worker, ends the run with std::runtime_error that begins with name(index). `done` is
/// called in the parent after each task with the number finished.
std::vector<std::string> run_in_processes(std::size_t count, unsigned workers,
                                          const std::function<std::string(std::size_t)>& task,
                                          const std::function<std::string(std::size_t)>& name,
                                          const std::function<void(std::size_t)>& done);

}  // namespace touchstone
