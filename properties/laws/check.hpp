#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "candidates/host/ask_cast.hpp"
#include "properties/identity.hpp"
#include "properties/laws/law.hpp"

namespace touchstone {

struct CheckOptions {
  std::vector<const Law*> laws;
  std::vector<Pair> pairs;
  std::vector<std::string> classes;  ///< of every pair that has them; empty for all
  std::vector<Group> groups;         ///< empty for all
  std::uint64_t count = 10;          ///< configurations of each pair and pose class
  std::uint64_t seed = 1;
  Bar bar;
  bool by_features = false;  ///< tell failures of one name apart by the features that meet
  unsigned workers = 1;      ///< processes that ask; they do not change the result
};

/// A configuration that breaks a law: the first one met, and a simpler one that fails alike.
struct Failure {
  std::string law;
  std::string candidate, version;
  std::string identity;         ///< of the first one met
  Configuration configuration;  ///< the simpler one
  Violation violation;          ///< by the simpler one
  Bar bar;
  std::optional<ts_answer> answer;  ///< to the simpler one; absent where it is not known
  Score score;                      ///< of that answer
  std::string features = {};        ///< that meet (meeting_features); empty where nobody has looked
  std::uint64_t met = 1;            ///< configurations that failed alike
  std::optional<Vec3> sweep = {};   ///< of A, metres, world frame, where it is a cast that failed
};

/// The group of the pose class in which it was met first; absent where that is none of today's.
std::optional<Group> group_met(const Failure& failure);
/// Groups by how much they matter to a user: everyday, degenerate, recorded, extreme; then none.
int order_of(std::optional<Group> group);

/// One law, of contacts or of casts, on one pair.
struct LawResult {
  std::string law;
  Pair pair;
  std::uint64_t tried = 0, broken = 0;
  std::uint64_t unsupported = 0;  ///< configurations that the candidate has no routine for
  std::map<std::string, std::uint64_t> counts = {};  ///< of configurations, by the failure's name
  /// One of each name (and features), in the order of their groups, of a group the simplest first.
  std::vector<Failure> failures = {};
  /// An equal part of what the pair's configurations took, which all laws are asked about together.
  double seconds = 0;
  /// Like `counts`, of the configurations that new_ones has taken from there.
  std::map<std::string, std::uint64_t> known = {};
};

/// Tries every law on every configuration and simplifies the first failure of each name, or of each
/// name and features, keeping both; classes come in the order of their groups. The configurations
/// of a chunk are asked in one session of `candidate`, or of a worker's own process. What is shown
/// fails in a session of its own, too, and so does a sample of what is counted; all of it where the
/// sample or the law "memory" says that answers depend on earlier questions. `progress` is told how
/// many configurations are done, of how many.
std::vector<LawResult> check(CandidateProcess& candidate, const CheckOptions& options,
                             const std::function<void(std::uint64_t, std::uint64_t)>& progress);

/// A configuration that breaks a law, as it was met.
struct MetFailure {
  const Law* law;
  std::string identity;  ///< its own, or that of what it grew from
  Configuration configuration;
  Violation violation;
  std::string features = {};  ///< that meet; empty where nobody has looked
};
template <class Archive>
void members(Archive& a, MetFailure& f) {
  std::string law = f.law ? f.law->name : "";
  a(law, f.identity, f.configuration, f.violation, f.features);
  if constexpr (Archive::reads) f.law = &find_law(law);
}

/// Simplifies it, with at most `max_trials`, for as long as it fails by the same name, and the same
/// features meet where they are known.
Configuration simplest(const MetFailure& met, int max_trials, CandidateProcess& candidate,
                       const Bar& bar);
/// What is kept of it: `simple` is what it was simplified to.
Failure failure_of(const MetFailure& met, const Configuration& simple, CandidateProcess& candidate,
                   const Bar& bar);

/// Trials to simplify a failure: the first of its name, which is shown, and each of the others,
/// which may be a hundred.
inline constexpr int trials_of_first = 500, trials_of_others = 100;

/// The features of both bodies that meet along the optimal normal, A's first, as in "rim-face": of
/// a cylinder cap, side or rim, of a capsule side or end, of a box face, edge or vertex. A normal
/// within 1e-6 rad of an axis counts as along it, since no engine tells them apart. "tied" where
/// several normals are optimal.
std::string meeting_features(const Configuration& configuration);
/// Those of a cast meet where A touches B; of a sweep without a touch, "apart".
std::string meeting_features(const CastQuestion& cast);

/// What failures have in common that are likely to have one cause.
struct Cause {
  std::string law;
  Pair pair;
  std::string features, failure;

  bool operator==(const Cause&) const = default;
  bool operator<(const Cause& other) const;
};
Cause cause_of(const Failure& failure);
/// "agreement, cylinder-box, rim-face, missed"
std::string to_string(const Cause& cause);

/// Those of all laws, the one to start with first: in the order of the laws, for a routine that
/// breaks one often breaks later ones by it; of a law in the order of the groups, then the most
/// frequent first, then the simplest.
std::vector<Failure> in_order(const std::vector<LawResult>& results);

/// The results without failures whose cause is that of a known one, which are counted as known;
/// what is left is new.
std::vector<LawResult> new_ones(std::vector<LawResult> results, const std::vector<Failure>& known);

}  // namespace touchstone
