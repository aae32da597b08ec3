#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "properties/files/configuration_json.hpp"
#include "reports/choice/choice.hpp"
#include "reports/pages/page.hpp"

namespace touchstone {

namespace {

using nlohmann::json;

/// RFC 4648.
std::string base64(const std::string& bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      three = three << 8 | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k > bytes.size() ? '=' : digits[three >> (18 - 6 * k) & 63U];
    }
  }
  return text;
}

/// Poses of the moving bodies in every `every`-th frame: position and orientation (w, x, y, z) as
/// floats, in base64.
std::string poses(const Scene& scene, const Trajectory& run, std::size_t every) {
  std::string bytes;
  const auto append = [&](double value) {
    const auto single = static_cast<float>(value);
    char raw[sizeof single];
    std::memcpy(raw, &single, sizeof single);
    bytes.append(raw, sizeof raw);
  };
  for (std::size_t i = 0; i < run.frames.size(); i += every) {
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
      if (scene.bodies[b].fixed) continue;
      const Pose& pose = run.frames[i][b].pose;
      const Eigen::Quaterniond q = pose.unit_orientation();
      for (const double x : {pose.position().x(), pose.position().y(), pose.position().z(), q.w(),
                             q.x(), q.y(), q.z()}) {
        append(x);
      }
    }
  }
  return base64(bytes);
}

/// Indices of the runs to show beside the exact one: the answer, some with the next cheaper model
/// of a kind, and well-known models for all pairs.
std::vector<std::size_t> worth_showing(const Choice& choice) {
  std::vector<std::size_t> result;
  if (choice.answer != 0) result.push_back(choice.answer);
  for (const auto& cheaper : choice.cheaper) {
    if (cheaper && result.size() < 4) result.push_back(*cheaper);
  }
  for (std::size_t i = 0; i < choice.runs.size(); ++i) {
    const std::string& name = choice.runs[i].name;
    if (name == "capsule" || name == "spheres:8" || name == "prism:16") result.push_back(i);
  }
  return result;
}

std::string note(const Choice& choice, std::size_t index) {
  const SceneRun& run = choice.runs[index];
  if (run.holds()) return "All needs hold.";
  const int broken = run.first_broken();
  return fmt::format("Breaks at {:.2f} s: {}.", run.verdicts[broken].time,
                     choice.file.needs[broken]->text(choice.file.scene));
}

/// The runs that the page animates, and the bodies and camera that they share.
json motion_json(const Choice& choice, const Limits& limits) {
  const SceneFile& file = choice.file;
  const Scene& scene = file.scene;
  json bodies = json::array();
  for (const Body& b : scene.bodies) {
    const auto& q = b.pose.orientation();
    bodies.push_back({{"name", b.name},
                      {"shape", to_json(b.shape)},
                      {"fixed", b.fixed},
                      {"pose",
                       {{"position", to_json(b.pose.position())},
                        {"orientation", {q.w(), q.x(), q.y(), q.z()}}}}});
  }
  constexpr double frames_per_second = 60;
  const auto every = std::max<std::size_t>(
      1, static_cast<std::size_t>(1 / (frames_per_second * scene.step) + 0.5));
  json runs = json::array();
  runs.push_back({{"name", "exact"},
                  {"note", "The exact cylinder for all pairs."},
                  {"poses", poses(scene, choice.exact_run, every)}});
  Processes processes(limits);
  for (const std::size_t i : worth_showing(choice)) {
    const Trajectory run =
        run_with(scene, choice.kinds, choice.runs[i].models, *choice.candidates[0], processes);
    runs.push_back({{"name", i == choice.answer ? "the answer" : choice.runs[i].name},
                    {"note", note(choice, i)},
                    {"poses", poses(scene, run, every)}});
  }
  return {
      {"bodies", bodies},
      {"interval", static_cast<double>(every) * scene.step},
      {"duration", scene.duration},
      {"camera",
       {{"position", to_json(file.camera.position)}, {"look_at", to_json(file.camera.look_at)}}},
      {"runs", runs}};
}

}  // namespace

std::string choice_page(const json& choice) { return render_page(Page::choice, choice); }

std::string choice_page(const Choice& choice, const std::string& command, const std::string& folder,
                        const Limits& limits) {
  json data = json::parse(choice_json(choice, command, folder));
  data["motion"] = motion_json(choice, limits);
  return choice_page(data);
}

}  // namespace touchstone
