#include "simulation/run_experiments.hpp"

#include <algorithm>
#include <cmath>

#include "candidates/host/progress.hpp"
#include "candidates/host/worker_processes.hpp"
#include "simulation/experiment_bodies.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

/// Kinetic energy, in weight × radius, below which a body rests: a thousandth of what a fall of one
/// step gives, which is about what an iterative solver leaves of it.
double at_rest(double step) { return 1e-3 * gravity * step * step / (2 * can_radius); }

struct Trial {
  const Experiment* experiment;
  const Candidate* candidate;
  double step;
};

/// Experiment by experiment, so that its rows stand together.
std::vector<Trial> trials(const ExperimentOptions& options) {
  std::vector<Trial> result;
  for (const Experiment* e : options.experiments) {
    for (const double step : options.steps) {
      for (const Candidate* c : options.candidates) result.push_back({e, c, step});
    }
  }
  return result;
}

/// Passes questions on and keeps some of them, evenly over the whole run, to be timed later.
class SamplingModel : public ContactModel {
 public:
  explicit SamplingModel(ContactModel& model) : model_(model) {}
  void begin() override { model_.begin(); }
  std::vector<Answer> answers(std::span<const PairQuestion> questions) override {
    auto result = model_.answers(questions);
    for (std::size_t i = 0; i < questions.size(); ++i) {
      if (result[i].status != TS_CONTACT || seen_++ % stride_ != 0) continue;
      kept_.push_back(questions[i].configuration);
      if (kept_.size() < 2 * wanted) continue;
      for (std::size_t k = 0; k < wanted; ++k) kept_[k] = kept_[2 * k];
      kept_.resize(wanted, kept_.front());
      stride_ *= 2;
    }
    return result;
  }
  const std::vector<Configuration>& kept() const { return kept_; }

 private:
  static constexpr std::size_t wanted = 50;
  ContactModel& model_;
  std::vector<Configuration> kept_;
  std::size_t seen_ = 0, stride_ = 1;
};

/// Median over a few rounds of the narrow phase alone; null where it cannot be timed.
json nanoseconds(CandidateProcess& process, const std::vector<Configuration>& configurations) {
  constexpr int rounds = 5;
  if (configurations.empty() || !process.prepare_timing(configurations)) return nullptr;
  std::vector<double> samples;
  for (int i = 0; i < rounds; ++i) {
    if (const auto cost = process.cost_per_query()) samples.push_back(cost->nanoseconds);
  }
  if (samples.empty()) return nullptr;
  const auto middle = samples.begin() + static_cast<std::ptrdiff_t>((samples.size() - 1) / 2);
  std::nth_element(samples.begin(), middle, samples.end());
  return *middle;
}

json finite(double x) { return std::isfinite(x) ? json(x) : json(nullptr); }

json run(const Trial& trial, const Limits& limits) {
  CandidateProcess process(*trial.candidate, simulation_threshold, limits);
  CandidateModel model(process);
  SamplingModel sampling(model);
  const Measurement m = trial.experiment->run(sampling, trial.step);
  const RunTally& t = m.tally;
  const double steps = static_cast<double>(std::max<std::uint64_t>(t.steps, 1));
  const auto share = [&](std::uint64_t count) { return static_cast<double>(count) / steps; };

  json result = {{"experiment", trial.experiment->name},
                 {"candidate", trial.candidate->name},
                 {"step", trial.step}};
  if (t.unsupported) {
    result["outcome"] = "unsupported";
    return result;
  }
  json details = json::object();
  for (const auto& [name, value] : m.details) details[name] = finite(value);
  result["outcome"] = t.unsound ? "unsound" : "measured";
  result["value"] = finite(m.value);
  result["error"] = finite(m.error);
  result["exact"] = !t.unsound && m.error <= trial.experiment->resolution(trial.step) &&
                    !(trial.experiment->rests && m.value > at_rest(trial.step));
  result["energy_gained"] = finite(t.energy_gained);
  result["points"] = share(t.points);
  result["flicker"] = share(t.flickers);
  result["single"] = share(t.single);
  result["without"] = share(t.without);
  result["failures"] = t.failures;
  result["details"] = details;
  result["steps"] = t.steps;
  result["nanoseconds"] = nanoseconds(process, sampling.kept());
  result["microseconds_per_step"] = 1e6 * t.seconds / steps;
  return result;
}

}  // namespace

json run_experiments(const ExperimentOptions& options) {
  const std::vector<Trial> all = trials(options);
  Progress progress("experiments", all.size());
  const auto texts = run_in_processes(
      all.size(), options.workers,
      [&](std::size_t i) { return run(all[i], options.limits).dump(); },
      [&](std::size_t i) { return all[i].experiment->name + " with " + all[i].candidate->name; },
      [&](std::size_t done) { progress.update(done); });
  json results = json::array();
  for (const std::string& text : texts) results.push_back(json::parse(text));

  json experiments = json::array();
  for (const Experiment* e : options.experiments) {
    json expected = json::array(), resolution = json::array();
    for (const double step : options.steps) {
      expected.push_back(e->expected(step));
      resolution.push_back(e->resolution(step));
    }
    experiments.push_back({{"name", e->name},
                           {"statement", e->statement},
                           {"quantity", e->quantity},
                           {"unit", e->unit},
                           {"expected", expected},
                           {"resolution", resolution}});
  }
  return {{"steps", options.steps}, {"experiments", experiments}, {"results", results}};
}

}  // namespace touchstone
