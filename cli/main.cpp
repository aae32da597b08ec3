#include <exception>
#include <fmt/format.h>
#include <string>

#include <CLI/CLI.hpp>

#include "cli/commands.hpp"
#include "cli/options.hpp"
#include "reference/invalid_input.hpp"

namespace {

constexpr int bad_input = 2;
constexpr int contradiction = 3;

/// CLI11 would only say that a subcommand is required.
void refuse_unknown_subcommand(const CLI::App& program, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::string names;
  for (const CLI::App* command : program.get_subcommands({})) {
    if (command->get_name() == argv[1]) return;
    names += (names.empty() ? "" : ", ") + command->get_name();
  }
  throw touchstone::InvalidInput("subcommand", '"' + std::string(argv[1]) + '"',
                                 "must be one of " + names);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program(
      "Touchstone: verification and validation of cylinder contacts.\n"
      "Scores contact routines against an exact oracle.",
      "touchstone");
  program.set_version_flag("--version", "touchstone " TOUCHSTONE_VERSION);
  program.require_subcommand(1);
  program.footer(
      "Examples:\n"
      "  touchstone report                                   the report: out/report.html\n"
      "  touchstone replay cylinder-box/rim-face/1/0         one configuration again\n"
      "  touchstone solve poses.jsonl                        your own configurations\n"
      "  touchstone certify cylinder-box/rim-face/1/17       a proof that others can check\n"
      "  touchstone check --candidate bullet                 laws, and the smallest failures\n"
      "Exit codes: 0 done; 1 a law was broken; 2 bad input or usage; 3 an internal contradiction.");
  program.fallthrough();  // --candidate may also stand after the subcommand
  touchstone::add_plugin_option(program);
  int exit_code = 0;
  touchstone::add_report(program, exit_code);
  touchstone::add_replay(program, exit_code);
  touchstone::add_solve(program, exit_code);
  touchstone::add_certify(program, exit_code);
  touchstone::add_check(program, exit_code);
  touchstone::add_campaign(program, exit_code);
  touchstone::add_merge(program, exit_code);
  touchstone::add_candidates(program, exit_code);
  try {
    refuse_unknown_subcommand(program, argc, argv);
    program.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    // Zero for --help and --version.
    return program.exit(e) == 0 ? 0 : bad_input;
  } catch (const touchstone::InvalidInput& e) {
    fmt::print(stderr, "error: {}\n", e.what());
    return bad_input;
  } catch (const std::exception& e) {
    fmt::print(stderr, "internal error: {}\n", e.what());
    return contradiction;
  }
  return exit_code;
}
