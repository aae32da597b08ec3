#include "reports/campaigns/plan.hpp"

#include <fmt/format.h>

#include "properties/files/configuration_json.hpp"
#include "properties/files/json_fields.hpp"
#include "reference/invalid_input.hpp"
#include "reports/campaigns/durable_file.hpp"
#include "reports/worst.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

/// Calls read(element, "name[i]") for each element.
template <class Read>
void each_of(const json& plan, const char* name, Read read) {
  const json& array = member(plan, name, "campaign");
  if (!array.is_array()) throw InvalidInput(name, shown(array), "must be an array");
  for (std::size_t i = 0; i < array.size(); ++i) read(array[i], fmt::format("{}[{}]", name, i));
}

/// "candidates[1].version is 3.24, not 3.25"; lists by the first entry that differs.
std::string difference(const std::string& name, const json& expected, const json& found) {
  if (expected.is_object() && found.is_object()) {
    for (const auto& [key, value] : expected.items()) {
      const json other = found.value(key, json());
      if (other != value) return difference(name.empty() ? key : name + "." + key, value, other);
    }
  }
  if (expected.is_array() && found.is_array() && expected.size() == found.size()) {
    for (std::size_t i = 0; i < expected.size(); ++i) {
      if (found[i] != expected[i]) {
        return difference(fmt::format("{}[{}]", name, i), expected[i], found[i]);
      }
    }
  }
  return fmt::format("{} is {}, not {}", name, shown(found), shown(expected));
}

}  // namespace

json make_plan(const Campaign& campaign, const std::string& command) {
  json classes = json::array(), candidates = json::array();
  std::string first_configurations;
  for (const Cell& cell : cells(campaign)) {
    classes.push_back({{"pair", pair_name(cell.pair)},
                       {"class", cell.pose_class},
                       {"description", describe_pose_class(cell.pair, cell.pose_class)}});
    first_configurations +=
        to_hex_json(make_configuration({cell.pair, cell.pose_class, campaign.seed, 0})).dump();
  }
  for (const Candidate* c : campaign.candidates) {
    candidates.push_back({{"name", c->name},
                          {"family", c->family},
                          {"version", c->version},
                          {"settings", c->settings},
                          {"models", c->models},
                          {"plugin_checksum", checksum(read_whole(c->plugin, "--candidate"))}});
  }
  return {{"version", TOUCHSTONE_VERSION},
          {"command", command},
          {"program", program_name()},
          {"seed", campaign.seed},
          {"count", campaign.count},
          {"unit_size", Cut::unit_size},
          {"tolerance", campaign.bar.tolerance},
          {"threshold", campaign.bar.threshold},
          {"time_limit", campaign.limits.seconds},
          {"memory_limit", campaign.limits.mebibytes},
          {"classes", classes},
          {"first_configurations_checksum", checksum(first_configurations)},
          {"candidates", candidates}};
}

PlanView::PlanView(const json& plan)
    : cut{0, whole_number(member(plan, "count", "campaign"), "campaign.count", max_count)},
      seed(whole_number(member(plan, "seed", "campaign"), "campaign.seed")) {
  for (const char* name : {"version", "command", "program"}) {
    string(member(plan, name, "campaign"), name);
  }
  for (const char* name : {"tolerance", "threshold"}) number(member(plan, name, "campaign"), name);
  each_of(plan, "classes", [&](const json& c, const std::string& path) {
    const auto text = [&](const char* name) {
      return string(member(c, name, path), path + '.' + name);
    };
    const Pair pair = parse_pair(text("pair"));
    const Cell cell{pair, text("class")};
    describe_pose_class(pair, cell.pose_class);  // throws where there is no such class
    for (const Cell& other : cells) {
      if (other.pair == cell.pair && other.pose_class == cell.pose_class) {
        throw InvalidInput(path, shown(c), "must be another class: it is given twice");
      }
    }
    cells.push_back(cell);
  });
  each_of(plan, "candidates", [&](const json& c, const std::string& path) {
    candidates.push_back(string(member(c, "name", path), path + ".name"));
  });
  cut.cells = cells.size();
  if (cells.empty() || cut.count == 0) {
    throw InvalidInput("campaign", "empty", "must have classes and a count");
  }
}

void require_same_plan(const json& expected, const json& found, const std::string& file) {
  if (expected == found) return;
  // Members that follow from others tell less than those.
  json settings = expected, other_settings = found.is_object() ? found : json::object();
  for (const char* derived : {"command", "first_configurations_checksum"}) {
    settings.erase(derived);
    other_settings.erase(derived);
  }
  const std::string what = settings == other_settings ? difference("", expected, found)
                                                      : difference("", settings, other_settings);
  throw InvalidInput('"' + file + '"', "of another campaign",
                     what + "; parts of different campaigns are never put together");
}

}  // namespace touchstone
