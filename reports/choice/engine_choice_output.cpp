#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sstream>

#include <nlohmann/json.hpp>

#include "reports/choice/choice.hpp"
#include "reports/make_report.hpp"
#include "reports/report_json.hpp"
#include "reports/terminal.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

const Cylinder& cylinder_of(const EngineChoice& choice, std::size_t size) {
  return std::get<Cylinder>(
      choice.file.scene.bodies[static_cast<std::size_t>(choice.sizes[size].bodies[0])].shape);
}

std::string bodies_of(const EngineChoice& choice, const CylinderSize& size) {
  const std::string& first =
      choice.file.scene.bodies[static_cast<std::size_t>(size.bodies[0])].name;
  return size.bodies.size() == 1 ? first : fmt::format("{} such, as {}", size.bodies.size(), first);
}

std::string microseconds(const EngineSetting& setting) {
  return setting.step_seconds ? fmt::format("{:.2g}", *setting.step_seconds * 1e6) : "";
}

std::size_t broken_of(const EngineSetting& setting) {
  return static_cast<std::size_t>(
      std::ranges::count_if(setting.verdicts, [](const Verdict& v) { return !v.holds(); }));
}

/// Where no setting is the answer: what a need came to with the default and with our routines.
std::string compared(const EngineChoice& choice, std::size_t need) {
  std::string text;
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
    const EngineSetting& setting = choice.settings[i];
    if (i == choice.nearest()) continue;
    text +=
        fmt::format("     with {}: {}\n", setting_name(setting),
                    setting.end.empty() ? measured(setting.verdicts[need], *choice.file.needs[need])
                                        : setting.end);
  }
  return text;
}

std::string headline(const EngineChoice& choice) {
  const EngineSetting& usual = choice.default_setting();
  if (!choice.answer) {
    const EngineSetting& nearest = choice.settings[choice.nearest()];
    return fmt::format(
        "No shape in {} meets all needs, not even with our routines installed. {} comes nearest, "
        "and breaks {} of {}:\n",
        choice.engine.name, setting_name(nearest), broken_of(nearest), nearest.verdicts.size());
  }
  const EngineSetting& answer = choice.settings[*choice.answer];
  const std::string took =
      usual.step_seconds ? fmt::format(" instead of {} µs", microseconds(usual)) : "";
  std::string lines;
  if (*choice.answer == 0) {
    lines = fmt::format(
        "{}'s default cylinder, {} µs a step: no other of its shapes that meets all needs "
        "takes less than nine tenths of that.\n",
        choice.engine.name, microseconds(usual));
  } else {
    lines =
        fmt::format("{}: {} µs a step{}, {:.1f} contact points instead of {:.1f}.\n",
                    setting_name(answer), microseconds(answer), took, answer.points, usual.points);
    lines += usual.holds()
                 ? "The default cylinder meets all needs, too.\n"
                 : fmt::format("The default cylinder breaks\n  {}\n", failure(choice.file, usual));
  }
  if (answer.has(EngineShape::Kind::exact)) {
    lines += "None of the engine's own shapes meets all needs.\n";
  } else if (const EngineSetting& exact = choice.exact_setting(); exact.holds()) {
    lines += fmt::format("With our routines a step takes {} µs.\n", microseconds(exact));
  }
  return lines;
}

/// A setting's shape of each size, and the lines that make it.
std::string lines_to_paste(const EngineChoice& choice, const EngineSetting& setting) {
  std::string text;
  for (std::size_t i = 0; i < choice.sizes.size(); ++i) {
    const EngineShape& shape = setting.shapes[i];
    text += fmt::format("\n{} ({}): {}\n", choice.sizes[i].name, bodies_of(choice, choice.sizes[i]),
                        engine_shape_name(shape));
    std::istringstream lines(engine_lines(choice.engine.name, shape, cylinder_of(choice, i)));
    for (std::string line; std::getline(lines, line);) text += "    " + line + '\n';
  }
  return text;
}

