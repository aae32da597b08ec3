#pragma once

#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <stdexcept>
#include <string>
#include <unistd.h>

#include "reference/invalid_input.hpp"
#include "simulation/scenes/robot_file.hpp"

// What tests of the files of robots have in common.

namespace touchstone {

inline const std::filesystem::path scenes = TOUCHSTONE_SCENES;

inline const LinkShape& named(const RobotFile& file, const std::string& name) {
  for (const Link& link : file.links) {
    for (const LinkShape& s : link.shapes) {
      if (s.name == name) return s;
    }
  }
  throw std::runtime_error("no shape " + name);
}
template <class List>
const auto& by_name(const List& list, const std::string& name) {
  for (const auto& entry : list) {
    if (entry.name == name) return entry;
  }
  throw std::runtime_error("nothing is called " + name);
}
inline std::size_t shape_count(const RobotFile& file) {
  std::size_t count = 0;
  for (const Link& link : file.links) count += link.shapes.size();
  return count;
}

/// A file of this test's own.
struct Written {
  Written(const std::string& name, const std::string& text)
      : path(std::filesystem::temp_directory_path() / (std::to_string(getpid()) + '-' + name)) {
    std::ofstream(path) << text;
  }
  ~Written() { std::filesystem::remove(path); }
  std::filesystem::path path;
};

inline RobotFile robot_of(const std::string& name, const std::string& text) {
  return read_robot(Written(name, text).path);
}

/// Why a file of this content is refused, or that it is accepted.
inline std::string refusal_of(const std::string& name, const std::string& text) {
  const Written file(name, text);
  try {
    return fmt::format("accepted with {} shapes", shape_count(read_robot(file.path)));
  } catch (const InvalidInput& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr(file.path.string()));
    return e.what();
  }
}

}  // namespace touchstone
