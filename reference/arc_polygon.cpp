#include "arc_polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "disc_layout.hpp"

namespace touchstone {

Lens::Lens(const Circle& c1, const Circle& c2, double apart, const Vec2& direction)
    : circle1(c1), circle2(c2), towards(direction) {
  // Where the common chord crosses the line of centres, and half its length.
  const double x = (apart + (c1.radius - c2.radius) * (c1.radius + c2.radius) / apart) / 2;
  const double half = std::sqrt(std::max(0.0, (c1.radius - x) * (c1.radius + x)));
  const Vec2 foot = c1.centre + x * towards, aside = half * turned_left(towards);
  left = foot + aside;
  right = foot - aside;
}

Vec2 Lens::farthest(const Vec2& unit) const {
  const auto within = [](const Circle& c, const Vec2& p) {
    return (p - c.centre).squaredNorm() <= c.radius * c.radius;
  };
  Vec2 top1 = circle1.centre + circle1.radius * unit;
  if (within(circle2, top1)) return top1;
  Vec2 top2 = circle2.centre + circle2.radius * unit;
  if (within(circle1, top2)) return top2;
  return unit.dot(left) > unit.dot(right) ? left : right;
}

std::array<Vec2, 4> Lens::spread() const {
  const Vec2 end1 = circle1.centre + circle1.radius * towards;
  const Vec2 end2 = circle2.centre - circle2.radius * towards;
  const double rise1 = (end1 - left).dot(towards), rise2 = (left - end2).dot(towards);
  // Arcs that stand out alike: their middles and the lens's widest places.
  constexpr double alike = 0.45, all_but_flat = 0.15;
  if (std::min(rise1, rise2) > alike * std::max(rise1, rise2)) {
    const Vec2 aside = turned_left(towards);
    return {end1, farthest(aside), end2, farthest(-aside)};
  }
  // Else two points of each; those of the flatter arc near the corners or, where the other circle
  // is nearly whole, on that one.
  const bool first_is_flatter = rise1 < rise2;
  const Circle& round = first_is_flatter ? circle2 : circle1;
  const Circle& flat = first_is_flatter ? circle1 : circle2;
  const Vec2 out = first_is_flatter ? Vec2(-towards) : towards;
  const auto on = [](const Circle& c, const Vec2& direction) -> Vec2 {
    return c.centre + c.radius * direction.normalized();
  };
  const auto mirrored = [&](const Vec2& p) -> Vec2 {
    const Vec2 arm = p - round.centre;
    return round.centre + 2 * arm.dot(out) * out - arm;
  };
  const Vec2 corner = (left - round.centre) / round.radius;
  constexpr double diagonal = 0.7071067811865476, third = 1.7;
  const double sign = cross2(out, corner) < 0 ? -1 : 1;
  const Vec2 aside = sign * turned_left(out);
  Vec2 front, rear;
  if (corner.dot(out) < -diagonal) {
    front = on(round, out + 0.9 * aside);
    rear = on(round, aside - out);
  } else {
    front = on(round, third * out + corner);  // near a third of the arc's half
    rear = left;
    if (std::min(rise1, rise2) > all_but_flat * std::max(rise1, rise2)) {
      rear = on(flat, 3 * (left - flat.centre) / flat.radius - out);
    }
  }
  return {front, rear, mirrored(rear), mirrored(front)};
}

namespace {

/// The part of the circle about `centre` counter-clockwise from p to q.
struct Arc {
  Vec2 to_p, to_q;

