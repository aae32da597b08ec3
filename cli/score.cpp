#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <iostream>
#include <memory>

#include "candidates/host/interruption.hpp"
#include "cli/command.hpp"
#include "cli/options.hpp"
#include "properties/files/disk.hpp"
#include "reference/invalid_input.hpp"
#include "reports/replay.hpp"
#include "reports/report_json.hpp"
#include "reports/terminal.hpp"
#include "reports/test_data/given_answers.hpp"
#include "reports/test_data/test_data.hpp"

namespace touchstone {
namespace {

struct ScoreArguments {
  explicit ScoreArguments(Command& command) : bar(command), workers(command) {}
  BarOption bar;
  WorkersOption workers;
  std::string file, configurations, out = "out", name, version, settings;
  bool suite = false, has_details = false;

  std::string file_name() const { return file == "-" ? "standard input" : file; }

  std::string command_line() const {
    std::string line = program_name() + " score " + shell_quoted(file);
    if (!configurations.empty()) line += " --configurations " + shell_quoted(configurations);
    if (suite) line += " --suite";
    for (const auto& [option, value] :
         {std::pair("--name", name), std::pair("--of-version", version),
          std::pair("--settings", settings)}) {
      if (!value.empty()) line += fmt::format(" {} {}", option, shell_quoted(value));
    }
    return line + bar.command_line();
  }
};

/// What `read` makes of a file, whose name its errors have.
template <class Read>
auto named_in_errors(const std::string& file, Read read) {
  try {
    return read();
  } catch (const InvalidInput& e) {
    const bool is_in_file = !e.field().starts_with("--");
    throw InvalidInput((is_in_file ? file + ": " : "") + e.field(), e.value(), e.remedy());
  }
}

ReadAnswers read(const ScoreArguments& options) {
  const auto given = [](const std::string& text) {
    return text.empty() ? std::nullopt : std::optional(text);
  };
  const GivenDescription description{given(options.name), given(options.version),
                                     given(options.settings)};
  ConfigurationFile configurations;
  Wanted wanted;
  if (!options.configurations.empty()) {
    std::ifstream in = opened(options.configurations, "--configurations");
    configurations = named_in_errors(options.configurations, [&] { return ConfigurationFile(in); });
    wanted.file = &configurations;
  }
  if (options.suite) wanted.identities = identities(suite_1());
  const auto answers = [&](std::istream& in) {
    return named_in_errors(options.file_name(),
                           [&] { return read_answers(in, description, wanted); });
  };
  if (options.file == "-") return answers(std::cin);
  std::ifstream in = opened(options.file, "file");
  return answers(in);
}

void tell(const std::vector<AnswerError>& errors, const std::string& file) {
  constexpr std::size_t max_told = 20;
  for (std::size_t i = 0; i < std::min(errors.size(), max_told); ++i) {
    const std::string where =
        errors[i].line > 0 ? fmt::format("line {}: ", errors[i].line) : std::string();
    complain("error: " + file + ": " + where + errors[i].error);
  }
  if (errors.size() > max_told) complain(fmt::format("and {} more", errors.size() - max_told));
}

/// Bad lines make exit code 2, after all others are scored.
int run_score(const ScoreArguments& options) {
  const OutputFolder out(options.out);
  const ReadAnswers read_ones = read(options);
  tell(read_ones.errors, options.file_name());
  if (read_ones.count == 0) {
    throw InvalidInput("file", '"' + options.file + '"',
                       "must have a line that is an answer, as {\"id\": "
                       "\"cylinder-box/rim-face/1/0\", \"status\": \"none\"}; docs/your-poses.md "
                       "says more");
  }
  const Interruption interruption;
  const Report report = report_of(read_ones.answers, read_ones.seed, options.bar.get(),
                                  options.workers.get(), options.command_line());
  if (report.results.empty()) {
    complain("Interrupted before any pose class was done: there is no report.");
    return interrupted_exit_code();
  }
  const auto text = options.has_details ? terminal_details : terminal_table;
  write_then_print([&] { write_report(report, options.out); },
                   fmt::format("{}\n{}, truth certified to 1e-30 of the larger size, {:.0f} s.\n",
                               text(report, standard_output()),
                               counted(report.configurations, "answer"), report.wall_seconds));
  print(fmt::format("Report: {}/report.html, {}/report.json\n", options.out, options.out));
  if (report.partial) return interrupted_exit_code();
  return read_ones.errors.empty() ? 0 : bad_input;
}

}  // namespace

void add_score(Program& program) {
  Command command = program.command("score", "Score answers that were computed elsewhere");
  const auto options = std::make_shared<ScoreArguments>(command);
  command.text("file", "FILE", options->file, "JSON Lines; - is standard input").required();
  command.text("--configurations", "FILE", options->configurations,
               "What the ids mean that are no identities: a file as for solve");
  command.flag("--suite", options->suite, "All of touchstone-suite-1 has to be answered");
  command.text("--name", "TEXT", options->name,
               "Whose answers these are, unless the first line says it");
  command.text("--of-version", "TEXT", options->version, "Its version").group("");
  command.text("--settings", "TEXT", options->settings, "How it was called");
  command.text("--out", "FOLDER", options->out, "Folder for report.json and report.html");
  command.flag("--details", options->has_details, details_help);
  command.footer(
      "Examples:\n"
      "  touchstone score answers.jsonl\n"
      "  touchstone score answers.jsonl --suite --name my-gpu\n"
      "  touchstone score answers.jsonl --configurations poses.jsonl --name mine\n"
      "An answer: {\"id\": \"cylinder-box/rim-face/1/0\", \"status\": \"contact\",\n"
      "\"signed_distance\": -0.1, \"normal\": [0, 0, 1],\n"
      "\"points\": [{\"position\": [0, 0, 0], \"depth\": 0.1}]}, or\n"
      "{\"id\": …, \"status\": \"none\"}; docs/your-poses.md says more.\n"
      "Exit code 2: a line was bad, or an answer is missing; the others are scored.");
  command.runs([options] { return run_score(*options); });
}

}  // namespace touchstone
