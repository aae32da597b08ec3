#include "simulation/world.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <ode/ode.h>
#include <utility>

#include "candidates/ode_library.hpp"
#include "reference/invalid_input.hpp"
#include "reference/support.hpp"

namespace touchstone {
namespace {

constexpr double error_reduction = 0.2;  // ERP
/// Impact speed below which nothing bounces, m/s.
constexpr double min_bounce_speed = 0.01;
/// Slip below which its direction is rounding, and any direction serves, m/s.
constexpr double min_slip = 1e-12;

/// Box that contains every candidate's model of the shape: some put round ends on a cylinder.
Aabb candidate_box(const Shape& shape, const Pose& pose) {
  if (const auto* c = std::get_if<Cylinder>(&shape)) {
    return aabb(Capsule(c->radius(), c->half_length()), pose);
  }
  return aabb(shape, pose);
}

/// ODE's shape of a body, in the body's frame; null for a cylinder, whose contacts come from the
/// contact model.
struct MakeGeom {
  dGeomID operator()(const Cylinder&) const { return nullptr; }
  dGeomID operator()(const Plane& s) const {
    return dCreatePlane(nullptr, s.normal().x(), s.normal().y(), s.normal().z(), s.displacement());
  }
  dGeomID operator()(const Sphere& s) const { return dCreateSphere(nullptr, s.radius()); }
  dGeomID operator()(const Capsule& s) const {
    return dCreateCapsule(nullptr, s.radius(), 2 * s.half_length());
  }
  dGeomID operator()(const Box& s) const {
    const Vec3 side = 2 * s.half_extents();
    return dCreateBox(nullptr, side.x(), side.y(), side.z());
  }
};

/// The posed plane in world coordinates: ODE's planes have no pose.
Plane in_world(const Plane& plane, const Pose& pose) {
  const Vec3 normal = (pose.rotation() * plane.unit_normal()).normalized();
  return Plane(normal, plane.unit_displacement() + normal.dot(pose.position()));
}

struct OdeQuaternion {
  explicit OdeQuaternion(const Pose& pose) {
    const Eigen::Quaterniond q = pose.unit_orientation();
    wxyz[0] = q.w(), wxyz[1] = q.x(), wxyz[2] = q.y(), wxyz[3] = q.z();
  }
  dQuaternion wxyz;
};

dBodyID make_ode_body(dWorldID world, const Body& body, const Inertia& inertia) {
  const dBodyID made = dBodyCreate(world);
  const Vec3 &p = body.pose.position(), &v = body.velocity, &w = body.angular_velocity;
  const Vec3& i = inertia.principal;
  dMass mass;
  dMassSetParameters(&mass, inertia.mass, 0, 0, 0, i.x(), i.y(), i.z(), 0, 0, 0);
  dBodySetMass(made, &mass);
  dBodySetPosition(made, p.x(), p.y(), p.z());
  dBodySetQuaternion(made, OdeQuaternion(body.pose).wxyz);
  dBodySetLinearVel(made, v.x(), v.y(), v.z());
  dBodySetAngularVel(made, w.x(), w.y(), w.z());
  dBodySetFiniteRotationMode(made, 1);  // exact finite rotations
  dBodySetGyroscopicMode(made, 0);      // see World::State::move
  return made;
}

/// A geometry that follows `moving`, or stays at the body's pose if that is null.
dGeomID make_ode_geom(const Body& body, dBodyID moving) {
  if (const auto* plane = std::get_if<Plane>(&body.shape)) {
    return MakeGeom{}(in_world(*plane, body.pose));
  }
  const dGeomID made = std::visit(MakeGeom{}, body.shape);
  if (!made) return nullptr;
  if (moving) {
    dGeomSetBody(made, moving);
    return made;
  }
  const Vec3& p = body.pose.position();
  dGeomSetPosition(made, p.x(), p.y(), p.z());
  dGeomSetQuaternion(made, OdeQuaternion(body.pose).wxyz);
  return made;
}

BodyState state_of(dBodyID body) {
  const auto vector = [](const dReal* v) { return Vec3(v[0], v[1], v[2]); };
  const dReal* q = dBodyGetQuaternion(body);
  return {Pose(vector(dBodyGetPosition(body)), Eigen::Quaterniond(q[0], q[1], q[2], q[3])),
          vector(dBodyGetLinearVel(body)), vector(dBodyGetAngularVel(body))};
}

}  // namespace

struct World::State {
  State(const Scene& given, ContactModel& contact_model);
  ~State();
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  void make_body(const Body& body);
  void find_contacts();
  std::vector<PairQuestion> find_pairs();
  void add_contacts(const PairContact& contact);
  void add_ode_contacts(int a, int b);
  void add_joint(int a, int b, dContactGeom geom);
  void move();
  void read_states(const std::vector<Vec3>& free_angular_velocities);
  Vec3 impending_slip(int a, int b, const Vec3& position) const;

