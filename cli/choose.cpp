#include "simulation/scenes/choose.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <memory>
#include <vector>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "cli/options.hpp"
#include "properties/files/disk.hpp"
#include "reference/invalid_input.hpp"
#include "reports/choice/choice.hpp"
#include "reports/replay.hpp"
#include "reports/terminal.hpp"
#include "simulation/scenes/engine_choice.hpp"
#include "simulation/scenes/exact_motion.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

constexpr int not_served = 1;

struct ChooseArguments {
  explicit ChooseArguments(Command& command)
      : candidates(command, false), workers(command), robot(command) {}
  CandidateOption candidates;
  WorkersOption workers;
  RobotOption robot;
  std::string scene, engine, out = "out";
  bool json = false;
  Trials trials;
  PairNeeds pairs;
  std::vector<Option> of_motions, of_samples;  // that say nothing of the other

  /// Are poses sampled, instead of a motion simulated?
  bool is_sampled() const {
    return std::ranges::any_of(of_samples, [](const Option& option) { return option.is_given(); });
  }
  std::vector<const Candidate*> contestants() const {
    return candidates.is_given() ? candidates.get() : swept_candidates();
  }
  std::string folder() const { return out + "/choose"; }
  /// The command that gives the same choice again.
  std::string command_line() const {
    return program_name() + " choose " + shell_quoted(scene) +
           candidates.command_line(contestants()) + robot.command_line();
  }
  /// The part of it that says how runs are repeated.
  std::string of_trials() const {
    return fmt::format(" --disturbances {} --seed {}", trials.disturbances, trials.seed);
  }
};

/// The scene, with needs from its runs with exact contacts if it is a robot's, in the engine's
/// world if one is named; none is made if that cannot do what the scene asks for.
SceneFile scene_of(ChooseArguments& options) {
  SceneFile file = options.robot.scene_with_rolling_wheels(options.scene);
  if (!is_robot_file(options.scene)) return file;
  if (!options.engine.empty()) {
    describe_engine(options.engine);  // which has to be there
    check_engine_scene(options.engine, file.scene);
  }
  const Trials trials = options.trials;
  const unsigned workers = options.workers.get();
  const ExactMotion exact =
      options.engine.empty()
          ? exact_motion(file.scene, trials, workers, options.candidates.limits(), file.name)
          : exact_motion_in(options.engine, file.scene, trials, workers, file.name);
  add_robot_needs(file, exact);
  if (!exact.has_contacts() || file.needs.empty()) {
    throw InvalidInput("scene", '"' + options.scene + '"',
                       "must have a cylinder that moves and touches something: see --drive; "
                       "--depth scores poses at random instead");
  }
  return file;
}

/// Prints the choice and writes choose.json, with a page of what `motion` gives, if anything. That
/// may write more.
void deliver(const ChooseArguments& options, const json& choice, const std::string& text,
             const std::function<json()>& motion) {
  // The names of files and folders may be of any bytes; JSON is UTF-8.
  const auto dumped = [&](int indent) {
    return choice.dump(indent, ' ', false, json::error_handler_t::replace) + '\n';
  };
  bool has_page = false;
  const auto write = [&] {
    const json shown = motion();
    has_page = !shown.is_null();
    remove_older(options.out, "choose.", "html");
    write_file(options.out + "/choose.json", dumped(1), "--out");
    if (has_page) write_file(options.out + "/choose.html", choice_page(choice, shown), "--out");
  };
  write_then_print(write, options.json ? dumped(-1) : text);
  if (options.json) return;
  print(
      fmt::format("\n{1}{0}/choose.json\n", options.out,
                  has_page ? fmt::format("Page: {}/choose.html; data: ", options.out) : "Data: "));
}

int choose_scene(ChooseArguments& options) {
  const SceneFile file = scene_of(options);
  const std::string command = options.command_line() + options.of_trials(),
                    folder = options.folder();
  const Limits limits = options.candidates.limits();
  Choice choice =
      choose(file, {options.contestants(), options.workers.get(), limits, options.trials});
  choice.arguments = shell_quoted(options.scene) + options.robot.command_line();
  deliver(options, choice_json(choice, command, folder),
          choice_text(choice, folder, standard_output().columns), [&] {
            write_evidence(choice, folder);
            return choice_motion(choice, limits);
          });
  return choice.impossible ? not_served : 0;
}

