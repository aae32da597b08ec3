// The harness's side; the candidate's is plugin_server.cpp, what goes between them exchange.hpp.
#include "candidates/candidate_process.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdexcept>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include "candidates/candidates.hpp"
#include "candidates/exchange.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

using Clock = std::chrono::steady_clock;

/// Loading a plug-in may read libraries from a cold disk.
constexpr int loading_milliseconds = 30000;
/// How often a candidate's use of time is looked at.
constexpr int poll_milliseconds = 20;

[[noreturn]] void fail(const char* call) {
  throw std::system_error(errno, std::generic_category(), call);
}

std::string how_it_ended(int status) {
  if (WIFSIGNALED(status)) return strsignal(WTERMSIG(status));
  return "ended with exit code " + std::to_string(WEXITSTATUS(status));
}

/// Seconds of processor time that a process has used; zero when it is gone.
double processor_seconds(pid_t pid) {
  clockid_t clock;
  timespec time{};
  if (clock_getcpuclockid(pid, &clock) != 0 || clock_gettime(clock, &time) != 0) return 0;
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

struct PluginProcess::State {
  std::vector<Candidate> candidates;
  /// A candidate that calls exit runs our destructors in its own process: they must do nothing
  /// there.
  const pid_t owner = getpid();
  pid_t pid = -1;
  int socket = -1;
  int text = -1;  ///< what the plug-in prints
  Exchange* exchange = nullptr;

  ~State() {
    if (socket >= 0) close(socket);
    if (text >= 0) close(text);
    if (pid > 0 && owner == getpid()) {
      kill(pid, SIGKILL);  // its sessions go with it
      waitpid(pid, nullptr, 0);
    }
    if (exchange) munmap(exchange, sizeof(Exchange));
  }

  /// False when the other end is closed or nothing came in time.
  bool receive(void* message, std::size_t size, int milliseconds) const {
    pollfd polled{socket, POLLIN, 0};
    int ready;
    while ((ready = poll(&polled, 1, milliseconds)) < 0 && errno == EINTR) {
    }
    if (ready <= 0) return false;
    ssize_t got;
    while ((got = recv(socket, message, size, 0)) < 0 && errno == EINTR) {
    }
    return got == static_cast<ssize_t>(size);
  }

  Report receive() const {
    Report report;
    if (!receive(&report, sizeof report, -1)) throw std::runtime_error("a plug-in's process ended");
    return report;
  }

  void send(const Command& command) const {
    if (::send(socket, &command, sizeof command, MSG_NOSIGNAL) < 0) fail("send");
  }

  /// The last line that the candidate printed.
  std::string last_line() const {
    char buffer[4096];
    const off_t size = lseek(text, 0, SEEK_END);
    const ssize_t got = pread(text, buffer, sizeof buffer, std::max<off_t>(0, size - 4096));
    std::string line(buffer, static_cast<std::size_t>(std::max<ssize_t>(0, got)));
    while (!line.empty() && line.back() == '\n') line.pop_back();
    return line.substr(line.rfind('\n') + 1);
  }
};

PluginProcess::PluginProcess(const std::filesystem::path& file) : state_(new State) {
  State& s = *state_;
  void* const memory =
      mmap(nullptr, sizeof(Exchange), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) fail("mmap");
  s.exchange = new (memory) Exchange{};
  s.text = memfd_create("candidate", MFD_CLOEXEC);
  if (s.text < 0 || fcntl(s.text, F_SETFL, O_APPEND) < 0) fail("memfd_create");
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) fail("socketpair");
  s.socket = ends[0];
  s.pid = fork();
  if (s.pid < 0) fail("fork");
  if (s.pid == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    close(ends[0]);
    const int nothing = open("/dev/null", O_RDONLY);
    dup2(nothing, STDIN_FILENO);
    dup2(s.text, STDOUT_FILENO);
    dup2(s.text, STDERR_FILENO);
    serve_plugin(file.c_str(), ends[1], *s.exchange);
  }
  close(ends[1]);

  const auto refuse = [&](const std::string& why) {
    throw InvalidInput("--candidate", '"' + file.string() + '"',
                       "must be a plug-in made with candidate.h, but " + why);
  };
  Report report;
  if (!s.receive(&report, sizeof report, loading_milliseconds)) {
    kill(s.pid, SIGKILL);
    int status = 0;
    waitpid(std::exchange(s.pid, -1), &status, 0);
    refuse("its process was not there after loading: " + how_it_ended(status));
  }
  if (report.kind == Report::refused) refuse("it " + std::string(report.text));
  for (int i = 0; i < report.value; ++i) {
    Description d;
    if (!s.receive(&d, sizeof d, loading_milliseconds)) refuse("it could not be described");
    Candidate c{d.name, d.name, d.version, d.settings, d.models, {}, 0, {}, file, i};
    std::copy(std::begin(d.supports), std::end(d.supports), c.supports.begin());
    if (d.has_parameter) c.parameter = {d.meaning, d.least, d.most, d.usual, d.whole, d.bare};
    s.candidates.push_back(std::move(c));
  }
}

