#pragma once

#include <gmpxx.h>
#include <optional>

#include "oracle/difference.hpp"
#include "reference/configuration.hpp"

namespace touchstone::oracle {

/// A configuration rounded to the bits that an answer can show, and a bound of what rounding
/// changed.
struct RoundedConfiguration {
  Configuration configuration;
  /// Metres: the signed distances differ by no more than this. Zero if nothing was rounded.
  mpq_class error;
};

/// Bits that every truth and every contact patch keeps. Doubles within a factor of 2^139 of each
/// other lose nothing; neither do tilts of 1e-25.
inline constexpr int kept_bits = 192;

/// Rounds lengths to multiples of 2^-bits of the larger size (a size to at least one multiple), and
/// a quaternion's components to multiples of 2^-bits of its largest one. This keeps the
/// coefficients of exact polynomials short, whatever exponents the doubles have: one component of
/// 1e-300 would make them a hundred times longer, and their roots that much harder to isolate.
///
/// The error follows from Lipschitz bounds of the gap along any one direction: 1 in the offset of
/// the centres, in every size and in a rounding, which makes the core as much smaller; a rotation
/// of quaternion q to that of q' moves no point by more than 2 |q' − q| / |q| times its distance
/// from the centre, as sin(angle/2) <= |q' − q| / |q|.
///
/// Against a plane or a sphere no polynomial arises, and nothing is rounded. A convex body becomes
/// the hull of its rounded vertices, of which there may be fewer; none of them is rounded if that
/// would put all on one line.
RoundedConfiguration rounded_configuration(const Configuration& configuration,
                                           int bits = kept_bits);

/// The same shape with other sizes, each of them a function of the size; a plane has none.
template <class Size>
struct Resized {
  Size size;

  Cylinder operator()(const Cylinder& s) const {
    return {size(s.radius()), size(s.half_length()), rounding(s.rounding())};
  }
  Capsule operator()(const Capsule& s) const { return {size(s.radius()), size(s.half_length())}; }
  Sphere operator()(const Sphere& s) const { return Sphere(size(s.radius())); }
  Box operator()(const Box& s) const {
    const Vec3& h = s.half_extents();
    return Box(Vec3(size(h.x()), size(h.y()), size(h.z())), rounding(s.rounding()));
  }
  Convex operator()(const Convex& s) const { return s; }  ///< its vertices are not sizes
  Plane operator()(const Plane& s) const { return s; }
  Shape operator()(const Shape& shape) const {
    return std::visit([this](const auto& s) -> Shape { return (*this)(s); }, shape);
  }

  /// No rounding stays none. A size that is at least another one must stay so.
  double rounding(double radius) const { return radius > 0 ? size(radius) : 0; }
};
template <class Size>
Resized(Size) -> Resized<Size>;  // clang 14 finds none by itself

/// Moves bodies that are farther apart than 2^bits times their sizes closer together, in the same
/// direction: coordinates of a thousand bits would give roots that lie 2^-1000 apart.
///
/// With D the distance of the centres, d̂ its direction, S the sum of all sizes and h the half width
/// of the difference body, g(d̂) = D − h(d̂) is a lower bound of σ, and the distance of the support
/// points along d̂ an upper one:
///
///   D − h(d̂) <= σ <= D − h(d̂) + S² / (2 (D − S)),
///
/// so that σ − D is independent of D to within S 2^-bits.
class FarBodies {
 public:
  /// Moves the bodies of the difference closer together. None if they are near already, or if there
  /// is only one segment and no hull, so that no polynomial arises.
  static std::optional<FarBodies> brought_nearer(Difference& difference, int bits);

  /// True signed distance minus that of the moved bodies, in units.
  Ball shift() const;
  /// Bound of the error of shift(), in units.
  const mpq_class& error() const { return error_; }

 private:
  FarBodies(const Difference& before, const Difference& after, mpq_class error);

  IntegerVector before_, after_;
  Integer norm_;
  mpq_class error_;
};

}  // namespace touchstone::oracle
