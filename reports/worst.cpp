#include "reports/worst.hpp"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include <nlohmann/json.hpp>

#include "candidates/candidates.hpp"
#include "properties/files/configuration_json.hpp"

namespace touchstone {
namespace {

constexpr std::size_t kept_of_heading = 4;
constexpr std::size_t kept_of_class = 2;

auto rank(const Score& s) {
  const Outcome o = s.outcome;
  const bool answered = o != Outcome::crashed && o != Outcome::timed_out && o != Outcome::failed &&
                        o != Outcome::not_finite;
  return std::tuple(o == Outcome::agree, answered, -s.severity);
}

std::string option_text(const Added& added) {
  return ' ' + added.option + ' ' + shell_quoted(added.value);
}

/// " --candidates a,b" if one of them is asked only when it is named; otherwise all are asked.
std::string choice_of(const std::vector<std::string>& candidates) {
  const std::vector<const Candidate*> usual = all_candidates();
  const bool is_special =
      std::any_of(candidates.begin(), candidates.end(), [&](const std::string& name) {
        const Candidate* const known = known_candidate(name);
        return known && std::find(usual.begin(), usual.end(), known) == usual.end();
      });
  if (!is_special) return "";
  std::string names;
  for (const std::string& name : candidates)
    names += (names.empty() ? "" : ",") + shell_quoted(name);
  return " --candidates " + names;
}

}  // namespace

bool is_worse(const Score& a, const Score& b) { return rank(a) < rank(b); }

bool Case::operator<(const Case& other) const {
  return std::tuple(rank(score), cell, index) <
         std::tuple(rank(other.score), other.cell, other.index);
}

std::vector<Case> worst_of_class(std::vector<Case> cases) {
  std::erase_if(cases, [](const Case& c) { return c.score.outcome == Outcome::unsupported; });
  std::sort(cases.begin(), cases.end());
  std::map<Outcome, std::size_t> seen;
  std::size_t at = 0;
  std::erase_if(cases, [&](const Case& c) {
    const bool first_of_outcome = seen[c.score.outcome]++ == 0;
    return at++ >= kept_of_class && !first_of_outcome;
  });
  return cases;
}

std::vector<Case> worst_of_heading(std::vector<Case> cases) {
  std::sort(cases.begin(), cases.end());
  // The worst of each outcome stay, then what else is worst.
  std::map<Outcome, std::size_t> seen;
  const auto others = std::stable_partition(
      cases.begin(), cases.end(), [&](const Case& c) { return seen[c.score.outcome]++ == 0; });
  const auto first = static_cast<std::size_t>(others - cases.begin());
  cases.resize(std::min(std::max(kept_of_heading, first), cases.size()));
  std::sort(cases.begin(), cases.end());
  return cases;
}

Examination examine(const Subject& subject, std::span<CandidateProcess* const> candidates,
                    const Bar& bar, double width) {
  std::vector<std::string> names;
  for (const CandidateProcess* c : candidates) names.push_back(c->candidate().name);
  Examination result{
      subject.name, subject.configuration, {}, {}, replay_command(subject.name, names)};
  const auto take = [&](const ScoredConfiguration& scored) {
    result.truth = scored.truth;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      result.answers.push_back(
          {candidates[k]->candidate().name, scored.answers[k], scored.scores[k]});
    }
  };
  score_configurations({&subject.configuration, 1}, candidates, bar, width, take);
  return result;
}

std::string shell_quoted(const std::string& text) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) || std::strchr("/._-+@", c); };
  if (!text.empty() && std::all_of(text.begin(), text.end(), plain)) return text;
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? "'\\''" : std::string(1, c);
  return result + "'";
}

std::string program_name() {
  std::string name = "./touchstone";
  for (const Added& added : added_candidates()) name += option_text(added);
  return name;
}

std::string program_name(const std::vector<std::string>& candidates) {
  std::vector<std::string> options;
  for (const std::string& name : candidates) {
    const Candidate* const known = known_candidate(name);
    if (!known || !known->added) continue;
    const std::string option = option_text(*known->added);
    if (std::find(options.begin(), options.end(), option) == options.end()) {
      options.push_back(option);
    }
  }
  return std::accumulate(options.begin(), options.end(), std::string("./touchstone"));
}

std::string replay_command(const std::string& name, const std::vector<std::string>& candidates) {
  return program_name(candidates) + " replay " + shell_quoted(name) + choice_of(candidates);
}

std::string replay_command(const Configuration& configuration,
                           const std::vector<std::string>& candidates) {
  return "echo '" + to_json(configuration).dump() + "' | " + program_name(candidates) +
         " replay -" + choice_of(candidates);
}

}  // namespace touchstone
