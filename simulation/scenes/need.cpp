#include "simulation/scenes/need.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <numbers>

namespace touchstone {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The largest value so far, and when the limit was first passed.
class Largest {
 public:
  explicit Largest(double limit) : limit_(limit) {}
  void add(double value, double time) {
    const bool worse = !(value <= value_);  // also when it is no number
    if (!broken_ && worse) time_ = time;
    if (worse) value_ = std::isnan(value) ? infinity : value;
    broken_ = broken_ || !(value <= limit_);
  }
  Verdict verdict() const { return {value_, limit_, time_}; }

 private:
  double limit_, value_ = 0, time_ = 0;
  bool broken_ = false;
};

double degrees_between(const Vec3& u, const Vec3& v) {
  return std::atan2(u.cross(v).norm(), u.dot(v)) * 180 / std::numbers::pi;
}

/// Of a line with the vertical, 0° … 90°.
double tilt(const Vec3& axis, const Vec3& gravity) {
  const double angle = degrees_between(axis, gravity);
  return std::min(angle, 180 - angle);
}

Vec3 horizontal(const Vec3& v, const Vec3& gravity) {
  return v - v.dot(gravity) / gravity.squaredNorm() * gravity;
}

struct Measure {
  const Scene& scene;
  const Trajectory& run;
  const Trajectory& exact;

  const BodyState& start(int body) const { return run.frames.front()[body]; }
  const BodyState& last(int body) const { return run.frames.back()[body]; }

  /// Calls f(state, time) for each frame from that time on.
  template <class F>
  void each(int body, double from, F f) const {
    for (std::size_t i = 0; i < run.frames.size(); ++i) {
      const double time = run.step * static_cast<double>(i);
      if (time >= from - run.step / 2) f(run.frames[i][body], time);
    }
  }

  Verdict operator()(const Stands& n) const {
    Largest largest(n.degrees);
    each(n.body, n.from, [&](const BodyState& s, double time) {
      if (time < n.until + run.step / 2) largest.add(tilt(s.pose.axis(), scene.gravity), time);
    });
    return largest.verdict();
  }

  Verdict operator()(const Rolls& n) const {
    const auto rolled = [&](const Trajectory& t) {
      const Vec3 way =
          t.frames.back()[n.body].pose.position() - t.frames.front()[n.body].pose.position();
      return horizontal(way, scene.gravity).norm();
    };
    const double expected = n.distance ? *n.distance : rolled(exact);
    return {std::abs(rolled(run) - expected) / expected, n.share, run.end()};
  }

  Verdict operator()(const Rests& n) const {
    Largest largest(n.speed);
    for (const int body : n.bodies) {
      const double reach = largest_half_extent(scene.bodies[body].shape);
      each(body, n.by, [&](const BodyState& s, double time) {
        largest.add(std::max(s.velocity.norm(), reach * s.angular_velocity.norm()), time);
      });
    }
    return largest.verdict();
  }

  /// How many fall before one that should have fallen earlier, or not at all.
  Verdict operator()(const FallsInOrder& n) const {
    double out_of_place = 0, first = infinity, before = 0;
    for (const int body : n.bodies) {
      double fell = infinity;
      each(body, 0, [&](const BodyState& s, double time) {
        const double angle = degrees_between(s.pose.axis(), start(body).pose.axis());
        if (angle > n.degrees) fell = std::min(fell, time);
      });
      if (!(fell < infinity) || fell < before) {
        ++out_of_place;
        first = std::min(first, std::min(fell, run.end()));
      } else {
        before = fell;
      }
    }
    return {out_of_place, 0, out_of_place > 0 ? first : run.end()};
  }

  bool concerns(const std::vector<int>& bodies, const Asked& asked) const {
    return bodies.empty() || (asked.a == bodies[0] && asked.b == bodies[1]) ||
           (asked.a == bodies[1] && asked.b == bodies[0]);
  }

  Verdict operator()(const Penetration& n) const {
    Largest largest(n.metres);
    for (const Asked& a : run.asked) {
      const double time = run.step * a.frame;
      if (time >= n.from - run.step / 2 && concerns(n.bodies, a)) largest.add(a.depth, time);
    }
    return largest.verdict();
  }

  Verdict operator()(const Normals& n) const {
    Largest largest(n.degrees);
    for (const Asked& a : run.asked) {
      if (a.normal_angle && concerns(n.bodies, a)) largest.add(*a.normal_angle, run.step * a.frame);
    }
    return largest.verdict();
  }

