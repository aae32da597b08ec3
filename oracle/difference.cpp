#include "oracle/difference.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "oracle/body.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone::oracle {
namespace {

/// A double as an odd integer times a power of two; zero stays zero.
struct Dyadic {
  explicit Dyadic(double value) {
    constexpr int mantissa_bits = std::numeric_limits<double>::digits;
    int binary_exponent = 0;
    const double fraction = std::frexp(value, &binary_exponent);
    mantissa = static_cast<std::int64_t>(std::ldexp(fraction, mantissa_bits));
    if (mantissa == 0) return;
    const int zeros = std::countr_zero(static_cast<std::uint64_t>(mantissa));
    mantissa >>= zeros;
    exponent = binary_exponent - mantissa_bits + zeros;
  }
  std::int64_t mantissa;
  int exponent = 0;
};

/// A power of two that makes all included doubles integers.
class DyadicScale {
 public:
  void include(double value) { bits_ = std::max(bits_, -Dyadic(value).exponent); }
  void include(const Vec3& v) {
    for (int i = 0; i < 3; ++i) include(v[i]);
  }
  Integer operator()(double value) const {
    const Dyadic dyadic(value);
    Integer result(static_cast<long>(dyadic.mantissa));
    const int shift = dyadic.exponent + bits_;
    result <<= static_cast<mp_bitcnt_t>(shift);
    return result;
  }
  IntegerVector operator()(const Vec3& v) const {
    return {(*this)(v.x()), (*this)(v.y()), (*this)(v.z())};
  }
  mpz_class factor() const { return mpz_class(1) << static_cast<mp_bitcnt_t>(bits_); }

 private:
  int bits_ = 0;
};

using IntegerRotation = ExactRotation<Integer>;

IntegerRotation exact_rotation(const Eigen::Quaterniond& q) {
  DyadicScale scale;
  for (const double c : {q.w(), q.x(), q.y(), q.z()}) scale.include(c);
  return {scale(q.w()), scale(q.x()), scale(q.y()), scale(q.z())};
}

/// Adds a segment or disc of this size to a list, or to that which is parallel to it.
template <class Parts, class Part>
void add(Parts& parts, Integer Part::*size_of, Frame frame, const Integer& size) {
  for (Part& part : parts) {
    if (parallel(part.frame.axis, frame.axis)) {
      part.*size_of += size;
      return;
    }
  }
  parts.push_back({std::move(frame), size});
}

/// Leaves out one of two discs that is a point: the rims of two discs are circles.
void leave_out_point(Difference& difference) {
  auto& discs = difference.discs;
  const auto is_point = [](const Difference::Disc& disc) { return disc.radius == 0; };
  const auto point = std::find_if(discs.begin(), discs.end(), is_point);
  if (discs.size() == 2 && point != discs.end()) discs.erase(point);
}

/// Divides by the common factor of all entries, which is large when the orientations are equal.
void reduce(Integer& norm, std::array<IntegerVector, 3>& columns) {
  Integer g = norm;
  for (const auto& c : columns) {
    for (const Integer* entry : {&c.x, &c.y, &c.z}) {
      if (g == 1) return;
      g = gcd(g, *entry);
    }
  }
  const auto divide = [&](Integer& x) {
    mpz_divexact(x.get_mpz_t(), x.get_mpz_t(), g.get_mpz_t());
  };
  divide(norm);
  for (auto& c : columns) {
    for (Integer* entry : {&c.x, &c.y, &c.z}) divide(*entry);
  }
}

/// The vertices in integers of B's frame, from a point in the middle of their box.
struct LocalHull {
  IntegerVector middle;
  std::vector<IntegerVector> vertices;
};

LocalHull local_hull(const Convex& body, const DyadicScale& length, const Integer& finer) {
  LocalHull hull;
  for (const Vec3& v : body.vertices()) hull.vertices.push_back(finer * length(v));
  const auto halfway = [&](Integer IntegerVector::*coordinate) {
    const auto [low, high] = std::minmax_element(
        hull.vertices.begin(), hull.vertices.end(),
        [&](const auto& a, const auto& b) { return a.*coordinate < b.*coordinate; });
    return Integer(((*low).*coordinate + (*high).*coordinate) / 2);
  };
  hull.middle = {halfway(&IntegerVector::x), halfway(&IntegerVector::y),
                 halfway(&IntegerVector::z)};
  for (IntegerVector& v : hull.vertices) v = v - hull.middle;
  return hull;
}

}  // namespace

