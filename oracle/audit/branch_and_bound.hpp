#pragma once

#include <algorithm>
#include <vector>

#include "oracle/audit/certain_bounds.hpp"
#include "oracle/audit/pair_search.hpp"

namespace touchstone::audit {

/// A cell of directions and the pair of points that bounds the gap along them.
template <class R>
struct BoundedCell {
  DirectionCell<R> cell;
  PointPair<R> pair;
  R bound;     ///< certain: no direction of the cell has a larger gap
  R estimate;  ///< the linear program's value: orders cells that only the closest pair bounds so
               ///< far

  bool operator<(const BoundedCell& other) const {
    return bound != other.bound ? bound < other.bound : estimate < other.estimate;
  }
};

/// Bounds of the signed distance, as certain as T is, and their proof.
template <class T>
struct Bounds {
  Real<T> lo;              ///< the gap along `normal`
  Vector<Real<T>> normal;  ///< world, any length
  Real<T> hi;
  PointPair<Real<T>> closest;  ///< a point of each body, close together
  Real<T> distance;            ///< distance of `closest`, rounded up
  std::vector<BoundedCell<Real<T>>>
      cells;         ///< cover the whole sphere, unless `closest` is the proof
  int programs = 0;  ///< number of cells bounded, split ones included
};

/// Branch and bound over the sphere of directions. The largest gap is the signed distance; the
/// closest pair bounds it everywhere, the pair of a cell's linear program within the cell.
template <class T>
class BranchAndBound {
 public:
  using R = Real<T>;

  BranchAndBound(const Bodies<T>& certain, const Bodies<R>& search)
      : certain_(certain), search_(search) {}

  /// Starts from a closest pair of any quality. Stops when hi − lo <= `width`, or before it bounds
  /// more than `max_programs` cells (but at least the cube's six faces).
  Bounds<T> run(const ClosestPair<R>& closest, const R& width, int max_programs) {
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
    while (open.front().bound - found_.lo > width && found_.programs + 4 <= max_programs) {
      std::pop_heap(open.begin(), open.end());
      const BoundedCell<R> top = std::move(open.back());
      open.pop_back();
      for (int quarter = 0; quarter < 4; ++quarter) {
        bound_cell({top.cell.child(quarter), top.pair, top.bound, top.estimate}, width);
        std::push_heap(open.begin(), open.end());
      }
    }
    found_.hi = open.front().bound;
    return std::move(found_);
  }

 private:
  static constexpr int max_program_steps = 40;

  void bound_by(const ClosestPair<R>& closest) {
    found_.normal = closest.direction;
    found_.lo = gap_below(certain_, closest.direction);
    // Any other serves if rounding has moved the points out of the bodies.
    const PointPair<R> inside = pulled_inside(search_, closest.pair);
    found_.closest = certainly_contain(certain_, inside) ? inside : some_pair(search_);
    found_.distance = distance_above(certain_, found_.closest);
  }

  void try_direction(const Vector<R>& n) {
    if (!is_finite(n)) return;
    const R lo = gap_below(certain_, n);
    if (!(lo > found_.lo)) return;
    found_.lo = lo;
    found_.normal = n;
  }

  /// Adds the cell, with a better pair than the inherited one if there is one.
  void bound_cell(BoundedCell<R> cell, const R& width) {
    ++found_.programs;
    CellProgram<R> program(search_, cell.cell, cell.pair);
    program.run(found_.lo + width / 2, program_tolerance(cell.cell), max_program_steps);
    if (program.has_gap() && program.gap() > found_.lo) try_direction(program.direction());
    cell.estimate = program.value();
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

  /// Tolerance of a cell's linear program: a fraction of what any single pair loses because the
  /// cell is curved (the bound is taken on the chord between the corners, not on the arc).
  R program_tolerance(const DirectionCell<R>& cell) const {
    using std::abs;
    const R spread = cell.size * cell.size / R(8);
    return R(abs(found_.lo)) * spread / (R(1) + spread);
  }

  const Bodies<T>& certain_;
  const Bodies<R>& search_;
  Bounds<T> found_;
};

}  // namespace touchstone::audit
