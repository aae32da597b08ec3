#include "reports/comparison_basis.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <set>
#include <utility>

namespace touchstone {
namespace {

using nlohmann::json;

std::set<std::string> names(const json& list, const char* member) {
  std::set<std::string> result;
  for (const json& entry : list) result.insert(entry[member].get<std::string>());
  return result;
}

std::set<std::string> class_names(const json& results) {
  std::set<std::string> result;
  for (const json& row : results) {
    result.insert(row["pair"].get<std::string>() + '/' + row["class"].get<std::string>());
  }
  return result;
}

std::set<std::string> without(const std::set<std::string>& all, const std::set<std::string>& some) {
  std::set<std::string> result;
  std::set_difference(all.begin(), all.end(), some.begin(), some.end(),
                      std::inserter(result, result.end()));
  return result;
}

void remark_candidates(ComparisonBasis& basis, const json& before, const json& after) {
  for (const json& old : before["candidates"]) {
    for (const json& now : after["candidates"]) {
      if (old["name"] != now["name"]) continue;
      const std::string name = old["name"];
      if (old["version"] != now["version"]) {
        basis.remark(fmt::format("{}: version {} before, {} now.", name,
                                 old["version"].get<std::string>(),
                                 now["version"].get<std::string>()));
      }
      if (old["settings"] != now["settings"]) {
        basis.remark(fmt::format("{} is called in another way than before.", name));
      }
    }
  }
}

}  // namespace

ComparisonBasis comparison_basis(const json& before, const json& after,
                                 const std::string& baseline) {
  ComparisonBasis basis;
  const auto only = [&](const std::set<std::string>& left, const char* what, const char* where) {
    if (left.empty()) return;
    basis.remark(fmt::format("Only in the {} report, not compared: {} {}.", where, what,
                             fmt::join(left, ", ")));
  };
  const auto old_names = names(before["candidates"], "name");
  const auto new_names = names(after["candidates"], "name");
  only(without(old_names, new_names), "candidates", "old");
  only(without(new_names, old_names), "candidates", "new");
  const auto old_classes = class_names(before["results"]);
  const auto new_classes = class_names(after["results"]);
  only(without(old_classes, new_classes), "classes", "old");
  only(without(new_classes, old_classes), "classes", "new");
  basis.same_classes = old_classes == new_classes;

  const auto count = [](const json& report) {
    return report["results"].empty() ? json(0) : report["results"][0]["count"];
  };
  basis.same_configurations = before["seed"] == after["seed"] && count(before) == count(after);
  if (!basis.same_configurations) {
    basis.remark(fmt::format(
        "The configurations differ (seed {} and {}, {} and {} of each class): only pairs as a "
        "whole "
        "are compared, by median and 99th percentile, and agreement beyond chance.",
        before["seed"].dump(), after["seed"].dump(), count(before).dump(), count(after).dump()));
  }
  basis.same_bar =
      before["tolerance"] == after["tolerance"] && before["threshold"] == after["threshold"];
  if (!basis.same_bar) {
    basis.remark(fmt::format(
        "The bars differ (tolerance {} and {}, threshold {} and {}): agreement and coverage are "
        "not compared.",
        before["tolerance"].dump(), after["tolerance"].dump(), before["threshold"].dump(),
        after["threshold"].dump()));
  }
  for (const auto& [report, which] : {std::pair(&before, "old"), std::pair(&after, "new")}) {
    if ((*report)["partial"].get<bool>()) {
      basis.remark(fmt::format("The {} report is partial: its run was interrupted.", which));
    }
  }
  if (before["version"] != after["version"]) {
    basis.remark(fmt::format("Made by touchstone {} and {}.", before["version"].get<std::string>(),
                             after["version"].get<std::string>()));
  }
  remark_candidates(basis, before, after);
  for (const char* what : {"cpu", "compiler"}) {
    if (before["machine"][what] == after["machine"][what]) continue;
    basis.remark(fmt::format("Another {}: {} before, {} now.", what,
                             before["machine"][what].get<std::string>(),
                             after["machine"][what].get<std::string>()));
  }
  basis.times = old_names.count(baseline) > 0 && new_names.count(baseline) > 0;
  if (!basis.times) {
    basis.remark(fmt::format("Times are not compared: {} is not in both reports to relate them to.",
                             baseline));
  }
  return basis;
}

}  // namespace touchstone
