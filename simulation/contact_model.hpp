#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "candidates/host/candidate_process.hpp"

namespace touchstone {

/// Two bodies of a scene, by their place in it, that may touch. Body a is the cylinder, of two
/// cylinders the one that comes first.
struct PairQuestion {
  int a, b;
  Configuration configuration;
  /// Of the same bodies in the step before, where they had a contact: the candidate's hint.
  std::optional<Vec3> previous_normal = {};
};

/// Who finds the contacts of pairs with a cylinder.
class ContactModel {
 public:
  virtual ~ContactModel() = default;
  /// Called once before a scene begins: what was asked before must not matter.
  virtual void begin() = 0;
  /// One answer for each question of a step, in order.
  virtual std::vector<Answer> answers(std::span<const PairQuestion> questions) = 0;
};

/// One candidate for all pairs. The process must outlive the model and be asked by nobody else
/// while a scene runs; its contact threshold is `simulation_threshold`.
class CandidateModel : public ContactModel {
 public:
  explicit CandidateModel(CandidateProcess& process) : process_(process) {}
  void begin() override { process_.restart(); }
  std::vector<Answer> answers(std::span<const PairQuestion> questions) override;

 private:
  CandidateProcess& process_;
};

/// A candidate for each pair of bodies.
class PairwiseModel : public ContactModel {
 public:
  /// Of bodies a and b (as in PairQuestion), always the same one for the same pair.
  using Choice = std::function<CandidateProcess&(int a, int b)>;
  explicit PairwiseModel(Choice choice) : choice_(std::move(choice)) {}
  void begin() override;
  std::vector<Answer> answers(std::span<const PairQuestion> questions) override;

 private:
  Choice choice_;
  std::vector<CandidateProcess*> begun_;
};

/// Another model, and every question that it was asked and every answer that it gave, in order.
class RecordingModel : public ContactModel {
 public:
  struct Asked {
    PairQuestion question;
    Answer answer;
  };
  explicit RecordingModel(ContactModel& model) : model_(model) {}
  void begin() override;
  std::vector<Answer> answers(std::span<const PairQuestion> questions) override;
  const std::vector<Asked>& asked() const { return asked_; }

 private:
  ContactModel& model_;
  std::vector<Asked> asked_;
};

/// Candidates are asked for contacts up to this far apart, metres: none that do not touch, because
/// ODE stops bodies at every contact that it is given.
inline constexpr double simulation_threshold = 0;

}  // namespace touchstone
