// touchstone-host FILE PARENT: the program that loads a plug-in and answers for it. A session is a
// fork of this process, and a fork of a small program copies little; Touchstone itself reads files
// with the libraries of half a dozen projects. touchstone-host COMMAND FOLDER PARENT becomes a
// command that runs in a folder. It is started by host_process.cpp, whose process is PARENT, with
// the descriptors of exchange.hpp.
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <signal.h>
#include <string>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "candidates/host/exchange.hpp"
#include "candidates/host/guard.hpp"

namespace touchstone {
namespace {

/// What a command may write to one file, its standard error included.
constexpr unsigned long max_file_of_command = 1ul << 28;

/// Is this a program and its arguments alone, so that the shell can become the program?
bool is_simple(const std::string& command) {
  const bool has_operator = command.find_first_of(";&|<>(){}\n`") != std::string::npos;
  const bool has_assignment = command.substr(0, command.find(' ')).find('=') != std::string::npos;
  return !has_operator && !has_assignment;
}

[[noreturn]] void become(const std::string& command, const char* folder) {
  become_plain_process(max_file_of_command);
  fcntl(host_socket, F_SETFD, FD_CLOEXEC);
  if (chdir(folder) != 0) {
    std::perror(folder);
    _exit(126);
  }
  // Without a shell in between the end of the command's output is seen at once.
  const std::string line = is_simple(command) ? "exec " + command : command;
  execl("/bin/sh", "sh", "-c", line.c_str(), static_cast<char*>(nullptr));
  _exit(127);
}

}  // namespace
}  // namespace touchstone

int main(int count, char** arguments) {
  using namespace touchstone;
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  // Null for a file of another size: of a Touchstone from another build.
  const auto map = [](int file, std::size_t size, int protection) -> void* {
    struct stat status;
    if (fstat(file, &status) != 0 || status.st_size != static_cast<off_t>(size)) return nullptr;
    void* const memory = mmap(nullptr, size, protection, MAP_SHARED, file, 0);
    close(file);  // the plug-in gets none of these
    return memory;
  };
  const bool is_command = count == 4;
  void* const questions = is_command ? nullptr : map(host_questions, sizeof(Questions), PROT_READ);
  void* const exchange =
      is_command ? nullptr : map(host_exchange, sizeof(Exchange), PROT_READ | PROT_WRITE);
  if (count == 3 && (!questions || !exchange)) {
    reply(host_socket, Reply::no_host, 0, 0, "it is of another build");
    return 2;
  }
  if ((count != 3 && !is_command) || questions == MAP_FAILED || exchange == MAP_FAILED) {
    std::fputs("touchstone-host is started by touchstone, once for each plug-in or command\n",
               stderr);
    return 2;
  }
  if (std::to_string(getppid()) != arguments[count - 1]) return 0;  // it died before prctl
  // The namespace begins with the next process. Its first process must not run the plug-in, because
  // the kernel spares it fatal signals.
  if (begin_pid_namespace()) fork_guarded(-1);
  fork_guarded(host_socket);
  unsetenv(bind_now);  // was for this process, not for those that the plug-in may start
  if (is_command) become(arguments[1], arguments[2]);
  serve_plugin(arguments[1], host_socket, *static_cast<const Questions*>(questions),
               *static_cast<Exchange*>(exchange));
}
