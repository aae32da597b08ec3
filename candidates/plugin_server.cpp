// The candidate's side: loads a plug-in, forks sessions of it, answers questions in them.
#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <dlfcn.h>
#include <exception>
#include <fcntl.h>
#include <limits>
#include <signal.h>
#include <stdexcept>
#include <string>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include "candidates/exchange.hpp"

namespace touchstone {
namespace {

/// A round of timing takes about this long, so that slow candidates do not take minutes.
constexpr std::chrono::microseconds round_time(500);
constexpr std::size_t fewest_timed = 10;

void send(int socket, const void* message, std::size_t size) {
  while (::send(socket, message, size, MSG_NOSIGNAL) < 0) {
    if (errno != EINTR) _exit(0);  // the harness is gone
  }
}

void report(int socket, Report::Kind kind, int value, const char* text = "") {
  Report r{kind, value, {}};
  std::snprintf(r.text, sizeof r.text, "%s", text);
  send(socket, &r, sizeof r);
}

/// The next command; ends the process when there is none to come.
Command receive(int socket) {
  Command command;
  for (;;) {
    const ssize_t size = recv(socket, &command, sizeof command, 0);
    if (size == sizeof command) return command;
    if (size < 0 && errno == EINTR) continue;
    _exit(0);
  }
}

const ts_plugin& load(const char* file) {
  void* const library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
  if (!library) throw std::runtime_error(dlerror());
  const auto entry =
      reinterpret_cast<decltype(&touchstone_plugin)>(dlsym(library, "touchstone_plugin"));
  if (!entry) throw std::runtime_error("exports no touchstone_plugin");
  const ts_plugin* plugin = entry();
  if (!plugin) throw std::runtime_error("gives no candidates");
  if (plugin->interface_version != TOUCHSTONE_INTERFACE_VERSION) {
    throw std::runtime_error("was made for version " + std::to_string(plugin->interface_version) +
                             " of candidate.h; this is version " +
                             std::to_string(TOUCHSTONE_INTERFACE_VERSION));
  }
  if (plugin->count < 1 || !plugin->candidates) throw std::runtime_error("gives no candidates");
  return *plugin;
}

template <std::size_t size>
void copy(const char* from, char (&to)[size]) {
  std::snprintf(to, size, "%s", from ? from : "");
}

Description describe(const ts_candidate& c) {
  if (!c.name || !*c.name || std::strpbrk(c.name, ":, \t\n")) {
    throw std::runtime_error("has a candidate whose name is empty or has a colon, comma or space");
  }
  if (!c.version || !c.settings || !c.supports || !c.prepare || !c.query || !c.release) {
    throw std::runtime_error(std::string("leaves something out in the candidate ") + c.name);
  }
  Description d{};
  copy(c.name, d.name);
  copy(c.version, d.version);
  copy(c.settings, d.settings);
  copy(c.models, d.models);
  if (c.parameter) {
    d.has_parameter = true;
    copy(c.parameter->meaning, d.meaning);
    d.least = c.parameter->least;
    d.most = c.parameter->most;
    d.usual = c.parameter->usual;
    d.whole = c.parameter->whole != 0;
    d.bare = c.parameter->bare != 0;
  }
  for (const ts_shape_kind kind : {TS_CYLINDER, TS_PLANE, TS_SPHERE, TS_CAPSULE, TS_BOX}) {
    d.supports[kind] = c.supports(kind) != 0;
  }
  return d;
}

/// Where a candidate writes its answer: the page behind is out of bounds, so that one point too
/// many is a crash wherever it is written, and the same one on every run.
ts_answer* make_answer() {
  const std::size_t page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  void* const memory =
      mmap(nullptr, 2 * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) _exit(1);
  char* const end = static_cast<char*>(memory) + page;
  mprotect(end, page, PROT_NONE);
  return reinterpret_cast<ts_answer*>(end - sizeof(ts_answer));
}

void bound_memory(std::uint64_t growth) {
  unsigned long pages = 0;
  if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
    if (std::fscanf(file, "%lu", &pages) != 1) pages = 0;
    std::fclose(file);
  }
  const rlim_t bytes = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + growth;
  const rlimit memory{bytes, bytes}, no_core{0, 0}, file_size{1 << 24, 1 << 24};
  setrlimit(RLIMIT_AS, &memory);
  setrlimit(RLIMIT_CORE, &no_core);
  setrlimit(RLIMIT_FSIZE, &file_size);
  signal(SIGXFSZ, SIG_IGN);
}

class Session {
 public:
  Session(const ts_candidate& candidate, const Command& begin, int socket, Exchange& exchange)
      : candidate_(candidate),
        threshold_(begin.threshold),
        parameter_(begin.parameter),
        socket_(socket),
        exchange_(exchange),
        answer_(make_answer()) {}

