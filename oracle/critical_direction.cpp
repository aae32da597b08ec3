// Directions with rational coordinates, and the functions that all kinds of directions use.
#include "oracle/critical_direction.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "oracle/real_roots.hpp"

namespace touchstone::oracle {
namespace {

/// Is the gap along n proven to be exactly zero? All terms are multiplied by norm.
bool gap_is_zero(const Difference& difference, const IntegerVector& n) {
  Integer a = dot(difference.d, n);
  if (difference.hull) {
    const auto& vertices = difference.hull->vertices;
    Integer highest = dot(vertices.front(), n);
    for (const IntegerVector& v : vertices) highest = std::max(highest, dot(v, n));
    a -= highest;
  }
  for (const auto& s : difference.segments) a -= s.half_length * abs(dot(s.frame.axis, n));
  std::vector<Integer> squares;
  for (const auto& disc : difference.discs) {
    const IntegerVector across = cross(disc.frame.axis, n);
    squares.push_back(disc.radius * disc.radius * dot(across, across));
  }
  squares.push_back(difference.inflation * difference.inflation * difference.norm *
                    difference.norm * dot(n, n));
  std::erase(squares, 0);
  if (squares.size() > 2) return false;  // not known: of two discs and a rounding
  squares.resize(2);
  return is_root_sum(a, squares[0], squares[1]);
}

/// n, and −n unless it is single.
class RationalDirection : public CriticalDirection {
 public:
  RationalDirection(IntegerVector n, std::optional<DirectionFamily> family, bool is_single)
      : n_(std::move(n)), family_(std::move(family)), is_single_(is_single) {}

  void enclose(const Difference& difference, const BallDifference& balls,
               std::vector<DirectionBound>& out) override {
    const BallVector n = to_balls(n_);
    const BallDifference::Along along = balls.along(n);
    const auto add = [&](const Ball& distance, const BallVector& towards) {
      Ball gap = distance - along.half_width;
      if (difference.hull) gap = gap - balls.height(towards);
      out.push_back({std::move(gap), towards});
    };
    add(along.centre_distance, n);
    if (!is_single_) add(-along.centre_distance, -n);
  }
  ZeroGap zero_gap(const Difference& difference) override {
    // Of opposite gaps only one can reach zero.
    const bool is_zero =
        gap_is_zero(difference, n_) || (!is_single_ && gap_is_zero(difference, -n_));
    return is_zero ? ZeroGap::zero : ZeroGap::unknown;
  }
  bool is_across(const IntegerVector& v) override { return dot(n_, v) == 0; }
  std::optional<DirectionFamily> family() const override { return family_; }

