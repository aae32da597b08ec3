#include "scenes/choose.hpp"

#include <fmt/format.h>
#include <memory>
#include <thread>

#include "cli/commands.hpp"
#include "cli/options.hpp"
#include "reference/invalid_input.hpp"
#include "reports/report.hpp"
#include "scenes/choice_json.hpp"
#include "scenes/choice_text.hpp"

namespace touchstone {
namespace {

struct Options {
  explicit Options(CLI::App& command) : candidates(command) {}
  CandidateOption candidates;
  std::string scene, out = "out";
  unsigned workers = std::max(1U, std::thread::hardware_concurrency());
  bool json = false;
};

int run(const Options& options) {
  const SceneFile file = read_scene(options.scene);
  check_writable(options.out);
  const Choice choice =
      choose(file, {swept_candidates(), options.workers, options.candidates.limits()});
  const std::string folder = options.out + "/choose";
  write_evidence(choice, file, folder);
  const nlohmann::json result = to_json(choice, file, "touchstone choose " + options.scene, folder);
  fmt::print("{}", options.json ? result.dump() + '\n' : choice_text(result));
  return choice.impossible ? 1 : 0;
}

}  // namespace

void add_choose(CLI::App& program, int& exit_code) {
  CLI::App* command =
      program.add_subcommand("choose", "The cheapest contact models that a scene needs");
  const auto options = std::make_shared<Options>(*command);
  command->add_option("scene", options->scene, "A scene file (docs/scenes.md)")->required();
  command->add_option("--out", options->out, "Folder for choose.json and choose.html")
      ->capture_default_str();
  command->add_flag("--json", options->json, "Print choose.json instead of text");
  command->add_option("--workers", options->workers, "Worker processes")->capture_default_str();
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace touchstone