  Scene scene;
  ContactModel& model;
  dWorldID world;
  dJointGroupID joints;
  std::vector<dBodyID> bodies;  ///< null where the body is fixed
  std::vector<dGeomID> geoms;   ///< null where it is a cylinder
  std::vector<Inertia> inertias;
  std::vector<BodyState> states;
  std::vector<Vec3> spins;  ///< about the bodies' centres
  std::vector<PairContact> contacts;
  std::uint64_t steps = 0;
  std::size_t unusable = 0;
  bool sound = true;
};

World::State::State(const Scene& given, ContactModel& contact_model)
    : scene(given),
      model(contact_model),
      world((check_scene(given), initialise_ode(), dWorldCreate())),
      joints(dJointGroupCreate(0)) {
  dWorldSetGravity(world, scene.gravity.x(), scene.gravity.y(), scene.gravity.z());
  dWorldSetERP(world, error_reduction);
  dWorldSetContactSurfaceLayer(world, scene.surface_layer);
  dWorldSetAutoDisableFlag(world, 0);
  dWorldSetQuickStepNumIterations(world, scene.solver_iterations);
  for (const Body& body : scene.bodies) make_body(body);
  double heaviest = 0;
  for (const Inertia& i : inertias) heaviest = std::max(heaviest, i.mass);
  if (heaviest > 0) dWorldSetCFM(world, constraint_mixing / heaviest);
  model.begin();
}

World::State::~State() {
  dJointGroupDestroy(joints);
  for (const dGeomID geom : geoms) {
    if (geom) dGeomDestroy(geom);
  }
  dWorldDestroy(world);
}

void World::State::make_body(const Body& body) {
  const Vec3 zero = Vec3::Zero();
  inertias.push_back(body.fixed ? Inertia{0, zero} : inertia(body.shape, body.density));
  bodies.push_back(body.fixed ? nullptr : make_ode_body(world, body, inertias.back()));
  geoms.push_back(make_ode_geom(body, bodies.back()));
  states.push_back(
      {body.pose, body.fixed ? zero : body.velocity, body.fixed ? zero : body.angular_velocity});
  spins.push_back(spin(body.pose, inertias.back(), states.back().angular_velocity));
}

/// All pairs with overlapping boxes: those with a cylinder as questions, the contacts of all others
/// at once. Scenes have few bodies, and testing a pair takes a nanosecond: no broad phase.
std::vector<PairQuestion> World::State::find_pairs() {
  const int count = static_cast<int>(bodies.size());
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
      if (!(bodies[i] || bodies[j]) || !boxes[i].overlaps(boxes[j])) continue;
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
  dJointGroupEmpty(joints);
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
  constexpr int max_points = 16;
  dContactGeom found[max_points];
  const int count = dCollide(geoms[a], geoms[b], max_points, found, sizeof(dContactGeom));
  for (int i = 0; i < count; ++i) add_joint(a, b, found[i]);
}

/// Velocity of body a relative to body b at the end of the step without the contact, which friction
/// acts against.
Vec3 World::State::impending_slip(int a, int b, const Vec3& position) const {
  const auto velocity = [&](int i) {
    if (!bodies[i]) return Vec3(Vec3::Zero());
    const BodyState& s = states[i];
    return Vec3(s.velocity + s.angular_velocity.cross(position - s.pose.position()) +
                scene.step * scene.gravity);
  };
  return velocity(a) - velocity(b);
}

void World::State::add_joint(int a, int b, dContactGeom geom) {
  const Material &material_a = scene.bodies[a].material, &material_b = scene.bodies[b].material;
  dContact contact{};
  contact.geom = geom;
  contact.surface.mode = dContactApprox1;
  contact.surface.mu = std::sqrt(material_a.friction * material_b.friction);
  if (const double bounce = std::max(material_a.restitution, material_b.restitution); bounce > 0) {
    contact.surface.mode |= dContactBounce;
    contact.surface.bounce = bounce;
    contact.surface.bounce_vel = min_bounce_speed;
  }
  const Vec3 normal(geom.normal), slip = impending_slip(a, b, Vec3(geom.pos));
  const Vec3 tangential = slip - slip.dot(normal) * normal;
  if (const double speed = tangential.norm(); speed > min_slip) {
    contact.surface.mode |= dContactFDir1;
    for (int k = 0; k < 3; ++k) contact.fdir1[k] = tangential[k] / speed;
  }
  const dJointID joint = dJointCreateContact(world, joints, &contact);
  dJointAttach(joint, bodies[a], bodies[b]);
}

/// ODE starts from the mean angular velocity of the step without contacts, adds the change that
/// contacts make, and rotates the body by the sum. Its own gyroscopic torque, which is off, loses
/// energy and angular momentum.
void World::State::move() {
  std::vector<Vec3> free(bodies.size(), Vec3::Zero());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!bodies[i]) continue;
    free[i] = free_angular_velocity(states[i].pose, inertias[i], spins[i], scene.step);
    dBodySetAngularVel(bodies[i], free[i].x(), free[i].y(), free[i].z());
  }
  dRandSetSeed(steps);
  dWorldQuickStep(world, scene.step);
  read_states(free);
}

