#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "oracle/difference.hpp"
#include "oracle/truth.hpp"

namespace touchstone::oracle {

/// Where a critical direction may lie: the parts of the difference that determine it, and for a
/// root of a polynomial the piece of its parameter that could not be excluded.
struct CriticalSite {
  enum class Kind {
    disc_axis,  ///< ± the axis of disc `first`
    face,       ///< the normal of the hull's face `first`
    crossing,   ///< ± the cross product of segments `first` and `second`
    radial,     ///< perpendicular to segment `first`, towards the vertex `signs`; the only disc has
                ///< the segment's axis
    rim_vertex,  ///< from the rim of the only disc to the vertex `signs`
    rim_line,    ///< perpendicular to segment `first`, disc `second` seen as an ellipse, at the
                 ///< vertex `signs`
    rim_rim      ///< between the rims of both discs, at the vertex `signs`
  };
  Kind kind;
  /// Against a hull, whose only segment and disc are A's: `second` of crossing and `first` of
  /// rim_line are an edge of the hull, `second` of radial and rim_vertex is a vertex of it.
  unsigned first = 0, second = 0;
  unsigned signs = 0;  ///< bit i: the direction is on the positive side of segment i's axis
  /// rim_line: the direction is x e + y f in the segment's frame, with (x, y) = (1, t) turned by
  /// `turn` quarters. rim_rim: the point of the first rim is at the angle 2 arctan t, plus half a
  /// circle if `turn` is 1. In both, lo <= t <= hi, and within [-1, 1] if `branch` is 0.
  unsigned turn = 0;
  double lo = 0, hi = 0;
  /// rim_line: the segment's frame is first turned about its axis by 2 arctan(heading), a multiple
  /// of 2^-heading_bits.
  double heading = 0;
  /// 0: any number of roots of the site's polynomial, of either branch. 1 or −1: a SlopeBracket.
  int branch = 0;
  bool rising = false;
};

/// A frame turned about its axis by 2 arctan(heading), exactly. e and f are longer by the factor
/// `stretch`.
struct TurnedFrame {
  Frame frame;
  Integer stretch;
};
inline constexpr int heading_bits = 26;
TurnedFrame turned_frame(const Frame& frame, double heading);

/// Every site that could hold a direction whose gap is within `slack` (metres, >= 0) of the signed
/// distance: all sites that double intervals cannot exclude. Complete (oracle/truth.md); a site
/// without a maximum does no harm. Precondition: B is not a plane.
std::vector<CriticalSite> critical_sites(const Difference& difference, double slack);

/// What one critical direction implies for the signed distance, at one working precision.
struct DirectionBound {
  Ball gap;  ///< In units. Not finite: nothing is known yet at this precision.
  /// Towards A's side, of any length, in A's frame. Absent: the direction is not determined, and
  /// `gap` is only an upper bound of the signed distance.
  std::optional<BallVector> normal;
};

/// What exact algebra proves about a gap whose sign no precision has decided.
enum class ZeroGap { unknown, at_most_zero, zero };

/// A continuous family of directions with the same gap: a NormalFamily in A's frame, with vectors
/// of any length.
struct DirectionFamily {
  NormalFamily::Kind kind;
  IntegerVector axis{0, 0, 0};
  std::vector<IntegerVector> ends;
};

/// A direction at which the gap may have its maximum: determined exactly, enclosed at any
/// precision. Since g(n) <= σ for every n, a direction that is no maximum does no harm; only
/// completeness matters (oracle/truth.md).
class CriticalDirection {
 public:
  virtual ~CriticalDirection() = default;

  /// Appends what is known at the working precision of `difference`: nothing if the direction is
  /// proven to lie outside the normals of its features.
  virtual void enclose(const Difference& difference, const BallDifference& balls,
                       std::vector<DirectionBound>& out) = 0;

  /// Decides by exact algebra whether the gap is zero. Precondition: the gap's ball contains zero.
  /// Balls at the working precision only separate roots that are known to differ.
  virtual ZeroGap zero_gap(const Difference& difference) = 0;

  /// Is the direction exactly perpendicular to this vector? May be false if the same direction also
  /// has a site of a simpler kind.
  virtual bool is_across(const IntegerVector& v) = 0;

  /// The family that this direction stands for.
  virtual std::optional<DirectionFamily> family() const { return std::nullopt; }
};

using CriticalDirections = std::vector<std::unique_ptr<CriticalDirection>>;

// Append the critical directions of one site, by its kind.

void append_disc_axis(const Difference& difference, const CriticalSite& site,
                      CriticalDirections& out);
void append_face(const Difference& difference, const CriticalSite& site, CriticalDirections& out);
void append_crossing(const Difference& difference, const CriticalSite& site,
                     CriticalDirections& out);
void append_radial(const Difference& difference, const CriticalSite& site, CriticalDirections& out);
void append_rim_vertex(const Difference& difference, const CriticalSite& site,
                       CriticalDirections& out);
void append_rim_line(const Difference& difference, const CriticalSite& site,
                     CriticalDirections& out);
void append_rim_rim(const Difference& difference, const CriticalSite& site,
                    CriticalDirections& out);

/// The single direction n, with integer coordinates.
std::unique_ptr<CriticalDirection> single_direction(IntegerVector n);

/// Both directions ±n with integer coordinates.
std::unique_ptr<CriticalDirection> rational_direction(IntegerVector n,
                                                      std::optional<DirectionFamily> family = {});

/// d less the site's ends of all segments but the one that its directions are perpendicular to, and
/// less its vertex of the hull; times norm.
IntegerVector reduced_point(const Difference& difference, const CriticalSite& site);

/// The directions n at which these ends and this vertex are the highest have n·v >= 0 for each of
/// these v.
std::vector<IntegerVector> inward(const Difference& difference, const CriticalSite& site);

/// All directions n perpendicular to a line with n·v >= 0 for every `inward` v: a circle, or an
/// arc. An arc without ends is empty.
DirectionFamily sector(const IntegerVector& line, const std::vector<IntegerVector>& inward);

enum class Certainty { no, undecided, yes };

/// Is n·v > 0 for every `inward` v? Undecided where balls contain zero.
Certainty at_vertex(const std::vector<IntegerVector>& inward, const BallVector& n);

}  // namespace touchstone::oracle
