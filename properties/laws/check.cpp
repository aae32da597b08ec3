#include "properties/laws/check.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "properties/laws/cause.hpp"
#include "properties/simplify.hpp"

namespace touchstone {
namespace {

std::vector<Identity> identities(const CheckOptions& options, Pair pair) {
  std::vector<Identity> result;
  for (const std::string& name : selected_classes(pair, {options.classes, options.groups})) {
    for (std::uint64_t i = 0; i < options.count; ++i) {
      result.push_back({pair, name, options.seed, i});
    }
  }
  return result;
}

/// How hard a failure is simplified: the first of its name, which is shown; and one of other
/// features, of which there may be a hundred.
constexpr int trials_of_first = 500, trials_of_others = 100;

Failure simplest(const Law& law, const Identity& identity, const Violation& violation,
                 const std::string& features, int max_trials, CandidateProcess& candidate,
                 const Bar& bar) {
  const auto fails_alike = [&](const Configuration& c) {
    const auto v = broken(law, c, candidate, bar);
    return v && v->failure == violation.failure &&
           (features.empty() || meeting_features(c) == features);
  };
  const Configuration c = simplified(make_configuration(identity), fails_alike, max_trials);
  const Violation of_simplest = broken(law, c, candidate, bar).value_or(violation);
  candidate.ask_within(bar.threshold);
  const Answer answer = candidate.answers({&c, 1}).front();
  return {law.name,
          candidate.candidate().name,
          candidate.candidate().version,
          to_string(identity),
          c,
          of_simplest,
          bar,
          answer,
          score(c, oracle::truth(c), answer, bar),
          features};
}

/// Adds the time of its life.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds), start_(Clock::now()) {}
  ~Stopwatch() { seconds_ += std::chrono::duration<double>(Clock::now() - start_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  double& seconds_;
  Clock::time_point start_;
};

}  // namespace

std::vector<LawResult> check(CandidateProcess& candidate, const CheckOptions& options,
                             const std::function<void(std::uint64_t, std::uint64_t)>& progress) {
  std::uint64_t all = 0, done = 0;
  for (const Pair pair : options.pairs) all += identities(options, pair).size();

  std::vector<LawResult> results;
  for (const Pair pair : options.pairs) {
    const std::vector<Identity> tried = identities(options, pair);
    if (tried.empty()) continue;
    const auto first = static_cast<std::ptrdiff_t>(results.size());
    for (const Law* law : options.laws) results.push_back({law, pair, 0, 0, {}, {}, 0});
    for (const Identity& identity : tried) {
      const Configuration c = make_configuration(identity);
      for (auto result = results.begin() + first; result != results.end(); ++result) {
        if (!result->law->applies(c)) continue;
        ++result->tried;
        const Stopwatch stopwatch(result->seconds);
        const auto violation = broken(*result->law, c, candidate, options.bar);
        if (!violation) continue;
        ++result->broken;
        const bool is_first = result->counts[violation->failure]++ == 0;
        const std::string features = options.by_features ? meeting_features(c) : "";
        const auto alike =
            std::find_if(result->failures.begin(), result->failures.end(), [&](const Failure& f) {
              return f.violation.failure == violation->failure && f.features == features;
            });
        if (alike != result->failures.end()) {
          ++alike->met;
          continue;
        }
        result->failures.push_back(simplest(*result->law, identity, *violation, features,
                                            is_first ? trials_of_first : trials_of_others,
                                            candidate, options.bar));
      }
      progress(++done, all);
    }
  }
  std::erase_if(results, [](const LawResult& result) { return result.tried == 0; });
  for (LawResult& result : results) {
    std::sort(result.failures.begin(), result.failures.end(), [](const auto& a, const auto& b) {
      return complexity(a.configuration) < complexity(b.configuration);
    });
  }
  return results;
}

}  // namespace touchstone
