#include "simulation/contact_model.hpp"

#include <algorithm>

namespace touchstone {

namespace {

/// What is asked of one process in a step, in one batch.
class Batch {
 public:
  void add(const PairQuestion& q) {
    configurations_.push_back(q.configuration);
    previous_normals_.push_back(q.previous_normal ? &*q.previous_normal : nullptr);
  }
  bool empty() const { return configurations_.empty(); }
  std::vector<Answer> ask(CandidateProcess& process) const {
    return process.answer(configurations_, previous_normals_);
  }

 private:
  std::vector<Configuration> configurations_;
  std::vector<const Vec3*> previous_normals_;
};

}  // namespace

std::vector<Answer> CandidateModel::answers(std::span<const PairQuestion> questions) {
  Batch batch;
  for (const PairQuestion& q : questions) batch.add(q);
  return batch.ask(process_);
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
    Batch batch;
    for (std::size_t i = 0; i < questions.size(); ++i) {
      if (chosen[i] == process) batch.add(questions[i]);
    }
    if (batch.empty()) continue;
    auto answer = batch.ask(*process);
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
