#include "simulation/world.hpp"

#include <algorithm>
#include <cmath>
#include <ode/ode.h>

#include "reference/aabb.hpp"
#include "simulation/inertia.hpp"

static_assert(sizeof(dReal) == sizeof(double), "built against single-precision ODE");

namespace touchstone {
namespace {

constexpr double error_reduction = 0.2;      // ERP
constexpr double constraint_mixing = 1e-10;  // CFM times the heaviest body's mass
/// Slower impacts do not bounce, m/s.
constexpr double least_bounce = 0.01;
/// Below this the direction of slip is rounding, m/s; any will do.
constexpr double least_slip = 1e-12;
constexpr double absurd = 1e6;

/// ODE's default handlers print and, for errors of its own, end the process.
void ignore_message(int, const char*, va_list) {}

void initialise() {
  static const bool done = [] {
    dInitODE2(0);
    dSetErrorHandler(nullptr);
    dSetMessageHandler(ignore_message);
    dAllocateODEDataForThread(dAllocateMaskAll);
    return true;
  }();
  (void)done;
}

Vec3 vector(const dReal* v) { return {v[0], v[1], v[2]}; }

struct MakeGeom {
  dGeomID operator()(const Cylinder&) const { return nullptr; }  // the contact model's
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

/// The posed plane as a shape of the world.
Plane in_world(const Plane& plane, const Pose& pose) {
  const Vec3 unit = plane.normal().stableNormalized();
  const Vec3 normal = (pose.rotation() * unit).normalized();
  return Plane(normal,
               plane.displacement() / plane.normal().stableNorm() + normal.dot(pose.position()));
}

/// What a cylinder may reach by any candidate: simplified models put round ends on top.
Aabb reach(const Shape& shape, const Pose& pose) {
  if (const auto* c = std::get_if<Cylinder>(&shape)) {
    return aabb(Capsule(c->radius(), c->half_length()), pose);
  }
  return aabb(shape, pose);
}

}  // namespace

struct World::State {
  State(const Scene& given, ContactModel& contact_model);
  ~State();
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  void make_body(const Body& body);
  void find_contacts();
  void add_contacts(const PairContact& contact);
  void add_others(int a, int b);
  void add_joint(int a, int b, dContactGeom geom);
  void read_states();
  Vec3 slip_to_come(int a, int b, const Vec3& position) const;

