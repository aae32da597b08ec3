#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Core>

#include "oracle/audit/certain_bounds.hpp"

namespace touchstone::audit {

// Points of bodies in the search's rounded arithmetic. No bound relies on their correctness:
// `certainly_contains` checks every point that is used.

/// The point of the body farthest along n (body frame, any length).
template <class R>
Vector<R> support_point(const Body<R>& body, const Vector<R>& n) {
  using std::sqrt;
  Vector<R> p;
  for (int i = 0; i < 3; ++i) p[i] = n[i] < 0 ? R(-body.half_extents[i]) : body.half_extents[i];
  const R across = sqrt(R(n.x() * n.x() + n.y() * n.y()));
  if (body.disc_radius > 0 && across > 0) {
    p.x() += body.disc_radius * n.x() / across;
    p.y() += body.disc_radius * n.y() / across;
  }
  const R length = sqrt(R(n.squaredNorm()));
  if (body.ball_radius > 0 && length > 0) p += n * R(body.ball_radius / length);
  return p;
}

template <class R>
int support_vertex(const std::vector<Vector<R>>& vertices, const Vector<R>& n) {
  std::size_t highest = 0;
  R height = vertices[0].dot(n);
  for (std::size_t i = 1; i < vertices.size(); ++i) {
    const R here = vertices[i].dot(n);
    if (here > height) highest = i, height = here;
  }
  return static_cast<int>(highest);
}

/// The pair that attains the gap along n (world, any length): A's lowest and B's highest point.
template <class R>
PointPair<R> support_pair(const Bodies<R>& bodies, const Vector<R>& n) {
  const Vector<R> n_a = bodies.a.axes.transpose() * n, n_b = bodies.b.axes.transpose() * n;
  const Vector<R> lowest = support_point(bodies.a, Vector<R>(-n_a));
  if (bodies.b.vertices.empty()) return {lowest, support_point(bodies.b, n_b)};
  return {lowest, Vector<R>::Zero(), {{support_vertex(bodies.b.vertices, n_b), R(1)}}};
}

/// A pair that certainly lies in the bodies, wherever: their centres, or a hull's first vertex.
template <class R>
PointPair<R> some_pair(const Bodies<R>& bodies) {
  PointPair<R> pair{Vector<R>::Zero(), Vector<R>::Zero()};
  if (!bodies.b.vertices.empty()) pair.weights = {{0, R(1)}};
  return pair;
}

/// Adds a share of a pair to a mean of pairs.
template <class R>
void add(PointPair<R>& sum, const R& share, const PointPair<R>& pair) {
  sum.a += share * pair.a;
  sum.b += share * pair.b;
  for (const VertexWeight<R>& of : pair.weights) {
    const auto at = std::find_if(sum.weights.begin(), sum.weights.end(),
                                 [&](const auto& known) { return known.vertex == of.vertex; });
    if (at == sum.weights.end()) {
      sum.weights.push_back({of.vertex, R(share * of.weight)});
    } else {
      at->weight += share * of.weight;
    }
  }
}

/// Moves a point into the body by a little more than rounding can have moved it out.
template <class R>
Vector<R> pulled_inside(const Body<R>& body, const Vector<R>& p) {
  using std::abs, std::sqrt;
  Vector<R> core;
  for (int i = 0; i < 3; ++i) {
    const R& h = body.half_extents[i];
    core[i] = p[i] > h ? h : p[i] < -h ? R(-h) : p[i];
  }
  const R radius = body.disc_radius + body.ball_radius;
  Vector<R> round = p - core;
  if (body.ball_radius == 0) round.z() = 0;
  const R margin =
      R(16) * std::numeric_limits<R>::epsilon() * (radius + R(body.half_extents.maxCoeff()));
  const R length = sqrt(R(round.squaredNorm()));
  const R allowed = radius > margin ? R(radius - margin) : R(0);
  if (length > allowed) round *= R(allowed / length);
  return core + round;
}

template <class R>
PointPair<R> pulled_inside(const Bodies<R>& bodies, const PointPair<R>& pair) {
  PointPair<R> result{pulled_inside(bodies.a, pair.a), pulled_inside(bodies.b, pair.b)};
  for (const VertexWeight<R>& of : pair.weights) {
    if (of.weight > 0) result.weights.push_back(of);
  }
  return result;
}

/// The result of a search, without guarantee.
template <class R>
struct ClosestPair {
  PointPair<R> pair;    ///< closest points found; for overlapping bodies (nearly) one point
  Vector<R> direction;  ///< world, any length; the gap along it is the largest found
  R gap;                ///< that gap
};

/// Wolfe's algorithm for the point of smallest norm in the set of differences a − b ("Finding the
/// nearest point in a polytope", Mathematical Programming 11, 1976), with support points as
/// vertices, as in Gilbert, Johnson, Keerthi (IEEE J. Robotics and Automation 4, 1988).
template <class R>
class ClosestPairSearch {
 public:
  explicit ClosestPairSearch(const Bodies<R>& bodies) : bodies_(bodies) {}

