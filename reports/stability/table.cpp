#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

#include "reports/stability/stability.hpp"
#include "reports/worst.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

/// Steps up to here are far below what a contact patch is made within (patch_depth).
constexpr double tiny = 1e-8;

std::string number(double value) { return value == 0 ? "0" : fmt::format("{:.1e}", value); }

/// Rounded upwards already.
std::string amplification_text(double value) {
  return value < 10 ? fmt::format("{:.2f}", value) : number(value);
}

/// Cut downwards: only all of them show 100.
std::string percent(double part, double whole) {
  const double value = std::floor(1000 * part / whole) / 10;
  return part == whole ? "100" : fmt::format("{:.1f}", value);
}

struct Row {
  double amplification = 0, jump = 0, regret = 0, hull_excess = 0;
  int tiny_steps = 0, flickers = 0, missed = 0, unanswered = 0;

  void add(const json& result, const std::vector<double>& amplitudes, int steps) {
    const auto raise = [&](double& most, const json& values) {
      for (const json& v : values) {
        if (!v.is_null()) most = std::max(most, v.get<double>());
      }
    };
    raise(amplification, result["amplification"]);
    if (!result["jump"].is_null()) jump = std::max(jump, result["jump"].get<double>());
    raise(regret, result["regret"]);
    raise(hull_excess, result["hull_excess"]);
    for (std::size_t i = 0; i < amplitudes.size(); ++i) {
      missed += result["missed"][i].get<int>();
      unanswered += result["unanswered"][i].get<int>();
      if (amplitudes[i] > tiny) continue;
      tiny_steps += steps - result["unanswered"][i].get<int>();
      flickers += result["points_changed"][i].get<int>();
    }
  }
};

std::string amplification_table(const json& a, const json& candidates) {
  std::map<std::string, std::map<std::string, Row>> rows;
  std::vector<std::string> pairs;
  for (const json& result : a["results"]) {
    const std::string pair = result["pair"];
    if (std::find(pairs.begin(), pairs.end(), pair) == pairs.end()) pairs.push_back(pair);
    rows[pair][result["candidate"]].add(result, a["amplitudes"], a["count"]);
  }
  std::string text = fmt::format("{:<23}{:>8} {:>8} {:>8} {:>8} {:>8} {:>6} {:>5}\n", "small steps",
                                 "depth x", "jump", "regret", "hull", "flicker%", "missed", "none");
  for (const std::string& pair : pairs) {
    text += '\n' + pair + '\n';
    for (const json& candidate : candidates) {
      const auto found = rows[pair].find(candidate);
      if (found == rows[pair].end()) continue;
      const Row& r = found->second;
      text += fmt::format("  {:<21}{:>8} {:>8} {:>8} {:>8} {:>8} {:>6} {:>5}\n",
                          candidate.get<std::string>(), amplification_text(r.amplification),
                          number(r.jump), number(r.regret), number(r.hull_excess),
                          r.tiny_steps > 0 ? percent(r.flickers, r.tiny_steps) : "-", r.missed,
                          r.unanswered);
    }
  }
  return text +
         "\ndepth x: largest change of the answered depth over what the step allows (the\n"
         "truth: 1). jump: of depth, beyond the true change. regret: of the normal. hull:\n"
         "by how much more the contact points' hull moved than the contact patch. All in\n"
         "sizes of the smaller shape. flicker: steps up to 1e-8 that change the number of\n"
         "points. none: steps without an answer in numbers at one end.\n";
}

std::string maps_table(const json& maps, const json& candidates) {
  struct Count {
    std::map<std::string, int> of_zoom;
    std::map<char, int> letters;
  };
  std::map<std::string, Count> counts;
  std::map<std::string, std::map<std::string, int>> asked;
  for (const json& pose : maps["poses"]) {
    for (const json& result : pose["results"]) {
      Count& count = counts[result["candidate"]];
      for (std::size_t z = 0; z < maps["zooms"].size(); ++z) {
        const std::string zoom = maps["zooms"][z];
        for (const char letter : map_letters_of(result["maps"][z])) {
          ++asked[result["candidate"]][zoom];
          count.of_zoom[zoom] += letter == '.';
          ++count.letters[letter];
        }
      }
    }
  }
  std::string text = fmt::format("{:<23}", "maps, pixels that agree");
  for (const json& zoom : maps["zooms"]) text += fmt::format("{:>8}", zoom.get<std::string>());
  text += fmt::format("{:>9}\n\n", "missed");
  for (const json& candidate : candidates) {
    const auto found = counts.find(candidate);
    if (found == counts.end()) continue;
    text += fmt::format("  {:<21}", candidate.get<std::string>());
    for (const json& zoom : maps["zooms"]) {
      text += fmt::format("{:>8}", percent(found->second.of_zoom[zoom], asked[candidate][zoom]));
    }
    text += fmt::format("{:>9}\n", found->second.letters['m']);
  }
  return text + "\npercent of the pixels of all poses, at each zoom\n";
}

std::string sequences_table(const json& sequences, const json& candidates) {
  struct Worst {
    double value = 0;
    std::string motion;
    void take(const json& largest, const std::string& where) {
      if (largest.is_null() || largest["value"].get<double>() <= value) return;
      value = largest["value"];
      motion = where;
    }
  };
  std::string text = fmt::format("{:<23}{:>8} {:<21} {:>8} {:<11}{:>6}\n\n", "motions", "jump",
                                 "in", "hull", "in", "missed");
  for (const json& candidate : candidates) {
    Worst jump, hull;
    int missed = 0;
    bool any = false;
    for (const json& motion : sequences["motions"]) {
      for (const json& result : motion["results"]) {
        if (result["candidate"] != candidate) continue;
        any = true;
        jump.take(result["jump"], motion["motion"]);
        hull.take(result["hull_excess"], motion["motion"]);
        missed += result["missed"].get<int>();
      }
    }
    if (!any) continue;
    text += fmt::format("  {:<21}{:>8} {:<21} {:>8} {:<11}{:>6}\n", candidate.get<std::string>(),
                        number(jump.value), jump.motion, number(hull.value),
                        hull.motion.substr(0, 11), missed);
  }
  return text + fmt::format("\nlargest at one of {} steps of each motion, in sizes; as above\n",
                            sequences["steps"].get<int>());
}

std::string worst_steps(const json& worst, const json& candidates) {
  std::string text;
  for (const json& candidate : candidates) {
    const json* most = nullptr;
    for (const json& w : worst) {
      if (w["candidate"] != candidate || w["measure"] != "amplification") continue;
      if (!most || w["value"] > (*most)["value"]) most = &w;
    }
    if (!most || (*most)["value"].get<double>() <= 1 + 1e-9) continue;
    text += fmt::format("  {}: depth x {}\n    {}\n    {}\n", candidate.get<std::string>(),
                        number((*most)["value"]), replay_command((*most)["from"]),
                        replay_command((*most)["to"]));
  }
  return text.empty() ? text : "\nWorst step of each candidate, from and to:\n" + text;
}

}  // namespace

std::string stability_table(const json& s) {
  std::string text;
  if (s.contains("amplification")) text += amplification_table(s["amplification"], s["candidates"]);
  if (s.contains("maps")) text += '\n' + maps_table(s["maps"], s["candidates"]);
  if (s.contains("sequences")) text += '\n' + sequences_table(s["sequences"], s["candidates"]);
  if (s.contains("amplification")) {
    text += worst_steps(s["amplification"]["worst"], s["candidates"]);
  }
  return text;
}

}  // namespace touchstone
