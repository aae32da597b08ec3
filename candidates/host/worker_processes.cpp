#include "candidates/host/worker_processes.hpp"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <malloc.h>
#include <map>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

#include "candidates/host/guard.hpp"
#include "candidates/host/interruption.hpp"

namespace touchstone {
namespace {

/// Counters in memory shared between the parent and its workers.
class Shared {
 public:
  explicit Shared(unsigned workers)
      : bytes_(sizeof(std::atomic<std::uint64_t>) * (workers + 1)),
        memory_(mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {
    if (memory_ == MAP_FAILED) fail("mmap");
    for (unsigned i = 0; i <= workers; ++i) new (&at(i)) std::atomic<std::uint64_t>(0);
  }
  ~Shared() { munmap(memory_, bytes_); }
  Shared(const Shared&) = delete;
  Shared& operator=(const Shared&) = delete;

  /// Hides the memory from processes that this one forks from now on, such as those of plug-ins.
  void withhold_from_children() { madvise(memory_, bytes_, MADV_DONTFORK); }

  std::atomic<std::uint64_t>& next() { return at(0); }
  /// One more than the index of this worker's task; zero between tasks.
  std::atomic<std::uint64_t>& current(unsigned worker) { return at(worker + 1); }

 private:
  std::atomic<std::uint64_t>& at(unsigned i) {
    return static_cast<std::atomic<std::uint64_t>*>(memory_)[i];
  }
  std::size_t bytes_;
  void* memory_;
};

struct Header {
  std::uint64_t index;
  std::uint64_t size;
  std::uint64_t failed;
};

void write_all(int fd, const void* data, std::size_t size) {
  const char* bytes = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t written = write(fd, bytes, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) _exit(1);  // the parent has gone
    bytes += written;
    size -= static_cast<std::size_t>(written);
  }
}

/// Makes this process end with its parent, and leaves a terminal's Ctrl-C, its end or a scheduler's
/// SIGTERM to the parent: a candidate that died of those would be counted as crashed.
void follow(pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(0);  // the parent died before prctl
  signal(SIGINT, SIG_IGN);
  signal(SIGTERM, SIG_IGN);
  signal(SIGHUP, SIG_IGN);
}

[[noreturn]] void work(Shared& shared, unsigned worker, std::uint64_t count, int fd,
                       const std::function<std::string(std::uint64_t)>& task) {
  for (;;) {
    const std::uint64_t index = shared.next().fetch_add(1);
    if (index >= count) break;
    shared.current(worker) = index + 1;
    std::string result;
    bool failed = false;
    try {
      result = task(index);
    } catch (const std::exception& e) {
      result = e.what();
      failed = true;
    }
    const Header header{index, result.size(), failed};
    write_all(fd, &header, sizeof header);
    write_all(fd, result.data(), result.size());
    shared.current(worker) = 0;
  }
  _exit(0);
}

struct Worker {
  pid_t pid = -1;
  int fd = -1;
  std::string buffer;
};

/// All workers of a run. The destructor kills those that are still running.
class Workers {
 public:
  explicit Workers(unsigned count) : workers_(count) {}
  ~Workers() {
    end();
    for (Worker& w : workers_) {
      if (w.fd >= 0) close(w.fd);
    }
  }
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;
  std::vector<Worker>& all() { return workers_; }
  /// Kills those that are still running. What they wrote can still be read.
  void end() {
    for (Worker& w : workers_) {
      if (w.pid <= 0) continue;
      kill(w.pid, SIGKILL);
      waitpid(std::exchange(w.pid, -1), nullptr, 0);
    }
  }

