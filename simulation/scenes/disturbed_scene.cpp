#include "simulation/scenes/disturbed_scene.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <numeric>
#include <rapidcheck.h>
#include <utility>

#include "candidates/host/progress.hpp"
#include "candidates/host/worker_processes.hpp"
#include "properties/draw.hpp"
#include "simulation/assembly.hpp"

namespace touchstone {
namespace {

constexpr double max_kick = 1e-3;  // of the speed after a fall by the smallest width

Vec3 draw_vector(Draw& draw, double max) { return draw.uniform(0, max) * draw.direction(); }

Eigen::Quaterniond draw_turn(Draw& draw, double max) {
  const double half = draw.uniform(0, max) / 2;
  const Vec3 axis = std::sin(half) * draw.direction();
  return {std::cos(half), axis.x(), axis.y(), axis.z()};
}

/// A small motion of what is joined, as one.
struct Disturbance {
  Vec3 centre, shift = Vec3::Zero();
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();  ///< about the centre
  Vec3 kick = Vec3::Zero();                                  ///< m/s

  Vec3 moved(const Vec3& point) const { return centre + shift + turn * (point - centre); }
};

/// By body: one that stands for all that joints connect it with.
std::vector<int> mechanisms(const Scene& scene) { return connected(scene, false); }

/// By mechanism: is it held by the world, or by a body that forces do not move?
std::vector<bool> held_mechanisms(const Scene& scene, const std::vector<int>& mechanism) {
  std::vector<bool> held(scene.bodies.size());
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (!scene.bodies[i].is_free()) held[mechanism[i]] = true;
  }
  for (const Joint& joint : scene.joints) {
    if (joint.b == world_body) held[mechanism[joint.a]] = true;
  }
  return held;
}

/// Smallest width of the bodies of a mechanism.
double smallest_width(const Scene& scene, const std::vector<int>& mechanism, int which) {
  double width = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (mechanism[i] != which) continue;
    width = std::min(width, 2 * smallest_half_extent(scene.bodies[i].shape));
  }
  return width;
}

/// Largest speed of a kick, of what has this smallest width.
double kick_of(const Scene& scene, double width) {
  return max_kick * std::sqrt(2 * scene.gravity.norm() * width);
}

struct TurnDrive {
  const Eigen::Quaterniond& turn;

  Drive operator()(const SteadyMotion& m) const {
    return SteadyMotion{turn * m.velocity, turn * m.angular_velocity};
  }
  Drive operator()(const Oscillation& o) const {
    return Oscillation{turn * o.amplitude, turn * o.turn, o.frequency};
  }
  Drive operator()(const Waypoints& waypoints) const {
    Waypoints result;
    for (const auto& [time, pose] : waypoints) {
      result.push_back({time, Pose(turn * pose.position(), turn * pose.unit_orientation())});
    }
    return result;
  }
};

double largest_share(const std::vector<Verdict>& verdicts) {
  double largest = 0;
  for (const Verdict& v : verdicts) largest = std::max(largest, v.share());
  return largest;
}

/// Counts a trial in a run, and keeps it if it is the worst: the first that broke a need, or while
/// none has, the one that came nearest.
void add(const Trial& trial, std::size_t disturbance, RepeatedRun& run) {
  const bool broke_before = run.held < run.trials;
  const bool holds = first_broken(trial.verdicts) < 0;
  const bool is_worse = run.trials == 0 || (!broke_before && !holds) ||
                        (!broke_before && largest_share(trial.verdicts) > run.error());
  if (disturbance == 0) {
    run.points = trial.points;
    run.solver_seconds = trial.solver_seconds;
  }
  run.straying.add(trial.straying);
  ++run.trials;
  run.held += holds;
  if (!is_worse) return;
  run.disturbance = disturbance;
  run.verdicts = trial.verdicts;
  run.end = trial.end;
  run.evidence = trial.evidence;
}

}  // namespace

