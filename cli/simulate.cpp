#include <fmt/format.h>
#include <memory>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "cli/options.hpp"
#include "properties/files/disk.hpp"
#include "simulation/experiment.hpp"
#include "simulation/run_experiments.hpp"

namespace touchstone {
namespace {

struct Options {
  explicit Options(Command& command) : candidates(command), workers(command) {}
  CandidateOption candidates;
  WorkersOption workers;
  std::vector<std::string> names;
  std::vector<double> steps = {1.0 / 60, 1.0 / 240, 1.0 / 960};
  std::string out;
  bool json = false;

  ExperimentOptions experiments() const {
    ExperimentOptions e;
    for (const auto& name : names) e.experiments.push_back(&find_experiment(name));
    if (names.empty()) {
      for (const Experiment& each : all_experiments()) e.experiments.push_back(&each);
    }
    e.candidates = candidates.get();
    e.limits = candidates.limits();
    e.steps = steps;
    e.workers = workers.get();
    return e;
  }
};

int run(const Options& options) {
  const ExperimentOptions experiments = options.experiments();
  if (!options.out.empty()) check_writable(options.out);
  const ExperimentResults results = run_experiments(experiments);
  const nlohmann::json json = to_json(results);
  fmt::print("{}", options.json ? json.dump() + '\n' : experiments_table(results));
  if (options.out.empty()) return 0;
  write_file(options.out + "/experiments.json", json.dump(1) + '\n', "--out");
  return 0;
}

std::string experiment_list() {
  std::string text = "Experiments:\n";
  for (const Experiment& e : all_experiments()) {
    text += list_entry(e.name, 15, e.statement);
  }
  return text;
}

}  // namespace

void add_simulate(Program& program) {
  Command command = program.command("simulate", "Rigid-body experiments with an answer on paper");
  const auto options = std::make_shared<Options>(command);
  command.arguments("experiments", options->names, "Only these experiments");
  command.numbers("--step", options->steps, {1e-5, 0.1},
                  "Steps of time, seconds, separated by commas (default: 1/60, 1/240, 1/960)");
  command.text("--out", options->out, "Folder for experiments.json");
  command.flag("--json", options->json, "Print one JSON object");
  command.footer(
      "Examples:\n"
      "  touchstone simulate rolling\n"
      "  touchstone simulate standing --candidates reference,bullet --step 0.004\n"
      "  touchstone simulate --out out\n" +
      experiment_list());
  command.runs([options] { return run(*options); });
}

}  // namespace touchstone
