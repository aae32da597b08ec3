#pragma once

#include <filesystem>
#include <string_view>

namespace touchstone {

/// Writes a file as a whole or not at all; what is no ordinary file (/dev/stdout) is written as it
/// is. Throws InvalidInput, with the option `field` that asked for the file, where that fails.
void write_file(const std::filesystem::path& file, std::string_view text, const char* field);

/// Throws InvalidInput, with the option `field` that named the folder, if files could not be
/// written there; makes the folder.
void check_writable(const std::filesystem::path& folder, const char* field = "--out");

}  // namespace touchstone
