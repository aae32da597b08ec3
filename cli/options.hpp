#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "candidates/candidate.h"
#include "properties/identity.hpp"
#include "reports/score.hpp"

namespace touchstone {

// Options that mean the same in every subcommand. Each adds itself to the subcommand and is read
// after parsing.

struct CandidateOption {
  explicit CandidateOption(CLI::App& command);
  /// In the order given; all of them by default. Throws InvalidInput on an unknown name.
  std::vector<const ts_candidate*> get() const;

 private:
  std::vector<std::string> names_;
};

struct BarOption {
  explicit BarOption(CLI::App& command);
  Bar get() const;  ///< throws InvalidInput unless both are finite and not negative

 private:
  Bar bar_;
};

}  // namespace touchstone
