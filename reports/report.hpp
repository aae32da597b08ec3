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
#include "properties/recorded.hpp"
#include "reports/casts.hpp"
#include "reports/stability/stability.hpp"
#include "reports/statistics.hpp"
#include "simulation/engines/run_engines.hpp"
#include "simulation/run_experiments.hpp"

namespace touchstone {

// The result of a run: filled once (make_report.hpp; a campaign's by campaigns/), then read by
// every writer: report.json, the terminal table, the pages, the figures, the comparison.
// docs/report.schema.json says what each member means; a member that report.json has too has the
// same name here.

struct Machine {
  std::string cpu, compiler, os;
  unsigned cores = 0;
};

struct CandidateDescription {
  std::string name, family, version, settings, models;
  std::string precision = {};   ///< "double" or "float"; empty: its settings say it
  std::string runs = "native";  ///< or "wasm", "script"
  bool given = false;           ///< its answers came in a file: it cannot be asked again
};

struct PoseClassDescription {
  std::string pair, pose_class, description, group, arrangement;
  std::vector<std::string> modifiers;
  /// Of answers that came in a file: tells their configurations from others. Empty: they are the
  /// first of the class.
  std::string digest = {};
};

/// Median and quartiles over repetitions.
struct Spread {
  double median, low, high;
};

/// The time of one query.
struct QueryTime {
  Spread nanoseconds;
  std::size_t repetitions = 0;
  /// What 95% of a class's configurations do not exceed, nanoseconds; in a summary, of the class
  /// where that is the most. Absent: they cannot be timed singly.
  std::optional<double> p95 = {};
  /// Median, in user space; absent: they cannot be counted.
  std::optional<double> instructions = {};
  std::optional<Spread> ratio_to_bullet = {};
  /// Of a candidate that is a command: medians over classes and repetitions.
  std::optional<QueryCost::Measured> measured = {};
};

/// The scores and times of one candidate: on one class or, in a summary, on the classes of one
/// group (group_name), of a pair or of all pairs.
struct ResultRow {
  std::string pair, pose_class, candidate;  ///< in a summary: or "all"; a group
  Statistics statistics;
  std::optional<QueryTime> time;
  /// Of one class: the worst configuration on which the candidate disagrees, if it does.
  std::optional<std::uint64_t> worst_index;
  // In a summary alone:
  std::optional<bool> pareto;  ///< on the front of speed and accuracy; absent: not in that chart
  std::vector<std::string> tied_with;  ///< candidates whose times overlap with this one's
};

/// Severity in one decade of a variable.
struct TrendBin {
  std::optional<int> decade;  ///< absent: zero
  std::uint64_t count = 0, missed = 0;
  double median = 0, max = 0;
};
struct Trend {
  std::string pair, group, candidate, variable;
  std::vector<TrendBin> bins;
};

/// How many of the configurations that a candidate was asked it does not agree on.
struct FailureRate {
  std::uint64_t count = 0, failed = 0;

  double share() const { return static_cast<double>(failed) / static_cast<double>(count); }
};

/// What raises a candidate's failure rate most (factors.hpp).
struct Factor {
  enum class Kind { arrangement, modifier };
  std::string pair, candidate;
  std::string group;  ///< of the classes with it
  Kind kind;
  std::string name;
  FailureRate with;
  double without;     ///< share of failures in what the classes with it are compared with
  std::string worst;  ///< identity of the worst failure in the class that fails most
};

/// An arrangement alone, and with one modifier.
struct Contrast {
  std::string pair, candidate, arrangement;
  std::string plain_class;  ///< what it is compared with: the arrangement, aligned if it can be
  std::string modifier;
  FailureRate plain, modified;
  double chance;      ///< p-value of Fisher's exact test
  bool fails;         ///< the candidate passes the one and clearly not the other
  std::string worst;  ///< identity of the worst failure with the modifier; empty: none
};

/// One candidate's answer to a configuration, judged.
struct ScoredAnswer {
  std::string candidate;
  Answer answer;
  Score score;
};

/// One configuration with its truth and what candidates make of it.
struct Examination {
  std::string id;  ///< an identity, or a file
  Configuration configuration;
  std::optional<oracle::Truth> truth;  ///< absent in a campaign, which keeps identities alone
  std::vector<ScoredAnswer> answers;
  std::string replay;  ///< the command that shows it again
};

/// One of the worst configurations of a pair × group × candidate.
struct WorstCase {
  std::string pair, group, pose_class, candidate;
  Score score;  ///< of that candidate
  Examination examination;
};

/// One pose of Drake's characterisation of its contact queries.
struct DrakeCase {
  std::string description;  ///< "cylinder edge against box face, far"
  Configuration configuration;
};

/// Largest errors by the protocol that Drake publishes its own by, metres.
struct DrakeProtocol {
  struct Published {
    std::string pair;
    std::optional<double> penetration, signed_distance;  ///< absent: Drake refuses
    std::vector<DrakeCase> configurations;
  };
  struct Result {
    std::string pair, candidate;
    std::uint64_t count = 0;
    std::map<Outcome, std::uint64_t> outcomes;
    std::optional<double> max_error;
    std::optional<std::size_t> worst;  ///< index of its configuration
  };
  double depth = 0;
  std::vector<Published> pairs;
  std::vector<Result> results;
};

/// A class of which the answers of an engine's release are clearly better or worse than those of
/// the release before (history.hpp).
struct ReleaseStep {
  std::string pair, pose_class;
  std::string candidate;  ///< the release
  double before, after;   ///< agreement
};
struct History {
  std::string engine;
  std::vector<ReleaseStep> steps;
};

struct Report {
  /// How much of a run there is.
  struct Extent {
    std::uint64_t classes = 0, configurations = 0;
  };

  bool is_old = false;  ///< read from a file of schema 1, without what knows of groups
  /// Read from a file before schema 3: contact points off the bodies agreed, and normals were
  /// judged against the whole bodies, however large.
  bool is_of_old_judge = false;
  std::string version, command;
  std::uint64_t seed = 0;
  double tolerance = 0, threshold = 0;
  Machine machine;
  std::uint64_t configurations = 0;
  bool partial = false;
  Extent planned, completed;
  std::uint64_t timed_classes = 0;
  double wall_seconds = 0;
  std::optional<Quantiles> oracle_microseconds;
  std::vector<CandidateDescription> candidates;
  std::vector<PoseClassDescription> classes;
  std::vector<ResultRow> results, summary;
  std::vector<Factor> factors;
  std::vector<Contrast> contrasts;
  std::vector<Trend> trends;
  std::vector<RecordedShare> recorded;  ///< of the pairs in the report
  std::optional<DrakeProtocol> drake_protocol;
  std::vector<WorstCase> worst;
  // Of a whole report, all pairs and classes:
  std::optional<Casts> casts;
  std::optional<Stability> stability;
  std::optional<ExperimentResults> experiments;
  std::optional<EngineResults> engines;
  std::optional<History> history;  ///< of the releases among the candidates, where it was asked for
};

}  // namespace touchstone
