#include "simulation/scenes/robot_file.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <stdexcept>
#include <sys/mman.h>
#include <unistd.h>

#include "candidates/candidates.hpp"
#include "candidates/host/contained.hpp"
#include "candidates/host/guard.hpp"
#include "properties/files/bytes.hpp"
#include "reference/invalid_input.hpp"
#include "simulation/scenes/library_log.hpp"
#include "simulation/scenes/robot_readers.hpp"

namespace touchstone {
namespace {

/// Loads the module; for a contained process only.
ReadRobot* load_reader(const std::filesystem::path& reader) {
  void* const module = dlopen(reader.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* const entry = module ? dlsym(module, robots_entry) : nullptr;
  if (!entry) throw std::runtime_error(dlerror());
  return reinterpret_cast<ReadRobot* (*)()>(entry)();
}

}  // namespace

bool is_robot_file(const std::filesystem::path& file) {
  const auto ending = file.extension();
  for (const char* known : {".urdf", ".sdf", ".world", ".mjcf", ".xml", ".xacro"}) {
    if (ending == known) return true;
  }
  return false;
}

RobotFile read_robot(const std::filesystem::path& file, const Folders& folders) {
  const std::filesystem::path reader = standard_folder() / "touchstone-robots.so";
  if (!exists(reader)) {
    throw InvalidInput("scene", '"' + file.string() + '"',
                       "needs " + reader.string() + ": ninja plugin_robots builds it");
  }
  const int log = memfd_create("library-log", MFD_CLOEXEC);
  if (log < 0) fail("memfd_create");
  constexpr double max_seconds = 20;
  const Contained read =
      run_contained([&] { return load_reader(reader)(file, folders, log); }, max_seconds);
  const std::string complaint = complaint_in(log);
  close(log);
  if (read.end != Contained::End::returned) {
    throw InvalidInput("scene", '"' + file.string() + '"',
                       "must be a file that its reader survives: " + read.text +
                           (complaint.empty() ? "" : "; it says: " + complaint));
  }
  BytesIn in(read.text);
  if (!in.next<bool>()) {
    std::string field, value, remedy;
    in(field, value, remedy);
    if (field != "scene" && !field.starts_with(file.string()))
      field.insert(0, file.string() + ": ");
    throw InvalidInput(field, value, remedy);
  }
  return in.next<RobotFile>();
}

std::string left_out_text(const RobotFile& robot) {
  const LeftOut& left = robot.left_out;
  if (left.shapes == 0) return "";
  std::size_t count = left.shapes;
  double volume = left.volume;
  for (const Link& link : robot.links) {
    count += link.shapes.size();
    for (const LinkShape& s : link.shapes) volume += inertia(s.shape, 1).inertia.mass;
  }
  const std::string share = left.unknown > 0 || !(volume > 0)
                                ? std::string("volume unknown")
                                : fmt::format("{:.2g}% of the volume", 100 * left.volume / volume);
  return fmt::format("left out: {} of {} collision shapes ({})", left.shapes, count, share);
}

}  // namespace touchstone
