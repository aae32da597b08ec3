#include "properties/files/write_file.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <unistd.h>

#include "reference/invalid_input.hpp"

namespace touchstone {

void write_file(const std::filesystem::path& file, std::string_view text, const char* field) {
  std::error_code error;
  const bool ordinary =
      !std::filesystem::exists(file, error) || std::filesystem::is_regular_file(file, error);
  const std::filesystem::path at = ordinary ? file.string() + ".partial" : file.string();
  std::ofstream out(at, std::ios::binary);
  out << text;
  out.close();
  const int reason = errno;  // of what failed first: streams stop there
  bool written = static_cast<bool>(out);
  std::string why = std::strerror(reason);
  if (ordinary && written) {
    std::filesystem::rename(at, file, error);
    written = !error;
    why = error.message();
  }
  if (written) return;
  if (ordinary) std::filesystem::remove(at, error);
  throw InvalidInput(field, '"' + file.string() + '"',
                     "could not be written (" + why + "); make room, or name another place");
}

void check_writable(const std::filesystem::path& folder, const char* field) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || access(folder.c_str(), W_OK | X_OK) != 0) {
    throw InvalidInput(field, '"' + folder.string() + '"',
                       "must be a folder that can be written to");
  }
}

}  // namespace touchstone
