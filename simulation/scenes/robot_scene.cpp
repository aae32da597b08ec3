// A robot or world as a scene: bodies, joints and motors, the ground.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <numbers>
#include <numeric>
#include <set>

#include "properties/files/given_text.hpp"
#include "reference/invalid_input.hpp"
#include "reference/support.hpp"
#include "simulation/assembly.hpp"
#include "simulation/scenes/robot_file.hpp"

namespace touchstone {
namespace {

constexpr double water = 1000;  // kg/m³, of links whose mass the file does not give

/// Mass of a link without shapes or a mass of its own, as a share of its robot's; a much lighter
/// one between two joints would need many more iterations of the solver.
constexpr double share_of_robot = 0.01;
constexpr double ghost_mass = 1e-3;  // kg, of one in a robot without any mass

constexpr double max_friction = 1e6, max_effort = 1e9;  // beyond these more makes no difference
constexpr double start_up = 0.2;                        // s, until a driven joint has its rate

double volume_of(const Shape& shape) { return inertia(shape, 1).inertia.mass; }

bool is_plane(const LinkShape& s) { return std::holds_alternative<Plane>(s.shape); }

/// Number of insertions, deletions and replacements that turn one text into the other
/// (Levenshtein).
std::size_t edits(const std::string& from, const std::string& to) {
  std::vector<std::size_t> row(to.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < from.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t k = 0; k < to.size(); ++k) {
      const std::size_t replaced = diagonal + (from[i] == to[k] ? 0 : 1);
      diagonal = row[k + 1];
      row[k + 1] = std::min({replaced, row[k] + 1, diagonal + 1});
    }
  }
  return row.back();
}

/// g(n) of two bodies: the clearance along n, from b to a.
double clearance(const Body& a, const Body& b, const Vec3& n) {
  return -support(a.shape, a.pose, -n) - support(b.shape, b.pose, n);
}

/// Do the convex bodies overlap? Of bodies apart the clearance has one maximum over the directions,
/// which a search from the line between their centres finds.
bool overlap(const Body& a, const Body& b) {
  if (!aabb(a.shape, a.pose).overlaps(aabb(b.shape, b.pose))) return false;
  Vec3 n = a.pose.position() - b.pose.position();
  n = n.norm() > 0 ? Vec3(n.normalized()) : Vec3(Vec3::UnitZ());
  double best = clearance(a, b, n);
  constexpr double first_angle = 0.5, last_angle = 1e-5;
  for (double angle = first_angle; angle > last_angle && best <= 0;) {
    const Vec3 across = n.unitOrthogonal(), other = n.cross(across);
    Vec3 next = n;
    for (const Vec3& way : {across, other, Vec3(across + other), Vec3(across - other)}) {
      for (const double sign : {-1.0, 1.0}) {
        const Vec3 tried = (n + sign * angle * way.normalized()).normalized();
        const double found = clearance(a, b, tried);
        if (found > best) best = found, next = tried;
      }
    }
    if (next == n) angle /= 2;
    n = next;
  }
  return best <= 0;
}

class SceneMaker {
 public:
  SceneMaker(const RobotFile& robot, const RobotMotion& motion)
      : robot_(robot), motion_(motion), links_(robot.links), bodies_of_(robot.links.size()) {}

  SceneFile make() {
    Scene& scene = file_.scene;
    file_.name = robot_.name;
    scene.gravity = robot_.gravity;
    scene.duration = motion_.duration;
    if (robot_.step) scene.step = *robot_.step;
    find_robots();
    if (motion_.has_fixed_base) {
      links_[base()].fixed = true;
      find_robots();
    }
    find_kept();
    check_names();
    for (std::size_t l = 0; l < links_.size(); ++l) add_link(l);
    const bool has_ground = std::ranges::any_of(
        links_, [](const Link& link) { return std::ranges::any_of(link.shapes, is_plane); });
    if (!robot_.is_world && !has_ground) add_ground();
    for (const LinkJoint& joint : robot_.joints) add_joint(joint);
    keep_apart();
    check();
    file_.description = description();
    file_.ignored = robot_.ignored;
    file_.camera = camera_for(scene);
    return std::move(file_);
  }

 private:
  bool is_moving(int link) const { return link != world_body && !links_[link].fixed; }
  bool has_body(int link) const { return link != world_body && !bodies_of_[link].empty(); }

