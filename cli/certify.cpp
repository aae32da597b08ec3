#include <fmt/format.h>
#include <memory>
#include <string>

#include "cli/command.hpp"
#include "oracle/audit/certificate.hpp"
#include "properties/files/configuration_json.hpp"
#include "reports/second_oracle.hpp"

namespace touchstone {
namespace {

struct Options {
  std::string input;
  double width = 1e-30;
  std::uint64_t cells = 4000;
};

int run(const Options& options) {
  const Configuration c = given_configuration(options.input).configuration;
  const audit::Certificate certificate =
      audit::certify(c, {options.width, static_cast<int>(options.cells)});
  fmt::print("{}\n", certificate_json(certificate, c));
  return 0;
}

}  // namespace

void add_certify(Program& program) {
  Command command =
      program.command("certify", "Prove one signed distance: a file that others can check");
  const auto options = std::make_shared<Options>();
  command.text("input", options->input, given_help).value("IDENTITY").required();
  command.number("--width", options->width, {1e-60, 1e30},
                 "Width to prove, relative to the larger size; down to 1e-60");
  command.count("--cells", options->cells, {0, 1000000},
                "End at so many cells of directions, with the width reached by then");
  command.footer(
      "Examples:\n"
      "  touchstone certify cylinder-box/parallel+tilted-1e-6/42/137 > proof.json\n"
      "  touchstone certify --width 1e-12 pose.jsonl > proof.json\n"
      "  python3 oracle/check_certificate.py proof.json");
  command.runs([options] { return run(*options); });
}

}  // namespace touchstone
