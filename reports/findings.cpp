#include "reports/findings.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>
#include <tuple>

#include "properties/files/given_text.hpp"
#include "reports/factors.hpp"
#include "reports/row_text.hpp"
#include "reports/terminal.hpp"

namespace touchstone {
namespace {

constexpr std::size_t max_findings = 3;

/// A finding with what it is chosen by.
struct Failing {
  Finding finding;
  std::string pair;
  bool is_seam;  ///< of a floor of triangles
  bool is_contrast;
  int rarity;    ///< the less the sooner: of a contrast, or the place of the group
  double share;  ///< by which agreement falls, or that fails
};

/// "bullet" for all its variants.
std::string engine_of(const std::string& candidate) {
  return candidate.substr(0, candidate.find_first_of("-+:"));
}

std::vector<Failing> contrasts_that_fail(const Report& report) {
  std::vector<Failing> result;
  for (const Contrast* c : failing_contrasts(report)) {
    const std::string text = fmt::format("{}: {}", shown_name(c->candidate), contrast_text(*c));
    result.push_back({{c->candidate, text, contrast_command(*c)},
                      c->pair,
                      false,
                      true,
                      rarity(*c),
                      c->modified.share() - c->plain.share()});
  }
  return result;
}

/// What the candidate's model costs, and how well it is solved: which of them a failure comes from.
std::string model_text(const Statistics& s) {
  if (!s.model_error || !s.solver_error) return "";
  return fmt::format("; 99%: what it models is off by at most {} of the size, and solved to {}",
                     scientific(s.model_error, &Quantiles::p99),
                     scientific(s.solver_error, &Quantiles::p99));
}

/// Are its floors triangles (candidates/floor.hpp)?
bool has_seams(const std::string& candidate) {
  return candidate.find("-floor") != candidate.npos || candidate.find("-heights") != candidate.npos;
}

/// Has it wrong normals at seams? A plane has one normal, which is that of all triangles: what else
/// is answered comes from their edges.
bool fails_at_seams(const ResultRow& row) {
  return has_seams(row.candidate) && row.pair == pair_name(Pair::plane) &&
         row.statistics.normal_angle && row.statistics.of(Outcome::wrong_normal) > 0;
}

/// The most frequent failure of each pair, group and candidate; at seams, their normals.
std::vector<Failing> frequent_failures(const Report& report) {
  std::vector<Failing> result;
  std::vector<std::string> groups;
  for (const ResultRow& row : report.summary) {
    if (groups.empty() || groups.back() != row.pose_class) groups.push_back(row.pose_class);
    if (row.pair == "all" || row.statistics.agreeing() == row.statistics.asked()) continue;
    const auto times = [&](Outcome o) {
      const bool is_failure = !agrees(o) && o != Outcome::unsupported && o != Outcome::not_asked;
      return is_failure ? row.statistics.of(o) : 0;
    };
    const bool is_seam = fails_at_seams(row);
    const Outcome outcome =
        is_seam ? Outcome::wrong_normal : *std::ranges::max_element(all_outcomes, {}, times);
    const auto worst = std::ranges::find_if(report.worst, [&](const WorstCase& w) {
      return w.pair == row.pair && w.group == row.pose_class && w.candidate == row.candidate &&
             w.score.outcome == outcome;
    });
    if (worst == report.worst.end()) continue;
    const std::string what =
        is_seam ? fmt::format("at seams normals are up to {:.0f}° off, {}",
                              row.statistics.normal_angle->max, outcome_name(outcome))
                : outcome_name(outcome);
    const std::string text =
        fmt::format("{}: {} in {} of {} of {}", shown_name(row.candidate), what, times(outcome),
                    counted(row.statistics.supported(), row.pose_class + " pose"), row.pair) +
        model_text(row.statistics);
    result.push_back(
        {{row.candidate, text, worst->examination.replay},
         row.pair,
         is_seam,
         false,
         static_cast<int>(groups.size()),
         static_cast<double>(times(outcome)) / static_cast<double>(row.statistics.supported())});
  }
  return result;
}

}  // namespace

std::vector<Finding> findings(const Report& report) {
  std::vector<Failing> all = contrasts_that_fail(report);
  std::ranges::move(frequent_failures(report), std::back_inserter(all));
  std::set<std::string> models, engines;
  for (const CandidateDescription& c : report.candidates) {
    if (!c.models.empty()) models.insert(c.name);
  }
  std::vector<Finding> result;
  while (result.size() < max_findings && !all.empty()) {
    const auto urgency = [&](const Failing& f) {
      const std::string& name = f.finding.candidate;
      return std::tuple(!models.contains(name), !engines.contains(engine_of(name)), f.is_seam,
                        f.is_contrast, -f.rarity, f.share);
    };
    const Failing first = *std::ranges::max_element(all, {}, urgency);
    engines.insert(engine_of(first.finding.candidate));
    result.push_back(first.finding);
    std::erase_if(all, [&](const Failing& f) {
      return (f.is_contrast && !first.is_seam) ||
             (f.pair == first.pair && f.finding.candidate == first.finding.candidate);
    });
  }
  return result;
}

}  // namespace touchstone
