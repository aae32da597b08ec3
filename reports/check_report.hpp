#pragma once

#include <string>
#include <vector>

#include "properties/laws/failure_file.hpp"
#include "reports/terminal.hpp"

namespace touchstone {

/// A line for each law and pair, and the simplest failure of each law with what is needed to see it
/// again.
std::string check_text(const std::vector<LawResult>& results, const Terminal& terminal = {});
std::string corpus_text(const std::vector<ReplayedFailure>& corpus);

/// For continuous integration: a test suite per candidate, a test case per law and pair, and one
/// per saved failure.
std::string junit_xml(const std::string& candidate, const std::vector<LawResult>& results,
                      const std::vector<ReplayedFailure>& corpus);

/// One JSON object (docs/check.md).
std::string check_json(const std::string& candidate, const CheckOptions& options,
                       const std::vector<LawResult>& results,
                       const std::vector<ReplayedFailure>& corpus);

}  // namespace touchstone
