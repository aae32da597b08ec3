#include "oracle/patch/convex_set.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/ch_graham_andrew.h>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace touchstone::oracle {
namespace {

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }
Vec2 polar(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// x − sin x, without cancellation. The first omitted term of the series is 1e-17 of its first.
double minus_sine(double x) {
  if (x > 0.1) return x - std::sin(x);
  const double y = x * x;
  return x * y / 6 * (1 - y / 20 * (1 - y / 42 * (1 - y / 72 * (1 - y / 110))));
}

/// Area between an arc and its chord.
double segment_area(const BoundaryPiece& s) {
  return s.radius * s.radius * minus_sine(s.sweep) / 2;
}

/// ∫ (x − centre) over the area between an arc and its chord: (2/3) r³ sin³(sweep/2) towards the
/// arc's middle.
Vec2 segment_moment(const BoundaryPiece& s) {
  const double sine = s.radius * std::sin(s.sweep / 2);
  return 2.0 / 3 * sine * sine * sine * polar(s.start + s.sweep / 2);
}

bool arc_sees(const BoundaryPiece& s, const Vec2& direction) {
  double turn = std::atan2(direction.y(), direction.x()) - s.start;
  turn -= 2 * pi * std::floor(turn / (2 * pi));
  return turn <= s.sweep;
}

double distance_to_line(const BoundaryPiece& s, const Vec2& p) {
  const Vec2 along = s.to - s.from;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0 ? std::clamp((p - s.from).dot(along) / length2, 0.0, 1.0) : 0;
  return (p - s.from - t * along).norm();
}

double distance_to_side(const BoundaryPiece& s, const Vec2& p) {
  if (s.is_line()) return distance_to_line(s, p);
  if (arc_sees(s, p - s.centre)) return std::abs((p - s.centre).norm() - s.radius);
  return std::min((p - s.from).norm(), (p - s.to).norm());
}

}  // namespace

BoundaryPiece BoundaryPiece::arc(const Vec2& centre, double radius, double start, double sweep) {
  return {centre + radius * polar(start),
          centre + radius * polar(start + sweep),
          centre,
          radius,
          start,
          sweep};
}

ConvexSet ConvexSet::point(const Vec2& p) { return {Kind::point, {BoundaryPiece::line(p, p)}}; }
ConvexSet ConvexSet::segment(const Vec2& from, const Vec2& to) {
  return {Kind::segment, {BoundaryPiece::line(from, to)}};
}
ConvexSet ConvexSet::region(std::vector<BoundaryPiece> sides) {
  return {Kind::region, std::move(sides)};
}

ConvexSet ConvexSet::polygon(const std::vector<Vec2>& vertices) {
  if (vertices.size() == 1) return point(vertices[0]);
  if (vertices.size() == 2) return segment(vertices[0], vertices[1]);
  std::vector<BoundaryPiece> sides;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    sides.push_back(BoundaryPiece::line(vertices[i], vertices[(i + 1) % vertices.size()]));
  }
  return region(std::move(sides));
}

ConvexSet ConvexSet::scaled(int exponent) const {
  const auto times = [&](double x) { return std::scalbn(x, exponent); };
  std::vector<BoundaryPiece> sides = sides_;
  for (BoundaryPiece& s : sides) {
    s.from = s.from.unaryExpr(times), s.to = s.to.unaryExpr(times);
    s.centre = s.centre.unaryExpr(times), s.radius = times(s.radius);
  }
  return {kind_, std::move(sides)};
}

double ConvexSet::area() const {
  if (kind_ != Kind::region) return 0;
  // Relative to a corner of the set, so that its distance from the origin costs no digits.
  const Vec2 corner = sides_[0].from;
  double sum = 0;
  for (const BoundaryPiece& s : sides_) {
    sum += cross(s.from - corner, s.to - corner) / 2 + segment_area(s);
  }
  return sum;
}

double ConvexSet::perimeter() const {
  double sum = 0;
  for (const BoundaryPiece& s : sides_)
    sum += s.is_line() ? (s.to - s.from).norm() : s.radius * s.sweep;
  return sum;
}

Vec2 ConvexSet::centroid() const {
  if (kind_ != Kind::region) return (sides_[0].from + sides_[0].to) / 2;
  const Vec2 corner = sides_[0].from;
  double area = 0;
  Vec2 moment = Vec2::Zero(), mean = Vec2::Zero();
  for (const BoundaryPiece& s : sides_) {
    const Vec2 a = s.from - corner, b = s.to - corner;
    const double triangle = cross(a, b) / 2, segment = segment_area(s);
    area += triangle + segment;
    moment += triangle * (a + b) / 3 + segment * (s.centre - corner) + segment_moment(s);
    mean += a / static_cast<double>(sides_.size());
  }
  // Otherwise the region is so thin that its area is lost in rounding.
  return corner + (area > 0 ? Vec2(moment / area) : mean);
}

