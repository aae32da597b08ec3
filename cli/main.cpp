#include <cstdio>
#include <exception>
#include <filesystem>
#include <fmt/format.h>
#include <sstream>
#include <string>

#include <CLI/CLI.hpp>

#include "cli/commands.hpp"
#include "cli/completion.hpp"
#include "cli/help.hpp"
#include "cli/manual.hpp"
#include "cli/options.hpp"
#include "cli/standard_streams.hpp"
#include "cli/version.hpp"
#include "properties/files/error_text.hpp"
#include "reference/invalid_input.hpp"

namespace {

constexpr int bad_input = 2;
constexpr int unwritten_output = 2;
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

/// --help and --version are errors to CLI11. The others' messages repeat what was given.
int tell(const CLI::App& program, const CLI::ParseError& error) {
  std::ostringstream out, message;
  const int code = program.exit(error, out, message);
  std::fputs(out.str().c_str(), stdout);
  if (code == 0) return 0;
  constexpr std::size_t max_message = 400;
  std::istringstream lines(message.str());
  for (std::string line; std::getline(lines, line);) {
    touchstone::complain(touchstone::printable(line, max_message));
  }
  return bad_input;
}

/// What packages are made with, and whoever installs none.
void add_descriptions(CLI::App& program) {
  program.add_flag_callback(
      "--manual",
      [&program] {
        fmt::print("{}", touchstone::manual(program));
        throw CLI::Success();
      },
      "Print the manual page in troff, as for man -l -");
  program
      .add_option_function<std::string>(
          "--completion",
          [&program](const std::string& shell) {
            if (shell != "bash" && shell != "zsh") {
              throw touchstone::InvalidInput("--completion", '"' + shell + '"',
                                             "must be bash or zsh");
            }
            fmt::print("{}", shell == "bash" ? touchstone::bash_completion(program)
                                             : touchstone::zsh_completion(program));
            throw CLI::Success();
          },
          "Print what bash or zsh completes this program with")
      ->type_name("SHELL");
}

/// Parses, runs what was asked for, and tells failures.
int run(int argc, char** argv) {
  CLI::App program(
      "Touchstone: verification and validation of cylinder contacts.\n"
      "Scores contact routines against an exact oracle.",
      "touchstone");
  program.set_version_flag("--version", touchstone::version_text);
  add_descriptions(program);
  program.require_subcommand(1);
  program.formatter(touchstone::help_format());
  program.footer(
      "Examples:\n"
      "  touchstone report                               the report: out/report.html\n"
      "  touchstone replay cylinder-box/rim-face/1/0     one configuration again\n"
      "  touchstone solve poses.jsonl                    your own configurations\n"
      "  touchstone certify cylinder-box/rim-face/1/17   a proof that others can check\n"
      "  touchstone check --candidate bullet             laws, smallest failures\n"
      "  touchstone campaign --count 1e6 --out run       any number, on many machines\n"
      "  touchstone simulate rolling                     contacts against paper\n"
      "  touchstone choose simulation/scenes/log-pile.json  the cheapest model that serves\n"
      "  touchstone stability                            tiny steps, slow motions\n"
      "  touchstone compare old.json out/report.json     better, worse, slower\n"
      "Exit codes:\n"
      "  0    done\n"
      "  1    a law was broken, a result is worse, or needs are not met\n"
      "  2    bad input or usage, or output that could not be written\n"
      "  3    an internal contradiction\n"
      "  130  interrupted");
  program.fallthrough();  // --candidate may also stand after the subcommand
  touchstone::add_plugin_option(program);
  int exit_code = 0;
  touchstone::add_report(program, exit_code);
  touchstone::add_replay(program, exit_code);
  touchstone::add_solve(program, exit_code);
  touchstone::add_certify(program, exit_code);
  touchstone::add_check(program, exit_code);
  touchstone::add_compare(program, exit_code);
  touchstone::add_campaign(program, exit_code);
  touchstone::add_merge(program, exit_code);
  touchstone::add_simulate(program, exit_code);
  touchstone::add_choose(program, exit_code);
  touchstone::add_search(program, exit_code);
  touchstone::add_render(program, exit_code);
  touchstone::add_stability(program, exit_code);
  touchstone::add_candidates(program, exit_code);
  try {
    refuse_unknown_subcommand(program, argc, argv);
    program.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return tell(program, e);
  } catch (const touchstone::InvalidInput& e) {
    touchstone::complain("error: " + touchstone::error_text(e));
    return bad_input;
  } catch (const std::filesystem::filesystem_error& e) {
    // Of a name that is too long, a folder that may not be read, a link to itself.
    touchstone::complain("error: " +
                         touchstone::error_text({"path", e.path1(), e.code().message()}));
    return bad_input;
  } catch (const std::exception& e) {
    if (std::ferror(stdout) != 0) return unwritten_output;  // main tells it
    touchstone::complain(std::string("internal error: ") + e.what());
    return contradiction;
  }
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  touchstone::open_closed_streams();
  const int code = run(argc, argv);
  if (touchstone::standard_output_is_written()) return code;
  return code == contradiction ? code : unwritten_output;
}
