#pragma once

#include <filesystem>
#include <set>

#include "reports/stability/amplification.hpp"
#include "reports/stability/maps.hpp"
#include "reports/stability/sequences.hpp"

namespace touchstone {

enum class StabilityPart { amplification, maps, sequences };
/// Throws InvalidInput (field "--part") unless it is "amplification", "maps" or "sequences".
StabilityPart parse_stability_part(std::string_view name);

struct StabilityOptions {
  Study study;
  std::set<StabilityPart> parts = {StabilityPart::amplification, StabilityPart::maps,
                                   StabilityPart::sequences};
  std::vector<Pair> pairs;      ///< of maps and sequences
  Ladder ladder;                ///< of amplification …
  std::optional<Subject> base;  ///< … unless it is around this one
  MapGrid grid;
  int steps = 400;  ///< of each motion
};

/// All pairs, all degenerate classes, the finest maps.
StabilityOptions thorough(const Study& study, std::uint64_t seed);
/// The same in about half a minute on two cores, for the report.
StabilityOptions brief(const Study& study, const std::vector<Pair>& pairs, std::uint64_t seed);

/// stability.json but for its header, and the member "stability" of report.json
/// (docs/stability.md). The same options give the same result. Progress goes to standard error.
nlohmann::json stability(const StabilityOptions& options);

/// What a person reads of it in a terminal, 80 columns wide.
std::string stability_table(const nlohmann::json& stability);

/// Writes stability.json and stability.html into the folder. Throws InvalidInput (field "--out").
void write_stability(const nlohmann::json& stability, const std::string& command,
                     const std::filesystem::path& folder);

}  // namespace touchstone
