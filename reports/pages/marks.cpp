#include "reports/pages/marks.hpp"

#include <algorithm>
#include <numeric>

namespace touchstone {

Mark mark_of(std::string_view candidate) {
  constexpr std::size_t symbols = 6;
  static const std::vector<std::vector<std::string_view>> engines = {
      {"reference"},
      {"bullet", "bullet-margin-0", "bullet-persistent", "bullet-hull", "bullet-float",
       "bullet-float-margin-0"},
      {"ode", "ode-mesh"},
      {"fcl", "fcl-indep", "fcl-distance"},
      {"libccd-gjk", "libccd-mpr"},
      {"mujoco"},
      {"capsule", "capsule-circumscribed", "spheres", "prism", "box-spheres", "box-capsules"}};
  const std::string_view family = candidate.substr(0, candidate.find(':'));
  for (std::size_t i = 0; i < engines.size(); ++i) {
    const auto at = std::find(engines[i].begin(), engines[i].end(), family);
    if (at != engines[i].end()) return {i, static_cast<std::size_t>(at - engines[i].begin())};
  }
  const auto sum = std::accumulate(
      candidate.begin(), candidate.end(), std::size_t{0},
      [](std::size_t total, char c) { return total + static_cast<unsigned char>(c); });
  return {engines.size(), sum % symbols};
}

std::map<std::string, std::array<std::size_t, 2>> marks(
    const std::vector<std::string>& candidates) {
  std::map<std::string, std::array<std::size_t, 2>> result;
  for (const auto& name : candidates) {
    const Mark mark = mark_of(name);
    result[name] = {mark.colour, mark.symbol};
  }
  return result;
}

}  // namespace touchstone
