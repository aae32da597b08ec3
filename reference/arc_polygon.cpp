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
  Vec2 centre, to_p, to_q;
  bool beyond_half_a_turn;

  Arc(const Vec2& middle, const Vec2& p, const Vec2& q)
      : centre(middle), to_p(p - middle), to_q(q - middle) {
    const double cross = cross2(to_p, to_q), dot = to_p.dot(to_q);
    constexpr double hair = 1e-7;  // as in angle_between
    beyond_half_a_turn = cross < 0 && (dot < 0 || cross < -hair * dot);
  }
  /// Is a point of the circle on the arc?
  bool holds(const Vec2& x) const {
    const Vec2 to_x = x - centre;
    const bool after_p = cross2(to_p, to_x) >= 0, before_q = cross2(to_x, to_q) >= 0;
    return beyond_half_a_turn ? after_p || before_q : after_p && before_q;
  }
};

}  // namespace

ArcPolygon::ArcPolygon(const Lens& lens) : circles_{lens.circle1, lens.circle2} {
  add(lens.right, 0);
  add(lens.left, 1);
}

void ArcPolygon::clip(const Vec2& normal, double bound) {
  // How far along the normal the line passes a circle's centre, in radii; the circle leaves the
  // half plane and returns to it at these places.
  const auto cosine = [&](const Circle& circle) {
    return (bound - normal.dot(circle.centre)) / circle.radius;
  };
  const auto place = [&](const Circle& circle, double at, double side) -> Vec2 {
    const double sine = std::sqrt(std::max(0.0, (1 - at) * (1 + at)));
    return circle.centre + circle.radius * (at * normal + side * sine * turned_left(normal));
  };
  const auto leaves = [&](const Circle& circle, double at) { return place(circle, at, -1); };
  const auto returns = [&](const Circle& circle, double at) { return place(circle, at, 1); };
  constexpr double sliver = 1e-12;

  if (is_disc_) {
    const double at = cosine(circles_[0]);
    if (at >= 1 - sliver) return;
    is_disc_ = false;
    if (at <= -1) return;
    add(leaves(circles_[0], at), straight);
    add(returns(circles_[0], at), 0);
    return;
  }
  const ArcPolygon before = *this;
  count_ = 0;
  const auto beyond = [&](const Vec2& x) { return normal.dot(x) - bound; };
  double q_beyond = before.count_ > 0 ? beyond(before.vertices_[0].at) : 0;
  for (int i = 0; i < before.count_; ++i) {
    const Vertex& vertex = before.vertices_[i];
    const Vec2 &p = vertex.at, &q = before.vertices_[before.next(i)].at;
    const double p_beyond = q_beyond;
    q_beyond = beyond(q);
    const bool p_stays = p_beyond <= 0, q_stays = q_beyond <= 0;
    if (count_ + 3 > max_vertices) return;  // cannot happen for the cuts of a patch
    if (p_stays) add(p, vertex.circle);
    if (vertex.circle == straight) {
      if (p_stays != q_stays) add(p + p_beyond / (p_beyond - q_beyond) * (q - p), straight);
      continue;
    }
    const Circle& circle = circles_[vertex.circle];
    const double at = cosine(circle);
    if (at >= 1 - sliver) {
      if (!p_stays) add(p, vertex.circle);
      continue;
    }
    if (at <= -1) continue;
    if (p_stays && !q_stays) {
      add(leaves(circle, at), straight);
      continue;
    }
    if (!p_stays && q_stays) {
      add(returns(circle, at), vertex.circle);
      continue;
    }
    const Arc arc(circle.centre, p, q);
    // Does it pass the place that is the farthest along the normal, or the least far? (Where the
    // line meets an end of the arc, rounding may put a crossing beyond it.)
    if (!arc.holds(circle.centre + (p_stays ? circle.radius : -circle.radius) * normal)) continue;
    const Vec2 out = leaves(circle, at), back = returns(circle, at);
    if (p_stays) {
      add(arc.holds(out) ? out : p, straight);
      add(arc.holds(back) ? back : q, vertex.circle);
    } else {
      add(arc.holds(back) ? back : p, vertex.circle);
      add(arc.holds(out) ? out : q, straight);
    }
  }
}

Vec2 ArcPolygon::farthest(const Vec2& direction) const {
  const Vec2 unit = direction.normalized();
  if (is_disc_) return circles_[0].centre + circles_[0].radius * unit;
  Vec2 best = vertices_[0].at;
  double most = unit.dot(best);
  const auto offer = [&](const Vec2& x) {
    if (unit.dot(x) > most) most = unit.dot(x), best = x;
  };
  for (int i = 0; i < count_; ++i) {
    const Vertex& vertex = vertices_[i];
    offer(vertex.at);
    if (vertex.circle == straight) continue;
    const auto& [centre, radius] = circles_[vertex.circle];
    const Vec2 top = centre + radius * unit;
    if (Arc(centre, vertex.at, vertices_[next(i)].at).holds(top)) offer(top);
  }
  return best;
}

