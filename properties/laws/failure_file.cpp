#include "properties/laws/failure_file.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <span>

#include <nlohmann/json.hpp>

#include "candidates/candidates.hpp"
#include "candidates/readable.hpp"
#include "properties/files/answer_json.hpp"
#include "properties/files/configuration_json.hpp"
#include "properties/files/disk.hpp"
#include "properties/files/strict_json.hpp"
#include "properties/laws/cast_laws.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

constexpr const char* schema = "touchstone-failure-1";

std::string text(const json& object, const char* name) {
  return readable(string(member(object, name, ""), name));
}

/// A member of a bar, which must be what its option takes.
double bar_number(const json& object, const char* name) {
  const json& value = member(object, name, "");
  const double x = number(value, name);
  if (!(x >= 0)) throw InvalidInput(name, shown(value), "must not be negative");
  return x;
}

std::vector<std::filesystem::path> files_of(const std::filesystem::path& path, const char* field) {
  if (is_file(path)) return {path};
  if (!is_folder(path)) {
    throw InvalidInput(field, '"' + path.string() + '"', "must be a folder, or a file of failures");
  }
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(path)) {
    const auto extension = entry.path().extension();
    if (extension == ".json" || extension == ".jsonl") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

ReplayedFailure replayed(const Failure& expected, const Limits& limits) {
  using Result = ReplayedFailure::Result;
  const Candidate* candidate = nullptr;
  try {
    candidate = &find_candidate(expected.candidate);
  } catch (const InvalidInput&) {
    return {expected, Result::skipped, "the candidate is not installed"};
  }
  std::optional<Violation> v;
  if (expected.sweep) {
    const CastQuestion cast{expected.configuration, *expected.sweep};
    const auto ask = [&](std::span<const CastQuestion> q) { return ask_casts(*candidate, q); };
    if (!ask({&cast, 1}).front()) return {expected, Result::changed, "unsupported"};
    v = broken(*find_cast_law(expected.law), cast, ask, expected.bar);
  } else {
    if (!candidate->has_routine_for(pair_of(expected.configuration))) {
      return {expected, Result::changed, "unsupported"};
    }
    CandidateProcess process(*candidate, expected.bar.threshold, limits);
    v = broken(find_law(expected.law), expected.configuration, process, expected.bar);
  }
  if (!v) return {expected, Result::fixed, ""};
  const bool same = v->failure == expected.violation.failure;
  return {expected, same ? Result::as_expected : Result::changed, v->failure};
}

void append_failures(const std::string& text, std::vector<Failure>& corpus) {
  const std::vector<json> values = parse_json_lines(text, "it");
  for (std::size_t i = 0; i < values.size(); ++i) {
    try {
      corpus.push_back(failure_from_json(values[i]));
    } catch (const InvalidInput& e) {
      if (values.size() == 1) throw;
      throw e.within(fmt::format("failure {}", i + 1));
    }
  }
}

}  // namespace

json to_json(const Failure& f) {
  json result = {
      {"schema", schema},
      {"candidate", f.candidate},
      {"version", f.version},
      {"law", f.law},
      {"failure", f.violation.failure},
      {"detail", f.violation.detail},
      {"tolerance", f.bar.tolerance},
      {"threshold", f.bar.threshold},
      {"found", f.identity},
      {"configuration",
       to_hex_json(f.configuration, f.sweep ? std::optional(Sweep(*f.sweep)) : std::nullopt)},
      {"answer", f.answer ? to_json(*f.answer, f.score) : json(nullptr)}};
  if (!f.features.empty()) result["features"] = f.features;
  return result;
}

Failure failure_from_json(const json& object) {
  require_object(object, "failure");
  if (text(object, "schema") != schema) {
    throw InvalidInput("schema", shown(object["schema"]), fmt::format("must be \"{}\"", schema));
  }
  const std::string failure = text(object, "failure");
  const auto& failures = all_failures();
  if (std::find(failures.begin(), failures.end(), failure) == failures.end()) {
    throw InvalidInput("failure", shown(failure),
                       fmt::format("must be one of {}", fmt::join(failures, ", ")));
  }
  const std::string law = text(object, "law");
  const GivenConfiguration given = cast_from_json(member(object, "configuration", ""));
  const bool is_of_casts = find_cast_law(law);
  if (is_of_casts != given.sweep.has_value()) {
    throw InvalidInput("law", shown(law),
                       given.sweep ? "must be one of casts: its configuration has a sweep"
                                   : "must be one of contacts: its configuration has no sweep");
  }
  Failure result{is_of_casts ? law : find_law(law).name,
                 text(object, "candidate"),
                 text(object, "version"),
                 text(object, "found"),
                 given.configuration,
                 {failure, 0, text(object, "detail")},
                 {bar_number(object, "tolerance"), bar_number(object, "threshold")},
                 {},
                 {}};
  if (given.sweep) result.sweep = given.sweep->translation();
  if (object.contains("features")) result.features = text(object, "features");
  const json answer = object.value("answer", json());
  if (answer.is_null()) return result;
  require_object(answer, "answer");
  result.answer = answer_from_json(answer, "answer");
  result.score = score_from_json(answer, "answer");
  return result;
}

std::filesystem::path save(const Failure& f, const std::filesystem::path& folder) {
  check_writable(folder, "--save");
  std::string name =
      fmt::format("{}-{}-{}-{}{}{}.json", f.candidate, pair_name(pair_of(f.configuration)), f.law,
                  f.violation.failure, f.features.empty() ? "" : "-", f.features);
  std::replace(name.begin(), name.end(), ':', '-');
  auto path = folder / name;
  write_file(path, to_json(f).dump(2) + '\n', "--save");
  return path;
}

std::vector<Failure> read_corpus(const std::filesystem::path& path, const char* field) {
  std::vector<Failure> corpus;
  for (const auto& file : files_of(path, field)) {
    const std::string text = read_file(file, field);
    try {
      append_failures(text, corpus);
    } catch (const InvalidInput& e) {
      throw InvalidInput(field, '"' + file.string() + '"', e.what());
    }
  }
  return corpus;
}

std::vector<ReplayedFailure> replay(const std::vector<Failure>& corpus, const Limits& limits) {
  std::vector<ReplayedFailure> result;
  result.reserve(corpus.size());
  for (const Failure& failure : corpus) result.push_back(replayed(failure, limits));
  return result;
}

}  // namespace touchstone
