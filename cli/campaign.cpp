#include <cstring>
#include <fmt/format.h>
#include <memory>
#include <thread>

#include "candidates/host/interruption.hpp"
#include "cli/command.hpp"
#include "cli/options.hpp"
#include "reference/invalid_input.hpp"
#include "reports/campaigns/shard.hpp"
#include "reports/replay.hpp"
#include "reports/terminal.hpp"

namespace touchstone {
namespace {

struct CampaignArguments {
  /// Ranks share a machine as mpirun says.
  explicit CampaignArguments(Command& command)
      : scored(command, 1000, Plan::max_count),
        workers(command, under_mpirun() ? 1 : std::max(1U, std::thread::hardware_concurrency()),
                "one a core or rank") {}
  CampaignOption scored;
  WorkersOption workers;
  std::vector<std::string> parts;  // to be merged
  std::string out = "out", shard_text;
  bool resume = false, partial = false, has_details = false;
  double interval = RunOptions{}.interval;

  Campaign campaign() const {
    Campaign c = scored.get();
    c.coverage = Coverage::triples;
    c.workers = workers.get();
    return c;
  }

  Shard shard() const {
    if (shard_text.empty()) return shard_of_rank();
    if (under_mpirun()) {
      throw InvalidInput("--shard", '"' + shard_text + '"',
                         "must not be given with mpirun, whose ranks are the shards");
    }
    return parse_shard(shard_text);
  }

  /// The command that gives the same result again, in one process.
  std::string command_line() const { return program_name() + " campaign" + scored.command_line(); }

  /// What goes on where this was stopped.
  std::string resuming() const {
    return command_line() + (shard_text.empty() ? "" : " --shard " + shard_text) +
           fmt::format(" --workers {} --out {} --resume", workers.get(), shell_quoted(out));
  }
};

void print_plan(const CampaignArguments& options, const ShardState& state) {
  const Plan& plan = state.plan;
  const Shard& shard = state.shard;
  const UnitSet all = shard.units(plan.cut), done = state.done;
  std::string text =
      fmt::format("{} × {} = {}, {}", counted(plan.cells.size(), "pose class"), plan.cut.count,
                  counted(plan.cells.size() * plan.cut.count, "configuration"),
                  counted(plan.candidates.size(), "candidate"));
  if (shard.of > 1) {
    text += fmt::format("; shard {}: {}", to_string(shard), configurations(plan.cut, all));
  }
  if (!done.empty()) text += fmt::format("; {} done before", configurations(plan.cut, done));
  complain(fmt::format("{}; workers: {}", text, options.workers.get()));
}

int run_campaign(const CampaignArguments& options) {
  const Shard shard = options.shard();
  const Campaign campaign = options.campaign();
  const ShardPlace place(options.out, shard);
  ShardState state = place.begin(make_plan(campaign, options.command_line()), options.resume);
  const bool speaks = !under_mpirun() || shard.number == 1;
  if (speaks) print_plan(options, state);

  const Interruption interruption;
  const bool done = run_shard(campaign, state, place.file(), {options.interval, speaks},
                              [] { return !interrupted(); });
  if (!done) {
    if (speaks) {
      complain(fmt::format("Stopped ({}); all that was done is in {}. To go on:\n  {}",
                           strsignal(interrupting_signal()), place.file().string(),
                           options.resuming()));
    }
    return interrupted_exit_code();
  }
  Merge merge;
  if (under_mpirun()) {
    if (!gather(state, merge)) return 0;
  } else if (shard.of > 1) {
    print(fmt::format(
        "Shard {} is done: {}\nWith the others: {} campaign --merge FOLDER... --out FOLDER\n",
        to_string(shard), place.file().string(), program_name()));
    return 0;
  } else {
    merge.add(state, place.file().string());
  }
  const ShardState whole = merge.whole(false);
  const Report result = campaign_result(whole);
  const auto file = write_result(whole, options.out);
  const Terminal terminal = standard_output();
  const auto text = options.has_details ? terminal_details : terminal_table;
  print(fmt::format("{}\n{}Result: {}\n", text(result, terminal),
                    terminal.folded(counted(result.configurations, "configuration") +
                                    ", truth certified to 1e-30 of the larger size."),
                    file.string()));
  return 0;
}

int run_merge(const CampaignArguments& options) {
  const ShardState whole = merge({options.parts.begin(), options.parts.end()}, options.partial);
  const ShardPlace place(options.out, whole.shard);
  place.begin(whole.plan, false);  // throws where there is a campaign
  write_shard(whole, place.file());
  const Report result = campaign_result(whole);
  const auto file = write_result(whole, options.out);
  const bool complete = result.completed.configurations == result.planned.configurations;
  const auto text = options.has_details ? terminal_details : terminal_table;
  print(fmt::format("{}\n{}{}.\nResult: {}\n", text(result, standard_output()),
                    counted(result.configurations, "configuration"),
                    complete ? "" : ", which is not all of the campaign", file.string()));
  return 0;
}

}  // namespace

void add_campaign(Program& program) {
  Command command =
      program.command("campaign", "Score any number of configurations, on many machines");
  const auto options = std::make_shared<CampaignArguments>(command);
  command.text("--out", "FOLDER", options->out, "Folder for the shard files and campaign.json");
  command.text("--shard", "TEXT", options->shard_text,
               "Only this part, as in 3/7; put together by --merge");
  command.flag("--resume", options->resume,
               "Go on where the folder's checkpoint ends, or begin where there is none");
  command.flag("--details", options->has_details, details_help);
  command.number("--checkpoint", options->interval, {1e-3, 1e9}, "Seconds between checkpoints")
      .group("");
  const Option merges =
      command.arguments("--merge", "PATH", options->parts,
                        "Put the parts of a campaign together: shard files, or folders with some");
  command.flag("--partial", options->partial, "Even if parts are missing");
  command.mode(merges, {"--partial"}, {"--out", "--details"});
  command.footer(
      "Examples:\n"
      "  touchstone campaign --candidates reference --count 1e6 --out run\n"
      "  touchstone campaign --candidates reference --count 1e6 --out run --resume\n"
      "  mpirun -n 64 touchstone campaign --count 1e6 --out run\n"
      "  touchstone campaign --count 1e6 --shard 3/7 --out run\n"
      "  touchstone campaign --merge run --out merged\n"
      "  touchstone campaign --merge node-*/shard-*.bin --out merged\n"
      "Parts of different campaigns, parts that overlap and damaged files are refused.\n"
      "Exit codes: 130, 143, 129 when stopped by Ctrl-C, SIGTERM, SIGHUP; what was\n"
      "done is saved.");
  command.runs([options, merges] {
    return merges.is_given() ? run_merge(*options) : run_campaign(*options);
  });
}

}  // namespace touchstone
