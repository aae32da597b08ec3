#include "simulation/scenes/spread.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

#include "reference/invalid_input.hpp"

namespace touchstone {

namespace {

/// The value of a relative need where all that a body is off by is what two disturbances carry it.
double value_of_carrying(const Need& need, const Scene& scene, const Trajectory& exact) {
  const int body = need.bodies[0];
  const Pose &from = exact.frames.front()[body].pose, &to = exact.frames.back()[body].pose;
  const Vec3 way = to.position() - from.position();
  const Vec3 along = way.norm() > 0 ? Vec3(way.normalized()) : scene.gravity.unitOrthogonal();
  const auto [metres, radians] = carrying(scene, body, way.norm());
  Trajectory carried = exact;
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(radians, to.axis().unitOrthogonal()));
  carried.frames.back()[body].pose =
      Pose(to.position() + metres * along, turn * to.unit_orientation());
  return need.judge({scene, carried, exact}).value;
}

}  // namespace

double spread(const Need& need, const Scene& scene, const std::vector<Trajectory>& exact_runs) {
  double largest = 0;
  for (const Trajectory& run : exact_runs) {
    for (const Trajectory& other : exact_runs) {
      if (&run != &other) largest = std::max(largest, need.judge({scene, run, other}).value);
    }
  }
  return largest;
}

Straying spread(const Straying& strayed, const Scene& scene,
                const std::vector<Trajectory>& exact_runs) {
  const auto of_body = [&](const std::string& name, auto make_need) {
    const auto at = std::ranges::find(scene.bodies, name, &Body::name);
    if (at == scene.bodies.end()) return 0.0;
    return spread(*make_need(static_cast<int>(at - scene.bodies.begin()), 0), scene, exact_runs);
  };
  return {0, of_body(strayed.body, ends_near_need), strayed.body,
          of_body(strayed.tilted_body, ends_tilted_need), strayed.tilted_body};
}

Spreads take_undecidable(SceneFile& file, const std::vector<Trajectory>& exact_runs) {
  Spreads result;
  for (auto& need : std::exchange(file.needs, {})) {
    std::optional<double> apart;
    if (need->is_relative()) {
      apart = spread(*need, file.scene, exact_runs);
      const double limit = need->judge({file.scene, exact_runs[0], exact_runs[0]}).limit;
      const bool is_decided =
          *apart <= limit || *apart <= value_of_carrying(*need, file.scene, exact_runs[0]);
      const auto wider = is_decided ? need : need->allowing(*apart);
      if (!wider) {
        result.undecidable.push_back({need->text(file.scene), need->unit, limit, *apart});
        continue;
      }
      need = wider;
    }
    result.of_needs.push_back(apart);
    file.needs.push_back(need);
  }
  if (file.needs.empty() && !result.undecidable.empty()) {
    const Undecidable& first = result.undecidable.front();
    throw InvalidInput(
        "needs", fmt::format("\"{}\"", first.text),
        fmt::format("must allow more than {:.2g}{}, by which exact runs differ that are hardly "
                    "disturbed, or stand beside a need of another kind: nothing else is left to "
                    "choose by",
                    first.spread, first.unit));
  }
  return result;
}

}  // namespace touchstone
