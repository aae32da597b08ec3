#include "reports/campaigns/merge.hpp"

#include <fmt/format.h>

#include "properties/files/read_file.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

/// "cylinder-box/rim-face, configurations 512 to 1023".
std::string describe(const PlanView& view, std::uint64_t number) {
  const Unit unit = view.cut.unit(number);
  return fmt::format("{}/{}, configurations {} to {}", pair_name(view.cells[unit.cell].pair),
                     view.cells[unit.cell].pose_class, unit.first, unit.last - 1);
}

}  // namespace

void Merge::add(const Progressed& part, const std::string& file) {
  if (sum_.empty()) {
    sum_.emplace_back(part.plan, Shard{});
  } else {
    require_same_plan(sum_.front().plan, part.plan, file);
  }
  for (const Part& earlier : parts_) {
    const UnitSet both = earlier.units & part.done;
    if (both.empty()) continue;
    throw InvalidInput('"' + file + '"', "no separate part",
                       fmt::format("it and \"{}\" both hold {}", earlier.file,
                                   describe(part.view, both.begin()->lower())));
  }
  sum_.front().add(part.done, part.tallies);
  parts_.push_back({file, part.done});
}

Progressed Merge::whole(bool may_be_partial) const {
  if (sum_.empty()) throw InvalidInput("input", "empty", "must hold shard files of a campaign");
  const Progressed& sum = sum_.front();
  const UnitSet missing = Shard{}.units(sum.view.cut) - sum.done;
  if (!missing.empty() && !may_be_partial) {
    throw InvalidInput(
        "input", "incomplete",
        fmt::format("{} of {} configurations are missing, the first of them {}; give all parts, "
                    "finish them with --resume, or take what there is with --partial",
                    configurations(sum.view.cut, missing), sum.view.cut.cells * sum.view.cut.count,
                    describe(sum.view, missing.begin()->lower())));
  }
  return sum;
}

Progressed merge(const std::vector<std::filesystem::path>& inputs, bool may_be_partial) {
  Merge merge;
  const auto add = [&](const std::filesystem::path& file) {
    merge.add(progressed_from_text(read_file(file, "input"), file.string()), file.string());
  };
  for (const auto& input : inputs) {
    if (!is_folder(input)) {
      add(input);
      continue;
    }
    const auto files = shard_files(input);
    if (files.empty()) {
      throw InvalidInput("input", '"' + input.string() + '"', "must hold shard files");
    }
    for (const auto& file : files) add(file);
  }
  return merge.whole(may_be_partial);
}

}  // namespace touchstone
