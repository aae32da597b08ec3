#include "reports/campaign.hpp"

#include <chrono>
#include <cstring>
#include <stdexcept>

#include "candidates/host/candidate_process.hpp"
#include "candidates/host/progress.hpp"
#include "candidates/host/worker_processes.hpp"
#include "oracle/truth.hpp"

namespace touchstone {
namespace {

/// A Score in fixed-size form for the pipe between two processes of the same program.
struct Record {
  Outcome outcome;
  int points;
  double severity;
  double values[8];
  bool present[8];
};

Record to_record(const Score& s) {
  Record r{};
  r.outcome = s.outcome;
  r.points = s.points;
  r.severity = s.severity;
  const std::optional<double>* values[] = {&s.depth_error, &s.normal_regret, &s.normal_angle,
                                           &s.coverage,    &s.model_error,   &s.solver_error,
                                           &s.point_error, &s.deepest_error};
  for (int i = 0; i < std::ssize(values); ++i) {
    r.present[i] = values[i]->has_value();
    r.values[i] = values[i]->value_or(0);
  }
  return r;
}

Score from_record(const Record& r) {
  const auto value = [&](int i) {
    return r.present[i] ? std::optional<double>(r.values[i]) : std::nullopt;
  };
  Score s;
  s.outcome = r.outcome;
  s.depth_error = value(0);
  s.normal_regret = value(1);
  s.normal_angle = value(2);
  s.coverage = value(3);
  s.model_error = value(4);
  s.solver_error = value(5);
  s.point_error = value(6);
  s.deepest_error = value(7);
  s.points = r.points;
  s.severity = r.severity;
  return s;
}

/// Per configuration: the oracle's time and the signed distance, then one record per candidate.
std::string score_cell(const Campaign& campaign, std::vector<CandidateProcess>& candidates,
                       const Cell& cell) {
  std::string bytes;
  const auto append = [&](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  score_range(campaign, candidates, cell, 0, campaign.count, [&](const ScoredConfiguration& s) {
    append(s.oracle_microseconds);
    append(s.signed_distance);
    for (const Score& of_candidate : s.scores) append(to_record(of_candidate));
  });
  return bytes;
}

CellScores parse_cell(const Campaign& campaign, const std::string& bytes) {
  CellScores result;
  result.scores.resize(campaign.candidates.size());
  const char* at = bytes.data();
  const auto take = [&](auto& value) {
    std::memcpy(&value, at, sizeof value);
    at += sizeof value;
  };
  for (std::uint64_t i = 0; i < campaign.count && !bytes.empty(); ++i) {
    take(result.oracle_microseconds.emplace_back());
    take(result.signed_distance.emplace_back());
    for (auto& scores : result.scores) {
      Record record;
      take(record);
      scores.push_back(from_record(record));
    }
  }
  return result;
}

}  // namespace

std::vector<Cell> cells(const Campaign& campaign) {
  std::vector<Cell> result;
  check_pose_classes(campaign.pairs, campaign.classes);
  for (const Pair pair : campaign.pairs) {
    for (const auto& name : pose_classes(pair, campaign.classes)) result.push_back({pair, name});
  }
  return result;
}

void score_range(const Campaign& campaign, std::vector<CandidateProcess>& candidates,
                 const Cell& cell, std::uint64_t first, std::uint64_t last,
                 const std::function<void(const ScoredConfiguration&)>& take) {
  const auto identity = [&](std::uint64_t i) {
    return Identity{cell.pair, cell.pose_class, campaign.seed, i};
  };
  std::vector<Configuration> configurations;
  for (std::uint64_t i = first; i < last; ++i) {
    configurations.push_back(make_configuration(identity(i)));
  }
  std::vector<std::vector<Answer>> answers;
  for (CandidateProcess& candidate : candidates) {
    answers.push_back(candidate.answers(configurations));
  }
  for (std::uint64_t i = first; i < last; ++i) {
    const Configuration& c = configurations[i - first];
    try {
      const auto start = std::chrono::steady_clock::now();
      const oracle::Truth truth = oracle::truth(c);
      ScoredConfiguration result;
      result.index = i;
      result.oracle_microseconds =
          std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start)
              .count();
      result.signed_distance = truth.signed_distance.midpoint();
      for (const auto& of_candidate : answers) {
        result.scores.push_back(score(c, truth, of_candidate[i - first], campaign.bar));
      }
      take(result);
    } catch (const std::exception& e) {
      throw std::runtime_error(to_string(identity(i)) + ": " + e.what());
    }
  }
}

std::vector<CellScores> run(const Campaign& campaign) {
  const std::vector<Cell> all = cells(campaign);
  Progress progress("configurations", all.size() * campaign.count);
  std::vector<CandidateProcess> candidates;  // each worker starts its own
  const auto results = run_in_processes(
      all.size(), campaign.workers,
      [&](std::size_t i) {
        if (candidates.empty()) {
          candidates = start(campaign.candidates, campaign.bar.threshold, campaign.limits);
        }
        return score_cell(campaign, candidates, all[i]);
      },
      [&](std::size_t i) { return std::string(pair_name(all[i].pair)) + "/" + all[i].pose_class; },
      [&](std::size_t done) { progress.update(done * campaign.count); });
  std::vector<CellScores> scores;
  for (const std::string& bytes : results) scores.push_back(parse_cell(campaign, bytes));
  return scores;
}

}  // namespace touchstone
