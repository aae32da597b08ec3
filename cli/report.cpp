#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <set>

#include "candidates/host/interruption.hpp"
#include "candidates/host/progress.hpp"
#include "cli/command.hpp"
#include "cli/options.hpp"
#include "properties/files/disk.hpp"
#include "reference/invalid_input.hpp"
#include "reports/engine_table.hpp"
#include "reports/figures/figures.hpp"
#include "reports/history.hpp"
#include "reports/make_report.hpp"
#include "reports/replay.hpp"
#include "reports/report_json.hpp"
#include "reports/stability/measure.hpp"
#include "reports/terminal.hpp"
#include "reports/test_data/given_answers.hpp"
#include "simulation/engines/run_engines.hpp"
#include "simulation/experiment.hpp"
#include "simulation/run_experiments.hpp"

namespace touchstone {
namespace {

/// A report keeps all answers in memory, about a hundred bytes each.
constexpr std::uint64_t max_answers = 100000000;

/// Everyday classes are few, and what users ask of first: of each that --class does not name, so
/// many times the count are scored.
constexpr std::uint64_t usual_count = 20, everyday_times = 5;

/// A part of a report with about the share of its time that it takes, by what its progress counts.
struct Part {
  std::string name;
  OverallProgress::Part share;
};
const std::vector<Part>& parts() {
  static const std::vector<Part> all = {{"scores", {"configurations", 45}},
                                        {"timing", {"pose classes timed", 20}},
                                        {"casts", {"casts", 4}},
                                        {"stability", {"poses", 18}},
                                        {"experiments", {"experiments", 14}},
                                        {"engines", {"experiments in engines", 6}}};
  return all;
}

struct ReportArguments {
  explicit ReportArguments(Command& command)
      : scored(command, usual_count, max_answers), workers(command) {}
  CampaignOption scored;
  WorkersOption workers;
  std::vector<std::string> only;
  std::string out = "out", figures, configurations, table, history;
  bool has_details = false;

  /// The names of the parts to make: scores always. Those that are not of single pose classes are
  /// left out where some are chosen, unless --only names them.
  std::set<std::string> chosen_parts() const {
    std::set<std::string> chosen(only.begin(), only.end());
    for (const std::string& name : chosen) {
      if (std::ranges::find(parts(), name, &Part::name) != parts().end()) continue;
      throw InvalidInput("--only", '"' + name + '"',
                         "must be of scores, timing, casts, stability, experiments, engines");
    }
    chosen.insert("scores");
    if (!only.empty()) return chosen;
    chosen.insert("timing");
    if (scored.sample.is_narrowed() || !configurations.empty() || !history.empty()) return chosen;
    for (const Part& part : parts()) chosen.insert(part.name);
    return chosen;
  }

  /// A person's own configurations, in place of drawn ones.
  void take_own(Campaign& c) const {
    if (scored.sample.is_narrowed() || scored.sample.count_is_given()) {
      throw InvalidInput("--configurations", '"' + configurations + '"',
                         "leaves no choice of --pair, --class, --group or --count");
    }
    std::ifstream in = opened(configurations, "--configurations");
    std::vector<std::pair<std::string, ConfigurationFile::Entry>> all;
    try {
      const ConfigurationFile file(in);
      all.assign(file.entries().begin(), file.entries().end());
    } catch (const InvalidInput& e) {
      throw InvalidInput(configurations + ": " + e.field(), e.value(), e.remedy());
    }
    if (all.empty()) {
      throw InvalidInput("--configurations", '"' + configurations + '"',
                         "must have a configuration, one a line");
    }
    std::ranges::sort(all, {}, [](const auto& entry) { return entry.second.number; });
    for (const auto& [id, entry] : all) {
      const Configuration& configuration = entry.given.configuration;
      c.own[pair_of(configuration)].push_back({id, configuration});
    }
    c.own_file = configurations;
    c.pairs.clear();
    for (const auto& [pair, of_pair] : c.own) c.pairs.push_back(pair);
  }

