#pragma once

#include <cstdint>
#include <iosfwd>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "properties/files/configuration_json.hpp"
#include "reports/campaign.hpp"

namespace touchstone {

// Files of answers that were computed elsewhere (docs/suite.md).

/// What is said of the routine that gave the answers, in place of the file's first line.
struct GivenDescription {
  std::optional<std::string> name, version, settings;
};

/// Configurations by their ids, as files for `solve` have them.
class ConfigurationFile {
 public:
  struct Entry {
    std::uint64_t number;  ///< in the file, from 0
    GivenConfiguration given;
  };
  ConfigurationFile() = default;
  /// Reads JSON Lines with an "id" each, a string or a number. Throws InvalidInput that names the
  /// line.
  explicit ConfigurationFile(std::istream& in);

  /// Null without such an id.
  const Entry* find(const std::string& id) const;
  const std::map<std::string, Entry>& entries() const { return entries_; }

 private:
  std::map<std::string, Entry> entries_;
};

/// Which configurations have to be answered.
struct Wanted {
  const ConfigurationFile* file = nullptr;  ///< all of its; ids may be identities besides
  std::vector<Identity> identities;         ///< and these
};

/// A line that could not be used, or an answer that is missing (line 0).
struct AnswerError {
  std::uint64_t line;
  std::string field, error;
};

struct ReadAnswers {
  GivenAnswers answers;
  std::uint64_t seed = 1, count = 0;
  std::vector<AnswerError> errors;
};

/// Reads JSON Lines: perhaps {"candidate": …, "version": …, "settings": …}, then an answer a line,
/// {"id", "status", "signed_distance", "normal", "points"}. A line that cannot be used is told
/// among the errors, and the others count. Throws InvalidInput where no name is given to the
/// routine, or an improper one.
ReadAnswers read_answers(std::istream& in, const GivenDescription& description,
                         const Wanted& wanted);

}  // namespace touchstone
