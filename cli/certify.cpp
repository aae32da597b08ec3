#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <string>

#include "audit/certificate.hpp"
#include "cli/commands.hpp"
#include "cli/given.hpp"
#include "reference/invalid_input.hpp"
#include "reports/certificate_json.hpp"

namespace touchstone {
namespace {

struct Options {
  std::string input;
  audit::Budget budget{1e-30, 4000};
};

void run(const Options& options) {
  const auto [width, cells] = options.budget;
  if (!(std::isfinite(width) && width > 0)) {
    throw InvalidInput("--width", fmt::format("{}", width), "must be positive and finite");
  }
  if (cells < 0) throw InvalidInput("--cells", fmt::format("{}", cells), "must not be negative");
  const Configuration c = given_configuration(options.input).configuration;
  const audit::Certificate certificate = audit::certify(c, options.budget);
  fmt::print("{}\n", to_json(certificate, c).dump());
}

}  // namespace

void add_certify(CLI::App& program, int&) {
  CLI::App* command =
      program.add_subcommand("certify", "Prove one signed distance: a file that others can check");
  const auto options = std::make_shared<Options>();
  command->add_option("input", options->input, given_help)->required();
  command
      ->add_option("--width", options->budget.width,
                   "Width to prove, relative to the larger size; down to 1e-60")
      ->capture_default_str();
  command
      ->add_option("--cells", options->budget.cells,
                   "End at so many cells of directions, with the width reached by then")
      ->capture_default_str();
  command->footer(
      "Examples:\n"
      "  touchstone certify cylinder-box/near-parallel-1e-6/42/137 > proof.json\n"
      "  touchstone certify --width 1e-12 pose.jsonl > proof.json\n"
      "  python3 oracle/check_certificate.py proof.json");
  command->callback([options] { run(*options); });
}

}  // namespace touchstone
