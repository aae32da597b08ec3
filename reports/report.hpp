#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "candidates/host/candidate_process.hpp"
#include "oracle/judge/score.hpp"
#include "oracle/truth.hpp"
#include "properties/identity.hpp"
#include "reports/statistics.hpp"

namespace touchstone {

// The result of a run: filled once (make_report.hpp), then read by every writer: report.json, the
// terminal table, the pages, the figures, the comparison. docs/report-schema.md says what each
// member means; here a member has the name that report.json gives it where both can.

struct Machine {
  std::string cpu, compiler, os;
  unsigned cores = 0;
};

struct CandidateDescription {
  std::string name, family, version, settings, models;
};

struct PoseClassDescription {
  std::string pair, pose_class, description;
};

/// Median and quartiles over repetitions.
struct Spread {
  double median, low, high;
};

/// What one query costs.
struct QueryTime {
  Spread nanoseconds;
  std::size_t repetitions = 0;
  std::optional<double> instructions;  ///< median, in user space
  std::optional<Spread> ratio_to_bullet;
};

/// The scores and times of one candidate on one class, on all classes of a pair, or on everything.
struct ResultRow {
  std::string pair, pose_class, candidate;  ///< pair and class may be "all"
  Statistics statistics;
  std::optional<QueryTime> time;
  // In a summary:
  std::optional<bool> pareto;          ///< on the front of speed and accuracy; absent: not in it
  std::vector<std::string> tied_with;  ///< candidates that take the same time
};

/// Severity in one decade of a variable.
struct TrendBin {
  std::optional<int> decade;  ///< absent: zero
  std::size_t count = 0, missed = 0;
  double median = 0, max = 0;
};
struct Trend {
  std::string pair, candidate, variable;
  std::vector<TrendBin> bins;
};

/// One candidate's answer to a configuration, judged.
struct ScoredAnswer {
  std::string candidate;
  Answer answer;
  Score score;
};

/// One configuration with its truth and what candidates make of it.
struct Examination {
  Subject subject;
  oracle::Truth truth;
  std::vector<ScoredAnswer> answers;
  std::string replay;  ///< command
};

/// One of the worst configurations of a pair × candidate.
struct WorstCase {
  std::string pair, pose_class, candidate;
  Score score;  ///< of that candidate
  Examination examination;
};

/// Largest errors by the protocol that Drake publishes its own by, metres.
struct DrakeProtocol {
  struct Published {
    std::string pair;
    std::optional<double> penetration, signed_distance;  ///< absent: Drake refuses
    std::size_t configurations = 0;
  };
  struct Result {
    std::string pair, candidate;
    std::size_t count = 0;
    std::map<Outcome, std::size_t> outcomes;
    std::optional<double> max_error;
    std::optional<std::size_t> worst;  ///< index of its configuration
  };
  double depth = 0;
  std::vector<Published> pairs;
  std::vector<Result> results;
};

struct Report {
  std::string version, command;
  std::uint64_t seed = 0;
  double tolerance = 0, threshold = 0;
  Machine machine;
  std::uint64_t configurations = 0;
  bool partial = false;
  struct Amount {
    std::uint64_t classes = 0, configurations = 0;
  };
  Amount planned, completed;
  std::uint64_t timed_classes = 0;
  double wall_seconds = 0;
  std::optional<Quantiles> oracle_microseconds;
  std::vector<CandidateDescription> candidates;
  std::vector<PoseClassDescription> classes;
  std::vector<ResultRow> results, summary;
  std::vector<Trend> trends;
  std::optional<DrakeProtocol> drake_protocol;
  std::vector<WorstCase> worst;
};

}  // namespace touchstone