 private:
  std::vector<Worker> workers_;
};

}  // namespace

std::vector<std::string> run_in_processes(std::size_t count, unsigned workers,
                                          const std::function<std::string(std::size_t)>& task,
                                          const std::function<std::string(std::size_t)>& name,
                                          const std::function<void(std::size_t)>& done) {
  std::vector<std::string> results(count);
  std::size_t finished = 0;
  stream_from_processes(
      count, workers, task, name,
      [&](std::uint64_t index, std::string result) {
        results[index] = std::move(result);
        done(++finished);
      },
      [] { return !interrupted(); });
  return results;
}

bool stream_from_processes(std::uint64_t count, unsigned workers,
                           const std::function<std::string(std::uint64_t)>& task,
                           const std::function<std::string(std::uint64_t)>& name,
                           const std::function<void(std::uint64_t, std::string)>& take,
                           const std::function<bool()>& go_on,
                           const std::function<void()>& forget) {
  constexpr int max_milliseconds = 100;
  workers = static_cast<unsigned>(
      std::clamp<std::uint64_t>(workers, 1, std::max<std::uint64_t>(count, 1)));
  Shared shared(workers);
  Workers pool(workers);
  const pid_t parent = getpid();
  for (unsigned i = 0; i < workers; ++i) {
    int ends[2];
    if (pipe(ends) != 0) fail("pipe");
    const pid_t pid = fork();
    if (pid < 0) fail("fork");
    if (pid == 0) {
      follow(parent);
      close(ends[0]);
      shared.withhold_from_children();
      forget();
      malloc_trim(0);  // what was freed but not given back has page tables, too
      work(shared, i, count, ends[1], task);
    }
    close(ends[1]);
    pool.all()[i] = {pid, ends[0], {}};
  }

  std::size_t open = workers;
  std::uint64_t taken = 0;
  const auto take_records = [&](std::string& buffer) {
    Header header;
    while (buffer.size() >= sizeof header) {
      std::memcpy(&header, buffer.data(), sizeof header);
      if (buffer.size() < sizeof header + header.size) break;
      std::string result = buffer.substr(sizeof header, header.size);
      buffer.erase(0, sizeof header + header.size);
      if (header.failed) throw TaskFailure(name(header.index) + ": " + result);
      take(header.index, std::move(result));
      ++taken;
    }
  };
  /// False at the end.
  const auto read_from = [&](Worker& w) {
    char chunk[1 << 16];
    const ssize_t size = read(w.fd, chunk, sizeof chunk);
    if (size > 0) w.buffer.append(chunk, static_cast<std::size_t>(size));
    return size != 0;  // also after an interruption
  };
  const auto run = [&] {
    while (open > 0) {
      if (!go_on()) return false;
      std::vector<pollfd> polled;
      for (const Worker& w : pool.all()) polled.push_back({w.fd, POLLIN, 0});
      if (poll(polled.data(), polled.size(), max_milliseconds) < 0) {
        if (errno == EINTR) continue;
        fail("poll");
      }
      for (unsigned i = 0; i < workers; ++i) {
        Worker& w = pool.all()[i];
        if (w.fd < 0 || polled[i].revents == 0) continue;
        if (read_from(w)) {
          take_records(w.buffer);
          continue;
        }
        close(std::exchange(w.fd, -1));
        --open;
        int status = 0;
        waitpid(std::exchange(w.pid, -1), &status, 0);
        const std::uint64_t at = shared.current(i);
        if (at != 0)
          throw TaskFailure(name(at - 1) + ": the worker's process: " + how_it_ended(status),
                            status);
      }
    }
    return true;
  };
  // What was finished before the end is not lost, nor what lies behind another failure.
  const auto take_finished = [&] {
    pool.end();
    for (Worker& w : pool.all()) {
      for (int ready = 1; w.fd >= 0 && ready > 0;) {
        pollfd polled{w.fd, POLLIN, 0};
        ready = poll(&polled, 1, 0);
        if (ready < 0 && errno == EINTR)
          ready = 1;
        else if (ready > 0 && !read_from(w))
          break;
      }
      for (bool is_more = true; is_more;) {
        try {
          take_records(w.buffer);
          is_more = false;
        } catch (const TaskFailure&) {  // the first one is told
        }
      }
    }
  };
  try {
    if (!run()) {
      take_finished();
      return false;
    }
  } catch (const TaskFailure&) {
    take_finished();
    throw;
  }
  if (taken != count) {  // a worker died between taking a task and noting that it has
    throw TaskFailure("a worker died: only " + std::to_string(taken) + " of " +
                      std::to_string(count) + " tasks were done");
  }
  return true;
}

bool stream_in_order(std::uint64_t count, unsigned workers,
                     const std::function<std::string(std::uint64_t)>& task,
                     const std::function<std::string(std::uint64_t)>& name,
                     const std::function<void(std::string)>& take,
                     const std::function<bool()>& go_on) {
  std::map<std::uint64_t, std::string> waiting;
  std::uint64_t next = 0;
  const auto take_in_turn = [&](std::uint64_t index, std::string result) {
    waiting[index] = std::move(result);
    for (auto first = waiting.begin(); first != waiting.end() && first->first == next; ++next) {
      take(std::move(first->second));
      first = waiting.erase(first);
    }
  };
  return stream_from_processes(count, workers, task, name, take_in_turn, go_on);
}

}  // namespace touchstone
