#include "reports/worst.hpp"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <utility>

#include "candidates/candidates.hpp"
#include "candidates/host/progress.hpp"
#include "reports/worst_selection.hpp"

namespace touchstone {
namespace {

std::vector<Case> worst_of(const std::vector<Cell>& all, const std::vector<CellScores>& scores,
                           Pair pair, std::size_t candidate) {
  std::vector<Case> cases;
  for (std::size_t cell = 0; cell < all.size(); ++cell) {
    if (all[cell].pair != pair) continue;
    std::vector<Case> of_class;
    const auto& row = scores[cell].scores[candidate];
    for (std::uint64_t i = 0; i < row.size(); ++i) of_class.push_back({cell, i, row[i]});
    const auto worst = worst_of_class(std::move(of_class));
    cases.insert(cases.end(), worst.begin(), worst.end());
  }
  return worst_of_pair(std::move(cases));
}

}  // namespace

std::string shell_quoted(const std::string& text) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) || std::strchr("/._-+@", c); };
  if (std::all_of(text.begin(), text.end(), plain)) return text;
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? "'\\''" : std::string(1, c);
  return result + "'";
}

std::string program_name() {
  std::string name = "./touchstone";
  for (const auto& file : added_plugins()) name += " --candidate " + shell_quoted(file.string());
  return name;
}

std::string replay_command(const std::string& name) {
  return program_name() + " replay " + shell_quoted(name);
}

Examination examine(const Subject& subject, const std::vector<CandidateProcess*>& candidates,
                    const Bar& bar, double width) {
  const Configuration& c = subject.configuration;
  const oracle::Truth truth = oracle::truth(c, width);
  std::vector<ScoredAnswer> answers;
  for (CandidateProcess* const process : candidates) {
    const Answer a = process->answer(c);
    answers.push_back({process->candidate().name, a, score(c, truth, a, bar)});
  }
  return {subject.name, c, truth, answers, replay_command(subject.name)};
}

std::vector<WorstCase> worst_cases(const Campaign& campaign,
                                   const std::vector<CellScores>& scores) {
  const std::vector<Cell> all = cells(campaign);
  std::vector<WorstCase> result;
  auto processes = start(campaign.candidates, campaign.bar.threshold, campaign.limits);
  Progress progress("candidates' worst cases", campaign.pairs.size() * campaign.candidates.size());
  std::size_t done = 0;
  for (const Pair pair : campaign.pairs) {
    for (std::size_t k = 0; k < campaign.candidates.size(); ++k) {
      progress.update(done++);
      for (const Case& w : worst_of(all, scores, pair, k)) {
        const Identity id{pair, all[w.cell].pose_class, campaign.seed, w.index};
        std::vector<CandidateProcess*> shown = {&processes[k]};
        if (k > 0) shown.push_back(&processes[0]);
        result.push_back({pair_name(pair), id.pose_class, campaign.candidates[k]->name, w.score,
                          examine(subject(id), shown, campaign.bar)});
      }
    }
  }
  return result;
}

}  // namespace touchstone
