#include "properties/laws/check.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <set>
#include <sstream>
#include <tuple>
#include <utility>

#include "candidates/host/worker_processes.hpp"
#include "oracle/truth.hpp"
#include "properties/simplify.hpp"

namespace touchstone {
namespace {

/// Configurations of one pair, which are asked in one session: what a worker does at a time. Few
/// enough to share the work out, and always the same ones, whatever the number of workers.
struct Chunk {
  Pair pair;
  std::vector<Identity> identities;
};
constexpr std::size_t max_chunk = 16;

std::vector<Chunk> chunks(const CheckOptions& options) {
  std::vector<Chunk> result;
  for (const Pair pair : options.pairs) {
    bool is_new_pair = true;
    for (const std::string& name : selected_classes(pair, {options.classes, options.groups})) {
      for (std::uint64_t i = 0; i < options.count; ++i) {
        if (is_new_pair || result.back().identities.size() == max_chunk) {
          result.push_back({pair, {}});
          is_new_pair = false;
        }
        result.back().identities.push_back({pair, name, options.seed, i});
      }
    }
  }
  return result;
}

/// A law that a configuration of a chunk breaks.
struct Broken {
  std::size_t configuration, law;  ///< places in the chunk and in the options
  Violation violation;
  std::string features;
};

/// What the configurations of a chunk break, in their order.
struct ChunkResult {
  std::vector<std::uint64_t> tried;  ///< of each law, the configurations that it applies to
  std::vector<Broken> broken;
  double seconds = 0;  ///< that all of it took
};

ChunkResult tried(const Chunk& chunk, const CheckOptions& options, CandidateProcess& candidate) {
  const auto start = std::chrono::steady_clock::now();
  ChunkResult result{std::vector<std::uint64_t>(options.laws.size()), {}, 0};
  candidate.ask_within(options.bar.threshold);
  for (std::size_t i = 0; i < chunk.identities.size(); ++i) {
    const Configuration c = make_configuration(chunk.identities[i]);
    const auto violations = broken(options.laws, c, candidate, options.bar);
    for (std::size_t law = 0; law < options.laws.size(); ++law) {
      if (options.laws[law]->applies(c)) ++result.tried[law];
      if (!violations[law]) continue;
      result.broken.push_back(
          {i, law, *violations[law], options.by_features ? meeting_features(c) : ""});
    }
  }
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
  result.seconds = passed.count();
  return result;
}

// A worker's result as text: numbers, and strings after their length.

void put(std::ostream& out, const std::string& text) { out << text.size() << ' ' << text << ' '; }
std::string get_string(std::istream& in) {
  std::size_t size = 0;
  in >> size;
  std::string text(size, ' ');
  in.get();
  in.read(text.data(), static_cast<std::streamsize>(size));
  return text;
}

std::string to_text(const ChunkResult& result) {
  std::ostringstream out;
  for (const std::uint64_t count : result.tried) out << count << ' ';
  out << result.seconds << ' ' << result.broken.size() << ' ';
  for (const Broken& b : result.broken) {
    out << b.configuration << ' ' << b.law << ' ';
    put(out, fmt::format("{:a}", b.violation.amount));
    put(out, b.violation.failure);
    put(out, b.violation.detail);
    put(out, b.features);
  }
  return out.str();
}

ChunkResult from_text(const std::string& text, std::size_t laws) {
  ChunkResult result{std::vector<std::uint64_t>(laws), {}, 0};
  std::istringstream in(text);
  for (std::uint64_t& count : result.tried) in >> count;
  std::size_t count = 0;
  in >> result.seconds >> count;
  for (std::size_t i = 0; i < count; ++i) {
    Broken b{};
    in >> b.configuration >> b.law;
    b.violation.amount = std::strtod(get_string(in).c_str(), nullptr);
    b.violation.failure = get_string(in);
    b.violation.detail = get_string(in);
    b.features = get_string(in);
    result.broken.push_back(std::move(b));
  }
  return result;
}

std::vector<ChunkResult> tried(const std::vector<Chunk>& all, const CheckOptions& options,
                               CandidateProcess& candidate,
                               const std::function<void(std::uint64_t)>& done) {
  std::vector<ChunkResult> results;
  std::uint64_t count = 0;
  if (options.workers <= 1) {
    for (const Chunk& chunk : all) {
      results.push_back(tried(chunk, options, candidate));
      done(count += chunk.identities.size());
    }
    return results;
  }
  for (const Chunk& chunk : all) count += chunk.identities.size();
  WorkerCandidates own({&candidate.candidate()}, options.bar.threshold, {});
  const auto texts = run_in_processes(
      all.size(), options.workers,
      [&](std::size_t i) { return to_text(tried(all[i], options, own.get().front())); },
      [&](std::size_t i) { return to_string(all[i].identities.front()); },
      [&](std::size_t finished) { done(std::min<std::uint64_t>(finished * max_chunk, count)); });
  for (const std::string& text : texts) results.push_back(from_text(text, options.laws.size()));
  return results;
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

/// Adds what a chunk has broken; simplifies what failed first.
void add(const Chunk& chunk, const ChunkResult& of_chunk, const CheckOptions& options,
         CandidateProcess& candidate, std::span<LawResult> results) {
  for (std::size_t law = 0; law < results.size(); ++law) {
    results[law].tried += of_chunk.tried[law];
    results[law].seconds += of_chunk.seconds / static_cast<double>(results.size());
  }
  for (const Broken& b : of_chunk.broken) {
    LawResult& result = results[b.law];
    ++result.broken;
    const bool is_first = result.counts[b.violation.failure]++ == 0;
    const auto alike =
        std::find_if(result.failures.begin(), result.failures.end(), [&](const Failure& f) {
          return f.violation.failure == b.violation.failure && f.features == b.features;
        });
    if (alike != result.failures.end()) {
      ++alike->met;
      continue;
    }
    result.failures.push_back(simplest(*result.law, chunk.identities[b.configuration], b.violation,
                                       b.features, is_first ? trials_of_first : trials_of_others,
                                       candidate, options.bar));
  }
}

}  // namespace

std::vector<LawResult> check(CandidateProcess& candidate, const CheckOptions& options,
                             const std::function<void(std::uint64_t, std::uint64_t)>& progress) {
  const std::vector<Chunk> all = chunks(options);
  std::uint64_t count = 0;
  for (const Chunk& chunk : all) count += chunk.identities.size();
  const std::vector<ChunkResult> of_chunks =
      tried(all, options, candidate, [&](std::uint64_t done) { progress(done, count); });

  std::vector<LawResult> results;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i == 0 || all[i].pair != all[i - 1].pair) {
      for (const Law* law : options.laws) results.push_back({law, all[i].pair, 0, 0, {}, {}, 0});
    }
    add(all[i], of_chunks[i], options, candidate, std::span(results).last(options.laws.size()));
  }
  std::erase_if(results, [](const LawResult& result) { return result.tried == 0; });
  for (LawResult& result : results) {
    std::sort(result.failures.begin(), result.failures.end(), [](const auto& a, const auto& b) {
      return complexity(a.configuration) < complexity(b.configuration);
    });
  }
  return results;
}

