#include "reports/campaigns/merge.hpp"

#include <fmt/format.h>
#include <memory>

#include "cli/command.hpp"
#include "reference/invalid_input.hpp"
#include "reports/campaigns/shard.hpp"
#include "reports/terminal_table.hpp"

namespace touchstone {
namespace {

struct Options {
  std::vector<std::string> inputs;
  std::string out = "out";
  bool partial = false;
};

int run(const Options& options) {
  const ShardState whole = merge({options.inputs.begin(), options.inputs.end()}, options.partial);
  const ShardPlace place(options.out, whole.shard);
  place.begin(whole.plan, false);  // throws where there is a campaign
  write_shard(whole, place.file());
  const Report result = campaign_result(whole);
  const auto file = write_result(whole, options.out);
  const bool complete = result.completed.configurations == result.planned.configurations;
  fmt::print("{}\n{} configurations{}.\nResult: {}\n", terminal_table(result),
             result.configurations, complete ? "" : ", which is not all of the campaign",
             file.string());
  return 0;
}

}  // namespace

void add_merge(Program& program) {
  Command command = program.command("merge", "Put the parts of a campaign together");
  const auto options = std::make_shared<Options>();
  command.arguments("inputs", options->inputs, "Shard files, or folders that hold some")
      .value("PATH")
      .required();
  command.text("--out", options->out, "Folder for campaign.json and the merged shard file")
      .value("FOLDER");
  command.flag("--partial", options->partial, "Even if parts are missing");
  command.footer(
      "Examples:\n"
      "  touchstone merge run --out merged\n"
      "  touchstone merge node-*/shard-*.jsonl --out merged\n"
      "Parts of different campaigns, parts that overlap and damaged files are refused.");
  command.runs([options] { return run(*options); });
}

}  // namespace touchstone