std::string settings_table(const EngineChoice& choice, std::size_t columns) {
  const bool is_narrow = columns < columns_of_tables;
  std::size_t width = 22;  // names of several sizes' shapes are longer
  for (const EngineSetting& s : choice.settings) width = std::max(width, setting_name(s).size());
  std::string lines = is_narrow ? "\nAll that was run\n"
                                : fmt::format("\n{:<{}}µs/step points  held  breaks first\n",
                                              "All that was run", width + 2);
  for (const EngineSetting& s : choice.settings) {
    const std::string failed = s.holds() ? "" : first_failure(s);
    const std::string points = fmt::format("{:.1f}", s.points);
    lines += is_narrow
                 ? narrow_row(setting_name(s),
                              {s.holds() ? microseconds(s) + " µs a step" : "breaks " + failed,
                               points + " points", "held in " + share_held(s)})
                 : fmt::format("  {:<{}} {:>6} {:>6} {:>5}  {}\n", setting_name(s), width,
                               microseconds(s), points, share_held(s), failed);
  }
  return Terminal{columns}.folded(lines);
}

json setting_json(const EngineChoice& choice, const EngineSetting& setting) {
  json shapes = json::array();
  for (const EngineShape& shape : setting.shapes) shapes.push_back(engine_shape_name(shape));
  json result = run_json(choice.file, setting);
  result.update(
      {{"name", setting_name(setting)},
       {"shapes", shapes},
       {"step_microseconds",
        setting.step_seconds ? json(*setting.step_seconds * 1e6) : json(nullptr)},
       {"points", setting.points},
       {"end", setting.end.empty() ? json(nullptr) : json(setting.end)},
       {"failure", setting.holds() ? json(nullptr) : json(failure(choice.file, setting))}});
  return result;
}

}  // namespace

std::string setting_name(const EngineSetting& setting) {
  std::vector<std::string> names;
  for (const EngineShape& shape : setting.shapes) names.push_back(engine_shape_name(shape));
  const bool is_uniform = std::equal(names.begin() + 1, names.end(), names.begin());
  return is_uniform ? names[0] : fmt::format("{}", fmt::join(names, "; "));
}

std::string engine_choice_text(const EngineChoice& choice, std::size_t columns) {
  const SceneFile& file = choice.file;
  std::string text =
      scene_text(fmt::format("{} in {} {}", file.name, choice.engine.name, choice.engine.version),
                 file, choice.trials);
  for (const std::string& need : choice.left_out) {
    text += fmt::format("Left out, for an engine's normals are not judged: {}\n", need);
  }
  for (const std::string& need : choice.not_judged) {
    text += fmt::format("Not judged, for {} ended a run with our routines ({}): {}\n",
                        choice.engine.name, choice.exact_end, need);
  }
  text += undecidable_text(choice.spreads) + '\n' + headline(choice);
  const EngineSetting& shown = choice.settings[choice.answer.value_or(choice.nearest())];
  for (std::size_t i = 0; i < shown.verdicts.size(); ++i) {
    text += need_line(file, choice.spreads, i, shown.verdicts[i]);
    if (!choice.answer) text += compared(choice, i);
  }
  if (const auto unasked = unasked_text(choice); !unasked.empty()) text += unasked + '\n';
  text = Terminal{columns}.folded(text) + lines_to_paste(choice, shown);
  return text + settings_table(choice, columns);
}

json engine_choice_json(const EngineChoice& choice, const std::string& command) {
  json sizes = json::array(), settings = json::array();
  json scene = scene_json(choice.file, choice.trials, choice.spreads);
  scene["left_out"] = choice.left_out;
  scene["not_judged"] = choice.not_judged;
  scene["exact_end"] = choice.exact_end.empty() ? json(nullptr) : json(choice.exact_end);
  const EngineSetting& shown = choice.settings[choice.answer.value_or(choice.nearest())];
  for (std::size_t i = 0; i < choice.sizes.size(); ++i) {
    const EngineShape& shape = shown.shapes[i];
    sizes.push_back({{"name", choice.sizes[i].name},
                     {"bodies", bodies_of(choice, choice.sizes[i])},
                     {"shape", engine_shape_name(shape)},
                     {"lines", engine_lines(choice.engine.name, shape, cylinder_of(choice, i))}});
  }
  for (const EngineSetting& s : choice.settings) settings.push_back(setting_json(choice, s));
  return {{"schema", "touchstone-engine-choice-1"},
          {"command", command},
          {"machine", to_json(describe_machine())},
          {"engine",
           {{"name", choice.engine.name},
            {"version", choice.engine.version},
            {"settings", choice.engine.settings}}},
          {"scene", scene},
          {"sizes", sizes},
          {"answer", choice.answer ? json(*choice.answer) : json(nullptr)},
          {"nearest", choice.nearest()},
          {"unasked", unasked_text(choice)},
          {"settings", settings}};
}

}  // namespace touchstone
