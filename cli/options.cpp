#include "cli/options.hpp"

#include <cmath>
#include <fmt/format.h>

#include "candidates/candidates.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {

CandidateOption::CandidateOption(CLI::App& command) {
  command.add_option("--candidates", names_, "Only these, separated by commas (default: all)")
      ->delimiter(',');
}

std::vector<const ts_candidate*> CandidateOption::get() const {
  const auto all = all_candidates();
  if (names_.empty()) return {all.begin(), all.end()};
  std::vector<const ts_candidate*> chosen;
  for (const auto& name : names_) chosen.push_back(&find_candidate(name));
  return chosen;
}

BarOption::BarOption(CLI::App& command) {
  command
      .add_option("--tolerance", bar_.tolerance,
                  "Agreement in depth and normal regret, relative to the smaller shape's size")
      ->capture_default_str();
  command
      .add_option("--threshold", bar_.threshold, "Ask for contacts up to this far apart, metres")
      ->capture_default_str();
}

Bar BarOption::get() const {
  const auto check = [](const char* field, double value) {
    if (!(std::isfinite(value) && value >= 0)) {
      throw InvalidInput(field, fmt::format("{}", value), "must be finite and not negative");
    }
  };
  check("--tolerance", bar_.tolerance);
  check("--threshold", bar_.threshold);
  return bar_;
}

}  // namespace touchstone
