#include "properties/laws/check.hpp"

#include <algorithm>
#include <chrono>
#include <set>
#include <tuple>
#include <utility>

#include "candidates/host/worker_processes.hpp"
#include "oracle/truth.hpp"
#include "properties/files/bytes.hpp"
#include "properties/simplify.hpp"

namespace touchstone {
namespace {

/// Configurations of one pair, which are asked in one session: what a worker does at a time. Always
/// the same ones, whatever the number of workers.
struct Chunk {
  Pair pair;
  std::vector<Identity> identities;
};

/// A session costs as much as some hundred answers, so that more configurations share one; but few
/// enough to share the work out.
std::size_t chunk_size(std::uint64_t configurations) {
  constexpr std::uint64_t min = 16, max = 64, wanted_chunks = 64;
  return std::clamp(configurations / wanted_chunks, min, max);
}

std::vector<Chunk> chunks(const CheckOptions& options) {
  std::vector<Chunk> result;
  std::vector<Identity> all;
  for (const Pair pair : options.pairs) {
    std::vector<PoseClass> classes = selected(pair, {options.classes, options.groups});
    std::stable_sort(classes.begin(), classes.end(), [&](const PoseClass& a, const PoseClass& b) {
      return order_of(a.group()) < order_of(b.group());
    });
    for (const PoseClass& c : classes) {
      for (std::uint64_t i = 0; i < options.count; ++i) all.push_back({c, options.seed, i});
    }
  }
  const std::size_t size = chunk_size(all.size());
  for (const Identity& identity : all) {
    const Pair pair = identity.pose_class.pair;
    const bool fits =
        !result.empty() && result.back().pair == pair && result.back().identities.size() < size;
    if (!fits) result.push_back({pair, {}});
    result.back().identities.push_back(identity);
  }
  return result;
}

/// A configuration that seems to break a law: it does in the session of its chunk.
struct Suspect {
  std::size_t configuration, law;  ///< places in the chunk and in the options
  Violation violation;
  std::string features;
};
/// What the configurations of a chunk seem to break, in their order.
struct ChunkResult {
  /// Configurations that each law applies to and the candidate has a routine for.
  std::vector<std::uint64_t> tried;
  std::uint64_t unsupported = 0;
  std::vector<Suspect> suspects;
  double seconds = 0;  ///< that all of it took
};
ChunkResult tried(const Chunk& chunk, const CheckOptions& options, CandidateProcess& candidate) {
  const auto start = std::chrono::steady_clock::now();
  ChunkResult result;
  result.tried.resize(options.laws.size());
  candidate.ask_within(options.bar.threshold);
  std::vector<Configuration> configurations;
  for (const Identity& identity : chunk.identities) {
    configurations.push_back(make_configuration(identity));
  }
  const auto found = broken_in_session(options.laws, configurations, candidate, options.bar);
  for (std::size_t i = 0; i < configurations.size(); ++i) {
    const Configuration& c = configurations[i];
    const Violations& violations = found[i];
    if (violations.empty()) {
      ++result.unsupported;
      continue;
    }
    for (std::size_t law = 0; law < options.laws.size(); ++law) {
      if (options.laws[law]->applies(c)) ++result.tried[law];
      if (!violations[law]) continue;
      result.suspects.push_back(
          {i, law, *violations[law], options.by_features ? meeting_features(c) : ""});
    }
  }
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
  result.seconds = passed.count();
  return result;
}

/// Runs task(i, candidate) for every i < count, in processes with a candidate of their own if there
/// is more than one worker.
std::vector<std::string> run(
    std::size_t count, const CheckOptions& options, CandidateProcess& candidate,
    const std::function<std::string(std::size_t, CandidateProcess&)>& task,
    const std::function<std::string(std::size_t)>& name,
    const std::function<void(std::size_t)>& done = [](std::size_t) {}) {
  if (options.workers > 1) {
    WorkerCandidates own({&candidate.candidate()}, options.bar.threshold, {});
    return run_in_processes(
        count, options.workers, [&](std::size_t i) { return task(i, own.get().front()); }, name,
        done);
  }
  std::vector<std::string> results;
  for (std::size_t i = 0; i < count; ++i) {
    results.push_back(task(i, candidate));
    done(i + 1);
  }
  return results;
}

/// A run's failures, before they are simplified.
struct Found {
  const Law* law;
  Identity identity;
  Violation violation;
  std::string features;
  bool is_doubtful;  ///< the law "memory" is broken in its chunk, or a failure of its kind is none

