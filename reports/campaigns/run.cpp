#include "reports/campaigns/run.hpp"

#include <chrono>
#include <optional>
#include <string>

#include "candidates/host/progress.hpp"
#include "candidates/host/worker_processes.hpp"
#include "reference/invalid_input.hpp"
#include "reports/campaigns/durable_file.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

/// Adds what a worker sent of one unit.
void add(Progressed& progressed, std::uint64_t number, const std::string& text) {
  const std::size_t cell = progressed.view.cut.unit(number).cell;
  std::size_t k = 0;
  for (const json& tally : json::parse(text)) {
    progressed.tally(cell, k++).add(ScoreTally::from_json(tally, cell));
  }
  progressed.done += UnitSet::interval_type(number, number + 1);
}

}  // namespace

std::vector<ScoreTally> tally_unit(const Campaign& campaign,
                                   std::vector<CandidateProcess>& candidates, const Cell& cell,
                                   const Unit& unit) {
  std::vector<ScoreTally> tallies(candidates.size());
  score_range(campaign, candidates, cell, unit.first, unit.last,
              [&](const ScoredConfiguration& scored) {
                for (std::size_t k = 0; k < scored.scores.size(); ++k) {
                  tallies[k].add(unit.cell, scored.index, scored.scores[k]);
                }
              });
  return tallies;
}

bool run_shard(const Campaign& campaign, Progressed& progressed, const std::filesystem::path& file,
               const Running& running, const std::function<bool()>& go_on) {
  using Clock = std::chrono::steady_clock;
  const std::vector<Cell>& cells = progressed.view.cells;
  const Cut& cut = progressed.view.cut;
  const UnitSet left = progressed.shard.units(cut) - progressed.done;
  std::optional<Progress> progress;
  if (running.progress) progress.emplace("configurations", configurations(cut, left));
  std::uint64_t scored = 0;
  Clock::time_point written = Clock::now();
  const auto checkpoint = [&] {
    write_durably(file, to_text(progressed));
    written = Clock::now();
  };
  checkpoint();  // tells at once whether it can be done

  std::vector<CandidateProcess> candidates;  // each worker starts its own
  bool all = false;
  try {
    all = stream_from_processes(
        boost::icl::cardinality(left), campaign.workers,
        [&](std::uint64_t task) {
          if (candidates.empty()) {
            candidates = start(campaign.candidates, campaign.bar.threshold, campaign.limits);
          }
          const Unit unit = cut.unit(nth(left, task));
          json tallies = json::array();
          for (const ScoreTally& t : tally_unit(campaign, candidates, cells[unit.cell], unit)) {
            tallies.push_back(t.to_json());
          }
          return tallies.dump();
        },
        [&](std::uint64_t task) {
          const Unit unit = cut.unit(nth(left, task));
          return to_string(Identity{cells[unit.cell].pair, cells[unit.cell].pose_class,
                                    campaign.seed, unit.first});
        },
        [&](std::uint64_t task, const std::string& tallies) {
          const std::uint64_t number = nth(left, task);
          add(progressed, number, tallies);
          const Unit unit = cut.unit(number);
          scored += unit.last - unit.first;
          if (progress) progress->update(scored);
          if (Clock::now() - written > std::chrono::duration<double>(running.interval))
            checkpoint();
        },
        go_on);
  } catch (const InvalidInput&) {
    throw;  // the file cannot be written
  } catch (const std::exception&) {
    checkpoint();
    throw;
  }
  checkpoint();
  return all;
}

}  // namespace touchstone