  /// Releases are compared on everyday poses, if no others are chosen.
  void keep_to_releases(Campaign& c) const {
    if (!configurations.empty()) {
      throw InvalidInput("--history", '"' + history + '"', "leaves no choice of --configurations");
    }
    const auto is_release = [&](const Candidate* candidate) {
      return candidate->name.starts_with(history + '@');
    };
    if (std::ranges::count_if(c.candidates, is_release) < 2) {
      throw InvalidInput(
          "--history", '"' + history + '"',
          fmt::format("must have two releases in --candidates, as {0}@1.0,{0}@1.1; without "
                      "--candidates ./touchstone takes those of an engine from npm",
                      history));
    }
    if (!scored.sample.is_narrowed()) c.groups = {Group::everyday};
  }

  Campaign campaign() const {
    Campaign c = scored.get();
    if (c.classes.empty()) c.everyday_times = everyday_times;
    if (!history.empty()) keep_to_releases(c);
    c.workers = workers.get();
    if (!configurations.empty()) {
      take_own(c);
      return c;
    }
    const std::uint64_t max_count =
        max_answers /
        std::max<std::uint64_t>(1, cells(c).size() * c.everyday_times * c.candidates.size());
    if (c.count > max_count) {
      throw InvalidInput("--count", fmt::format("{}", c.count),
                         fmt::format("must be at most {} for these classes and candidates; "
                                     "touchstone campaign scores any number",
                                     max_count));
    }
    return c;
  }

