#include "reports/campaigns/durable_file.hpp"

#include <boost/crc.hpp>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <unistd.h>

#include "properties/files/read_file.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, int error) {
  throw InvalidInput(
      "--out", '"' + file.string() + '"',
      fmt::format(
          "could not be written: {}{}", std::strerror(error),
          error == ENOSPC || error == EDQUOT ? "; make room, then go on with --resume" : ""));
}

/// An open file; the name goes with it unless it is kept.
class NewFile {
 public:
  explicit NewFile(std::filesystem::path path)
      : path_(std::move(path)),
        fd_(open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
    if (fd_ < 0) refuse(path_, errno);
  }
  ~NewFile() {
    if (fd_ >= 0) close(fd_);
    if (!path_.empty()) unlink(path_.c_str());
  }
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  void write(std::string_view text) {
    while (!text.empty()) {
      const ssize_t written = ::write(fd_, text.data(), text.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) refuse(path_, errno);
      text.remove_prefix(static_cast<std::size_t>(written));
    }
    if (fsync(fd_) != 0) refuse(path_, errno);
  }

  void rename_to(const std::filesystem::path& name) {
    if (rename(path_.c_str(), name.c_str()) != 0) refuse(name, errno);
    path_.clear();
  }

 private:
  std::filesystem::path path_;
  int fd_;
};

}  // namespace

void write_durably(const std::filesystem::path& file, std::string_view text) {
  NewFile partial(file.string() + ".partial");
  partial.write(text);
  partial.rename_to(file);
  // The new name is on the disk when the folder is.
  const auto parent = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  const int folder = open(parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) refuse(parent, errno);
  const int failed = fsync(folder);
  const int error = errno;
  close(folder);
  if (failed != 0 && error != EINVAL) refuse(parent, error);  // some file systems cannot
}

std::string read_whole(const std::filesystem::path& file, const char* field) {
  std::ifstream in(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (!in.is_open() || in.bad() || is_folder(file)) {
    throw InvalidInput(field, '"' + file.string() + '"', "could not be read");
  }
  return text;
}

std::string checksum(std::string_view text) {
  boost::crc_32_type crc;
  crc.process_bytes(text.data(), text.size());
  return fmt::format("{:08x}", crc.checksum());
}

FileLock::FileLock(const std::filesystem::path& file)
    : fd_(open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
  if (fd_ < 0) refuse(file, errno);
  struct flock whole {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  if (fcntl(fd_, F_SETLK, &whole) == 0) return;
  const int error = errno;
  close(fd_);
  if (error != EACCES && error != EAGAIN) refuse(file, error);
  throw InvalidInput("--out", '"' + file.parent_path().string() + '"',
                     "must be a folder to which no other campaign is writing");
}

FileLock::~FileLock() { close(fd_); }

}  // namespace touchstone