  auto kind() const {
    return std::tuple(identity.pose_class.pair, law, violation.failure, features);
  }
};
using Kind = decltype(std::declval<Found>().kind());

/// The places of each kind's failures.
std::map<Kind, std::vector<std::size_t>> by_kind(const std::vector<Found>& found) {
  std::map<Kind, std::vector<std::size_t>> places;
  for (std::size_t i = 0; i < found.size(); ++i) places[found[i].kind()].push_back(i);
  return places;
}

std::vector<Found> found(const std::vector<Chunk>& all, const std::vector<ChunkResult>& results,
                         const CheckOptions& options) {
  std::vector<Found> result;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& suspects = results[i].suspects;
    const bool remembers = std::any_of(suspects.begin(), suspects.end(), [&](const Suspect& s) {
      return options.laws[s.law]->name == "memory";
    });
    for (const Suspect& s : suspects) {
      result.push_back({options.laws[s.law], all[i].identities[s.configuration], s.violation,
                        s.features, remembers});
    }
  }
  return result;
}

/// Suspects of a kind that are asked again alone, first and last included.
constexpr std::size_t asked_again_of_kind = 8;

std::vector<std::size_t> sample(const std::vector<std::size_t>& places) {
  if (places.size() <= asked_again_of_kind) return places;
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < asked_again_of_kind; ++i) {
    result.push_back(places[i * (places.size() - 1) / (asked_again_of_kind - 1)]);
  }
  return result;
}

/// Asks those at `places` again, each by its law alone in a session of its own. Absent: it holds.
std::vector<std::optional<Violation>> asked_again(const std::vector<Found>& all,
                                                  const std::vector<std::size_t>& places,
                                                  const CheckOptions& options,
                                                  CandidateProcess& candidate) {
  const auto texts = run(
      places.size(), options, candidate,
      [&](std::size_t i, CandidateProcess& asked) {
        const Found& f = all[places[i]];
        return to_bytes(broken(*f.law, make_configuration(f.identity), asked, options.bar));
      },
      [&](std::size_t i) { return to_string(all[places[i]].identity); });
  std::vector<std::optional<Violation>> result;
  for (const std::string& text : texts) {
    result.push_back(text.empty() ? std::nullopt : from_bytes<std::optional<Violation>>(text));
  }
  return result;
}

/// Drops those that fail in the session of their chunk alone. A candidate whose answers do not
/// depend on earlier questions has none, so that a sample of each kind is asked again; all of a
/// kind are if one of the sample does not fail alike, and all of a chunk that breaks "memory".
void drop_unconfirmed(std::vector<Found>& all, const CheckOptions& options,
                      CandidateProcess& candidate) {
  const auto kinds = by_kind(all);
  std::vector<std::optional<Violation>> verdicts(all.size());
  std::vector<bool> is_asked(all.size());
  const auto ask = [&](const std::vector<std::size_t>& places) {
    const auto answers = asked_again(all, places, options, candidate);
    for (std::size_t i = 0; i < places.size(); ++i) {
      is_asked[places[i]] = true;
      verdicts[places[i]] = answers[i];
    }
  };
  std::set<std::size_t> places;
  for (const auto& [kind, of_kind] : kinds) {
    for (const std::size_t i : sample(of_kind)) places.insert(i);
    for (const std::size_t i : of_kind) {
      if (all[i].is_doubtful) places.insert(i);
    }
  }
  ask({places.begin(), places.end()});
  std::vector<std::size_t> others;
  for (const auto& [kind, of_kind] : kinds) {
    const bool is_trusted = std::all_of(of_kind.begin(), of_kind.end(), [&](std::size_t i) {
      return !is_asked[i] || (verdicts[i] && verdicts[i]->failure == all[i].violation.failure);
    });
    if (is_trusted) continue;
    for (const std::size_t i : of_kind) {
      if (!is_asked[i]) others.push_back(i);
    }
  }
  ask(others);
  std::vector<Found> confirmed;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (is_asked[i] && !verdicts[i]) continue;
    if (is_asked[i]) all[i].violation = *verdicts[i];
    confirmed.push_back(std::move(all[i]));
  }
  all = std::move(confirmed);
}

MetFailure met(const Found& f) {
  return {f.law, to_string(f.identity), make_configuration(f.identity), f.violation, f.features};
}

/// Simplifies the first of each kind, and counts the others.
std::vector<Failure> simplified(const std::vector<Found>& all, const CheckOptions& options,
                                CandidateProcess& candidate) {
  std::set<std::tuple<Pair, const Law*, std::string>> names;
  std::set<Kind> kinds;
  std::vector<std::pair<const Found*, int>> first;  // with its number of trials
  for (const Found& f : all) {
    if (!kinds.insert(f.kind()).second) continue;
    const bool is_first_of_name =
        names.insert({f.identity.pose_class.pair, f.law, f.violation.failure}).second;
    first.emplace_back(&f, is_first_of_name ? trials_of_first : trials_of_others);
  }
  const auto texts = run(
      first.size(), options, candidate,
      [&](std::size_t i, CandidateProcess& asked) {
        return to_bytes(simplest(met(*first[i].first), first[i].second, asked, options.bar));
      },
      [&](std::size_t i) { return to_string(first[i].first->identity); });
  const auto places = by_kind(all);
  std::vector<Failure> result;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (texts[i].empty()) continue;  // interrupted before
    const MetFailure f = met(*first[i].first);
    result.push_back(failure_of(f, from_bytes<Configuration>(texts[i]), candidate, options.bar));
    result.back().met = places.at(first[i].first->kind()).size();
  }
  return result;
}

}  // namespace

