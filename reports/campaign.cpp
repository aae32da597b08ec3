#include "reports/campaign.hpp"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <utility>

#include "properties/numbers.hpp"
#include "properties/stable_hash.hpp"

namespace touchstone {

std::vector<PoseClass> cells(const Campaign& campaign) {
  std::vector<PoseClass> result;
  for (const auto& [pair, configurations] : campaign.own) result.push_back(given_class(pair));
  if (!result.empty()) return result;
  const ClassSelection wanted{campaign.classes, campaign.groups, campaign.coverage};
  check_pose_classes(campaign.pairs, campaign.classes);
  check_groups(campaign.pairs, wanted);
  for (const Pair pair : campaign.pairs) {
    const std::vector<PoseClass> of_pair = selected(pair, wanted);
    result.insert(result.end(), of_pair.begin(), of_pair.end());
  }
  return result;
}

std::uint64_t count_of(const Campaign& campaign, const PoseClass& cell) {
  const Group group = cell.group();
  if (group == Group::given) return campaign.own.at(cell.pair).size();
  const bool everyday = group == Group::everyday || group == Group::recorded;
  const bool aligned = cell.modifiers.count() == 1 && cell.modifiers.frame() == Frame::aligned;
  return campaign.count * (everyday || aligned ? campaign.everyday_times : 1);
}

namespace {

/// Null of one that is drawn.
const OwnConfiguration* own_one(const Campaign& campaign, const Identity& identity) {
  if (identity.pose_class.group() != Group::given) return nullptr;
  return &campaign.own.at(identity.pose_class.pair)[identity.index];
}

}  // namespace

Configuration configuration_of(const Campaign& campaign, const Identity& identity) {
  const OwnConfiguration* const own = own_one(campaign, identity);
  return own ? own->configuration : make_configuration(identity);
}

std::string name_of(const Campaign& campaign, const Identity& identity) {
  const OwnConfiguration* const own = own_one(campaign, identity);
  return own ? own->id : to_string(identity);
}

std::uint64_t hash_of(const Configuration& configuration) {
  Numbers numbers = numbers_of(configuration);
  std::string bytes;
  for (const double* number : every_number(numbers)) {
    const double x = *number + 0.0;  // zeros of either sign are equal
    bytes.append(reinterpret_cast<const char*>(&x), sizeof x);
  }
  return stable_hash(bytes);
}

std::vector<Answer> answers_until_stopped(
    const std::function<std::vector<Answer>(std::span<const Configuration>, bool in_new_session)>&
        ask,
    std::span<const Configuration> configurations, std::span<const std::size_t> unit_ends) {
  std::vector<Answer> answers;
  std::vector<int> timeouts(unit_ends.size());
  while (answers.size() < configurations.size()) {
    // A call goes on through units until one of its answers times out.
    const bool in_new_session = answers.empty();
    auto given = ask(configurations.subspan(answers.size()), in_new_session);
    if (answers.empty()) {  // most often all of them: an answer is large
      answers = std::move(given);
    } else {
      std::move(given.begin(), given.end(), std::back_inserter(answers));
    }
    if (answers.back().status != TS_TIMED_OUT) continue;
    const auto end = std::lower_bound(unit_ends.begin(), unit_ends.end(), answers.size());
    if (++timeouts[static_cast<std::size_t>(end - unit_ends.begin())] < max_timeouts) continue;
    while (answers.size() < *end) answers.emplace_back().was_asked = false;
  }
  return answers;
}

void score_configurations(std::span<const Configuration> configurations,
                          std::span<CandidateProcess* const> candidates, const Bar& bar,
                          double width,
                          const std::function<void(const ScoredConfiguration&)>& take) {
  std::vector<std::vector<Answer>> answers;
  for (CandidateProcess* candidate : candidates) {
    answers.push_back(candidate->answers(configurations));
  }
  score_answers(configurations, std::move(answers), bar, width, take);
}

void score_answers(std::span<const Configuration> configurations,
                   std::vector<std::vector<Answer>> answers, const Bar& bar, double width,
                   const std::function<void(const ScoredConfiguration&)>& take) {
  for (std::size_t i = 0; i < configurations.size(); ++i) {
    const Configuration& c = configurations[i];
    const auto start = std::chrono::steady_clock::now();
    ScoredConfiguration scored{c, oracle::truth(c, width), 0, {}, {}};
    const auto end = std::chrono::steady_clock::now();
    scored.oracle_microseconds = std::chrono::duration<double, std::micro>(end - start).count();
    Judge judge(c, scored.truth, bar);
    scored.scores.reserve(answers.size());
    scored.answers.reserve(answers.size());
    for (auto& of_candidate : answers) {
      scored.scores.push_back(judge.score(of_candidate[i]));
      scored.answers.push_back(std::move(of_candidate[i]));
    }
    take(scored);
  }
}

}  // namespace touchstone
