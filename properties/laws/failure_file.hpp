#pragma once

#include <filesystem>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "properties/laws/check.hpp"

namespace touchstone {

/// Writes a failure as a file keeps it (docs/check.md): explicit numbers, so that it can be
/// replayed without this program's generators.
nlohmann::json to_json(const Failure& failure);
/// Reads what to_json wrote. Throws InvalidInput naming the member, its value and what it must be.
Failure failure_from_json(const nlohmann::json& json);

/// Writes one file into the folder, which is made if need be; named after candidate, law, pair and
/// failure, and after its features where they are known, so that the same failure replaces itself.
std::filesystem::path save(const Failure& failure, const std::filesystem::path& folder);

/// The failures of a file, or of a folder's .json and .jsonl files in order of their names. A file
/// holds one failure, or JSON Lines with one each. Throws InvalidInput naming the option `field`
/// and the file that cannot be read or understood.
std::vector<Failure> read_corpus(const std::filesystem::path& path, const char* field = "--corpus");

/// A saved failure, and what its candidate does today.
struct ReplayedFailure {
  enum class Result { as_expected, fixed, changed, skipped };
  Failure expected;
  Result result;
  std::string now;  ///< the failure's name today, or why it was skipped; empty when fixed
};

/// Asks every failure's candidate again; one that is not installed is skipped.
std::vector<ReplayedFailure> replay(const std::vector<Failure>& corpus, const Limits& limits);

}  // namespace touchstone
