#include "candidates/host/watch.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <unistd.h>
#include <vector>

namespace touchstone {

namespace {

double processor_seconds(const std::vector<pid_t>& processes) {
  double sum = 0;
  for (const pid_t process : processes) {
    clockid_t clock;
    timespec time{};
    if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &time) != 0) continue;
    sum += static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }
  return sum;
}

std::string folder_of(pid_t process) { return "/proc/" + std::to_string(process); }

/// Calls take(folder) with the folder of each thread.
template <class Take>
void for_each_thread(pid_t process, const Take& take) {
  std::error_code error;
  for (auto task = std::filesystem::directory_iterator(folder_of(process) + "/task", error);
       !error && task != std::filesystem::directory_iterator(); task.increment(error)) {
    take(task->path());
  }
}

std::vector<pid_t> all_of(pid_t process, Watched watched) {
  std::vector<pid_t> result = {process};
  // The list grows as it is gone through.
  for (std::size_t i = 0; watched == Watched::descendants_too && i < result.size(); ++i) {
    for_each_thread(pid_t(result[i]), [&](const std::filesystem::path& thread) {
      std::ifstream children(thread / "children");
      for (pid_t child; children >> child;) result.push_back(child);
    });
  }
  return result;
}

struct Threads {
  bool one_can_run = false;
  /// Total seconds for which the threads were ready to run and had no processor: the second number
  /// in schedstat (Linux, Documentation/scheduler/sched-stats.rst), which is updated only when such
  /// a wait is over.
  std::optional<double> starved;
};

Threads threads(const std::vector<pid_t>& processes) {
  Threads result;
  const auto add = [&](const std::filesystem::path& thread) {
    std::string stat;
    std::getline(std::ifstream(thread / "stat"), stat);
    const auto name_end = stat.rfind(") ");  // the state follows
    result.one_can_run |= name_end != std::string::npos && stat[name_end + 2] == 'R';
    std::ifstream schedstat(thread / "schedstat");
    std::uint64_t ran = 0, waited = 0;
    if (schedstat >> ran >> waited) {
      result.starved = result.starved.value_or(0) + 1e-9 * static_cast<double>(waited);
    }
  };
  for (const pid_t process : processes) for_each_thread(process, add);
  return result;
}

}  // namespace

double processor_seconds(pid_t process, Watched watched) {
  return processor_seconds(all_of(process, watched));
}

// The order of the readings makes waiting an underestimate: the clock is read last here …
Watch::Watch(pid_t process, Watched watched)
    : process_(process),
      watched_(watched),
      computed_(processor_seconds(process, watched)),
      starved_(threads(all_of(process, watched)).starved),
      start_(std::chrono::steady_clock::now()) {}

// … and first here.
Watch::TimeUse Watch::spent() const {
  const double clock =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const std::vector<pid_t> processes = all_of(process_, watched_);
  const Threads now = threads(processes);
  const double computing = std::max(0.0, processor_seconds(processes) - computed_);
  if (!starved_) return {computing, std::nullopt, clock};
  if (now.one_can_run) return {computing, 0, clock};
  const double starved = std::max(0.0, now.starved.value_or(0) - *starved_);
  return {computing, std::max(0.0, clock - computing - starved), clock};
}

double Watch::resident_mebibytes() const {
  double pages = 0;
  for (const pid_t process : all_of(process_, watched_)) {
    double size = 0, resident = 0;
    if (std::ifstream(folder_of(process) + "/statm") >> size >> resident) pages += resident;
  }
  return pages * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

std::string seconds_text(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g s", seconds);
  return text;
}

}  // namespace touchstone