int choose_for_engine(ChooseArguments& options) {
  const SceneFile file = scene_of(options);
  const std::string command =
      fmt::format("{} choose {}{} --engine {}{}", program_name(), shell_quoted(options.scene),
                  options.robot.command_line(), options.engine, options.of_trials());
  if (const std::string hulls = hulls_text(options.engine, file.scene); !hulls.empty()) {
    complain("warning: " + hulls);
  }
  const EngineChoice choice =
      choose_in_engine(file, options.engine, {options.workers.get(), options.trials});
  deliver(options, engine_choice_json(choice, command),
          engine_choice_text(choice, standard_output().columns),
          [&] { return choice_motion(choice); });
  return choice.answer ? 0 : not_served;
}

int choose_pairs(const ChooseArguments& options) {
  PairNeeds needs = options.pairs;
  needs.seed = options.trials.seed;
  const std::string command =
      options.command_line() + fmt::format(" --depth {} --angle {} --count {} --seed {}",
                                           needs.depth, needs.angle, needs.count, needs.seed);
  const RobotFile file = options.robot.robot(options.scene);
  const PairsChoice choice =
      choose_for_pairs(file, needs, options.contestants(), options.candidates.limits());
  const std::string folder = options.folder();
  deliver(options, pairs_json(choice, command, folder),
          pairs_text(choice, folder, standard_output().columns), [&] {
            write_evidence(choice, folder);
            return json();
          });
  return choice.all_served() ? 0 : not_served;
}

int run_choose(ChooseArguments& options) {
  const bool is_robot = is_robot_file(options.scene);
  for (const Option& option : is_robot ? options.of_motions : options.of_samples) {
    if (!option.is_given() || (is_robot && !options.is_sampled())) continue;
    throw InvalidInput(option.name(), "given with \"" + options.scene + '"',
                       is_robot ? "must be left out: sampled poses have no motion"
                                : "must be left out: a scene's needs stand in its file");
  }
  const OutputFolder out(options.out);
  if (options.is_sampled()) return choose_pairs(options);
  return options.engine.empty() ? choose_scene(options) : choose_for_engine(options);
}

}  // namespace

void add_choose(Program& program) {
  Command command = program.command("choose", "The cheapest contact models that a scene needs");
  const auto options = std::make_shared<ChooseArguments>(command);
  command
      .text("scene", "FILE", options->scene,
            "A scene file (docs/scenes.md), or a robot or world (.urdf, .sdf, MJCF)")
      .required();
  command.text("--out", "FOLDER", options->out, "Folder for choose.json and choose.html");
  command.flag("--json", options->json, "Print choose.json instead of text");
  command.count("--seed", options->trials.seed, all_counts,
                "Same seed, same disturbances or poses");
  options->of_motions = {
      command.count("--disturbances", options->trials.disturbances, {0, 1000},
                    "Runs of a scene beside the one as it is written; needs must hold in all"),
      command
          .text("--engine", "ENGINE", options->engine,
                "The best setting of this engine's own world instead: bullet, bullet-float, ode, "
                "mujoco")
          .excludes(options->candidates.option())};
  for (const Option& option : options->robot.of_motion()) options->of_motions.push_back(option);
  const char* sampled = "Of a robot or world, at random poses";
  PairNeeds& pairs = options->pairs;
  options->of_samples = {
      command.number("--depth", pairs.depth, positive_numbers, "Largest depth error, metres")
          .group(sampled),
      command.number("--angle", pairs.angle, positive_numbers, "Largest error of a normal, degrees")
          .group(sampled),
      command.count("--count", pairs.count, {1, 1000000}, "Sampled poses of each pair of shapes")
          .group(sampled)};
  command.footer(
      "Examples:\n"
      "  touchstone choose simulation/scenes/log-pile.json\n"
      "  touchstone choose simulation/scenes/conveyor.json --candidates spheres:1..16\n"
      "  touchstone choose simulation/scenes/rover.urdf\n"
      "  touchstone choose simulation/scenes/gripper.urdf --drive left_finger_joint=1\n"
      "  touchstone choose simulation/scenes/log-pile.json --engine bullet\n"
      "  touchstone choose simulation/scenes/gripper.urdf --depth 0.002 --angle 10\n"
      "Exit code 1: not even exact contacts meet the needs.");
  command.runs([options] { return run_choose(*options); });
}

}  // namespace touchstone
