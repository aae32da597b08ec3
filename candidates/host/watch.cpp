#include "candidates/host/watch.hpp"

#include <algorithm>
#include <cstdint>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

namespace touchstone {

double processor_seconds(pid_t process) {
  clockid_t clock;
  timespec time{};
  if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &time) != 0) return 0;
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

namespace {

struct Threads {
  bool one_can_run = false;
  /// Total seconds for which the threads were ready to run and had no processor: the second number
  /// in schedstat (Linux, Documentation/scheduler/sched-stats.rst), which is updated only when such
  /// a wait is over.
  std::optional<double> starved;
};

Threads threads(pid_t process) {
  Threads result;
  std::error_code error;
  const std::string folder = "/proc/" + std::to_string(process) + "/task";
  for (auto task = std::filesystem::directory_iterator(folder, error);
       !error && task != std::filesystem::directory_iterator(); task.increment(error)) {
    std::string stat;
    std::getline(std::ifstream(task->path() / "stat"), stat);
    const auto name_end = stat.rfind(") ");  // the state follows
    result.one_can_run |= name_end != std::string::npos && stat[name_end + 2] == 'R';
    std::ifstream schedstat(task->path() / "schedstat");
    std::uint64_t ran = 0, waited = 0;
    if (schedstat >> ran >> waited) {
      result.starved = result.starved.value_or(0) + 1e-9 * static_cast<double>(waited);
    }
  }
  return result;
}

}  // namespace

// The order of the readings makes waiting an underestimate: the clock is read last here …
Watch::Watch(pid_t process)
    : process_(process),
      computed_(processor_seconds(process)),
      starved_(threads(process).starved),
      start_(std::chrono::steady_clock::now()) {}

// … and first here.
Watch::TimeUse Watch::spent() const {
  const double clock =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const Threads now = threads(process_);
  const double computing = std::max(0.0, processor_seconds(process_) - computed_);
  if (!starved_) return {computing, std::nullopt, clock};
  if (now.one_can_run) return {computing, 0, clock};
  const double starved = std::max(0.0, now.starved.value_or(0) - *starved_);
  return {computing, std::max(0.0, clock - computing - starved), clock};
}

}  // namespace touchstone
