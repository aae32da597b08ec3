#include "cli/options.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <set>
#include <system_error>
#include <thread>

#include "candidates/candidates.hpp"
#include "properties/files/disk.hpp"
#include "reference/invalid_input.hpp"
#include "reports/replay.hpp"

namespace touchstone {

CandidateOption::CandidateOption(Command& command, bool has_default)
    : option_(command.list("--candidates", "CANDIDATE", names_,
                           fmt::format("Only these, separated by commas (default: {}); families by "
                                       "several numbers, as in prism:8,16,32 or spheres:1..64",
                                       has_default ? "all but variants" : "all"))) {
  if (has_default) {
    command.flag("--all-candidates", asks_all_, "All, with the variants of engines and models")
        .excludes(option_);
  }
  constexpr NumberRange seconds{1e-3, 1e6}, mebibytes{1, 1e9};
  command.number("--time-limit", limits_.seconds, seconds,
                 "Processor time that a candidate may take for one configuration, seconds");
  command
      .number("--memory-limit", limits_.mebibytes, mebibytes,
              "What a candidate's memory may grow by, mebibytes")
      .group("");
}

std::vector<const Candidate*> CandidateOption::get() const {
  auto candidates = asks_all_        ? all_candidates()
                    : names_.empty() ? default_candidates()
                                     : find_candidates(names_);
  if (candidates.empty()) {
    throw InvalidInput("--candidates", "empty",
                       "no plug-ins are where the program looks for them; touchstone list "
                       "candidates says why");
  }
  return candidates;
}

std::string CandidateOption::command_line(const std::vector<const Candidate*>& candidates) const {
  std::vector<std::string> names;
  for (const Candidate* c : candidates) names.emplace_back(c->name);
  std::string line = fmt::format(" --candidates {}", fmt::join(names, ","));
  const Limits usual;
  if (limits_.seconds != usual.seconds) line += fmt::format(" --time-limit {}", limits_.seconds);
  if (limits_.mebibytes != usual.mebibytes) {
    line += fmt::format(" --memory-limit {}", limits_.mebibytes);
  }
  return line;
}

namespace {

const Candidate& first_of_file(const std::string& file) {
  const std::size_t known = all_candidates().size();
  try {
    add_file(file);
  } catch (const InvalidInput& e) {
    throw InvalidInput("--candidate", e.value(), e.remedy());
  }
  return *all_candidates()[known];
}

}  // namespace

const Candidate& named_candidate(const std::string& name) {
  try {
    return find_candidate(name);
  } catch (const InvalidInput& e) {
    if (is_file(name)) return first_of_file(name);
    if (name.ends_with(".so") || name.find('/') != std::string::npos) {
      throw InvalidInput(
          "--candidate", '"' + name + '"',
          "must be a file that is there, or a name that touchstone list candidates shows");
    }
    if (name.find(',') != std::string::npos) {
      throw InvalidInput("--candidate", '"' + name + '"', "must be one name, not a list");
    }
    throw InvalidInput("--candidate", e.value(), e.remedy());
  }
}

BarOption::BarOption(Command& command) {
  constexpr NumberRange not_negative{0, 1e30};
  command.number("--tolerance", bar_.tolerance, not_negative,
                 "Agreement in depth and normal regret, relative to the smaller shape's size");
  command.number("--threshold", bar_.threshold, not_negative,
                 "Ask for contacts up to this far apart, metres");
}

std::string BarOption::command_line() const {
  return fmt::format(" --tolerance {} --threshold {}", bar_.tolerance, bar_.threshold);
}

SampleOption::SampleOption(Command& command, std::uint64_t count, std::uint64_t max_count)
    : count_(count),
      pair_option_(command.list("--pair", "PAIR", pairs_, "Only these pairs, as in cylinder-box")),
      class_option_(command.list("--class", "CLASS", classes_,
                                 "Only these pose classes; see touchstone list classes")),
      count_option_(
          command.count("--count", count_, {1, max_count},
                        "Configurations of each pair and pose class; 1e6 is understood too")),
      group_option_(command.list("--group", "GROUP", groups_,
                                 "Only everyday, degenerate, extreme or recorded pose classes")) {
  command.count("--seed", seed_, all_counts, "Same seed, same configurations");
}

std::vector<Pair> SampleOption::pairs() const {
  if (pairs_.empty()) return {std::begin(all_pairs), std::end(all_pairs)};
  std::vector<Pair> result;
  for (const auto& name : pairs_) add_once(result, parse_pair(name, "--pair"));
  return result;
}

const std::vector<std::string>& SampleOption::classes() const {
  check_pose_classes(pairs(), classes_);
  return classes_;
}

std::vector<Group> SampleOption::groups() const {
  std::vector<Group> result;
  for (const auto& name : groups_) result.push_back(parse_group(name));
  check_groups(pairs(), {classes(), result});
  return result;
}

Campaign SampleOption::campaign() const {
  Campaign c;
  c.pairs = pairs();
  c.classes = classes();
  c.groups = groups();
  c.count = count_;
  c.seed = seed_;
  return c;
}

std::string SampleOption::command_line() const {
  std::string line = fmt::format(" --seed {} --count {}", seed_, count_);
  if (!pairs_.empty()) line += fmt::format(" --pair {}", fmt::join(pairs_, ","));
  if (!classes_.empty()) line += fmt::format(" --class {}", fmt::join(classes_, ","));
  if (!groups_.empty()) line += fmt::format(" --group {}", fmt::join(groups_, ","));
  return line;
}

WorkersOption::WorkersOption(Command& command)
    : WorkersOption(command, std::max(1U, std::thread::hardware_concurrency()), "one a core") {}

WorkersOption::WorkersOption(Command& command, unsigned usual, const std::string& meaning)
    : workers_(usual) {
  const std::uint64_t max = std::max(1024U, usual);  // each is a process with candidates of its own
  command.count("--workers", workers_, {1, max}, "Worker processes; they do not change the result")
      .default_text(meaning);
}

RobotOption::RobotOption(Command& command) : seconds_(RobotMotion().duration) {
  const char* robots = "Of a robot or world";
  constexpr NumberRange durations{1e-3, 1000};
  options_ = {
      command
          .list(
              "--drive", "JOINT=RATE", drives_,
              "Turn or move joints at these rates, rad/s or m/s, as in left_wheel=5,right_wheel=5; "
              "a joint with =loose has no motor, all others hold")
          .group(robots),
      command.number("--duration", seconds_, durations, "Simulated time, seconds").group(robots),
      command.flag("--fixed-base", has_fixed_base_, "Hold the root link where it is").group(robots),
      command
          .list("--model-path", "FOLDER", folders_,
                "Folders to look for meshes and included models in, before those of SDF_PATH, "
                "GZ_SIM_RESOURCE_PATH, ROS_PACKAGE_PATH and the file's own")
          .group(robots)};
}

RobotMotion RobotOption::motion() const {
  RobotMotion motion;
  motion.duration = seconds_;
  motion.has_fixed_base = has_fixed_base_;
  std::set<std::string> driven;
  for (const std::string& drive : drives_) {
    const std::size_t equals = drive.rfind('=');
    if (equals == drive.npos || equals == 0) {
      throw InvalidInput("--drive", '"' + drive + '"',
                         "must be a joint and its rate, as in left_wheel=5");
    }
    const std::string joint = drive.substr(0, equals), rate = drive.substr(equals + 1);
    constexpr double max_rate = 1e6;
    if (!driven.insert(joint).second) {
      throw InvalidInput("--drive", '"' + joint + '"', "must be given one rate, not several");
    }
    if (rate == "loose") {
      motion.loose.push_back(joint);
    } else {
      motion.rates.emplace_back(joint, read_number("--drive", rate, {-max_rate, max_rate}));
    }
  }
  return motion;
}

RobotFile RobotOption::robot(const std::string& file) const {
  std::vector<std::filesystem::path> folders;
  for (const std::string& folder : folders_) {
    if (!is_folder(folder))
      throw InvalidInput("--model-path", '"' + folder + '"', "must be a folder");
    folders.emplace_back(folder);
  }
  RobotFile robot = read_robot(file, folders);
  if (const std::string left = left_out_text(robot); !left.empty()) {
    complain(fmt::format("warning: {}: {}", file, left));
  }
  for (const std::string& ignored : robot.ignored) {
    complain(fmt::format("warning: {}: {}", file, ignored));
  }
  return robot;
}

SceneFile RobotOption::scene_of(const RobotFile& robot, const std::string& file) const {
  try {
    return robot_scene(robot, motion());
  } catch (const InvalidInput& e) {
    const bool is_in_file = e.field() != "scene" && !e.field().starts_with("--");
    throw InvalidInput((is_in_file ? file + ": " : "") + e.field(), e.value(), e.remedy());
  }
}

SceneFile RobotOption::scene_with_rolling_wheels(const std::string& file) {
  if (!is_robot_file(file) || !drives_.empty()) return scene(file);
  const RobotFile read = robot(file);
  scene_of(read, file);  // sizes that are refused give no rate
  for (const auto& [joint, rate] : rolling_rates(read)) {
    drives_.push_back(fmt::format("{}={:.3g}", joint, rate));
  }
  return scene_of(read, file);
}

SceneFile RobotOption::scene(const std::string& file) const {
  if (is_robot_file(file)) return scene_of(robot(file), file);
  for (const Option& option : options_) {
    if (!option.is_given()) continue;
    throw InvalidInput("scene", '"' + file + '"',
                       "must be a robot or world (.urdf, .sdf, .xml) with --drive, --duration, "
                       "--fixed-base and --model-path");
  }
  return read_scene(file);
}

std::string RobotOption::command_line() const {
  std::string line;
  if (!drives_.empty())
    line += " --drive " + shell_quoted(fmt::format("{}", fmt::join(drives_, ",")));
  if (options_[1].is_given()) line += fmt::format(" --duration {}", seconds_);
  if (has_fixed_base_) line += " --fixed-base";
  if (!folders_.empty()) {
    line += " --model-path " + shell_quoted(fmt::format("{}", fmt::join(folders_, ",")));
  }
  return line;
}

CampaignOption::CampaignOption(Command& command, std::uint64_t count, std::uint64_t max_count)
    : sample(command, count, max_count), candidates(command), bar(command) {}

Campaign CampaignOption::get() const {
  Campaign c = sample.campaign();
  c.candidates = candidates.get();
  c.bar = bar.get();
  c.limits = candidates.limits();
  return c;
}

std::string CampaignOption::command_line() const {
  return sample.command_line() + candidates.command_line() + bar.command_line();
}

void refuse_to_replace(const std::string& input, const std::string& output, const char* option) {
  std::error_code error;  // one that does not exist is another one
  if (output.empty() || !std::filesystem::equivalent(input, output, error)) return;
  throw InvalidInput(option, '"' + output + '"', "must be another file than the input");
}

}  // namespace touchstone
