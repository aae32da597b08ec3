// What a person reads of it in a terminal, and its JSON and page.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <map>

#include <nlohmann/json.hpp>

#include "properties/files/disk.hpp"
#include "properties/files/json_members.hpp"
#include "properties/motions/motion.hpp"
#include "reports/pages/page.hpp"
#include "reports/replay.hpp"
#include "reports/report_members.hpp"
#include "reports/stability/stability_members.hpp"
#include "reports/terminal.hpp"

namespace touchstone {
namespace {

using Names = std::vector<std::string>;

std::string rounded_number(double value) { return value == 0 ? "0" : fmt::format("{:.1e}", value); }
std::string short_text(double value) { return rounded_number(short_number(value)); }

std::string amplification_text(double ratio) {
  const double shown = rounded_up(ratio);
  return shown < 10 ? fmt::format("{:.2f}", shown) : rounded_number(shown);
}

/// Cut downwards, so that only the whole shows 100.
std::string percent(int part, int whole) {
  const double value = std::floor(1000.0 * part / whole) / 10;
  return part == whole ? "100" : fmt::format("{:.1f}", value);
}

/// One candidate on all classes of a pair.
struct PairRow {
  double amplification = 0, jump = 0, regret = 0, hull_excess = 0;
  int tiny_steps = 0, flickers = 0, missed = 0, unanswered = 0;

