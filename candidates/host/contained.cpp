#include "candidates/host/contained.hpp"

#include <chrono>
#include <cmath>
#include <exception>
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "candidates/host/guard.hpp"
#include "candidates/host/worker_processes.hpp"

namespace touchstone {
namespace {

constexpr char returned = 'r', threw = 't';  // first byte of what the child writes

void limit_and_silence(double seconds) {
  signal(SIGXCPU, SIG_DFL);
  const int nothing = open("/dev/null", O_RDWR);
  for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nothing, standard);
  const auto limit = static_cast<rlim_t>(std::ceil(seconds));
  const rlimit processor{limit, limit + 1}, no_core{0, 0};
  setrlimit(RLIMIT_CPU, &processor);
  setrlimit(RLIMIT_CORE, &no_core);
}

}  // namespace

Contained run_contained(const std::function<std::string()>& task, double seconds) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(4 * seconds);
  Contained result{Contained::End::timed_out, "took too long"};
  const auto contained = [&](std::uint64_t) {
    limit_and_silence(seconds);
    try {
      return returned + task();
    } catch (const std::exception& e) {
      return threw + std::string(e.what());
    }
  };
  const auto take = [&](std::uint64_t, const std::string& text) {
    using End = Contained::End;
    result = {text[0] == returned ? End::returned : End::crashed, text.substr(1)};
  };
  try {
    stream_from_processes(
        1, 1, contained, [](std::uint64_t) { return std::string(); }, take,
        [&] { return Clock::now() < end; });
  } catch (const TaskFailure& failure) {
    if (WIFSIGNALED(failure.wait_status) && WTERMSIG(failure.wait_status) == SIGXCPU) return result;
    return {Contained::End::crashed, how_it_ended(failure.wait_status)};
  }
  return result;
}

}  // namespace touchstone
