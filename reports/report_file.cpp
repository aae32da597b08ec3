#include <fmt/format.h>
#include <future>
#include <string>

#include <nlohmann/json.hpp>

#include "properties/files/disk.hpp"
#include "properties/files/json_members.hpp"
#include "properties/files/strict_json.hpp"
#include "properties/identity.hpp"
#include "reference/invalid_input.hpp"
#include "reports/inconsistency.hpp"
#include "reports/report_json.hpp"
#include "reports/report_members.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

Report report(const json& file) {
  const JsonIn in(file);
  const json schema = in.at("schema").value();
  constexpr int old_schema = 1, schema_of_old_judge = 2;
  Report result;
  result.is_old = schema == old_schema;
  result.is_of_old_judge = result.is_old || schema == schema_of_old_judge;
  in.require(result.is_of_old_judge || schema == report_schema, "schema",
             fmt::format("must be {}, {} or {}", old_schema, schema_of_old_judge, report_schema));
  members(in, result);
  for (ResultRow& row : result.results) {
    const auto today = find_pose_class(row.pair, row.pose_class);
    if (result.is_old && today) row.pose_class = today->name();
  }
  if (const auto found = inconsistency(result)) throw *found;
  return result;
}

}  // namespace

Report report_from_text(std::string_view text, const std::string& name) {
  const auto refuse_file = [&](const std::string& must) {
    throw InvalidInput("file", '"' + name + '"', must);
  };
  json parsed;
  try {
    parsed = parse_json(text, "it");
  } catch (const InvalidInput& e) {
    refuse_file(std::string("must be a report.json; ") + e.what());
  }
  if (!parsed.is_object()) refuse_file("must be a report.json: an object");
  // Other files of ours name what they are.
  if (const json schema = parsed.value("schema", json()); schema.is_string()) {
    refuse_file("must be the report.json of touchstone report, but has schema " + shown(schema));
  }
  try {
    return report(parsed);
  } catch (const InvalidInput& e) {
    throw InvalidInput(name + ": " + e.field(), e.value(),
                       e.remedy() + "; make the report again with this version of touchstone");
  }
}

Report read_report(const std::filesystem::path& file) {
  return report_from_text(read_file(file, "file"), file.string());
}

void write_report(const Report& report, const std::filesystem::path& folder) {
  check_writable(folder);
  auto page = std::async(std::launch::async, [&] { return report_page(report); });
  write_file(folder / "report.json", text_by_lines(to_json(report)), "--out");
  write_file(folder / "report.html", page.get(), "--out");
}

}  // namespace touchstone
