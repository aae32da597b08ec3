#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "oracle/critical_site.hpp"
#include "oracle/optimal_normal.hpp"

namespace touchstone::oracle {

/// What one critical direction says of the signed distance, at one working precision.
struct DirectionBound {
  Ball gap;  ///< In units. Not finite: nothing is known yet at this precision.
  /// Towards A's side, of any length, in A's frame. Absent: the direction is not determined, and
  /// `gap` bounds the signed distance from above only.
  std::optional<BallVector> normal;
};

/// What can be proven, exactly, of a gap that no precision has told from zero.
enum class ZeroGap { unknown, at_most_zero, zero };

/// A continuous family of directions with the same gap: a NormalFamily in A's frame, with vectors
/// of any length.
struct DirectionFamily {
  NormalFamily::Kind kind;
  IntegerVector axis{0, 0, 0};
  std::vector<IntegerVector> ends;
};

/// A direction at which the gap may have its maximum: exactly determined, to be enclosed at any
/// precision. Since g(n) <= σ for every n, one that is no maximum does no harm; only completeness
/// matters (oracle/README.md).
class CriticalDirection {
 public:
  virtual ~CriticalDirection() = default;

  /// Appends what is known at the working precision of `difference`. Nothing when the direction is
  /// proven not to lie where its features are in contact.
  virtual void enclose(const Difference& difference, const BallDifference& balls,
                       std::vector<DirectionBound>& out) = 0;

  /// To be asked where the gap's ball contains zero; decided with exact algebra, for which balls
  /// at the working precision only tell apart what is apart.
  virtual ZeroGap zero_gap(const Difference& difference) = 0;

  /// Is the direction exactly perpendicular to this vector? May be false where the same direction
  /// has another site of a simpler kind.
  virtual bool is_across(const IntegerVector& v) const = 0;

  /// The family that this direction stands for.
  virtual std::optional<DirectionFamily> family() const { return std::nullopt; }
};

using CriticalDirections = std::vector<std::unique_ptr<CriticalDirection>>;

/// Appends all critical directions of one site.
void append_directions(const Difference& difference, const CriticalSite& site,
                       CriticalDirections& out);

// Its parts, by kind.

void append_disc_axis(const Difference& difference, const CriticalSite& site,
                      CriticalDirections& out);
void append_crossing(const Difference& difference, const CriticalSite& site,
                     CriticalDirections& out);
void append_radial(const Difference& difference, const CriticalSite& site, CriticalDirections& out);
void append_rim_vertex(const Difference& difference, const CriticalSite& site,
                       CriticalDirections& out);
void append_rim_line(const Difference& difference, const CriticalSite& site,
                     CriticalDirections& out);
void append_rim_rim(const Difference& difference, const CriticalSite& site,
                    CriticalDirections& out);
/// A half-space has one direction.
std::unique_ptr<CriticalDirection> plane_direction(const Difference& difference);

/// Both directions ±n with integer coordinates.
std::unique_ptr<CriticalDirection> rational_direction(IntegerVector n,
                                                      std::optional<DirectionFamily> family = {});

/// The segments' axes, turned to the side that `signs` says.
std::vector<IntegerVector> signed_axes(const Difference& difference, unsigned signs,
                                       const Difference::Segment* skipped = nullptr);

/// All directions across a line that are not behind any of `inward`: a circle, or an arc.
/// Without ends there is no arc.
DirectionFamily sector(const IntegerVector& line, const std::vector<IntegerVector>& inward);

/// d − Σ sign·half_length·axis over the segments other than `skipped`: where the reduced point lies
/// once these segments have shrunk to their ends. Bit i of `signs` is the sign of segment i. Times
/// norm, like d.
IntegerVector reduced_point(const Difference& difference, unsigned signs,
                            const Difference::Segment* skipped = nullptr);

/// The part of q across a frame's axis, times norm².
IntegerVector off_axis(const IntegerVector& q, const Frame& frame);

enum class Side { no, undecided, yes };

/// Is a direction on the side of every segment's axis that `signs` says, as far as balls can tell?
Side at_vertex(const Difference& difference, unsigned signs, const BallVector& n,
               const Difference::Segment* skipped = nullptr);

}  // namespace touchstone::oracle
