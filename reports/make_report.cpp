#include "reports/make_report.hpp"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <fstream>
#include <span>
#include <string>
#include <sys/utsname.h>
#include <unistd.h>
#include <utility>

#include "candidates/host/interruption.hpp"
#include "candidates/host/progress.hpp"
#include "properties/identity.hpp"
#include "properties/numbers.hpp"
#include "properties/stable_hash.hpp"
#include "reports/covered_pairs.hpp"
#include "reports/factors.hpp"
#include "reports/replay.hpp"
#include "reports/sampler.hpp"
#include "reports/statistics.hpp"
#include "reports/tally.hpp"
#include "reports/timing.hpp"

namespace touchstone {

std::vector<Heading> headings(const std::vector<PoseClass>& cells,
                              const std::function<bool(std::size_t)>& is_scored) {
  std::vector<Group> groups;
  for (const PoseClass& cell : cells) groups.push_back(cell.group());
  std::vector<Heading> result;
  for (const Group group : reported_groups) {
    Heading all{"all", group, {}};
    std::size_t pairs = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (groups[i] != group || !is_scored(i)) continue;
      const char* pair = pair_name(cells[i].pair);
      if (pairs == 0 || result.back().pair != pair) {
        result.push_back({pair, group, {}});
        ++pairs;
      }
      result.back().cells.push_back(i);
      all.cells.push_back(i);
    }
    if (pairs > 1) result.push_back(std::move(all));
  }
  return result;
}

PoseClassDescription description_of(const PoseClass& cell) {
  auto [arrangement, modifiers] = cell.parts();
  return {pair_name(cell.pair),   cell.name(),         cell.description(), group_name(cell.group()),
          std::move(arrangement), std::move(modifiers)};
}

namespace {

/// A number made from those of a configuration.
std::uint64_t hash_of(const Configuration& configuration) {
  Numbers numbers = numbers_of(configuration);
  std::string bytes;
  for (const double* number : every_number(numbers)) {
    const double x = *number + 0.0;  // zeros of either sign are equal
    bytes.append(reinterpret_cast<const char*>(&x), sizeof x);
  }
  return stable_hash(bytes);
}

/// What tells the configurations of given answers from others, in whatever order they are; empty
/// where they are the first of their class, as in a report of candidates that are asked.
std::string digest_of(const Campaign& campaign, const PoseClass& cell) {
  if (!campaign.given) return "";
  const std::vector<GivenAnswer>& answers = answers_in(*campaign.given, cell);
  if (cell.group() != Group::given && answers.back().index == answers.size() - 1) return "";
  std::uint64_t sum = 0;
  for (const GivenAnswer& answer : answers) {
    sum += hash_of(answered_configuration(campaign, cell, answer));
  }
  return fmt::format("{:016x}", sum);
}

/// What is known of each cell; absent where the run was interrupted before all of it was scored.
std::vector<std::optional<Sample>> sample_cells(const Campaign& campaign,
                                                const std::vector<PoseClass>& cells) {
  std::vector<Unit> units;
  std::uint64_t configurations = 0;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    const EqualUnits cut{count_of(campaign, cells[cell])};
    for (std::uint64_t n = 0; n < cut.units(); ++n) units.push_back(cut.unit(cell, n));
    configurations += cut.count;
  }
  std::vector<std::optional<Sample>> parts(units.size());
  Progress progress("configurations", configurations);
  std::uint64_t done = 0;
  const std::vector<UnitRun> runs = runs_of(units, run_size);
  std::vector<std::size_t> first_of_run;
  for (std::size_t unit = 0; const UnitRun& run : runs) {
    first_of_run.push_back(unit);
    unit += run.size();
  }
  sample(
      campaign, Purpose::report, runs.size(), [&](std::uint64_t number) { return runs[number]; },
      [&](std::uint64_t number, std::vector<Sample> samples) {
        for (std::size_t i = 0; i < samples.size(); ++i) {
          parts[first_of_run[number] + i] = std::move(samples[i]);
          const Unit& unit = runs[number][i];
          done += unit.last - unit.first;
        }
        progress.update(done);
      },
      [] { return !interrupted(); });

  std::vector<std::optional<Sample>> result(cells.size());
  for (std::size_t first = 0, last = 0; first < units.size(); first = last) {
    while (last < units.size() && units[last].cell == units[first].cell) ++last;
    const std::span of_cell = std::span(parts).subspan(first, last - first);
    if (!std::all_of(of_cell.begin(), of_cell.end(), [](const auto& part) { return !!part; })) {
      continue;
    }
    auto& whole = result[units[first].cell];
    whole = std::move(of_cell.front());
    for (const auto& part : of_cell.subspan(1)) whole->add(*part);
  }
  return result;
}

std::optional<QueryTime> time_of(const Campaign& campaign, const Times& times,
                                 const std::vector<std::size_t>& cells, std::size_t k) {
  auto time = query_time(times, cells, k);
  for (std::size_t b = 0; time && b < campaign.candidates.size(); ++b) {
    if (campaign.candidates[b]->name != "bullet") continue;
    time->ratio_to_bullet = time_ratio(times, cells, k, b);
  }
  return time;
}

