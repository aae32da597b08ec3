#include "cli/options.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <thread>

#include "candidates/candidates.hpp"
#include "properties/files/read_file.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {

void add_plugin_option(CLI::App& program) {
  program
      .add_option_function<std::vector<std::string>>(
          "--candidate",
          [](const std::vector<std::string>& files) {
            for (const auto& file : files) add_plugin(file);
          },
          "A plug-in with candidates of your own; may be repeated")
      ->type_name("FILE")
      ->allow_extra_args(false);
}

CandidateOption::CandidateOption(CLI::App& command) {
  command
      .add_option("--candidates", names_,
                  "Only these, separated by commas (default: all); families by several numbers, as "
                  "in prism:8,16,32 or spheres:1..64")
      ->delimiter(',');
  constexpr NumberRange seconds{1e-3, 1e6}, mebibytes{1, 1e9};
  add_number(command, "--time-limit", limits_.seconds, seconds,
             "Processor time that a candidate may take for one configuration, seconds");
  add_number(command, "--memory-limit", limits_.mebibytes, mebibytes,
             "What a candidate's memory may grow by, mebibytes");
}

std::vector<const Candidate*> CandidateOption::get() const {
  auto candidates = names_.empty() ? all_candidates() : find_candidates(names_);
  if (candidates.empty()) {
    throw InvalidInput("--candidates", "empty",
                       "no plug-ins are where the program looks for them; touchstone candidates "
                       "says why");
  }
  return candidates;
}

std::string CandidateOption::command_line() const {
  std::vector<std::string> names;
  for (const Candidate* c : get()) names.emplace_back(c->name);
  return fmt::format(" --candidates {} --time-limit {} --memory-limit {}", fmt::join(names, ","),
                     limits_.seconds, limits_.mebibytes);
}

const Candidate& named_candidate(const std::string& name) {
  if (!is_file(name)) return find_candidate(name);
  add_plugin(name);
  return *all_candidates().back();
}

BarOption::BarOption(CLI::App& command) {
  constexpr NumberRange not_negative{0, 1e30};
  add_number(command, "--tolerance", bar_.tolerance, not_negative,
             "Agreement in depth and normal regret, relative to the smaller shape's size");
  add_number(command, "--threshold", bar_.threshold, not_negative,
             "Ask for contacts up to this far apart, metres");
}

std::string BarOption::command_line() const {
  return fmt::format(" --tolerance {} --threshold {}", bar_.tolerance, bar_.threshold);
}

SampleOption::SampleOption(CLI::App& command, std::uint64_t count, std::uint64_t max_count)
    : count_(count) {
  command.add_option("--pair", pairs_, "Only these pairs, as in cylinder-box")->delimiter(',');
  command.add_option("--class", classes_, "Only these pose classes")->delimiter(',');
  add_count(command, "--count", count_, {1, max_count},
            "Configurations of each pair and pose class; 1e6 is understood too");
  add_count(command, "--seed", seed_, all_counts, "Same seed, same configurations");
}

std::vector<Pair> SampleOption::pairs() const {
  if (pairs_.empty()) return {std::begin(all_pairs), std::end(all_pairs)};
  std::vector<Pair> result;
  for (const auto& name : pairs_) {
    try {
      result.push_back(parse_pair(name));
    } catch (const InvalidInput& e) {
      throw InvalidInput("--pair", e.value(), e.remedy());
    }
  }
  return result;
}

const std::vector<std::string>& SampleOption::classes() const {
  check_pose_classes(pairs(), classes_);
  return classes_;
}

std::string SampleOption::command_line() const {
  std::string line = fmt::format(" --seed {} --count {}", seed_, count_);
  if (!pairs_.empty()) line += fmt::format(" --pair {}", fmt::join(pairs_, ","));
  if (!classes_.empty()) line += fmt::format(" --class {}", fmt::join(classes_, ","));
  return line;
}

WorkersOption::WorkersOption(CLI::App& command)
    : WorkersOption(command, std::max(1U, std::thread::hardware_concurrency()), "one a core") {}

WorkersOption::WorkersOption(CLI::App& command, unsigned usual, const std::string& meaning)
    : workers_(usual) {
  const std::uint64_t max = std::max(1024U, usual);  // each is a process with candidates of its own
  add_count(command, "--workers", workers_, {1, max},
            "Worker processes; they do not change the result")
      ->default_str(meaning);
}

CampaignOption::CampaignOption(CLI::App& command, std::uint64_t count, std::uint64_t max_count)
    : sample(command, count, max_count), candidates(command), bar(command) {}

Campaign CampaignOption::get() const {
  Campaign c;
  c.pairs = sample.pairs();
  c.classes = sample.classes();
  c.candidates = candidates.get();
  c.count = sample.count();
  c.seed = sample.seed();
  c.bar = bar.get();
  c.limits = candidates.limits();
  return c;
}

std::string CampaignOption::command_line() const {
  return sample.command_line() + candidates.command_line() + bar.command_line();
}

}  // namespace touchstone