  Verdict operator()(const EndsNear& n) const {
    const Vec3& with_exact = exact.frames.back()[n.body].pose.position();
    return {(last(n.body).pose.position() - with_exact).norm(), n.metres, run.end()};
  }

  Verdict operator()(const EndsTilted& n) const {
    const Vec3 with_exact = exact.frames.back()[n.body].pose.axis();
    const double angle = degrees_between(last(n.body).pose.axis(), with_exact);
    return {angle, n.degrees, run.end()};
  }

  Verdict operator()(const StaysIn& n) const {
    Largest largest(n.metres);
    each(n.body, n.from, [&](const BodyState& s, double time) {
      const Vec3& p = s.pose.position();
      largest.add((p - p.cwiseMax(n.lower).cwiseMin(n.upper)).norm(), time);
    });
    return largest.verdict();
  }
};

struct Describe {
  const Scene& scene;

  const std::string& name(int body) const { return scene.bodies[body].name; }
  std::string names(const std::vector<int>& bodies) const {
    std::vector<std::string> all;
    for (const int b : bodies) all.push_back(name(b));
    return fmt::format("{}", fmt::join(all, ", "));
  }
  std::string from(double time) const { return time > 0 ? fmt::format(" from {:g} s", time) : ""; }

  std::string operator()(const Stands& n) const {
    return fmt::format("{} stands within {:g}°{}{}", name(n.body), n.degrees, from(n.from),
                       n.until < scene.duration ? fmt::format(" until {:g} s", n.until) : "");
  }
  std::string operator()(const Rolls& n) const {
    return fmt::format("{} rolls {} within {:g}%", name(n.body),
                       n.distance ? fmt::format("{:g} m", *n.distance) : "as far as exactly",
                       100 * n.share);
  }
  std::string operator()(const Rests& n) const {
    return fmt::format(
        "{} slower than {:g} m/s from {:g} s",
        n.bodies.size() > 3 ? fmt::format("{} bodies", n.bodies.size()) : names(n.bodies), n.speed,
        n.by);
  }
  std::string operator()(const FallsInOrder& n) const {
    if (n.bodies.size() == 1) return name(n.bodies[0]) + " falls";
    return fmt::format("fall in the order {}", names(n.bodies));
  }
  std::string operator()(const Penetration& n) const {
    return fmt::format("{} overlap by less than {:g} m{}",
                       n.bodies.empty() ? "bodies" : names(n.bodies), n.metres, from(n.from));
  }
  std::string operator()(const Normals& n) const {
    return fmt::format("normals of {} within {:g}°", names(n.bodies), n.degrees);
  }
  std::string operator()(const EndsNear& n) const {
    return fmt::format("{} ends within {:g} m of the exact place", name(n.body), n.metres);
  }
  std::string operator()(const EndsTilted& n) const {
    return fmt::format("{} ends within {:g}° of the exact tilt", name(n.body), n.degrees);
  }
  std::string operator()(const StaysIn& n) const {
    return fmt::format("{} stays in its region{}", name(n.body), from(n.from));
  }
};

struct Unit {
  const char* operator()(const Stands&) const { return "°"; }
  const char* operator()(const Rolls&) const { return ""; }
  const char* operator()(const Rests&) const { return " m/s"; }
  const char* operator()(const FallsInOrder&) const { return " out of place"; }
  const char* operator()(const Penetration&) const { return " m"; }
  const char* operator()(const Normals&) const { return "°"; }
  const char* operator()(const EndsNear&) const { return " m"; }
  const char* operator()(const EndsTilted&) const { return "°"; }
  const char* operator()(const StaysIn&) const { return " m"; }
};

}  // namespace

Verdict measure(const Need& need, const Scene& scene, const Trajectory& run,
                const Trajectory& exact) {
  Verdict verdict = std::visit(Measure{scene, run, exact}, need);
  if (!run.sound) verdict.value = infinity, verdict.time = std::min(verdict.time, run.end());
  return verdict;
}

std::vector<int> bodies_of(const Need& need) {
  return std::visit(
      [](const auto& n) -> std::vector<int> {
        if constexpr (requires { n.bodies; }) {
          return n.bodies;
        } else {
          return {n.body};
        }
      },
      need);
}

std::string describe(const Need& need, const Scene& scene) {
  return std::visit(Describe{scene}, need);
}
const char* unit(const Need& need) { return std::visit(Unit{}, need); }

}  // namespace touchstone
