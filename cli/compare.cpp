#include "reports/compare.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "candidates/host/interruption.hpp"
#include "candidates/npm_engines.hpp"
#include "cli/command.hpp"
#include "cli/options.hpp"
#include "properties/files/disk.hpp"
#include "reference/invalid_input.hpp"
#include "reports/history.hpp"
#include "reports/make_report.hpp"
#include "reports/report_json.hpp"

namespace touchstone {
namespace {

struct CompareArguments {
  std::string before, after, html;
  CompareLimits limits;
  std::vector<std::string> fail_on;
  bool json = false;
  std::optional<WorkersOption> workers;

  CompareLimits chosen() const {
    CompareLimits result = limits;
    for (const auto& name : fail_on) {
      if (name == "time") {
        result.time_counts = true;
      } else if (name != "accuracy") {
        throw InvalidInput("--fail-on", '"' + name + '"',
                           "must be accuracy, which is always meant, or time");
      }
    }
    return result;
  }
};

/// Is it a release of an engine from npm, and no file?
bool is_release(const std::string& text) {
  return !npm_release(text).empty() && !std::filesystem::exists(text);
}

/// Two releases of an engine on everyday poses: as reports on the engine, with the baseline.
std::pair<Report, Report> score_releases(const CompareArguments& options,
                                         const std::string& baseline) {
  const std::string engine = options.before.substr(0, options.before.find('@'));
  if (!is_release(options.before) || !options.after.starts_with(engine + '@')) {
    throw InvalidInput("NEW", '"' + options.after + '"',
                       "must be a report.json, as OLD, or both must be releases of one engine from "
                       "npm, as rapier@0.20 and rapier@0.21");
  }
  Campaign campaign;
  campaign.pairs.assign(std::begin(all_pairs), std::end(all_pairs));
  campaign.groups = {Group::everyday};
  campaign.candidates = find_candidates({options.before, options.after, baseline});
  campaign.count = 20;
  campaign.workers = options.workers->get();
  const Interruption interruption;
  const Report report = make_report(campaign, "");
  const auto of = [&](const std::string& release) {
    return part_of(report, {{release, engine}, {baseline, baseline}});
  };
  return {of(options.before), of(options.after)};
}

int run_compare(const CompareArguments& options) {
  refuse_to_replace(options.before, options.html, "--html");
  refuse_to_replace(options.after, options.html, "--html");
  const CompareLimits limits = options.chosen();
  const auto [before, after] =
      is_release(options.before) || is_release(options.after)
          ? score_releases(options, limits.baseline)
          : std::pair(read_report(options.before), read_report(options.after));
  const Comparison comparison = compare(before, after, limits);
  const auto write = [&] {
    if (options.html.empty()) return;
    write_file(options.html, comparison_page(comparison, before, after), "--html");
  };
  write_then_print(write, options.json ? comparison_json(comparison)
                                       : comparison_text(comparison, standard_output()));
  if (interrupted()) return interrupted_exit_code();
  return comparison.has_regressed() ? 1 : 0;
}

}  // namespace

void add_compare(Program& program) {
  Command command =
      program.command("compare", "What is better, worse or slower than in another report");
  const auto options = std::make_shared<CompareArguments>();
  command
      .text("OLD", "FILE", options->before,
            "report.json to compare with, or a release of an engine from npm, as rapier@0.20, to "
            "be scored on everyday poses")
      .required();
  command.text("NEW", "FILE", options->after, "Likewise, that may be worse").required();
  options->workers.emplace(command);
  constexpr NumberRange factors{1, 1e300}, shares{0, 1};
  command.number(
      "--max-error-factor", options->limits.error_factor, factors,
      "By how much an error may grow, and the share of the contact patch that the points do "
      "not cover");
  command.number("--max-time-factor", options->limits.time_factor, factors,
                 "By how much a time, as a multiple of the baseline's, or an instruction count may "
                 "grow, by the nearest ends of their spreads");
  command.number("--min-agree", options->limits.agreement, shares,
                 "Share of the configurations that agreed before that must agree still");
  command.text("--baseline", "CANDIDATE", options->limits.baseline,
               "Candidate that times are related to");
  command.list("--fail-on", "FAILURE", options->fail_on,
               "With time, exit code 1 also where something is slower; accuracy always counts");
  command.flag("--json", options->json, "Print one JSON object with every change");
  command.text("--html", "FILE", options->html,
               "Write a page too: both Pareto fronts, all changes");
  command.footer(
      "Examples:\n"
      "  touchstone compare old/report.json out/report.json\n"
      "  touchstone compare old/report.json out/report.json --html compare.html\n"
      "  touchstone compare rapier@0.20 rapier@0.21\n"
      "  touchstone compare old.json new.json --min-agree 0.99 --max-time-factor 1.2\n"
      "Exit code 1: something is worse beyond the limits, or, with --fail-on time,\n"
      "slower.");
  command.runs([options] { return run_compare(*options); });
}

}  // namespace touchstone
