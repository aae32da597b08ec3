#pragma once

#include <nlohmann/json.hpp>

#include "reports/campaigns/shard.hpp"

// Parts of a campaign without plug-ins: scores are made up, not found.

namespace touchstone {

inline nlohmann::json made_up_plan(std::uint64_t count = 1000, std::uint64_t seed = 1) {
  return {{"version", "0"},
          {"command", "./touchstone campaign"},
          {"program", "./touchstone"},
          {"seed", seed},
          {"count", count},
          {"unit_size", Unit::max_size},
          {"run_size", run_size},
          {"tolerance", 1e-4},
          {"threshold", 0},
          {"classes",
           {{{"pair", "cylinder-sphere"}, {"class", "general-shallow"}},
            {{"pair", "cylinder-box"}, {"class", "rim-face"}}}},
          {"candidates", {{{"name", "one"}}, {{"name", "two"}, {"runs", "wasm"}}}}};
}

/// Those of a shard's units that are in `wanted`, with scores that follow from their indices.
inline ShardState made_up_part(const nlohmann::json& plan, const Shard& shard,
                               const UnitSet& wanted) {
  ShardState p(plan_from_json(plan), shard);
  p.done = shard.units(p.plan.cut) & wanted;
  for (const auto& range : p.done) {
    for (std::uint64_t number = range.lower(); number < range.upper(); ++number) {
      const Unit unit = p.plan.cut.unit(number);
      for (std::uint64_t i = unit.first; i < unit.last; ++i) {
        for (std::size_t k = 0; k < 2; ++k) {
          Score s;
          s.depth_error = 1e-9 * static_cast<double>((i * 7919 + k) % 1009);
          s.severity = *s.depth_error;
          s.coverage = 0.5;
          s.points = static_cast<int>(i % 4);
          s.outcome = i % 5 == k ? Outcome::shallow : Outcome::agree;
          p.samples[unit.cell].tallies[k].add(unit.cell, i, s);
        }
      }
    }
  }
  return p;
}

}  // namespace touchstone
