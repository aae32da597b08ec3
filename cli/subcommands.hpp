#pragma once

#include "cli/command.hpp"

namespace touchstone {

// One file each. A subcommand adds itself to the program.

void add_report(Program& program);
void add_replay(Program& program);
void add_solve(Program& program);
void add_certify(Program& program);
void add_check(Program& program);
void add_compare(Program& program);
void add_campaign(Program& program);
void add_merge(Program& program);
void add_simulate(Program& program);
void add_choose(Program& program);
void add_search(Program& program);
void add_render(Program& program);
void add_stability(Program& program);
void add_candidates(Program& program);
void add_classes(Program& program);

}  // namespace touchstone
