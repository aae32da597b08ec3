#include "reports/campaigns/result.hpp"

#include <utility>

#include <nlohmann/json.hpp>

#include "reports/campaigns/durable_file.hpp"
#include "reports/report_json.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

ResultRow row(const ScoreTally& tally, const std::string& pair, const std::string& pose_class,
              const std::string& candidate) {
  ResultRow result;
  result.pair = pair;
  result.pose_class = pose_class;
  result.candidate = candidate;
  result.statistics = tally.statistics();
  return result;  // campaigns do not time candidates
}

WorstCase worst_case(const Progressed& whole, const Case& c, const std::string& candidate) {
  const Cell& cell = whole.view.cells[c.cell];
  const Identity identity{cell.pair, cell.pose_class, whole.view.seed, c.index};
  const std::string id = to_string(identity);
  const std::string replay = whole.plan.at("program").get<std::string>() + " replay " + id;
  return {pair_name(cell.pair),
          cell.pose_class,
          candidate,
          c.score,
          {id, make_configuration(identity), std::nullopt, {}, replay}};
}

}  // namespace

Report campaign_result(const Progressed& whole) {
  const PlanView& view = whole.view;
  const std::size_t candidates = view.candidates.size();
  Report report;
  report.version = whole.plan.at("version");
  report.command = whole.plan.at("command");
  report.seed = view.seed;
  report.tolerance = whole.plan.at("tolerance");
  report.threshold = whole.plan.at("threshold");
  report.planned = {view.cut.cells, view.cut.cells * view.cut.count};
  report.completed = {view.cut.cells, configurations(view.cut, whole.done)};
  report.configurations = report.completed.configurations;
  for (const std::string& name : view.candidates) {
    report.candidates.push_back({name, "", "", "", ""});
  }
  for (const Cell& cell : view.cells) {
    report.classes.push_back({pair_name(cell.pair), cell.pose_class,
                              std::string(describe_pose_class(cell.pair, cell.pose_class))});
  }

  std::vector<ScoreTally> everything(candidates);
  std::size_t pairs = 0;
  for (std::size_t first = 0, last = 0; first < view.cells.size(); first = last, ++pairs) {
    const Pair pair = view.cells[first].pair;
    while (last < view.cells.size() && view.cells[last].pair == pair) ++last;
    for (std::size_t cell = first; cell < last; ++cell) {
      for (std::size_t k = 0; k < candidates; ++k) {
        report.results.push_back(row(whole.tally(cell, k), pair_name(pair),
                                     view.cells[cell].pose_class, view.candidates[k]));
      }
    }
    for (std::size_t k = 0; k < candidates; ++k) {
      ScoreTally of_pair;
      std::vector<Case> cases;
      for (std::size_t cell = first; cell < last; ++cell) {
        const ScoreTally& tally = whole.tally(cell, k);
        of_pair.add(tally);
        cases.insert(cases.end(), tally.worst().begin(), tally.worst().end());
      }
      everything[k].add(of_pair);
      report.summary.push_back(row(of_pair, pair_name(pair), "all", view.candidates[k]));
      for (const Case& c : worst_of_pair(std::move(cases))) {
        report.worst.push_back(worst_case(whole, c, view.candidates[k]));
      }
    }
  }
  for (std::size_t k = 0; k < candidates && pairs > 1; ++k) {
    report.summary.push_back(row(everything[k], "all", "all", view.candidates[k]));
  }
  return report;
}

std::string campaign_json(const Progressed& whole) {
  const Report report = campaign_result(whole);
  json results = json::array(), summary = json::array(), worst = json::array();
  for (const ResultRow& row : report.results) results.push_back(to_json(row));
  for (const ResultRow& row : report.summary) summary.push_back(to_json(row));
  for (const WorstCase& w : report.worst) worst.push_back(to_json(w));
  json result = {{"schema", "touchstone-campaign-1"},
                 {"configurations", report.configurations},
                 {"complete", report.completed.configurations == report.planned.configurations},
                 {"results", results},
                 {"summary", summary},
                 {"worst", worst}};
  for (const char* member :
       {"version", "command", "seed", "count", "tolerance", "threshold", "candidates", "classes"}) {
    result[member] = whole.plan.at(member);
  }
  return result.dump(1) + '\n';
}

std::filesystem::path write_result(const Progressed& whole, const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "campaign.json";
  write_durably(file, campaign_json(whole));
  return file;
}

}  // namespace touchstone
