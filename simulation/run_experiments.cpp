#include "simulation/run_experiments.hpp"

#include <algorithm>

#include "candidates/host/progress.hpp"
#include "candidates/host/worker_processes.hpp"
#include "properties/files/bytes.hpp"
#include "simulation/experiment.hpp"
#include "simulation/experiment_setup.hpp"
#include "simulation/world.hpp"

namespace touchstone {
namespace {

/// One experiment to run.
struct Task {
  const Experiment* experiment;
  const Candidate* candidate;
  double step;
};

/// All tasks, ordered by experiment, then step, then candidate.
std::vector<Task> tasks(const ExperimentOptions& options) {
  std::vector<Task> result;
  for (const Experiment* e : options.experiments) {
    for (const double step : options.steps) {
      for (const Candidate* c : options.candidates) result.push_back({e, c, step});
    }
  }
  return result;
}

/// One candidate for the scenes of an experiment, all in one session: to begin a session takes
/// longer than a hundred steps. Keeps a sample of the configurations in contact, evenly spread over
/// the scenes.
class SamplingModel : public ContactModel {
 public:
  explicit SamplingModel(CandidateProcess& process) : process_(process), model_(process) {}
  void begin() override { process_.release_shapes(); }
  std::vector<Answer> answers(std::span<const PairQuestion> questions) override {
    auto result = model_.answers(questions);
    for (std::size_t i = 0; i < questions.size(); ++i) {
      if (result[i].status != TS_CONTACT || seen_++ % stride_ != 0) continue;
      sample_.push_back(questions[i].configuration);
      if (sample_.size() < 2 * min_size) continue;
      for (std::size_t k = 0; k < min_size; ++k) sample_[k] = sample_[2 * k];
      sample_.resize(min_size, sample_.front());
      stride_ *= 2;
    }
    return result;
  }
  const std::vector<Configuration>& sample() const { return sample_; }

 private:
  static constexpr std::size_t min_size = 50;  // of the sample of a long run
  CandidateProcess& process_;
  CandidateModel model_;
  std::vector<Configuration> sample_;
  std::size_t seen_ = 0, stride_ = 1;
};

/// Nanoseconds per query of the narrow phase alone, median over a few rounds; absent where it
/// cannot be timed.
std::optional<double> query_time(CandidateProcess& process,
                                 const std::vector<Configuration>& configurations) {
  constexpr int rounds = 5;
  if (configurations.empty() || !process.prepare_timing(configurations)) return std::nullopt;
  std::vector<double> samples;
  for (int i = 0; i < rounds; ++i) {
    if (const auto cost = process.cost_per_query()) samples.push_back(cost->nanoseconds);
  }
  if (samples.empty()) return std::nullopt;
  const auto middle = samples.begin() + static_cast<std::ptrdiff_t>((samples.size() - 1) / 2);
  std::nth_element(samples.begin(), middle, samples.end());
  return *middle;
}

ExperimentResult run(const Task& task, CandidateProcess& process) {
  process.ask_within(simulation_threshold);  // as if it had been asked nothing before
  SamplingModel sampling(process);
  const Measurement measured = task.experiment->run(in_our_world(sampling), task.step);
  ExperimentResult r = result_of(*task.experiment, task.candidate->name, task.step, measured);
  if (r.outcome != ExperimentResult::Outcome::unsupported) {
    r.nanoseconds = query_time(process, sampling.sample());
  }
  return r;
}

}  // namespace

ExperimentResult result_of(const Experiment& experiment, const std::string& candidate, double step,
                           const Measurement& m) {
  const RunTally& t = m.tally;
  const double steps = static_cast<double>(std::max<std::uint64_t>(t.steps, 1));
  const auto share = [&](std::uint64_t count) { return static_cast<double>(count) / steps; };

  ExperimentResult r;
  r.experiment = experiment.name;
  r.candidate = candidate;
  r.step = step;
  r.outcome = t.unsupported ? ExperimentResult::Outcome::unsupported
              : t.unsound   ? ExperimentResult::Outcome::unsound
                            : ExperimentResult::Outcome::measured;
  if (t.unsupported) return r;
  r.value = m.value;
  r.error = m.error;
  r.exact = !t.unsound && m.error <= experiment.resolution(step) &&
            !(experiment.rests && m.value > rest_energy(step, experiment.radius));
  r.energy_gained = t.energy_gained;
  r.points = share(t.points);
  r.flicker = share(t.flickers);
  r.single = share(t.single);
  r.without = share(t.without);
  r.failures = t.failures;
  r.details = {m.details.begin(), m.details.end()};
  r.steps = t.steps;
  r.microseconds_per_step = 1e6 * t.seconds / steps;
  r.last_motion = t.last_motion;
  r.last_time = t.last_time;
  return r;
}

bool ExperimentResult::comes_to_rest() const {
  constexpr double still = 0.5;  // s
  return outcome == Outcome::measured && last_motion < last_time - still;
}

ExperimentDescription describe(const Experiment& experiment, const std::vector<double>& steps) {
  ExperimentDescription d{
      experiment.name, experiment.statement, experiment.quantity, experiment.unit, {}, {},
      experiment.rests};
  for (const double step : steps) {
    d.expected.push_back(experiment.expected(step));
    d.resolution.push_back(experiment.resolution(step));
  }
  return d;
}

ExperimentResults run_experiments(const ExperimentOptions& options) {
  const std::vector<Task> all = tasks(options);
  Progress progress("experiments", all.size());
  WorkerCandidates processes(options.candidates, simulation_threshold, options.limits);
  const auto texts = run_in_processes(
      all.size(), options.workers,
      [&](std::size_t i) {
        const std::size_t candidate = i % options.candidates.size();  // the order of the tasks
        return to_bytes(run(all[i], processes.get()[candidate]));
      },
      [&](std::size_t i) { return all[i].experiment->name + " with " + all[i].candidate->name; },
      [&](std::size_t done) { progress.update(done); });
  ExperimentResults results{options.steps, {}, {}};
  for (const Experiment* e : options.experiments) {
    results.experiments.push_back(describe(*e, options.steps));
  }
  for (const std::string& text : texts) {
    if (!text.empty()) results.results.push_back(from_bytes<ExperimentResult>(text));
  }
  return results;
}

}  // namespace touchstone