 private:
  IntegerVector n_;
  std::optional<DirectionFamily> family_;
  bool is_single_;
};

}  // namespace

TurnedFrame turned_frame(const Frame& frame, double heading) {
  if (heading == 0) return {frame, 1};
  const Integer tangent(std::ldexp(heading, heading_bits));
  const Integer one = Integer(1) << heading_bits;
  const Integer cosine = one * one - tangent * tangent, sine = 2 * one * tangent;
  return {{frame.axis, cosine * frame.e + sine * frame.f, cosine * frame.f - sine * frame.e},
          one * one + tangent * tangent};
}

namespace {

/// The segment that the site's directions are perpendicular to.
const Difference::Segment* segment_across(const Difference& difference, const CriticalSite& site) {
  const bool is_across = site.kind == CriticalSite::Kind::radial ||
                         (site.kind == CriticalSite::Kind::rim_line && !difference.hull);
  return is_across ? &difference.segments[site.first] : nullptr;
}

int vertex_of_hull(const Difference::Hull& hull, const CriticalSite& site) {
  return site.kind == CriticalSite::Kind::rim_line ? hull.body.edges()[site.first].vertices[0]
                                                   : static_cast<int>(site.second);
}

/// Other ends of the edges at a vertex.
std::vector<int> neighbours(const Convex& body, int vertex) {
  std::vector<int> result;
  for (const Convex::Edge& edge : body.edges()) {
    if (edge.vertices[0] == vertex) result.push_back(edge.vertices[1]);
    if (edge.vertices[1] == vertex) result.push_back(edge.vertices[0]);
  }
  return result;
}

/// A vertex of each of the edge's faces beside it.
std::vector<int> beside_edge(const Convex& body, const Convex::Edge& edge) {
  std::vector<int> result;
  for (const int face : edge.faces) {
    const std::vector<int>& on = body.faces()[face].vertices;
    result.push_back(*std::find_if(on.begin(), on.end(), [&](int v) {
      return v != edge.vertices[0] && v != edge.vertices[1];
    }));
  }
  return result;
}

}  // namespace

IntegerVector reduced_point(const Difference& difference, const CriticalSite& site) {
  IntegerVector q = reduced_point(difference, site.signs, segment_across(difference, site));
  if (!difference.hull) return q;
  return q - difference.hull->vertices[vertex_of_hull(*difference.hull, site)];
}

std::vector<IntegerVector> inward(const Difference& difference, const CriticalSite& site) {
  std::vector<IntegerVector> result;
  const Difference::Segment* const across = segment_across(difference, site);
  for (std::size_t i = 0; i < difference.segments.size(); ++i) {
    const auto& segment = difference.segments[i];
    if (&segment == across || segment.half_length == 0) continue;
    result.push_back((site.signs >> i & 1U) ? segment.frame.axis : -segment.frame.axis);
  }
  if (!difference.hull) return result;
  const auto& [vertices, body, reach] = *difference.hull;
  const int vertex = vertex_of_hull(*difference.hull, site);
  for (const int other : site.kind == CriticalSite::Kind::rim_line
                             ? beside_edge(body, body.edges()[site.first])
                             : neighbours(body, vertex)) {
    result.push_back(vertices[vertex] - vertices[other]);
  }
  return result;
}

DirectionFamily sector(const IntegerVector& line, const std::vector<IntegerVector>& inward) {
  if (inward.empty()) return {NormalFamily::Kind::circle, line, {}};
  const auto inside = [&](const IntegerVector& n) {
    return std::all_of(inward.begin(), inward.end(),
                       [&](const IntegerVector& v) { return dot(v, n) >= 0; });
  };
  DirectionFamily arc{NormalFamily::Kind::arc, line, {}};
  for (const IntegerVector& border : inward) {
    const IntegerVector end = cross(line, border);
    if (is_zero(end)) continue;
    for (const IntegerVector& n : {end, -end}) {
      const bool known = std::any_of(arc.ends.begin(), arc.ends.end(), [&](const IntegerVector& m) {
        return is_zero(cross(m, n)) && dot(m, n) > 0;
      });
      if (!known && inside(n)) arc.ends.push_back(n);
    }
  }
  if (arc.ends.size() != 2) return {NormalFamily::Kind::arc, line, {}};
  const int turn = sgn(dot(cross(arc.ends[0], arc.ends[1]), line));
  const IntegerVector middle = cross(line, arc.ends[0]);  // if the ends are opposite
  if (turn == 0 && !inside(middle) && !inside(-middle)) {
    // Of a polygon in space only the faces' normals: to each side of the line there is a neighbour.
    return {NormalFamily::Kind::arc, line, {}};
  }
  const bool forth = turn == 0 ? inside(middle) : turn > 0;
  if (!forth) std::swap(arc.ends[0], arc.ends[1]);
  return arc;
}

std::unique_ptr<CriticalDirection> rational_direction(IntegerVector n,
                                                      std::optional<DirectionFamily> family) {
  return std::make_unique<RationalDirection>(std::move(n), std::move(family), false);
}

Certainty at_vertex(const std::vector<IntegerVector>& inward, const BallVector& n) {
  Certainty result = Certainty::yes;
  for (const IntegerVector& v : inward) {
    Ball side = [&] {
      const WorkingPrecision few_bits(64);  // which nearly always decide
      return dot(to_balls(v), n);
    }();
    if (side.contains_zero()) side = dot(to_balls(v), n);
    if (side.is_negative()) return Certainty::no;
    if (!side.is_positive()) result = Certainty::undecided;
  }
  return result;
}

std::unique_ptr<CriticalDirection> single_direction(IntegerVector n) {
  return std::make_unique<RationalDirection>(std::move(n), std::nullopt, true);
}

}  // namespace touchstone::oracle
