#pragma once

#include <algorithm>
#include <vector>

#include "oracle/audit/cell_program.hpp"
#include "oracle/audit/certain_bounds.hpp"
#include "oracle/audit/closest_pair.hpp"

namespace touchstone::audit {

/// A cell with a pair of points that bounds the gap along its directions.
template <class R>
struct BoundedCell {
  DirectionCell<R> cell;
  PointPair<R> pair;
  R bound;    ///< Certain: no direction of the cell has a larger gap.
  R promise;  ///< The program's value: ranks cells that only the closest pair bounds as yet.

  bool operator<(const BoundedCell& other) const {
    return bound != other.bound ? bound < other.bound : promise < other.promise;
  }
};

/// Bounds of the signed distance, certain as far as T is, and what proves them.
template <class T>
struct Bounds {
  Real<T> lo;              ///< The gap along `normal`.
  Vector<Real<T>> normal;  ///< World, any length.
  Real<T> hi;
  PointPair<Real<T>> closest;               ///< Points of both bodies, close together.
  Real<T> distance;                         ///< Of `closest`, rounded up.
  std::vector<BoundedCell<Real<T>>> cells;  ///< Of the whole sphere, if `closest` is no proof.
  int programs = 0;                         ///< Cells that were bounded, split ones included.
};

/// Branch and bound over the sphere of directions. The largest gap is the signed distance; the
/// closest pair bounds it everywhere, and cell by cell the program's pair.
template <class T>
class BranchAndBound {
 public:
  using R = Real<T>;

  BranchAndBound(const Bodies<T>& certain, const Bodies<R>& search)
      : certain_(certain), search_(search) {}

  /// Starts from a closest pair, of whatever quality. Stops when hi − lo <= `width`, or before
  /// `most_programs` cells are exceeded, beyond the six faces of the cube.
  Bounds<T> run(const ClosestPair<R>& closest, const R& width, int most_programs) {
    bound_by(closest);
    if (found_.distance - found_.lo <= width || found_.lo > 0) {
      found_.hi = found_.distance;
      return std::move(found_);
    }
    for (int face = 0; face < 6; ++face) {
      const R unknown(0);
      bound_cell({DirectionCell<R>::whole_face(face), found_.closest, found_.distance, unknown},
                 width);
    }
    std::vector<BoundedCell<R>>& open = found_.cells;  // a heap
    std::make_heap(open.begin(), open.end());
    while (open.front().bound - found_.lo > width && found_.programs + 4 <= most_programs) {
      std::pop_heap(open.begin(), open.end());
      const BoundedCell<R> top = std::move(open.back());
      open.pop_back();
      for (int quarter = 0; quarter < 4; ++quarter) {
        bound_cell({top.cell.child(quarter), top.pair, top.bound, top.promise}, width);
        std::push_heap(open.begin(), open.end());
      }
    }
    found_.hi = open.front().bound;
    return std::move(found_);
  }

 private:
  static constexpr int most_program_steps = 40;

  void bound_by(const ClosestPair<R>& closest) {
    found_.normal = closest.direction;
    found_.lo = gap_below(certain_, closest.direction);
    // A's and B's centres, should rounding have moved the points out of the bodies.
    PointPair<R> pair{Vector<R>::Zero(), Vector<R>::Zero()};
    const PointPair<R> inside = pulled_inside(search_, closest.pair);
    if (certainly_contain(certain_, inside)) pair = inside;
    found_.closest = pair;
    found_.distance = distance_above(certain_, pair);
  }

  void try_direction(const Vector<R>& n) {
    if (!is_finite(n)) return;
    const R lo = gap_below(certain_, n);
    if (!(lo > found_.lo)) return;
    found_.lo = lo;
    found_.normal = n;
  }

  /// Adds the cell with a better pair than the one that it inherits, if there is one.
  void bound_cell(BoundedCell<R> cell, const R& width) {
    ++found_.programs;
    CellProgram<R> program(search_, cell.cell, cell.pair);
    program.run(found_.lo + width / 2, worthwhile(cell.cell), most_program_steps);
    if (program.has_gap() && program.gap() > found_.lo) try_direction(program.direction());
    cell.promise = program.value();
    const PointPair<R> pair = pulled_inside(search_, program.pair());
    if (certainly_contain(certain_, pair)) {
      const R bound = corner_bound_above(certain_, pair, cell.cell);
      if (bound < 0 && bound < cell.bound) {
        cell.bound = bound;
        cell.pair = pair;
      }
    }
    found_.cells.push_back(std::move(cell));
  }

  /// A fraction of what any single pair loses on a cell because directions are curved: the bound
  /// holds on the chord between the corners, not on the arc.
  R worthwhile(const DirectionCell<R>& cell) const {
    using std::abs;
    const R spread = cell.size * cell.size / R(8);
    return R(abs(found_.lo)) * spread / (R(1) + spread);
  }

  const Bodies<T>& certain_;
  const Bodies<R>& search_;
  Bounds<T> found_;
};

}  // namespace touchstone::audit
