#pragma once

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <sys/wait.h>

// What tests do with files and commands.

namespace touchstone {

/// A folder of a test's own, gone with it.
class OwnFolder {
 public:
  OwnFolder() {
    std::string name = std::filesystem::temp_directory_path() / "touchstone-test-XXXXXX";
    EXPECT_NE(mkdtemp(name.data()), nullptr);
    path = name;
  }
  ~OwnFolder() { std::filesystem::remove_all(path); }
  OwnFolder(const OwnFolder&) = delete;
  OwnFolder& operator=(const OwnFolder&) = delete;

  /// Writes a file, and makes its folder.
  std::filesystem::path with(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((path / name).parent_path());
    std::ofstream(path / name, std::ios::binary) << text;
    return path / name;
  }

  std::filesystem::path path;
};

/// What a command prints. Its exit code must be one from 0 to `max_exit_code`.
inline std::string printed_by(const std::string& command, int max_exit_code = 0) {
  FILE* const pipe = popen(command.c_str(), "r");
  std::string text, block(1 << 16, '\0');
  for (std::size_t n; (n = std::fread(block.data(), 1, block.size(), pipe)) > 0;) {
    text.append(block, 0, n);
  }
  const int status = pclose(pipe);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) <= max_exit_code) << command;
  return text;
}

}  // namespace touchstone
