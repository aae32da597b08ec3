#include "line_normals.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "point_ellipse.hpp"

namespace touchstone {
namespace {

using Vec2 = Eigen::Vector2d;

double cross(const Vec2& x, const Vec2& y) { return x.x() * y.y() - x.y() * y.x(); }

/// The largest p·n over unit n from `from` counter-clockwise to `to`, less than half a turn.
double largest_on_arc(const Vec2& p, const Vec2& from, const Vec2& to) {
  if (cross(from, p) > 0 && cross(p, to) > 0) return p.norm();
  return std::max(p.dot(from), p.dot(to));
}

/// The sum of all discs and the ball, seen along the line: an ellipse with half axes a >= b along
/// the frame's axes (of the disc that is tilted), widened by `round` (discs seen flat on).
struct RoundCorner {
  double a = 0, b = 0, round = 0;

  /// The point that is farthest along the unit vector n.
  Vec2 farthest(const Vec2& n) const {
    const Vec2 scaled(a * n.x(), b * n.y());
    const double length = scaled.norm();
    const Vec2 wide = round * n;
    return length > 0 ? Vec2(wide + Vec2(a * scaled.x(), b * scaled.y()) / length) : wide;
  }
};

/// A plane across the line with the bodies seen along it.
struct View {
  Vec3 line, x_axis, y_axis;
  RoundCorner corner;
  double lean = 0;  ///< how far the rim's point (0, b) lies along the line

  View(const ReducedPair& pair, const Vec3& along) : line(along) {
    const ReducedPair::Disc* tilted = nullptr;
    x_axis = line.unitOrthogonal();
    corner.round = pair.inflation;
    for (int j = 0; j < pair.disc_count; ++j) {
      const auto& disc = pair.discs[j];
      const Vec3 tilt = line.cross(disc.axis);
      if (tilt.isZero(0)) {
        corner.round += disc.radius;
        continue;
      }
      tilted = &disc;
      corner.a = disc.radius;
      corner.b = std::min(disc.radius, disc.radius * std::abs(line.dot(disc.axis)));
      x_axis = tilt.normalized();
    }
    // The product of nearly parallel axes has few digits left; across the line it must stay.
    x_axis = (x_axis - x_axis.dot(line) * line).normalized();
    y_axis = line.cross(x_axis);
    if (tilted) {
      const Vec3 rim = tilted->radius * tilted->axis.cross(x_axis);
      lean = rim.dot(y_axis) < 0 ? -rim.dot(line) : rim.dot(line);
    }
  }

  Vec2 to_plane(const Vec3& v) const { return {v.dot(x_axis), v.dot(y_axis)}; }
  Vec3 to_space(const Vec2& v) const { return v.x() * x_axis + v.y() * y_axis; }
};

/// No p on the arc of normals from..to has a larger gap than this, q being d less the corner that
/// the arc belongs to: each point of the sum bounds the gap by a sinusoid.
double most_on_arc(const View& view, const Vec2& q, const Vec2& from, const Vec2& to) {
  const Vec2 p0 = q - view.corner.farthest(from), p1 = q - view.corner.farthest(to);
  const Vec2 chord = p0 - p1;
  const double length = chord.norm();
  Vec2 middle(chord.y(), -chord.x());  // p0 and p1 bound alike here
  if (length > 0) middle /= length;
  if (middle.dot(from + to) < 0) middle = -middle;
  if (!(cross(from, middle) > 0 && cross(middle, to) > 0)) {
    return std::min(largest_on_arc(p0, from, to), largest_on_arc(p1, from, to));
  }
  return std::max(largest_on_arc(p0, from, middle), largest_on_arc(p1, middle, to));
}

void offer_corner(const ReducedPair& pair, const View& view, const Vec2& q, double along,
                  double half_length, BestNormal& best) {
  const RoundCorner& corner = view.corner;
  // A point of the sum, if the line's segment reaches there.
  const auto limit = [&](const Vec2& apart, double rim_along) {
    if (std::abs(along - rim_along) > half_length) return;
    best.limit = std::min(best.limit, std::max(apart.norm() - corner.round, 0.0));
  };
  if (corner.a == 0) {
    offer_normal(pair, view.to_space(q), best);
    limit(q, 0);
    // On the axis every radial direction is as good as another.
    if (q.norm() <= 1e-15 * pair.d.norm()) offer_normal(pair, view.x_axis, best);
    return;
  }
  const EllipseFeet feet = feet_on_ellipse(corner.a, corner.b, q.x(), q.y());
  for (int k = 0; k < feet.count; ++k) {
    const double c = std::cos(feet.angle[k]), s = std::sin(feet.angle[k]);
    const Vec2 apart = q - Vec2(corner.a * c, corner.b * s);
    offer_normal(pair, view.to_space({corner.b * c, corner.a * s}), best);
    limit(apart, view.lean * s);
    // The point itself where the ellipse ends in a vertex.
    offer_normal(pair, view.to_space(apart), best);
  }
}

}  // namespace

void offer_line_normals(const ReducedPair& pair, int line, BestNormal& best) {
  const auto& segment = pair.segments[line];
  const View view(pair, segment.axis);
  const Vec2 d = view.to_plane(pair.d);

  // Normals across a second segment too: there the corner changes. Within half a turn, in order.
  struct Turn {
    Vec2 normal;
    double angle;
  };
  // The frame's axes are among them to keep the arcs below half a turn.
  std::array<Turn, ReducedPair::max_segments + 1> turns = {Turn{{1, 0}, -1}, Turn{{0, 1}, 0}};
  int count = 2;
  for (int k = 0; k < pair.segment_count; ++k) {
    if (k == line) continue;
    const Vec2 s = view.to_plane(pair.segments[k].axis);
    const double length = s.norm();
    if (!(length > 0)) continue;  // parallel to the line: seen as a point
    Vec2 n(-s.y() / length, s.x() / length);
    if (n.y() < 0 || (n.y() == 0 && n.x() < 0)) n = -n;
    turns[count++] = {n, -n.x()};
  }
  for (int i = 1; i < count; ++i) {
    for (int k = i; k > 0 && turns[k].angle < turns[k - 1].angle; --k) {
      std::swap(turns[k], turns[k - 1]);
    }
  }

  for (int i = 0; i < count; ++i) {
    const Vec2 from = turns[i].normal;
    const Vec2 to = i + 1 < count ? turns[i + 1].normal : Vec2(-turns[0].normal);
    const Vec2 middle = from + to;
    Vec2 corner = Vec2::Zero();
    Vec3 corner_in_space = Vec3::Zero();
    for (int k = 0; k < pair.segment_count; ++k) {
      if (k == line) continue;
      const auto& s = pair.segments[k];
      const Vec2 seen = view.to_plane(s.axis);
      const double end = seen.dot(middle) < 0 ? -s.half_length : s.half_length;
      corner += end * seen;
      corner_in_space += end * s.axis;
    }
    for (const double side : {1.0, -1.0}) {
      const Vec2 q = d - side * corner;
      if (most_on_arc(view, q, side * from, side * to) <= best.gap + best.rounding) continue;
      offer_corner(pair, view, q, (pair.d - side * corner_in_space).dot(segment.axis),
                   segment.half_length, best);
    }
  }
}

}  // namespace touchstone
