#include "properties/files/disk.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <iostream>
#include <string>
#include <sys/file.h>
#include <system_error>
#include <unistd.h>

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

  /// In large blocks.
  void write(const std::vector<std::string_view>& texts) const {
    constexpr std::size_t max_block = std::size_t{1} << 20;
    std::string block;
    for (const std::string_view text : texts) {
      if (block.size() + text.size() > max_block) {
        write(block);
        block.clear();
      }
      if (text.size() > max_block) {
        write(text);
      } else {
        block += text;
      }
    }
    write(block);
  }
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

void replace(const std::filesystem::path& file, const std::vector<std::string_view>& texts) {
  const std::filesystem::path partial = file.string() + ".partial";
  try {
    const Descriptor out(partial, to_write);
    out.write(texts);
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
  write_file(file, std::vector{text}, field, remedy);
}

void write_file(const std::filesystem::path& file, const std::vector<std::string_view>& texts,
                const char* field, const char* remedy) {
  std::error_code error;
  const bool ordinary =
      !std::filesystem::exists(file, error) || std::filesystem::is_regular_file(file, error);
  try {
    if (ordinary) {
      replace(file, texts);
    } else {
      Descriptor(file, to_write).write(texts);
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

OutputFolder::OutputFolder(const std::filesystem::path& folder, const char* field, Use use) {
  check_writable(folder, field);
  fd_ = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  // On the folder itself: nothing is left behind, and links and other names are the same place.
  const int lock = (use == Use::alone ? LOCK_EX : LOCK_SH) | LOCK_NB;
  if (fd_ < 0 || flock(fd_, lock) == 0 || errno != EWOULDBLOCK) return;
  close(fd_);
  throw InvalidInput(field, '"' + folder.string() + '"',
                     fmt::format("must be a folder that no other run of Touchstone is using; wait "
                                 "for its end, or name another folder by {}",
                                 field));
}

OutputFolder::~OutputFolder() {
  if (fd_ >= 0) close(fd_);
}

void remove_older(const std::filesystem::path& folder, std::string_view beginning,
                  std::string_view ending) {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(beginning) || !name.ends_with(ending)) continue;
    if (entry.is_regular_file(error)) std::filesystem::remove(entry.path(), error);
  }
}

void check_file_writable(const std::filesystem::path& file, const char* field) {
  if (is_folder(file)) {
    throw InvalidInput(field, '"' + file.string() + '"', "must be a file, not a folder");
  }
  std::error_code error;
  const bool is_special = std::filesystem::exists(file, error) &&
                          !std::filesystem::is_regular_file(file, error);  // as /dev/stdout is
  if (!is_special) check_writable(file.has_parent_path() ? file.parent_path() : ".", field);
}

std::ifstream opened(const std::filesystem::path& file, const char* field) {
  const std::string name = '"' + file.string() + '"';
  if (is_folder(file)) throw InvalidInput(field, name, "must be a file, not a folder");
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (in) return in;
  throw InvalidInput(field, name,
                     fmt::format("could not be opened for reading ({})", std::strerror(errno)));
}

std::string read_file(const std::filesystem::path& file, const char* field, std::size_t max_size) {
  std::ifstream in = opened(file, field);
  return read_stream(in, '"' + file.string() + '"', field, max_size);
}

bool ended_by_error(const std::istream& in) {
  return in.bad() || (&in == &std::cin && std::ferror(stdin) != 0);
}

std::string read_stream(std::istream& in, const std::string& name, const char* field,
                        std::size_t max_size) {
  std::string text, block(1 << 16, '\0');
  while (in) {
    in.read(block.data(), static_cast<std::streamsize>(block.size()));
    text.append(block, 0, static_cast<std::size_t>(in.gcount()));
    if (text.size() > max_size) {
      throw InvalidInput(field, name, fmt::format("must have at most {} bytes", max_size));
    }
  }
  if (ended_by_error(in)) throw InvalidInput(field, name, "could not be read to its end");
  return text;
}

bool is_file(const std::filesystem::path& name) {
  std::error_code error;
  return std::filesystem::exists(name, error) && !is_folder(name);
}

bool is_folder(const std::filesystem::path& name) {
  std::error_code error;
  return std::filesystem::is_directory(name, error);
}

}  // namespace touchstone
