#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace touchstone {

/// Writes a file as a whole or not at all, whatever ends the program or the machine: into a file
/// beside it, to the disk, then under its name; what stood there before stays until then. What is
/// no ordinary file (/dev/stdout) is written as it is. Throws InvalidInput, with the option `field`
/// that asked for the file, the system's reason, such as a full disk, and the remedy.
void write_file(const std::filesystem::path& file, std::string_view text, const char* field,
                const char* remedy = "make room, or name another place");
/// Writes these one after the other, so that they need not be put together in memory.
void write_file(const std::filesystem::path& file, const std::vector<std::string_view>& texts,
                const char* field, const char* remedy);

/// Throws InvalidInput, with the option `field` that named the folder, if files could not be
/// written there; makes the folder.
void check_writable(const std::filesystem::path& folder, const char* field = "--out");

/// A folder in which a run writes its files, which no other run is to mix with its own. Claimed as
/// long as this lives, and let go however the process ends; where the file system has no locks,
/// nobody is kept out.
class OutputFolder {
 public:
  /// Many can share it: the parts of a campaign.
  enum class Use { alone, shared };
  /// Makes the folder. Throws InvalidInput, with the option `field` that named it, if files could
  /// not be written there, or if another process has claimed it and either is to use it alone.
  explicit OutputFolder(const std::filesystem::path& folder, const char* field = "--out",
                        Use use = Use::alone);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

 private:
  int fd_;
};

/// Removes the files of a folder whose names begin and end so: those of an earlier run that this
/// one need not write, for they would be taken for its own.
void remove_older(const std::filesystem::path& folder, std::string_view beginning,
                  std::string_view ending);

/// Like check_writable for a file, before the work of which it is to hold the result; makes its
/// folder.
void check_file_writable(const std::filesystem::path& file, const char* field);

/// Ten times the largest that we write; without a bound, a wrong file (/dev/zero) would take all
/// memory.
inline constexpr std::size_t max_file_size = std::size_t{1} << 27;

/// A file of input. Throws InvalidInput with this field and the file's name if it cannot be read.
std::ifstream opened(const std::filesystem::path& file, const char* field);
/// The whole file. Throws InvalidInput with this field and the file's name unless it can be read
/// and has at most `max_size` bytes.
std::string read_file(const std::filesystem::path& file, const char* field,
                      std::size_t max_size = max_file_size);
/// The rest of an open stream; `name` is what errors call it.
std::string read_stream(std::istream& in, const std::string& name, const char* field,
                        std::size_t max_size = max_file_size);
/// Has an error rather than its end ended the stream? std::cin keeps that from its readers.
bool ended_by_error(const std::istream& in);

/// True for the name of anything that exists and is not a folder, a pipe for example.
bool is_file(const std::filesystem::path& name);
bool is_folder(const std::filesystem::path& name);

}  // namespace touchstone
