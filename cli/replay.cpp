#include "reports/replay.hpp"

#include <fmt/format.h>
#include <memory>
#include <optional>

#include "cli/command.hpp"
#include "cli/options.hpp"
#include "properties/files/configuration_json.hpp"
#include "properties/files/disk.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

struct ReplayArguments {
  explicit ReplayArguments(Command& command) : candidates(command), bar(command) {}
  CandidateOption candidates;
  BarOption bar;
  std::string input, id, engine, language;
  bool json = false;
  std::string html;
};

int run_replay(const ReplayArguments& options, bool emits) {
  if (!emits && !options.language.empty()) {
    throw InvalidInput("--language", options.language, "must stand beside --emit");
  }
  const Bar bar = options.bar.get();
  const Subject given = given_configuration(
      options.input, options.id.empty() ? std::nullopt : std::optional(options.id));
  if (emits) {
    const std::string asked = given.name + (given.id.empty() ? "" : ", id " + given.id);
    print(reproducer(options.engine, options.language, given.configuration, asked, bar,
                     options.candidates.limits()));
    return 0;
  }
  refuse_to_replace(options.input, options.html, "--html");
  if (!options.html.empty()) check_file_writable(options.html, "--html");
  auto candidates = start(options.candidates.get(), bar.threshold, options.candidates.limits());
  const Examination shown = examine(given, pointers(candidates), bar, 1e-30);
  if (!options.html.empty()) {
    write_file(options.html, replay_page(shown, given.description), "--html");
  }
  print(options.json ? replay_json(shown)
                     : replay_text(shown, given.description, options.candidates.are_named(),
                                   standard_output()));
  return 0;
}

}  // namespace

void add_replay(Program& program) {
  Command command = program.command("replay", "Show one configuration again: truth and answers");
  const auto options = std::make_shared<ReplayArguments>(command);
  command.text("input", options->input, given_help).value("IDENTITY").required();
  command.text("--id", options->id, "The configuration of this id, of a file with several lines")
      .value("ID");
  const Option json = command.flag("--json", options->json, "Print one JSON object");
  Option emit =
      command
          .text("--emit", options->engine,
                fmt::format("Write a program that asks this engine alone: {}; or a candidate's "
                            "plug-in or command",
                            fmt::join(reproducer_engines(), ", ")))
          .value("CANDIDATE");
  command
      .text("--language", options->language,
            "Language of that program, where there are several: c++, javascript, python")
      .value("LANGUAGE");
  const Option html = command
                          .text("--html", options->html,
                                "Write a page too: both bodies in 3-D, a slice, and all numbers")
                          .value("FILE");
  emit.excludes(json).excludes(html);
  command.footer(
      "Examples:\n"
      "  touchstone replay cylinder-box/parallel+tilted-1e-6/42/137\n"
      "  touchstone replay cylinder-cylinder/rim-rim/1/0 --candidates bullet --json\n"
      "  touchstone replay cylinder-box/rim-face/1/0 --emit bullet > reproducer.cpp\n"
      "  touchstone replay cylinder-box/rim-face/1/0 --emit jolt > reproducer.mjs\n"
      "  touchstone replay cylinder-box/rim-face/1/0 --html page.html\n"
      "  touchstone replay poses.jsonl --id c1\n"
      "  touchstone replay failures/ode-cylinder-box-agreement-missed.json --emit ode");
  command.runs([options, emit] { return run_replay(*options, emit.is_given()); });
}

}  // namespace touchstone
