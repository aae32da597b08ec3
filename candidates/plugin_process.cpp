// The harness's side of a plug-in's process; the plug-in's own is plugin_server.cpp.
#include <algorithm>
#include <cerrno>
#include <cstring>
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

#include "candidates/plugin_state.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

/// Loading a plug-in may read libraries from a cold disk.
constexpr int loading_milliseconds = 30000;

}  // namespace

void fail(const char* call) { throw std::system_error(errno, std::generic_category(), call); }

std::string readable(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const std::size_t length = lead < 0x80                    ? 1
                               : lead >= 0xc2 && lead <= 0xdf ? 2
                               : lead >= 0xe0 && lead <= 0xef ? 3
                               : lead >= 0xf0 && lead <= 0xf4 ? 4
                                                              : 0;
    bool good = length > 0 && i + length <= text.size();
    for (std::size_t k = 1; good && k < length; ++k) {
      good = (static_cast<unsigned char>(text[i + k]) & 0xc0) == 0x80;
    }
    if (good && length == 3) {  // neither an overlong form nor a surrogate
      const auto second = static_cast<unsigned char>(text[i + 1]);
      good = !(lead == 0xe0 && second < 0xa0) && !(lead == 0xed && second > 0x9f);
    }
    if (good && length == 4) {  // neither an overlong form nor beyond U+10FFFF
      const auto second = static_cast<unsigned char>(text[i + 1]);
      good = !(lead == 0xf0 && second < 0x90) && !(lead == 0xf4 && second > 0x8f);
    }
    if (!good) {
      result += '?';
      ++i;
      continue;
    }
    if (length == 1) {
      result += lead < 0x20 || lead == 0x7f ? ' ' : static_cast<char>(lead);
    } else {
      result.append(text, i, length);
    }
    i += length;
  }
  return result;
}

std::string how_it_ended(int status) {
  if (WIFSIGNALED(status)) return strsignal(WTERMSIG(status));
  return "ended with exit code " + std::to_string(WEXITSTATUS(status));
}

PluginProcess::State::~State() {
  if (socket >= 0) close(socket);
  if (text >= 0) close(text);
  if (pid > 0 && owner == getpid()) {
    kill(pid, SIGKILL);  // its sessions go with it
    waitpid(pid, nullptr, 0);
  }
  if (exchange) munmap(exchange, sizeof(Exchange));
}

bool PluginProcess::State::receive(void* message, std::size_t size, int milliseconds) const {
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

Report PluginProcess::State::receive() const {
  Report report;
  if (!receive(&report, sizeof report, -1)) throw std::runtime_error("a plug-in's process ended");
  return report;
}

void PluginProcess::State::send(const Command& command) const {
  if (::send(socket, &command, sizeof command, MSG_NOSIGNAL) < 0) fail("send");
}

std::string PluginProcess::State::last_line() const {
  char buffer[4096];
  const off_t size = lseek(text, 0, SEEK_END);
  const ssize_t got = pread(text, buffer, sizeof buffer, std::max<off_t>(0, size - 4096));
  std::string line(buffer, static_cast<std::size_t>(std::max<ssize_t>(0, got)));
  while (!line.empty() && line.back() == '\n') line.pop_back();
  return line.substr(line.rfind('\n') + 1);
}

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
    if (getppid() != s.owner) _exit(0);  // it died before that
    // A terminal's Ctrl-C goes to all of its processes; this one ends with its parent.
    signal(SIGINT, SIG_IGN);
    signal(SIGTERM, SIG_IGN);
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
  if (report.kind == Report::refused) refuse("it " + readable(report.text));
  for (int i = 0; i < report.value; ++i) {
    Description d;
    if (!s.receive(&d, sizeof d, loading_milliseconds)) refuse("it could not be described");
    Candidate c{
        d.name, d.name, readable(d.version), readable(d.settings), readable(d.models), {}, 0, {},
        file,   i};
    std::copy(std::begin(d.supports), std::end(d.supports), c.supports.begin());
    if (d.has_parameter)
      c.parameter = {readable(d.meaning), d.least, d.most, d.usual, d.whole, d.bare};
    s.candidates.push_back(std::move(c));
  }
}

PluginProcess::~PluginProcess() = default;
PluginProcess::PluginProcess(PluginProcess&&) noexcept = default;
PluginProcess& PluginProcess::operator=(PluginProcess&&) noexcept = default;

const std::vector<Candidate>& PluginProcess::candidates() const { return state_->candidates; }

}  // namespace touchstone
