#include "reports/search.hpp"

#include <algorithm>
#include <limits>
#include <random>
#include <utility>

#include <nlohmann/json.hpp>

#include "oracle/truth.hpp"
#include "properties/files/answer_json.hpp"
#include "properties/files/configuration_json.hpp"
#include "properties/files/strict_json.hpp"
#include "reports/report_json.hpp"
#include "reports/tally.hpp"

namespace touchstone {
namespace {

using Tape = std::vector<std::uint64_t>;

constexpr std::size_t batch = 32;  // asked in one session
constexpr std::size_t climbers = 4;

struct Trial {
  Identity identity;  ///< extends the tape where it is too short
  Tape tape;
  Configuration configuration;
  Score score;
};

bool worse_trial(const Trial& a, const Trial& b) { return is_worse(a.score, b.score); }

bool is_without_answer(Outcome o) {
  return o == Outcome::crashed || o == Outcome::timed_out || o == Outcome::failed ||
         o == Outcome::not_finite;
}

class Climb {
 public:
  Climb(CandidateProcess& candidate, const Search& search,
        const std::function<void(std::uint64_t)>& progress)
      : candidate_(candidate), search_(search), progress_(progress), random_(search.seed) {}

  /// The worst of `count` sampled configurations, worst first.
  std::vector<Trial> sample(std::uint64_t count) {
    std::vector<Trial> worst;
    for (std::uint64_t first = 0; first < count; first += batch) {
      std::vector<Trial> trials;
      for (std::uint64_t i = first; i < std::min(count, first + batch); ++i) {
        trials.push_back(trial({search_.cell.pair, search_.cell.pose_class, search_.seed, i}, {}));
      }
      ask(trials);
      worst.insert(worst.end(), trials.begin(), trials.end());
      std::stable_sort(worst.begin(), worst.end(), worse_trial);
      worst.resize(std::min(worst.size(), climbers), worst.front());
    }
    return worst;
  }

  void climb(Trial& at, std::uint64_t steps) {
    while (steps > 0 && !is_without_answer(at.score.outcome)) {
      std::vector<Trial> trials;
      for (std::uint64_t i = 0; i < std::min<std::uint64_t>(steps, batch); ++i) {
        trials.push_back(trial(at.identity, changed(at.tape)));
      }
      ask(trials);
      steps -= trials.size();
      const auto worst = std::min_element(trials.begin(), trials.end(), worse_trial);
      if (worse_trial(*worst, at)) at = *worst;
    }
  }

 private:
  static Trial trial(Identity identity, Tape tape) {
    Configuration c = make_configuration(identity, tape);
    return {std::move(identity), std::move(tape), c, {}};
  }

  /// Changes one to four numbers: most by a step of any magnitude, for a step of a millionth may be
  /// the right one; the others are drawn anew.
  Tape changed(Tape tape) {
    constexpr std::uint64_t anew_in = 8;
    constexpr std::uint64_t unused_bits = 11;  // the lowest bits make no double (Draw::uniform)
    const std::uint64_t changes = 1 + random_() % 4;
    for (std::uint64_t i = 0; i < changes; ++i) {
      std::uint64_t& number = tape[random_() % tape.size()];
      const std::uint64_t step = random_() >> (random_() % (64 - unused_bits));
      if (random_() % anew_in == 0) {
        number = random_();
      } else if (random_() % 2 == 0) {
        number += std::min(step, std::numeric_limits<std::uint64_t>::max() - number);
      } else {
        number -= std::min(step, number);
      }
    }
    return tape;
  }

  void ask(std::vector<Trial>& trials) {
    std::vector<Configuration> questions;
    for (const Trial& t : trials) questions.push_back(t.configuration);
    CandidateProcess* const asked[] = {&candidate_};
    auto trial = trials.begin();
    score_configurations(
        questions, asked, search_.bar, truth_width,
        [&](const ScoredConfiguration& scored) { (trial++)->score = scored.scores.front(); });
    progress_(asked_ += trials.size());
  }

  CandidateProcess& candidate_;
  const Search& search_;
  const std::function<void(std::uint64_t)>& progress_;
  std::mt19937_64 random_;
  std::uint64_t asked_ = 0;
};

}  // namespace

SearchResult search(CandidateProcess& candidate, const Search& s,
                    const std::function<void(std::uint64_t)>& progress) {
  Climb climb(candidate, s, progress);
  const std::uint64_t sampled = std::max<std::uint64_t>(1, s.budget / 4);
  std::vector<Trial> best = climb.sample(sampled);
  const Score of_sampled = best.front().score;
  const std::uint64_t each = (s.budget - sampled) / 2 / best.size();
  for (Trial& t : best) climb.climb(t, each);
  std::stable_sort(best.begin(), best.end(), worse_trial);
  climb.climb(best.front(), s.budget - sampled - each * best.size());
  const Trial& worst = best.front();
  return {worst.configuration, worst.score, to_string(worst.identity), of_sampled};
}

std::optional<Failure> failure_of(const SearchResult& found, CandidateProcess& candidate,
                                  const Bar& bar) {
  const Configuration& c = found.configuration;
  for (const char* name : {"answers", "agreement", "points"}) {
    const auto violation = broken(find_law(name), c, candidate, bar);
    if (!violation) continue;
    const Answer answer = candidate.answers({&c, 1}).front();
    return Failure{name,
                   candidate.candidate().name,
                   candidate.candidate().version,
                   found.identity,
                   c,
                   *violation,
                   bar,
                   answer,
                   score(c, oracle::truth(c), answer, bar)};
  }
  return std::nullopt;
}

nlohmann::json to_json(const SearchResult& f, const Cell& cell) {
  return {{"pair", pair_name(cell.pair)},
          {"class", cell.pose_class},
          {"outcome", outcome_name(f.score.outcome)},
          {"depth_error", or_null(f.score.depth_error)},
          {"normal_regret", or_null(f.score.normal_regret)},
          {"severity", f.score.severity},
          {"sampled_severity", f.sampled.severity},
          {"from", f.identity},
          {"configuration", to_hex_json(f.configuration)}};
}

}  // namespace touchstone
