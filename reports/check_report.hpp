#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "properties/laws/failure_file.hpp"

namespace touchstone {

/// A line per law and pair, and the simplest failure of each law with what is needed to see it
/// again.
std::string check_text(const std::vector<LawResult>& results);
std::string corpus_text(const std::vector<ReplayedFailure>& corpus);

/// For continuous integration: a test suite per candidate, a test case per law and pair, and one
/// per saved failure.
std::string junit_xml(const std::string& candidate, const std::vector<LawResult>& results,
                      const std::vector<ReplayedFailure>& corpus);

nlohmann::json to_json(const std::string& candidate, const CheckOptions& options,
                       const std::vector<LawResult>& results,
                       const std::vector<ReplayedFailure>& corpus);

}  // namespace touchstone
