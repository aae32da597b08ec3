#include "candidates/candidates.hpp"

#include <fmt/format.h>
#include <string>

#include "cli/subcommands.hpp"

namespace touchstone {
namespace {

std::string supported_pairs(const Candidate& candidate) {
  constexpr const char* names[] = {"cylinder", "plane", "sphere", "capsule", "box"};
  std::string text;
  for (const ts_shape_kind kind : {TS_PLANE, TS_SPHERE, TS_CAPSULE, TS_CYLINDER, TS_BOX}) {
    if (candidate.supports[kind]) text += (text.empty() ? "" : ", ") + std::string(names[kind]);
  }
  return text;
}

void print(const Candidate& c) {
  fmt::print("{} {}\n  cylinder against {}\n  {}\n", c.name, c.version, supported_pairs(c),
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
  command.runs([] {
    for (const Candidate* c : all_candidates()) print(*c);
    for (const Skipped& s : skipped_plugins()) fmt::print("{}: skipped; {}\n", s.name, s.reason);
    return 0;
  });
}

}  // namespace touchstone
