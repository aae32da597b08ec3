#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "properties/laws/check.hpp"
#include "properties/laws/failure_file.hpp"
#include "reports/search.hpp"
#include "reports/terminal.hpp"

namespace touchstone {

/// What broke which law, with the truth, the answer and the command that shows it again, in a line
/// of its own however long.
std::string failure_text(const Failure& failure, const Terminal& terminal);

/// What `touchstone check` finds of a candidate.
struct CheckResult {
  std::string candidate;  ///< empty: saved failures alone were asked again
  std::vector<ReplayedFailure> corpus, known = {};  ///< saved failures, asked again
  std::vector<LawResult> laws = {};                 ///< of contacts, then of casts

  /// Whether a law is broken in a new way or a saved failure has changed. One that is known may be
  /// fixed, but has to be asked.
  bool has_failed() const;
};

/// A line for each law and pair, and the first failure of each with what is needed to see it again,
/// in the order of their groups; laws that one configuration breaks stand together.
std::string check_text(const std::vector<LawResult>& laws, const Terminal& terminal);
/// A line for each saved failure that was asked again.
std::string corpus_text(const std::vector<ReplayedFailure>& corpus, const Terminal& terminal);
/// One JSON object (docs/check.md).
nlohmann::json check_json(const CheckResult& result, const CheckOptions& options);
/// For continuous integration: a test suite per candidate, a test case per law and pair, and one
/// per saved failure. What is known is skipped and says so, as pytest writes failures that are
/// expected, for JUnit has no word of its own.
std::string junit_xml(const CheckResult& result);

/// What a search found: a line for each pair and goal, its failures, and the commands that show the
/// slowest configurations again; those of other goals that matter are failures.
std::string search_text(const SearchResult& result, const std::string& candidate,
                        const Terminal& terminal);

}  // namespace touchstone