/// Rows of all candidates on these cells together. `pair` and `pose_class` are what the rows are
/// called by.
std::vector<ResultRow> rows_of(const Campaign& campaign,
                               const std::vector<std::optional<Sample>>& samples,
                               const Times& times, const std::vector<std::size_t>& cells,
                               const std::string& pair, const std::string& pose_class) {
  std::vector<ResultRow> rows;
  for (std::size_t k = 0; k < campaign.candidates.size(); ++k) {
    ScoreTally tally(Precision::exact);
    for (const std::size_t cell : cells) tally.add(samples[cell]->tallies[k]);
    ResultRow& row = rows.emplace_back();
    row.pair = pair;
    row.pose_class = pose_class;
    row.candidate = campaign.candidates[k]->name;
    row.statistics = tally.statistics();
    row.time = time_of(campaign, times, cells, k);
  }
  return rows;
}

std::vector<Trend> trends_of(const Campaign& campaign,
                             const std::vector<std::optional<Sample>>& samples,
                             const std::vector<Heading>& all) {
  std::vector<std::string> names;
  for (const Candidate* c : campaign.candidates) names.push_back(c->name);
  std::vector<Trend> result;
  for (const Heading& heading : all) {
    if (heading.pair == "all") continue;
    TrendTally tally;
    for (const std::size_t cell : heading.cells) tally.add(samples[cell]->trends);
    const auto trends = tally.trends(heading.pair, group_name(heading.group), names);
    result.insert(result.end(), trends.begin(), trends.end());
  }
  return result;
}

/// The id of a configuration that came in a file with others; otherwise its identity.
std::string name_of(const Campaign& campaign, const Identity& identity) {
  if (identity.pose_class.group() != Group::given) return to_string(identity);
  const auto& answers = answers_in(*campaign.given, identity.pose_class);
  return std::find_if(answers.begin(), answers.end(),
                      [&](const GivenAnswer& a) { return a.index == identity.index; })
      ->id;
}

WorstCase worst_case(const Campaign& campaign, const Sample& sample, const Identity& identity,
                     std::size_t candidate) {
  auto [configuration, truth, answers] = sample.examined(candidate, identity.index);
  const std::string id = name_of(campaign, identity);
  std::vector<std::string> names = {campaign.candidates[candidate]->name};
  if (answers.size() > 1) names.insert(names.begin(), campaign.candidates.front()->name);
  const PoseClass& c = identity.pose_class;
  const std::string replay =
      c.group() == Group::given ? replay_command(configuration, names) : replay_command(id, names);
  WorstCase result{pair_name(c.pair),
                   group_name(c.group()),
                   c.name(),
                   campaign.candidates[candidate]->name,
                   answers.front().second,
                   {id, configuration, std::move(truth), {}, replay}};
  std::size_t shown = candidate;
  for (auto& [answer, score] : answers) {
    result.examination.answers.push_back(
        {campaign.candidates[shown]->name, std::move(answer), score});
    shown = 0;  // the other one is the first candidate's
  }
  return result;
}

/// The worst configurations of every pair × group × candidate, each with the candidate's answer and
/// that of the campaign's first.
std::vector<WorstCase> worst_of(const Campaign& campaign, const std::vector<PoseClass>& cells,
                                const std::vector<std::optional<Sample>>& samples,
                                const std::vector<Heading>& all) {
  std::vector<WorstCase> result;
  for (const Heading& heading : all) {
    if (heading.pair == "all") continue;
    for (std::size_t k = 0; k < campaign.candidates.size(); ++k) {
      std::vector<Case> found;
      for (const std::size_t cell : heading.cells) {
        const auto& worst = samples[cell]->tallies[k].worst;
        found.insert(found.end(), worst.begin(), worst.end());
      }
      for (const Case& c : worst_of_heading(std::move(found))) {
        const Identity identity{cells[c.cell], campaign.seed, c.index};
        result.push_back(worst_case(campaign, *samples[c.cell], identity, k));
      }
    }
  }
  return result;
}

SpeedAccuracy place_of(const ResultRow& row) {
  /// Half an ulp of the size or less: no difference in accuracy.
  constexpr double no_error = 1e-17;
  const std::optional<Quantiles>& error = row.statistics.depth_error;
  const Spread& time = row.time->nanoseconds;
  return {time.low, time.high, std::max(error ? error->p99 : 0, no_error)};
}

/// Finds which rows under one heading are on the front of speed and accuracy, and whose times tie.
/// `is_whole`: over all pairs of the heading; others are in no order with those.
void rank(std::span<ResultRow> rows, const std::function<bool(const ResultRow&)>& is_native,
          const std::function<bool(const ResultRow&)>& is_whole) {
  std::vector<ResultRow*> placed;
  std::vector<SpeedAccuracy> places;
  for (ResultRow& row : rows) {
    if (!row.time) continue;
    for (const ResultRow& other : rows) {
      if (&other == &row || !other.time || !tied_in_time(place_of(row), place_of(other))) continue;
      row.tied_with.push_back(other.candidate);
    }
    // Without a contact there is no error, and no place in the chart.
    if (!row.statistics.depth_error || !is_whole(row)) continue;
    placed.push_back(&row);
    places.push_back(place_of(row));
    places.back().is_native = is_native(row);
  }
  const std::vector<bool> front = pareto_front(places);
  for (std::size_t i = 0; i < placed.size(); ++i) placed[i]->pareto = front[i];
}

}  // namespace