  /// The first link of a robot that is no joint's child.
  std::size_t root_of(int robot) const {
    std::set<int> children;
    for (const LinkJoint& joint : robot_.joints) {
      if (is_moving(joint.child) && is_moving(joint.parent)) children.insert(joint.child);
    }
    for (std::size_t l = 0; l < links_.size(); ++l) {
      if (robot_of_[l] == robot && !children.contains(static_cast<int>(l))) return l;
    }
    return static_cast<std::size_t>(robot);  // a circle of joints
  }

  /// The link that --fixed-base holds: in a world, that of the only robot without a hold on it; a
  /// loose part without joints counts only where there is nothing else.
  std::size_t base() const {
    if (!robot_.is_world) return root_of(robot_of_.front());
    std::set<int> jointed, held;  // robots
    for (const LinkJoint& joint : robot_.joints) {
      for (const auto& [link, other] :
           {std::pair{joint.child, joint.parent}, {joint.parent, joint.child}}) {
        if (!is_moving(link)) continue;
        jointed.insert(robot_of_[link]);
        if (!is_moving(other)) held.insert(robot_of_[link]);
      }
    }
    std::set<int> roots;
    for (std::size_t l = 0; l < links_.size(); ++l) {
      const bool counts = jointed.empty() || jointed.contains(robot_of_[l]);
      if (!links_[l].fixed && counts && !held.contains(robot_of_[l])) {
        roots.insert(static_cast<int>(root_of(robot_of_[l])));
      }
    }
    if (roots.size() == 1) return static_cast<std::size_t>(*roots.begin());
    std::vector<std::string> names;
    for (const int root : roots) names.push_back(links_[root].name);
    throw InvalidInput(
        "--fixed-base", "given",
        names.empty()
            ? std::string("must not be: no robot here moves freely, so that there is no base to "
                          "hold")
            : fmt::format("must not be: {} robots move freely, with the bases {}; it holds that of "
                          "one alone",
                          names.size(), fmt::join(names, ", ")));
  }

  /// By link: the first of those that joints connect for which `counts` is true.
  template <class F>
  std::vector<int> connected(F counts) const {
    std::vector<int> first(links_.size());
    std::iota(first.begin(), first.end(), 0);
    for (bool changed = true; changed;) {
      changed = false;
      for (const LinkJoint& joint : robot_.joints) {
        if (!counts(joint)) continue;
        int &a = first[joint.child], &b = first[joint.parent];
        changed = changed || a != b;
        a = b = std::min(a, b);
      }
    }
    return first;
  }

  /// Numbers the robots: links that joints connect, other than through the world.
  void find_robots() {
    robot_of_ = connected(
        [&](const LinkJoint& joint) { return is_moving(joint.child) && is_moving(joint.parent); });
    masses_.assign(links_.size(), 0);
    for (std::size_t l = 0; l < links_.size(); ++l) masses_[robot_of_[l]] += mass_of(links_[l]);
  }

  /// Mass of what the file describes; zero where that is nothing.
  static double mass_of(const Link& link) {
    if (link.fixed) return 0;
    if (link.mass.value_or(0) > 0) return *link.mass;
    double volume = 0;
    for (const LinkShape& s : link.shapes) volume += volume_of(s.shape);
    return water * volume;
  }

