#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "candidates/host/candidate_process.hpp"
#include "simulation/scene.hpp"

namespace touchstone {

/// Two bodies of a scene, by index, whose bounding boxes overlap. Body a is a cylinder; of two
/// cylinders, the one with the smaller index.
struct PairQuestion {
  int a, b;
  Configuration configuration;
  /// Normal of the same pair in the previous step if it was in contact: a hint to the candidate.
  std::optional<Vec3> previous_normal = {};
};

/// Source of the contacts of pairs with a cylinder.
class ContactModel {
 public:
  virtual ~ContactModel() = default;
  /// Called once before a scene begins; forgets what earlier scenes asked.
  virtual void begin() = 0;
  /// One answer for each question of a step, in order.
  virtual std::vector<Answer> answers(std::span<const PairQuestion> questions) = 0;
};

/// Contact threshold of the candidates, metres: none that do not touch, because ODE stops bodies at
/// every contact that it is given.
inline constexpr double simulation_threshold = 0;

/// What a model makes of a pair that its candidate has no routine for.
enum class Unsupported {
  answered,  ///< the answer says so: who asks has to look at it
  refused    ///< InvalidInput (field "candidate"): bodies would pass through each other
};

/// One candidate for all pairs. Its process must outlive the model, serve nobody else while a scene
/// runs, and have the contact threshold `simulation_threshold`.
class CandidateModel : public ContactModel {
 public:
  explicit CandidateModel(CandidateProcess& process,
                          Unsupported unsupported = Unsupported::answered)
      : process_(process), unsupported_(unsupported) {}
  void begin() override { process_.restart(); }
  std::vector<Answer> answers(std::span<const PairQuestion> questions) override;

 private:
  CandidateProcess& process_;
  Unsupported unsupported_;
};

/// Answer of the contact model for one pair of bodies, named as in PairQuestion.
struct PairContact {
  int a, b;
  Answer answer;
};

/// Constraint force mixing times the mass of the heaviest body, s⁻¹ (ODE's CFM is a speed per
/// force).
inline constexpr double constraint_mixing = 1e-10;

/// A scene in motion: ODE moves the bodies; contacts of pairs with a cylinder come from the contact
/// model, those of all other pairs from ODE's own routines.
///
/// A step finds contacts, solves for velocities (dWorldQuickStep; Coulomb's cone as a pyramid
/// aligned with the impending slip), and moves the bodies by them: semi-implicit Euler. Contacts
/// are hard (`constraint_mixing`); a fifth of the depth beyond the scene's surface layer is
/// corrected in a step (ERP 0.2). All candidates get the same settings, and the motion depends on
/// the scene and the answers alone. (dWorldStep would be more accurate for one body, but gives up
/// where friction meets redundant points, as in a stack.)
class World {
 public:
  /// Throws InvalidInput as check_scene does. The model must outlive the world.
  World(const Scene& scene, ContactModel& model);
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  void step();
  double time() const;  ///< s
  const std::vector<BodyState>& states() const;
  /// All pairs of the last step whose answer is not "none", failures included.
  const std::vector<PairContact>& contacts() const;
  /// Contact points given to the solver in the last step, of all pairs.
  std::size_t points() const;

  /// False once a position or velocity has left `max_in_world` or is not finite, through contacts
  /// that no solver can satisfy; the bodies then stay where they last were.
  bool sound() const;
  /// Contact points ignored because their position, normal or depth is not a number.
  std::size_t unusable_points() const;

  double kinetic_energy() const;  ///< J, of the bodies that are not fixed
  Vec3 momentum() const;          ///< kg m/s
  Vec3 angular_momentum() const;  ///< kg m²/s, about the origin

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace touchstone