  [[noreturn]] void serve() {
    for (;;) {
      const Command command = receive(socket_);
      try {
        obey(command);
      } catch (const std::exception& e) {
        std::snprintf(exchange_.thrown, sizeof exchange_.thrown, "%s", e.what());
        _exit(exit_thrown);
      } catch (...) {
        std::snprintf(exchange_.thrown, sizeof exchange_.thrown, "something that is no exception");
        _exit(exit_thrown);
      }
      report(socket_, Report::finished, 0);
    }
  }

 private:
  /// Ready for timing.
  struct Kept {
    ts_prepared* prepared;
    ts_pose a, b;
  };

  void obey(const Command& command) {
    switch (command.kind) {
      case Command::answer:
        for (std::uint32_t i = command.first; i < command.count; ++i) answer(i);
        return;
      case Command::keep:
        for (std::uint32_t i = 0; i < command.count; ++i) {
          questions_.push_back(exchange_.slots[i].question);
        }
        return;
      case Command::warm_up:
        return warm_up();
      case Command::time:
        return time();
      case Command::begin:
      case Command::finish:
        _exit(0);
    }
  }

  ts_prepared* prepare(const Question& q) {
    if (!candidate_.supports(q.b.kind)) return nullptr;
    return candidate_.prepare(&q.a, &q.b, threshold_, parameter_);
  }

  void answer(std::uint32_t i) {
    Slot& slot = exchange_.slots[i];
    const Question question = slot.question;
    slot.model_distance = std::numeric_limits<double>::quiet_NaN();
    *answer_ = {};
    answer_->status = TS_UNSUPPORTED;
    if (ts_prepared* const prepared = prepare(question)) {
      candidate_.query(prepared, &question.pose_a, &question.pose_b, answer_);
      if (candidate_.model_distance) {
        slot.model_distance =
            candidate_.model_distance(prepared, &question.pose_a, &question.pose_b);
      }
      candidate_.release(prepared);
    }
    slot.answer = *answer_;
    exchange_.done.store(i + 1);
  }

  void warm_up() {
    std::chrono::steady_clock::duration used{};
    for (const Question& q : questions_) {
      if (kept_.size() >= fewest_timed && used > round_time) break;
      ts_prepared* const prepared = prepare(q);
      if (!prepared) continue;
      const auto start = std::chrono::steady_clock::now();
      candidate_.query(prepared, &q.pose_a, &q.pose_b, answer_);
      used += std::chrono::steady_clock::now() - start;
      kept_.push_back({prepared, q.pose_a, q.pose_b});
    }
  }

  void time() {
    // The process has slept since the last round: its first queries find cold caches.
    for (std::size_t i = 0; i < std::min(fewest_timed, kept_.size()); ++i) {
      candidate_.query(kept_[i].prepared, &kept_[i].a, &kept_[i].b, answer_);
    }
    const auto start = std::chrono::steady_clock::now();
    // The call goes through a function pointer, which no optimiser removes.
    for (const Kept& k : kept_) candidate_.query(k.prepared, &k.a, &k.b, answer_);
    const auto end = std::chrono::steady_clock::now();
    exchange_.nanoseconds = std::chrono::duration<double, std::nano>(end - start).count() /
                            static_cast<double>(kept_.size());
  }

  const ts_candidate& candidate_;
  double threshold_, parameter_;
  int socket_;
  Exchange& exchange_;
  ts_answer* answer_;
  std::vector<Question> questions_;
  std::vector<Kept> kept_;
};

}  // namespace

void serve_plugin(const char* file, int socket, Exchange& exchange) {
  const ts_plugin* plugin = nullptr;
  try {
    plugin = &load(file);
    std::vector<Description> descriptions;
    for (int i = 0; i < plugin->count; ++i) descriptions.push_back(describe(plugin->candidates[i]));
    report(socket, Report::described, plugin->count);
    for (const Description& d : descriptions) send(socket, &d, sizeof d);
  } catch (const std::exception& e) {
    report(socket, Report::refused, 0, e.what());
    _exit(1);
  }
  for (;;) {
    const Command command = receive(socket);
    const pid_t pid = fork();
    if (pid == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);  // if this process dies first, receive() ends the session
      bound_memory(command.memory);
      Session(plugin->candidates[command.index], command, socket, exchange).serve();
    }
    report(socket, Report::began, pid);
    int status = 0;
    while (pid > 0 && waitpid(pid, &status, 0) < 0 && errno == EINTR) {
    }
    if (pid > 0) report(socket, Report::ended, status);
  }
}

}  // namespace touchstone