PluginProcess::~PluginProcess() = default;
PluginProcess::PluginProcess(PluginProcess&&) noexcept = default;
PluginProcess& PluginProcess::operator=(PluginProcess&&) noexcept = default;

const std::vector<Candidate>& PluginProcess::candidates() const { return state_->candidates; }

CandidateProcess::CandidateProcess(const Candidate& candidate, double threshold,
                                   const Limits& limits)
    : candidate_(candidate), threshold_(threshold), limits_(limits), plugin_(candidate.plugin) {}

void CandidateProcess::begin() {
  const PluginProcess::State& s = *plugin_.state_;
  if (ftruncate(s.text, 0) != 0) fail("ftruncate");
  s.send({Command::begin, 0, 0, candidate_.index, threshold_, candidate_.value,
          static_cast<std::uint64_t>(limits_.mebibytes * (1 << 20))});
  session_ = s.receive().value;
  if (session_ < 0) throw std::runtime_error("no process could be made for " + candidate_.name);
}

void CandidateProcess::end() {
  if (session_ < 0) return;
  plugin_.state_->send({Command::finish, 0, 0, 0, 0, 0, 0});
  plugin_.state_->receive();
  session_ = -1;
}

void CandidateProcess::put(std::uint32_t slot, const Configuration& c) {
  plugin_.state_->exchange->slots[slot].question = {to_ts_shape(c.a), to_ts_shape(c.b),
                                                    to_ts_pose(c.pose_a), to_ts_pose(c.pose_b)};
}

std::optional<Answer> CandidateProcess::obey(std::uint32_t kind, std::uint32_t first,
                                             std::uint32_t count) {
  const PluginProcess::State& s = *plugin_.state_;
  if (session_ < 0) begin();
  s.exchange->done = first;
  s.send({static_cast<Command::Kind>(kind), first, count, 0, 0, 0, 0});

  std::uint32_t done = first;
  double used = processor_seconds(session_);
  auto since = Clock::now();
  bool killed = false;
  Report report;
  pollfd polled{s.socket, POLLIN, 0};
  while (poll(&polled, 1, poll_milliseconds) == 0) {
    if (s.exchange->done != done) {
      done = s.exchange->done;
      used = processor_seconds(session_);
      since = Clock::now();
    } else if (!killed &&
               (processor_seconds(session_) - used > limits_.seconds ||
                Clock::now() - since > std::chrono::duration<double>(100 * limits_.seconds))) {
      kill(session_, SIGKILL);
      killed = true;
    }
  }
  report = s.receive();
  if (report.kind == Report::finished) return std::nullopt;
  session_ = -1;

  Answer answer{};
  answer.status = killed ? TS_TIMED_OUT : TS_CRASHED;
  const int status = report.value;
  if (killed) {
    char limit[32];
    std::snprintf(limit, sizeof limit, "%g", limits_.seconds);
    answer.reason = std::string("no answer within ") + limit + " s";
  } else if (WIFEXITED(status) && WEXITSTATUS(status) == exit_thrown) {
    answer.reason = "threw " + std::string(s.exchange->thrown,
                                           strnlen(s.exchange->thrown, sizeof s.exchange->thrown));
    std::replace(answer.reason.begin(), answer.reason.end(), '\n', ' ');
  } else {
    answer.reason = how_it_ended(status);
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT && !s.last_line().empty()) {
      answer.reason += ": " + s.last_line();
    }
  }
  return answer;
}

