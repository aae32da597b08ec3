#include "reports/casts.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <limits>

#include "candidates/host/ask_cast.hpp"
#include "candidates/host/progress.hpp"
#include "candidates/host/worker_processes.hpp"
#include "properties/casts.hpp"
#include "properties/files/bytes.hpp"
#include "reports/campaign.hpp"
#include "reports/replay.hpp"
#include "reports/report_members.hpp"
#include "reports/row_text.hpp"

namespace touchstone {
namespace {

/// Of each motion, in a pair and group: the whole takes some three seconds on two cores.
constexpr std::uint64_t casts_of_motion = 8;
constexpr Group groups_with_casts[] = {Group::everyday, Group::degenerate, Group::extreme};

/// The casts of one pair in one group.
struct CastCell {
  Pair pair;
  Group group;
  std::vector<PoseClass> classes;
};

std::vector<CastCell> cells_with_casts(const Campaign& campaign) {
  std::vector<CastCell> cells;
  for (const Pair pair : campaign.pairs) {
    for (const Group group : groups_with_casts) {
      if (!campaign.groups.empty() && std::ranges::count(campaign.groups, group) == 0) continue;
      CastCell cell{pair, group, selected(pair, {campaign.classes, {group}})};
      if (!cell.classes.empty()) cells.push_back(std::move(cell));
    }
  }
  return cells;
}

/// Each motion upon classes in turn, beginning elsewhere for each.
std::vector<CastIdentity> casts_of(const CastCell& cell, std::uint64_t seed) {
  constexpr std::size_t stride = 7;
  std::vector<CastIdentity> casts;
  std::size_t at = 0;
  for (const CastMotion& motion : cast_motions()) {
    for (std::uint64_t i = 0; i < casts_of_motion; ++i, at += stride) {
      casts.push_back({Identity{cell.classes[at % cell.classes.size()], seed, i}, &motion});
    }
  }
  return casts;
}

/// Larger is worse; what gave no answer is the worst.
double severity_of(const CastScore& score) {
  if (score.outcome == CastOutcome::failed) return std::numeric_limits<double>::infinity();
  return std::max(std::abs(score.distance.value_or(0)), score.normal_regret.value_or(0));
}

/// Adds a candidate's row and worst case, unless it has no casts of the pair.
void add_answers(Casts& casts, const CastCell& cell, const Candidate& candidate,
                 const std::vector<CastIdentity>& identities,
                 const std::vector<CastQuestion>& questions,
                 const std::vector<oracle::FirstTouch>& truths, const Bar& bar) {
  const auto answers = ask_casts(candidate, questions);
  Casts::Row row{pair_name(cell.pair), group_name(cell.group), candidate.name, 0, {}, {}, {}, {}};
  std::optional<Casts::Worst> worst;
  double worst_severity = -1;
  std::vector<double> distances;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    if (!answers[i]) continue;
    const auto& [c, sweep] = questions[i];
    const CastScore score = answers[i]->cast
                                ? score_cast(c, Sweep(sweep), truths[i], *answers[i]->cast, bar)
                                : CastScore{CastOutcome::failed, {}, {}};
    ++row.count;
    ++row.outcomes[score.outcome];
    if (score.distance) {
      const bool is_inside_from_start =
          truths[i].status == oracle::FirstTouch::Status::from_start &&
          score.outcome == CastOutcome::agree;
      if (!is_inside_from_start) distances.push_back(std::abs(*score.distance));
    }
    if (score.outcome == CastOutcome::agree) continue;
    ++row.wrong_by_motion[identities[i].motion->name];
    if (severity_of(score) <= worst_severity) continue;
    worst_severity = severity_of(score);
    const std::string id = to_string(identities[i]);
    worst = {id,
             row.pair,
             row.group,
             row.candidate,
             score.outcome,
             score.distance,
             score.normal_regret,
             replay_command(id, {candidate.name}),
             answers[i]->cast ? std::optional(answers[i]->cast->fraction) : std::nullopt};
  }
  if (row.count == 0) return;
  if (!distances.empty()) {
    std::ranges::sort(distances);
    row.distance_p99 = distances[(distances.size() - 1) * 99 / 100];
    row.distance_max = distances.back();
  }
  casts.results.push_back(std::move(row));
  if (worst) casts.worst.push_back(std::move(*worst));
}

Casts casts_of_cell(const CastCell& cell, const Campaign& campaign) {
  const std::vector<CastIdentity> identities = casts_of(cell, campaign.seed);
  std::vector<CastQuestion> questions;
  std::vector<oracle::FirstTouch> truths;
  for (const CastIdentity& identity : identities) {
    questions.push_back(make_cast(identity));
    truths.push_back(
        oracle::first_touch(questions.back().configuration, Sweep(questions.back().sweep)));
  }
  Casts casts;
  for (const Candidate* candidate : campaign.candidates) {
    add_answers(casts, cell, *candidate, identities, questions, truths, campaign.bar);
  }
  return casts;
}

}  // namespace

