#include "simulation/scenes/need.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <numbers>

#include "oracle/judge/normals.hpp"
#include "oracle/truth.hpp"
#include "reference/contact_of.hpp"
#include "reference/invalid_input.hpp"
#include "reference/support.hpp"
#include "simulation/assembly.hpp"
#include "simulation/scenes/disturbed_scene.hpp"

namespace touchstone {
namespace {

/// The largest of a series of values, and when and on which bodies the limit was first exceeded.
/// Values are added in the order of their times.
class Largest {
 public:
  explicit Largest(double limit) : limit_(limit) {}
  void add(double value, double time, std::array<int, 2> bodies = {-1, -1}) {
    const bool worse = !(value <= value_);  // true for NaN
    if (!broken_ && worse) time_ = time, bodies_ = bodies;
    if (worse) value_ = std::isnan(value) ? infinity : value;
    broken_ = broken_ || !(value <= limit_);
  }
  Verdict verdict() const { return {value_, limit_, time_, bodies_}; }

 private:
  double limit_, value_ = 0, time_ = 0;
  std::array<int, 2> bodies_ = {-1, -1};
  bool broken_ = false;
};

/// Angle of a line to the vertical, 0° … 90°.
double tilt(const Vec3& axis, const Vec3& gravity) {
  const double angle = degrees_between(axis, gravity);
  return std::min(angle, 180 - angle);
}

Vec3 horizontal(const Vec3& v, const Vec3& gravity) {
  return v - v.dot(gravity) / gravity.squaredNorm() * gravity;
}

/// Horizontal distance of a body from its start at the end of a run.
double horizontal_distance(const ComparedRuns& runs, const Trajectory& run, int body) {
  const Vec3 way =
      run.frames.back()[body].pose.position() - run.frames.front()[body].pose.position();
  return horizontal(way, runs.scene.gravity).norm();
}

/// Calls f(frame, time) for each frame of the run from a time on.
template <class F>
void each_frame(const Trajectory& run, double from, F f) {
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    const double time = run.step * static_cast<double>(i);
    if (time >= from - run.step / 2) f(run.frames[i], time);
  }
}

/// Calls f(state, time) for a body in each of them.
template <class F>
void each_state(const Trajectory& run, int body, double from, F f) {
  each_frame(run, from, [&](const auto& frame, double time) { f(frame[body], time); });
}

/// Is the answer about this body, or these two in either order? True for all answers if none are
/// given.
bool concerns(const std::vector<int>& bodies, const JudgedAnswer& answer) {
  if (bodies.size() == 1) return answer.a == bodies[0] || answer.b == bodies[0];
  return bodies.empty() || (answer.a == bodies[0] && answer.b == bodies[1]) ||
         (answer.a == bodies[1] && answer.b == bodies[0]);
}

/// The vertical is the direction of gravity.
void require_vertical(const Scene& scene, const char* need) {
  if (scene.gravity.norm() > 0) return;
  throw InvalidInput("need", fmt::format("\"{}\"", need),
                     "has no meaning in a scene without gravity");
}

/// An angle beyond which nothing can be would make a need that cannot fail, or cannot hold.
void require_angle(double degrees, double below) {
  if (degrees < below) return;
  throw InvalidInput("degrees", fmt::format("{:g}", degrees),
                     fmt::format("must be less than {:g}: no angle here is larger", below));
}

/// Nothing but the exact run itself ends nearer to where it does than anybody knows where a body
/// starts: it would be judged by itself.
void require_knowable(const char* member, double limit, double known) {
  if (limit >= known) return;
  throw InvalidInput(member, fmt::format("{:g}", limit),
                     fmt::format("must be at least {:.2g}: how a scene starts is known no better, "
                                 "and only exact contacts end so near to where these do",
                                 known));
}

/// How far from its place a body may start.
double known_place(const Scene& scene, int body) {
  return max_shift * 2 * smallest_half_extent(scene.bodies[body].shape);
}

/// Between bodies that never touch nothing could be wrong.
void require_touch(const Scene& scene, const std::vector<int>& bodies) {
  if (bodies.size() < 2 || Touching(scene)(bodies[0], bodies[1])) return;
  throw InvalidInput(
      "bodies",
      fmt::format("{} and {}", scene.bodies[bodies[0]].name, scene.bodies[bodies[1]].name),
      "must be able to touch: these never do, for a joint connects them, or neither is moved by "
      "forces, or one of them does not collide");
}

std::string names(const Scene& scene, const std::vector<int>& bodies) {
  std::vector<std::string> all;
  for (const int b : bodies) all.push_back(scene.bodies[b].name);
  return fmt::format("{}", fmt::join(all, ", "));
}

std::string from_text(double time) { return time > 0 ? fmt::format(" from {:g} s", time) : ""; }

struct Stands : Need {
  Stands() : Need("stands", "Its local z stays near the vertical", "°") {}
  double degrees = 0, from = 0, until = infinity;

