#include "reports/make_report.hpp"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <fstream>
#include <numeric>
#include <span>
#include <string>
#include <sys/utsname.h>
#include <unistd.h>
#include <utility>

#include "candidates/host/interruption.hpp"
#include "properties/identity.hpp"
#include "properties/named.hpp"
#include "reports/factors.hpp"
#include "reports/row_text.hpp"
#include "reports/statistics.hpp"
#include "reports/tally.hpp"

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

std::vector<std::string> names_of(const std::vector<CandidateDescription>& candidates) {
  std::vector<std::string> names;
  for (const CandidateDescription& c : candidates) names.push_back(c.name);
  return names;
}

std::optional<QueryTime> time_of(const std::vector<std::string>& names, const Times& times,
                                 const std::vector<std::size_t>& cells, std::size_t k) {
  if (times.empty()) return std::nullopt;
  auto time = query_time(times, cells, k);
  const auto bullet = std::find(names.begin(), names.end(), "bullet");
  if (time && bullet != names.end()) {
    const auto b = static_cast<std::size_t>(bullet - names.begin());
    time->ratio_to_bullet = time_ratio(times, cells, k, b);
  }
  return time;
}

/// Rows of all candidates on these cells together. `pair` and `pose_class` are what the rows are
/// called by.
std::vector<ResultRow> rows_of(const std::vector<std::string>& names, const Scored& scored,
                               const std::vector<std::size_t>& cells, const std::string& pair,
                               const std::string& pose_class) {
  std::vector<ResultRow> rows;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto part = [&](std::size_t i) { return scored.samples[cells[i]]->tallies[k]; };
    ResultRow& row = rows.emplace_back();
    row.pair = pair;
    row.pose_class = pose_class;
    row.candidate = names[k];
    row.statistics = sum_of(0, cells.size(), part).statistics();
    row.time = time_of(names, scored.times, cells, k);
  }
  return rows;
}

/// Trends under a heading.
std::vector<Trend> trends_of(const std::vector<std::string>& names, const Scored& scored,
                             const Heading& heading) {
  const auto part = [&](std::size_t i) { return scored.samples[heading.cells[i]]->trends; };
  return sum_of(0, heading.cells.size(), part)
      .trends(heading.pair, group_name(heading.group), names);
}

/// A case of one candidate, with its answer and that of the first candidate where they were kept.
WorstCase worst_case(const std::vector<std::string>& names, const Scored& scored,
                     std::uint64_t seed, const Case& c, std::size_t candidate) {
  const PoseClass& cell = scored.cells[c.cell];
  const Identity identity{cell, seed, c.index};
  const auto examined = scored.samples[c.cell]->examined(candidate, c.index);
  WorstCase result{pair_name(cell.pair),
                   group_name(cell.group()),
                   cell.name(),
                   names[candidate],
                   c.score,
                   {scored.name(identity),
                    examined ? examined->configuration : make_configuration(identity),
                    std::nullopt,
                    {},
                    ""}};
  std::vector<std::string> asked = {names[candidate]};
  if (examined) {
    result.score = examined->answers.front().second;
    result.examination.truth = examined->truth;
    std::size_t shown = candidate;
    for (const auto& [answer, score] : examined->answers) {
      result.examination.answers.push_back({names[shown], answer, score});
      shown = 0;  // the other one is the first candidate's
    }
    if (examined->answers.size() > 1) asked.insert(asked.begin(), names.front());
  }
  result.examination.replay = scored.replay(identity, asked);
  return result;
}

