#include "reports/search.hpp"

#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "candidates/host/progress.hpp"
#include "cli/command.hpp"
#include "cli/options.hpp"
#include "properties/files/disk.hpp"
#include "properties/laws/failure_file.hpp"
#include "reference/invalid_input.hpp"
#include "reports/check_output.hpp"

namespace touchstone {
namespace {

constexpr std::uint64_t usual_budget = 10000, max_budget = 1000000000;

struct SearchArguments {
  explicit SearchArguments(Command& command)
      : sample(command, usual_budget, max_budget, "Evaluations for each pair and goal"),
        bar(command),
        workers(command) {}
  SampleOption sample;
  BarOption bar;
  WorkersOption workers;
  std::string candidate, save;
  std::vector<std::string> goals;
  bool json = false;

  Search search() const {
    Search s;
    s.pairs = sample.pairs();
    for (const std::string& name : goals) add_once(s.goals, parse_goal(name));
    if (goals.empty()) s.goals.assign(usual_goals.begin(), usual_goals.end());
    s.starts = {sample.classes(), sample.groups()};
    s.seed = sample.seed();
    s.budget = sample.count();
    s.bar = bar.get();
    s.workers = workers.get();
    return s;
  }
};

int run_search(const SearchArguments& options) {
  if (!options.save.empty()) check_writable(options.save, "--save");
  const Search wanted = options.search();
  const Candidate& candidate = named_candidate(options.candidate);
  SearchResult result;
  {
    std::unique_ptr<Progress> progress;
    result = search(candidate, wanted, [&](std::uint64_t done, std::uint64_t all) {
      if (!progress) progress = std::make_unique<Progress>("evaluations", all);
      progress->update(done);
    });
  }
  if (result.goals.empty()) {
    throw InvalidInput("--candidate", candidate.name,
                       "must have a routine for a pair that is asked");
  }
  std::string saved;
  const auto write = [&] {
    if (options.save.empty()) return;
    for (const Failure& f : result.failures) {
      saved += "saved " + save(f, options.save).string() + '\n';
    }
  };
  write_then_print(write, options.json ? to_json(result).dump(1) + '\n'
                                       : search_text(result, candidate.name, standard_output()));
  if (!options.json) print(saved);
  return result.failures.empty() ? 0 : something_failed;
}

std::string goal_list() {
  return "Goals, each what is made as large as can be:\n" +
         list_entry("distance", 9, "the error of the signed distance") +
         list_entry("normal", 9, "the normal regret") +
         list_entry("points", 9, "the error of the deepest point's depth") +
         list_entry("hull", 9,
                    "how far the hull of the points moves at a step that cannot be seen") +
         list_entry("time", 9, "what a query takes; only where it is named");
}

}  // namespace

void add_search(Program& program) {
  Command command = program.command("search", "Climb to one candidate's worst configurations");
  const auto options = std::make_shared<SearchArguments>(command);
  command.text("--candidate", options->candidate, "Its name, or a plug-in's file")
      .value("CANDIDATE")
      .required();
  command.list("--goal", options->goals, "Only these goals (default: distance,normal,points,hull)")
      .value("GOAL");
  command.text("--save", options->save, "Save failures into this folder, one of each cause")
      .value("FOLDER");
  command.flag("--json", options->json, "Print all that was found as JSON instead of text");
  command.footer(
      "Examples:\n"
      "  touchstone search --candidate bullet --pair cylinder-box --save failures\n"
      "  touchstone search --candidate reference --tolerance 1e-13 --count 1e6\n"
      "  touchstone search --candidate reference --goal time --pair cylinder-cylinder\n"
      "  touchstone replay failures/bullet-cylinder-box-agreement-shallow.json\n" +
      goal_list() + "Exit code 1: a law was broken.");
  command.runs([options] { return run_search(*options); });
}

}  // namespace touchstone
