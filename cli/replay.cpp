#include "reports/replay.hpp"

#include <fmt/format.h>
#include <memory>

#include "cli/commands.hpp"
#include "cli/options.hpp"
#include "reports/configuration_json.hpp"
#include "reports/replay_page/replay_page.hpp"
#include "reports/worst.hpp"

namespace touchstone {
namespace {

struct Options {
  explicit Options(CLI::App& command) : candidates(command), bar(command) {}
  CandidateOption candidates;
  BarOption bar;
  std::string identity;
  bool json = false;
  std::string html;
};

}  // namespace

void add_replay(CLI::App& program, int&) {
  CLI::App* command =
      program.add_subcommand("replay", "Show one configuration again: truth and answers");
  const auto options = std::make_shared<Options>(*command);
  command->add_option("identity", options->identity, "pair/class/seed/index, as a report prints it")
      ->required();
  command->add_flag("--json", options->json, "Print one JSON object");
  command->add_option("--html", options->html,
                      "Write a page too: both bodies in 3-D, a slice, and all numbers");
  command->footer(
      "Examples:\n"
      "  touchstone replay cylinder-box/near-parallel-1e-6/42/137\n"
      "  touchstone replay cylinder-cylinder/rim-rim/1/0 --candidates bullet --json\n"
      "  touchstone replay cylinder-box/rim-face/1/17 --html page.html");
  command->callback([options] {
    const Identity identity = parse_identity(options->identity);
    const Bar bar = options->bar.get();
    auto candidates = start(options->candidates.get(), bar.threshold, options->candidates.limits());
    if (!options->html.empty()) {
      const Configuration c = make_configuration(identity);
      write_replay_page(
          replay_page(examined(identity, pointers(candidates), bar, 1e-30), to_hex_json(c),
                      to_exact_json(c), describe_pose_class(identity.pair, identity.pose_class)),
          options->html);
    }
    if (options->json) {
      fmt::print("{}\n", examined(identity, pointers(candidates), bar, 1e-30).dump());
    } else {
      fmt::print("{}", replay_text(identity, candidates, bar));
    }
  });
}

}  // namespace touchstone
