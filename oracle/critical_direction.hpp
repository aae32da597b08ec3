#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "oracle/difference.hpp"

namespace touchstone::oracle {

/// What one critical direction says of the signed distance, at one working precision.
struct DirectionBound {
  Ball gap;  ///< In units. Not finite: nothing is known yet at this precision.
  /// Towards A's side, of any length, in A's frame. Absent: the direction is not determined, and
  /// `gap` bounds the signed distance from above only.
  std::optional<BallVector> normal;
};

/// A direction at which the gap may have its maximum: exactly determined, to be enclosed at any
/// precision. Since g(n) <= σ for every n, one that is no maximum does no harm; only completeness
/// matters (oracle/README.md).
class CriticalDirection {
 public:
  virtual ~CriticalDirection() = default;

  /// Appends what is known at the working precision of `difference`. Nothing when the direction is
  /// proven not to lie where its features are in contact.
  virtual void enclose(const BallDifference& difference, std::vector<DirectionBound>& out) = 0;

  /// A member of a continuous family along which the gap is constant.
  virtual bool of_a_continuum() const { return false; }
};

using CriticalDirections = std::vector<std::unique_ptr<CriticalDirection>>;

/// Bound of ±n, whichever of the two has the larger gap (both where that is not decided).
void append_bounds(const BallDifference& difference, const BallVector& n,
                   std::vector<DirectionBound>& out);

/// d − Σ sign·half_length·axis over the segments other than `skipped`: where the reduced point lies
/// once these segments have shrunk to their ends. Bit i of `signs` is the sign of segment i. Times
/// norm, like d.
IntegerVector reduced_point(const Difference& difference, unsigned signs,
                            const Difference::Segment* skipped = nullptr);

/// Caps, box faces, planes, crossed sides and edges: ±axis of each disc, ±axis × axis of two
/// segments.
void add_axial_directions(const Difference& difference, CriticalDirections& out);

/// Across one segment, where every disc is seen flat on: from the segment's line to a vertex.
void add_radial_directions(const Difference& difference, CriticalDirections& out);

/// A single disc's rim against a vertex.
void add_rim_vertex_directions(const Difference& difference, CriticalDirections& out);

/// Across one segment, where one disc is seen as an ellipse: rim against side, rim against edge.
void add_rim_line_directions(const Difference& difference, CriticalDirections& out);

/// Two discs' rims.
void add_rim_rim_directions(const Difference& difference, CriticalDirections& out);

}  // namespace touchstone::oracle
