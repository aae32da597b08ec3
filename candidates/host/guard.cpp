#include "candidates/host/guard.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <optional>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <string>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

#include "candidates/host/exchange.hpp"

namespace touchstone {
namespace {

/// Time in which a guard must end its processes.
constexpr std::chrono::milliseconds stopping_time(10000);

/// Writes in a single call, as the files of user namespaces require.
void write_file(const char* file, const std::string& text) {
  const int fd = open(file, O_WRONLY);
  if (fd < 0) return;
  [[maybe_unused]] const ssize_t written = write(fd, text.data(), text.size());
  close(fd);
}

/// Sends SIGKILL to all children, including those reparented to this process; as the first process
/// of a PID namespace, to all processes in it. False if the kernel does not list children.
bool kill_children() {
  if (getpid() == 1) {
    kill(-1, SIGKILL);
    return true;
  }
  std::FILE* const list = std::fopen("/proc/thread-self/children", "r");
  if (!list) return false;
  for (int child; std::fscanf(list, "%d", &child) == 1;) kill(child, SIGKILL);
  std::fclose(list);
  return true;
}

/// Kills children until none is left. This terminates because orphans are reparented to this
/// process.
void end_descendants(pid_t child) {
  while (kill_children()) {
    if (waitpid(-1, nullptr, 0) < 0 && errno == ECHILD) return;
  }
  kill(-child, SIGKILL);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
}

[[noreturn]] void guard(pid_t child, int socket) {
  sigset_t awaited;
  sigemptyset(&awaited);
  sigaddset(&awaited, SIGCHLD);
  sigaddset(&awaited, SIGTERM);
  std::optional<int> ended;
  for (bool over = false; !over;) {
    over = sigwaitinfo(&awaited, nullptr) == SIGTERM;
    int status = 0;
    for (pid_t pid; (pid = waitpid(-1, &status, WNOHANG | WUNTRACED)) > 0;) {
      if (pid == child) ended = status;
    }
    over |= ended.has_value();
  }
  end_descendants(child);
  if (ended && socket >= 0) reply(socket, Reply::gone, 0, *ended);
  _exit(0);
}

}  // namespace

bool begin_pid_namespace() {
  if (unshare(CLONE_NEWPID) == 0) return true;
  const std::string user = std::to_string(geteuid()), group = std::to_string(getegid());
  if (unshare(CLONE_NEWUSER | CLONE_NEWPID) != 0) return false;
  write_file("/proc/self/setgroups", "deny");
  write_file("/proc/self/uid_map", user + " " + user + " 1");
  write_file("/proc/self/gid_map", group + " " + group + " 1");
  return true;
}

void fork_guarded(int socket) {
  sigset_t all;
  sigfillset(&all);
  sigprocmask(SIG_BLOCK, &all, nullptr);
  signal(SIGCHLD, SIG_DFL);
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  const pid_t child = fork();
  if (child < 0) _exit(1);
  if (child > 0) guard(child, socket);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  setpgid(0, 0);
}

void become_plain_process(unsigned long max_file) {
  for (const int signal : {SIGHUP, SIGINT, SIGPIPE, SIGTERM}) ::signal(signal, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  const rlimit no_core{0, 0}, file_size{max_file, max_file};
  setrlimit(RLIMIT_CORE, &no_core);
  setrlimit(RLIMIT_FSIZE, &file_size);
  signal(SIGXFSZ, SIG_IGN);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
}

std::string last_line(int file) {
  char buffer[4096];
  const off_t size = lseek(file, 0, SEEK_END);
  const ssize_t got = pread(file, buffer, sizeof buffer, std::max<off_t>(0, size - 4096));
  std::string line(buffer, static_cast<std::size_t>(std::max<ssize_t>(0, got)));
  while (!line.empty() && line.back() == '\n') line.pop_back();
  return line.substr(line.rfind('\n') + 1);
}

std::string how_it_ended(int status) {
  if (WIFSIGNALED(status)) return strsignal(WTERMSIG(status));
  if (WIFSTOPPED(status)) return "was stopped";
  return "ended with exit code " + std::to_string(WEXITSTATUS(status));
}

void fail(const char* call) { throw std::system_error(errno, std::generic_category(), call); }

void end_guard(pid_t guard) {
  kill(guard, SIGCONT);
  kill(guard, SIGTERM);
  const int handle = static_cast<int>(syscall(SYS_pidfd_open, guard, 0));
  pollfd ended{handle, POLLIN, 0};
  if (handle >= 0) {
    int ready;
    while ((ready = poll(&ended, 1, static_cast<int>(stopping_time.count()))) < 0 &&
           errno == EINTR) {
    }
    if (ready == 0) kill(guard, SIGKILL);
    close(handle);
  }
  while (waitpid(guard, nullptr, 0) < 0 && errno == EINTR) {
  }
}

}  // namespace touchstone
