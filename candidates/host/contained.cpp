#include "candidates/host/contained.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <exception>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "candidates/host/guard.hpp"

namespace touchstone {
namespace {

constexpr char returned = 'r', threw = 't';  // first byte of what the child writes

[[noreturn]] void run_child(const std::function<std::string()>& task, int out, double seconds) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  signal(SIGXCPU, SIG_DFL);
  const int nothing = open("/dev/null", O_RDWR);
  for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nothing, standard);
  const auto limit = static_cast<rlim_t>(std::ceil(seconds));
  const rlimit processor{limit, limit + 1}, no_core{0, 0};
  setrlimit(RLIMIT_CPU, &processor);
  setrlimit(RLIMIT_CORE, &no_core);
  std::string text;
  try {
    text = returned + task();
  } catch (const std::exception& e) {
    text = std::string(1, threw) + e.what();
  }
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t size = write(out, text.data() + at, text.size() - at);
    if (size < 0 && errno != EINTR) _exit(1);
    at += static_cast<std::size_t>(std::max<ssize_t>(size, 0));
  }
  _exit(0);
}

/// Everything that is written until the other end closes; false if that takes too long.
bool read_all(int in, std::string& text, std::chrono::duration<double> time) {
  const auto end = std::chrono::steady_clock::now() + time;
  for (;;) {
    const auto left = end - std::chrono::steady_clock::now();
    pollfd polled{in, POLLIN, 0};
    const auto wait = std::chrono::ceil<std::chrono::milliseconds>(left).count();
    const int ready = wait > 0 ? poll(&polled, 1, static_cast<int>(wait)) : 0;
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0) return false;
    char chunk[1 << 16];
    const ssize_t size = read(in, chunk, sizeof chunk);
    if (size == 0) return true;
    if (size > 0) text.append(chunk, static_cast<std::size_t>(size));
  }
}

}  // namespace

Contained run_contained(const std::function<std::string()>& task, double seconds) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) fail("pipe");
  const pid_t child = fork();
  if (child < 0) fail("fork");
  if (child == 0) run_child(task, ends[1], seconds);
  close(ends[1]);
  std::string text;
  const bool ended = read_all(ends[0], text, std::chrono::duration<double>(4 * seconds));
  close(ends[0]);
  if (!ended) kill(child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!ended || (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)) {
    return {Contained::End::timed_out, "took too long"};
  }
  if (status != 0 || text.empty()) return {Contained::End::crashed, how_it_ended(status)};
  return {text[0] == returned ? Contained::End::returned : Contained::End::crashed, text.substr(1)};
}

}  // namespace touchstone
