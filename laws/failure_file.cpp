#include "laws/failure_file.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <memory>

#include "candidates/candidates.hpp"
#include "reference/invalid_input.hpp"
#include "reports/configuration_json.hpp"
#include "reports/write_file.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

constexpr const char* schema = "touchstone-failure-1";

std::string text(const json& object, const char* member) {
  if (!object.contains(member) || !object[member].is_string()) {
    throw InvalidInput(member, object.value(member, json()).dump(), "must be a string");
  }
  return object[member];
}

double number(const json& object, const char* member) {
  if (!object.contains(member) || !object[member].is_number()) {
    throw InvalidInput(member, object.value(member, json()).dump(), "must be a number");
  }
  return object[member];
}

ReplayedFailure replayed(const Failure& expected, const Limits& limits) {
  std::unique_ptr<CandidateProcess> process;
  try {
    process = std::make_unique<CandidateProcess>(find_candidate(expected.candidate),
                                                 expected.bar.threshold, limits);
  } catch (const InvalidInput&) {
    return {expected, ReplayedFailure::Result::skipped, "the candidate is not installed"};
  }
  const auto v = broken(find_law(expected.law), expected.configuration, *process, expected.bar);
  if (!v) return {expected, ReplayedFailure::Result::fixed, ""};
  const bool same = v->failure == expected.violation.failure;
  return {expected, same ? ReplayedFailure::Result::as_expected : ReplayedFailure::Result::changed,
          v->failure};
}

}  // namespace

json to_json(const Failure& f) {
  return {{"schema", schema},
          {"candidate", f.candidate},
          {"version", f.version},
          {"law", f.law},
          {"failure", f.violation.failure},
          {"detail", f.violation.detail},
          {"tolerance", f.bar.tolerance},
          {"threshold", f.bar.threshold},
          {"found", f.identity},
          {"configuration", to_hex_json(f.configuration)},
          {"decimal", to_json(f.configuration)},
          {"answer", f.answer}};
}

Failure failure_from_json(const json& object) {
  if (!object.is_object()) {
    throw InvalidInput("line", object.dump().substr(0, 60), "must be a JSON object");
  }
  if (text(object, "schema") != schema) {
    throw InvalidInput("schema", object["schema"].dump(), fmt::format("must be \"{}\"", schema));
  }
  const std::string failure = text(object, "failure");
  const auto& failures = all_failures();
  if (std::find(failures.begin(), failures.end(), failure) == failures.end()) {
    throw InvalidInput("failure", '"' + failure + '"',
                       fmt::format("must be one of {}", fmt::join(failures, ", ")));
  }
  return {find_law(text(object, "law")).name,
          text(object, "candidate"),
          text(object, "version"),
          text(object, "found"),
          configuration_from_json(object.value("configuration", json())).configuration,
          {failure, 0, text(object, "detail")},
          {number(object, "tolerance"), number(object, "threshold")},
          object.value("answer", json())};
}

std::filesystem::path save(const Failure& f, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::string name = fmt::format("{}-{}-{}-{}.json", f.candidate,
                                 pair_name(pair_of(f.configuration)), f.law, f.violation.failure);
  std::replace(name.begin(), name.end(), ':', '-');
  auto path = folder / name;
  write_file(path, to_json(f).dump(2) + '\n', "--save");
  return path;
}

std::vector<Failure> read_corpus(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder)) {
    throw InvalidInput("--corpus", '"' + folder.string() + '"', "must be a folder");
  }
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<Failure> corpus;
  for (const auto& file : files) {
    try {
      std::ifstream in(file);
      corpus.push_back(failure_from_json(json::parse(in)));
    } catch (const InvalidInput& e) {
      throw InvalidInput("--corpus", '"' + file.string() + '"', e.what());
    } catch (const json::exception& e) {
      throw InvalidInput("--corpus", '"' + file.string() + '"', "is no JSON object");
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
