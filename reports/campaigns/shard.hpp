#pragma once

#include <boost/icl/interval_set.hpp>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "properties/files/disk.hpp"
#include "reports/report.hpp"
#include "reports/sampler.hpp"
#include "reports/tally.hpp"

namespace touchstone {

/// How a campaign is cut into units of work, the same however it is shared out: numbers go through
/// all cells with the first configurations of each, then through all with the next ones. A piece of
/// consecutive numbers has its share of every cell, cheap and dear.
struct Cut {
  std::uint64_t cells;
  std::uint64_t count;  ///< of configurations of each cell

  EqualUnits of_cell() const { return {count}; }
  std::uint64_t units() const { return cells * of_cell().units(); }
  Unit unit(std::uint64_t number) const { return of_cell().unit(number % cells, number / cells); }
  /// The units before this one are larger than the others, by one configuration.
  std::uint64_t first_smaller() const { return cells * of_cell().larger(); }

  /// Units of a run (UnitRun): as many as have up to `run_size` configurations together. Runs are
  /// the same for all shards; the last one may be shorter.
  std::uint64_t run_length() const { return run_size / (unit(0).last - unit(0).first); }
  std::uint64_t runs() const { return (units() + run_length() - 1) / run_length(); }
  /// The run that begins with this unit.
  UnitRun run(std::uint64_t first_unit) const;
};

/// Numbers of units, as ranges [first, last).
using UnitSet = boost::icl::interval_set<std::uint64_t, std::less,
                                         boost::icl::right_open_interval<std::uint64_t>>;

/// Is it what some runs consist of?
bool are_whole_runs(const Cut& cut, const UnitSet& set);

/// The number at a position among those of the set, in order.
std::uint64_t nth(const UnitSet& set, std::uint64_t position);
std::uint64_t configurations(const Cut& cut, const UnitSet& set);
/// Of each cell.
std::vector<std::uint64_t> configurations_by_cell(const Cut& cut, const UnitSet& set);

/// One of `of` parts, numbered from 1, which differ by at most a run and one configuration in 257.
struct Shard {
  std::uint64_t number = 1, of = 1;

  bool operator==(const Shard&) const = default;
  /// Units of consecutive runs; those of all shards together are all units, each once.
  UnitSet units(const Cut& cut) const;
};
/// "3/7".
std::string to_string(const Shard& shard);
/// Throws InvalidInput (field "--shard").
Shard parse_shard(const std::string& text);

/// Everything that decides a campaign's result. Parts with the same plan belong together.
struct Plan {
  /// Configurations of each class; numbers of units and configurations of all classes do not
  /// overflow.
  static constexpr std::uint64_t max_count = Magnitudes::max_count;

  std::string version;
  std::string command;  ///< gives the same result in one process; it names every setting
  std::string program;  ///< of the command
  std::uint64_t seed = 0;
  double tolerance = 0, threshold = 0;
  std::vector<PoseClass> cells;
  std::vector<std::string> candidates;
  std::vector<std::string> runs;  ///< how each candidate does: "native", "wasm" or "script"
  Cut cut{};
  /// All of it in JSON, as the campaign's files have it: limits, descriptions, and checksums of the
  /// plug-ins and of the first configuration of each class, which changes when a generator does.
  std::string text;
};
Plan make_plan(const Campaign& campaign, const std::string& command);

/// Throws InvalidInput on anything else than the text of a plan.
Plan plan_from_json(const nlohmann::json& json);

/// Throws InvalidInput (field `file`) naming what differs and how, unless `found` is the text of
/// the expected plan.
void require_same_plan(const Plan& expected, const nlohmann::json& found, const std::string& file);

/// CRC-32 (as in zip and PNG) as eight hexadecimal digits: finds damage, not malice.
std::string checksum(std::string_view text);
/// Of all of them, one after the other.
std::string checksum(std::span<const std::string> texts);

/// How far one shard has come: the samples of the units that are done, and no others.
struct ShardState {
  ShardState(Plan plan, Shard shard);

  /// Adds the samples of some units, one of each cell. The units must not be done yet.
  void add(const UnitSet& units, const std::vector<Sample>& added);

