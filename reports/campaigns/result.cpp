#include "reports/campaigns/result.hpp"

#include <string>
#include <utility>

#include "properties/files/configuration_json.hpp"
#include "reports/campaigns/durable_file.hpp"
#include "reports/worst.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

json row(const ScoreTally& tally, const std::string& pair, const std::string& pose_class,
         const std::string& candidate) {
  json result = tally.summary();
  result["pair"] = pair;
  result["class"] = pose_class;
  result["candidate"] = candidate;
  result["nanoseconds"] = nullptr;  // campaigns do not time candidates
  return result;
}

/// One of its pair and candidate, with the numbers that replay it without our generators.
json worst_case(const Progressed& whole, const Case& c, const std::string& candidate) {
  const Cell& cell = whole.view.cells[c.cell];
  const std::string id = to_string(Identity{cell.pair, cell.pose_class, whole.view.seed, c.index});
  const auto or_null = [](const std::optional<double>& v) { return v ? json(*v) : json(nullptr); };
  return {{"id", id},
          {"pair", pair_name(cell.pair)},
          {"class", cell.pose_class},
          {"candidate", candidate},
          {"outcome", outcome_name(c.score.outcome)},
          {"depth_error", or_null(c.score.depth_error)},
          {"normal_regret", or_null(c.score.normal_regret)},
          {"severity", c.score.severity},
          {"configuration", to_json(make_configuration(parse_identity(id)))},
          {"replay", whole.plan.at("program").get<std::string>() + " replay " + id}};
}

}  // namespace

json campaign_result(const Progressed& whole) {
  const PlanView& view = whole.view;
  const std::size_t candidates = view.candidates.size();
  json results = json::array(), summary = json::array(), worst = json::array();
  std::vector<ScoreTally> everything(candidates);
  std::size_t pairs = 0;
  for (std::size_t first = 0, last = 0; first < view.cells.size(); first = last, ++pairs) {
    const Pair pair = view.cells[first].pair;
    while (last < view.cells.size() && view.cells[last].pair == pair) ++last;
    for (std::size_t cell = first; cell < last; ++cell) {
      for (std::size_t k = 0; k < candidates; ++k) {
        results.push_back(row(whole.tally(cell, k), pair_name(pair), view.cells[cell].pose_class,
                              view.candidates[k]));
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
      summary.push_back(row(of_pair, pair_name(pair), "all", view.candidates[k]));
      for (const Case& c : worst_of_pair(std::move(cases))) {
        worst.push_back(worst_case(whole, c, view.candidates[k]));
      }
    }
  }
  for (std::size_t k = 0; k < candidates && pairs > 1; ++k) {
    summary.push_back(row(everything[k], "all", "all", view.candidates[k]));
  }

  const std::uint64_t all = view.cut.cells * view.cut.count;
  const std::uint64_t scored = configurations(view.cut, whole.done);
  json result = {{"schema", "touchstone-campaign-1"},
                 {"configurations", scored},
                 {"complete", scored == all},
                 {"results", results},
                 {"summary", summary},
                 {"worst", worst}};
  for (const char* member :
       {"version", "command", "seed", "count", "tolerance", "threshold", "candidates", "classes"}) {
    result[member] = whole.plan.at(member);
  }
  return result;
}

std::filesystem::path write_result(const json& result, const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "campaign.json";
  write_durably(file, result.dump(1) + '\n');
  return file;
}

}  // namespace touchstone