Casts measure_casts(const Campaign& campaign) {
  const std::vector<CastCell> cells = cells_with_casts(campaign);
  const std::size_t of_cell = casts_of_motion * cast_motions().size();
  Progress progress("casts", cells.size() * of_cell);
  const std::vector<std::string> texts = run_in_processes(
      cells.size(), campaign.workers,
      [&](std::size_t i) { return to_bytes(casts_of_cell(cells[i], campaign)); },
      [&](std::size_t i) {
        return fmt::format("casts of {}, {}", pair_name(cells[i].pair), group_name(cells[i].group));
      },
      [&](std::size_t done) { progress.update(done * of_cell); });
  Casts all;
  all.count = casts_of_motion;
  for (const std::string& text : texts) {
    if (text.empty()) continue;  // interrupted before
    Casts part = from_bytes<Casts>(text);
    std::ranges::move(part.results, std::back_inserter(all.results));
    std::ranges::move(part.worst, std::back_inserter(all.worst));
  }
  return all;
}

namespace {

/// What a candidate's rows of one group come to.
Casts::Row sum_over_pairs(const Casts& casts, const std::string& group,
                          const std::string& candidate) {
  Casts::Row sum{"all", group, candidate, 0, {}, {}, {}, {}};
  for (const Casts::Row& row : casts.results) {
    if (row.group != group || row.candidate != candidate) continue;
    sum.count += row.count;
    for (const auto& [outcome, count] : row.outcomes) sum.outcomes[outcome] += count;
  }
  return sum;
}

std::uint64_t count_of(const Casts::Row& row, CastOutcome outcome) {
  const auto found = row.outcomes.find(outcome);
  return found == row.outcomes.end() ? 0 : found->second;
}

/// "bullet 62.1 (83)": the share that is right, and how many pass through.
std::string row_words(const Casts::Row& row) {
  const double share =
      static_cast<double>(count_of(row, CastOutcome::agree)) / static_cast<double>(row.count);
  // Cut downwards, as all shares are: 100.0 is without a fault.
  return fmt::format("{} {:.1f} ({})", row.candidate, std::floor(1000 * share) / 10,
                     count_of(row, CastOutcome::late) + count_of(row, CastOutcome::missed));
}

}  // namespace

std::string casts_text(const Report& report, const Terminal& terminal) {
  if (!report.casts || report.casts->results.empty()) return "";
  const Casts& casts = *report.casts;
  const std::string& group = casts.results.front().group;
  std::string words;
  std::uint64_t count = 0;
  for (const CandidateDescription& c : report.candidates) {
    const Casts::Row row = sum_over_pairs(casts, group, c.name);
    if (row.count == 0) continue;
    words += (words.empty() ? "" : ", ") + row_words(row);
    count = std::max(count, row.count);
  }
  const Casts::Worst* worst = nullptr;
  const auto severity = [](const Casts::Worst& w) {
    return severity_of({w.outcome, w.distance, w.normal_regret});
  };
  for (const Casts::Worst& w : casts.worst) {
    if (w.group == group && (!worst || severity(w) > severity(*worst))) worst = &w;
  }
  return '\n' +
         terminal.folded(fmt::format("Casts, % of {} {} ones whose first touch is right, and how "
                                     "many pass through: {}.",
                                     count, group, words)) +
         (worst ? "  " + worst->replay + '\n' : "");
}

}  // namespace touchstone