DisturbedScene::DisturbedScene(const Scene& written, std::uint64_t seed, std::size_t disturbance)
    : scene(written), turn(Eigen::Quaterniond::Identity()), origin(written.bodies.size()) {
  std::iota(origin.begin(), origin.end(), 0);
  if (disturbance == 0) return;
  // Every disturbance has a stream of its own, whatever their number.
  Draw draw(rc::Random(rc::Random::Key{seed, disturbance, 0, 0}));
  turn = draw.orientation();
  for (std::size_t i = origin.size(); i > 1; --i) {
    std::swap(origin[i - 1],
              origin[static_cast<std::size_t>(draw.integer(0, static_cast<std::int64_t>(i) - 1))]);
  }
  const std::vector<int> mechanism = mechanisms(written);
  const std::vector<bool> held = held_mechanisms(written, mechanism);
  std::map<int, Disturbance> disturbances;  // by mechanism
  std::vector<int> place(origin.size());    // the inverse of origin
  for (std::size_t i = 0; i < origin.size(); ++i) {
    place[origin[i]] = static_cast<int>(i);
    const Body& from = written.bodies[origin[i]];
    Body& body = scene.bodies[i] = from;
    const int which = mechanism[origin[i]];
    const auto [found, is_new] = disturbances.try_emplace(which);
    Disturbance& d = found->second;
    if (is_new) d.centre = from.pose.position();
    if (is_new && !held[which]) {
      const double width = smallest_width(written, mechanism, which);
      d.shift = draw_vector(draw, max_shift * width);
      d.turn = draw_turn(draw, max_angle);
      d.kick = draw_vector(draw, kick_of(written, width));
    }
    body.pose =
        Pose(turn * d.moved(from.pose.position()), turn * d.turn * from.pose.unit_orientation());
    // Turned with the poses: what is joined still moves as one.
    body.velocity = turn * (d.turn * from.velocity + d.kick);
    body.angular_velocity = turn * d.turn * from.angular_velocity;
    if (body.drive) body.drive = std::visit(TurnDrive{turn}, *from.drive);
  }
  for (Joint& joint : scene.joints) {
    const Disturbance& d = disturbances.at(mechanism[joint.a]);
    joint.anchor = turn * d.moved(joint.anchor);
    joint.axis = (turn * d.turn * joint.axis).normalized();
    joint.a = place[joint.a];
    if (joint.b != world_body) joint.b = place[joint.b];
  }
  for (auto& [a, b] : scene.apart) a = place[a], b = place[b];
  for (Push& push : scene.pushes) {
    push.body = place[push.body];
    push.force = turn * push.force;
    push.torque = turn * push.torque;
  }
  scene.gravity = turn * written.gravity;
}

Carrying carrying(const Scene& written, int body, double way) {
  const std::vector<int> mechanism = mechanisms(written);
  const int which = mechanism[body];
  if (held_mechanisms(written, mechanism)[which]) return {};
  const double width = smallest_width(written, mechanism, which);
  double reach = way;  // from any body of the mechanism, about which it may be turned
  for (std::size_t i = 0; i < written.bodies.size(); ++i) {
    if (mechanism[i] != which) continue;
    const Vec3 off = written.bodies[body].pose.position() - written.bodies[i].pose.position();
    reach = std::max(reach, way + off.norm());
  }
  return {2 * (max_shift * width + kick_of(written, width) * written.duration + max_angle * reach),
          2 * max_angle};
}

Trajectory DisturbedScene::turned_back(const Trajectory& run) const {
  const Eigen::Quaterniond back = turn.conjugate();
  Trajectory result = run;
  for (std::size_t f = 0; f < run.frames.size(); ++f) {
    for (std::size_t i = 0; i < origin.size(); ++i) {
      const BodyState& s = run.frames[f][i];
      result.frames[f][origin[i]] = {
          Pose(back * s.pose.position(), back * s.pose.unit_orientation()), back * s.velocity,
          back * s.angular_velocity};
    }
  }
  for (JudgedAnswer& a : result.answers) {
    a.a = origin[a.a], a.b = origin[a.b];
    if (a.wrong_normal) a.wrong_normal = back * *a.wrong_normal;
  }
  return result;
}

void Straying::add(const Straying& other) {
  overlap = std::max(overlap, other.overlap);
  if (other.distance > distance) distance = other.distance, body = other.body;
  if (other.tilt > tilt) tilt = other.tilt, tilted_body = other.tilted_body;
}

