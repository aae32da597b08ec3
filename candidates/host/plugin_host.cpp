// touchstone-host FILE PARENT: the program that loads a plug-in and answers for it. A session is a
// fork of this process, and a fork of a small program copies little; Touchstone itself reads files
// with the libraries of half a dozen projects. touchstone-host COMMAND FOLDER PARENT starts a
// command in a folder and answers for that. It is started by plugin_process.cpp, whose process is
// PARENT, with the descriptors of exchange.hpp.
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

int main(int count, char** arguments) {
  using namespace touchstone;
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (count != 3 && count != 4) {
    std::fputs("touchstone-host is started by touchstone, once for each plug-in or command\n",
               stderr);
    return 2;
  }
  // Null for a file of another size: of a Touchstone from another build.
  const auto map = [](int file, std::size_t size, int protection) -> void* {
    struct stat status;
    if (fstat(file, &status) != 0 || status.st_size != static_cast<off_t>(size)) return nullptr;
    void* const memory = mmap(nullptr, size, protection, MAP_SHARED, file, 0);
    close(file);  // the plug-in gets none of these
    return memory == MAP_FAILED ? nullptr : memory;
  };
  const void* const questions = map(host_questions, sizeof(Questions), PROT_READ);
  void* const exchange = map(host_exchange, sizeof(Exchange), PROT_READ | PROT_WRITE);
  if (!questions || !exchange) {
    reply(host_socket, Reply::no_host, 0, 0);
    return 2;
  }
  if (std::to_string(getppid()) != arguments[count - 1]) return 0;  // it died before prctl
  // The namespace begins with the next process. Its first process must not run the plug-in, because
  // the kernel spares it fatal signals.
  if (begin_pid_namespace()) fork_guarded(-1);
  fork_guarded(host_socket);
  unsetenv(bind_now);  // was for this process, not for those that the plug-in may start
  fcntl(host_socket, F_SETFD, FD_CLOEXEC);
  serve_plugin(arguments[1], count == 4 ? arguments[2] : nullptr, host_socket,
               *static_cast<const Questions*>(questions), *static_cast<Exchange*>(exchange));
}
