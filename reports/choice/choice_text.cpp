#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>

#include "properties/files/given_text.hpp"
#include "reports/choice/choice.hpp"
#include "reports/terminal.hpp"
#include "simulation/scenes/passing.hpp"

namespace touchstone {

std::string measured(const Verdict& verdict, const Need& need) {
  if (!std::isfinite(verdict.value)) return "the motion becomes absurd";
  return fmt::format("{:.3g}{}", verdict.value, need.unit);
}

std::string bodies_of(const SceneFile& file, const Verdict& verdict) {
  std::string names;
  for (const int body : verdict.bodies) {
    if (body >= 0) names += (names.empty() ? "" : " and ") + file.scene.bodies[body].name;
  }
  return names;
}

namespace {

/// When a need was broken, and by which of its bodies; of one that holds, which came nearest.
std::string when(const SceneFile& file, const Verdict& verdict) {
  const std::string bodies = bodies_of(file, verdict);
  std::string named = bodies.empty() ? "" : ", " + bodies;
  if (verdict.holds()) return named;
  return fmt::format(" at {:.2f} s{}{}", verdict.time, named, bodies.empty() ? "" : " first");
}

}  // namespace

std::string need_line(const SceneFile& file, const Spreads& spreads, std::size_t need,
                      const Verdict& verdict) {
  const Need& n = *file.needs[need];
  std::string line =
      fmt::format("{:>3}. {:<6} {}: {}{}", need + 1, verdict.holds() ? "holds" : "BROKEN",
                  n.text(file.scene), measured(verdict, n), when(file, verdict));
  if (need < spreads.of_needs.size() && spreads.of_needs[need]) {
    const double spread = *spreads.of_needs[need];
    line += fmt::format(" (exact runs differ by {:.2g}{}{})", spread, n.unit,
                        spread > verdict.limit ? ", as the disturbances carry them" : "");
  }
  return line + '\n';
}

std::string undecidable_text(const Spreads& spreads) {
  std::string text;
  for (const Undecidable& u : spreads.undecidable) {
    text += fmt::format(
        "Undecidable, for exact runs that are hardly disturbed differ by {:.2g}{}: {}\n", u.spread,
        u.unit, u.text);
  }
  return text;
}

namespace {

/// `contacts`: what the run is compared with, whose own runs overlap by so much and differ so.
std::string unasked(const Straying& s, const std::string& contacts, double overlap,
                    const Straying& apart) {
  std::string text = fmt::format(
      "Asked for or not, in all its runs: bodies overlap by up to {:.2g} m (with {}: {:.2g} m)",
      s.overlap, contacts, overlap);
  if (s.distance > 0) {
    text += fmt::format(
        "; {} ends up to {:.2g} m from where it does with {} under the same disturbance (exact "
        "runs differ by {:.2g} m)",
        s.body, s.distance, contacts, apart.distance);
  }
  if (s.tilt > 0) {
    text +=
        fmt::format("; {} ends up to {:.2g}° from its tilt there (exact runs differ by {:.2g}°)",
                    s.tilted_body, s.tilt, apart.tilt);
  }
  return text + '.';
}

}  // namespace

std::string unasked_text(const Choice& choice) {
  if (choice.answer == 0) return "";
  return unasked(choice.runs[choice.answer].straying, "exact contacts",
                 choice.runs[0].straying.overlap, choice.exact_spread);
}

std::string unasked_text(const EngineChoice& choice) {
  const bool is_exact =
      choice.answer && &choice.settings[*choice.answer] == &choice.exact_setting();
  if (!choice.answer || is_exact) return "";
  return unasked(choice.settings[*choice.answer].straying, "our routines",
                 choice.exact_setting().straying.overlap, choice.exact_spread);
}

namespace {

/// The runs with one candidate for all pairs: of models, or of others.
std::vector<const SceneRun*> uniform_runs(const Choice& choice, bool are_models) {
  std::vector<const SceneRun*> result;
  for (const SceneRun& run : choice.runs) {
    const bool of_search = run.name.find(' ') != std::string::npos || run.name == "combination";
    if (!of_search && choice.has_models_alone(run) == are_models) result.push_back(&run);
  }
  return result;
}

/// Of an impact that a step could miss: "At 0.42 s ball would be through wall in 0.013 s: a
/// longer step may miss it."
std::string passing_text(const Choice& choice) {
  const Scene& scene = choice.file.scene;
  const std::optional<Passing> passing = shortest_passing(scene, choice.exact_run);
  constexpr double longest_step = 0.1;  // s, of anyone
  if (!passing || passing->seconds > longest_step) return "";
  return fmt::format("At {:.2f} s {} would be through {} in {:.2g} s: a longer step may miss it.",
                     passing->time, scene.bodies[passing->a].name, scene.bodies[passing->b].name,
                     passing->seconds);
}

/// As long_step_text has it of exact contacts that fail.
std::string late_text(const Choice& choice) {
  if (!choice.impossible) return "";
  const Scene& scene = choice.file.scene;
  const auto& frames = choice.exact_run.frames;
  double share = 0, way = 0;
  std::string name;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    if (!body.is_free() || !body.collides) continue;
    double moved = scene.gravity.norm() * scene.step * scene.step;
    for (std::size_t f = 1; f < frames.size(); ++f) {
      const auto& [before, after] = std::pair(frames[f - 1][i], frames[f][i]);
      moved = std::max(moved, (after.pose.position() - before.pose.position()).norm());
    }
    const double of_width = moved / (2 * smallest_half_extent(body.shape));
    if (of_width > share) share = of_width, way = moved, name = body.name;
  }
  constexpr double late = 0.1;
  bool is_late = share > late;
  const std::vector<Verdict>& verdicts = choice.runs[0].verdicts;
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    const bool is_overlap = choice.file.needs[i]->name == std::string("penetration");
    is_late = is_late || (is_overlap && !verdicts[i].holds() && verdicts[i].limit < way);
  }
  if (!is_late) return "";
  return fmt::format(
      "In a step of {:.2g} s {} may move by {:.2g} m, {:.2g} of its smallest width, before its "
      "contacts are found again: a shorter step may do.",
      scene.step, name, way, share);
}

}  // namespace

