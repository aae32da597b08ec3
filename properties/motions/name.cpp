#include "properties/motions/name.hpp"

#include <charconv>
#include <fmt/format.h>
#include <vector>

#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

constexpr int most_steps = 1 << 20;

std::vector<std::string_view> parts_of(std::string_view text) {
  std::vector<std::string_view> parts;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find('/', start), text.size());
    parts.push_back(text.substr(start, end - start));
    start = end + 1;
  }
  return parts;
}

int number(const char* field, std::string_view text, int least, int most) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < least || value > most) {
    throw InvalidInput(field, fmt::format("\"{}\"", text),
                       fmt::format("must be a whole number from {} to {}", least, most));
  }
  return value;
}

void require_count(const char* field, const std::string& text,
                   const std::vector<std::string_view>& parts, std::size_t count,
                   const char* remedy) {
  if (parts.size() != count) throw InvalidInput(field, '"' + text + '"', remedy);
}

}  // namespace

std::string pixel_name(const CriticalPose& pose, Decade zoom, int column, int row) {
  return fmt::format("map/{}/{}/{}/{}", pose.name, zoom.name(), column, row);
}

std::string step_name(const Motion& motion, int step, int steps) {
  return fmt::format("sequence/{}/{}/{}", motion.name, step, steps);
}

std::string perturbed_name(const std::string& base, const Perturbation& perturbation) {
  return base + "@" + to_string(perturbation);
}

std::optional<Subject> named_configuration(const std::string& text) {
  const auto parts = parts_of(text);
  if (parts[0] == "map") {
    require_count("map", text, parts, 5,
                  "must read map/pose/zoom/column/row, as in map/standing/1e-12/-3/16");
    const CriticalPose& pose = find_critical_pose(parts[1]);
    return Subject{text, pose.description,
                   map_pixel(pose, Decade::parse("map.zoom", parts[2]),
                             number("map.column", parts[3], -map_reach, map_reach),
                             number("map.row", parts[4], -map_reach, map_reach))};
  }
  if (parts[0] == "sequence") {
    require_count("sequence", text, parts, 4,
                  "must read sequence/motion/step/steps, as in sequence/roll-over-edge/113/200");
    const Motion& motion = find_motion(parts[1]);
    const int steps = number("sequence.steps", parts[3], 1, most_steps);
    const int step = number("sequence.step", parts[2], 0, steps);
    return Subject{text, motion.description, pose_at(motion, step, steps)};
  }
  return std::nullopt;
}

}  // namespace touchstone