  void visit(NeedMembers& members) override {
    members.body(bodies);
    members.number("degrees", degrees);
    members.time_or_default("from", from);
    members.time_or_default("until", until);
  }
  void check(const Scene& scene) const override {
    require_vertical(scene, name);
    require_angle(degrees, 90);
    if (until >= from) return;
    throw InvalidInput("until", fmt::format("{:g}", until),
                       fmt::format("must not lie before from, which is {:g}", from));
  }
  std::string text(const Scene& scene) const override {
    return fmt::format("{} stands within {:g}°{}{}", names(scene, bodies), degrees, from_text(from),
                       until < scene.duration ? fmt::format(" until {:g} s", until) : "");
  }
  Verdict measure(const ComparedRuns& runs) const override {
    Largest largest(degrees);
    each_state(runs.run, bodies[0], from, [&](const BodyState& s, double time) {
      if (time < until + runs.run.step / 2) {
        largest.add(tilt(s.pose.axis(), runs.scene.gravity), time);
      }
    });
    return largest.verdict();
  }
};

struct Rolls : Need {
  Rolls()
      : Need(
            "rolls",
            "It ends so far from its start, horizontally; without a distance, as far as with exact "
            "contacts",
            "") {}
  std::optional<double> distance;  // metres
  double share = 0;                // that it may be off by

  void visit(NeedMembers& members) override {
    members.body(bodies);
    members.positive("distance", distance);
    members.number("share", share);
  }
  void check(const Scene& scene) const override {
    require_vertical(scene, name);
    if (is_relative()) require_knowable("share", share, max_shift);
  }
  bool is_relative() const override { return !distance; }
  std::string text(const Scene& scene) const override {
    return fmt::format("{} rolls {} within {:g}%", names(scene, bodies),
                       distance ? fmt::format("{:g} m", *distance) : "as far as exactly",
                       100 * share);
  }
  Verdict measure(const ComparedRuns& runs) const override {
    const double expected = distance ? *distance : horizontal_distance(runs, runs.exact, bodies[0]);
    const double found = horizontal_distance(runs, runs.run, bodies[0]);
    // What stays where it is with exact contacts has no distance to take a share of.
    constexpr double standstill = 1e-6;  // of its width
    const double width = 2 * smallest_half_extent(runs.scene.bodies[bodies[0]].shape);
    const double whole = distance ? expected : std::max(expected, standstill * width);
    return {std::abs(found - expected) / whole, share, runs.run.end()};
  }
};

struct Rests : Need {
  Rests() : Need("rests", "None is faster from then on; without bodies, all that move", " m/s") {}
  double speed = 0, by = 0;  // m/s, of the centre or of the surface by rotation

  void visit(NeedMembers& members) override {
    members.moving_bodies(bodies);
    members.number("speed", speed);
    members.time_or_default("by", by);
  }
  std::string text(const Scene& scene) const override {
    constexpr std::size_t max_named = 3;
    return fmt::format(
        "{} slower than {:g} m/s from {:g} s",
        bodies.size() > max_named ? fmt::format("{} bodies", bodies.size()) : names(scene, bodies),
        speed, by);
  }
  Verdict measure(const ComparedRuns& runs) const override {
    Largest largest(speed);
    each_frame(runs.run, by, [&](const std::vector<BodyState>& states, double time) {
      for (const int body : bodies) {
        const BodyState& s = states[body];
        const double reach = largest_half_extent(runs.scene.bodies[body].shape);
        const double fastest = std::max(s.velocity.norm(), reach * s.angular_velocity.norm());
        largest.add(fastest, time, {bodies.size() > 1 ? body : -1, -1});
      }
    });
    return largest.verdict();
  }
};

struct FallsInOrder : Need {
  FallsInOrder()
      : Need("falls-in-order", "They tilt by more than the angle, in this order", " out of place") {
  }
  double degrees = 45;

