// touchstone-host FILE: the program that loads a plug-in and answers for it. A session is a fork of
// this process, and a fork of a small program copies little; Touchstone itself reads files with the
// libraries of half a dozen projects. It is started by plugin_process.cpp, with the descriptors of
// exchange.hpp.
#include <cstdio>
#include <cstdlib>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "candidates/host/exchange.hpp"

int main(int count, char** arguments) {
  using namespace touchstone;
  // Null for a file of another size: of a Touchstone from another build.
  const auto map = [](int file, std::size_t size, int protection) -> void* {
    struct stat status;
    if (fstat(file, &status) != 0 || status.st_size != static_cast<off_t>(size)) return nullptr;
    void* const memory = mmap(nullptr, size, protection, MAP_SHARED, file, 0);
    close(file);  // the plug-in gets none of these
    return memory;
  };
  void* const questions = map(host_questions, sizeof(Questions), PROT_READ);
  void* const exchange = map(host_exchange, sizeof(Exchange), PROT_READ | PROT_WRITE);
  if (count == 2 && (!questions || !exchange)) {
    reply(host_socket, Reply::no_host, 0, 0, "it is of another build");
    return 2;
  }
  if (count != 2 || questions == MAP_FAILED || exchange == MAP_FAILED) {
    std::fputs("touchstone-host is started by touchstone, once for each plug-in\n", stderr);
    return 2;
  }
  unsetenv(bind_now);  // was for this process, not for those that the plug-in may start
  serve_plugin(arguments[1], host_socket, *static_cast<const Questions*>(questions),
               *static_cast<Exchange*>(exchange));
}
