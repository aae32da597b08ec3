#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "candidates/candidate_process.hpp"
#include "properties/identity.hpp"
#include "reports/score.hpp"

namespace touchstone {

// Options that mean the same in every subcommand. Each adds itself to the subcommand and is read
// after parsing.

/// --candidate FILE of the program itself: plug-ins beside the standard ones.
void add_plugin_option(CLI::App& program);

struct CandidateOption {
  explicit CandidateOption(CLI::App& command);
  /// In the order given; all of them by default. Throws InvalidInput on an unknown name.
  std::vector<const Candidate*> get() const;
  /// Throws InvalidInput unless both are positive and finite.
  Limits limits() const;

 private:
  std::vector<std::string> names_;
  Limits limits_;
};

struct BarOption {
  explicit BarOption(CLI::App& command);
  Bar get() const;  ///< throws InvalidInput unless both are finite and not negative

 private:
  Bar bar_;
};

}  // namespace touchstone
