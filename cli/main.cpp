#include <exception>
#include <fmt/format.h>
#include <stdexcept>

#include <CLI/CLI.hpp>

#include "cli/commands.hpp"
#include "reference/invalid_input.hpp"

namespace {

constexpr int bad_input = 2;
constexpr int contradiction = 3;

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
      "  touchstone replay cylinder-box/rim-face/1/17        one configuration again\n"
      "  touchstone solve poses.jsonl                        your own configurations\n"
      "Exit codes: 0 done; 2 bad input or usage; 3 an internal contradiction.");
  int exit_code = 0;
  touchstone::add_report(program, exit_code);
  touchstone::add_replay(program, exit_code);
  touchstone::add_solve(program, exit_code);
  touchstone::add_candidates(program, exit_code);
  try {
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
