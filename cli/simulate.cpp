#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <functional>
#include <memory>
#include <optional>

#include <nlohmann/json.hpp>

#include "candidates/candidates.hpp"
#include "candidates/host/interruption.hpp"
#include "cli/command.hpp"
#include "cli/options.hpp"
#include "properties/files/disk.hpp"
#include "reference/invalid_input.hpp"
#include "reports/replay.hpp"
#include "reports/report_json.hpp"
#include "reports/terminal.hpp"
#include "simulation/engines/run_engines.hpp"
#include "simulation/experiment.hpp"
#include "simulation/run_experiments.hpp"
#include "simulation/scenes/choose.hpp"
#include "simulation/scenes/scene_file.hpp"
#include "simulation/scenes/trajectory.hpp"

namespace touchstone {
namespace {

const std::vector<double> default_steps = {1.0 / 60, 1.0 / 240, 1.0 / 960};

struct SimulateArguments {
  explicit SimulateArguments(Command& command)
      : candidates(command), workers(command), robot(command) {}
  CandidateOption candidates;
  WorkersOption workers;
  RobotOption robot;
  std::vector<std::string> names;
  std::vector<double> steps = default_steps;
  std::vector<std::string> engines;
  std::string out, record, povray;
  std::vector<Option> of_files, of_experiments;  // that have no meaning for the other
  RecordingOptions recording;
  std::uint64_t disturbance = 0;
  std::vector<std::string> contacts = {"reference"};
  double every = 0.04;
  bool json = false;

  /// A run of the scene as `choose` disturbs it, as seen in the scene as it is written: `run` makes
  /// it.
  Trajectory run_of(const Scene& scene,
                    const std::function<Trajectory(const DisturbedScene&)>& run) const {
    const DisturbedScene disturbed(scene, recording.seed, disturbance);
    return disturbance == 0 ? run(disturbed) : disturbed.turned_back(run(disturbed));
  }

  /// Those named. Throws InvalidInput.
  std::vector<const Experiment*> named_experiments() const {
    std::vector<const Experiment*> result;
    for (const auto& name : names) {
      if (name.find_first_of("./") != name.npos) {
        throw InvalidInput(
            "experiment", '"' + name + '"',
            "must be a name, as rolling; a file is one for touchstone choose, or for "
            "--record");
      }
      add_once(result, &find_experiment(name));
    }
    return result;
  }

  ExperimentOptions experiments() const {
    ExperimentOptions e;
    e.experiments = named_experiments();
    if (names.empty()) {
      for (const Experiment& each : all_experiments()) e.experiments.push_back(&each);
    }
    e.candidates = candidates.get();
    e.limits = candidates.limits();
    e.steps.clear();  // which are the report's
    for (const double step : steps) add_once(e.steps, step);
    e.workers = workers.get();
    return e;
  }

  EngineOptions in_engines() const {
    EngineOptions e;
    e.experiments = named_experiments();
    if (names.empty()) e.experiments = engine_experiments();
    for (const auto& engine : engines) add_once(e.engines, engine);
    if (steps != default_steps && steps.size() > 1) {
      throw InvalidInput("--step", fmt::format("{}", fmt::join(steps, ",")),
                         "must be one number with --engine");
    }
    if (steps.size() == 1) e.step = steps.front();
    e.workers = workers.get();
    return e;
  }