  void visit(NeedMembers& members) override {
    members.bodies(bodies);
    members.number_or_default("degrees", degrees);
  }
  void check(const Scene&) const override { require_angle(degrees, 180); }
  std::string text(const Scene& scene) const override {
    return bodies.size() == 1 ? names(scene, bodies) + " falls"
                              : "fall in the order " + names(scene, bodies);
  }
  /// Counts bodies that do not fall, or fall before one that should have fallen earlier.
  Verdict measure(const ComparedRuns& runs) const override {
    double out_of_place = 0, before = 0;
    Verdict verdict{0, 0, runs.run.end()};
    for (const int body : bodies) {
      const double fell = fall_time(runs.run, body);
      if (fell < infinity && fell >= before) {
        before = fell;
        continue;
      }
      ++out_of_place;
      if (out_of_place > 1 && !(fell < verdict.time)) continue;
      verdict.time = std::min(fell, runs.run.end());
      verdict.bodies[0] = bodies.size() > 1 ? body : -1;
    }
    verdict.value = out_of_place;
    return verdict;
  }

 private:
  double fall_time(const Trajectory& run, int body) const {
    const Vec3 start = run.frames.front()[body].pose.axis();
    double fell = infinity;
    each_state(run, body, 0, [&](const BodyState& s, double time) {
      if (degrees_between(s.pose.axis(), start) > degrees) fell = std::min(fell, time);
    });
    return fell;
  }
};

struct Penetration : Need {
  Penetration()
      : Need("penetration", "True depth of pairs with a cylinder; of all, or of two bodies", " m") {
  }
  double metres = 0, from = 0;

  void visit(NeedMembers& members) override {
    members.any_pair(bodies);
    members.number("metres", metres);
    members.time_or_default("from", from);
  }
  void check(const Scene& scene) const override {
    require_touch(scene, bodies);
    // Contacts are asked for at the beginning of a step.
    if (from < scene.duration - scene.step / 2) return;
    throw InvalidInput(
        "from", fmt::format("{:g}", from),
        fmt::format("must be at least a step before the end, which is {:g}", scene.duration));
  }
  std::string text(const Scene& scene) const override {
    return fmt::format("{} overlap{} by less than {:g} m{}",
                       bodies.empty() ? "bodies" : names(scene, bodies),
                       bodies.size() == 1 ? "s others" : "", metres, from_text(from));
  }
  Verdict measure(const ComparedRuns& runs) const override {
    Largest largest(metres);
    for (const JudgedAnswer& a : runs.run.answers) {
      const double time = runs.run.step * a.frame;
      if (time < from - runs.run.step / 2 || !concerns(bodies, a)) continue;
      largest.add(a.depth, time, bodies.size() == 2 ? std::array{-1, -1} : std::array{a.a, a.b});
    }
    return largest.verdict();
  }
};

struct Normals : Need {
  Normals() : Need("normals", "Every contact's normal", "°") {}
  double degrees = 0;

  void visit(NeedMembers& members) override {
    members.pair(bodies);
    members.number("degrees", degrees);
  }
  void check(const Scene& scene) const override {
    require_touch(scene, bodies);
    require_angle(degrees, 180);
  }
  std::string text(const Scene& scene) const override {
    return fmt::format("normals of {} within {:g}°", names(scene, bodies), degrees);
  }
  Verdict measure(const ComparedRuns& runs) const override {
    Largest largest(degrees);
    for (const JudgedAnswer& a : runs.run.answers) {
      if (!a.wrong_normal || !concerns(bodies, a)) continue;
      const Configuration c = runs.run.configuration(runs.scene, a);
      // No optimal normal is further than the one that our routine names: seldom is the oracle
      // asked, which knows them all.
      const double bound = degrees_between(*a.wrong_normal, signed_distance(c).normal);
      if (bound <= largest.verdict().value) continue;
      if (std::isnan(bound)) {
        largest.add(bound, runs.run.step * a.frame);
        continue;
      }
      const oracle::Truth truth = oracle::truth(c);
      const double regret = signed_distance(c).value - gap(c, *a.wrong_normal);
      const auto angle = angle_to_optimal(c, truth, *a.wrong_normal, regret);
      if (angle) largest.add(*angle, runs.run.step * a.frame);
    }
    return largest.verdict();
  }
};

struct EndsNear : Need {
  EndsNear() : Need("ends-near", "It ends near where it does with exact contacts", " m") {}
  double metres = 0;
  bool is_derived = false;

