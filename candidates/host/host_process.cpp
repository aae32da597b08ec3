#include "candidates/host/host_process.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <system_error>
#include <utility>

#include "candidates/candidates.hpp"
#include "candidates/host/exchange.hpp"
#include "candidates/host/guard.hpp"

namespace touchstone {
namespace {

/// Found once: while a folder is built anew, its files come and go.
const std::string& host_program() {
  static const std::string program = standard_folder() / "touchstone-host";
  return program;
}

}  // namespace

void fail(const char* call) { throw std::system_error(errno, std::generic_category(), call); }

HostProcess::HostProcess() : text_(memfd_create("candidate", MFD_CLOEXEC)) {
  if (text_ < 0 || fcntl(text_, F_SETFL, O_APPEND) < 0) fail("memfd_create");
}

HostProcess::~HostProcess() {
  stop();
  close(text_);
}

void HostProcess::stop() {
  if (guard_ > 0 && owner_ == getpid()) end_guard(guard_);
  guard_ = -1;
  // Not earlier: a routine that waits for the end of the connection would continue.
  if (socket_ >= 0) close(std::exchange(socket_, -1));
}

std::string HostProcess::last_line() const { return touchstone::last_line(text_); }

void HostProcess::clear_text() const {
  if (ftruncate(text_, 0) != 0) fail("ftruncate");
}

NoHost HostProcess::no_host(const std::string& why) {
  return NoHost("touchstone-host", in_quotes(host_program()),
                "must be a program that can be started, but that says \"" + why +
                    "\"; build or install Touchstone again");
}

void HostProcess::start_host(std::vector<std::string> arguments, std::vector<int> files) {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) fail("socketpair");
  socket_ = ends[0];
  // Messages carry their sender's id as seen in our own PID namespace.
  const int yes = 1;
  setsockopt(socket_, SOL_SOCKET, SO_PASSCRED, &yes, sizeof yes);
  files.insert(files.begin() + host_socket, ends[1]);

  // First out of each other's way.
  const int behind = static_cast<int>(files.size());
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
  close(ends[1]);
  if (error == 0) return;
  guard_ = -1;
  stop();
  throw no_host(std::strerror(error));
}

}  // namespace touchstone
