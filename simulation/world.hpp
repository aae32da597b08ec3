#pragma once

#include <memory>
#include <vector>

#include "simulation/contact_model.hpp"
#include "simulation/motion.hpp"
#include "simulation/scene.hpp"

namespace touchstone {

/// CFM times the heaviest body's mass, s⁻¹ (ODE's CFM is a speed for a force).
inline constexpr double constraint_mixing = 1e-10;

/// What the contact model answered for two bodies in the last step; bodies as in PairQuestion.
struct PairContact {
  int a, b;
  Answer answer;
};

/// A scene in motion: ODE moves the bodies; contacts of pairs with a cylinder come from the contact
/// model, those of all other pairs from ODE's own routines.
///
/// A step finds contacts, solves for velocities (dWorldQuickStep; Coulomb's cone as a pyramid along
/// the slip to come), and moves the bodies by them: semi-implicit Euler. Contacts are
/// hard (`constraint_mixing`); a fifth of the depth beyond the scene's surface
/// layer is taken back in a step (ERP 0.2). All candidates get the same settings. What it does
/// depends on the scene and the answers alone. docs/simulation.md says why.
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
  /// All pairs that were asked in the last step and are not apart, crashes included.
  const std::vector<PairContact>& contacts() const;

  /// False once the motion has become absurd (beyond 1e6 m or m/s, or not finite) through contacts
  /// that no solver can satisfy; the bodies then stay where they last were.
  bool sound() const;
  /// Points that were not used because their position, normal or depth is no number.
  std::size_t unusable_points() const;

  double kinetic_energy() const;    ///< J, of the bodies that are not fixed
  double potential_energy() const;  ///< J, of gravity; zero at the origin
  Vec3 momentum() const;            ///< kg m/s
  Vec3 angular_momentum() const;    ///< kg m²/s, about the origin

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace touchstone