void World::State::read_states(const std::vector<Vec3>& free_angular_velocities) {
  std::vector<BodyState> read = states;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!bodies[i]) continue;
    try {
      read[i] = state_of(bodies[i]);
    } catch (const InvalidInput&) {  // not a number
      sound = false;
      return;
    }
    for (const Vec3& v : {read[i].pose.position(), read[i].velocity, read[i].angular_velocity}) {
      if (!(v.norm() < max_in_world)) sound = false;
    }
  }
  if (!sound) return;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!bodies[i]) continue;
    spins[i] +=
        spin(states[i].pose, inertias[i], read[i].angular_velocity - free_angular_velocities[i]);
    read[i].angular_velocity = angular_velocity(read[i].pose, inertias[i], spins[i]);
  }
  states = std::move(read);
}

std::vector<Answer> CandidateModel::answers(std::span<const PairQuestion> questions) {
  std::vector<Configuration> configurations;
  std::vector<const Vec3*> previous_normals;
  for (const PairQuestion& q : questions) {
    configurations.push_back(q.configuration);
    previous_normals.push_back(q.previous_normal ? &*q.previous_normal : nullptr);
  }
  return process_.answer(configurations, previous_normals);
}

World::World(const Scene& scene, ContactModel& model)
    : state_(std::make_unique<State>(scene, model)) {}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

void World::step() {
  State& s = *state_;
  ++s.steps;
  if (!s.sound) return;
  s.find_contacts();
  s.move();
}

double World::time() const { return static_cast<double>(state_->steps) * state_->scene.step; }
const std::vector<BodyState>& World::states() const { return state_->states; }
const std::vector<PairContact>& World::contacts() const { return state_->contacts; }
bool World::sound() const { return state_->sound; }
std::size_t World::unusable_points() const { return state_->unusable; }

double World::kinetic_energy() const {
  double sum = 0;
  for (std::size_t i = 0; i < state_->states.size(); ++i) {
    sum += touchstone::kinetic_energy(state_->states[i], state_->inertias[i]);
  }
  return sum;
}

double World::potential_energy() const {
  double sum = 0;
  for (std::size_t i = 0; i < state_->states.size(); ++i) {
    sum -= state_->inertias[i].mass * state_->scene.gravity.dot(state_->states[i].pose.position());
  }
  return sum;
}

Vec3 World::momentum() const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < state_->states.size(); ++i) {
    sum += state_->inertias[i].mass * state_->states[i].velocity;
  }
  return sum;
}

Vec3 World::angular_momentum() const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < state_->states.size(); ++i) {
    const BodyState& s = state_->states[i];
    sum += state_->inertias[i].mass * s.pose.position().cross(s.velocity) + state_->spins[i];
  }
  return sum;
}

}  // namespace touchstone
