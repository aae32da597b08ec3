#include "stability/stability.hpp"

#include <fmt/format.h>
#include <memory>
#include <thread>

#include "cli/commands.hpp"
#include "cli/given.hpp"
#include "cli/options.hpp"
#include "reference/invalid_input.hpp"
#include "reports/report.hpp"

namespace touchstone {
namespace {

struct Options {
  explicit Options(CLI::App& command) : candidates(command), bar(command) {}
  CandidateOption candidates;
  BarOption bar;
  std::string input;
  std::vector<std::string> parts, pairs, classes;
  std::uint64_t count = 6, seed = 1;
  unsigned workers = std::max(1U, std::thread::hardware_concurrency());
  std::string out = "out";
  bool json = false;

  StabilityOptions stability() const {
    if (count == 0) throw InvalidInput("--count", "0", "must be at least 1");
    if (workers == 0) throw InvalidInput("--workers", "0", "must be at least 1");
    StabilityOptions s =
        thorough({candidates.get(), bar.get(), candidates.limits(), workers}, seed);
    if (!pairs.empty()) {
      s.pairs.clear();
      for (const auto& name : pairs) s.pairs.push_back(parse_pair(name));
    }
    s.ladder = {degenerate_cells(s.pairs), seed, count};
    const bool ladder_only = !input.empty() || !classes.empty();
    if (ladder_only) s.parts = {StabilityPart::amplification};
    if (!classes.empty()) {
      Campaign wanted;
      wanted.pairs = s.pairs;
      wanted.classes = classes;
      s.ladder.cells = cells(wanted);
    }
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
      if (!classes.empty() || !pairs.empty()) {
        throw InvalidInput("input", '"' + input + '"', "leaves no choice of --pair or --class");
      }
      s.base = given_configuration(input);
    }
    return s;
  }

  /// The command that gives the same result again.
  std::string command_line(const StabilityOptions& s) const {
    std::string line = program_name() + " stability";
    if (!input.empty()) line += ' ' + shell_quoted(input);
    if (!parts.empty()) line += fmt::format(" --part {}", fmt::join(parts, ","));
    if (!pairs.empty()) line += fmt::format(" --pair {}", fmt::join(pairs, ","));
    if (!classes.empty()) line += fmt::format(" --class {}", fmt::join(classes, ","));
    std::vector<std::string> names;
    for (const Candidate* c : s.study.candidates) names.emplace_back(c->name);
    return line + fmt::format(
                      " --count {} --seed {} --candidates {} --tolerance {} --threshold {} "
                      "--time-limit {} --memory-limit {}",
                      count, seed, fmt::join(names, ","), s.study.bar.tolerance,
                      s.study.bar.threshold, s.study.limits.seconds, s.study.limits.mebibytes);
  }
};

void run(const Options& options) {
  const StabilityOptions chosen = options.stability();
  check_writable(options.out);
  const nlohmann::json result = stability(chosen);
  write_stability(result, options.command_line(chosen), options.out);
  if (options.json) {
    fmt::print("{}\n", result.dump());
    return;
  }
  fmt::print("{}\nWritten: {}/stability.html, {}/stability.json\n", stability_table(result),
             options.out, options.out);
}

}  // namespace

void add_stability(CLI::App& program, int&) {
  CLI::App* command = program.add_subcommand(
      "stability", "How answers change at tiny steps, near degenerate poses and along motions");
  const auto options = std::make_shared<Options>(*command);
  command->add_option("input", options->input,
                      std::string("Small steps around this configuration alone: ") + given_help);
  command->add_option("--part", options->parts, "Only these of amplification, maps, sequences")
      ->delimiter(',');
  command->add_option("--pair", options->pairs, "Only these pairs, as in cylinder-box")
      ->delimiter(',');
  command
      ->add_option("--class", options->classes,
                   "Small steps in these pose classes (default: the exactly degenerate ones)")
      ->delimiter(',');
  command
      ->add_option("--count", options->count,
                   "Small steps at each amplitude, around as many configurations of each class")
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Same seed, same configurations and steps")
      ->capture_default_str();
  command
      ->add_option("--workers", options->workers, "Worker processes; they do not change the result")
      ->default_str("one a core");
  command->add_option("--out", options->out, "Folder for stability.json and stability.html")
      ->capture_default_str();
  command->add_flag("--json", options->json, "Print the result as one JSON object");
  command->footer(
      "Examples:\n"
      "  touchstone stability\n"
      "  touchstone stability --part maps --pair cylinder-plane --candidates reference,bullet\n"
      "  touchstone stability cylinder-box/side-on-face/1/0 --count 100\n"
      "A step's two ends, a map's pixel and a motion's step can be replayed:\n"
      "  touchstone replay cylinder-box/side-on-face/1/0@1e-8/1/4\n"
      "  touchstone replay map/standing/1e-12/-3/16\n"
      "  touchstone replay sequence/roll-over-edge/113/400");
  command->callback([options] { run(*options); });
}

}  // namespace touchstone
