#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fmt/format.h>
#include <mpi.h>

#include <nlohmann/json.hpp>

#include "candidates/readable.hpp"
#include "properties/files/disk.hpp"
#include "properties/files/given_text.hpp"
#include "reference/invalid_input.hpp"
#include "reports/campaigns/shard.hpp"
#include "reports/make_report.hpp"
#include "reports/report_json.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

/// "cylinder-box/rim-face, configurations 512 to 1023".
std::string describe(const Plan& plan, std::uint64_t number) {
  const Unit unit = plan.cut.unit(number);
  return fmt::format("{}/{}, configurations {} to {}", pair_name(plan.cells[unit.cell].pair),
                     plan.cells[unit.cell].name(), unit.first, unit.last - 1);
}

constexpr const char* size_variable = "OMPI_COMM_WORLD_SIZE";
constexpr const char* rank_variable = "OMPI_COMM_WORLD_RANK";

std::uint64_t number_in(const char* variable) {
  const char* const text = std::getenv(variable);
  std::uint64_t value = 0;
  const char* const end = text ? text + std::strlen(text) : nullptr;
  if (!text || std::from_chars(text, end, value).ptr != end) {
    throw InvalidInput(variable, text ? text : "unset", "must be the number that mpirun gives");
  }
  return value;
}

/// MPI counts bytes in int.
constexpr std::size_t piece = 1 << 30;

void send(const std::string& text) {
  const std::uint64_t size = text.size();
  MPI_Send(&size, 1, MPI_UINT64_T, 0, 0, MPI_COMM_WORLD);
  for (std::size_t at = 0; at < text.size(); at += piece) {
    MPI_Send(text.data() + at, static_cast<int>(std::min(piece, text.size() - at)), MPI_BYTE, 0, 0,
             MPI_COMM_WORLD);
  }
}

std::string receive(int rank) {
  std::uint64_t size = 0;
  MPI_Recv(&size, 1, MPI_UINT64_T, rank, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  std::string text(size, '\0');
  for (std::size_t at = 0; at < text.size(); at += piece) {
    MPI_Recv(text.data() + at, static_cast<int>(std::min(piece, text.size() - at)), MPI_BYTE, rank,
             0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  }
  return text;
}

bool exchange(const ShardState& part, Merge& merge) {
  int rank = 0, size = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  if (rank != 0) {
    send(to_text(part));
    return false;
  }
  merge.add(part, "rank 0");
  for (int other = 1; other < size; ++other) {
    const std::string name = fmt::format("rank {}", other);
    merge.add(shard_from_text(receive(other), name), name);
  }
  return true;
}

}  // namespace

void Merge::add(const ShardState& part, const std::string& file) {
  if (sum_.empty()) {
    sum_.emplace_back(part.plan, Shard{});
  } else {
    require_same_plan(sum_.front().plan, json::parse(part.plan.text), file);
  }
  for (const Part& earlier : parts_) {
    const UnitSet both = earlier.units & part.done;
    if (both.empty()) continue;
    throw InvalidInput('"' + file + '"', "no separate part",
                       fmt::format("it and \"{}\" both hold {}", earlier.file,
                                   describe(part.plan, both.begin()->lower())));
  }
  sum_.front().add(part.done, part.samples);
  parts_.push_back({file, part.done});
}

ShardState Merge::whole(bool may_be_partial) const {
  if (sum_.empty()) throw InvalidInput("--merge", "empty", "must hold shard files of a campaign");
  const ShardState& sum = sum_.front();
  const UnitSet missing = Shard{}.units(sum.plan.cut) - sum.done;
  if (!missing.empty() && !may_be_partial) {
    throw InvalidInput(
        "--merge", "incomplete",
        fmt::format("{} of {} are missing, the first of them {}; give all parts, "
                    "finish them with --resume, or take what there is with --partial",
                    configurations(sum.plan.cut, missing),
                    counted(sum.plan.cut.cells * sum.plan.cut.count, "configuration"),
                    describe(sum.plan, missing.begin()->lower())));
  }
  return sum;
}

ShardState merge(const std::vector<std::filesystem::path>& inputs, bool may_be_partial) {
  Merge merge;
  const auto add = [&](const std::filesystem::path& file) {
    merge.add(read_shard(file, "--merge"), file.string());
  };
  for (const auto& input : inputs) {
    if (!is_folder(input)) {
      add(input);
      continue;
    }
    const auto files = shard_files(input);
    if (files.empty()) {
      throw InvalidInput("--merge", '"' + input.string() + '"', "must hold shard files");
    }
    for (const auto& file : files) add(file);
  }
  return merge.whole(may_be_partial);
}

bool under_mpirun() { return std::getenv(size_variable) != nullptr; }

Shard shard_of_rank() {
  if (!under_mpirun()) return {};
  const std::uint64_t rank = number_in(rank_variable), size = number_in(size_variable);
  if (rank >= size) {
    throw InvalidInput(rank_variable, fmt::format("{}", rank),
                       fmt::format("must be less than {}, which is {}", size_variable, size));
  }
  return {rank + 1, size};
}

bool gather(const ShardState& part, Merge& merge) {
  MPI_Init(nullptr, nullptr);
  try {
    const bool first = exchange(part, merge);
    MPI_Finalize();
    return first;
  } catch (const std::exception& e) {
    // The other ranks would wait for ever.
    std::fputs(escaped(fmt::format("error: {}\n", e.what())).c_str(), stderr);
    MPI_Abort(MPI_COMM_WORLD, 2);
    throw;
  }
}

Report campaign_result(const ShardState& whole) {
  const Plan& plan = whole.plan;
  Report report;
  report.version = plan.version;
  report.command = plan.command;
  report.seed = plan.seed;
  report.tolerance = plan.tolerance;
  report.threshold = plan.threshold;
  report.planned = {plan.cut.cells, plan.cut.cells * plan.cut.count};
  for (std::size_t k = 0; k < plan.candidates.size(); ++k) {
    CandidateDescription& candidate = report.candidates.emplace_back();
    candidate.name = plan.candidates[k];
    candidate.runs = plan.runs[k];
  }
  Scored scored{plan.cells, {}};
  for (const Sample& sample : whole.samples) scored.samples.push_back(&sample);
  scored.replay = [&](const Identity& identity, const std::vector<std::string>&) {
    return plan.program + " replay " + to_string(identity);
  };
  add_results(report, scored);
  return report;
}

std::string campaign_json(const ShardState& whole) {
  const Report report = campaign_result(whole);
  const json plan = json::parse(whole.plan.text);
  const auto list = [](const auto& values) {
    json result = json::array();
    for (const auto& value : values) result.push_back(to_json(value));
    return result;
  };
  json result = {{"schema", "touchstone-campaign-3"},
                 {"configurations", report.configurations},
                 {"complete", report.completed.configurations == report.planned.configurations},
                 {"results", list(report.results)},
                 {"summary", list(report.summary)},
                 {"classes", list(report.classes)},
                 {"factors", list(report.factors)},
                 {"contrasts", list(report.contrasts)},
                 {"worst", list(report.worst)}};
  for (const char* member :
       {"version", "command", "seed", "count", "tolerance", "threshold", "candidates"}) {
    result[member] = plan.at(member);
  }
  return text_by_lines(result);
}

std::filesystem::path write_result(const ShardState& whole, const std::filesystem::path& folder) {
  std::filesystem::path file = folder / "campaign.json";
  write_file(file, campaign_json(whole), "--out");
  return file;
}

}  // namespace touchstone
