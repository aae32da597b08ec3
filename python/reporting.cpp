// Scores a Python function as a report does every candidate.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <thread>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "candidates/host/exchange.hpp"
#include "candidates/host/interruption.hpp"
#include "properties/files/disk.hpp"
#include "properties/files/given_text.hpp"
#include "python/parameters.hpp"
#include "reference/invalid_input.hpp"
#include "reports/make_report.hpp"
#include "reports/report_json.hpp"
#include "reports/terminal.hpp"

namespace touchstone::python {
namespace {

using Names = std::optional<std::vector<std::string>>;

/// What `report` is called with.
struct Request {
  py::function function;
  std::string name, version, settings;
  Names pairs, classes, groups;
  std::uint64_t count, seed;
  double tolerance, threshold;
  std::vector<std::string> candidates;
  double seconds;
  unsigned workers;
};

/// Throws InvalidInput unless reports and command lines can name a candidate so.
void check_name(const std::string& name) {
  if (is_candidate_name(name)) return;
  throw InvalidInput("name", py::repr(py::str(name)).cast<std::string>(),
                     std::string("must be ") + candidate_names);
}

Candidate candidate_of(const Request& request) {
  Candidate candidate;
  candidate.name = candidate.family = request.name;
  candidate.version = request.version;
  candidate.settings = request.settings;
  candidate.supports.fill(true);
  candidate.precision = "double";
  candidate.runs = "script";
  candidate.origin = [function = request.function, seconds = request.seconds,
                      owner = getpid()](const Limits&) -> std::unique_ptr<Respondent> {
    // A worker: Python must know that it was forked, as by os.fork.
    if (getpid() != owner) PyOS_AfterFork_Child();
    return function_respondent(function, seconds);
  };
  return candidate;
}

/// What `parse` makes of the names, each once; without names, all there is.
template <class Value, class Parse>
std::vector<Value> parsed(const Names& names, std::span<const Value> all, const Parse& parse) {
  if (!names) return {all.begin(), all.end()};
  std::vector<Value> result;
  for (const std::string& name : *names) {
    const Value value = parse(name);
    if (std::find(result.begin(), result.end(), value) == result.end()) result.push_back(value);
  }
  return result;
}

Campaign campaign_of(const Request& request, const Candidate& candidate) {
  Campaign c;
  c.pairs = parsed<Pair>(request.pairs, all_pairs,
                         [](const std::string& name) { return parse_pair(name, "pairs"); });
  c.classes = request.classes.value_or(c.classes);
  if (request.groups) {
    c.groups = parsed<Group>(request.groups, all_groups,
                             [](const std::string& name) { return parse_group(name); });
  }
  c.candidates = find_candidates(request.candidates);
  for (const Candidate* const other : c.candidates) {
    if (other->name != candidate.name) continue;
    throw InvalidInput("name", '"' + candidate.name + '"', "must not be that of another candidate");
  }
  c.candidates.push_back(&candidate);
  c.count = request.count;
  c.seed = request.seed;
  c.bar = {request.tolerance, request.threshold};
  c.workers =
      request.workers > 0 ? request.workers : std::max(1U, std::thread::hardware_concurrency());
  return c;
}

/// The call that gives the same report again.
std::string call_of(const Request& request) {
  const auto text = [](const auto& value) {
    return py::repr(py::cast(value)).template cast<std::string>();
  };
  return fmt::format(
      "touchstone.report({}, pairs={}, classes={}, groups={}, count={}, seed={}, candidates={}, "
      "tolerance={}, threshold={})",
      request.name, text(request.pairs), text(request.classes), text(request.groups), request.count,
      request.seed, text(request.candidates), text(request.tolerance), text(request.threshold));
}

Report report_of(const Request& request) {
  check_name(request.name);
  check_threshold(request.threshold);
  const auto refuse_unless = [](bool good, const char* field, double value, const char* remedy) {
    if (!good) throw InvalidInput(field, fmt::format("{}", value), remedy);
  };
  const auto count = static_cast<double>(request.count);
  refuse_unless(request.count > 0, "count", count, "must be at least 1");
  refuse_unless(request.tolerance > 0, "tolerance", request.tolerance, "must be positive");
  refuse_unless(request.seconds > 0 && std::isfinite(request.seconds), "seconds", request.seconds,
                "must be positive and finite");
  const Candidate candidate = candidate_of(request);
  const Campaign campaign = campaign_of(request, candidate);
  // What is in a buffer would be written by each worker.
  for (const char* const stream : {"stdout", "stderr"}) {
    py::module_::import("sys").attr(stream).attr("flush")();
  }
  const Interruption interruption;
  Report report = make_report(campaign, call_of(request));
  if (interrupted()) {
    PyErr_SetNone(PyExc_KeyboardInterrupt);
    throw py::error_already_set();
  }
  return report;
}

py::object dict_of(const Report& report) {
  return py::module_::import("json").attr("loads")(to_json(report).dump());
}

}  // namespace

void bind_report(py::module_& m) {
  py::class_<Report> type(m, "Report", R"(How a function compares with the truth: `report` gives it.

Printed, it is a table with a row for each pair and candidate.
)");
  type.def("to_dict", &dict_of, "The members of report.json (docs/report.schema.json), as a dict.");
  type.def(
      "save",
      [](const Report& report, const std::filesystem::path& folder) {
        check_writable(folder);
        write_report(report, folder);
      },
      py::arg("folder"), R"(save(folder)

Writes report.json and report.html, which needs no network, into a folder; makes the folder.
)");
  type.def(
      "save",
      [refused = refusal("Report.save", {parameter_of<std::filesystem::path>(py::arg("folder"))})](
          const Report&, const AnyFirst& first, const py::args& others, const py::kwargs& named) {
        return refused(first, others, named);
      },
      first_may_lack());
  type.def("__str__", [](const Report& report) { return terminal_table(report); });
  type.def("__repr__", [](const Report& report) {
    return fmt::format("<touchstone.Report: {}, {}>",
                       counted(report.configurations, "configuration"),
                       counted(report.candidates.size(), "candidate"));
  });

  define(
      m, "report",
      +[](py::function function, const std::string& name, const Names& pairs, const Names& classes,
          const Names& groups, std::uint64_t count, std::uint64_t seed,
          const std::vector<std::string>& candidates, double tolerance, double threshold,
          double seconds, unsigned workers, const std::string& version,
          const std::string& settings) {
        return report_of({std::move(function), name, version, settings, pairs, classes, groups,
                          count, seed, tolerance, threshold, candidates, seconds, workers});
      },
      R"(report(function, name="function", pairs=None, classes=None, groups=None, count=20, seed=1,
       candidates=("reference",), tolerance=1e-4, threshold=0.0, seconds=5.0, workers=0,
       version="", settings="a Python function")

Scores function(a, pose_a, b, pose_b, threshold) as `touchstone report` scores every candidate, and
returns a Report.

The function returns a Contact; None where the bodies are more than `threshold` metres apart; or
NotImplemented where it has no routine for the shape of b. What it raises is the outcome "failed",
with its text as the reason, as is any other result; a NaN in a contact is "not-finite".

`count` configurations of each class of the pairs, classes and groups (None: all) are drawn by
`seed`. `candidates` are engines that are scored beside it ("bullet", "prism:16"). An answer agrees
within `tolerance`, relative to the size. The function is called in `workers` processes forked from
this one (0: one a core), then in this one to be timed: what it changes elsewhere is lost or done
again. A call that takes more than `seconds` by the clock is ended and counts as "timed-out"; that
cannot end compiled code, and what crashes ends the report. For such engines there is
`touchstone --candidate-command` (docs/engine.md).

>>> def nothing(a, pose_a, b, pose_b, threshold):
...     return None
>>> r = touchstone.report(nothing, "nothing", ["cylinder-plane"], ["lying"], count=2, candidates=[])
>>> [row["outcomes"] for row in r.to_dict()["results"]]
[{'missed': 1, 'unseen': 1}]
)",
      py::arg("function"), py::arg("name") = "function", py::arg("pairs") = py::none(),
      py::arg("classes") = py::none(), py::arg("groups") = py::none(), py::arg("count") = 20,
      py::arg("seed") = 1, py::arg("candidates") = std::vector<std::string>{"reference"},
      py::arg("tolerance") = Bar{}.tolerance, py::arg("threshold") = Bar{}.threshold,
      py::arg("seconds") = 5.0, py::arg("workers") = 0, py::arg("version") = "",
      py::arg("settings") = "a Python function");
}

}  // namespace touchstone::python
