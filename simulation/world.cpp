#include "simulation/world.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <ode/ode.h>
#include <utility>

#include "candidates/ode_library.hpp"
#include "reference/invalid_input.hpp"
#include "reference/support.hpp"
#include "simulation/assembly.hpp"
#include "simulation/ode_scene.hpp"

namespace touchstone {
namespace {

constexpr double error_reduction = 0.2;  // ERP
/// Slip below which its direction is rounding, and any direction serves, m/s.
constexpr double min_slip = 1e-12;

/// Box that contains every candidate's model of the shape: some put round ends on a cylinder.
Aabb candidate_box(const Shape& shape, const Pose& pose) {
  if (const auto* c = std::get_if<Cylinder>(&shape)) {
    return aabb(Capsule(c->radius(), c->half_length()), pose);
  }
  return aabb(shape, pose);
}

}  // namespace

struct World::State {
  /// An assembly in motion.
  struct Moving {
    Assembly assembly;
    dBodyID body;  ///< null if it is fixed
    BodyState state;
    Vec3 spin;  ///< about its centre of mass
  };

  State(const Scene& given, ContactModel& contact_model);
  ~State();
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  void make_assembly(const Assembly& assembly);
  double time() const { return static_cast<double>(steps) * scene.step; }
  BodyState driven(const Moving& m) const;
  void drive();
  void prepare_joints();
  void push();
  void find_contacts();
  std::vector<PairQuestion> find_pairs();
  void add_contacts(const PairContact& contact);
  void add_ode_contacts(int a, int b);
  void add_joint(int a, int b, dContactGeom geom);
  void move();
  void read_states(const std::vector<Vec3>& free_angular_velocities);
  void place_bodies(const Moving& m);
  Vec3 impending_slip(int a, int b, const Vec3& position) const;
  dBodyID ode_body(int body) const { return moving[assembly_of[body]].body; }