  /// Frames are not kept: links without shapes and mass with nothing but one fixed joint, and what
  /// is without shapes and joints.
  void find_kept() {
    kept_.assign(links_.size(), true);
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t l = links_.size(); l-- > 0;) {  // children come last, as a rule
        if (!kept_[l] || !links_[l].shapes.empty()) continue;
        int joints = 0, moving = 0;
        for (const LinkJoint& joint : robot_.joints) {
          const bool ends_here =
              joint.child == static_cast<int>(l) || joint.parent == static_cast<int>(l);
          if (!ends_here || !is_kept(joint.child) || !is_kept(joint.parent)) continue;
          ++joints;
          moving += joint.kind != JointKind::fixed ? 1 : 0;
        }
        const bool has_mass = links_[l].mass.value_or(0) > 0;
        if (!links_[l].fixed && (moving > 0 || joints > 1 || (joints == 1 && has_mass))) continue;
        kept_[l] = false;
        changed = true;
      }
    }
  }
  /// Is there something that a joint to this link holds to?
  bool is_kept(int link) const { return !is_moving(link) || kept_[link]; }

  std::vector<std::string> movable_joints() const {
    std::vector<std::string> names;
    for (const LinkJoint& joint : robot_.joints) {
      const bool moves = is_moving(joint.child) || is_moving(joint.parent);
      if (joint.kind != JointKind::fixed && moves) names.push_back(joint.name);
    }
    return names;
  }

  void check_name(const std::string& name) const {
    std::vector<std::string> known = movable_joints();
    if (std::ranges::find(known, name) != known.end()) return;
    std::ranges::stable_sort(known, {}, [&](const std::string& k) { return edits(name, k); });
    constexpr std::size_t max_shown = 3;
    known.resize(std::min(known.size(), max_shown));
    throw InvalidInput(
        "--drive", '"' + printable(name, 60) + '"',
        known.empty() ? std::string("must be a joint that moves: there is none")
                      : fmt::format("must be a joint that moves, as {}", fmt::join(known, ", ")));
  }
  void check_names() const {
    for (const auto& [name, rate] : motion_.rates) check_name(name);
    for (const std::string& name : motion_.loose) check_name(name);
  }

  /// A name that no other body has.
  std::string unique(const std::string& name) {
    std::string result = name;
    for (int number = 2; !names_.insert(result).second; ++number) {
      result = fmt::format("{} {}", name, number);
    }
    return result;
  }

  void add_body(std::size_t link, Body body) {
    body.name = unique(body.name);
    body.fixed = links_[link].fixed;
    auto& bodies = bodies_of_[link];
    const int index = static_cast<int>(file_.scene.bodies.size());
    if (!bodies.empty()) {
      Joint joint;
      joint.name = fmt::format("{} in {}", body.name, links_[link].name);
      joint.a = index;
      joint.b = bodies.front();
      file_.scene.joints.push_back(joint);
    }
    bodies.push_back(index);
    file_.scene.bodies.push_back(std::move(body));
  }

  void add_link(std::size_t l) {
    const Link& link = links_[l];
    if (!kept_[l]) return;
    if (link.shapes.empty()) {
      if (!link.fixed) add_ghost(l);
      return;
    }
    double volume = 0;
    for (const LinkShape& s : link.shapes) volume += volume_of(s.shape);
    std::vector<Body> bodies;
    for (const LinkShape& s : link.shapes) {
      Body& body = bodies.emplace_back(Body{link.shapes.size() == 1 ? link.name : s.name, s.shape});
      body.pose = s.pose;
      body.density = link.mass.value_or(0) > 0 ? *link.mass / volume : water;
      if (s.friction) body.material.friction = std::min(*s.friction, max_friction);
    }
    set_inertia(link, bodies);
    for (const Body& body : bodies) add_body(l, body);
  }

  /// Puts the mass of a link where the file has it: with its moments, all of it into the first
  /// body; without them each body keeps its own, all of them moved to where their centre shall be.
  static void set_inertia(const Link& link, std::vector<Body>& bodies) {
    if (!link.inertia || link.fixed) return;
    const auto& [pose, moments] = *link.inertia;
    if (moments) {
      for (Body& body : bodies) body.inertia = PosedInertia{{0, Vec3::Zero()}};
      bodies.front().inertia = {{*link.mass, *moments}, relative(bodies.front().pose, pose)};
      return;
    }
    Vec3 centre = Vec3::Zero();
    for (const Body& body : bodies) {
      const auto [own, X_BC] = inertia(body);
      centre +=
          own.mass / *link.mass * (body.pose.position() + body.pose.rotation() * X_BC.position());
    }
    for (Body& body : bodies) {
      const Vec3 off = body.pose.rotation().transpose() * (pose.position() - centre);
      body.inertia = inertia(body);
      body.inertia->X_BC = {body.inertia->X_BC.position() + off, body.inertia->X_BC.orientation()};
    }
  }

  /// A small ball that touches nothing, with the mass of the link.
  void add_ghost(std::size_t l) {
    double mass = links_[l].mass.value_or(0);
    if (!(mass > 0)) mass = share_of_robot * masses_[robot_of_[l]];
    if (!(mass > 0)) mass = ghost_mass;
    Body body{links_[l].name, Sphere(std::cbrt(3 * mass / (4 * std::numbers::pi * water)))};
    body.density = water;
    body.pose = links_[l].pose;
    body.collides = false;
    std::vector<Body> bodies = {body};
    set_inertia(links_[l], bodies);
    add_body(l, bodies.front());
  }

  void add_ground() {
    double lowest = infinity;
    for (const Body& body : file_.scene.bodies) {
      if (body.collides) lowest = std::min(lowest, aabb(body.shape, body.pose).lower.z());
    }
    // What is bolted to the world stands on its floor, unless it reaches below.
    if (robot_.links.front().fixed) lowest = std::min(lowest, 0.0);
    if (!std::isfinite(lowest)) return;
    Body ground{unique("ground"), Plane(Vec3::UnitZ(), lowest)};
    ground.fixed = true;
    file_.scene.bodies.push_back(ground);
  }

  /// Force or torque that carries the whole robot, sideways by its reach.
  double strength(const LinkJoint& joint, int link) const {
    if (joint.effort) return std::min(*joint.effort, max_effort);
    Aabb all{Vec3::Constant(infinity), Vec3::Constant(-infinity)};
    double mass = 0;
    for (std::size_t l = 0; l < links_.size(); ++l) {
      if (robot_of_[l] != robot_of_[link]) continue;
      for (const int b : bodies_of_[l]) {
        const Body& body = file_.scene.bodies[b];
        const Aabb box = aabb(body.shape, body.pose);
        all = {all.lower.cwiseMin(box.lower), all.upper.cwiseMax(box.upper)};
        mass += inertia(body).inertia.mass;
      }
    }
    constexpr double earth = 9.81;  // m/s²
    const double weight = mass * std::max(earth, robot_.gravity.norm());
    const double reach = joint.kind == JointKind::hinge ? (all.upper - all.lower).norm() : 1;
    return std::min(weight * reach, max_effort);
  }

  std::optional<Motor> motor_of(const LinkJoint& joint, int link) const {
    Motor motor;
    motor.max_force = strength(joint, link);
    for (const auto& [name, rate] : motion_.rates) {
      if (name == joint.name) motor.course = {{0, 0}, {start_up, rate}};
    }
    if (!motor.course.empty()) return motor;
    const auto& loose = motion_.loose;
    if (!joint.holds || std::ranges::find(loose, joint.name) != loose.end()) return std::nullopt;
    motor.target = Motor::Target::position;
    motor.course = {{0, 0}};
    return motor;
  }

  void add_joint(const LinkJoint& joint) {
    const bool child_moves = is_moving(joint.child) && has_body(joint.child);
    const bool parent_moves = is_moving(joint.parent) && has_body(joint.parent);
    if (!child_moves && !parent_moves) return;
    if (joint.kind == JointKind::fixed) {
      // Frames have no bodies; what was joined through one alone does not occur.
      if (child_moves != parent_moves && (is_moving(joint.child) && is_moving(joint.parent)))
        return;
    }
    Joint made;
    made.name = joint.name;
    made.kind = joint.kind;
    const auto body = [&](int link) {
      return has_body(link) ? bodies_of_[link].front() : world_body;
    };
    // Positions are of a relative to b, of the child relative to the parent.
    const bool turned = !child_moves;
    made.a = body(turned ? joint.parent : joint.child);
    made.b = body(turned ? joint.child : joint.parent);
    if (joint.kind != JointKind::fixed) {
      made.anchor = joint.anchor;
      made.axis = (turned ? -1 : 1) * joint.axis.normalized();
      made.lower = joint.lower < -max_in_world ? -infinity : std::min(joint.lower, 0.0);
      made.upper = joint.upper > max_in_world ? infinity : std::max(joint.upper, 0.0);
      made.motor = motor_of(joint, turned ? joint.parent : joint.child);
    }
    file_.scene.joints.push_back(made);
  }

  void keep_apart(int link, int other) {
    for (const int a : bodies_of_[link]) {
      for (const int b : bodies_of_[other]) file_.scene.apart.emplace_back(a, b);
    }
  }

  /// Keeps apart the shapes of two links whose masks do not meet.
  void keep_masks(std::size_t link, std::size_t other) {
    const auto &shapes = links_[link].shapes, &others = links_[other].shapes;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      for (std::size_t j = 0; j < others.size(); ++j) {
        if (shapes[i].mask.touches(others[j].mask)) continue;
        file_.scene.apart.emplace_back(bodies_of_[link][i], bodies_of_[other][j]);
      }
    }
  }

  /// Keeps apart what the file does, and links of a robot that overlap at the start: they stand for
  /// parts that are built into each other.
  void keep_apart() {
    for (const auto& [link, other] : robot_.apart) keep_apart(link, other);
    const std::vector<Body>& bodies = file_.scene.bodies;
    // As the file has them, whatever holds a base.
    const std::vector<int> robot_of = connected([](const LinkJoint& joint) {
      return joint.child != world_body && joint.parent != world_body;
    });
    for (std::size_t l = 0; l < links_.size(); ++l) {
      for (std::size_t k = l + 1; k < links_.size(); ++k) {
        keep_masks(l, k);
        if (robot_of[l] != robot_of[k]) continue;
        const bool is_one = std::ranges::any_of(bodies_of_[l], [&](int a) {
          return std::ranges::any_of(bodies_of_[k], [&](int b) {
            return bodies[a].collides && bodies[b].collides && overlap(bodies[a], bodies[b]);
          });
        });
        if (is_one) keep_apart(static_cast<int>(l), static_cast<int>(k));
      }
    }
  }

  /// Throws as check_scene does, with the link's or joint's name in place of its number.
  void check() const {
    if (file_.scene.bodies.empty()) {
      throw InvalidInput(
          "scene", '"' + robot_.name + '"',
          robot_.left_out.shapes > 0
              ? "must hold a collision shape that can be simulated, not only ellipsoids and height "
                "fields: add cylinders, boxes, spheres, capsules or meshes"
              : "must hold at least one collision shape");
    }
    constexpr double max_states = 4e6;  // a state of a body takes 200 bytes
    const Scene& scene = file_.scene;
    const double steps = scene.duration / scene.step;
    if (steps < 1 - 1e-9) {
      throw InvalidInput("--duration", fmt::format("{:g}", scene.duration),
                         fmt::format("must be at least one step, which is {:g} s", scene.step));
    }
    if (steps * static_cast<double>(scene.bodies.size()) > max_states) {
      throw InvalidInput("--duration", fmt::format("{:g}", scene.duration),
                         fmt::format("must be shorter: {:.0f} steps of {} bodies are too many",
                                     steps, scene.bodies.size()));
    }
    try {
      check_scene(scene);
    } catch (const InvalidInput& e) {
      const std::string& field = e.field();
      const bool is_body = field.starts_with("bodies[");
      if (!is_body && !field.starts_with("joints[")) throw;
      const std::size_t open = field.find('['), close = field.find(']');
      const auto index = static_cast<std::size_t>(std::stoul(field.substr(open + 1)));
      const std::string& name = is_body ? scene.bodies.at(index).name : scene.joints.at(index).name;
      const char* const units =
          field.ends_with(".density")
              ? " kg/m³; it is the link's mass over its shapes' volume: are these in kilograms and "
                "metres?"
              : "";
      throw InvalidInput((is_body ? "link " : "joint ") + name + field.substr(close + 1), e.value(),
                         e.remedy() + units);
    }
  }

  /// Which joints move by themselves, or that none does.
  std::string driven_text() const {
    constexpr std::size_t max_shown = 6;
    std::vector<std::string> names;
    for (const auto& [joint, rate] : motion_.rates) {
      names.push_back(fmt::format("{}={:g}", joint, rate));
    }
    const bool is_driven = !names.empty();
    if (!is_driven) names = movable_joints();
    if (names.empty()) return "";
    const std::size_t more = names.size() - std::min(names.size(), max_shown);
    names.resize(names.size() - more);
    return fmt::format(
        "; {} {}{}",
        is_driven ? "driven:" : "no joint is driven, and what rests needs little: see --drive, of",
        fmt::join(names, ", "), more > 0 ? fmt::format(" and {} more", more) : "");
  }

  std::string description() const {
    std::size_t hinges = 0, sliders = 0, moving = 0;
    for (const Joint& joint : file_.scene.joints) {
      hinges += joint.kind == JointKind::hinge ? 1 : 0;
      sliders += joint.kind == JointKind::slider ? 1 : 0;
    }
    for (const Body& body : file_.scene.bodies) moving += body.fixed ? 0 : 1;
    std::string text = fmt::format("{}, {}, {}", counted(moving, "moving shape"),
                                   counted(hinges, "hinge"), counted(sliders, "slider"));
    text += driven_text();
    if (const std::string left = left_out_text(robot_); !left.empty()) text += "; " + left;
    return text;
  }

  const RobotFile& robot_;
  const RobotMotion& motion_;
  std::vector<Link> links_;
  std::vector<std::vector<int>> bodies_of_;  ///< by link: one for each shape, or a ball
  std::vector<int> robot_of_;                ///< by link
  std::vector<double> masses_;               ///< by robot, kg
  std::vector<bool> kept_;                   ///< by link
  std::set<std::string> names_;
  SceneFile file_;
};

}  // namespace

SceneFile robot_scene(const RobotFile& robot, const RobotMotion& motion) {
  return SceneMaker(robot, motion).make();
}

}  // namespace touchstone
