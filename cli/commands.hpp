#pragma once

#include <CLI/CLI.hpp>

namespace touchstone {

// One file each. A subcommand adds itself to the program; when it was given it runs in a callback
// and leaves its exit code in `exit_code`.

void add_report(CLI::App& program, int& exit_code);
void add_replay(CLI::App& program, int& exit_code);
void add_solve(CLI::App& program, int& exit_code);
void add_certify(CLI::App& program, int& exit_code);
void add_check(CLI::App& program, int& exit_code);
void add_compare(CLI::App& program, int& exit_code);
void add_campaign(CLI::App& program, int& exit_code);
void add_merge(CLI::App& program, int& exit_code);
void add_simulate(CLI::App& program, int& exit_code);
void add_choose(CLI::App& program, int& exit_code);
void add_search(CLI::App& program, int& exit_code);
void add_render(CLI::App& program, int& exit_code);
void add_stability(CLI::App& program, int& exit_code);
void add_candidates(CLI::App& program, int& exit_code);

}  // namespace touchstone