  Scene scene;
  ContactModel& model;
  dWorldID world;
  dJointGroupID joints;
  std::vector<dBodyID> bodies;  ///< null where the body is fixed
  std::vector<dGeomID> geoms;   ///< null where it is a cylinder
  std::vector<Inertia> inertias;
  std::vector<BodyState> states;
  std::vector<PairContact> contacts;
  std::uint64_t steps = 0;
  std::size_t unusable = 0;
  bool sound = true;
};

World::State::State(const Scene& given, ContactModel& contact_model)
    : scene(given),
      model(contact_model),
      world((check_scene(given), initialise(), dWorldCreate())),
      joints(dJointGroupCreate(0)) {
  dWorldSetGravity(world, scene.gravity.x(), scene.gravity.y(), scene.gravity.z());
  dWorldSetERP(world, error_reduction);
  dWorldSetContactSurfaceLayer(world, scene.surface_layer);
  dWorldSetAutoDisableFlag(world, 0);
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
  const Eigen::Quaterniond unit = body.pose.orientation().normalized();
  const dQuaternion q = {unit.w(), unit.x(), unit.y(), unit.z()};
  const Vec3& p = body.pose.position();
  dBodyID made = nullptr;
  if (!body.fixed) {
    made = dBodyCreate(world);
    const Inertia i = inertia(body.shape, body.density);
    dMass mass;
    dMassSetParameters(&mass, i.mass, 0, 0, 0, i.principal.x(), i.principal.y(), i.principal.z(), 0,
                       0, 0);
    dBodySetMass(made, &mass);
    dBodySetPosition(made, p.x(), p.y(), p.z());
    dBodySetQuaternion(made, q);
    dBodySetLinearVel(made, body.velocity.x(), body.velocity.y(), body.velocity.z());
    dBodySetAngularVel(made, body.angular_velocity.x(), body.angular_velocity.y(),
                       body.angular_velocity.z());
    dBodySetFiniteRotationMode(made, 1);  // turns by the whole angle, not by its tangent
  }
  dGeomID geom = nullptr;
  if (const auto* plane = std::get_if<Plane>(&body.shape)) {
    geom = MakeGeom{}(in_world(*plane, body.pose));
  } else {
    geom = std::visit(MakeGeom{}, body.shape);
    if (geom && made) dGeomSetBody(geom, made);
    if (geom && !made) {
      dGeomSetPosition(geom, p.x(), p.y(), p.z());
      dGeomSetQuaternion(geom, q);
    }
  }
  bodies.push_back(made);
  geoms.push_back(geom);
  inertias.push_back(body.fixed ? Inertia{0, Vec3::Zero()} : inertia(body.shape, body.density));
  states.push_back({body.pose, body.fixed ? Vec3(Vec3::Zero()) : body.velocity,
                    body.fixed ? Vec3(Vec3::Zero()) : body.angular_velocity});
}

void World::State::find_contacts() {
  dJointGroupEmpty(joints);
  const int count = static_cast<int>(bodies.size());
  std::vector<Aabb> boxes;
  for (int i = 0; i < count; ++i) boxes.push_back(reach(scene.bodies[i].shape, states[i].pose));

  // Every pair is looked at: scenes have few bodies, and a look costs a nanosecond.
  std::vector<PairQuestion> questions;
  for (int i = 0; i < count; ++i) {
    for (int j = i + 1; j < count; ++j) {
      if (!(bodies[i] || bodies[j]) || !boxes[i].overlaps(boxes[j])) continue;
      const bool i_is_cylinder = !geoms[i];
      if (!i_is_cylinder && geoms[j]) {
        add_others(i, j);
        continue;
      }
      const int a = i_is_cylinder ? i : j, b = i_is_cylinder ? j : i;
      questions.push_back({a,
                           b,
                           {std::get<Cylinder>(scene.bodies[a].shape), states[a].pose,
                            scene.bodies[b].shape, states[b].pose}});
    }
  }
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
    if (!position.allFinite() || !std::isfinite(p.depth) || !(length > 0 && length < absurd)) {
      ++unusable;
      continue;
    }
    if (p.depth < simulation_threshold) continue;  // ODE would stop what is still apart
    dContactGeom geom{};
    for (int k = 0; k < 3; ++k) {
      geom.pos[k] = position[k];
      geom.normal[k] = normal[k] / length;
    }
    geom.depth = p.depth;
    add_joint(contact.a, contact.b, geom);
  }
}

void World::State::add_others(int a, int b) {
  constexpr int most = 16;
  dContactGeom found[most];
  const int count = dCollide(geoms[a], geoms[b], most, found, sizeof(dContactGeom));
  for (int i = 0; i < count; ++i) add_joint(a, b, found[i]);
}

/// Of body a over body b, were there no contact: what friction has to act against.
Vec3 World::State::slip_to_come(int a, int b, const Vec3& position) const {
  const auto velocity = [&](int i) {
    if (!bodies[i]) return Vec3(Vec3::Zero());
    const BodyState& s = states[i];
    return Vec3(s.velocity + s.angular_velocity.cross(position - s.pose.position()) +
                scene.step * scene.gravity);
  };
  return velocity(a) - velocity(b);
}

void World::State::add_joint(int a, int b, dContactGeom geom) {
  const Material &of_a = scene.bodies[a].material, &of_b = scene.bodies[b].material;
  dContact contact{};
  contact.geom = geom;
  contact.surface.mode = dContactApprox1;
  contact.surface.mu = std::sqrt(of_a.friction * of_b.friction);
  if (const double bounce = std::max(of_a.restitution, of_b.restitution); bounce > 0) {
    contact.surface.mode |= dContactBounce;
    contact.surface.bounce = bounce;
    contact.surface.bounce_vel = least_bounce;
  }
  const Vec3 normal = vector(geom.normal), slip = slip_to_come(a, b, vector(geom.pos));
  const Vec3 along = slip - slip.dot(normal) * normal;
  if (const double speed = along.norm(); speed > least_slip) {
    contact.surface.mode |= dContactFDir1;
    for (int k = 0; k < 3; ++k) contact.fdir1[k] = along[k] / speed;
  }
  const dJointID joint = dJointCreateContact(world, joints, &contact);
  dJointAttach(joint, bodies[a], bodies[b]);
}

void World::State::read_states() {
  std::vector<BodyState> read = states;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!bodies[i]) continue;
    const Vec3 p = vector(dBodyGetPosition(bodies[i]));
    const Vec3 v = vector(dBodyGetLinearVel(bodies[i]));
    const Vec3 w = vector(dBodyGetAngularVel(bodies[i]));
    const dReal* q = dBodyGetQuaternion(bodies[i]);
    const Eigen::Quaterniond orientation(q[0], q[1], q[2], q[3]);
    for (const double x : {p.norm(), v.norm(), w.norm(), orientation.norm()}) {
      if (!(x < absurd)) sound = false;  // also when it is no number
    }
    if (!sound) return;
    read[i] = {Pose(p, orientation), v, w};
  }
  states = std::move(read);
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
  dRandSetSeed(s.steps);
  dWorldStep(s.world, s.scene.step);
  s.read_states();
}

double World::time() const { return static_cast<double>(state_->steps) * state_->scene.step; }
const std::vector<BodyState>& World::states() const { return state_->states; }
const std::vector<PairContact>& World::contacts() const { return state_->contacts; }
bool World::sound() const { return state_->sound; }
std::size_t World::unusable_points() const { return state_->unusable; }

double World::kinetic_energy() const {
  double sum = 0;
  for (std::size_t i = 0; i < state_->states.size(); ++i) {
    const BodyState& s = state_->states[i];
    const Inertia& m = state_->inertias[i];
    const Vec3 w = s.pose.rotation().transpose() * s.angular_velocity;
    sum += (m.mass * s.velocity.squaredNorm() + w.dot(m.principal.cwiseProduct(w))) / 2;
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
    const Inertia& m = state_->inertias[i];
    const auto& r = s.pose.rotation();
    sum += m.mass * s.pose.position().cross(s.velocity) +
           r * m.principal.cwiseProduct(r.transpose() * s.angular_velocity);
  }
  return sum;
}

}  // namespace touchstone
