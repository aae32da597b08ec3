#include "reports/worst.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include "candidates/candidates.hpp"
#include "reports/answer_json.hpp"
#include "reports/configuration_json.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

constexpr std::size_t kept = 4;           // of each pair × candidate
constexpr std::size_t kept_of_class = 2;  // among them

struct Case {
  std::size_t cell;
  std::uint64_t index;
  Score score;

  /// Worse cases first; equal ones in report order.
  auto rank() const {
    return std::tuple(score.outcome == Outcome::agree, -score.severity, cell, index);
  }
};

std::vector<Case> worst_of(const std::vector<Cell>& all, const std::vector<CellScores>& scores,
                           Pair pair, std::size_t candidate) {
  std::vector<Case> cases;
  for (std::size_t cell = 0; cell < all.size(); ++cell) {
    if (all[cell].pair != pair) continue;
    std::vector<Case> of_class;
    const auto& row = scores[cell].scores[candidate];
    for (std::uint64_t i = 0; i < row.size(); ++i) {
      if (row[i].outcome != Outcome::unsupported) of_class.push_back({cell, i, row[i]});
    }
    const std::size_t count = std::min(kept_of_class, of_class.size());
    std::partial_sort(of_class.begin(), of_class.begin() + static_cast<std::ptrdiff_t>(count),
                      of_class.end(),
                      [](const Case& x, const Case& y) { return x.rank() < y.rank(); });
    cases.insert(cases.end(), of_class.begin(),
                 of_class.begin() + static_cast<std::ptrdiff_t>(count));
  }
  std::sort(cases.begin(), cases.end(),
            [](const Case& x, const Case& y) { return x.rank() < y.rank(); });
  cases.resize(std::min(kept, cases.size()));
  return cases;
}

json or_null(const std::optional<double>& value) { return value ? json(*value) : json(nullptr); }

}  // namespace

std::string replay_command(const Identity& identity) {
  return "./touchstone replay " + to_string(identity);
}

json examined(const Identity& identity, const std::vector<const ts_candidate*>& candidates,
              const Bar& bar, double width) {
  const Configuration c = make_configuration(identity);
  const oracle::Truth truth = oracle::truth(c, width);
  json answers = json::object();
  for (const ts_candidate* candidate : candidates) {
    const ts_answer a = answer(*candidate, c, bar.threshold);
    answers[candidate->name] = to_json(a, score(c, truth, a, bar));
  }
  return {{"id", to_string(identity)},
          {"configuration", to_json(c)},
          {"truth", to_json(c, truth)},
          {"answers", answers},
          {"replay", replay_command(identity)}};
}

json worst_cases(const Campaign& campaign, const std::vector<CellScores>& scores) {
  const std::vector<Cell> all = cells(campaign);
  json result = json::array();
  for (const Pair pair : campaign.pairs) {
    for (std::size_t k = 0; k < campaign.candidates.size(); ++k) {
      for (const Case& w : worst_of(all, scores, pair, k)) {
        const Identity id{pair, all[w.cell].pose_class, campaign.seed, w.index};
        json entry = examined(id, campaign.candidates, campaign.bar);
        entry["pair"] = pair_name(pair);
        entry["class"] = id.pose_class;
        entry["candidate"] = campaign.candidates[k]->name;
        entry["outcome"] = outcome_name(w.score.outcome);
        entry["depth_error"] = or_null(w.score.depth_error);
        entry["normal_regret"] = or_null(w.score.normal_regret);
        entry["severity"] = w.score.severity;
        result.push_back(std::move(entry));
      }
    }
  }
  return result;
}

}  // namespace touchstone
