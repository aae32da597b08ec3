#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace touchstone {

/// Writes a file as a whole or not at all, whatever ends the program or the machine: into a file
/// beside it, to the disk, then under its name. What stood there before stays until then. Throws
/// InvalidInput (field "--out") naming the system's reason, such as a full disk.
void write_durably(const std::filesystem::path& file, std::string_view text);

/// The whole file; throws InvalidInput (with this field) if it cannot be read.
std::string read_whole(const std::filesystem::path& file, const char* field);

/// CRC-32 (as in zip and PNG) as eight hexadecimal digits: finds damage, not malice.
std::string checksum(std::string_view text);

/// Held by one process at a time, and let go when it ends, however it does: a record lock, which
/// its children do not hold.
class FileLock {
 public:
  /// Makes the file. Throws InvalidInput (field "--out") if another process holds it.
  explicit FileLock(const std::filesystem::path& file);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  int fd_;
};

}  // namespace touchstone