Difference make_difference(const Configuration& c) {
  DyadicScale length;
  const Body body_a(c.a), body_b(c.b);
  for (const Body* body : {&body_a, &body_b}) {
    length.include(body->half_extents);
    length.include(Vec3(body->disc_radius, body->inset, body->ball_radius));
  }
  if (body_b.hull) {
    for (const Vec3& v : body_b.hull->vertices()) length.include(v);
  }
  const auto* const plane = std::get_if<Plane>(&c.b);
  if (plane) length.include(plane->displacement());
  length.include(c.pose_a.position());
  length.include(c.pose_b.position());

  const IntegerRotation a = exact_rotation(c.pose_a.orientation());
  const IntegerRotation b = exact_rotation(c.pose_b.orientation());

  Difference difference;
  for (int row = 0; row < 3; ++row) {
    const auto entry = [row](const IntegerVector& v) {
      return row == 0 ? v.x : row == 1 ? v.y : v.z;
    };
    difference.world_rows[row] = {entry(a.columns[0]), entry(a.columns[1]), entry(a.columns[2])};
  }

  // B's axes in A's frame, times norm.
  Integer norm = 1;
  std::array<IntegerVector, 3> axes_b;
  if (body_b.half_extents.z() > 0 || body_b.hull) {
    norm = a.norm * b.norm;
    for (int i = 0; i < 3; ++i) axes_b[i] = a.apply_inverse(b.columns[i]);
    reduce(norm, axes_b);
  }
  difference.norm = norm;
  std::copy(axes_b.begin(), axes_b.end(), difference.axes_b);

  // D = A^T (cA − cB) / |qA|² in units. Times the reduced norm it need not be an integer, so the
  // unit is made finer by the missing factor.
  const IntegerVector centre_world = length(c.pose_a.position()) - length(c.pose_b.position());
  IntegerVector centre = a.apply_inverse(centre_world);
  Integer centre_denominator = a.norm;

  if (plane) {
    DyadicScale normal_scale;
    normal_scale.include(plane->normal());
    const IntegerVector n = normal_scale(plane->normal());
    const IntegerVector normal_a = a.apply_inverse(b.apply(n));
    difference.is_plane = true;
    difference.plane_normal = normal_a;
    // The plane's point nearest to B's origin, displacement · n / |n|², becomes B's centre. With
    // the integer normal n_F = F n it is displacement · F · n_F / |n_F|²; in A's frame n_F becomes
    // normal_a / (|qA|² |qB|²).
    const Integer squared = dot(n, n);
    const Integer offset = length(plane->displacement()) * normal_scale.factor();
    const Integer plane_denominator = a.norm * b.norm * squared;
    centre = (b.norm * squared) * centre - offset * normal_a;
    centre_denominator = plane_denominator;
  }
  const Integer g = gcd(centre_denominator, norm);
  const Integer finer = centre_denominator / g;  // lengths are multiplied by this
  const Integer multiplier = norm / g;
  difference.d = multiplier * centre;
  difference.per_metre = length.factor() * finer;

  const auto size = [&](double value) { return Integer(length(value) * finer); };
  const auto add_body = [&](const Body& body, const std::array<IntegerVector, 3>& axes) {
    const auto frame = [&](int i) { return Frame{axes[i], axes[(i + 1) % 3], axes[(i + 2) % 3]}; };
    const auto of_core = [&](double outer) { return Integer(size(outer) - size(body.inset)); };
    difference.inflation += size(body.ball_radius);
    for (int i = 0; i < 3; ++i) {
      if (body.half_extents[i] == 0) continue;
      const Integer half = of_core(body.half_extents[i]);
      if (half != 0 || body.disc_radius > 0)
        add(difference.segments, &Difference::Segment::half_length, frame(i), half);
    }
    if (body.disc_radius > 0)
      add(difference.discs, &Difference::Disc::radius, frame(2), of_core(body.disc_radius));
  };
  add_body(body_a, {{{norm, 0, 0}, {0, norm, 0}, {0, 0, norm}}});
  add_body(body_b, axes_b);
  leave_out_point(difference);
  if (body_b.hull) {
    const auto in_frame = [&](const IntegerVector& v) {
      return v.x * axes_b[0] + v.y * axes_b[1] + v.z * axes_b[2];
    };
    const LocalHull local = local_hull(*body_b.hull, length, finer);
    difference.d = difference.d - in_frame(local.middle);
    difference.hull.emplace(Difference::Hull{{}, *body_b.hull, 0});
    for (const IntegerVector& v : local.vertices) {
      difference.hull->vertices.push_back(in_frame(v));
      difference.hull->reach =
          std::max(difference.hull->reach, Integer(abs(v.x) + abs(v.y) + abs(v.z)));
    }
  }
  return difference;
}

Integer sum_of_sizes(const Difference& difference) {
  Integer sum = difference.inflation;
  for (const auto& s : difference.segments) sum += s.half_length;
  for (const auto& disc : difference.discs) sum += disc.radius;
  if (difference.hull) sum += difference.hull->reach;
  return sum;
}