  void add(const Amplification::Row& row, int steps) {
    /// Steps up to here are far below the depth within which a contact patch lies (patch_depth).
    constexpr double tiny = 1e-8;
    jump = std::max(jump, row.jump.value_or(0));
    for (std::size_t i = 0; i < amplitude_count; ++i) {
      amplification = std::max(amplification, row.amplification[i].value_or(0));
      regret = std::max(regret, row.regret[i].value_or(0));
      hull_excess = std::max(hull_excess, row.hull_excess[i].value_or(0));
      missed += row.missed[i];
      unanswered += row.unanswered[i];
      if (amplitude(i).value() > tiny) continue;
      tiny_steps += steps - row.unanswered[i];
      flickers += row.points_changed[i];
    }
  }
};

/// Width of the first column, in which candidates' names are indented below a pair's.
std::size_t name_width(const Names& candidates) {
  std::size_t width = 0;
  for (const std::string& name : candidates) width = std::max(width, 2 + name.size());
  return width;
}

/// In place of a table without rows. `are_of_pairs`: is there anything of the pairs that were
/// asked?
std::string nothing_measured(const char* what, bool are_of_pairs, const Terminal& terminal) {
  return terminal.folded(fmt::format("{}: nothing was measured, for {}.", what,
                                     are_of_pairs ? "no candidate has a routine for such a pair"
                                                  : "there is none of such a pair"));
}

std::string amplification_table(const Amplification& a, const Names& candidates,
                                const Terminal& terminal) {
  std::map<std::string, std::map<std::string, PairRow>> rows;
  Names pairs;
  for (const Amplification::Row& row : a.results) {
    if (std::find(pairs.begin(), pairs.end(), row.pair) == pairs.end()) pairs.push_back(row.pair);
    rows[row.pair][row.candidate].add(row, static_cast<int>(a.count));
  }
  if (pairs.empty()) return nothing_measured("Small steps", true, terminal);
  const TextTable table("small steps", name_width(candidates),
                        {{"depth x", 8, 0},
                         {"jump", 8, 1},
                         {"regret", 8, 3},
                         {"hull", 8, 4},
                         {"flicker%", 8, 5},
                         {"missed", 6, 2},
                         {"none", 5, 6}},
                        terminal);
  std::string text = table.headings();
  for (const std::string& pair : pairs) {
    text += '\n' + pair + '\n';
    for (const std::string& candidate : candidates) {
      const auto found = rows[pair].find(candidate);
      if (found == rows[pair].end()) continue;
      const PairRow& r = found->second;
      text +=
          table.row("  " + candidate, {{amplification_text(r.amplification)},
                                       {short_text(r.jump)},
                                       {short_text(r.regret)},
                                       {short_text(r.hull_excess)},
                                       {r.tiny_steps > 0 ? percent(r.flickers, r.tiny_steps) : "-"},
                                       {std::to_string(r.missed)},
                                       {std::to_string(r.unanswered)}});
    }
  }
  return text + '\n' +
         Legend(table, terminal)
             .of("depth x",
                 "largest change of the answered depth over what the step allows (the truth: 1)")
             .of("jump", "of depth, beyond the true change")
             .of("regret", "of the normal, after the step")
             .of("hull", "by how much more the contact points' hull moved than the contact patch")
             .of("flicker%", "steps up to 1e-8 that change the number of points")
             .of("missed", "steps that end in a missed contact")
             .of("none", "steps without an answer in numbers at one end")
             .line("Lengths in sizes of the smaller shape.")
             .text();
}

/// All pixels of one candidate.
struct PixelCounts {
  std::vector<int> asked, agreed;  ///< of each zoom
  int missed = 0;
};

std::map<std::string, PixelCounts> count_pixels(const FailureMaps& maps) {
  std::map<std::string, PixelCounts> counts;
  for (const FailureMaps::Pose& pose : maps.poses) {
    for (const FailureMaps::Picture& picture : pose.pictures) {
      PixelCounts& c = counts[picture.candidate];
      c.asked.resize(maps.zooms.size());
      c.agreed.resize(maps.zooms.size());
      for (std::size_t z = 0; z < maps.zooms.size(); ++z) {
        const std::string& letters = picture.letters[z];
        c.asked[z] += static_cast<int>(letters.size());
        c.agreed[z] += static_cast<int>(std::count(letters.begin(), letters.end(), '.'));
        c.missed += static_cast<int>(std::count(letters.begin(), letters.end(), 'm'));
      }
    }
  }
  return counts;
}

std::string maps_table(const FailureMaps& maps, const Names& candidates, const Terminal& terminal) {
  const auto counts = count_pixels(maps);
  if (counts.empty()) return nothing_measured("Maps", !maps.poses.empty(), terminal);
  std::vector<TextTable::Column> columns;
  for (const Decade& zoom : maps.zooms) {
    columns.push_back({zoom.name(), 7, static_cast<int>(columns.size())});
  }
  columns.push_back({"missed", 8});
  const TextTable table("maps, % that agree", name_width(candidates), columns, terminal);
  std::string text = table.headings() + '\n';
  for (const std::string& candidate : candidates) {
    const auto found = counts.find(candidate);
    if (found == counts.end()) continue;
    const PixelCounts& c = found->second;
    std::vector<TextTable::Cell> cells;
    for (std::size_t z = 0; z < maps.zooms.size(); ++z) {
      cells.push_back({percent(c.agreed[z], c.asked[z])});
    }
    cells.push_back({std::to_string(c.missed)});
    text += table.row("  " + candidate, cells);
  }
  return text + '\n' +
         Legend(table, terminal)
             .line("percent of the pixels of all poses, at each zoom")
             .of("missed", "pixels that are a missed contact, at all zooms")
             .text();
}

/// The largest value of a measure over all motions, as it is shown, and the first motion that has
/// it.
struct LargestPeak {
  double value = 0;
  std::string motion;
  void raise(const std::optional<Sequences::Peak>& peak, const std::string& of) {
    const double shown = peak ? short_number(peak->value) : 0;
    if (shown > value) *this = {shown, of};
  }
};

std::string sequences_table(const Sequences& sequences, const Names& candidates,
                            const Terminal& terminal) {
  const auto has_rows = [](const Sequences::Course& course) { return !course.results.empty(); };
  if (std::ranges::none_of(sequences.motions, has_rows)) {
    return nothing_measured("Motions", !sequences.motions.empty(), terminal);
  }
  std::size_t motion_width = 0;
  for (const Sequences::Course& course : sequences.motions) {
    motion_width = std::max(motion_width, course.motion.size());
  }
  const TextTable table("motions", name_width(candidates),
                        {{"jump", 8, 0},
                         {"in", motion_width, 3},
                         {"hull", 8, 2},
                         {"in", motion_width, 4},
                         {"missed", 6, 1}},
                        terminal);
  std::string text = table.headings() + '\n';
  for (const std::string& candidate : candidates) {
    LargestPeak jump, hull;
    int missed = 0;
    bool any = false;
    for (const Sequences::Course& course : sequences.motions) {
      for (const Sequences::Row& row : course.results) {
        if (row.candidate != candidate) continue;
        any = true;
        jump.raise(row.jump, course.motion);
        hull.raise(row.hull_excess, course.motion);
        missed += row.missed;
      }
    }
    if (!any) continue;
    text += table.row("  " + candidate, {{rounded_number(jump.value)},
                                         {jump.motion},
                                         {rounded_number(hull.value)},
                                         {hull.motion},
                                         {std::to_string(missed)}});
  }
  return text + '\n' +
         Legend(table, terminal)
             .line(fmt::format("largest at one of {} steps of each motion, in sizes of the smaller "
                               "shape",
                               sequences.steps))
             .of("jump", "of depth, beyond the true change")
             .of("hull", "by how much more the contact points' hull moved than the contact patch")
             .of("in", "the motion")
             .of("missed", "poses with a missed contact")
             .text();
}

std::string worst_steps(const std::vector<Amplification::WorstStep>& worst, const Names& candidates,
                        const Terminal& terminal) {
  std::string text;
  for (const std::string& candidate : candidates) {
    const Amplification::WorstStep* max = nullptr;
    for (const Amplification::WorstStep& w : worst) {
      if (w.candidate != candidate || w.measure != "amplification") continue;
      if (!max || w.value > max->value) max = &w;
    }
    if (!max || max->value <= 1 + 1e-9) continue;
    text +=
        fmt::format("  {}: depth x {}\n    {}\n    {}\n", candidate, rounded_number(max->value),
                    replay_command(max->from, {candidate}), replay_command(max->to, {candidate}));
  }
  return text.empty() ? text
                      : '\n' + terminal.folded("Worst step of each candidate, from and to:") + text;
}

}  // namespace

std::string stability_table(const Stability& s, const Terminal& terminal) {
  std::string text;
  if (s.amplification) text += amplification_table(*s.amplification, s.candidates, terminal);
  if (s.maps) text += '\n' + maps_table(*s.maps, s.candidates, terminal);
  if (s.sequences) text += '\n' + sequences_table(*s.sequences, s.candidates, terminal);
  if (s.amplification) text += worst_steps(s.amplification->worst, s.candidates, terminal);
  return text;
}

using nlohmann::json;

double short_number(double value) {
  return value < 1e-15 ? 0 : std::strtod(fmt::format("{:.2g}", value).c_str(), nullptr);
}

double rounded_up(double ratio) {
  return ratio >= 10 ? short_number(ratio) : std::ceil(100 * ratio * (1 - 1e-9)) / 100;
}

json to_json(ShortNumber x) {
  const double shown = short_number(x.value);
  return shown == 0 ? json(0) : json(shown);
}

std::string run_lengths(const std::string& letters) {
  std::string result;
  for (std::size_t start = 0; start < letters.size();) {
    const std::size_t end =
        std::min(letters.find_first_not_of(letters[start], start), letters.size());
    if (end - start > 1) result += std::to_string(end - start);
    result += letters[start];
    start = end;
  }
  return result;
}

json to_json(const Stability& s) { return object_of(s); }

std::string json_text(const Stability& stability) { return to_json(stability).dump(); }

void write_stability(const Stability& stability, const std::string& command,
                     const std::filesystem::path& folder) {
  check_writable(folder);
  json whole = to_json(stability);
  whole["schema"] = "touchstone-stability-1";
  whole["version"] = TOUCHSTONE_VERSION;
  whole["command"] = command;
  write_file(folder / "stability.json", whole.dump() + "\n", "--out");
  std::map<std::string, std::string> runs;
  for (const std::string& name : stability.candidates) runs[name] = runs_as(name);
  write_file(folder / "stability.html", render_page(Page::stability, with_candidates(whole, runs)),
             "--out");
}

}  // namespace touchstone
