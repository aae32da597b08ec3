#include <cstdio>
#include <exception>
#include <filesystem>
#include <fmt/format.h>
#include <set>
#include <string>

#include "candidates/candidates.hpp"
#include "candidates/host/interruption.hpp"
#include "cli/command.hpp"
#include "oracle/truth.hpp"
#include "properties/files/given_text.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

constexpr int unwritten_output = 2;
constexpr int contradiction = 3;

/// Versions of the engines: of the first candidate of each plug-in that is not our own.
std::string engines() {
  std::set<std::string> seen;
  std::string text;
  for (const Candidate* c : all_candidates()) {
    const std::string from = c->plugin() ? c->plugin()->file.string() : c->command()->line;
    if (c->version == TOUCHSTONE_VERSION || !seen.insert(from).second) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", c->family, c->version);
  }
  for (const Skipped& s : skipped_plugins()) {
    text += fmt::format("{}no {}", text.empty() ? "" : ", ", s.name);
  }
  return text;
}

std::string version_text() {
  return fmt::format("touchstone {}\nengines: {}\nlibraries: {}", TOUCHSTONE_VERSION, engines(),
                     fmt::join(oracle::libraries(), ", "));
}

/// Parses, runs what was asked for, and tells failures.
int run_program(int argc, char** argv) {
  Program program("touchstone",
                  "Touchstone: verification and validation of cylinder contacts.\n"
                  "Scores contact routines against an exact oracle.");
  program.version(version_text);
  program.footer(
      "Examples:\n"
      "  touchstone report                               the report: out/report.html\n"
      "  touchstone replay cylinder-box/rim-face/1/0     one configuration again\n"
      "  touchstone solve poses.jsonl                    your own configurations\n"
      "  touchstone check --candidate bullet             laws, smallest failures\n"
      "  touchstone campaign --count 1e6 --out run       any number, on many machines\n"
      "  touchstone simulate rolling                     contacts against paper\n"
      "  touchstone choose scene.json                    the cheapest model that serves\n"
      "  touchstone stability                            tiny steps, slow motions\n"
      "  touchstone compare old.json out/report.json     better, worse, slower\n"
      "  touchstone list candidates                      engines, models, our routines\n"
      "In a clone, ./touchstone test builds and runs all tests, and ./touchstone python\n"
      "starts Python with the module touchstone.\n"
      "docs/, oracle/ and simulation/scenes/ are folders of a clone; what is installed of them "
      "lies in "
      "share/doc/touchstone and share/touchstone.\n"
      "Exit codes:\n" +
      list_entry("0", 3, "done") +
      list_entry("1", 3, "a law was broken, a result is worse, or needs are not met") +
      list_entry("2", 3, "bad input or usage, or output that could not be written") +
      list_entry(
          "3", 3,
          "an internal contradiction, or another failure that is not the input's: no process "
          "or memory to be had, a worker killed") +
      list_entry("130", 3, "interrupted by Ctrl-C; 143 by SIGTERM, 129 by SIGHUP"));
  program.repeated(
      "--load", "FILE", [](const std::string& file) { add_file(file); },
      "A plug-in with candidates of your own, or a list of commands (.txt); may be repeated");
  program.repeated(
      "--candidate-command", "COMMAND", [](const std::string& command) { add_command(command); },
      "A command that is a candidate (docs/engine.md); may be repeated");
  add_report(program);
  add_replay(program);
  add_solve(program);
  add_check(program);
  add_compare(program);
  add_campaign(program);
  add_simulate(program);
  add_choose(program);
  add_export(program);
  add_score(program);
  add_stability(program);
  add_list(program);
  try {
    return program.run(argc, argv);
  } catch (const InvalidInput& e) {
    complain("error: " + error_text(e));
    return bad_input;
  } catch (const std::filesystem::filesystem_error& e) {
    // A name that is too long, a folder that may not be read, a link to itself.
    complain("error: " + error_text({"path", e.path1(), e.code().message()}));
    return bad_input;
  } catch (const std::exception& e) {
    if (std::ferror(stdout) != 0) return unwritten_output;  // main tells it
    complain(std::string("internal error: ") + e.what());
    return contradiction;
  }
}

}  // namespace
}  // namespace touchstone

int main(int argc, char** argv) {
  touchstone::open_closed_streams();
  touchstone::say_when_interrupted();
  const int code = touchstone::run_program(argc, argv);
  if (touchstone::standard_output_is_written()) return code;
  return code == touchstone::contradiction ? code : touchstone::unwritten_output;
}