void ArcPolygon::mark_farthest(const Vec2& direction) {
  const Vec2 unit = direction.normalized();
  for (int i = 0; i < count_ && count_ < max_vertices; ++i) {
    const Vertex& vertex = vertices_[i];
    if (vertex.circle == straight) continue;
    const auto& [centre, radius] = circles_[vertex.circle];
    const Vec2 top = centre + radius * unit;
    if (!Arc(centre, vertex.at, vertices_[next(i)].at).holds(top)) continue;
    std::copy_backward(vertices_.begin() + i + 1, vertices_.begin() + count_,
                       vertices_.begin() + count_ + 1);
    vertices_[i + 1] = {top, vertices_[i].circle};
    ++count_;
    return;
  }
}

// Points whose hull covers the region well.

namespace {

/// An arc that is not longer than this is covered well by its ends.
constexpr double long_arc = 0.4 * std::numbers::pi;
/// The square of its chord where the radius is 1: 2 - 2 cos 72° = (5 - √5) / 2.
constexpr double long_chord = 1.3819660112501051;
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
    const auto& [centre, radius] = circles_[0];
    int count = 0;
    for (const Vec2& arm : three_arms(radius, first.normalized())) points[count++] = centre + arm;
    return count;
  }

  struct Edge {
    Vec2 from;
    int circle;
    double chord_squared;
    bool beyond_half_a_turn;
    double angle;         // of an arc that is divided
    int inside;           // points on it, ends not counted
    double standing_out;  // how far its pieces do, as a part of the region's width there
  };
  std::array<Edge, max_vertices> edges;
  int total = 0;
  int corner = 0;
  for (int i = 1; i < count_; ++i) {
    if (first.dot(vertices_[i].at - vertices_[corner].at) > 0) corner = i;
  }
  const auto angle = [&](int i) {
    const Edge& e = edges[i];
    const Vec2& centre = circles_[e.circle].centre;
    return angle_between(e.from - centre, edges[i + 1 < count_ ? i + 1 : 0].from - centre);
  };
  for (int i = 0; i < count_; ++i, corner = next(corner)) {
    const auto& [from, circle] = vertices_[corner];
    const Vec2& to = vertices_[next(corner)].at;
    edges[i] = {from, circle, (to - from).squaredNorm(), false, 0, 0, 0};
    if (circle != straight) {
      edges[i].beyond_half_a_turn = Arc(circles_[circle].centre, from, to).beyond_half_a_turn;
    }
  }
  for (int i = 0; i < count_; ++i) {
    Edge& e = edges[i];
    if (e.circle != straight) {
      const double radius = circles_[e.circle].radius;
      const bool is_long = e.beyond_half_a_turn || e.chord_squared > long_chord * radius * radius;
      if (is_long) {
        e.angle = angle(i);
        e.inside = std::max(0, static_cast<int>(std::ceil(e.angle / long_arc - 1e-9)) - 1);
      }
    }
    total += 1 + e.inside;
  }
  const auto piece = [](const Edge& e) { return e.angle / (e.inside + 1); };
  // How far an arc stands out above its chord: 1 - cos = sin² / (1 + cos) of half its angle.
  const auto whole_rise = [&](const Edge& e) {
    const double radius = circles_[e.circle].radius;
    const double sine2 = std::min(e.chord_squared / (4 * radius * radius), 1.0);
    const double cosine = std::sqrt(1 - sine2);
    return radius * (e.beyond_half_a_turn ? 1 + cosine : sine2 / (1 + cosine));
  };
  const auto measure = [&](int i) {
    Edge& e = edges[i];
    if (e.circle == straight) return;
    const Vec2 chord = edges[i + 1 < count_ ? i + 1 : 0].from - e.from;
    const double length = chord.norm();
    double width = 0;
    for (int k = 0; k < count_ && length > 0; ++k) {
      width = std::max(width, cross2(chord, edges[k].from - e.from));
    }
    if (length > 0) width /= length;
    const double whole = whole_rise(e);
    const double of_piece =
        e.inside == 0 ? whole : circles_[e.circle].radius * (1 - std::cos(piece(e) / 2));
    e.standing_out = of_piece / (width + whole);
  };
  for (int i = 0; i < count_ && total < sufficient_points; ++i) measure(i);
  while (total < sufficient_points) {
    int most = 0;
    for (int i = 1; i < count_; ++i) {
      if (edges[i].standing_out > edges[most].standing_out) most = i;
    }
    if (!(edges[most].standing_out > flat_part)) break;
    if (edges[most].angle == 0) edges[most].angle = angle(most);
    ++edges[most].inside;
    ++total;
    measure(most);
  }

  std::array<Vec2, std::size_t{2} * max_vertices> all;
  int count = 0;
  for (int i = 0; i < count_; ++i) {
    const Edge& e = edges[i];
    all[count++] = e.from;
    if (e.inside == 0) continue;
    const Vec2& centre = circles_[e.circle].centre;
    const double step = piece(e), c = std::cos(step), s = std::sin(step);
    Vec2 arm = e.from - centre;
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
