#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "oracle/audit/certain_bounds.hpp"
#include "oracle/audit/closest_pair.hpp"

namespace touchstone::audit {

/// The best bound of one cell: the convex combination w of differences a − b whose largest product
/// with the cell's unit corner vectors is smallest,
///
///     minimise t  over  λ >= 0, Σ λ = 1:   Σ_j λ_j w_j·m_k <= t   for the four corners k.
///
/// This is a linear program with one column for every pair of points, solved by the simplex method
/// with column generation (Dantzig, Wolfe, "Decomposition principle for linear programs",
/// Operations Research 8, 1960): the corners' multipliers μ_k give a direction x = Σ μ_k m_k, and
/// the support pair along x is the most useful column. Its product g(x) is a lower bound of t,
/// which tells when t is good enough.
template <class R>
class CellProgram {
 public:
  CellProgram(const Bodies<R>& bodies, const DirectionCell<R>& cell, const PointPair<R>& start)
      : bodies_(bodies), corners_(cell.corners()) {
    using std::sqrt;
    smallest_pivot_ = cell.size * sqrt(std::numeric_limits<R>::epsilon());
    for (auto& m : corners_) m /= R(sqrt(R(m.squaredNorm())));
    pairs_[1] = start;
    const Row products = products_of(start);
    int top = 0;
    for (int k = 1; k < 4; ++k) {
      if (products[k] > products[top]) top = k;
    }
    // Basis: t in row 0, λ of `start` in row 1, the slacks of the other corners below. The right
    // hand side is (0, 0, 0, 0, 1), so the last column of the inverse holds the variables' values.
    for (Row& row : inverse_) row.fill(R(0));
    inverse_[0][top] = R(-1);
    inverse_[0][4] = products[top];
    inverse_[1][4] = R(1);
    for (int k = 0, row = 2; k < 4; ++k) {
      if (k == top) continue;
      inverse_[row][k] = R(1);
      inverse_[row][top] = R(-1);
      inverse_[row][4] = products[top] - products[k];
      ++row;
    }
    is_pair_ = {false, true, false, false, false};
  }

  /// Improves t until it is within `tolerance` of the minimum, or at most `goal`, or for
  /// `max_steps`.
  void run(const R& goal, const R& tolerance, int max_steps) {
    using std::sqrt;
    for (int step = 0; step < max_steps && value() > goal; ++step) {
      int slack = 0;
      for (int k = 1; k < 4; ++k) {
        if (inverse_[0][k] > inverse_[0][slack]) slack = k;
      }
      if (inverse_[0][slack] > std::numeric_limits<R>::epsilon()) {
        Row unit;
        unit.fill(R(0));
        unit[slack] = R(1);
        if (!enter(unit, nullptr)) return;
        continue;
      }
      Vector<R> x = Vector<R>::Zero();
      for (int k = 0; k < 4; ++k) x -= inverse_[0][k] * corners_[k];
      const PointPair<R> pair = support_pair(bodies_, x);
      const Row products = products_of(pair);
      R along_x(0);
      for (int k = 0; k < 4; ++k) along_x -= inverse_[0][k] * products[k];
      const R gap = along_x / sqrt(R(x.squaredNorm()));
      if (!has_gap_ || gap > gap_) {
        has_gap_ = true;
        gap_ = gap;
        direction_ = x;
      }
      if (value() - along_x <= tolerance || !enter(products, &pair)) return;
    }
  }

  const R& value() const { return inverse_[0][4]; }  ///< t

  /// The pair of points whose difference is w.
  PointPair<R> pair() const {
    PointPair<R> sum{Vector<R>::Zero(), Vector<R>::Zero()};
    for (int i = 1; i < 5; ++i) {
      if (!is_pair_[i]) continue;
      sum.a += inverse_[i][4] * pairs_[i].a;
      sum.b += inverse_[i][4] * pairs_[i].b;
    }
    return sum;
  }

  /// The direction (any length) with the largest gap found, if any was tried.
  bool has_gap() const { return has_gap_; }
  const R& gap() const { return gap_; }
  const Vector<R>& direction() const { return direction_; }

 private:
  using Row = std::array<R, 5>;

  /// The column of a pair: the products of its difference with the corners, and a one.
  Row products_of(const PointPair<R>& pair) const {
    const Vector<R> w = difference(bodies_, pair);
    return {w.dot(corners_[0]), w.dot(corners_[1]), w.dot(corners_[2]), w.dot(corners_[3]), R(1)};
  }

  /// One simplex step; false when the column no longer lowers t.
  bool enter(const Row& column, const PointPair<R>* pair) {
    Row change;
    for (int i = 0; i < 5; ++i) {
      change[i] = R(0);
      for (int k = 0; k < 5; ++k) change[i] += inverse_[i][k] * column[k];
    }
    if (!(change[0] > 0)) return false;
    int leaving = 0;
    for (int i = 1; i < 5; ++i) {
      if (!(change[i] > smallest_pivot_)) continue;
      if (leaving == 0 || inverse_[i][4] * change[leaving] < inverse_[leaving][4] * change[i]) {
        leaving = i;
      }
    }
    if (leaving == 0) return false;
    for (R& entry : inverse_[leaving]) entry /= change[leaving];
    for (int i = 0; i < 5; ++i) {
      if (i == leaving) continue;
      for (int k = 0; k < 5; ++k) inverse_[i][k] -= change[i] * inverse_[leaving][k];
    }
    is_pair_[leaving] = pair != nullptr;
    if (pair != nullptr) pairs_[leaving] = *pair;
    return true;
  }

  const Bodies<R>& bodies_;
  std::array<Vector<R>, 4> corners_;  // unit
  // The corner vectors are nearly linearly dependent, so that four pairs are no basis. Pivots of
  // true columns shrink with the cell; those made of rounding errors do not.
  R smallest_pivot_{0};
  std::array<Row, 5> inverse_;
  std::array<bool, 5> is_pair_;  // otherwise a slack; row 0 is t
  std::array<PointPair<R>, 5> pairs_;
  bool has_gap_ = false;
  R gap_{0};
  Vector<R> direction_;
};

}  // namespace touchstone::audit
