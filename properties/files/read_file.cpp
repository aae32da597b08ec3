#include "properties/files/read_file.hpp"

#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <istream>
#include <system_error>

#include "reference/invalid_input.hpp"

namespace touchstone {

std::string read_file(const std::filesystem::path& file, const char* field) {
  const std::string name = '"' + file.string() + '"';
  if (is_folder(file)) throw InvalidInput(field, name, "must be a file, not a folder");
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in) {
    throw InvalidInput(field, name,
                       fmt::format("could not be opened for reading ({})", std::strerror(errno)));
  }
  return read_stream(in, name, field);
}

std::string read_stream(std::istream& in, const std::string& name, const char* field) {
  std::string text, block(1 << 16, '\0');
  while (in) {
    in.read(block.data(), static_cast<std::streamsize>(block.size()));
    text.append(block, 0, static_cast<std::size_t>(in.gcount()));
    if (text.size() > max_file_size) {
      throw InvalidInput(field, name, fmt::format("must have at most {} bytes", max_file_size));
    }
  }
  if (in.bad()) throw InvalidInput(field, name, "could not be read to its end");
  return text;
}

bool is_file(const std::filesystem::path& name) {
  std::error_code error;
  return std::filesystem::is_regular_file(name, error);
}

bool is_folder(const std::filesystem::path& name) {
  std::error_code error;
  return std::filesystem::is_directory(name, error);
}

}  // namespace touchstone
