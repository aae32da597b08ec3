// The harness's side of a plug-in's process; the plug-in's own is plugin_server.cpp.
#include "candidates/host/plugin_process.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>
#include <utility>

#include "candidates/host/exchange.hpp"
#include "candidates/host/guard.hpp"
#include "candidates/readable.hpp"

namespace touchstone {
namespace {

using Clock = std::chrono::steady_clock;

/// Makes a file in memory that two processes can map.
int shared_file(std::size_t size) {
  const int file = memfd_create("exchange", MFD_CLOEXEC | MFD_ALLOW_SEALING);
  if (file < 0 || ftruncate(file, static_cast<off_t>(size)) < 0) fail("memfd_create");
  return file;
}

void* map(int file, std::size_t size, int protection) {
  void* const memory = mmap(nullptr, size, protection, MAP_SHARED, file, 0);
  if (memory == MAP_FAILED) fail("mmap");
  return memory;
}

std::chrono::milliseconds until(Clock::time_point end) {
  return std::max(std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now()),
                  std::chrono::milliseconds(0));
}

/// poll that ignores interruption by signals.
int poll_through(pollfd& polled, std::chrono::milliseconds time) {
  int ready;
  while ((ready = poll(&polled, 1, static_cast<int>(time.count()))) < 0 && errno == EINTR) {
  }
  return ready;
}

/// Found once: while a folder is built anew, its files come and go.
const std::string& host_program() {
  static const std::string program = standard_folder() / "touchstone-host";
  return program;
}

NoHost no_host(const std::string& why) {
  return NoHost("touchstone-host", in_quotes(host_program()),
                "must be a program that can be started, but that says \"" + why +
                    "\"; build or install Touchstone again");
}

}  // namespace

PluginProcess::PluginProcess()
    : text_(memfd_create("candidate", MFD_CLOEXEC)),
      questions_file_(shared_file(sizeof(Questions))),
      exchange_file_(shared_file(sizeof(Exchange))) {
  if (text_ < 0 || fcntl(text_, F_SETFL, O_APPEND) < 0) fail("memfd_create");
  // Not cleared: it is large, and most of it is never used.
  questions_ = new (map(questions_file_, sizeof(Questions), PROT_READ | PROT_WRITE)) Questions;
  exchange_ = new (map(exchange_file_, sizeof(Exchange), PROT_READ | PROT_WRITE)) Exchange{};
  // Each plug-in's process maps its own memory and does not inherit that of others.
  madvise(questions_, sizeof(Questions), MADV_DONTFORK);
  madvise(exchange_, sizeof(Exchange), MADV_DONTFORK);
  // From here on no process can map the questions for writing.
  if (fcntl(questions_file_, F_ADD_SEALS, F_SEAL_FUTURE_WRITE) < 0) fail("fcntl");
}

PluginProcess::PluginProcess(const std::filesystem::path& file, std::chrono::milliseconds loading)
    : PluginProcess() {
  start_host({file.string()});
  if (const std::string why = describe(loading); !why.empty()) {
    throw InvalidInput("--load", in_quotes(file.string()),
                       "must be a plug-in made with candidate.h, but " + why);
  }
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    candidates_[i].origin = Candidate::Plugin{file, static_cast<int>(i)};
  }
}

PluginProcess::PluginProcess(const Candidate::Command& command, std::chrono::milliseconds loading)
    : PluginProcess() {
  start_host({command.line, command.folder.string()});
  if (std::string why = describe(loading); !why.empty()) {
    if (!last_line().empty()) why += "; standard error: " + readable(last_line());
    throw InvalidInput(
        "--candidate-command", in_quotes(command.line),
        "must be a command that speaks as docs/engine.md says, not as this one: " + why);
  }
  auto& origin = std::get<Candidate::Command>(candidates_.front().origin);
  origin.line = command.line;
  origin.folder = command.folder;
}

PluginProcess::~PluginProcess() {
  stop();
  for (const int file : {text_, questions_file_, exchange_file_}) close(file);
  if (owner_ != getpid()) return;
  munmap(questions_, sizeof(Questions));
  munmap(exchange_, sizeof(Exchange));
}

void PluginProcess::stop() {
  if (guard_ > 0 && owner_ == getpid()) end_guard(guard_);
  guard_ = -1;
  // Not earlier: a routine that waits for the end of the connection would continue.
  if (socket_ >= 0) close(std::exchange(socket_, -1));
}

std::string PluginProcess::last_line() const { return touchstone::last_line(text_); }

void PluginProcess::clear_text() const {
  if (ftruncate(text_, 0) != 0) fail("ftruncate");
}

