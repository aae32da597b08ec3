#include "candidates/candidates.hpp"

#include <fmt/format.h>
#include <string>

#include "cli/commands.hpp"

namespace touchstone {
namespace {

std::string supported_pairs(const ts_candidate& candidate) {
  constexpr const char* names[] = {"cylinder", "plane", "sphere", "capsule", "box"};
  std::string text;
  for (const ts_shape_kind kind : {TS_PLANE, TS_SPHERE, TS_CAPSULE, TS_CYLINDER, TS_BOX}) {
    if (candidate.supports(kind)) text += (text.empty() ? "" : ", ") + std::string(names[kind]);
  }
  return text;
}

}  // namespace

void add_candidates(CLI::App& program, int&) {
  CLI::App* command = program.add_subcommand("candidates", "List the contact routines there are");
  command->callback([] {
    for (const ts_candidate* c : all_candidates()) {
      fmt::print("{} {}\n  cylinder against {}\n  {}\n", c->name, c->version, supported_pairs(*c),
                 c->settings);
    }
  });
}

}  // namespace touchstone