/// The worst cases of every candidate under a heading.
std::vector<WorstCase> worst_of(const std::vector<std::string>& names, const Scored& scored,
                                std::uint64_t seed, const Heading& heading) {
  std::vector<WorstCase> result;
  for (std::size_t k = 0; k < names.size(); ++k) {
    std::vector<Case> found;
    for (const std::size_t cell : heading.cells) {
      const auto& worst = scored.samples[cell]->tallies[k].worst;
      found.insert(found.end(), worst.begin(), worst.end());
    }
    for (const Case& c : worst_of_heading(std::move(found))) {
      result.push_back(worst_case(names, scored, seed, c, k));
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

/// What tells a file's configurations from others.
std::string digest_of_own(const std::vector<OwnConfiguration>& own) {
  std::uint64_t sum = 0;
  for (const OwnConfiguration& o : own) sum += hash_of(o.configuration);
  return fmt::format("{:016x}", sum);
}

}  // namespace

void add_results(Report& report, const Scored& scored) {
  const std::vector<PoseClass>& cells = scored.cells;
  const std::vector<std::string> names = names_of(report.candidates);
  Magnitudes oracle_times(Resolution::exact);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (!scored.samples[i]) continue;
    const Sample& sample = *scored.samples[i];
    report.completed.classes += 1;
    report.completed.configurations += sample.tallies.front().count;
    if (!scored.times.empty()) {
      const auto has_times = [](const Repetitions& r) { return !r.empty(); };
      report.timed_classes +=
          std::any_of(scored.times[i].begin(), scored.times[i].end(), has_times);
    }
    oracle_times.add(sample.oracle_microseconds);
    report.classes.push_back(description_of(cells[i]));
    auto rows = rows_of(names, scored, {i}, pair_name(cells[i].pair), cells[i].name());
    for (std::size_t k = 0; k < rows.size() && cells[i].group() != Group::given; ++k) {
      rows[k].worst_index = worst_failure(sample.tallies[k]);
    }
    report.results.insert(report.results.end(), rows.begin(), rows.end());
  }
  report.configurations = report.completed.configurations;
  report.oracle_microseconds = oracle_times.quantiles();

  const auto is_native = [&](const ResultRow& row) {
    const auto is = [&](const CandidateDescription& c) { return c.name == row.candidate; };
    return std::find_if(report.candidates.begin(), report.candidates.end(), is)->runs == "native";
  };
  const auto is_whole = [&](const ResultRow& row) {
    return row.pair != "all" ||
           covered_pairs(report, row.pose_class, row.candidate).are_all();  // which stand before it
  };
  const auto append = [](auto& list, const auto& added) {
    list.insert(list.end(), added.begin(), added.end());
  };
  const std::vector<Heading> of_groups =
      headings(cells, [&](std::size_t cell) { return scored.samples[cell] != nullptr; });
  for (const Heading& heading : of_groups) {
    auto rows = rows_of(names, scored, heading.cells, heading.pair, group_name(heading.group));
    rank(rows, is_native, is_whole);
    append(report.summary, rows);
    if (heading.pair == "all") continue;
    append(report.trends, trends_of(names, scored, heading));
    append(report.worst, worst_of(names, scored, report.seed, heading));
  }
  report.factors = factors(report);
  report.contrasts = contrasts(report);
  for (const RecordedShare& s : recorded_shares()) {
    const auto is_of = [&](const Heading& heading) { return heading.pair == pair_name(s.pair); };
    if (std::any_of(of_groups.begin(), of_groups.end(), is_of)) report.recorded.push_back(s);
  }
}

Report begun_report(const std::string& command, std::uint64_t seed, const Bar& bar,
                    const std::vector<std::uint64_t>& counts) {
  Report report;
  report.version = TOUCHSTONE_VERSION;
  report.command = command;
  report.seed = seed;
  report.tolerance = bar.tolerance;
  report.threshold = bar.threshold;
  report.machine = describe_machine();
  report.planned = {counts.size(), std::accumulate(counts.begin(), counts.end(), std::uint64_t{0})};
  return report;
}

std::vector<const Sample*> pointers(const std::vector<std::optional<Sample>>& samples) {
  std::vector<const Sample*> result;
  for (const auto& sample : samples) result.push_back(sample ? &*sample : nullptr);
  return result;
}

Report make_report(const Campaign& campaign, const std::string& command) {
  const auto start = std::chrono::steady_clock::now();
  const std::vector<PoseClass> all = cells(campaign);
  std::vector<std::uint64_t> counts;
  for (const PoseClass& cell : all) counts.push_back(count_of(campaign, cell));
  // Started before samples fill the memory: to start a plug-in's process costs the more the larger
  // this one is.
  auto candidates = touchstone::start(campaign.candidates, campaign.bar.threshold, campaign.limits);
  const auto samples = sample_cells(scorer(campaign, Resolution::exact), counts);
  const Times times = time_queries(campaign, all, samples, candidates);

  Report report = begun_report(command, campaign.seed, campaign.bar, counts);
  report.partial = interrupted();
  for (const Candidate* c : campaign.candidates) {
    report.candidates.push_back(
        {c->name, c->family, c->version, c->settings, c->models, c->precision, c->runs});
  }
  Scored scored{all, pointers(samples), times};
  if (!campaign.own.empty()) {
    scored.name = [&](const Identity& i) { return name_of(campaign, i); };
    scored.replay = [&](const Identity& i, const std::vector<std::string>& names) {
      const Subject subject{campaign.own_file, "", configuration_of(campaign, i),
                            name_of(campaign, i)};
      return replay_command(subject, names);
    };
  }
  add_results(report, scored);
  for (PoseClassDescription& c : report.classes) {
    if (c.group == group_name(Group::given))
      c.digest = digest_of_own(campaign.own.at(named(all_pairs, c.pair, "pair", pair_name)));
  }
  if (!report.partial) report.drake_protocol = drake_protocol(campaign, candidates);
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
