#include "reports/choice/choice_text.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace touchstone {
namespace {

using nlohmann::json;

std::string text(const json& value) { return value.get<std::string>(); }

std::string measured(const json& value, const json& need) {
  if (value.is_null()) return "the motion becomes absurd";
  return fmt::format("{:.3g}{}", value.get<double>(), text(need["unit"]));
}

/// "can stands within 0.5°: 12.3° at 0.71 s"
std::string failure(const json& choice, const json& run) {
  const std::size_t broken = run["first_broken"].get<std::size_t>();
  const json &need = choice["scene"]["needs"][broken], &verdict = run["verdicts"][broken];
  return fmt::format("{}: {} at {:.2f} s", text(need["text"]), measured(verdict["value"], need),
                     verdict["time"].get<double>());
}

/// "need 3 at 0.71 s"
std::string breaks(const json& run) {
  const std::size_t broken = run["first_broken"].get<std::size_t>();
  return fmt::format("need {} at {:.2f} s", broken + 1,
                     run["verdicts"][broken]["time"].get<double>());
}

std::string evidence(const json& run, const char* indent) {
  if (run["evidence"].is_null()) return "";
  const json& e = run["evidence"];
  return fmt::format("{0}{1} at {2:.2f} s: {3}\n{0}{4}\n", indent, text(e["bodies"]),
                     e["time"].get<double>(), text(e["wrong"]), text(e["replay"]));
}

std::string needs_of(const json& choice, const json& run) {
  std::string lines;
  for (std::size_t i = 0; i < run["verdicts"].size(); ++i) {
    const json &need = choice["scene"]["needs"][i], &verdict = run["verdicts"][i];
    lines +=
        fmt::format("{:>3}. {:<6} {}: {}\n", i + 1, verdict["holds"] == true ? "holds" : "BROKEN",
                    text(need["text"]), measured(verdict["value"], need));
  }
  return lines;
}

std::string answer(const json& choice) {
  std::string lines;
  for (const json& kind : choice["kinds"]) {
    const double ns = kind["nanoseconds"].get<double>();
    const double exact = kind["exact_nanoseconds"].get<double>();
    lines += fmt::format("  {} ({}): {}\n", text(kind["name"]), text(kind["bodies"]),
                         kind["chosen"] == "reference" ? "exact" : text(kind["chosen"]));
    lines += kind["chosen"] == "reference"
                 ? fmt::format("    {:.0f} ns a query\n", ns)
                 : fmt::format("    {:.0f} ns a query instead of {:.0f} ns exactly\n", ns, exact);
    if (kind["next_cheaper"].is_null()) {
      lines += "    nothing is cheaper\n";
      continue;
    }
    const json& cheaper = kind["next_cheaper"];
    const json& run = choice["runs"][cheaper["run"].get<std::size_t>()];
    lines +=
        fmt::format("    next cheaper: {}, {:.0f} ns, breaks\n      {}\n", text(cheaper["name"]),
                    cheaper["nanoseconds"].get<double>(), failure(choice, run));
    lines += evidence(run, "      ");
  }
  return lines;
}

std::string headline(const json& choice) {
  if (choice["possible"] == false) {
    return "Not even exact contacts meet the needs of this scene:\n";
  }
  if (choice["exact_is_cheapest"] == true) {
    return "The exact cylinder is itself the cheapest model that meets all needs:\n";
  }
  return fmt::format(
      "The cheapest models that meet all needs save {:.0f}% of the contacts' time:\n",
      100 * choice["time_saved"].get<double>());
}

}  // namespace

std::string choice_text(const json& choice) {
  const json& scene = choice["scene"];
  const json& run = choice["runs"][choice["answer"].get<std::size_t>()];
  std::string lines =
      fmt::format("{}: {} bodies, {:g} s in steps of {:.2g} s\n\n{}", text(scene["name"]),
                  scene["bodies"].get<std::size_t>(), scene["duration"].get<double>(),
                  scene["step"].get<double>(), headline(choice));
  lines += needs_of(choice, run);
  if (choice["possible"] == false) return lines;
  const double exact = choice["runs"][0]["microseconds_per_step"].get<double>();
  const double chosen = run["microseconds_per_step"].get<double>();
  lines += fmt::format(
      "Contacts take {:.2g} µs of a step{}; the rest of it takes {:.0f} µs.\n\n{}", chosen,
      choice["exact_is_cheapest"] == true ? ""
                                          : fmt::format(" instead of {:.2g} µs exactly", exact),
      choice["rest_of_step_microseconds"].get<double>(), answer(choice));

  lines += "\nOne model for all pairs      µs/step   error/limit  breaks first\n";
  for (const json& other : choice["runs"]) {
    const std::string name = text(other["name"]);
    if (name.find(' ') != std::string::npos || name == "combination") continue;
    lines += fmt::format(
        "  {:<24} {:>9.2f} {:>13}  {}\n", name, other["microseconds_per_step"].get<double>(),
        other["error"].is_null() ? "absurd" : fmt::format("{:.3g}", other["error"].get<double>()),
        other["holds"] == true ? "" : breaks(other));
  }
  for (const json& name : choice["too_slow"]) {
    lines += fmt::format("  {:<24} takes too long to run\n", text(name));
  }
  return lines;
}

}  // namespace touchstone
