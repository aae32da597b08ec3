#include "properties/files/write_file.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <string>
#include <system_error>
#include <unistd.h>
#include <utility>

#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

[[noreturn]] void fail() { throw std::system_error(errno, std::generic_category()); }

/// Open while it lives.
class Descriptor {
 public:
  Descriptor(const std::filesystem::path& path, int flags)
      : fd_(open(path.c_str(), flags | O_CLOEXEC, 0666)) {
    if (fd_ < 0) fail();
  }
  ~Descriptor() { close(fd_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  void write(std::string_view text) const {
    while (!text.empty()) {
      const ssize_t written = ::write(fd_, text.data(), text.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail();
      text.remove_prefix(static_cast<std::size_t>(written));
    }
  }
  /// To the disk; of folders, some file systems cannot.
  void sync() const {
    if (fsync(fd_) != 0 && errno != EINVAL) fail();
  }

 private:
  int fd_;
};

constexpr int to_write = O_WRONLY | O_CREAT | O_TRUNC;

void replace(const std::filesystem::path& file, std::string_view text) {
  const std::filesystem::path partial = file.string() + ".partial";
  try {
    const Descriptor out(partial, to_write);
    out.write(text);
    out.sync();
    if (rename(partial.c_str(), file.c_str()) != 0) fail();
  } catch (const std::system_error&) {
    unlink(partial.c_str());
    throw;
  }
  // The new name is on the disk when the folder is.
  Descriptor(file.has_parent_path() ? file.parent_path() : ".", O_RDONLY | O_DIRECTORY).sync();
}

}  // namespace

void write_file(const std::filesystem::path& file, std::string_view text, const char* field,
                const char* remedy) {
  std::error_code error;
  const bool ordinary =
      !std::filesystem::exists(file, error) || std::filesystem::is_regular_file(file, error);
  try {
    if (ordinary) {
      replace(file, text);
    } else {
      Descriptor(file, to_write).write(text);
    }
  } catch (const std::system_error& e) {
    throw InvalidInput(field, '"' + file.string() + '"',
                       "could not be written (" + e.code().message() + "); " + remedy);
  }
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
