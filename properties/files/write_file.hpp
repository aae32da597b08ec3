#pragma once

#include <filesystem>
#include <string_view>

namespace touchstone {

/// Writes a file as a whole or not at all, whatever ends the program or the machine: into a file
/// beside it, to the disk, then under its name; what stood there before stays until then. What is
/// no ordinary file (/dev/stdout) is written as it is. Throws InvalidInput, with the option `field`
/// that asked for the file, the system's reason, such as a full disk, and the remedy.
void write_file(const std::filesystem::path& file, std::string_view text, const char* field,
                const char* remedy = "make room, or name another place");

/// Throws InvalidInput, with the option `field` that named the folder, if files could not be
/// written there; makes the folder.
void check_writable(const std::filesystem::path& folder, const char* field = "--out");

}  // namespace touchstone
