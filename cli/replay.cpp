#include "reports/replay.hpp"

#include <fmt/format.h>
#include <memory>
#include <optional>

#include "cli/command.hpp"
#include "cli/options.hpp"
#include "properties/files/configuration_json.hpp"
#include "properties/files/disk.hpp"
#include "reports/solve.hpp"

namespace touchstone {
namespace {

struct ReplayArguments {
  explicit ReplayArguments(Command& command) : candidates(command), bar(command) {}
  CandidateOption candidates;
  BarOption bar;
  std::string input, id, engine, language;
  bool json = false, certifies = false;
  std::string html;
  double width = 1e-30;
  std::uint64_t cells = 4000;
};

std::string certificate_of(const Subject& given, const ReplayArguments& options) {
  const Configuration& c = given.configuration;
  if (!given.sweep) {
    const audit::Budget budget{options.width, static_cast<int>(options.cells)};
    return certificate_json(audit::certify(c, budget), c);
  }
  return certificate_json(audit::certify_cast(c, *given.sweep), c, *given.sweep);
}

/// Of a cast. Throws InvalidInput if A turns, too, which no engine is asked.
std::optional<Vec3> asked_sweep(const Subject& given) {
  if (!given.sweep) return std::nullopt;
  if (given.sweep->turns()) {
    throw InvalidInput("spin", "given", "must be left out: --emit knows no turns");
  }
  return given.sweep->translation();
}

int run_replay(const ReplayArguments& options, bool emits) {
  const Bar bar = options.bar.get();
  const Subject given = given_configuration(
      options.input, options.id.empty() ? std::nullopt : std::optional(options.id));
  if (options.certifies) {
    print(certificate_of(given, options) + '\n');
    return 0;
  }
  if (emits) {
    const std::string asked = given.name + (given.id.empty() ? "" : ", id " + given.id);
    print(reproducer(options.engine, options.language, given.configuration, asked_sweep(given),
                     asked, bar, options.candidates.limits()));
    return 0;
  }
  refuse_to_replace(options.input, options.html, "--html");
  if (!options.html.empty()) check_file_writable(options.html, "--html");
  auto candidates = start(options.candidates.get(), bar.threshold, options.candidates.limits());
  const Examination shown = examine(given, pointers(candidates), bar, 1e-30);
  std::optional<CastExamination> cast;
  if (given.sweep) {
    cast = examine_cast(given.configuration, *given.sweep, options.candidates.get(), bar);
  }
  if (!options.html.empty()) {
    write_file(options.html, replay_page(shown, given.description, cast), "--html");
  }
  if (options.json) {
    print(replay_json(shown, cast));
  } else {
    print(replay_text(shown, given.description, options.candidates.are_named(), standard_output()) +
          (cast ? '\n' + cast_text(*cast, standard_output()) : ""));
  }
  return 0;
}

}  // namespace

void add_replay(Program& program) {
  Command command = program.command("replay", "Show one configuration again: truth and answers");
  const auto options = std::make_shared<ReplayArguments>(command);
  command.text("input", "IDENTITY", options->input, given_help).required();
  command.text("--id", "ID", options->id,
               "The configuration of this id, of a file with several lines");
  command.flag("--json", options->json, "Print one JSON object");
  const Option emit =
      command.text("--emit", "CANDIDATE", options->engine,
                   fmt::format("Write a program that asks this engine alone: {}; or a candidate's "
                               "plug-in or command",
                               fmt::join(reproducer_engines(), ", ")));
  command.text("--language", "LANGUAGE", options->language,
               "Language of that program, where there are several: c++, javascript, python");
  command.text("--html", "FILE", options->html,
               "Write a page too: both bodies in 3-D, a slice, and all numbers; a cast in motion");
  const Option certify = command.flag(
      "--certify", options->certifies,
      "Print a proof of the signed distance, or of a cast, a file that others can check");
  command.number("--width", options->width, {1e-60, 1e30},
                 "Width to prove, relative to the larger size; down to 1e-60");
  command
      .count("--cells", options->cells, {0, 1000000},
             "End at so many cells of directions, with the width reached by then")
      .group("");
  command.mode(emit, {"--language"},
               {"--id", "--tolerance", "--threshold", "--time-limit", "--memory-limit"});
  command.mode(certify, {"--width", "--cells"}, {"--id"});
  command.footer(
      "Examples:\n"
      "  touchstone replay cylinder-box/parallel+tilted-1e-6/42/137\n"
      "  touchstone replay cylinder-cylinder/rim-rim/1/0 --candidates bullet --json\n"
      "  touchstone replay cylinder-box/rim-face/1/0 --emit bullet > reproducer.cpp\n"
      "  touchstone replay cylinder-box/rim-face/1/0 --emit jolt > reproducer.mjs\n"
      "  touchstone replay cylinder-box/rim-face/1/0 --html page.html\n"
      "  touchstone replay poses.jsonl --id c1\n"
      "  touchstone replay cast.jsonl   (a line with a sweep: when it touches first)\n"
      "  touchstone replay failures/ode-cylinder-box-agreement-missed.json --emit ode\n"
      "  touchstone replay cylinder-box/rim-face/1/0 --certify > proof.json\n"
      "  python3 oracle/check_certificate.py proof.json");
  command.runs([options, emit] { return run_replay(*options, emit.is_given()); });
}

}  // namespace touchstone
