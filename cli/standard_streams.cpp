#include "cli/standard_streams.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <iostream>
#include <unistd.h>

namespace touchstone {

void open_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) != -1) continue;
    // For the other direction, and the lowest descriptor that is free: this one.
    open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
}

bool standard_output_is_written() {
  errno = 0;
  const bool flushed = std::fflush(stdout) == 0;
  const int reason = errno;
  std::cout.flush();
  if (flushed && std::cout.good() && std::ferror(stdout) == 0) return true;
  // An earlier failure has left no reason.
  const std::string why = flushed ? "" : std::string(" (") + std::strerror(reason) + ")";
  complain("error: standard output is incomplete: it could not be written" + why);
  return false;
}

void complain(const std::string& text) {
  std::fputs((text + '\n').c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace touchstone
