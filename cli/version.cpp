#include "cli/version.hpp"

#include <filesystem>
#include <fmt/format.h>
#include <set>

#include "candidates/candidates.hpp"
#include "oracle/truth.hpp"

namespace touchstone {
namespace {

/// Of the first candidate of each plug-in that is not our own.
std::string engines() {
  std::set<std::filesystem::path> seen;
  std::string text;
  for (const Candidate* c : all_candidates()) {
    if (c->version == TOUCHSTONE_VERSION || !seen.insert(c->plugin).second) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", c->family, c->version);
  }
  for (const Skipped& s : skipped_plugins()) {
    text += fmt::format("{}no {}", text.empty() ? "" : ", ", s.name);
  }
  return text;
}

}  // namespace

std::string version_text() {
  return fmt::format("touchstone {}\nengines: {}\nlibraries: {}", TOUCHSTONE_VERSION, engines(),
                     fmt::join(oracle::libraries(), ", "));
}

}  // namespace touchstone