Configuration simplest(const MetFailure& f, int max_trials, CandidateProcess& candidate,
                       const Bar& bar) {
  const auto fails_alike = [&](const std::optional<Violation>& v, const Configuration& c) {
    return v && v->failure == f.violation.failure &&
           (f.features.empty() || meeting_features(c) == f.features);
  };
  // All trials in one session; what it finds has to fail alone.
  candidate.ask_within(bar.threshold);
  const Law* const law[] = {f.law};
  Configuration simple = simplified(
      f.configuration,
      [&](const Configuration& c) {
        const auto violations = broken_in_session(law, c, candidate, bar);
        return !violations.empty() && fails_alike(violations.front(), c);
      },
      max_trials);
  if (fails_alike(broken(*f.law, simple, candidate, bar), simple)) return simple;
  return simplified(
      f.configuration,
      [&](const Configuration& c) { return fails_alike(broken(*f.law, c, candidate, bar), c); },
      max_trials);
}

Failure failure_of(const MetFailure& f, const Configuration& simple, CandidateProcess& candidate,
                   const Bar& bar) {
  const Violation violation = broken(*f.law, simple, candidate, bar).value_or(f.violation);
  candidate.ask_within(bar.threshold);
  const Answer answer = candidate.answers({&simple, 1}).front();
  return {f.law->name,
          candidate.candidate().name,
          candidate.candidate().version,
          f.identity,
          simple,
          violation,
          bar,
          answer,
          score(simple, oracle::truth(simple), answer, bar),
          f.features};
}

std::vector<LawResult> check(CandidateProcess& candidate, const CheckOptions& options,
                             const std::function<void(std::uint64_t, std::uint64_t)>& progress) {
  const std::vector<Chunk> all = chunks(options);
  std::uint64_t count = 0, largest = 0;
  for (const Chunk& chunk : all) {
    count += chunk.identities.size();
    largest = std::max<std::uint64_t>(largest, chunk.identities.size());
  }
  const auto texts = run(
      all.size(), options, candidate,
      [&](std::size_t i, CandidateProcess& asked) {
        return to_bytes(tried(all[i], options, asked));
      },
      [&](std::size_t i) { return to_string(all[i].identities.front()); },
      [&](std::size_t done) { progress(std::min<std::uint64_t>(done * largest, count), count); });
  std::vector<ChunkResult> of_chunks;
  for (const std::string& text : texts) {
    of_chunks.push_back(text.empty()  // interrupted before
                            ? ChunkResult{std::vector<std::uint64_t>(options.laws.size()), 0, {}, 0}
                            : from_bytes<ChunkResult>(text));
  }
  std::vector<Found> failures = found(all, of_chunks, options);
  drop_unconfirmed(failures, options, candidate);

  std::vector<LawResult> results;
  const auto result_of = [&](Pair pair, const std::string& law) -> LawResult& {
    return *std::find_if(results.begin(), results.end(),
                         [&](const LawResult& r) { return r.pair == pair && r.law == law; });
  };
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i == 0 || all[i].pair != all[i - 1].pair) {
      for (const Law* law : options.laws) results.push_back({law->name, all[i].pair});
    }
    const auto of_pair = std::span(results).last(options.laws.size());
    for (std::size_t law = 0; law < of_pair.size(); ++law) {
      of_pair[law].tried += of_chunks[i].tried[law];
      of_pair[law].unsupported += of_chunks[i].unsupported;
      of_pair[law].seconds += of_chunks[i].seconds / static_cast<double>(of_pair.size());
    }
  }
  for (const Found& f : failures) {
    LawResult& result = result_of(f.identity.pose_class.pair, f.law->name);
    ++result.broken;
    ++result.counts[f.violation.failure];
  }
  for (Failure& f : simplified(failures, options, candidate)) {
    result_of(pair_of(f.configuration), f.law).failures.push_back(std::move(f));
  }
  std::erase_if(results, [](const LawResult& r) { return r.tried + r.unsupported == 0; });
  for (LawResult& result : results) {
    const auto rank = [](const Failure& f) {
      return std::pair(order_of(group_met(f)), complexity(f.configuration));
    };
    std::sort(result.failures.begin(), result.failures.end(),
              [&](const Failure& a, const Failure& b) { return rank(a) < rank(b); });
  }
  return results;
}

}  // namespace touchstone