std::string long_step_text(const Choice& choice) {
  const std::string passing = passing_text(choice), late = late_text(choice);
  return passing + (passing.empty() || late.empty() ? "" : " ") + late;
}

std::string cheaper_routines(const Choice& choice) {
  const double limit = (1 - noise_of_step) * choice.runs[choice.answer].seconds();
  std::vector<std::string> names;
  for (const SceneRun* run : uniform_runs(choice, false)) {
    if (run->timing > 0 && run->holds() && run->seconds() < limit) names.push_back(run->name);
  }
  if (names.empty()) return "";
  return fmt::format(
      "(Beside models: the routines of {} for the cylinder itself met all needs in the first runs, "
      "and took less.)",
      fmt::join(names, ", "));
}

namespace {

double step_microseconds(const Choice& choice, const SceneRun& run) {
  return 1e6 * run.seconds() / choice.steps();
}

/// What a need takes of its limit; above 1 it is broken.
double share_of_limit(const Verdict& v) {
  return std::isfinite(v.value) ? v.share() : std::numeric_limits<double>::infinity();
}

/// Of many needs those that are nearest to their limits, or beyond.
std::string needs_of(const Choice& choice, const SceneRun& run) {
  constexpr std::size_t max_shown = 12;
  std::vector<std::size_t> order(run.verdicts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto share = [&](std::size_t i) { return share_of_limit(run.verdicts[i]); };
  std::string left_out;
  if (order.size() > max_shown) {
    std::ranges::stable_sort(order, std::greater(), share);
    const double next = share(order[max_shown]);
    left_out = fmt::format("     and {} more, in choose.html", order.size() - max_shown);
    if (next <= 1) {
      left_out +=
          fmt::format(", which take at most {:.0f}% of their limits", std::ceil(100 * next));
    }
    left_out += '\n';
    order.resize(max_shown);
    std::ranges::sort(order);
  }
  std::string lines;
  for (const std::size_t i : order) {
    lines += need_line(choice.file, choice.spreads, i, run.verdicts[i]);
  }
  return lines + left_out;
}

/// A candidate's name, with what it is for this kind where that is no capsule.
std::string model_name(const Choice& choice, std::size_t kind, const Candidate& model) {
  return model.name + (choice.is_sphere(kind, model) ? " (a sphere here)" : "");
}

/// The model of a kind with the next cheaper query, and how it fails.
std::string next_cheaper(const Choice& choice, std::size_t kind, const std::string& folder) {
  if (choice.cheaper.empty() || !choice.cheaper[kind]) return "    nothing is cheaper\n";
  const std::size_t index = *choice.cheaper[kind];
  const SceneRun& run = choice.runs[index];
  const Candidate& cheaper = *run.models[kind];
  std::string lines =
      fmt::format("    next cheaper: {}, {:.0f} ns, ", model_name(choice, kind, cheaper),
                  choice.nanoseconds(kind, cheaper));
  if (run.holds()) {
    const auto microseconds = [&](const SceneRun& r) { return 1e6 * r.seconds() / choice.steps(); };
    return lines + fmt::format("holds: {}{:.3g} µs a step, and the answer {:.3g}\n",
                               run.timing > 0 ? "" : "about ", microseconds(run),
                               microseconds(choice.runs[choice.answer]));
  }
  lines += fmt::format("breaks\n      {}\n      {}\n", failure(choice.file, run),
                       render_command(choice, run));
  if (const auto& e = run.evidence) {
    lines += fmt::format("      {} at {:.2f} s: {}\n      {}\n", e->bodies, e->time, e->wrong,
                         replay_command(evidence_file(choice, index, folder), e->candidate));
  }
  return lines;
}

std::string kinds_of(const Choice& choice, const std::string& folder) {
  std::string lines;
  const Candidate& exact = *choice.candidates[0];
  for (std::size_t k = 0; k < choice.kinds.all().size(); ++k) {
    const PairKind& kind = choice.kinds.all()[k];
    const Candidate& chosen = *choice.runs[choice.answer].models[k];
    const double ns = choice.nanoseconds(k, chosen);
    const bool is_exact = &chosen == &exact;
    lines += fmt::format("  {} ({}): {}\n", kind.name, kind.bodies,
                         is_exact ? "exact" : model_name(choice, k, chosen));
    lines +=
        is_exact
            ? fmt::format("    {:.0f} ns a query\n", ns)
            : fmt::format("    {:.0f} ns a query instead of {:.0f} ns exactly; {} bytes a shape\n",
                          ns, choice.nanoseconds(k, exact), choice.model_bytes(k, chosen));
    lines += next_cheaper(choice, k, folder);
  }
  return lines;
}

/// What a step takes, of which the solver, and a frame.
std::string times_of(const Choice& choice) {
  const SceneRun &answer = choice.runs[choice.answer], &exact = choice.runs[0];
  const bool differs = choice.answer != 0;
  const auto instead = [&](const char* format, double value) {
    return differs ? fmt::format(fmt::runtime(format), value) : "";
  };
  const double unit = 1e6 / choice.steps();
  const auto point = choice.point_seconds();
  std::string text = fmt::format(
      "A step takes {:.3g} µs{}: its contacts {:.2g} µs{}, the solver {:.3g} µs{}. The solver gets "
      "{:.1f} points{}{}. A frame of 1/60 s takes {:.0f} µs{}.\n",
      unit * answer.seconds(), instead(" instead of {:.3g} µs", unit * exact.seconds()),
      1e-9 * unit * answer.nanoseconds,
      instead(" instead of {:.2g} µs", 1e-9 * unit * exact.nanoseconds),
      unit * answer.solver_seconds, instead(" instead of {:.3g} µs", unit * exact.solver_seconds),
      answer.points, instead(" instead of {:.1f}", exact.points),
      point ? fmt::format("; one costs it about {:.2g} µs", 1e6 * *point) : "",
      1e6 * choice.frame_seconds(answer),
      instead(" instead of {:.0f} µs", 1e6 * choice.frame_seconds(exact)));
  return differs ? text + unasked_text(choice) + '\n' : text;
}

std::string headline(const Choice& choice) {
  if (choice.impossible) {
    const std::size_t disturbance = choice.runs[0].disturbance;
    return fmt::format("Not even exact contacts meet the needs of this scene{}:\n",
                       disturbance == 0 ? "" : fmt::format(" under disturbance {}", disturbance));
  }
  const double percent = 100 * choice.step_saved();
  if (choice.answer != 0) {
    const double seconds = choice.runs[choice.answer].seconds();
    const bool is_cheapest = std::ranges::none_of(choice.runs, [&](const SceneRun& run) {
      return run.timing > 0 && run.holds() && choice.has_models_alone(run) &&
             run.seconds() < seconds;
    });
    return fmt::format("The {} models that meet all needs save {:.0f}% of a step:\n",
                       is_cheapest ? "cheapest" : "simplest of the cheapest", percent);
  }
  const auto is_model = [&](const SceneRun& run) {
    return &run != &choice.runs[0] && run.holds() && choice.has_models_alone(run);
  };
  if (std::ranges::none_of(choice.runs, is_model)) return "Exact: no model meets all needs:\n";
  if (!(percent > 0)) return "Exact: no model that meets all needs takes less of a step:\n";
  return fmt::format(
      "Exact: nothing cheaper that meets all needs saves more than {:.1f}% of a step:\n",
      std::ceil(10 * percent) / 10);
}

/// What a step takes; "~" marks a time of a single run, which was not timed in turns with others.
std::string step_of(const Choice& choice, const SceneRun& run) {
  return fmt::format("{}{:.1f}", run.timing > 0 ? "" : "~", step_microseconds(choice, run));
}

/// One row for each candidate that was run for all pairs.
std::string candidates_table(const Choice& choice, std::size_t columns, bool of_models) {
  const bool is_narrow = columns < columns_of_tables;
  const std::vector<const SceneRun*> runs = uniform_runs(choice, of_models);
  if (runs.empty()) return "";
  const char* const title = of_models ? "One model for all pairs" : "Routines, not models";
  std::string lines = is_narrow ? fmt::format("\n{}\n", title)
                                : fmt::format("\n{:<23} {:>7} {:>8} {:>5}  {}\n", title, "µs/step",
                                              "of limit", "held", "breaks first");
  for (const SceneRun* run : runs) {
    const std::string step = run->holds() ? step_of(choice, *run) : "";
    const std::string error =
        std::isfinite(run->error()) ? fmt::format("{:.3g}", run->error()) : "absurd";
    const std::string failed = run->holds() ? "" : first_failure(*run);
    lines += is_narrow
                 ? narrow_row(run->name, {run->holds() ? step + " µs a step" : "breaks " + failed,
                                          error + " of the limit", "held in " + share_held(*run)})
                 : fmt::format("  {:<21} {:>7} {:>8} {:>5}  {}\n", run->name, step, error,
                               share_held(*run), failed);
  }
  return lines;
}

std::string candidates_tables(const Choice& choice, std::size_t columns) {
  std::string lines = candidates_table(choice, columns, true);
  lines += candidates_table(choice, columns, false);
  for (const Candidate* c : choice.too_slow) {
    lines += fmt::format("  {:<21} takes too long to run\n", c->name);
  }
  for (const Candidate* c : choice.same_as_sphere) {
    lines += fmt::format("  {:<21} is spheres:1 here\n", c->name);
  }
  return lines +
         "  (~: of one run; of limit: the largest share that any need takes; held: of the runs as "
         "written and disturbed; choose.json has the command that draws each)\n";
}

std::string errors(const ReplayScore& s) {
  if (!std::isfinite(s.depth_error)) return "some without an answer";
  return fmt::format("depth off by up to {:.2g} m, normals by {:.2g}°", s.depth_error,
                     s.normal_angle);
}

}  // namespace

std::string in_disturbance(const RepeatedRun& run) {
  return run.disturbance == 0 ? "" : fmt::format(", disturbance {}", run.disturbance);
}

std::string scene_text(const std::string& where, const SceneFile& file, const Trials& trials) {
  std::string lines =
      fmt::format("{}: {}, {:g} s in steps of {:.2g} s\n", where,
                  counted(file.scene.bodies.size(), "body"), file.scene.duration, file.scene.step);
  if (!file.description.empty()) lines += file.description + '\n';
  if (trials.disturbances == 0) return lines;
  return lines + fmt::format("Each run as written, then under {}, the answer under {} (seed {})\n",
                             counted(trials.disturbances, "disturbance"), trials.of_answer(),
                             trials.seed);
}

std::string failure(const SceneFile& file, const RepeatedRun& run) {
  if (!run.end.empty()) return run.end + in_disturbance(run);
  const int broken = run.first_broken();
  const Need& need = *file.needs[broken];
  const Verdict& verdict = run.verdicts[broken];
  return need.text(file.scene) + ": " + measured(verdict, need) + when(file, verdict) +
         in_disturbance(run);
}

std::string first_failure(const RepeatedRun& run) {
  if (!run.end.empty()) return run.end + in_disturbance(run);
  const int broken = run.first_broken();
  return fmt::format("need {}, {:.2f} s{}", broken + 1, run.verdicts[broken].time,
                     in_disturbance(run));
}

std::string share_held(const RepeatedRun& run) {
  return fmt::format("{}/{}", run.held, run.trials);
}

std::string narrow_row(const std::string& name, const std::vector<std::string>& parts) {
  return fmt::format("  {}: {}\n", name, fmt::join(parts, ", "));
}

std::string choice_text(const Choice& choice, const std::string& folder, std::size_t columns) {
  const SceneFile& file = choice.file;
  const SceneRun& answer = choice.runs[choice.answer];
  std::string lines = scene_text(file.name, file, choice.trials);
  lines += undecidable_text(choice.spreads) + '\n' + headline(choice);
  if (const auto text = cheaper_routines(choice); !choice.impossible && !text.empty()) {
    lines += text + '\n';
  }
  lines += needs_of(choice, answer);
  if (choice.impossible) lines += "  " + render_command(choice, answer) + '\n';
  if (const auto text = long_step_text(choice); !text.empty()) lines += text + '\n';
  if (choice.impossible) return Terminal{columns}.folded(lines);
  return Terminal{columns}.folded(lines + times_of(choice) + '\n' + kinds_of(choice, folder) +
                                  candidates_tables(choice, columns));
}

std::string pairs_text(const PairsChoice& choice, const std::string& folder, std::size_t columns) {
  std::string lines = fmt::format(
      "{}: {}, {} of pairs with a cylinder\n"
      "Needs: depth within {:g} m, normals within {:g}°, on {} of each\n",
      choice.name, counted(choice.shapes, "collision shape"), counted(choice.pairs.size(), "kind"),
      choice.needs.depth, choice.needs.angle, counted(choice.needs.count, "sampled pose"));
  for (std::size_t i = 0; i < choice.pairs.size(); ++i) {
    const PairChoice& pair = choice.pairs[i];
    lines +=
        fmt::format("\n{} ({}{})\n", pair.name,
                    pair.count == 1 ? "" : fmt::format("{} pairs, as ", pair.count), pair.example);
    if (pair.chosen) {
      const PairCandidate& c = pair.candidates[*pair.chosen];
      lines += fmt::format("  {}, {:.0f} ns: {}\n",
                           c.name == "reference" ? "the exact cylinder" : c.name,
                           *c.score.nanoseconds, errors(c.score));
    } else {
      lines += "  no candidate serves\n";
    }
    for (const PairCandidate& c : pair.candidates) {
      if (c.name != "capsule" || c.serves) continue;
      lines +=
          fmt::format("  capsule, {:.0f} ns, fails: {}\n    {}\n", *c.score.nanoseconds,
                      errors(c.score), replay_command(evidence_file(choice, i, c, folder), c.name));
    }
  }
  return Terminal{columns}.folded(lines);
}

}  // namespace touchstone