  Arc(const Vec2& centre, const Vec2& p, const Vec2& q) : to_p(p - centre), to_q(q - centre) {}
  bool beyond_half_a_turn() const {
    const double cross = cross2(to_p, to_q), dot = to_p.dot(to_q);
    constexpr double hair = 1e-7;  // as in angle_between
    return cross < 0 && (dot < 0 || cross < -hair * dot);
  }
  /// Is the circle's place in a direction from the centre on the arc, which has these products: of
  /// p with it, and of it with q?
  bool holds(double after_p, double before_q) const {
    if (after_p >= 0) return before_q >= 0 || beyond_half_a_turn();
    return before_q >= 0 && beyond_half_a_turn();
  }
};

}  // namespace

// Without branches on what is unpredictable: which edges cut the disc, and which corners lie in it.
// Where rounding puts one end of an edge in the disc and the other, no farther out, off it, the
// edge still ends where it ends.
ArcPolygon::ArcPolygon(const Circle& circle, const Strip& first, const Strip& second, double uncut)
    : circle_(circle) {
  const double r = circle.radius, x1 = first.across.x(), y1 = first.across.y();
  const double turn = cross2(first.across, second.across), side = std::copysign(1, turn);
  const double x2 = side * second.across.x(), y2 = side * second.across.y();
  const double offset1 = first.across.dot(circle.centre) - first.middle;
  const double offset2 = side * (second.across.dot(circle.centre) - second.middle);
  // Counter-clockwise, seen from the circle's centre: the edges' outward normals and distances.
  const double nx[4] = {x1, x2, -x1, -x2}, ny[4] = {y1, y2, -y1, -y2};
  const double distance[4] = {first.half_width - offset1, second.half_width - offset2,
                              first.half_width + offset1, second.half_width + offset2};
  const double inverse_sine = 1 / std::abs(turn), cosine = x1 * x2 + y1 * y2;
  // Where an edge begins and ends, along itself from the foot of the perpendicular.
  double begin[4], end[4];
  bool end_is_inside[4];
  double nearest_to_rim = std::numeric_limits<double>::infinity();  // of corners, in squares
  for (int i = 0; i < 4; ++i) {
    const double d = distance[i], before = distance[(i + 3) % 4], after = distance[(i + 1) % 4];
    const double slant = i % 2 == 0 ? cosine : -cosine;
    begin[i] = -(before + d * slant) * inverse_sine;
    end[i] = (after - d * slant) * inverse_sine;
    const double within = r * r - (d * d + end[i] * end[i]);
    end_is_inside[i] = within > 0;
    nearest_to_rim = std::min(nearest_to_rim, std::abs(within));
  }
  for (int i = 0; i < 4; ++i) {
    const double d = distance[i], half = std::sqrt(std::max(0.0, (r - d) * (r + d)));
    const bool begins_inside = end_is_inside[(i + 3) % 4], ends_inside = end_is_inside[i];
    const bool is_cut = begins_inside | ends_inside |
                        ((std::abs(d) < (1 - uncut) * r) & (begin[i] <= 0) & (end[i] >= 0));
    const auto add_if = [&](bool is_there, double along, Side edge) {
      vertices_[count_] = {Vec2(circle.centre.x() + d * nx[i] - along * ny[i],
                                circle.centre.y() + d * ny[i] + along * nx[i]),
                           edge};
      count_ += is_there;
    };
    // Of an edge that touches the rim from a corner on, only the corner is left.
    const bool touches = (std::abs(d) >= (1 - uncut) * r) & (begins_inside != ends_inside);
    add_if(is_cut & (begins_inside | !touches),
           begins_inside ? begin[i] : std::max(begin[i], -half), touches ? round : straight);
    add_if(is_cut & !ends_inside & !touches, std::min(end[i], half), round);
  }
  is_disc_ = count_ == 0 && *std::min_element(distance, distance + 4) >= 0;
  // Where a corner lies on the rim, rounding decides whether an arc is left beside it.
  if (nearest_to_rim <= 4 * uncut * r * r) merge_closer_than(uncut * r);
}

void ArcPolygon::merge_closer_than(double distance) {
  const auto are_close = [&](const Vertex& p, const Vertex& q) {
    return (p.at - q.at).squaredNorm() <= distance * distance;
  };
  int kept = 0;
  for (int i = 0; i < count_; ++i) {
    if (kept > 0 && are_close(vertices_[kept - 1], vertices_[i])) {
      vertices_[kept - 1].side = vertices_[i].side;
    } else {
      vertices_[kept++] = vertices_[i];
    }
  }
  while (kept > 1 && are_close(vertices_[kept - 1], vertices_[0])) --kept;
  count_ = kept;
}

ArcPolygon::Extremes ArcPolygon::extremes(const Vec2& unit) const {
  if (is_disc_) {
    const auto& [centre, radius] = circle_;
    return {centre + radius * unit, centre - radius * unit};
  }
  Extremes found{vertices_[0].at, vertices_[0].at};
  double highest = unit.dot(found.top), lowest = highest;
  const auto offer_top = [&](const Vec2& x) {
    if (const double height = unit.dot(x); height > highest) highest = height, found.top = x;
  };
  const auto offer_bottom = [&](const Vec2& x) {
    if (const double height = unit.dot(x); height < lowest) lowest = height, found.bottom = x;
  };
  for (int i = 0; i < count_; ++i) {
    const Vertex& vertex = vertices_[i];
    offer_top(vertex.at);
    offer_bottom(vertex.at);
    if (vertex.side == straight) continue;
    const auto& [centre, radius] = circle_;
    const Arc arc(centre, vertex.at, vertices_[next(i)].at);
    const double after_p = cross2(arc.to_p, unit), before_q = cross2(unit, arc.to_q);
    if (arc.holds(after_p, before_q)) offer_top(centre + radius * unit);
    if (arc.holds(-after_p, -before_q)) offer_bottom(centre - radius * unit);
  }
  return found;
}

// Points whose hull covers the region well.

namespace {

/// An arc that is not longer than this is covered well by its ends.
constexpr double long_arc = 0.4 * std::numbers::pi;
/// The squares of its chord and of that of two such, where the radius is 1:
/// 2 - 2 cos 72° = (5 - √5) / 2 and 2 - 2 cos 144° = (5 + √5) / 2.
constexpr double long_chord = 1.3819660112501051, chord_of_two = 3.618033988749895;
/// An arc's piece that stands out by less than this part of the region's width is covered by its
/// ends.
constexpr double flat_part = 0.14;
/// With so many points an arc need not be divided for that.
constexpr int sufficient_points = 6;

double twice_area(const Vec2& p, const Vec2& q, const Vec2& r) {
  return std::abs(cross2(q - p, r - p));
}

}  // namespace

int ArcPolygon::spread(const Vec2& first, std::array<Vec2, 8>& points) const {
  if (is_disc_) {
    const auto& [centre, radius] = circle_;
    int count = 0;
    for (const Vec2& arm : three_arms(radius, first.normalized())) points[count++] = centre + arm;
    return count;
  }

  struct Edge {
    Vec2 from, to;
    Side side;
    bool beyond_half_a_turn;
    double chord_squared;
    int inside;           // points on it, ends not counted
    double standing_out;  // how far its pieces do, as a part of the region's width there
  };
  std::array<Edge, max_vertices> edges;
  int total = 0;
  int corner = 0;
  double most = first.dot(vertices_[0].at);
  for (int i = 1; i < count_; ++i) {
    const double along = first.dot(vertices_[i].at);
    corner = along > most ? i : corner;
    most = std::max(most, along);
  }
  const auto angle = [&](const Edge& e) {
    const Vec2& centre = circle_.centre;
    return angle_between(e.from - centre, e.to - centre);
  };
  for (int i = 0; i < count_; ++i) {
    const auto& [from, side] = vertices_[corner];
    corner = next(corner);
    Edge& e = edges[i] = {from, vertices_[corner].at, side, false, 0, 0, 0};
    ++total;
    if (side == straight) continue;
    e.chord_squared = (e.to - from).squaredNorm();
    e.beyond_half_a_turn = Arc(circle_.centre, from, e.to).beyond_half_a_turn();
    const double squared = circle_.radius * circle_.radius;
    if (e.beyond_half_a_turn || e.chord_squared > chord_of_two * squared) {
      e.inside = std::max(0, static_cast<int>(std::ceil(angle(e) / long_arc - 1e-9)) - 1);
    } else {
      e.inside = e.chord_squared > long_chord * squared;
    }
    total += e.inside;
  }
  // How far an arc stands out above its chord: 1 - cos = sin² / (1 + cos) of half its angle.
  const auto whole_rise = [&](const Edge& e) {
    const double radius = circle_.radius;
    const double sine2 = std::min(e.chord_squared / (4 * radius * radius), 1.0);
    const double cosine = std::sqrt(1 - sine2);
    return radius * (e.beyond_half_a_turn ? 1 + cosine : sine2 / (1 + cosine));
  };
  const auto rise_of_piece = [&](const Edge& e, double whole) {
    const double radius = circle_.radius;
    if (e.inside == 0) return whole;
    if (e.inside > 1) return radius * (1 - std::cos(angle(e) / (2 * (e.inside + 1))));
    const double sine2 = whole / (2 * radius);  // 1 - cos = 2 sin² of the half
    return radius * sine2 / (1 + std::sqrt(1 - sine2));
  };
  const auto measure = [&](int i) {
    Edge& e = edges[i];
    if (e.side == straight) return;
    const Vec2 chord = e.to - e.from;
    double width = 0;
    for (int k = 0; k < count_; ++k) {
      width = std::max(width, cross2(chord, edges[k].from - e.from));
    }
    if (e.chord_squared > 0) width /= std::sqrt(e.chord_squared);
    const double whole = whole_rise(e);
    e.standing_out = rise_of_piece(e, whole) / (width + whole);
  };
  for (int i = 0; i < count_ && total < sufficient_points; ++i) measure(i);
  while (total < sufficient_points) {
    int outermost = 0;
    for (int i = 1; i < count_; ++i) {
      if (edges[i].standing_out > edges[outermost].standing_out) outermost = i;
    }
    if (!(edges[outermost].standing_out > flat_part)) break;
    ++edges[outermost].inside;
    ++total;
    measure(outermost);
  }

  std::array<Vec2, std::size_t{2} * max_vertices> all;
  int count = 0;
  for (int i = 0; i < count_; ++i) {
    const Edge& e = edges[i];
    all[count++] = e.from;
    if (e.inside == 0) continue;
    const auto& [centre, radius] = circle_;
    Vec2 arm = e.from - centre;
    if (e.inside == 1) {
      // Of a short arc the ends' sum keeps more digits than their difference.
      const Vec2 end = e.to - centre;
      const bool is_short = !e.beyond_half_a_turn && arm.dot(end) > 0;
      const Vec2 middle = is_short ? Vec2(arm + end) : turned_left(e.from - e.to);
      all[count++] = centre + radius / middle.norm() * middle;
      continue;
    }
    const double step = angle(e) / (e.inside + 1), c = std::cos(step), s = std::sin(step);
    for (int k = 1; k <= e.inside; ++k) {
      arm = Vec2(c * arm.x() - s * arm.y(), s * arm.x() + c * arm.y());
      all[count++] = centre + arm;
    }
  }
  while (count > static_cast<int>(points.size())) {  // but the first, the one that spans the least
    int least = 1;
    double min_area = std::numeric_limits<double>::infinity();
    for (int i = 1; i < count; ++i) {
      const double area = twice_area(all[(i + count - 1) % count], all[i], all[(i + 1) % count]);
      if (area < min_area) min_area = area, least = i;
    }
    std::copy(all.begin() + least + 1, all.begin() + count, all.begin() + least);
    --count;
  }
  std::copy(all.begin(), all.begin() + count, points.begin());
  return count;
}

}  // namespace touchstone