  /// The command that gives the same result in the engines again.
  std::string engines_command() const {
    std::string line = program_name() + " simulate";
    for (const auto& name : names) line += ' ' + name;
    line += fmt::format(" --engine {}", fmt::join(engines, ","));
    return steps.size() == 1 ? line + fmt::format(" --step {}", steps.front()) : line;
  }
};

/// Runs the scenes with exact contacts and writes what occurred near contact.
int record(const SimulateArguments& options) {
  if (options.names.empty()) {
    throw InvalidInput("--record", options.record,
                       "needs scene files, as simulation/scenes/conveyor.json");
  }
  check_file_writable(options.record, "--record");
  std::vector<SceneFile> files;
  for (const std::string& name : options.names) files.push_back(options.robot.scene(name));
  Processes processes(options.candidates.limits());
  CandidateModel exact(processes.of(*exact_first({}).front()));
  std::string lines;
  for (const SceneFile& file : files) {
    const Trajectory run = run_scene(file.scene, exact);
    const auto questions = sample_near_contact(file.scene, run, options.recording);
    lines += recording_lines(file.name, file.scene, run, questions);
    std::uint64_t near = 0;
    for (const RecordedQuestion& q : questions) near += q.weight;
    print(fmt::format("{}: {} of {} near contact\n", file.name, questions.size(),
                      counted(near, "configuration")));
  }
  write_file(options.record, lines, "--record");
  return 0;
}

/// Runs a scene and writes it for POV-Ray.
int write_frames(const SimulateArguments& options) {
  if (options.names.size() != 1) {
    throw InvalidInput("--povray", '"' + options.povray + '"',
                       "must be with one scene file, as simulation/scenes/thesis-knock.json");
  }
  const SceneFile file = options.robot.scene(options.names.front());
  const NamedContacts contacts = read_contacts(options.contacts, file.scene);
  const OutputFolder out(options.povray, "--povray");
  Processes processes(options.candidates.limits());
  const Trajectory run = options.run_of(file.scene, [&](const DisturbedScene& scene) {
    return run_with(scene, contacts, *exact_first({}).front(), processes);
  });
  const int frames = write_povray(file, run, options.every, options.povray);
  print(fmt::format("{}. To draw with Debian's povray:\n  cd {} && povray scene.ini\n",
                    counted(frames, "frame"), shell_quoted(options.povray)));
  return 0;
}

/// Is one of the names that of a file rather than of an experiment?
bool has_files(const SimulateArguments& options) {
  return std::ranges::any_of(options.names, [](const std::string& name) {
    return is_robot_file(name) || std::filesystem::path(name).extension() == ".json";
  });
}

/// Runs the scenes and prints where their bodies end.
int simulate_scenes(const SimulateArguments& options) {
  const std::vector<const Candidate*> candidates =
      options.candidates.is_given() ? options.candidates.get() : exact_first({});
  Processes processes(options.candidates.limits());
  for (const std::string& name : options.names) {
    const SceneFile file = options.robot.scene(name);
    for (const Candidate* candidate : candidates) {
      CandidateModel model(processes.of(*candidate), Unsupported::refused);
      const Trajectory run = options.run_of(
          file.scene, [&](const DisturbedScene& scene) { return run_scene(scene.scene, model); });
      const std::string which = options.disturbance == 0
                                    ? ""
                                    : fmt::format(", disturbance {} of seed {}",
                                                  options.disturbance, options.recording.seed);
      print(fmt::format("{}, {}{}\n{}", file.name, candidate->name, which,
                        motion_table(file.scene, run)));
    }
  }
  return 0;
}

int simulate_in_engines(const SimulateArguments& options) {
  const EngineOptions chosen = options.in_engines();
  std::optional<OutputFolder> out;
  if (!options.out.empty()) out.emplace(options.out);
  const Interruption interruption;
  const EngineResults results = run_engines(chosen);
  const nlohmann::json json = to_json(results);
  print(options.json ? json.dump() + '\n' : engines_table(results, standard_output()));
  if (interrupted()) return interrupted_exit_code();
  if (options.out.empty()) return 0;
  write_file(options.out + "/engines.json", json.dump(1) + '\n', "--out");
  write_file(options.out + "/engines.html",
             engines_page(results, options.engines_command(), engine_motions(results)), "--out");
  if (!options.json)
    print(fmt::format("\nPage: {0}/engines.html; data: {0}/engines.json\n", options.out));
  return 0;
}

/// Refuses options that would have no effect.
void refuse_others(const SimulateArguments& options) {
  const bool files = has_files(options) || !options.record.empty() || !options.povray.empty();
  for (const Option& option : files ? options.of_experiments : options.of_files) {
    if (!option.is_given()) continue;
    throw InvalidInput(option.name(), "given",
                       files ? "must be with experiments, not with scene files"
                             : "must be with scene files, robots or worlds");
  }
}

int run_simulate(const SimulateArguments& options) {
  refuse_others(options);
  if (!options.record.empty()) return record(options);
  if (!options.povray.empty()) return write_frames(options);
  if (!options.engines.empty()) return simulate_in_engines(options);
  if (has_files(options)) return simulate_scenes(options);
  const ExperimentOptions experiments = options.experiments();
  std::optional<OutputFolder> out;
  if (!options.out.empty()) out.emplace(options.out);
  const ExperimentResults results = run_experiments(experiments);
  const nlohmann::json json = to_json(results);
  print(options.json ? json.dump() + '\n' : experiments_table(results, standard_output()));
  if (options.out.empty()) return 0;
  write_file(options.out + "/experiments.json", json.dump(1) + '\n', "--out");
  return 0;
}

std::string experiment_list() {
  std::string text = "Experiments:\n";
  for (const Experiment* e : engine_experiments()) text += list_entry(e->name, 15, e->statement);
  const Experiment& tunnelling = find_experiment("tunnelling");
  return text + list_entry(tunnelling.name, 15, tunnelling.statement);
}

}  // namespace

void add_simulate(Program& program) {
  Command command = program.command("simulate", "Rigid-body experiments with an answer on paper");
  const auto options = std::make_shared<SimulateArguments>(command);
  command.arguments(
      "experiments", "EXPERIMENT", options->names,
      "Only these experiments; or scene files, robots and worlds (.json, .urdf, .sdf, MJCF)");
  const Option engine =
      command.list("--engine", "ENGINE", options->engines,
                   "Run in these engines' own worlds, with their contacts and with ours: bullet, "
                   "bullet-float, ode, mujoco (docs/motion.md)");
  const Option step = command.numbers(
      "--step", options->steps, {1e-5, 0.1},
      "Steps of time, seconds, separated by commas (default: 1/60, 1/240, 1/960; with "
      "--engine 1/240)");
  const Option out =
      command.text("--out", "FOLDER", options->out,
                   "Folder for experiments.json; with --engine for engines.json, engines.html");
  const Option json = command.flag("--json", options->json, "Print one JSON object");
  const Option record =
      command.text("--record", "FILE", options->record,
                   "File for configurations near contact that occur in scenes with exact contacts "
                   "(docs/scenes.md)");
  command.count("--count", options->recording.count, {1, 1000000},
                "Configurations of each scene and pair of shapes");
  const Option povray = command.text("--povray", "FOLDER", options->povray,
                                     "Folder for the motion in a scene as frames for POV-Ray: "
                                     "scene.ini, scene.pov and a file for each");
  command.number("--every", options->every, {1e-6, 1e6}, "Seconds between frames");
  command.list("--contacts", "CANDIDATE", options->contacts,
               "The candidate that contacts come from; or candidates of kinds of pairs, as in "
               "choose's commands, with exact contacts of all others");
  const Option disturbance =
      command.count("--disturbance", options->disturbance, {0, 5000},
                    "The scene under this one of choose's disturbances; 0: as it is written");
  command.count("--seed", options->recording.seed, all_counts,
                "Same seed, same disturbances; or with --record same configurations");
  options->of_experiments = {step, out, json};
  options->of_files = options->robot.all();
  options->of_files.push_back(disturbance);
  std::vector<std::string> of_scene = {"--time-limit", "--memory-limit"};
  for (const Option& option : options->robot.all()) of_scene.push_back(option.name());
  const auto with = [&](std::vector<std::string> names) {
    names.insert(names.end(), of_scene.begin(), of_scene.end());
    return names;
  };
  command.mode(engine, {}, {"--step", "--out", "--json", "--workers"});
  command.mode(record, {"--count", "--seed"}, of_scene);
  command.mode(povray, {"--every", "--contacts"}, with({"--disturbance", "--seed"}));
  command.mode(disturbance, {"--seed"},
               with({"--candidates", "--povray", "--every", "--contacts"}));
  command.footer(
      "Examples:\n"
      "  touchstone simulate rolling\n"
      "  touchstone simulate standing --candidates reference,bullet --step 0.004\n"
      "  touchstone simulate --out out\n"
      "  touchstone simulate small-log --engine bullet --out out\n"
      "  touchstone simulate simulation/scenes/rover.urdf --duration 1\n"
      "  touchstone simulate simulation/scenes/three-logs.json --disturbance 3\n"
      "  touchstone simulate simulation/scenes/thesis-knock.json --povray out/render\n"
      "  touchstone simulate simulation/scenes/conveyor.json --record recorded.jsonl\n" +
      experiment_list());
  command.runs([options] { return run_simulate(*options); });
}

}  // namespace touchstone
