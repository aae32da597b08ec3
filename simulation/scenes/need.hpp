#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "simulation/scenes/trajectory.hpp"

namespace touchstone {

double degrees_between(const Vec3& u, const Vec3& v);

/// Outcome of a need in one run.
struct Verdict {
  double value;  ///< measured, in the unit of the limit; not finite if the run is not sound
  double limit;
  /// When the limit was first exceeded; for a need that holds, of the largest value; for one that
  /// is broken only because the run is not sound, the end of the run.
  double time;
  /// On which body or bodies of the scene that was, where the need does not say it; −1: none.
  std::array<int, 2> bodies = {-1, -1};

  bool holds() const { return value <= limit; }
  /// Value as a share of the limit; for a limit of zero, above one as soon as the need is broken.
  double share() const { return limit > 0 ? value / limit : value > 0 ? 1 + value : 0; }
};

/// Runs of one scene: the run to be judged and the run with exact contacts, which may be the same.
struct ComparedRuns {
  const Scene& scene;
  const Trajectory& run;
  const Trajectory& exact;
};

/// Visitor of the members that a need has in a scene file beside "need". One visitor reads them,
/// another describes them as JSON Schema. Bodies are indices into the scene, times seconds.
class NeedMembers {
 public:
  virtual ~NeedMembers() = default;
  virtual void body(std::vector<int>& bodies) = 0;           ///< "body": one
  virtual void bodies(std::vector<int>& bodies) = 0;         ///< "bodies": one or more
  virtual void moving_bodies(std::vector<int>& bodies) = 0;  ///< likewise; default: all that move
  virtual void pair(std::vector<int>& bodies) = 0;           ///< "bodies": two, one a cylinder
  virtual void any_pair(std::vector<int>& bodies) = 0;       ///< likewise; default: none
  virtual void number(const char* name, double& value) = 0;  ///< finite, not negative
  virtual void number_or_default(const char* name, double& value) = 0;
  virtual void positive(const char* name, std::optional<double>& value) = 0;  ///< default: none
  virtual void time_or_default(const char* name, double& value) = 0;  ///< within the duration
  virtual void point(const char* name, Vec3& value) = 0;
};

/// A requirement on the motion of a scene (docs/scenes.md). need.cpp has one class for each kind.
class Need {
 public:
  virtual ~Need() = default;

  const char* const name;     ///< in a scene file: "stands"
  const char* const meaning;  ///< in the schema, as a phrase
  const char* const unit;     ///< of value and limit, to stand after a number: "°", " m"
  std::vector<int> bodies;    ///< that the need names; empty: all pairs with a cylinder

  /// Visits the members in the order in which they are documented.
  virtual void visit(NeedMembers& members) = 0;
  /// Throws InvalidInput with the name of the member if the members do not suit the scene.
  virtual void check(const Scene&) const {}
  /// "can-1 stands within 0.5°"
  virtual std::string text(const Scene& scene) const = 0;
  /// Does it compare how a run ends with how one with exact contacts does? Two of these may be
  /// compared, too (spread.hpp).
  virtual bool is_relative() const { return false; }

  /// The same need with a limit of at least so much, if it is derived from a scene rather than
  /// read: nobody asked for just its own. Null for others, and where it would allow nearly
  /// anything.
  virtual std::shared_ptr<const Need> allowing(double) const { return nullptr; }

  /// Broken whatever it requires if the run is not sound.
  Verdict judge(const ComparedRuns& runs) const;

 protected:
  Need(const char* need_name, const char* need_meaning, const char* need_unit)
      : name(need_name), meaning(need_meaning), unit(need_unit) {}
  virtual Verdict measure(const ComparedRuns& runs) const = 0;
};

/// One need of each kind with its default members, in the order of docs/scenes.md.
std::vector<std::unique_ptr<Need>> all_needs();

/// To two digits, upwards: a limit that a person can read.
double readable_limit(double limit);

// Needs that are derived from a scene rather than read:

/// The true depth of the body in any other one, of pairs with a cylinder.
std::shared_ptr<const Need> penetration_need(int body, double metres);
std::shared_ptr<const Need> ends_near_need(int body, double metres);
std::shared_ptr<const Need> ends_tilted_need(int body, double degrees);

}  // namespace touchstone