Report make_report(const Campaign& campaign, const std::string& command) {
  const auto start = std::chrono::steady_clock::now();
  const std::vector<PoseClass> all = cells(campaign);
  // Started before samples fill the memory: to start a plug-in's process costs the more the larger
  // this one is.
  auto candidates = campaign.given ? std::vector<CandidateProcess>()
                                   : touchstone::start(campaign.candidates, campaign.bar.threshold,
                                                       campaign.limits);
  const std::vector<std::optional<Sample>> samples = sample_cells(campaign, all);
  const Times times = time_queries(campaign, all, samples, candidates);

  Report report;
  report.version = TOUCHSTONE_VERSION;
  report.command = command;
  report.seed = campaign.seed;
  report.tolerance = campaign.bar.tolerance;
  report.threshold = campaign.bar.threshold;
  report.machine = describe_machine();
  report.partial = interrupted();
  for (const Candidate* c : campaign.candidates) {
    report.candidates.push_back({c->name, c->family, c->version, c->settings, c->models,
                                 c->precision, c->runs, campaign.given != nullptr});
  }

  std::vector<double> oracle_times;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::uint64_t count = count_of(campaign, all[i]);
    report.planned.classes += 1;
    report.planned.configurations += count;
    if (!samples[i]) continue;
    report.completed.classes += 1;
    report.completed.configurations += count;
    const auto has_times = [](const Repetitions& r) { return !r.empty(); };
    report.timed_classes += std::any_of(times[i].begin(), times[i].end(), has_times);
    oracle_times.insert(oracle_times.end(), samples[i]->oracle_microseconds.begin(),
                        samples[i]->oracle_microseconds.end());
    report.classes.push_back(description_of(all[i]));
    report.classes.back().digest = digest_of(campaign, all[i]);
    auto rows = rows_of(campaign, samples, times, {i}, pair_name(all[i].pair), all[i].name());
    for (std::size_t k = 0; k < rows.size() && all[i].group() != Group::given; ++k) {
      rows[k].worst_index = worst_failure(samples[i]->tallies[k]);
    }
    report.results.insert(report.results.end(), rows.begin(), rows.end());
  }
  report.configurations = report.completed.configurations;
  report.oracle_microseconds = quantiles(std::move(oracle_times));

  const auto is_scored = [&](std::size_t cell) { return samples[cell].has_value(); };
  const std::vector<Heading> of_groups = headings(all, is_scored);
  const auto is_native = [&](const ResultRow& row) {
    const auto is = [&](const CandidateDescription& c) { return c.name == row.candidate; };
    return std::find_if(report.candidates.begin(), report.candidates.end(), is)->runs == "native";
  };
  const auto is_whole = [&](const ResultRow& row) {
    return row.pair != "all" ||
           covered_pairs(report, row.pose_class, row.candidate).are_all();  // which stand before it
  };
  for (const Heading& heading : of_groups) {
    auto rows =
        rows_of(campaign, samples, times, heading.cells, heading.pair, group_name(heading.group));
    rank(rows, is_native, is_whole);
    report.summary.insert(report.summary.end(), rows.begin(), rows.end());
  }
  report.factors = factors(report);
  report.contrasts = contrasts(report);
  report.trends = trends_of(campaign, samples, of_groups);
  for (const RecordedShare& s : recorded_shares()) {
    const auto is_of = [&](const Heading& heading) { return heading.pair == pair_name(s.pair); };
    if (std::any_of(of_groups.begin(), of_groups.end(), is_of)) report.recorded.push_back(s);
  }
  report.worst = worst_of(campaign, all, samples, of_groups);
  if (!report.partial && !campaign.given) {
    report.drake_protocol = drake_protocol(campaign, candidates);
  }
  report.wall_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

namespace {

/// The text after `key` and a separator on the first line of a file that begins with it.
std::string value_in(const char* path, const std::string& key, char separator) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (line.rfind(key, 0) != 0) continue;
    std::string value = line.substr(line.find(separator) + 1);
    std::erase(value, '"');
    const std::size_t start = value.find_first_not_of(" \t");
    return start == std::string::npos ? "" : value.substr(start);
  }
  return "";
}

}  // namespace

Machine describe_machine() {
  utsname system{};
  uname(&system);
  std::string cpu = value_in("/proc/cpuinfo", "model name", ':');
  if (cpu.empty()) cpu = system.machine;
  std::string os = value_in("/etc/os-release", "PRETTY_NAME", '=');
  if (os.empty()) os = system.sysname;
  const std::string compiler = fmt::format("g++ {} {}", __VERSION__, TOUCHSTONE_FLAGS);
  return {cpu, compiler, os, static_cast<unsigned>(sysconf(_SC_NPROCESSORS_ONLN))};
}

}  // namespace touchstone