void CandidateProcess::answer_batch(std::uint32_t count, std::vector<Answer>& answers) {
  Exchange& exchange = *plugin_.state_->exchange;
  std::uint32_t first = 0;
  while (first < count) {
    const std::optional<Answer> misdeed = obey(Command::answer, first, count);
    const std::uint32_t done = misdeed ? std::min<std::uint32_t>(exchange.done, count) : count;
    for (; first < done; ++first) {
      const Slot& slot = exchange.slots[first];
      Answer& answer = answers.emplace_back(Answer{slot.answer, {}, {}});
      if (!std::isnan(slot.model_distance)) answer.model_distance = slot.model_distance;
      // Statuses and points that the interface does not allow are the candidate's failure.
      if (answer.status < TS_CONTACT || answer.status > TS_FAILED || answer.point_count < 0 ||
          answer.point_count > TOUCHSTONE_MAX_POINTS) {
        static_cast<ts_answer&>(answer) = {};
        answer.status = TS_FAILED;
      }
    }
    if (misdeed && first < count) {
      answers.push_back(*misdeed);
      ++first;
    }
  }
}

std::vector<Answer> CandidateProcess::answers(std::span<const Configuration> configurations) {
  end();
  std::vector<Answer> result;
  for (std::size_t at = 0; at < configurations.size(); at += Exchange::batch) {
    const auto batch = configurations.subspan(
        at, std::min<std::size_t>(Exchange::batch, configurations.size() - at));
    for (std::uint32_t i = 0; i < batch.size(); ++i) put(i, batch[i]);
    answer_batch(static_cast<std::uint32_t>(batch.size()), result);
  }
  return result;
}

Answer CandidateProcess::answer(const Configuration& configuration) {
  std::vector<Answer> result;
  put(0, configuration);
  answer_batch(1, result);
  return result.front();
}

bool CandidateProcess::prepare_timing(std::span<const Configuration> configurations) {
  end();
  for (std::size_t at = 0; at < configurations.size(); at += Exchange::batch) {
    const auto batch = configurations.subspan(
        at, std::min<std::size_t>(Exchange::batch, configurations.size() - at));
    for (std::uint32_t i = 0; i < batch.size(); ++i) put(i, batch[i]);
    if (obey(Command::keep, 0, static_cast<std::uint32_t>(batch.size()))) return false;
  }
  return !configurations.empty() && !obey(Command::warm_up, 0, 0);
}

std::optional<double> CandidateProcess::nanoseconds_per_query() {
  if (session_ < 0 || obey(Command::time, 0, 0)) return std::nullopt;
  const double nanoseconds = plugin_.state_->exchange->nanoseconds;
  return std::isfinite(nanoseconds) ? std::optional(nanoseconds) : std::nullopt;
}

std::vector<CandidateProcess> start(const std::vector<const Candidate*>& candidates,
                                    double threshold, const Limits& limits) {
  std::vector<CandidateProcess> processes;
  for (const Candidate* c : candidates) processes.emplace_back(*c, threshold, limits);
  return processes;
}

std::vector<CandidateProcess*> pointers(std::vector<CandidateProcess>& processes) {
  std::vector<CandidateProcess*> result;
  for (CandidateProcess& p : processes) result.push_back(&p);
  return result;
}

}  // namespace touchstone
