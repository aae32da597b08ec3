#include "candidates/host/own_respondent.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <dlfcn.h>
#include <stdexcept>

#include "candidates/candidates.hpp"
#include "candidates/host/plugin_sessions.hpp"
#include "candidates/host/routine.hpp"

namespace touchstone {
namespace {

const ts_candidate& load(const Candidate& candidate) {
  void* const library = dlopen(candidate.plugin.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* const entry = library ? dlsym(library, "touchstone_plugin") : nullptr;
  if (!entry) throw std::runtime_error(dlerror());
  return reinterpret_cast<decltype(&touchstone_plugin)>(entry)()->candidates[candidate.index];
}

class OwnRespondent : public Respondent {
 public:
  OwnRespondent(const Candidate& candidate, double threshold)
      : routine_(load(candidate), candidate.value), threshold_(threshold) {}
  ~OwnRespondent() override { routine_.release_all_but_of({}); }
  OwnRespondent(const OwnRespondent&) = delete;
  OwnRespondent& operator=(const OwnRespondent&) = delete;

  void ask_within(double threshold) override {
    restart();
    threshold_ = threshold;
  }
  void restart() override { routine_.release_all_but_of({}); }
  std::vector<Answer> answers(std::span<const Configuration> configurations) override {
    restart();
    return answer(configurations, {}, {});
  }
  std::vector<Answer> answers_until_timeout(std::span<const Configuration> configurations,
                                            bool) override {
    return answers(configurations);
  }
  std::vector<Answer> answer(std::span<const Configuration> configurations,
                             std::span<const Vec3* const> previous_normals,
                             std::span<const double> thresholds) override {
    std::vector<Answer> result;
    result.reserve(configurations.size());
    for (std::size_t i = 0; i < configurations.size(); ++i) {
      const Question question =
          question_of(configurations[i], thresholds.empty() ? threshold_ : thresholds[i],
                      previous_normals.empty() ? nullptr : previous_normals[i]);
      double model_distance;
      routine_.ask(question, result.emplace_back(), model_distance);
      if (!std::isnan(model_distance)) result.back().model_distance = model_distance;
    }
    return result;
  }
  bool prepare_timing(std::span<const Configuration>) override { return false; }
  std::optional<QueryCost> cost_per_query() override { return std::nullopt; }

 private:
  Routine routine_;
  double threshold_;
};

}  // namespace

bool is_own(const Candidate& candidate) {
  constexpr std::array own = {"touchstone-reference.so", "touchstone-simplified.so",
                              "touchstone-box-parts.so"};
  return !candidate.added && candidate.plugin.parent_path() == standard_folder() &&
         std::ranges::find(own, candidate.plugin.filename()) != own.end();
}

std::unique_ptr<Respondent> own_respondent(const Candidate& candidate, double threshold) {
  return std::make_unique<OwnRespondent>(candidate, threshold);
}

}  // namespace touchstone
