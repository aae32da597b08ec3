#include <fmt/format.h>
#include <memory>
#include <string>

#include "cli/commands.hpp"
#include "cli/given.hpp"
#include "cli/number_option.hpp"
#include "oracle/audit/certificate.hpp"
#include "reports/certificate_json.hpp"

namespace touchstone {
namespace {

struct Options {
  std::string input;
  double width = 1e-30;
  std::uint64_t cells = 4000;
};

void run(const Options& options) {
  const Configuration c = given_configuration(options.input).configuration;
  const audit::Certificate certificate =
      audit::certify(c, {options.width, static_cast<int>(options.cells)});
  fmt::print("{}\n", to_json(certificate, c).dump());
}

}  // namespace

void add_certify(CLI::App& program, int&) {
  CLI::App* command =
      program.add_subcommand("certify", "Prove one signed distance: a file that others can check");
  const auto options = std::make_shared<Options>();
  command->add_option("input", options->input, given_help)->required();
  add_number(*command, "--width", options->width, {1e-60, 1e30},
             "Width to prove, relative to the larger size; down to 1e-60");
  add_count(*command, "--cells", options->cells, {0, 1000000},
            "End at so many cells of directions, with the width reached by then");
  command->footer(
      "Examples:\n"
      "  touchstone certify cylinder-box/near-parallel-1e-6/42/137 > proof.json\n"
      "  touchstone certify --width 1e-12 pose.jsonl > proof.json\n"
      "  python3 oracle/check_certificate.py proof.json");
  command->callback([options] { run(*options); });
}

}  // namespace touchstone
