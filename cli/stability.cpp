#include "reports/stability/stability.hpp"

#include <fmt/format.h>
#include <memory>

#include "cli/command.hpp"
#include "cli/options.hpp"
#include "properties/files/configuration_json.hpp"
#include "properties/files/disk.hpp"
#include "reference/invalid_input.hpp"
#include "reports/replay.hpp"
#include "reports/stability/measure.hpp"
#include "reports/terminal.hpp"

namespace touchstone {
namespace {

struct StabilityArguments {
  explicit StabilityArguments(Command& command)
      : sample(command, 6, 100000), candidates(command), bar(command), workers(command) {}
  SampleOption sample;
  CandidateOption candidates;
  BarOption bar;
  WorkersOption workers;
  std::string input;
  std::vector<std::string> parts;
  std::string out = "out";
  bool json = false;

  StabilityOptions stability() const {
    StabilityOptions s =
        thorough({candidates.get(), bar.get(), candidates.limits(), workers.get()}, sample.seed());
    s.pairs = sample.pairs();
    s.ladder = {degenerate_cells(s.pairs), sample.seed(), sample.count()};
    const bool ladder_only = !input.empty() || sample.has_some_classes();
    if (ladder_only) s.parts = {StabilityPart::amplification};
    if (sample.has_some_classes()) s.ladder.cells = cells(sample.campaign());
    if (!parts.empty()) s.parts.clear();
    for (const auto& name : parts) {
      const StabilityPart part = parse_stability_part(name);
      if (ladder_only && part != StabilityPart::amplification) {
        throw InvalidInput("--part", '"' + name + '"',
                           "must be amplification, the only one of a given configuration or class");
      }
      s.parts.insert(part);
    }
    if (!input.empty()) {
      if (sample.is_narrowed()) {
        throw InvalidInput("input", '"' + input + '"',
                           "leaves no choice of --pair, --class or --group");
      }
      s.base = given_configuration(input);
      refuse_sweep(*s.base, "stability");
    }
    return s;
  }

  /// The command that gives the same result again.
  std::string command_line() const {
    std::string line = program_name() + " stability";
    if (!input.empty()) line += ' ' + shell_quoted(input);
    if (!parts.empty()) line += fmt::format(" --part {}", fmt::join(parts, ","));
    return line + sample.command_line() + candidates.command_line() + bar.command_line();
  }
};

int run_stability(const StabilityArguments& options) {
  const StabilityOptions chosen = options.stability();
  const OutputFolder out(options.out);
  const Stability result = measure(chosen);
  const auto write = [&] { write_stability(result, options.command_line(), options.out); };
  write_then_print(
      write, options.json ? json_text(result) + '\n' : stability_table(result, standard_output()));
  if (!options.json) {
    print(
        fmt::format("\nWritten: {}/stability.html, {}/stability.json\n", options.out, options.out));
  }
  return 0;
}

}  // namespace

void add_stability(Program& program) {
  Command command =
      program.command("stability", "How answers change at tiny steps and along motions");
  const auto options = std::make_shared<StabilityArguments>(command);
  command.text("input", "IDENTITY", options->input,
               std::string("Small steps around this configuration alone: ") + given_help);
  command.list("--part", "PART", options->parts, "Only these of amplification, maps, sequences");
  command.text("--out", "FOLDER", options->out, "Folder for stability.json and stability.html");
  command.flag("--json", options->json, "Print the result as one JSON object");
  command.footer(
      "Small steps start in exactly degenerate pose classes, or in those of --class.\n"
      "Examples:\n"
      "  touchstone stability\n"
      "  touchstone stability --part maps --candidates reference,bullet\n"
      "  touchstone stability cylinder-box/side-on-face/1/0 --count 100\n"
      "A step's two ends, a map's pixel and a motion's step can be replayed:\n"
      "  touchstone replay cylinder-box/side-on-face/1/0@1e-8/1/4\n"
      "  touchstone replay map/standing/1e-12/-3/16\n"
      "  touchstone replay sequence/roll-over-edge/113/400");
  command.runs([options] { return run_stability(*options); });
}

}  // namespace touchstone