  /// The command that gives the same report again.
  std::string command_line() const {
    const std::string scored_ones =
        configurations.empty() ? scored.command_line()
                               : " --configurations " + shell_quoted(configurations) +
                                     scored.candidates.command_line() + scored.bar.command_line();
    return program_name() + " report" + scored_ones +
           (only.empty() ? "" : fmt::format(" --only {}", fmt::join(only, ","))) +
           (history.empty() ? "" : " --history " + shell_quoted(history));
  }
};

ExperimentOptions experiments_of(const Campaign& campaign) {
  ExperimentOptions e;
  for (const Experiment& each : all_experiments()) e.experiments.push_back(&each);
  e.candidates = campaign.candidates;
  e.workers = campaign.workers;
  e.limits = campaign.limits;
  return e;
}

/// In those of the engines that are among the candidates.
EngineOptions engines_of(const Campaign& campaign) {
  EngineOptions e;
  e.experiments = engine_experiments();
  for (const std::string& engine : all_engines()) {
    // In single precision nothing but rounding would be new.
    if (engine == "bullet-float") continue;
    const auto at = std::ranges::find(campaign.candidates, engine, &Candidate::name);
    if (at != campaign.candidates.end()) e.engines.push_back(engine);
  }
  e.workers = campaign.workers;
  return e;
}

OverallProgress progress_of(const std::set<std::string>& chosen) {
  std::vector<OverallProgress::Part> shares;
  for (const Part& part : parts()) {
    if (chosen.contains(part.name)) shares.push_back(part.share);
  }
  return OverallProgress(std::move(shares));
}

int run_report(const ReportArguments& options) {
  const std::set<std::string> chosen = options.chosen_parts();
  Campaign campaign = options.campaign();
  campaign.is_timed = chosen.contains("timing");
  const std::string folder = options.out, figures_folder = options.figures;
  const OutputFolder out(folder);
  std::optional<OutputFolder> figures;
  const bool is_html = !options.table.empty() && is_html_table(options.table);
  if (!options.table.empty()) check_file_writable(options.table, "--table");
  if (!figures_folder.empty()) {
    check_figures(figures_folder);
    if (!std::filesystem::equivalent(figures_folder, folder)) {
      figures.emplace(figures_folder, "--figures");
    }
  }
  const Interruption interruption;
  const OverallProgress progress = progress_of(chosen);
  Report report = make_report(campaign, options.command_line());
  if (report.results.empty()) {
    complain("Interrupted before any pose class was done: there is no report.");
    return interrupted_exit_code();
  }
  const auto start = std::chrono::steady_clock::now();
  const auto is_next = [&](const char* part) { return chosen.contains(part) && !interrupted(); };
  if (is_next("casts")) report.casts = measure_casts(campaign);
  if (is_next("stability")) {
    const Study study{campaign.candidates, campaign.bar, campaign.limits, campaign.workers};
    report.stability = measure(brief(study, campaign.pairs, campaign.seed));
  }
  if (is_next("experiments")) report.experiments = run_experiments(experiments_of(campaign));
  const EngineOptions engines = engines_of(campaign);
  if (is_next("engines") && !engines.engines.empty()) report.engines = run_engines(engines);
  report.wall_seconds +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  report.partial = report.partial || interrupted();
  if (!options.history.empty()) {
    report.history = History{options.history, release_steps(report, options.history)};
  }
  const Terminal terminal = standard_output();
  std::string text = report.history        ? history_text(report, terminal)
                     : options.has_details ? terminal_details(report, terminal)
                                           : terminal_table(report, terminal);
  if (options.has_details && report.engines) {
    text += '\n' + engines_summary(*report.engines, terminal);
  }
  text += '\n' + terminal.folded(fmt::format(
                     "{}, truth certified to 1e-30 of the larger size, {:.0f} s.",
                     counted(report.configurations, "configuration"), report.wall_seconds));
  write_then_print(
      [&] {
        write_report(report, folder);
        if (report.history) {
          write_file(std::filesystem::path(folder) / "history.html", history_page(report), "--out");
        }
        if (options.table.empty()) return;
        write_file(options.table, engine_table(report, is_html), "--table");
      },
      text);
  print(fmt::format("Report: {0}/report.html, {0}/report.json{1}\n", folder,
                    report.history ? fmt::format(", {}/history.html", folder) : ""));
  if (!figures_folder.empty()) {
    write_figures(report, figures_folder);
    print(fmt::format("Figures: {}\n", figures_folder));
  }
  return report.partial ? interrupted_exit_code() : 0;
}

}  // namespace

void add_report(Program& program) {
  Command command = program.command("report", "Score all candidates; write out/report.html");
  const auto options = std::make_shared<ReportArguments>(command);
  command.list("--only", "REPORT-PART", options->only,
               "Only these parts of scores (always made), timing, casts, stability, experiments, "
               "engines");
  command.text("--out", "FOLDER", options->out, "Folder for report.json and report.html");
  command.text("--configurations", "FILE", options->configurations,
               "Your own, in place of drawn ones: a file as for solve, with an id a line");
  command.text("--figures", "FOLDER", options->figures,
               "Folder for figures as SVG, PNG and CSV, made by gnuplot");
  command.text("--table", "FILE", options->table,
               "Also a table of candidates by pairs for your own page, as .md or .html");
  command.text("--history", "CANDIDATE", options->history,
               "What the releases of an engine from npm changed in everyday poses: history.html");
  command.flag("--details", options->has_details, details_help);
  command.footer(
      "Examples:\n"
      "  touchstone report\n"
      "  touchstone report --pair cylinder-box --count 1000 --seed 7\n"
      "  touchstone report --candidates reference,bullet --class rim-rim,touching\n"
      "  touchstone report --group everyday --count 100\n"
      "  touchstone report --configurations poses.jsonl\n"
      "  touchstone report --figures figures\n"
      "  touchstone report --only scores,timing\n"
      "Of everyday pose classes, recorded ones and arrangements along the world's axes\n"
      "that --class does not name, five times as many configurations are scored.\n"
      "Ctrl-C, SIGTERM or SIGHUP ends with a report of what is done, marked partial.\n"
      "Exit codes: 130, 143, 129 when stopped by Ctrl-C, SIGTERM, SIGHUP.");
  command.runs([options] { return run_report(*options); });
}

}  // namespace touchstone