bool has_exact_faces(const Difference::Hull& hull) {
  const std::vector<IntegerVector>& vertices = hull.vertices;
  const Convex& body = hull.body;
  if (body.is_flat()) return vertices.size() == 3;
  std::vector<IntegerVector> normals;
  const auto above = [&](int face, int v) {
    return sgn(dot(normals[face], vertices[v] - vertices[body.faces()[face].vertices[0]]));
  };
  for (int face = 0; face < static_cast<int>(body.faces().size()); ++face) {
    normals.push_back(face_normal(hull, face));
    const std::vector<int>& on = body.faces()[face].vertices;
    for (std::size_t i = 3; i < on.size(); ++i) {
      if (above(face, on[i]) != 0) return false;
    }
  }
  std::vector<int> edges_at(vertices.size());
  for (const Convex::Edge& edge : body.edges()) {
    for (const int v : edge.vertices) ++edges_at[v];
    const std::vector<int>& beside = body.faces()[edge.faces[1]].vertices;
    const int beyond = *std::find_if(beside.begin(), beside.end(), [&](int v) {
      return v != edge.vertices[0] && v != edge.vertices[1];
    });
    if (above(edge.faces[0], beyond) >= 0) return false;
  }
  return std::all_of(edges_at.begin(), edges_at.end(), [](int edges) { return edges > 2; });
}

IntegerVector face_normal(const Difference::Hull& hull, int face) {
  const std::vector<int>& on = hull.body.faces()[face].vertices;
  const IntegerVector& corner = hull.vertices[on[0]];
  return cross(hull.vertices[on[1]] - corner, hull.vertices[on[2]] - corner);
}

IntegerVector edge_vector(const Difference::Hull& hull, int edge) {
  const auto& [from, to] = hull.body.edges()[edge].vertices;
  return hull.vertices[to] - hull.vertices[from];
}

IntegerVector in_frame_of_a(const Difference& difference, const Vec3& world) {
  DyadicScale scale;
  scale.include(world);
  const IntegerVector v = scale(world);
  const auto& rows = difference.world_rows;
  return v.x * rows[0] + v.y * rows[1] + v.z * rows[2];
}

Float width_in_units(const Difference& difference, const Configuration& configuration,
                     double width) {
  if (!(std::isfinite(width) && width > 0)) {
    throw InvalidInput("width", std::to_string(width), "must be positive and finite");
  }
  return Float(width) * Float(larger_size(configuration)) * Float(difference.per_metre);
}

BallDifference::BallDifference(const Difference& difference)
    : inflation_(difference.inflation, WorkingPrecision::bits()) {
  const auto rounded = [](const Integer& x) { return Ball(x, WorkingPrecision::bits()); };
  const Ball inverse_norm = Ball(1) / rounded(difference.norm);
  const auto divided = [&](const IntegerVector& v) { return inverse_norm * to_balls(v); };
  d_ = divided(difference.d);
  for (const auto& s : difference.segments) {
    segments_.push_back({divided(s.frame.axis), rounded(s.half_length)});
  }
  for (const auto& disc : difference.discs) {
    discs_.push_back({divided(disc.frame.axis), rounded(disc.radius)});
  }
  if (!difference.hull) return;
  const Ball inverse_reach = Ball(1) / rounded(difference.hull->reach);
  for (const IntegerVector& v : difference.hull->vertices) {
    const auto& [x, y, z] = vertices_.emplace_back(divided(v));
    relative_vertices_.emplace_back((inverse_reach * x).midpoint(), (inverse_reach * y).midpoint(),
                                    (inverse_reach * z).midpoint());
  }
}

BallDifference::Along BallDifference::along(const BallVector& n) const {
  const Ball inverse_length = Ball(1) / norm(n);
  return {dot(d_, n) * inverse_length,
          add_half_width(Ball(0), segments_, discs_, n) * inverse_length + inflation_};
}

std::vector<int> BallDifference::highest(const BallVector& n) const {
  // Doubles leave out what is lower by more than they and n are rounded by.
  constexpr double margin = 0x1p-30;
  const BallVector unit = (Ball(1) / norm(n)) * n;
  const auto is_known = [](const Ball& x) { return mag_cmp_2exp_si(arb_radref(x.get()), -40) < 0; };
  const bool leaves_out = is_known(unit.x) && is_known(unit.y) && is_known(unit.z);
  const Vec3 up(unit.x.midpoint(), unit.y.midpoint(), unit.z.midpoint());
  double top = -std::numeric_limits<double>::infinity();
  for (const Vec3& v : relative_vertices_) top = std::max(top, v.dot(up));
  std::vector<int> result;
  for (std::size_t i = 0; i < relative_vertices_.size(); ++i) {
    const bool is_lower = leaves_out && relative_vertices_[i].dot(up) < top - margin;
    if (!is_lower) result.push_back(static_cast<int>(i));
  }
  return result;
}

Ball BallDifference::height(const BallVector& n) const {
  if (vertices_.empty()) return 0;
  const std::vector<int> candidates = highest(n);
  Ball height = dot(vertices_[candidates.front()], n);
  for (const int i : candidates) height = max(height, dot(vertices_[i], n));
  return height / norm(n);
}

Ball BallDifference::gap(const BallVector& n) const {
  const Along a = along(n);
  if (vertices_.empty()) return a.centre_distance - a.half_width;
  return a.centre_distance - a.half_width - height(n);
}

}  // namespace touchstone::oracle