double ConvexSet::support(const Vec2& direction) const {
  double max = -std::numeric_limits<double>::infinity();
  for (const BoundaryPiece& s : sides_) {
    max = std::max({max, s.from.dot(direction), s.to.dot(direction)});
    if (!s.is_line() && arc_sees(s, direction)) {
      max = std::max(max, s.centre.dot(direction) + s.radius * direction.norm());
    }
  }
  return max;
}

bool ConvexSet::contains(const Vec2& p) const {
  return kind_ == Kind::region &&
         std::all_of(sides_.begin(), sides_.end(), [&](const BoundaryPiece& s) {
           return s.is_line() ? cross(s.to - s.from, p - s.from) >= 0
                              : (p - s.centre).norm() <= s.radius;
         });
}

double ConvexSet::distance(const Vec2& p) const {
  if (contains(p)) return 0;
  double min = std::numeric_limits<double>::infinity();
  for (const BoundaryPiece& s : sides_) min = std::min(min, distance_to_side(s, p));
  return min;
}

std::vector<Vec2> ConvexSet::outline(int per_quarter) const {
  if (kind_ == Kind::point) return {sides_[0].from};
  if (kind_ == Kind::segment) return {sides_[0].from, sides_[0].to};
  std::vector<Vec2> points;
  for (const BoundaryPiece& s : sides_) {
    points.push_back(s.from);
    const int chords = static_cast<int>(std::ceil(s.sweep / (pi / 2) * per_quarter));
    for (int i = 1; i < chords; ++i) {
      points.push_back(s.centre + s.radius * polar(s.start + s.sweep * i / chords));
    }
  }
  return points;
}

namespace {

/// The part of a polygon left of the line from `a` to `b` (Sutherland and Hodgman 1974).
std::vector<Vec2> left_of(const std::vector<Vec2>& polygon, const Vec2& a, const Vec2& b) {
  std::vector<Vec2> kept;
  kept.reserve(polygon.size() + 1);
  const Vec2 along = b - a;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double side_p = cross(along, p - a), side_q = cross(along, q - a);
    if (side_p >= 0) kept.push_back(p);
    if ((side_p >= 0) != (side_q >= 0)) kept.push_back(p + side_p / (side_p - side_q) * (q - p));
  }
  return kept;
}

Vec2 nearest_on_boundary(const std::vector<Vec2>& polygon, const Vec2& p) {
  Vec2 nearest = polygon[0];
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2& a = polygon[i];
    const Vec2 along = polygon[(i + 1) % polygon.size()] - a;
    const double length2 = along.squaredNorm();
    if (!(length2 > 0)) continue;
    const Vec2 q = a + std::clamp((p - a).dot(along) / length2, 0.0, 1.0) * along;
    if ((p - q).squaredNorm() < (p - nearest).squaredNorm()) nearest = q;
  }
  return nearest;
}

}  // namespace

std::vector<Vec2> plane_hull(const std::vector<Vec2>& points) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_2> all, extreme;
  all.reserve(points.size());
  for (const Vec2& p : points) all.emplace_back(p.x(), p.y());
  // Nearly all points are extreme: an algorithm that first looks for others takes twice as long.
  CGAL::ch_graham_andrew(all.begin(), all.end(), std::back_inserter(extreme));
  std::vector<Vec2> hull;
  hull.reserve(extreme.size());
  for (const auto& p : extreme) hull.emplace_back(p.x(), p.y());
  return hull;
}

std::vector<Vec2> intersection(const std::vector<Vec2>& p, const std::vector<Vec2>& q) {
  if (q.size() < 3 && p.size() >= 3) return intersection(q, p);
  if (q.size() < 3) return {};
  std::vector<Vec2> common = p;
  for (std::size_t i = 0; i < q.size() && !common.empty(); ++i) {
    common = left_of(common, q[i], q[(i + 1) % q.size()]);
  }
  return common.empty() ? common : plane_hull(common);
}

Vec2 halfway(const std::vector<Vec2>& p, const std::vector<Vec2>& q) {
  double min_distance = std::numeric_limits<double>::infinity();
  Vec2 middle = p[0];
  const auto meet = [&](const std::vector<Vec2>& vertices, const std::vector<Vec2>& other) {
    for (const Vec2& v : vertices) {
      const Vec2 w = nearest_on_boundary(other, v);
      if ((v - w).norm() < min_distance) {
        min_distance = (v - w).norm();
        middle = (v + w) / 2;
      }
    }
  };
  meet(p, q);
  meet(q, p);
  return middle;
}

}  // namespace touchstone::oracle
