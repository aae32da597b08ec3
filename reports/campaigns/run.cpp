#include <cerrno>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <optional>
#include <string>
#include <unistd.h>
#include <utility>

#include <nlohmann/json.hpp>

#include "candidates/host/progress.hpp"
#include "properties/files/disk.hpp"
#include "properties/files/strict_json.hpp"
#include "reference/invalid_input.hpp"
#include "reports/campaigns/shard.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

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

/// What began the campaign of a shard file.
std::string command_in(const std::filesystem::path& file) {
  const json campaign = head_of(file).value("campaign", json());
  const bool says =
      campaign.is_object() && campaign.contains("command") && campaign["command"].is_string();
  return says ? campaign["command"].get<std::string>() : "a damaged file";
}

[[noreturn]] void refuse(const std::filesystem::path& file, int error) {
  throw InvalidInput("--out", '"' + file.string() + '"',
                     fmt::format("could not be locked: {}", std::strerror(error)));
}

}  // namespace

FileLock::FileLock(const std::filesystem::path& file)
    : fd_(open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
  if (fd_ < 0) refuse(file, errno);
  struct flock whole {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  if (fcntl(fd_, F_SETLK, &whole) == 0) return;
  const int error = errno;
  close(fd_);
  if (error != EACCES && error != EAGAIN) refuse(file, error);
  throw InvalidInput(
      "--out", '"' + file.parent_path().string() + '"',
      "must be a folder to which no other campaign is writing; wait for its end, or name "
      "another folder by --out");
}

FileLock::~FileLock() { close(fd_); }

ShardPlace::ShardPlace(std::filesystem::path folder, const Shard& shard)
    : folder_(std::move(folder)),
      claim_(folder_, "--out", OutputFolder::Use::shared),
      shard_(shard),
      file_(shard_file(folder_, shard)),
      lock_(std::filesystem::path(file_).replace_extension(".lock")) {}

ShardState ShardPlace::begin(const Plan& plan, bool resume) const {
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
  if (!std::filesystem::exists(file_)) return ShardState(plan, shard_);
  if (!resume) {
    throw InvalidInput("--out", '"' + folder_.string() + '"',
                       fmt::format("already holds a campaign, in {}: {}; choose another folder, or "
                                   "go on with that one: the same command with --resume",
                                   file_.filename().string(), command_in(file_)));
  }
  ShardState found = read_shard(file_, "--out");
  require_same_plan(plan, json::parse(found.plan.text), file_.string());
  if (found.shard != shard_) {
    throw InvalidInput('"' + file_.string() + '"', "shard " + to_string(found.shard),
                       "must be shard " + to_string(shard_) + ", as its name says");
  }
  return found;
}

bool run_shard(const Campaign& campaign, ShardState& state, const std::filesystem::path& file,
               const RunOptions& options, const std::function<bool()>& go_on) {
  using Clock = std::chrono::steady_clock;
  const Cut& cut = state.plan.cut;
  const UnitSet left = state.shard.units(cut) - state.done;
  std::optional<Progress> progress;
  if (options.progress) progress.emplace("configurations", configurations(cut, left));
  std::uint64_t scored = 0;
  Clock::time_point written = Clock::now();
  const auto checkpoint = [&] {
    write_shard(state, file);
    written = Clock::now();
  };
  checkpoint();  // tells at once whether it can be done

  bool all = false;
  try {
    const std::uint64_t length = cut.run_length();
    const auto first_unit = [&](std::uint64_t run) { return nth(left, run * length); };
    all = sample(
        scorer(campaign, Resolution::eighths),
        (boost::icl::cardinality(left) + length - 1) / length,
        [&](std::uint64_t run) { return cut.run(first_unit(run)); },
        [&](std::uint64_t run, const std::vector<Sample>& samples) {
          const std::uint64_t first = first_unit(run);
          for (std::size_t i = 0; i < samples.size(); ++i) {
            const Unit unit = cut.unit(first + i);
            state.samples[unit.cell].add(samples[i]);
            scored += unit.last - unit.first;
          }
          state.done += UnitSet::interval_type(first, first + samples.size());
          if (progress) progress->update(scored);
          if (Clock::now() - written > std::chrono::duration<double>(options.interval)) {
            checkpoint();
          }
        },
        go_on,
        [&] { state.samples = {}; });  // hundreds of megabytes, in which workers have no part
  } catch (const InvalidInput&) {
    throw;  // the file cannot be written
  } catch (const std::exception&) {
    checkpoint();
    throw;
  }
  checkpoint();
  return all;
}

}  // namespace touchstone
