#include "reports/search.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <utility>

#include <nlohmann/json.hpp>

#include "candidates/host/progress.hpp"
#include "cli/command.hpp"
#include "cli/options.hpp"
#include "properties/files/disk.hpp"
#include "properties/laws/failure_file.hpp"
#include "reports/terminal.hpp"

namespace touchstone {
namespace {

struct SearchArguments {
  explicit SearchArguments(Command& command) : sample(command, 250, 1000000), bar(command) {}
  SampleOption sample;
  BarOption bar;
  std::string candidate, save;
  bool json = false;
};

std::string name_of(const Cell& cell) {
  return std::string(pair_name(cell.pair)) + '/' + cell.pose_class;
}

TextTable table_of(const std::vector<Cell>& all, const Terminal& terminal) {
  constexpr std::size_t numbers_width = 36;
  std::size_t name_width = 0;
  for (const Cell& cell : all) name_width = std::max(name_width, name_of(cell).size());
  return {"class",
          std::min(name_width, terminal.columns - numbers_width),
          {{"outcome", 15, 0}, {"severity", 9, 1}, {"sampled", 9, 2}},
          terminal};
}

int run_search(const SearchArguments& options) {
  if (!options.save.empty()) check_writable(options.save, "--save");
  const std::vector<Cell> all = cells(options.sample.campaign());
  const Bar bar = options.bar.get();
  const std::uint64_t budget = options.sample.count();
  CandidateProcess process(named_candidate(options.candidate), bar.threshold);

  std::map<std::pair<Pair, std::string>, std::pair<double, Failure>> failures;  // the worst alike
  nlohmann::json found_json = nlohmann::json::array();
  const Terminal terminal = standard_output();
  const TextTable table = table_of(all, terminal);
  std::string text = table.headings();
  {
    Progress progress("configurations", all.size() * budget);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const SearchResult found =
          search(process, {all[i], options.sample.seed(), budget, bar},
                 [&](std::uint64_t asked) { progress.update(i * budget + asked); });
      found_json.push_back(to_json(found, all[i]));
      text += table.row(name_of(all[i]), {{outcome_name(found.score.outcome)},
                                          {fmt::format("{:.1e}", found.score.severity)},
                                          {fmt::format("{:.1e}", found.sampled.severity)}});
      const auto failure = failure_of(found, process, bar);
      if (!failure) continue;
      const auto [at, is_new] = failures.try_emplace({all[i].pair, failure->violation.failure},
                                                     found.score.severity, *failure);
      if (!is_new && at->second.first < found.score.severity) {
        at->second = {found.score.severity, *failure};
      }
    }
  }
  text += '\n' + terminal.folded("severity: the worst found, relative to the smaller size");
  if (table.has("sampled")) {
    text += terminal.folded(
        "sampled: the worst of the first quarter, which were drawn and not changed");
  }
  text += table.what_is_left_out();
  std::string saved;
  const auto write = [&] {
    for (const auto& [name, failure] : failures) {
      if (options.save.empty()) break;
      saved += "saved " + save(failure.second, options.save).string() + '\n';
    }
  };
  write_then_print(write, options.json ? found_json.dump(1) + '\n' : text);
  if (!options.json) print(saved);
  return failures.empty() ? 0 : something_failed;
}

}  // namespace

void add_search(Program& program) {
  Command command = program.command("search", "Look for one candidate's worst configurations");
  const auto options = std::make_shared<SearchArguments>(command);
  command.text("--candidate", options->candidate, "Its name, or a plug-in's file")
      .value("CANDIDATE")
      .required();
  command
      .text("--save", options->save,
            "Save the worst failure of each kind and pair into this folder")
      .value("FOLDER");
  command.flag("--json", options->json, "Print all that was found as JSON instead of text");
  command.footer(
      "Examples:\n"
      "  touchstone search --candidate bullet --pair cylinder-box --save failures\n"
      "  touchstone search --candidate reference --tolerance 1e-12 --count 1e5\n"
      "  touchstone replay failures/bullet-cylinder-box-agreement-shallow.json\n"
      "Exit code 1: something was beyond the tolerance.");
  command.runs([options] { return run_search(*options); });
}

}  // namespace touchstone