  Plan plan;
  Shard shard;
  UnitSet done;
  std::vector<Sample> samples;  ///< of each cell, by eighths
};

// A shard file is at once checkpoint and result: a line of JSON that says what it is (schema,
// shard, done, plan), the samples as the bytes of properties/files/bytes.hpp, and a line with the
// checksum of all that comes before.

/// shard-3-of-7.bin
std::filesystem::path shard_file(const std::filesystem::path& folder, const Shard& shard);
/// Those in a folder, by name.
std::vector<std::filesystem::path> shard_files(const std::filesystem::path& folder);

/// Writes a shard file as a whole or not at all. Throws InvalidInput (field "--out") where that
/// cannot be done.
void write_shard(const ShardState& state, const std::filesystem::path& file);

std::string to_text(const ShardState& state);
/// `file` is what errors call it. Throws InvalidInput where the text is damaged, cut short, or of
/// something else.
ShardState shard_from_text(std::string_view text, const std::string& file);

/// Reads a shard file. Throws InvalidInput, with this field where the file cannot be read.
ShardState read_shard(const std::filesystem::path& file, const char* field);

/// [[first, last], …], and back; throws InvalidInput on anything else.
nlohmann::json to_json(const UnitSet& set);
UnitSet unit_set_from_json(const nlohmann::json& json);

/// Held by one process at a time, and let go when it ends, however it does: a record lock, which
/// its children do not hold.
class FileLock {
 public:
  /// Makes the file. Throws InvalidInput (field "--out") if another process holds it.
  explicit FileLock(const std::filesystem::path& file);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  int fd_;
};

/// Place of one shard: its file in a campaign's folder, locked as long as this lives.
class ShardPlace {
 public:
  /// Makes the folder. Throws InvalidInput (field "--out") where nothing can be written, another
  /// process is at work on the same shard, or it is one of another command.
  ShardPlace(std::filesystem::path folder, const Shard& shard);

  const std::filesystem::path& file() const { return file_; }

  /// The shard as its file has it, or at its beginning where there is none. Throws InvalidInput
  /// where there is one and `resume` is false, where it is damaged, of another campaign or another
  /// shard, and where the folder holds shards of another campaign or of another cut.
  ShardState begin(const Plan& plan, bool resume) const;

 private:
  std::filesystem::path folder_;
  OutputFolder claim_;
  Shard shard_;
  std::filesystem::path file_;
  FileLock lock_;
};

/// How a shard is run; none of it changes the result.
struct RunOptions {
  double interval = 30;  ///< seconds between checkpoints, by a clock that never jumps
  bool progress = true;  ///< shown on standard error
};

/// Scores the units of the shard that are not done yet, spread over worker processes, and writes
/// `file` at every interval, at the end, and before an error goes on. Ends early, with the file
/// written, once `go_on` says no; units in hand are lost. The result does not depend on workers or
/// interruptions. Returns whether all is done.
bool run_shard(const Campaign& campaign, ShardState& state, const std::filesystem::path& file,
               const RunOptions& options, const std::function<bool()>& go_on);

/// Puts parts of one campaign together, one after the other. The sum does not depend on how the
/// campaign was cut nor on the order of the parts.
class Merge {
 public:
  /// `file` is what errors call the part. Throws InvalidInput where it belongs to another campaign
  /// or holds a unit that an earlier part holds.
  void add(const ShardState& part, const std::string& file);

  /// The sum as the only shard of all. Throws InvalidInput where units are missing, unless they
  /// may, or without any part.
  ShardState whole(bool may_be_partial) const;

 private:
  struct Part {
    std::string file;
    UnitSet units;
  };
  std::vector<ShardState> sum_;  ///< one, once there is a part
  std::vector<Part> parts_;
};

/// Merges shard files, and folders that hold some. Throws InvalidInput as Merge and shard_from_text
/// do.
ShardState merge(const std::vector<std::filesystem::path>& inputs, bool may_be_partial);

// MPI (Open MPI). Ranks are processes that mpirun has started; each runs its own shard, without a
// word to the others, in worker processes of its own. Those must not be forked once MPI runs, so
// MPI is initialised only when all is done, for the one message that each rank has: its tallies.

/// This process's rank as a shard, from the environment that mpirun gives; 1/1 outside of it.
Shard shard_of_rank();
/// Has mpirun started this process, alone or with others?
bool under_mpirun();

/// Merges the parts of all ranks of mpirun, each of which calls it once: the first rank merges them
/// into `merge`, the others send theirs. Returns whether this is the first rank.
bool gather(const ShardState& part, Merge& merge);

/// Result of a campaign: of a report, what does not depend on how, where and how fast it ran.
Report campaign_result(const ShardState& whole);

/// campaign.json (docs/campaign.md): the members of report.json that a campaign has.
std::string campaign_json(const ShardState& whole);

/// Writes campaign.json as a whole or not at all; returns its name. Throws InvalidInput (field
/// "--out") where that cannot be done.
std::filesystem::path write_result(const ShardState& whole, const std::filesystem::path& folder);

}  // namespace touchstone
