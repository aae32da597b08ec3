#include "candidates/candidates.hpp"

#include <fmt/format.h>
#include <string>
#include <string_view>

#include "candidates/npm_engines.hpp"
#include "cli/command.hpp"

namespace touchstone {
namespace {

/// The shapes that it has a routine for, against a cylinder.
std::string other_shapes(const Candidate& candidate) {
  constexpr std::string_view before = "cylinder-";  // of a pair's name
  std::string text;
  for (const Pair pair : all_pairs) {
    if (!candidate.has_routine_for(pair)) continue;
    text += (text.empty() ? "" : ", ") + std::string(pair_name(pair)).substr(before.size());
  }
  return text;
}

void print(const Candidate& c) {
  fmt::print("{} {}\n  cylinder against {}\n  {}\n", c.name, c.version, other_shapes(c),
             c.settings);
  if (!c.models.empty()) fmt::print("  models {}\n", c.models);
  if (c.parameter) {
    fmt::print("  {}:N with N the {}, {} to {}\n", c.family, c.parameter->meaning, c.parameter->min,
               c.parameter->max);
  }
}

}  // namespace

void add_candidates(Program& program) {
  Command command = program.command("candidates", "List the contact routines there are");
  command.footer(
      "Examples:\n"
      "  touchstone candidates\n"
      "  touchstone --load ./my_engine.so candidates\n"
      "  touchstone report --candidates reference,bullet,prism:8,16\n"
      "A family with a parameter is named with its number, as prism:16; what is skipped\n"
      "or unavailable says why.");
  command.runs([] {
    for (const Candidate* c : all_candidates()) print(*c);
    for (const Skipped& s : skipped_plugins()) fmt::print("{}: skipped; {}\n", s.name, s.reason);
    fmt::print(
        "In single precision, or with Touchstone's contacts installed, when one is named:\n");
    for (const std::string& name : named_candidates()) fmt::print("  {}\n", name);
    fmt::print("From npm, when one is named:\n");
    for (const NpmEngine& engine : npm_engines()) {
      const std::string obstacle = npm_obstacle(engine);
      fmt::print("  {}{}\n", engine.family, obstacle.empty() ? "" : ": unavailable; " + obstacle);
    }
    return 0;
  });
}

}  // namespace touchstone
