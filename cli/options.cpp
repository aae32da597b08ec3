#include "cli/options.hpp"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <thread>

#include "candidates/candidates.hpp"
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
  command
      .add_option("--time-limit", limits_.seconds,
                  "Processor time that a candidate may take for one configuration, seconds")
      ->capture_default_str();
  command
      .add_option("--memory-limit", limits_.mebibytes,
                  "What a candidate's memory may grow by, mebibytes")
      ->capture_default_str();
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

Limits CandidateOption::limits() const {
  const auto check = [](const char* field, double value) {
    if (!(std::isfinite(value) && value > 0)) {
      throw InvalidInput(field, fmt::format("{}", value), "must be positive and finite");
    }
  };
  check("--time-limit", limits_.seconds);
  check("--memory-limit", limits_.mebibytes);
  return limits_;
}

std::string CandidateOption::command_line() const {
  std::vector<std::string> names;
  for (const Candidate* c : get()) names.emplace_back(c->name);
  return fmt::format(" --candidates {} --time-limit {} --memory-limit {}", fmt::join(names, ","),
                     limits_.seconds, limits_.mebibytes);
}

const Candidate& named_candidate(const std::string& name) {
  if (!std::filesystem::is_regular_file(name)) return find_candidate(name);
  add_plugin(name);
  return *all_candidates().back();
}

BarOption::BarOption(CLI::App& command) {
  command
      .add_option("--tolerance", bar_.tolerance,
                  "Agreement in depth and normal regret, relative to the smaller shape's size")
      ->capture_default_str();
  command
      .add_option("--threshold", bar_.threshold, "Ask for contacts up to this far apart, metres")
      ->capture_default_str();
}

Bar BarOption::get() const {
  const auto check = [](const char* field, double value) {
    if (!(std::isfinite(value) && value >= 0)) {
      throw InvalidInput(field, fmt::format("{}", value), "must be finite and not negative");
    }
  };
  check("--tolerance", bar_.tolerance);
  check("--threshold", bar_.threshold);
  return bar_;
}

std::string BarOption::command_line() const {
  return fmt::format(" --tolerance {} --threshold {}", bar_.tolerance, bar_.threshold);
}

namespace {

/// Writes "1e6" as CLI11 reads a whole number, and leaves what is none to it to refuse.
std::string whole_number(std::string& text) {
  constexpr double most = 0x1p53;  // doubles know every whole number up to here
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const bool scientific = text.find_first_of("eE") != std::string::npos && *end == '\0';
  if (scientific && value >= 0 && value <= most && value == std::floor(value)) {
    text = fmt::format("{:.0f}", value);
  }
  return {};
}

}  // namespace

SampleOption::SampleOption(CLI::App& command, std::uint64_t count) : count_(count) {
  command.add_option("--pair", pairs_, "Only these pairs, as in cylinder-box")->delimiter(',');
  command.add_option("--class", classes_, "Only these pose classes")->delimiter(',');
  command
      .add_option("--count", count_,
                  "Configurations of each pair and pose class; 1e6 is understood too")
      ->transform(CLI::Validator(whole_number, ""))
      ->capture_default_str();
  command.add_option("--seed", seed_, "Same seed, same configurations")->capture_default_str();
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

std::uint64_t SampleOption::count() const {
  if (count_ == 0) throw InvalidInput("--count", "0", "must be at least 1");
  return count_;
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
  command.add_option("--workers", workers_, "Worker processes; they do not change the result")
      ->default_str(meaning);
}

unsigned WorkersOption::get() const {
  if (workers_ == 0) throw InvalidInput("--workers", "0", "must be at least 1");
  return workers_;
}

CampaignOption::CampaignOption(CLI::App& command, std::uint64_t count)
    : sample(command, count), candidates(command), bar(command) {}

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
