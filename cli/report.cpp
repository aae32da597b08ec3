#include "reports/report.hpp"

#include <fmt/format.h>
#include <memory>
#include <thread>

#include "cli/commands.hpp"
#include "cli/options.hpp"
#include "reference/invalid_input.hpp"
#include "reports/terminal_table.hpp"
#include "reports/worst.hpp"
#include "stability/stability.hpp"

namespace touchstone {
namespace {

struct Options {
  explicit Options(CLI::App& command) : candidates(command), bar(command) {}
  CandidateOption candidates;
  BarOption bar;
  std::vector<std::string> pairs, classes;
  std::uint64_t count = 100, seed = 1;
  unsigned workers = std::max(1U, std::thread::hardware_concurrency());
  std::string out = "out";

  Campaign campaign() const {
    Campaign c;
    for (const auto& name : pairs) c.pairs.push_back(parse_pair(name));
    if (pairs.empty()) c.pairs.assign(std::begin(all_pairs), std::end(all_pairs));
    c.classes = classes;
    c.candidates = candidates.get();
    c.count = count;
    c.seed = seed;
    c.workers = workers;
    c.bar = bar.get();
    c.limits = candidates.limits();
    if (count == 0) throw InvalidInput("--count", "0", "must be at least 1");
    if (workers == 0) throw InvalidInput("--workers", "0", "must be at least 1");
    return c;
  }

  /// The command that gives the same report again.
  std::string command_line() const {
    std::string line = fmt::format("{} report --seed {} --count {}", program_name(), seed, count);
    if (!pairs.empty()) line += fmt::format(" --pair {}", fmt::join(pairs, ","));
    if (!classes.empty()) line += fmt::format(" --class {}", fmt::join(classes, ","));
    std::vector<std::string> names;
    for (const Candidate* c : candidates.get()) names.emplace_back(c->name);
    const Bar used = bar.get();
    const Limits limits = candidates.limits();
    return line + fmt::format(
                      " --candidates {} --tolerance {} --threshold {} --time-limit {} "
                      "--memory-limit {}",
                      fmt::join(names, ","), used.tolerance, used.threshold, limits.seconds,
                      limits.mebibytes);
  }
};

void run(const Options& options) {
  const Campaign campaign = options.campaign();
  cells(campaign);  // refuses unknown classes before any work
  check_writable(options.out);
  nlohmann::json report = make_report(campaign, options.command_line());
  const Study study{campaign.candidates, campaign.bar, campaign.limits, campaign.workers};
  report["stability"] = stability(brief(study, campaign.pairs, campaign.seed));
  write_report(report, options.out);
  fmt::print("{}\n{} configurations, truth certified to 1e-30 of the larger size, {:.0f} s.\n",
             terminal_table(report), report["configurations"].get<std::uint64_t>(),
             report["wall_seconds"].get<double>());
  fmt::print("Report: {}/report.html, {}/report.json\n", options.out, options.out);
}

}  // namespace

void add_report(CLI::App& program, int&) {
  CLI::App* command =
      program.add_subcommand("report", "Score all candidates; write out/report.html");
  const auto options = std::make_shared<Options>(*command);
  command->add_option("--pair", options->pairs, "Only these pairs, as in cylinder-box")
      ->delimiter(',');
  command->add_option("--class", options->classes, "Only these pose classes")->delimiter(',');
  command->add_option("--count", options->count, "Configurations of each pair and pose class")
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Same seed, same configurations")
      ->capture_default_str();
  command
      ->add_option("--workers", options->workers, "Worker processes; they do not change the result")
      ->capture_default_str();
  command->add_option("--out", options->out, "Folder for report.json and report.html")
      ->capture_default_str();
  command->footer(
      "Examples:\n"
      "  touchstone report\n"
      "  touchstone report --pair cylinder-box --count 1000 --seed 7\n"
      "  touchstone report --candidates reference,bullet --class rim-rim,touching");
  command->callback([options] { run(*options); });
}

}  // namespace touchstone
