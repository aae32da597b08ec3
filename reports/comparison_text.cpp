#include <algorithm>
#include <fmt/format.h>
#include <string>
#include <utility>
#include <vector>

#include "reports/compare.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

constexpr std::size_t most_shown = 20;  // of each verdict

std::string value(const json& change, const char* which) {
  const double v = change[which];
  const std::string measure = change["measure"];
  if (measure == "has a routine") return v > 0 ? "yes" : "no";
  if (measure == "agreement") return fmt::format("{:.1f}%", 100 * v);
  if (measure == "time") return fmt::format("{:.2f}", v);
  if (measure == "instructions") return fmt::format("{:.0f}", v);
  return v == 0 ? "0" : fmt::format("{:.1e}", v);
}

std::string factor(const json& change) {
  const json& f = change["factor"];
  return f.is_null() ? "" : fmt::format("x {:.3g}", f.get<double>());
}

/// Broken at blanks, indented by two.
std::string wrapped(const std::string& text) {
  constexpr std::size_t width = 76;
  std::string result;
  std::size_t at = 0;
  while (at < text.size()) {
    std::size_t end = text.size();
    if (end - at > width) {
      end = text.rfind(' ', at + width);
      if (end == std::string::npos || end <= at) end = std::min(text.find(' ', at), text.size());
    }
    result += (at == 0 ? "- " : "  ") + text.substr(at, end - at) + '\n';
    at = end + 1;
  }
  return result;
}

/// Those of one verdict beyond the limits, the largest first; all of one row stand together.
std::string section(const char* title, const char* verdict, const json& changes) {
  std::vector<std::pair<std::string, std::string>> shown;  // a row, its changes
  for (const json& c : changes) {
    if (c["verdict"] != verdict || !c["beyond_limits"].get<bool>()) continue;
    const std::string row =
        fmt::format("{}/{}  {}", c["pair"].get<std::string>(), c["class"].get<std::string>(),
                    c["candidate"].get<std::string>());
    auto at =
        std::find_if(shown.begin(), shown.end(), [&](const auto& s) { return s.first == row; });
    if (at == shown.end()) at = shown.insert(at, {row, ""});
    at->second += fmt::format("    {:<24} {:>10} -> {:>10}  {}\n", c["measure"].get<std::string>(),
                              value(c, "before"), value(c, "after"), factor(c));
  }
  if (shown.empty()) return "";
  std::string text = fmt::format("\n{}: {}\n", title, shown.size());
  for (std::size_t i = 0; i < std::min(shown.size(), most_shown); ++i) {
    text += "  " + shown[i].first + '\n' + shown[i].second;
  }
  if (shown.size() > most_shown) {
    text += fmt::format("  and {} more, which --json lists\n", shown.size() - most_shown);
  }
  return text;
}

}  // namespace

std::string comparison_text(const json& comparison) {
  std::string text;
  for (const char* which : {"before", "after"}) {
    const json& report = comparison[which];
    text += fmt::format("{:<7} {} configurations, seed {}\n", which,
                        report["configurations"].dump(), report["seed"].dump());
  }
  for (const json& remark : comparison["remarks"]) text += wrapped(remark.get<std::string>());

  const json &changes = comparison["changes"], &limits = comparison["limits"];
  text += section("Worse", "worse", changes) + section("Slower", "slower", changes) +
          section("Better", "better", changes) + section("Faster", "faster", changes);
  const auto within = std::count_if(changes.begin(), changes.end(),
                                    [](const json& c) { return !c["beyond_limits"].get<bool>(); });
  text += '\n';
  if (changes.empty()) text += "No change. ";
  if (within > 0) text += fmt::format("{} smaller changes, within the limits.\n", within);
  text += fmt::format(
      "{} rows of pair, class and candidate compared.\n"
      "Limits: errors {:g} times; times {:g} times, as multiples of {}'s and by the\n"
      "nearest ends of their spreads; {:g} of the agreement kept.\n",
      comparison["compared"].get<std::size_t>(), limits["error_factor"].get<double>(),
      limits["time_factor"].get<double>(), limits["baseline"].get<std::string>(),
      limits["agreement"].get<double>());
  return text;
}

}  // namespace touchstone