namespace {

constexpr double aligned = 1e-6;  // radians

/// The unit normal in a body's frame.
Vec3 in_frame(const Pose& pose, const Vec3& n) { return pose.rotation().transpose() * n; }

bool is_along(const Vec3& local) { return std::hypot(local.x(), local.y()) < aligned; }
bool is_across(const Vec3& local) { return std::abs(local.z()) < aligned; }

struct FeatureAlong {
  Vec3 n;  // in the body's frame

  std::string operator()(const Cylinder&) const {
    return is_along(n) ? "cap" : is_across(n) ? "side" : "rim";
  }
  std::string operator()(const Capsule&) const { return is_across(n) ? "side" : "end"; }
  std::string operator()(const Sphere&) const { return "sphere"; }
  std::string operator()(const Plane&) const { return "plane"; }
  std::string operator()(const Box&) const {
    switch ((n.array().abs() < aligned).count()) {
      case 2:
        return "face";
      case 1:
        return "edge";
      default:
        return "vertex";
    }
  }
};

}  // namespace

std::string meeting_features(const Configuration& c) {
  const oracle::Truth truth = oracle::truth(c);
  if (truth.ties != oracle::Ties::unique) return "tied";
  const Vec3& n = truth.normals.front().n;
  return FeatureAlong{in_frame(c.pose_a, n)}(c.a) + '-' +
         std::visit(FeatureAlong{in_frame(c.pose_b, n)}, c.b);
}

bool Cause::operator<(const Cause& other) const {
  return std::tie(law, pair, features, failure) <
         std::tie(other.law, other.pair, other.features, other.failure);
}

Cause cause_of(const Failure& f) {
  const std::string features = f.features.empty() ? meeting_features(f.configuration) : f.features;
  return {f.law, pair_of(f.configuration), features, f.violation.failure};
}

std::string to_string(const Cause& cause) {
  return cause.law + ", " + pair_name(cause.pair) + ", " + cause.features + ", " + cause.failure;
}

std::vector<Failure> in_order(const std::vector<LawResult>& results) {
  std::vector<Failure> all;
  for (const LawResult& result : results) {
    all.insert(all.end(), result.failures.begin(), result.failures.end());
  }
  const auto rank = [](const Failure& f) {
    return std::tuple(&find_law(f.law), ~f.met, complexity(f.configuration));
  };
  std::stable_sort(all.begin(), all.end(),
                   [&](const Failure& a, const Failure& b) { return rank(a) < rank(b); });
  return all;
}

std::vector<LawResult> new_ones(std::vector<LawResult> results, const std::vector<Failure>& known) {
  std::set<Cause> causes;
  for (const Failure& failure : known) causes.insert(cause_of(failure));
  for (LawResult& result : results) {
    result.broken = 0;
    result.counts.clear();
    std::erase_if(result.failures, [&](const Failure& f) { return causes.contains(cause_of(f)); });
    for (const Failure& f : result.failures) {
      result.broken += f.met;
      result.counts[f.violation.failure] += f.met;
    }
  }
  return results;
}

}  // namespace touchstone