  Scene scene;
  Touching may_touch;
  ContactModel& model;
  dWorldID world;
  dJointGroupID contact_joints;
  std::vector<Moving> moving;
  std::vector<std::size_t> assembly_of;  ///< by body: index of its assembly
  OdeMeshes meshes;                      ///< of the geoms
  std::vector<dGeomID> geoms;            ///< by body; null where it is a cylinder
  std::vector<BodyState> states;         ///< by body
  std::vector<OdeJoint> joints;          ///< hinges and sliders
  std::vector<PairContact> contacts;
  std::size_t points = 0;  ///< contact joints of this step
  std::uint64_t steps = 0;
  std::size_t unusable = 0;
  bool sound = true;
};

World::State::State(const Scene& given, ContactModel& contact_model)
    : scene(given),
      may_touch((check_scene(given), given)),
      model(contact_model),
      world((initialise_ode(), dWorldCreate())),
      contact_joints(dJointGroupCreate(0)),
      assembly_of(given.bodies.size()),
      geoms(given.bodies.size()) {
  dWorldSetGravity(world, scene.gravity.x(), scene.gravity.y(), scene.gravity.z());
  dWorldSetERP(world, error_reduction);
  dWorldSetContactSurfaceLayer(world, scene.surface_layer);
  dWorldSetAutoDisableFlag(world, 0);
  dWorldSetQuickStepNumIterations(world, scene.solver_iterations);
  for (const Body& b : scene.bodies) states.push_back({b.pose, Vec3::Zero(), Vec3::Zero()});
  for (const Assembly& assembly : assemblies(scene)) make_assembly(assembly);
  double heaviest = 0;
  for (const Moving& m : moving) heaviest = std::max(heaviest, m.assembly.inertia.mass);
  if (heaviest > 0) dWorldSetCFM(world, constraint_mixing / heaviest);
  for (const Joint& joint : scene.joints) {
    if (joint.kind == JointKind::fixed) continue;  // assemblies obey it
    const dBodyID other = joint.b == world_body ? nullptr : ode_body(joint.b);
    joints.emplace_back(world, joint, ode_body(joint.a), other);
  }
  model.begin();
}

World::State::~State() {
  dJointGroupDestroy(contact_joints);
  for (const dGeomID geom : geoms) {
    if (geom) dGeomDestroy(geom);
  }
  dWorldDestroy(world);
}

void World::State::make_assembly(const Assembly& assembly) {
  const BodyState state = start_of(assembly, scene);
  const dBodyID body = make_ode_body(world, assembly);
  if (assembly.is_free()) {
    dBodySetFiniteRotationMode(body, 1);  // exact finite rotations
    dBodySetGyroscopicMode(body, 0);      // see move
  }
  if (body) place(body, state);
  moving.push_back(
      {assembly, body, state, spin(state.pose, assembly.inertia, state.angular_velocity)});
  for (std::size_t i = 0; i < assembly.bodies.size(); ++i) {
    const int b = assembly.bodies[i];
    assembly_of[b] = moving.size() - 1;
    if (std::holds_alternative<Cylinder>(scene.bodies[b].shape)) continue;
    const Body& made = scene.bodies[b];
    geoms[b] =
        make_ode_geom(nullptr, made.shape, body, body ? assembly.X_FB[i] : made.pose, meshes);
  }
  place_bodies(moving.back());
}

/// State of a driven assembly after this step.
BodyState World::State::driven(const Moving& m) const {
  const Body& body = scene.bodies[m.assembly.driven];
  return driven_state(*body.drive, body.pose, time() + scene.step, scene.step);
}

/// Gives driven assemblies the velocities that lead them to where they shall be after this step.
void World::State::drive() {
  for (Moving& m : moving) {
    if (m.assembly.fixed || m.assembly.driven < 0) continue;
    const BodyState next = driven(m);
    m.state = {m.state.pose, next.velocity, next.angular_velocity};
    place(m.body, m.state);
    place_bodies(m);
  }
}

void World::State::prepare_joints() {
  for (OdeJoint& joint : joints) joint.prepare(time(), scene.step);
}

void World::State::push() {
  for (const Push& p : scene.pushes) {
    const double share = p.share(time(), scene.step);
    if (share == 0) continue;
    const dBodyID body = ode_body(p.body);
    const Vec3 &at = states[p.body].pose.position(), force = share * p.force,
               torque = share * p.torque;
    dBodyAddForceAtPos(body, force.x(), force.y(), force.z(), at.x(), at.y(), at.z());
    dBodyAddTorque(body, torque.x(), torque.y(), torque.z());
  }
}

/// All pairs with overlapping boxes: those with a cylinder as questions, the contacts of all others
/// at once. Scenes have few bodies, and testing a pair takes a nanosecond: no broad phase.
std::vector<PairQuestion> World::State::find_pairs() {
  const int count = static_cast<int>(states.size());
  std::vector<Aabb> boxes;
  for (int i = 0; i < count; ++i) {
    boxes.push_back(candidate_box(scene.bodies[i].shape, states[i].pose));
  }
  std::map<std::pair<int, int>, Vec3> previous;
  for (const PairContact& c : contacts) {
    const Vec3 normal(c.answer.normal);
    constexpr double rounding = 1e-6;  // a candidate may answer in single precision
    if (c.answer.status == TS_CONTACT && std::abs(normal.squaredNorm() - 1) < rounding) {
      previous.insert({{c.a, c.b}, normal});
    }
  }
  std::vector<PairQuestion> questions;
  for (int i = 0; i < count; ++i) {
    for (int j = i + 1; j < count; ++j) {
      if (!may_touch(i, j) || !boxes[i].overlaps(boxes[j])) continue;
      const bool i_is_cylinder = !geoms[i];
      if (!i_is_cylinder && geoms[j]) {
        add_ode_contacts(i, j);
        continue;
      }
      const int a = i_is_cylinder ? i : j, b = i_is_cylinder ? j : i;
      questions.push_back({a,
                           b,
                           {std::get<Cylinder>(scene.bodies[a].shape), states[a].pose,
                            scene.bodies[b].shape, states[b].pose}});
      if (const auto found = previous.find({a, b}); found != previous.end()) {
        questions.back().previous_normal = found->second;
      }
    }
  }
  return questions;
}

void World::State::find_contacts() {
  dJointGroupEmpty(contact_joints);
  points = 0;
  const std::vector<PairQuestion> questions = find_pairs();
  contacts.clear();
  if (questions.empty()) return;
  auto answers = model.answers(questions);
  for (std::size_t i = 0; i < questions.size(); ++i) {
    if (answers[i].status == TS_NONE) continue;
    contacts.push_back({questions[i].a, questions[i].b, std::move(answers[i])});
    if (contacts.back().answer.status == TS_CONTACT) add_contacts(contacts.back());
  }
}

void World::State::add_contacts(const PairContact& contact) {
  for (int i = 0; i < contact.answer.point_count; ++i) {
    const ts_point& p = contact.answer.points[i];
    const Vec3 position(p.position), normal(p.normal);
    const double length = normal.norm();
    if (!position.allFinite() || !std::isfinite(p.depth) ||
        !(length > 0 && length < max_in_world)) {
      ++unusable;
      continue;
    }
    if (p.depth < simulation_threshold) continue;  // ODE would stop bodies that are still apart
    dContactGeom geom{};
    for (int k = 0; k < 3; ++k) {
      geom.pos[k] = position[k];
      geom.normal[k] = normal[k] / length;
    }
    geom.depth = p.depth;
    add_joint(contact.a, contact.b, geom);
  }
}

void World::State::add_ode_contacts(int a, int b) {
  constexpr int max_points = 256;  // a hull has one at each corner that is in a plane
  dContactGeom found[max_points];
  const int count = dCollide(geoms[a], geoms[b], max_points, found, sizeof(dContactGeom));
  for (int i = 0; i < count; ++i) add_joint(a, b, found[i]);
}

/// Velocity of the surface of body a relative to that of body b at the end of the step without the
/// contact, which friction acts against.
Vec3 World::State::impending_slip(int a, int b, const Vec3& position) const {
  const auto velocity = [&](int i) {
    const Moving& m = moving[assembly_of[i]];
    if (!m.body) return Vec3(Vec3::Zero());
    const BodyState& s = states[i];
    Vec3 v = s.velocity + s.angular_velocity.cross(position - s.pose.position());
    if (m.assembly.is_free()) v += scene.step * scene.gravity;
    return v;
  };
  return velocity(a) - velocity(b);
}

void World::State::add_joint(int a, int b, dContactGeom geom) {
  dContact contact{};
  contact.geom = geom;
  set_materials(contact, scene.bodies[a].material, scene.bodies[b].material);
  const Vec3 normal(geom.normal);
  const auto along = [&](const Vec3& v) { return Vec3(v - v.dot(normal) * normal); };
  const auto surface_velocity = [&](int i) {
    return Vec3(states[i].pose.rotation() * scene.bodies[i].surface_velocity);
  };
  const Vec3 belt = along(surface_velocity(a) - surface_velocity(b));
  Vec3 tangential = along(impending_slip(a, b, Vec3(geom.pos))) + belt;
  const bool has_belt = belt.norm() > min_slip;
  if (has_belt && !(tangential.norm() > min_slip)) tangential = belt;
  const dBodyID body_a = ode_body(a), body_b = ode_body(b);
  if (const double speed = tangential.norm(); speed > min_slip) {
    contact.surface.mode |= dContactFDir1;
    for (int k = 0; k < 3; ++k) contact.fdir1[k] = tangential[k] / speed;
  }
  if (has_belt) set_belt(contact, belt, !body_a);
  const dJointID joint = dJointCreateContact(world, contact_joints, &contact);
  dJointAttach(joint, body_a, body_b);
  ++points;
}

/// ODE starts from the mean angular velocity of the step without contacts, adds the change that
/// contacts make, and rotates the body by the sum. Its own gyroscopic torque, which is off, loses
/// energy and angular momentum.
void World::State::move() {
  std::vector<Vec3> free(moving.size(), Vec3::Zero());
  for (std::size_t i = 0; i < moving.size(); ++i) {
    const Moving& m = moving[i];
    if (!m.assembly.is_free()) continue;
    free[i] = free_angular_velocity(m.state.pose, m.assembly.inertia, m.spin, scene.step);
    dBodySetAngularVel(m.body, free[i].x(), free[i].y(), free[i].z());
  }
  dRandSetSeed(steps + 1);
  dWorldQuickStep(world, scene.step);
  for (OdeJoint& joint : joints) joint.follow(scene.step);
  read_states(free);
}

void World::State::read_states(const std::vector<Vec3>& free_angular_velocities) {
  std::vector<BodyState> read(moving.size());
  for (std::size_t i = 0; i < moving.size(); ++i) {
    const Moving& m = moving[i];
    if (m.assembly.fixed) continue;
    try {
      read[i] = m.assembly.is_free() ? state_of(m.body) : driven(m);
    } catch (const InvalidInput&) {  // not a number
      sound = false;
      return;
    }
    for (const Vec3& v : {read[i].pose.position(), read[i].velocity, read[i].angular_velocity}) {
      if (!(v.norm() < max_in_world)) sound = false;
    }
  }
  if (!sound) return;
  for (std::size_t i = 0; i < moving.size(); ++i) {
    Moving& m = moving[i];
    if (m.assembly.fixed) continue;
    if (m.assembly.is_free()) {
      m.spin += spin(m.state.pose, m.assembly.inertia,
                     read[i].angular_velocity - free_angular_velocities[i]);
      read[i].angular_velocity = angular_velocity(read[i].pose, m.assembly.inertia, m.spin);
    }
    m.state = read[i];
    place_bodies(m);
  }
}

void World::State::place_bodies(const Moving& m) {
  for (std::size_t i = 0; i < m.assembly.bodies.size(); ++i) {
    states[m.assembly.bodies[i]] = state_within(m.state, m.assembly.X_FB[i]);
  }
}

std::vector<Answer> CandidateModel::answers(std::span<const PairQuestion> questions) {
  std::vector<Configuration> configurations;
  std::vector<const Vec3*> previous_normals;
  for (const PairQuestion& q : questions) {
    configurations.push_back(q.configuration);
    previous_normals.push_back(q.previous_normal ? &*q.previous_normal : nullptr);
  }
  auto result = process_.answer(configurations, previous_normals);
  for (std::size_t i = 0; i < result.size() && unsupported_ == Unsupported::refused; ++i) {
    if (result[i].status != TS_UNSUPPORTED) continue;
    throw InvalidInput("candidate", '"' + process_.candidate().name + '"',
                       std::string("must have a routine for ") +
                           pair_name(pair_of(configurations[i])) +
                           ", such bodies come near each other in the scene");
  }
  return result;
}

World::World(const Scene& scene, ContactModel& model)
    : state_(std::make_unique<State>(scene, model)) {}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

void World::step() {
  State& s = *state_;
  if (s.sound) {
    s.drive();
    s.prepare_joints();
    s.push();
    s.find_contacts();
    s.move();
  }
  ++s.steps;
}

double World::time() const { return state_->time(); }
const std::vector<BodyState>& World::states() const { return state_->states; }
const std::vector<PairContact>& World::contacts() const { return state_->contacts; }
std::size_t World::points() const { return state_->points; }
bool World::sound() const { return state_->sound; }
std::size_t World::unusable_points() const { return state_->unusable; }

double World::kinetic_energy() const {
  double sum = 0;
  for (const auto& m : state_->moving) {
    sum += touchstone::kinetic_energy(m.state, m.assembly.inertia);
  }
  return sum;
}

Vec3 World::momentum() const {
  Vec3 sum = Vec3::Zero();
  for (const auto& m : state_->moving) sum += m.assembly.inertia.mass * m.state.velocity;
  return sum;
}

Vec3 World::angular_momentum() const {
  Vec3 sum = Vec3::Zero();
  for (const auto& m : state_->moving) {
    sum += m.assembly.inertia.mass * m.state.pose.position().cross(m.state.velocity) + m.spin;
  }
  return sum;
}

}  // namespace touchstone
