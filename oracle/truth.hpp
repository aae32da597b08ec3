#pragma once

#include <array>
#include <gmpxx.h>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "oracle/enclosure.hpp"
#include "reference/configuration.hpp"

namespace touchstone::oracle {

/// Exact relation of an optimal normal to one of a body's own axes; no tolerance is involved.
enum class Alignment { oblique, parallel, perpendicular };

/// One direction that reaches the signed distance.
struct OptimalNormal {
  Vec3 n;  ///< unit, from B to A, in world coordinates, to within a few ulp
  /// Relation to body A's axis, and to body B's x, y and z axes. A shape of revolution has only z;
  /// all others, and those of planes, spheres and convex bodies, stay oblique.
  Alignment to_a = Alignment::oblique;
  std::array<Alignment, 3> to_b{};
  /// The vertices of a convex body B that lie exactly on its support plane along n, in the order of
  /// their numbers. Empty for other shapes.
  std::vector<int> support_b = {};
};

/// A continuous family of optimal normals. World coordinates, unit vectors.
struct NormalFamily {
  enum class Kind {
    circle,  ///< all normals perpendicular to `axis`
    arc,     ///< the part of that circle from ends[0] to ends[1], right-handed about `axis`
    curve    ///< normals of two rims at constant distance; no closed form is given
  };
  Kind kind;
  Vec3 axis = Vec3::Zero();
  std::vector<Vec3> ends;
};

/// How many directions reach the signed distance.
enum class Ties { unique, finite, continuum };

/// The exact answer for one configuration.
struct Truth {
  /// Metres; positive apart, negative inside. If the bodies touch exactly, both ends are zero;
  /// otherwise zero lies outside. The exception: neither contact nor the sign could be proven. The
  /// ends are then ±2^-1000 of the larger size, or ±2^-184 if numbers had to be rounded (see
  /// below).
  Enclosure signed_distance;
  /// The critical directions that reach it or tie with one that does, each once; at least one of
  /// each family.
  std::vector<OptimalNormal> normals;
  Ties ties;
  /// The families to which some of `normals` belong.
  std::vector<NormalFamily> families;
};

/// Signed distance and optimal normals by exact critical directions (see oracle/truth.md). The
/// enclosure is no wider than `width` times the larger size, and its sign is decided. It depends on
/// the geometry alone: an exact common rotation, a translation, an exchange of the bodies leave it
/// as it is, a scaling by a power of two scales it. `normals` are those that tie: their gaps are
/// within max(2^-20 `width`, `tie`) times the larger size of the signed distance. Gaps are refined
/// until every tie is decided, so that ties too depend on the geometry alone.
///
/// Against a capsule, cylinder, box or convex body, lengths are rounded to multiples of 2^-192 of
/// the larger size and orientations to as many bits (rounding.hpp); a narrower `width` keeps more.
/// The enclosure is valid for the exact configuration; normals, ties and alignments are those of
/// the rounded one, and bodies that touch to within 2^-184 of the size have zero in their
/// enclosure. This bounds the time for any finite numbers to about 50 ms at the width 1e-30;
/// against a convex body of 8 vertices to 400 ms, and for numbers of moderate size as truth.md
/// says.
///
/// Throws InvalidInput unless 0 < width; std::logic_error if its own bounds contradict each other.
Truth truth(const Configuration& configuration, double width = 1e-30, double tie = 0);

/// The same once A has moved by t times `sweep` (metres, world), exactly, which no double may hold.
Truth truth_at(const Configuration& configuration, const Vec3& sweep, const mpq_class& t,
               double width = 1e-30, double tie = 0);

/// Encloses the gap g(n/|n|) of the exact configuration along a vector n of doubles, finite and not
/// zero. The width is at most `width` times the larger size. A half-space has a finite gap only
/// along its own normal, which no engine answers to the last bit. For a plane, g is therefore taken
/// against the column of the half-space beneath the cylinder's circumsphere, two circumradii deep:
/// a tilted normal costs as much as it matters to this cylinder.
Enclosure certified_gap(const Configuration& configuration, const Vec3& n, double width = 1e-15);

/// Normal regret max(0, σ − g(n)) in metres, to within the widths of truth and gap.
double normal_regret(const Configuration& configuration, const Truth& truth, const Vec3& n);

/// Gaps and regrets of one configuration along any number of directions: the same numbers as
/// certified_gap and normal_regret, at a fraction of the cost, since what depends on configuration
/// and truth alone is made once, and the regret along equal directions, too.
class Regrets {
 public:
  Regrets(const Configuration& configuration, const Truth& truth);
  Regrets(Regrets&&) noexcept;
  ~Regrets();

  Enclosure gap(const Vec3& n);
  double of(const Vec3& n);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The libraries that the truth is computed with, as in "MPFR 4.2.0": for those that are linked
/// dynamically, the version at run time.
std::vector<std::string> libraries();

}  // namespace touchstone::oracle
