#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

namespace touchstone {

/// Ten times the largest that we write; without a bound, a wrong file (/dev/zero) would take all
/// memory.
inline constexpr std::size_t max_file_size = std::size_t{1} << 27;

/// The whole file. Throws InvalidInput with this field and the file's name unless it can be read
/// and has at most `max_file_size` bytes.
std::string read_file(const std::filesystem::path& file, const char* field);
/// The rest of an open stream; `name` is what errors call it.
std::string read_stream(std::istream& in, const std::string& name, const char* field);

/// True for the name of a file that is not a folder.
bool is_file(const std::filesystem::path& name);
bool is_folder(const std::filesystem::path& name);

}  // namespace touchstone
