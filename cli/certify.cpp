#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>

#include "audit/certificate.hpp"
#include "cli/commands.hpp"
#include "properties/identity.hpp"
#include "reference/invalid_input.hpp"
#include "reports/certificate_json.hpp"
#include "reports/configuration_json.hpp"

namespace touchstone {
namespace {

struct Options {
  std::string input;
  audit::Budget budget{1e-30, 4000};
};

/// The first line that is not blank.
Configuration read_configuration(std::istream& in) {
  std::string line;
  while (std::getline(in, line) && line.find_first_not_of(" \t\r") == std::string::npos) {
  }
  try {
    return configuration_from_json(nlohmann::json::parse(line)).configuration;
  } catch (const nlohmann::json::exception& e) {
    throw InvalidInput("line", '"' + line.substr(0, 60) + '"', "must be a JSON object");
  }
}

Configuration configuration(const std::string& input) {
  if (input == "-") return read_configuration(std::cin);
  if (!std::filesystem::is_regular_file(input)) return make_configuration(parse_identity(input));
  std::ifstream file(input);
  if (!file) throw InvalidInput("input", '"' + input + '"', "could not be opened for reading");
  return read_configuration(file);
}

void run(const Options& options) {
  const auto [width, cells] = options.budget;
  if (!(std::isfinite(width) && width > 0)) {
    throw InvalidInput("--width", fmt::format("{}", width), "must be positive and finite");
  }
  if (cells < 0) throw InvalidInput("--cells", fmt::format("{}", cells), "must not be negative");
  const Configuration c = configuration(options.input);
  const audit::Certificate certificate = audit::certify(c, options.budget);
  fmt::print("{}\n", to_json(certificate, c).dump());
}

}  // namespace

void add_certify(CLI::App& program, int&) {
  CLI::App* command =
      program.add_subcommand("certify", "Prove one signed distance: a file that others can check");
  const auto options = std::make_shared<Options>();
  command
      ->add_option(
          "input", options->input,
          "pair/class/seed/index, a file with a line as for solve, or - for standard input")
      ->required();
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
