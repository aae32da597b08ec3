#pragma once

#include <array>
#include <cstdint>
#include <iosfwd>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "properties/files/configuration_json.hpp"
#include "reports/report.hpp"

namespace touchstone {

// Files of answers that were computed elsewhere (docs/your-poses.md).

/// An answer that was computed elsewhere; smaller than an Answer, for there may be a million.
struct GivenAnswer {
  std::string id;
  std::uint64_t index;  ///< of the identity; in the class "given", of the configuration in its file
  std::optional<Configuration> configuration;  ///< absent: the identity's
  ts_status status;
  double signed_distance;
  Vec3 normal;
  std::vector<ts_point> points;
  /// Radii by which the routine rounds the bodies, where it says so.
  std::optional<std::array<double, 2>> roundings;

  Answer answer() const;
};

/// Answers that were computed elsewhere, to be scored like those of a candidate that is asked.
struct GivenAnswers {
  struct OfCell {
    PoseClass cell;
    std::vector<GivenAnswer> answers;  ///< no two with the same index
  };
  Candidate candidate;  ///< what is said of it: name, version, settings
  std::vector<OfCell> cells;
};

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
  /// Reads JSON Lines with an "id" each. Throws InvalidInput that names the line.
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

/// The report of answers of this seed, scored in so many workers, as of a candidate that is asked.
Report report_of(const GivenAnswers& given, std::uint64_t seed, const Bar& bar, unsigned workers,
                 const std::string& command);

}  // namespace touchstone
