#include "reports/report.hpp"

#include <fmt/format.h>
#include <memory>
#include <thread>

#include "cli/commands.hpp"
#include "cli/options.hpp"
#include "reference/invalid_input.hpp"
#include "reports/figures/figures.hpp"
#include "reports/interruption.hpp"
#include "reports/terminal_table.hpp"
#include "reports/worst.hpp"
#include "simulation/run_experiments.hpp"
#include "stability/stability.hpp"

namespace touchstone {
namespace {

struct Options {
  explicit Options(CLI::App& command) : sample(command, 100), candidates(command), bar(command) {}
  SampleOption sample;
  CandidateOption candidates;
  BarOption bar;
  unsigned workers = std::max(1U, std::thread::hardware_concurrency());
  std::string out = "out", figures;

  Campaign campaign() const {
    Campaign c;
    c.pairs = sample.pairs();
    c.classes = sample.classes();
    c.candidates = candidates.get();
    c.count = sample.count();
    c.seed = sample.seed();
    c.workers = workers;
    c.bar = bar.get();
    c.limits = candidates.limits();
    if (workers == 0) throw InvalidInput("--workers", "0", "must be at least 1");
    return c;
  }

  /// Of all pairs and pose classes: then experiments belong to it too.
  bool is_whole() const {
    return sample.pairs().size() == std::size(all_pairs) && sample.classes().empty();
  }
  ExperimentOptions experiments() const {
    ExperimentOptions e;
    for (const Experiment& each : all_experiments()) e.experiments.push_back(&each);
    e.candidates = candidates.get();
    e.workers = workers;
    e.limits = candidates.limits();
    return e;
  }

  /// The command that gives the same report again.
  std::string command_line() const {
    return program_name() + " report" + sample.command_line() + candidates.command_line() +
           bar.command_line();
  }
};

int run(const Options& options) {
  const Campaign campaign = options.campaign();
  check_writable(options.out);
  if (!options.figures.empty()) check_figures(options.figures);
  const Interruption interruption;
  nlohmann::json report = make_report(campaign, options.command_line());
  if (report["results"].empty()) {
    fmt::print(stderr, "Interrupted before any pose class was done: there is no report.\n");
    return interrupted_exit_code();
  }
  if (options.is_whole() && !interrupted()) {
    const Study study{campaign.candidates, campaign.bar, campaign.limits, campaign.workers};
    report["stability"] = stability(brief(study, campaign.pairs, campaign.seed));
    report["experiments"] = run_experiments(options.experiments());
  }
  write_report(report, options.out);
  fmt::print("{}\n{} configurations, truth certified to 1e-30 of the larger size, {:.0f} s.\n",
             terminal_table(report), report["configurations"].get<std::uint64_t>(),
             report["wall_seconds"].get<double>());
  fmt::print("Report: {}/report.html, {}/report.json\n", options.out, options.out);
  if (!options.figures.empty()) {
    write_figures(report, options.figures);
    fmt::print("Figures: {}\n", options.figures);
  }
  return report["partial"].get<bool>() ? interrupted_exit_code() : 0;
}

}  // namespace

void add_report(CLI::App& program, int& exit_code) {
  CLI::App* command =
      program.add_subcommand("report", "Score all candidates; write out/report.html");
  const auto options = std::make_shared<Options>(*command);
  command
      ->add_option("--workers", options->workers, "Worker processes; they do not change the result")
      ->default_str("one a core");
  command->add_option("--out", options->out, "Folder for report.json and report.html")
      ->capture_default_str();
  command->add_option("--figures", options->figures,
                      "Folder for figures as SVG, PNG and CSV, made by gnuplot");
  command->footer(
      "Examples:\n"
      "  touchstone report\n"
      "  touchstone report --pair cylinder-box --count 1000 --seed 7\n"
      "  touchstone report --candidates reference,bullet --class rim-rim,touching\n"
      "  touchstone report --figures figures\n"
      "Ctrl-C ends with a report of what is done by then, marked partial (exit code 130).");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace touchstone
