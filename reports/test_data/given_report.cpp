#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <stdexcept>

#include "candidates/host/interruption.hpp"
#include "reports/make_report.hpp"
#include "reports/test_data/given_answers.hpp"

namespace touchstone {

Answer GivenAnswer::answer() const {
  Answer result{};
  result.status = status;
  result.signed_distance = signed_distance;
  for (int i = 0; i < 3; ++i) result.normal[i] = normal[i];
  result.point_count = static_cast<int>(points.size());
  std::copy(points.begin(), points.end(), result.points);
  result.roundings = roundings;
  return result;
}

namespace {

Configuration configuration_of(const PoseClass& cell, std::uint64_t seed,
                               const GivenAnswer& answer) {
  return answer.configuration ? *answer.configuration
                              : make_configuration({cell, seed, answer.index});
}

/// What tells the configurations of given answers from others, in whatever order they are; empty
/// where they are the first of their class, as in a report of candidates that are asked.
std::string digest_of(const GivenAnswers::OfCell& given, std::uint64_t seed) {
  const auto& [cell, answers] = given;
  if (cell.group() != Group::given && answers.back().index == answers.size() - 1) return "";
  std::uint64_t sum = 0;
  for (const GivenAnswer& answer : answers) sum += hash_of(configuration_of(cell, seed, answer));
  return fmt::format("{:016x}", sum);
}

Sample sample_of(const GivenAnswers::OfCell& given, std::uint64_t seed, const Bar& bar,
                 const Unit& unit) {
  Sample result(1, Resolution::exact);
  for (std::uint64_t i = unit.first; i < unit.last; ++i) {
    const GivenAnswer& answer = given.answers[i];
    const Configuration c = configuration_of(given.cell, seed, answer);
    try {
      score_answers({&c, 1}, {{answer.answer()}}, bar, truth_width,
                    [&](const ScoredConfiguration& s) { result.add(unit.cell, answer.index, s); });
    } catch (const std::exception& e) {
      throw std::runtime_error(answer.id + ": " + e.what());
    }
  }
  return result;
}

}  // namespace

Report report_of(const GivenAnswers& given, std::uint64_t seed, const Bar& bar, unsigned workers,
                 const std::string& command) {
  const auto start = std::chrono::steady_clock::now();
  std::vector<PoseClass> cells;
  std::vector<std::uint64_t> counts;
  for (const auto& [cell, answers] : given.cells) {
    cells.push_back(cell);
    counts.push_back(answers.size());
  }
  const auto score = [&](const UnitRun& run) {
    std::vector<Sample> result;
    for (const Unit& unit : run) {
      result.push_back(sample_of(given.cells[unit.cell], seed, bar, unit));
    }
    return result;
  };
  const auto first_id = [&](const Unit& unit) {
    return given.cells[unit.cell].answers[unit.first].id;
  };
  const auto samples = sample_cells({1, Resolution::exact, workers, score, first_id}, counts);

  Report report = begun_report(command, seed, bar, counts);
  report.partial = interrupted();
  const Candidate& c = given.candidate;
  report.candidates = {
      {c.name, c.family, c.version, c.settings, c.models, c.precision, c.runs, true}};
  // What came with a configuration of its own is called by its id, and shown again by its numbers.
  const auto answer_to = [&](const Identity& identity) -> const GivenAnswer& {
    const auto of_cell =
        std::ranges::find(given.cells, identity.pose_class, &GivenAnswers::OfCell::cell);
    return *std::ranges::find(of_cell->answers, identity.index, &GivenAnswer::index);
  };
  Scored scored{cells, pointers(samples)};
  scored.name = [&](const Identity& identity) {
    const GivenAnswer& answer = answer_to(identity);
    return answer.configuration ? answer.id : to_string(identity);
  };
  scored.replay = [&](const Identity& identity, const std::vector<std::string>& names) {
    const GivenAnswer& answer = answer_to(identity);
    return answer.configuration ? replay_command(*answer.configuration, names)
                                : replay_command(to_string(identity), names);
  };
  add_results(report, scored);
  for (std::size_t cell = 0, scored_one = 0; cell < cells.size(); ++cell) {
    if (samples[cell]) report.classes[scored_one++].digest = digest_of(given.cells[cell], seed);
  }
  report.wall_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

}  // namespace touchstone