  void visit(NeedMembers& members) override {
    members.body(bodies);
    members.number("metres", metres);
  }
  void check(const Scene& scene) const override {
    require_knowable("metres", metres, known_place(scene, bodies[0]));
  }
  bool is_relative() const override { return true; }
  std::shared_ptr<const Need> allowing(double limit) const override {
    const bool is_wider = is_derived && limit <= max_in_world;
    return is_wider ? ends_near_need(bodies[0], readable_limit(limit)) : nullptr;
  }
  std::string text(const Scene& scene) const override {
    return fmt::format("{} ends within {:g} m of the exact place", names(scene, bodies), metres);
  }
  Verdict measure(const ComparedRuns& runs) const override {
    const Vec3& found = runs.run.frames.back()[bodies[0]].pose.position();
    const Vec3& expected = runs.exact.frames.back()[bodies[0]].pose.position();
    return {(found - expected).norm(), metres, runs.run.end()};
  }
};

struct EndsTilted : Need {
  EndsTilted()
      : Need("ends-tilted", "Its local z ends near how it does with exact contacts", "°") {}
  double degrees = 0;
  bool is_derived = false;

  void visit(NeedMembers& members) override {
    members.body(bodies);
    members.number("degrees", degrees);
  }
  void check(const Scene&) const override {
    require_angle(degrees, 180);
    require_knowable("degrees", degrees, max_angle * 180 / std::numbers::pi);
  }
  bool is_relative() const override { return true; }
  std::shared_ptr<const Need> allowing(double limit) const override {
    constexpr double nearly_any = 90;
    const bool is_wider = is_derived && limit < nearly_any;
    return is_wider ? ends_tilted_need(bodies[0], readable_limit(limit)) : nullptr;
  }
  std::string text(const Scene& scene) const override {
    return fmt::format("{} ends within {:g}° of the exact tilt", names(scene, bodies), degrees);
  }
  Verdict measure(const ComparedRuns& runs) const override {
    const Vec3 found = runs.run.frames.back()[bodies[0]].pose.axis();
    const Vec3 expected = runs.exact.frames.back()[bodies[0]].pose.axis();
    return {degrees_between(found, expected), degrees, runs.run.end()};
  }
};

struct StaysIn : Need {
  StaysIn() : Need("stays-in", "Its centre stays in a box of the world", " m") {}
  Vec3 lower = Vec3::Zero(), upper = Vec3::Zero();
  double metres = 0, from = 0;  // `metres`: distance that it may be outside

  void visit(NeedMembers& members) override {
    members.body(bodies);
    members.point("lower", lower);
    members.point("upper", upper);
    members.number_or_default("metres", metres);
    members.time_or_default("from", from);
  }
  void check(const Scene&) const override {
    if ((lower.array() <= upper.array()).all()) return;
    throw InvalidInput("upper", "below lower", "must not lie below lower");
  }
  std::string text(const Scene& scene) const override {
    return fmt::format("{} stays in its region{}", names(scene, bodies), from_text(from));
  }
  Verdict measure(const ComparedRuns& runs) const override {
    Largest largest(metres);
    each_state(runs.run, bodies[0], from, [&](const BodyState& s, double time) {
      const Vec3& p = s.pose.position();
      largest.add((p - p.cwiseMax(lower).cwiseMin(upper)).norm(), time);
    });
    return largest.verdict();
  }
};

template <class... Kinds>
std::vector<std::unique_ptr<Need>> one_of_each() {
  std::vector<std::unique_ptr<Need>> all;
  (all.push_back(std::make_unique<Kinds>()), ...);
  return all;
}

}  // namespace

double degrees_between(const Vec3& u, const Vec3& v) {
  return std::atan2(u.cross(v).norm(), u.dot(v)) * 180 / std::numbers::pi;
}

double readable_limit(double limit) {
  if (!(limit > 0)) return 0;
  const double unit = std::pow(10, std::floor(std::log10(limit)) - 1);
  return std::ceil(limit / unit) * unit;
}

Verdict Need::judge(const ComparedRuns& runs) const {
  Verdict verdict = measure(runs);
  if (!runs.run.sound) {
    if (verdict.holds()) verdict.time = runs.run.end();
    verdict.value = infinity;
  }
  return verdict;
}

std::shared_ptr<const Need> penetration_need(int body, double metres) {
  auto need = std::make_shared<Penetration>();
  need->bodies = {body};
  need->metres = metres;
  return need;
}

std::shared_ptr<const Need> ends_near_need(int body, double metres) {
  auto need = std::make_shared<EndsNear>();
  need->bodies = {body};
  need->metres = metres;
  need->is_derived = true;
  return need;
}

std::shared_ptr<const Need> ends_tilted_need(int body, double degrees) {
  auto need = std::make_shared<EndsTilted>();
  need->bodies = {body};
  need->degrees = degrees;
  need->is_derived = true;
  return need;
}

std::vector<std::unique_ptr<Need>> all_needs() {
  return one_of_each<Stands, Rolls, Rests, FallsInOrder, Penetration, Normals, EndsNear, EndsTilted,
                     StaysIn>();
}

}  // namespace touchstone
