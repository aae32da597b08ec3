#include "simulation/contact_model.hpp"

#include <algorithm>

namespace touchstone {

std::vector<Answer> CandidateModel::answers(std::span<const PairQuestion> questions) {
  std::vector<Configuration> configurations;
  configurations.reserve(questions.size());
  for (const PairQuestion& q : questions) configurations.push_back(q.configuration);
  return process_.answer(configurations);
}

void PairwiseModel::begin() { begun_.clear(); }

std::vector<Answer> PairwiseModel::answers(std::span<const PairQuestion> questions) {
  std::vector<CandidateProcess*> chosen;
  for (const PairQuestion& q : questions) {
    chosen.push_back(&choice_(q.a, q.b));
    if (std::find(begun_.begin(), begun_.end(), chosen.back()) != begun_.end()) continue;
    chosen.back()->restart();
    begun_.push_back(chosen.back());
  }
  std::vector<Answer> result(questions.size());
  for (CandidateProcess* process : begun_) {
    std::vector<Configuration> configurations;
    for (std::size_t i = 0; i < questions.size(); ++i) {
      if (chosen[i] == process) configurations.push_back(questions[i].configuration);
    }
    if (configurations.empty()) continue;
    auto answer = process->answer(configurations);
    auto next = answer.begin();
    for (std::size_t i = 0; i < questions.size(); ++i) {
      if (chosen[i] == process) result[i] = std::move(*next++);
    }
  }
  return result;
}

void RecordingModel::begin() {
  asked_.clear();
  model_.begin();
}

std::vector<Answer> RecordingModel::answers(std::span<const PairQuestion> questions) {
  auto result = model_.answers(questions);
  for (std::size_t i = 0; i < questions.size(); ++i) {
    asked_.push_back({questions[i], result[i]});
  }
  return result;
}

}  // namespace touchstone
