#include "reports/search.hpp"

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

namespace touchstone {
namespace {

constexpr int something_failed = 1;

struct Options {
  explicit Options(Command& command) : sample(command, 250, 1000000), bar(command) {}
  SampleOption sample;
  BarOption bar;
  std::string candidate, save, json;
};

int run(const Options& options) {
  const std::vector<Cell> all = cells(options.sample.campaign());
  const Bar bar = options.bar.get();
  const std::uint64_t budget = options.sample.count();
  CandidateProcess process(named_candidate(options.candidate), bar.threshold);

  std::map<std::pair<Pair, std::string>, std::pair<double, Failure>> failures;  // the worst alike
  nlohmann::json found_json = nlohmann::json::array();
  std::string table =
      fmt::format("{:<46} {:>13} {:>9} {:>9}\n", "class", "outcome", "severity", "sampled");
  {
    Progress progress("configurations", all.size() * budget);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const SearchResult found =
          search(process, {all[i], options.sample.seed(), budget, bar},
                 [&](std::uint64_t asked) { progress.update(i * budget + asked); });
      found_json.push_back(to_json(found, all[i]));
      table += fmt::format("{:<46} {:>13} {:>9.1e} {:>9.1e}\n",
                           fmt::format("{}/{}", pair_name(all[i].pair), all[i].pose_class),
                           outcome_name(found.score.outcome), found.score.severity,
                           found.sampled.severity);
      const auto failure = failure_of(found, process, bar);
      if (!failure) continue;
      const auto [at, is_new] = failures.try_emplace({all[i].pair, failure->violation.failure},
                                                     found.score.severity, *failure);
      if (!is_new && at->second.first < found.score.severity) {
        at->second = {found.score.severity, *failure};
      }
    }
  }
  fmt::print(
      "{}\nseverity: the worst found, relative to the smaller size; sampled: the worst of "
      "the\nfirst quarter, which were drawn and not changed\n",
      table);
  if (!options.save.empty()) {
    for (const auto& [name, failure] : failures) {
      fmt::print("saved {}\n", save(failure.second, options.save).string());
    }
  }
  if (!options.json.empty()) write_file(options.json, found_json.dump(1) + '\n', "--json");
  return failures.empty() ? 0 : something_failed;
}

}  // namespace

void add_search(Program& program) {
  Command command = program.command("search", "Look for one candidate's worst configurations");
  const auto options = std::make_shared<Options>(command);
  command.text("--candidate", options->candidate, "Its name, or a plug-in's file")
      .value("CANDIDATE")
      .required();
  command
      .text("--save", options->save,
            "Save the worst failure of each kind and pair into this folder")
      .value("FOLDER");
  command.text("--json", options->json, "Write all that was found as JSON").value("FILE");
  command.footer(
      "Examples:\n"
      "  touchstone search --candidate bullet --pair cylinder-box --save failures\n"
      "  touchstone search --candidate reference --tolerance 1e-12 --count 1e5\n"
      "  touchstone replay failures/bullet-cylinder-box-agreement-shallow.json\n"
      "Exit code 1: something was beyond the tolerance.");
  command.runs([options] { return run(*options); });
}

}  // namespace touchstone
