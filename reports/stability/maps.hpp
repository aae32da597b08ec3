#pragma once

#include <nlohmann/json.hpp>

#include "properties/motions/critical_pose.hpp"
#include "reports/stability/examined_pose.hpp"

namespace touchstone {

/// Which pixels are asked.
struct MapGrid {
  std::vector<Decade> zooms;
  int stride = 1;  ///< every so many columns and rows, the middle one included; divides map_reach
};

/// A pixel's colour, by its letter: outcomes as in reports, and contacts that agree but do not hold
/// the contact patch.
struct MapLetter {
  char letter;
  const char* meaning;
};
inline constexpr MapLetter map_letters[] = {
    {'.', "agree"},           {'m', "missed"},        {'p', "phantom"},    {'s', "shallow"},
    {'o', "overdeep"},        {'n', "wrong-normal"},  {'f', "few-points"}, {'i', "not-finite"},
    {'x', "failed"},          {'c', "crashed"},       {'t', "timed-out"},  {'S', "shallow-points"},
    {'O', "overdeep-points"}, {'P', "phantom-points"}};

/// Contacts whose points cover less of the patch have too few (as the law "manifold" has it).
inline constexpr double least_coverage = 0.3;
char map_letter(const Score& score);  ///< precondition: the candidate supports the pair

/// Pixels row by row as letters, of a map's string in run lengths: "3m2." is mmm..
std::string map_letters_of(const std::string& runs);

/// Member "maps" of stability.json (docs/stability.md), for these poses.
nlohmann::json maps(const std::vector<const CriticalPose*>& poses, const MapGrid& grid,
                    const Study& study);

}  // namespace touchstone
