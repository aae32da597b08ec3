// The harness's side of a plug-in's process; the plug-in's own is plugin_server.cpp.
#include "candidates/host/plugin_process.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>

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

}  // namespace

PluginProcess::PluginProcess(const std::filesystem::path& file, std::chrono::milliseconds loading)
    : file_(file),
      questions_file_(shared_file(sizeof(Questions))),
      exchange_file_(shared_file(sizeof(Exchange))) {
  questions_ = new (map(questions_file_, sizeof(Questions), PROT_READ | PROT_WRITE)) Questions{};
  exchange_ = new (map(exchange_file_, sizeof(Exchange), PROT_READ | PROT_WRITE)) Exchange{};
  // Each plug-in's process maps its own memory and does not inherit that of others.
  madvise(questions_, sizeof(Questions), MADV_DONTFORK);
  madvise(exchange_, sizeof(Exchange), MADV_DONTFORK);
  // From here on no process can map the questions for writing.
  if (fcntl(questions_file_, F_ADD_SEALS, F_SEAL_FUTURE_WRITE) < 0) fail("fcntl");
  try {
    start(loading);
  } catch (...) {
    release_memory();
    throw;
  }
}

PluginProcess::~PluginProcess() {
  stop();
  release_memory();
}

void PluginProcess::release_memory() {
  for (const int file : {questions_file_, exchange_file_}) close(file);
  if (owner_ != getpid()) return;
  munmap(questions_, sizeof(Questions));
  munmap(exchange_, sizeof(Exchange));
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

void PluginProcess::start(std::chrono::milliseconds loading) {
  const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
  start_host({file_.string()}, {nothing, text_, text_, questions_file_, exchange_file_});
  close(nothing);

  const auto refuse = [&](const std::string& why) {
    stop();
    throw InvalidInput("--load", in_quotes(file_.string()),
                       "must be a plug-in made with candidate.h, but " + why);
  };
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
  if (!heard && Clock::now() < end) refuse("its process was not there after loading");
  if (!heard) {
    refuse("nothing was heard of it within " + std::to_string(loading.count()) + " ms of loading");
  }
  if (reply.kind == Reply::no_host) {  // no fault of the plug-in
    stop();
    throw no_host(reply.text);
  }
  if (reply.kind == Reply::gone) {
    refuse("its process was not there after loading: " + how_it_ended(reply.value));
  }
  if (reply.kind != Reply::described) refuse("it " + readable(reply.text));
  candidates_.clear();
  for (int i = 0; i < reply.value; ++i) {
    Description d;
    if (!wait_for(&d, sizeof d, until(end))) refuse("it could not be described");
    Candidate& c = candidates_.emplace_back();
    c.name = c.family = d.name;
    c.version = readable(d.version);
    c.settings = readable(d.settings);
    c.models = readable(d.models);
    c.origin = Candidate::Plugin{file_, i};
    std::copy(std::begin(d.supports), std::end(d.supports), c.supports.begin());
    is_unforked_ = d.unforked;
    if (d.has_parameter)
      c.parameter = {readable(d.meaning), d.min, d.max, d.usual, d.whole, d.bare};
  }
}

}  // namespace touchstone