Straying straying(const Scene& scene, const Trajectory& run, const Trajectory& exact) {
  Straying result;
  for (const JudgedAnswer& answer : run.answers) {
    result.overlap = std::max(result.overlap, answer.depth);
  }
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const auto end = [&](const Trajectory& t) -> const Pose& { return t.frames.back()[i].pose; };
    const bool has_tilt = !std::holds_alternative<Sphere>(scene.bodies[i].shape);
    const std::string& name = scene.bodies[i].name;
    result.add({0, (end(run).position() - end(exact).position()).norm(), name,
                has_tilt ? degrees_between(end(run).axis(), end(exact).axis()) : 0, name});
  }
  return result;
}

Trajectory ends_of(const Trajectory& run) {
  return {run.step, {run.frames.front(), run.frames.back()}, {}};
}

double RepeatedRun::error() const { return largest_share(verdicts); }

int RepeatedRun::first_broken() const { return touchstone::first_broken(verdicts); }

int first_broken(const std::vector<Verdict>& verdicts) {
  int first = -1;
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    if (verdicts[i].holds()) continue;
    if (first < 0 || verdicts[i].time < verdicts[first].time) first = static_cast<int>(i);
  }
  return first;
}

void repeat(const std::vector<RepeatedRun*>& runs, std::size_t last, unsigned workers,
            const std::function<Trial(std::size_t run, std::size_t disturbance)>& trial,
            const std::function<std::string(std::size_t run)>& name) {
  struct Task {
    std::size_t run, disturbance;
  };
  // In waves, so that what breaks early is not run to the last disturbance.
  for (std::size_t from = 0, to = 1; from <= last; from = to, to = std::min(4 * to + 1, last + 1)) {
    std::vector<Task> tasks;
    for (std::size_t r = 0; r < runs.size(); ++r) {
      if (runs[r]->held < runs[r]->trials) continue;
      for (std::size_t d = std::max(from, runs[r]->trials); d < to; ++d) tasks.push_back({r, d});
    }
    if (tasks.empty()) continue;
    Progress progress(from == 0 ? "runs of the scene" : "disturbed runs", tasks.size());
    const auto results = run_in_processes(
        tasks.size(), workers,
        [&](std::size_t i) { return to_bytes(trial(tasks[i].run, tasks[i].disturbance)); },
        [&](std::size_t i) {
          return fmt::format("{}, disturbance {}", name(tasks[i].run), tasks[i].disturbance);
        },
        [&](std::size_t done) { progress.update(done); });
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      add(from_bytes<Trial>(results[i]), tasks[i].disturbance, *runs[tasks[i].run]);
    }
  }
}

std::vector<std::vector<double>> least_step_seconds(
    std::size_t runs, const std::function<std::vector<double>(std::size_t run)>& step_seconds,
    std::size_t rounds) {
  Progress progress("rounds of timing", rounds);
  std::vector<std::vector<double>> least(runs);
  for (std::size_t round = 0; round < rounds; ++round) {
    for (std::size_t turn = 0; turn < runs; ++turn) {
      const std::size_t i = (round + turn) % runs;
      const std::vector<double> times = step_seconds(i);
      if (round == 0) least[i] = times;
      for (std::size_t k = 0; k < std::min(times.size(), least[i].size()); ++k) {
        least[i][k] = std::min(least[i][k], times[k]);
      }
    }
    progress.update(round + 1);
  }
  return least;
}

std::vector<std::string> exact_runs(const Scene& scene, std::uint64_t seed,
                                    std::size_t disturbances, unsigned workers,
                                    const std::string& name,
                                    const std::function<std::string(const DisturbedScene&)>& make) {
  Progress progress("exact runs, disturbed", disturbances + 1);
  return run_in_processes(
      disturbances + 1, workers,
      [&](std::size_t i) {
        return make({scene, seed, i});
      },
      [&](std::size_t i) { return fmt::format("{}, disturbance {}", name, i); },
      [&](std::size_t done) { progress.update(done); });
}

}  // namespace touchstone
