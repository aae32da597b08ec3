#include "reports/campaigns/shard_place.hpp"

#include <fstream>
#include <string>
#include <utility>

#include "properties/files/read_file.hpp"
#include "properties/files/strict_json.hpp"
#include "properties/files/write_file.hpp"
#include "reference/invalid_input.hpp"
#include "reports/make_report.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

std::filesystem::path writable(std::filesystem::path folder) {
  check_writable(folder);
  return folder;
}

/// The first line of a shard file alone: another process may be at work on the rest.
json head_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  try {
    const json head = parse_json(line, "it");
    return head.is_object() ? head : json::object();
  } catch (const InvalidInput&) {
    return json::object();
  }
}

}  // namespace

ShardPlace::ShardPlace(std::filesystem::path folder, const Shard& shard)
    : folder_(writable(std::move(folder))),
      shard_(shard),
      file_(shard_file(folder_, shard)),
      lock_(std::filesystem::path(file_).replace_extension(".lock")) {}

Progressed ShardPlace::begin(const json& plan, bool resume) const {
  for (const auto& other : shard_files(folder_)) {
    if (other == file_) continue;
    const json head = head_of(other);
    require_same_plan(plan, head.value("campaign", json()), other.string());
    const json cut = head.value("shard", json());
    if (!cut.is_array() || cut.size() != 2 || cut[1] != shard_.of) {
      throw InvalidInput(
          "--out", '"' + folder_.string() + '"',
          "already holds this campaign cut in another way; go on as it was begun, or "
          "choose another folder");
    }
  }
  if (!std::filesystem::exists(file_)) return Progressed(plan, shard_);
  if (!resume) {
    throw InvalidInput("--out", '"' + folder_.string() + '"',
                       "already holds a campaign; go on with --resume, or choose another folder");
  }
  Progressed found = progressed_from_text(read_file(file_, "--out"), file_.string());
  require_same_plan(plan, found.plan, file_.string());
  return found;
}

}  // namespace touchstone
