#include "reports/solve.hpp"

#include <fstream>
#include <iostream>
#include <memory>
#include <string>

#include "cli/command.hpp"
#include "cli/options.hpp"
#include "properties/files/disk.hpp"

namespace touchstone {
namespace {

struct SolveArguments {
  explicit SolveArguments(Command& command)
      : candidates(command), bar(command), workers(command, 1, "1") {}
  CandidateOption candidates;
  BarOption bar;
  WorkersOption workers;
  std::string file = "-";
  double width = 1e-30;
  bool audit = false, csv = false;
};

/// Bad lines make exit code 2, after all of them are answered; a contradiction ends all.
int run_solve(const SolveArguments& options) {
  const SolveOptions solving{
      options.candidates.get(),    options.width,         options.bar.get(), options.audit,
      options.candidates.limits(), options.workers.get(), options.csv};
  if (options.file == "-") return solve(std::cin, std::cout, solving) ? 0 : 2;
  std::ifstream in = opened(options.file, "file");
  return solve(in, std::cout, solving) ? 0 : 2;
}

}  // namespace

void add_solve(Program& program) {
  Command command =
      program.command("solve", "Truth, answers and scores for your own configurations");
  const auto options = std::make_shared<SolveArguments>(command);
  command.text("file", "FILE", options->file, "JSON Lines; - is standard input");
  command.number("--width", options->width, {1e-300, 1e30},
                 "Width of the truth, relative to the larger size");
  command.flag("--audit", options->audit, "Let the second oracle check every truth");
  command.flag("--csv", options->csv, "Print CSV, a row for each line and candidate");
  command.footer(
      "Examples:\n"
      "  touchstone solve poses.jsonl > answers.jsonl\n"
      "  touchstone solve poses.jsonl --workers 8 --csv > answers.csv\n"
      "  echo '{\"a\":{\"shape\":\"cylinder\",\"radius\":0.5,\"half_length\":1},\n"
      "         \"b\":{\"shape\":\"sphere\",\"radius\":1}}' | tr -d '\\n' | touchstone solve\n"
      "  touchstone solve --candidates bullet --width 1e-50 poses.jsonl\n"
      "Shapes: cylinder and capsule (radius, half_length), sphere (radius),\n"
      "box (half_extents), plane (normal, displacement).\n"
      "A pose has position and orientation (w, x, y, z), or rotation (a matrix), or axis\n"
      "(\"y\" or a vector: where the axis of the cylinder points).\n"
      "With one worker each line is answered as soon as it has come.");
  command.runs([options] { return run_solve(*options); });
}

}  // namespace touchstone
