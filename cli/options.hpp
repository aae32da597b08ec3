#pragma once

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "candidates/host/candidate_process.hpp"
#include "cli/command.hpp"
#include "properties/identity.hpp"
#include "reports/campaign.hpp"
#include "simulation/scenes/robot_file.hpp"

namespace touchstone {

// Options that mean the same in every subcommand. Each adds itself to the subcommand and is read
// after parsing.

struct CandidateOption {
  /// `has_default`: the command asks the default candidates where none are named, and has
  /// --all-candidates.
  explicit CandidateOption(Command& command, bool has_default = true);
  bool is_given() const { return asks_all_ || are_named(); }
  /// One by one.
  bool are_named() const { return option_.is_given(); }
  /// In the order given; the default ones where none are. Throws InvalidInput on an unknown name.
  std::vector<const Candidate*> get() const;
  const Limits& limits() const { return limits_; }
  const Option& option() const { return option_; }
  /// These options as text, to be repeated: every candidate's name, and limits other than the
  /// usual.
  std::string command_line() const { return command_line(get()); }
  /// Likewise, with the names of these candidates.
  std::string command_line(const std::vector<const Candidate*>& candidates) const;

 private:
  std::vector<std::string> names_;
  bool asks_all_ = false;
  Limits limits_;
  Option option_;
};

/// What --details of a report's commands does.
inline constexpr const char* details_help = "Print all tables and findings, not the first screen";

/// What is named several times counts once, in every list.
template <class T>
void add_once(std::vector<T>& list, const T& value) {
  if (std::find(list.begin(), list.end(), value) == list.end()) list.push_back(value);
}

/// The candidate of that name, or, where there is none, the first of the plug-in in that file,
/// which is added. Throws InvalidInput.
const Candidate& named_candidate(const std::string& name);

struct BarOption {
  explicit BarOption(Command& command);
  const Bar& get() const { return bar_; }
  std::string command_line() const;

 private:
  Bar bar_;
};

/// --pair, --class, --group, --count, --seed: which sampled configurations a command is about.
struct SampleOption {
  /// `count`: of each pair and pose class, by default, and at most.
  SampleOption(Command& command, std::uint64_t count, std::uint64_t max_count);
  /// Each once, in the order given; all of them by default. Throws InvalidInput on an unknown name.
  std::vector<Pair> pairs() const;
  /// As given; empty means all. Throws InvalidInput on a class that none of the pairs has.
  const std::vector<std::string>& classes() const;
  /// Empty means all. Throws InvalidInput on an unknown name.
  std::vector<Group> groups() const;
  /// All of this, without candidates.
  Campaign campaign() const;
  std::uint64_t count() const { return count_; }
  std::uint64_t seed() const { return seed_; }
  bool count_is_given() const { return count_option_.is_given(); }
  /// By --pair, --class or --group.
  bool is_narrowed() const { return !pairs_.empty() || has_some_classes(); }
  /// By --class or --group.
  bool has_some_classes() const { return !(classes_.empty() && groups_.empty()); }
  const Option& class_option() const { return class_option_; }
  const Option& group_option() const { return group_option_; }
  /// The same options as text, to be repeated: " --seed 1 --count 100 --pair cylinder-box".
  std::string command_line() const;

 private:
  std::vector<std::string> pairs_, classes_, groups_;
  std::uint64_t count_, seed_ = 1;
  Option pair_option_, class_option_, count_option_, group_option_;
};

/// --workers
struct WorkersOption {
  /// One a core by default, or as many as `usual` says, which `meaning` explains.
  explicit WorkersOption(Command& command);
  WorkersOption(Command& command, unsigned usual, const std::string& meaning);
  unsigned get() const { return static_cast<unsigned>(workers_); }

 private:
  std::uint64_t workers_;
};

/// How a robot or world is simulated: --drive, --duration, --fixed-base, --model-path.
struct RobotOption {
  explicit RobotOption(Command& command);
  /// Reads a robot or world; says on standard error what of it is not read.
  RobotFile robot(const std::string& file) const;
  /// A scene file as it is written, or the scene of a robot or world. Throws InvalidInput, also for
  /// one of these options with a scene file.
  SceneFile scene(const std::string& file) const;
  /// Likewise; wheels of a robot or world roll if --drive is not given, and these options then say
  /// so.
  SceneFile scene_with_rolling_wheels(const std::string& file);
  /// These options as text, to be repeated.
  std::string command_line() const;
  const std::vector<Option>& all() const { return options_; }
  /// Those that say how it moves.
  std::vector<Option> of_motion() const { return {options_.begin(), options_.end() - 1}; }

 private:
  RobotMotion motion() const;
  SceneFile scene_of(const RobotFile& robot, const std::string& file) const;

  std::vector<std::string> drives_, folders_;
  bool has_fixed_base_ = false;
  double seconds_;
  std::vector<Option> options_;  // --model-path last
};

/// What is scored, by whom, and how strictly.
struct CampaignOption {
  /// `count`: of each pair and pose class, by default, and at most.
  CampaignOption(Command& command, std::uint64_t count, std::uint64_t max_count);
  /// With one worker. Throws InvalidInput.
  Campaign get() const;
  std::string command_line() const;

  SampleOption sample;
  CandidateOption candidates;
  BarOption bar;
};

/// Throws InvalidInput (field `option`) if the file to be written is the one that is read.
void refuse_to_replace(const std::string& input, const std::string& output, const char* option);

}  // namespace touchstone
