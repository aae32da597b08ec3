#include "reports/compare.hpp"

#include <cmath>
#include <fmt/format.h>
#include <memory>

#include "cli/commands.hpp"
#include "reference/invalid_input.hpp"
#include "reports/compare_page/compare_page.hpp"
#include "reports/report_file.hpp"
#include "reports/write_file.hpp"

namespace touchstone {
namespace {

struct Options {
  std::string before, after, html;
  CompareLimits limits;
  bool json = false;

  void check() const {
    const auto must = [](bool good, const char* field, double value, const char* remedy) {
      if (!good) throw InvalidInput(field, fmt::format("{}", value), remedy);
    };
    constexpr const char* factor = "must be a finite number, at least 1";
    const auto is_factor = [](double f) { return std::isfinite(f) && f >= 1; };
    must(is_factor(limits.error_factor), "--max-error-factor", limits.error_factor, factor);
    must(is_factor(limits.time_factor), "--max-time-factor", limits.time_factor, factor);
    must(limits.agreement >= 0 && limits.agreement <= 1, "--min-agree", limits.agreement,
         "must be from 0 to 1");
  }
};

int run(const Options& options) {
  options.check();
  const nlohmann::json before = read_report(options.before), after = read_report(options.after);
  const nlohmann::json comparison = compare(before, after, options.limits);
  if (!options.html.empty()) {
    write_file(options.html, compare_page(comparison, before, after), "--html");
  }
  fmt::print("{}", options.json ? comparison.dump() + '\n' : comparison_text(comparison));
  return has_regressed(comparison) ? 1 : 0;
}

}  // namespace

void add_compare(CLI::App& program, int& exit_code) {
  CLI::App* command =
      program.add_subcommand("compare", "What is better, worse or slower than in another report");
  const auto options = std::make_shared<Options>();
  command->add_option("OLD", options->before, "report.json to compare with")->required();
  command->add_option("NEW", options->after, "report.json that may be worse")->required();
  command
      ->add_option("--max-error-factor", options->limits.error_factor,
                   "By how much an error may grow, and the share of the contact patch that the "
                   "points do not cover")
      ->capture_default_str();
  command
      ->add_option("--max-time-factor", options->limits.time_factor,
                   "By how much a time, as a multiple of the baseline's, or an instruction count "
                   "may grow, by the nearest ends of their spreads")
      ->capture_default_str();
  command
      ->add_option("--min-agree", options->limits.agreement,
                   "Share of the configurations that agreed before that must agree still")
      ->capture_default_str();
  command->add_option("--baseline", options->limits.baseline, "Candidate that times are related to")
      ->capture_default_str();
  command->add_flag("--json", options->json, "Print one JSON object with every change");
  command->add_option("--html", options->html, "Write a page too: both Pareto fronts, all changes");
  command->footer(
      "Examples:\n"
      "  touchstone compare old/report.json out/report.json\n"
      "  touchstone compare old/report.json out/report.json --html compare.html\n"
      "  touchstone compare old.json new.json --min-agree 0.99 --max-time-factor 1.2\n"
      "Exit code 1: something is worse or slower beyond the limits.");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace touchstone