void PluginProcess::start_host(std::vector<std::string> arguments) {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) fail("socketpair");
  socket_ = ends[0];
  // Messages carry their sender's id as seen in our own PID namespace.
  const int yes = 1;
  setsockopt(socket_, SOL_SOCKET, SO_PASSCRED, &yes, sizeof yes);
  const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
  // Its descriptors from standard input on.
  const std::array files = {nothing, text_, text_, ends[1], questions_file_, exchange_file_};

  // First out of each other's way.
  constexpr int behind = static_cast<int>(files.size());
  std::vector<int> moved;
  for (const int file : files) moved.push_back(fcntl(file, F_DUPFD_CLOEXEC, behind));
  const bool are_moved = std::ranges::all_of(moved, [](int file) { return file >= 0; });
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (int i = 0; i < behind; ++i) {
    posix_spawn_file_actions_adddup2(&actions, moved[static_cast<std::size_t>(i)], i);
  }
  posix_spawn_file_actions_addclosefrom_np(&actions, behind);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);

  std::string program = host_program(), setting = std::string(bind_now) + "=1";
  arguments.push_back(std::to_string(getpid()));
  std::vector<char*> words = {program.data()}, environment = {setting.data()};
  for (std::string& argument : arguments) words.push_back(argument.data());
  for (char** each = environ; *each; ++each) environment.push_back(*each);
  words.push_back(nullptr);
  environment.push_back(nullptr);
  const int error = are_moved ? posix_spawn(&guard_, program.c_str(), &actions, &attributes,
                                            words.data(), environment.data())
                              : EMFILE;
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  for (const int each : moved) close(each);
  for (const int each : {nothing, ends[1]}) close(each);
  if (error == 0) return;
  guard_ = -1;
  stop();
  throw no_host(std::strerror(error));
}

PluginProcess::Received PluginProcess::receive(void* message, std::size_t size,
                                               std::chrono::milliseconds time,
                                               pid_t* sender) const {
  pollfd polled{socket_, POLLIN, 0};
  if (poll_through(polled, time) <= 0) return Received::nothing;
  iovec part{message, size};
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof(ucred))];
  msghdr header{};
  header.msg_iov = &part;
  header.msg_iovlen = 1;
  header.msg_control = control;
  header.msg_controllen = sizeof control;
  const ssize_t got = recvmsg(socket_, &header, MSG_TRUNC | MSG_CMSG_CLOEXEC);
  if (got <= 0 && (got < 0 || (polled.revents & POLLHUP))) {
    return got < 0 && errno == EINTR ? Received::nothing : Received::end;
  }
  if (got != static_cast<ssize_t>(size)) return Received::noise;
  const cmsghdr* const first = CMSG_FIRSTHDR(&header);
  if (sender && first && first->cmsg_type == SCM_CREDENTIALS) {
    ucred credentials;
    std::memcpy(&credentials, CMSG_DATA(first), sizeof credentials);
    *sender = credentials.pid;
  }
  return Received::message;
}

bool PluginProcess::wait_for(void* message, std::size_t size, std::chrono::milliseconds time,
                             pid_t* sender) const {
  const auto end = Clock::now() + time;
  while (Clock::now() <= end) {
    const Received received = receive(message, size, until(end), sender);
    if (received == Received::message) return true;
    if (received == Received::end) return false;
  }
  return false;
}

std::optional<Reply> PluginProcess::await(Reply::Kind kind, std::uint64_t ticket,
                                          std::chrono::milliseconds time, pid_t* sender) const {
  Reply reply;
  const auto end = Clock::now() + time;
  while (Clock::now() < end && wait_for(&reply, sizeof reply, until(end), sender)) {
    if (reply.kind == kind && reply.ticket == ticket) return reply;
  }
  return std::nullopt;
}

bool PluginProcess::send(const SessionCommand& command) const {
  return ::send(socket_, &command, sizeof command, MSG_NOSIGNAL) == sizeof command;
}

std::string PluginProcess::describe(std::chrono::milliseconds loading) {
  const auto told = [](const Reply& r) {
    return r.kind == Reply::described || r.kind == Reply::refused || r.kind == Reply::no_host ||
           r.kind == Reply::gone;
  };
  Reply reply;
  const auto end = Clock::now() + loading;
  bool heard;
  do {
    heard = wait_for(&reply, sizeof reply, until(end));
  } while (heard && !told(reply));
  if (!heard && Clock::now() < end) return "its process was not there after loading";
  if (!heard) {
    return "nothing was heard of it within " + std::to_string(loading.count()) + " ms of loading";
  }
  if (reply.kind == Reply::no_host) throw no_host("it is of another build");
  if (reply.kind == Reply::gone) {
    return "its process was not there after loading: " + how_it_ended(reply.value);
  }
  if (reply.kind == Reply::refused) return "it " + readable(text_of(exchange_->text));
  for (int i = 0; i < reply.value; ++i) {
    Description d;
    if (!wait_for(&d, sizeof d, until(end))) return "it could not be described";
    Candidate& c = candidates_.emplace_back();
    c.name = c.family = d.name;
    c.version = readable(d.version);
    c.settings = readable(d.settings);
    c.models = readable(d.models);
    std::copy(std::begin(d.supports), std::end(d.supports), c.supports.begin());
    is_unforked_ = d.unforked;
    if (d.runs[0] != '\0') {  // a command
      c.precision = d.precision;
      c.runs = d.runs;
      c.origin = Candidate::Command{"", "", d.in_frames};
    }
    if (d.has_parameter)
      c.parameter = {readable(d.meaning), d.min, d.max, d.usual, d.whole, d.bare};
  }
  return "";
}

}  // namespace touchstone
