#pragma once

#include <algorithm>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "candidates/candidates.hpp"
#include "reports/make_report.hpp"
#include "reports/report_json.hpp"

// What the tests of several sources look at.

namespace touchstone {

/// Loads one of the tests' own plug-ins, unless another test has.
inline void add_test_plugin(const char* name) {
  const auto file = std::filesystem::canonical(TOUCHSTONE_TEST_PLUGINS) / name;
  const auto is = [&](const Added& a) { return a.value == file.string(); };
  if (std::ranges::none_of(added_candidates(), is)) add_file(file);
}

/// Our own routines and three engines; the others differ in nothing that is tested.
inline Campaign some_configurations(unsigned workers = 2) {
  return {.pairs = {Pair::plane, Pair::box},
          .classes = {"general-shallow", "touching", "concentric"},
          .candidates = find_candidates({"reference", "bullet", "ode", "prism:8"}),
          .count = 4,
          .seed = 5,
          .workers = workers};
}

/// Their report, made once.
inline const Report& report_of_some() {
  static const Report report = make_report(some_configurations(), "x");
  return report;
}

inline nlohmann::json report_of(const Campaign& campaign) {
  return to_json(make_report(campaign, "x"));
}

/// A report but for what is said of times, which differ.
inline nlohmann::json without_times(nlohmann::json report) {
  for (const char* list : {"results", "summary"}) {
    for (nlohmann::json& row : report[list]) {
      for (const char* timed : {"nanoseconds", "pareto", "tied_with"}) row.erase(timed);
    }
  }
  for (const char* timed : {"wall_seconds", "oracle_microseconds"}) report.erase(timed);
  return report;
}

}  // namespace touchstone