  /// Stops when |a − b| and the gap along a − b are within `tolerance` of each other, or when
  /// rounding prevents progress.
  ClosestPair<R> run(const R& tolerance, int max_steps) {
    using std::sqrt;
    const R nothing = 64 * std::numeric_limits<R>::epsilon();
    Vector<R> start = bodies_.offset;
    if (start.squaredNorm() == 0) start = Vector<R>(R(0), R(0), R(1));
    ClosestPair<R> best;
    best.direction = start;
    add(support_pair(bodies_, start), R(1));
    best.gap = vertices_[0].w.dot(start) / sqrt(R(start.squaredNorm()));
    for (int step = 0; step < max_steps; ++step) {
      const Vector<R> w = nearest();
      const R length = sqrt(R(w.squaredNorm()));
      if (length <= nothing) break;
      const PointPair<R> pair = support_pair(bodies_, w);
      const R gap = difference(bodies_, pair).dot(w) / length;
      if (gap > best.gap) {
        best.gap = gap;
        best.direction = w / length;
      }
      if (length - gap <= tolerance || count_ == 4) break;
      add(pair, R(0));
      if (!reduce()) break;
    }
    best.pair = {Vector<R>::Zero(), Vector<R>::Zero()};
    for (int i = 0; i < count_; ++i) {
      audit::add(best.pair, vertices_[i].weight, vertices_[i].pair);
    }
    return best;
  }

 private:
  struct Vertex {
    PointPair<R> pair;
    Vector<R> w;
    R weight;
  };

  void add(const PointPair<R>& pair, const R& weight) {
    vertices_[count_++] = {pair, difference(bodies_, pair), weight};
  }

  Vector<R> nearest() const {
    Vector<R> sum = Vector<R>::Zero();
    for (int i = 0; i < count_; ++i) sum += vertices_[i].weight * vertices_[i].w;
    return sum;
  }

  /// Weights (with sum one) of the point of the vertices' affine hull nearest to the origin: least
  /// squares over the edges from the first vertex, by Gram and Schmidt's method, which is stable if
  /// the right-hand side is reduced with the columns (Björck, BIT 7, 1967). The longest edge comes
  /// first; edges within rounding of the span of those before get no weight. (Eigen's solvers do
  /// the same and take the compiler 17 s for these number types.)
  std::array<R, 4> affine_minimum() const {
    using std::sqrt;
    const int count = count_ - 1;
    std::array<Vector<R>, 3> edges;
    for (int i = 0; i < count; ++i) edges[i] = vertices_[i + 1].w - vertices_[0].w;
    Vector<R> rest = -vertices_[0].w;
    std::array<int, 3> order{0, 1, 2};
    Matrix<R> along = Matrix<R>::Zero();  // (k, i): the i-th edge along the k-th direction
    Vector<R> steps = Vector<R>::Zero();
    R longest(0);
    int rank = 0;
    for (; rank < count; ++rank) {
      for (int i = rank + 1; i < count; ++i) {
        if (edges[order[i]].squaredNorm() > edges[order[rank]].squaredNorm()) {
          std::swap(order[i], order[rank]);
          along.col(i).swap(along.col(rank));
        }
      }
      const Vector<R>& edge = edges[order[rank]];
      const R length = sqrt(R(edge.squaredNorm()));
      if (rank == 0) longest = length;
      if (length <= 3 * std::numeric_limits<R>::epsilon() * longest) break;
      const Vector<R> direction = edge / length;
      along(rank, rank) = length;
      for (int i = rank + 1; i < count; ++i) {
        along(rank, i) = direction.dot(edges[order[i]]);
        edges[order[i]] -= along(rank, i) * direction;
      }
      steps[rank] = direction.dot(rest);
      rest -= steps[rank] * direction;
    }
    std::array<R, 4> weights{R(1), R(0), R(0), R(0)};
    for (int i = rank - 1; i >= 0; --i) {
      for (int k = i + 1; k < rank; ++k) steps[i] -= along(i, k) * steps[k];
      steps[i] /= along(i, i);
      weights[order[i] + 1] = steps[i];
      weights[0] -= steps[i];
    }
    return weights;
  }

  /// Moves to the nearest point of the vertices' hull and drops vertices of weight zero. False if
  /// rounding prevents progress: the newest vertex is dropped at once.
  bool reduce() {
    const R before = nearest().squaredNorm();
    for (;;) {
      const std::array<R, 4> target = affine_minimum();
      R step(1);
      int blocking = -1;
      for (int i = 0; i < count_; ++i) {
        if (target[i] > 0) continue;
        // Weight and target zero would give 0/0: such a vertex is dropped.
        const R& weight = vertices_[i].weight;
        const R reach = weight > target[i] ? R(weight / (weight - target[i])) : R(0);
        if (blocking < 0 || reach < step) {
          step = reach;
          blocking = i;
        }
      }
      for (int i = 0; i < count_; ++i) {
        vertices_[i].weight += step * (target[i] - vertices_[i].weight);
      }
      if (blocking < 0) break;
      vertices_[blocking] = vertices_[--count_];
      if (count_ == 1) {
        vertices_[0].weight = R(1);
        break;
      }
    }
    return nearest().squaredNorm() < before;
  }

  const Bodies<R>& bodies_;
  std::array<Vertex, 4> vertices_;
  int count_ = 0;
};

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
      if (is_pair_[i]) add(sum, inverse_[i][4], pairs_[i]);
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
