#include <fmt/format.h>
#include <memory>

#include "candidates/candidates.hpp"
#include "cli/command.hpp"
#include "properties/files/disk.hpp"
#include "simulation/scenes/scene_file.hpp"

namespace touchstone {
namespace {

struct Options {
  std::string scene, out = "out/render", contacts = "reference";
  double every = 0.04;
};

SceneFile read(const std::string& file) {
  return is_shapes_file(file) ? still_scene(read_shapes(file)) : read_scene(file);
}

int run(const Options& options) {
  const Candidate& candidate = find_candidate(options.contacts);
  const SceneFile file = read(options.scene);
  check_writable(options.out);
  CandidateProcess process(candidate, simulation_threshold);
  CandidateModel model(process);
  const int frames = write_povray(file, run_scene(file.scene, model), options.every, options.out);
  fmt::print("{} frames. To draw them with Debian's povray:\n  cd {} && povray scene.ini\n", frames,
             options.out);
  return 0;
}

}  // namespace

void add_render(Program& program) {
  Command command =
      program.command("render", "Run a scene and write it for POV-Ray, frame by frame");
  const auto options = std::make_shared<Options>();
  command.text("scene", options->scene, "A scene file, or a robot or world (.urdf, .sdf)")
      .value("FILE")
      .required();
  command.number("--every", options->every, {1e-6, 1e6}, "Seconds between frames");
  command.text("--contacts", options->contacts, "The candidate that contacts come from")
      .value("CANDIDATE");
  command.text("--out", options->out, "Folder for scene.pov, scene.ini and the frames")
      .value("FOLDER");
  command.footer(
      "Examples:\n"
      "  touchstone render simulation/scenes/thesis-knock.json\n"
      "  touchstone render simulation/scenes/log-pile.json --contacts capsule\n"
      "  touchstone render simulation/scenes/gripper.urdf");
  command.runs([options] { return run(*options); });
}

}  // namespace touchstone
