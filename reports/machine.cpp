#include "reports/machine.hpp"

#include <fstream>
#include <string>
#include <sys/utsname.h>
#include <unistd.h>

namespace touchstone {
namespace {

/// The text after `key` and a separator on the first line of a file that begins with it.
std::string value_in(const char* path, const std::string& key, char separator) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (line.rfind(key, 0) != 0) continue;
    std::string value = line.substr(line.find(separator) + 1);
    std::erase(value, '"');
    const std::size_t start = value.find_first_not_of(" \t");
    return start == std::string::npos ? "" : value.substr(start);
  }
  return "";
}

}  // namespace

Machine describe_machine() {
  utsname system{};
  uname(&system);
  std::string cpu = value_in("/proc/cpuinfo", "model name", ':');
  if (cpu.empty()) cpu = system.machine;
  std::string os = value_in("/etc/os-release", "PRETTY_NAME", '=');
  if (os.empty()) os = system.sysname;
  const std::string compiler = std::string("g++ ") + __VERSION__ + " " + TOUCHSTONE_FLAGS;
  return {cpu, compiler, os, static_cast<unsigned>(sysconf(_SC_NPROCESSORS_ONLN))};
}

}  // namespace touchstone
