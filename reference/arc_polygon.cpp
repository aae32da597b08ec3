#include "arc_polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace touchstone {
namespace {

constexpr double quarter = std::numbers::pi / 2;
/// An arc that is not longer than this is covered well by its ends.
constexpr double long_arc = quarter * 0.8;
/// An arc's piece that stands out by less than this part of the region's width is covered by its
/// ends.
constexpr double flat_part = 0.14;
/// With so many points an arc need not be divided for that.
constexpr int enough = 6;

Vec2 turned_left(const Vec2& v) { return {-v.y(), v.x()}; }

Vec2 rotated(const Vec2& v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

/// Counter-clockwise angle from p to q in [0, 2π).
double angle_between(const Vec2& p, const Vec2& q) {
  const double angle = std::atan2(cross2(p, q), p.dot(q));
  return angle < 0 ? angle + 4 * quarter : angle;
}

/// Is x, on the circle about `centre`, on the arc from p to q of at most half a turn?
bool on_arc(const Vec2& centre, const Vec2& p, const Vec2& q, const Vec2& x) {
  const Vec2 to_x = x - centre;
  return cross2(p - centre, to_x) >= 0 && cross2(to_x, q - centre) >= 0;
}

double twice_area(const Vec2& p, const Vec2& q, const Vec2& r) {
  return std::abs(cross2(q - p, r - p));
}

}  // namespace

ArcPolygon::ArcPolygon(const Circle& circle) {
  circles_[0] = circle;
  const double r = circle.radius;
  for (const Vec2& arm : {Vec2(r, 0), Vec2(0, r), Vec2(-r, 0), Vec2(0, -r)}) {
    add(circle.centre + arm, 0, false);
  }
}

Lens::Lens(const Circle& c1, const Circle& c2) : circle1(c1), circle2(c2) {
  const Vec2 between = c2.centre - c1.centre;
  const double distance = between.norm();
  const Vec2 towards = between / distance;
  // Where the common chord crosses the line of centres, and half its length.
  const double x = (distance + (c1.radius - c2.radius) * (c1.radius + c2.radius) / distance) / 2;
  const double half = std::sqrt(std::max(0.0, (c1.radius - x) * (c1.radius + x)));
  left = c1.centre + x * towards + half * turned_left(towards);
  right = c1.centre + x * towards - half * turned_left(towards);
}

Vec2 Lens::farthest(const Vec2& unit) const {
  const auto within = [](const Circle& c, const Vec2& p) {
    return (p - c.centre).squaredNorm() <= c.radius * c.radius;
  };
  const Vec2 top1 = circle1.centre + circle1.radius * unit;
  if (within(circle2, top1)) return top1;
  const Vec2 top2 = circle2.centre + circle2.radius * unit;
  if (within(circle1, top2)) return top2;
  return unit.dot(left) > unit.dot(right) ? left : right;
}

std::array<Vec2, 4> Lens::spread() const {
  const Vec2 towards = (circle2.centre - circle1.centre).normalized();
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

ArcPolygon ArcPolygon::lens(const Circle& circle1, const Circle& circle2) {
  const Lens lens(circle1, circle2);
  ArcPolygon result;
  result.circles_ = {circle1, circle2};
  result.add_arc(0, lens.right, lens.left);
  result.add_arc(1, lens.left, lens.right);
  return result;
}

void ArcPolygon::add_arc(int circle, const Vec2& from, const Vec2& to) {
  const Vec2& centre = circles_[circle].centre;
  const double angle = angle_between(from - centre, to - centre);
  const int pieces = std::max(1, static_cast<int>(std::ceil(angle / quarter)));
  add(from, circle, true);
  for (int i = 1; i < pieces; ++i) {
    add(centre + rotated(from - centre, i * angle / pieces), circle, false);
  }
}

void ArcPolygon::clip(const Vec2& normal, double bound) {
  const ArcPolygon before = *this;
  count_ = 0;
  for (int i = 0; i < before.count_; ++i) {
    const Vertex& vertex = before.vertices_[i];
    const Vec2 p = vertex.at, q = before.vertices_[(i + 1) % before.count_].at;
    const double p_beyond = normal.dot(p) - bound, q_beyond = normal.dot(q) - bound;
    const bool p_stays = p_beyond <= 0, q_stays = q_beyond <= 0;
    if (count_ + 3 > max_vertices) return;  // cannot happen for the cuts of a patch
    if (p_stays) add(p, vertex.circle, vertex.corner);
    if (vertex.circle == straight) {
      if (p_stays != q_stays) {
        const Vec2 crossing = p + p_beyond / (p_beyond - q_beyond) * (q - p);
        add(crossing, straight, true);
      }
      continue;
    }
    const auto& [centre, radius] = circles_[vertex.circle];
    const double cosine = (bound - normal.dot(centre)) / radius;
    constexpr double sliver = 1e-12;
    if (cosine >= 1 - sliver) {
      if (!p_stays) add(p, vertex.circle, vertex.corner);
      continue;
    }
    if (cosine <= -1) continue;
    const double sine = std::sqrt((1 - cosine) * (1 + cosine));
    const Vec2 middle = centre + radius * cosine * normal;
    const Vec2 aside = radius * sine * turned_left(normal);
    const Vec2 leaves = middle - aside, returns = middle + aside;
    if (p_stays && !q_stays) {
      add(leaves, straight, true);
    } else if (!p_stays && q_stays) {
      add(returns, vertex.circle, true);
    } else if (on_arc(centre, p, q, leaves) && on_arc(centre, p, q, returns)) {
      if (p_stays) {
        add(leaves, straight, true);
        add(returns, vertex.circle, true);
      } else {
        add(returns, vertex.circle, true);
        add(leaves, straight, true);
      }
    }
  }
}

Vec2 ArcPolygon::farthest(const Vec2& direction) const {
  const Vec2 unit = direction.normalized();
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
    if (on_arc(centre, vertex.at, vertices_[(i + 1) % count_].at, top)) offer(top);
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
    if (!on_arc(centre, vertex.at, vertices_[(i + 1) % count_].at, top)) continue;
    std::copy_backward(vertices_.begin() + i + 1, vertices_.begin() + count_,
                       vertices_.begin() + count_ + 1);
    vertices_[i + 1] = {top, vertices_[i].circle, true};
    ++count_;
    return;
  }
}

std::array<Vec2, 3> ArcPolygon::three_arms(double radius, const Vec2& unit) {
  const double half = 0.5, height = std::numbers::sqrt3 / 2;  // cos 60°, sin 60°
  const Vec2 arm = radius * unit;
  return {arm, height * turned_left(arm) - half * arm, -height * turned_left(arm) - half * arm};
}

int ArcPolygon::spread(const Vec2& first, std::array<Vec2, 8>& points) const {
  int start = -1;
  for (int i = 0; i < count_; ++i) {
    if (!vertices_[i].corner) continue;
    if (start < 0 || first.dot(vertices_[i].at - vertices_[start].at) > 0) start = i;
  }
  if (start < 0) {
    const auto& [centre, radius] = circles_[0];
    const auto arms = three_arms(radius, first.normalized());
    for (std::size_t i = 0; i < arms.size(); ++i) points[i] = centre + arms[i];
    return 3;
  }

  // From corner to corner; an arc that was divided is one edge again.
  struct Edge {
    Vec2 from;
    int circle;
    double angle;
    int inside;           // points on it, ends not counted
    double standing_out;  // how far its pieces do, as a part of the region's width there
  };
  std::array<Edge, max_vertices> edges;
  int edge_count = 0, total = 0;
  for (int i = 0; i < count_; ++i) {
    const Vertex& vertex = vertices_[(start + i) % count_];
    if (vertex.corner) edges[edge_count++] = {vertex.at, vertex.circle, 0, 0, 0};
    if (vertex.circle == straight) continue;
    const Vec2& centre = circles_[vertex.circle].centre;
    edges[edge_count - 1].angle +=
        angle_between(vertex.at - centre, vertices_[(start + i + 1) % count_].at - centre);
  }
  for (int i = 0; i < edge_count; ++i) {
    Edge& e = edges[i];
    e.inside = std::max(0, static_cast<int>(std::ceil(e.angle / long_arc - 1e-9)) - 1);
    total += 1 + e.inside;
  }
  const auto piece = [](const Edge& e) { return e.angle / (e.inside + 1); };
  const auto rise = [&](const Edge& e, double angle) {  // of an arc above its chord
    return circles_[e.circle].radius * (1 - std::cos(angle / 2));
  };
  const auto measure = [&](int i) {
    Edge& e = edges[i];
    if (e.circle == straight) return;
    const Vec2 chord = edges[(i + 1) % edge_count].from - e.from;
    const double length = chord.norm();
    double width = 0;
    for (int k = 0; k < edge_count && length > 0; ++k) {
      width = std::max(width, cross2(chord, edges[k].from - e.from) / length);
    }
    e.standing_out = rise(e, piece(e)) / (width + rise(e, e.angle));
  };
  for (int i = 0; i < edge_count && total < enough; ++i) measure(i);
  while (total < enough) {
    int most = 0;
    for (int i = 1; i < edge_count; ++i) {
      if (edges[i].standing_out > edges[most].standing_out) most = i;
    }
    if (!(edges[most].standing_out > flat_part)) break;
    ++edges[most].inside;
    ++total;
    measure(most);
  }

  std::array<Vec2, 2 * max_vertices> all;
  int count = 0;
  for (int i = 0; i < edge_count; ++i) {
    const Edge& e = edges[i];
    all[count++] = e.from;
    for (int k = 1; k <= e.inside; ++k) {
      const Vec2& centre = circles_[e.circle].centre;
      all[count++] = centre + rotated(e.from - centre, k * piece(e));
    }
  }
  while (count > static_cast<int>(points.size())) {  // but the first, the one that spans the least
    int least = 1;
    double least_area = std::numeric_limits<double>::infinity();
    for (int i = 1; i < count; ++i) {
      const double area = twice_area(all[(i + count - 1) % count], all[i], all[(i + 1) % count]);
      if (area < least_area) least_area = area, least = i;
    }
    std::copy(all.begin() + least + 1, all.begin() + count, all.begin() + least);
    --count;
  }
  std::copy(all.begin(), all.begin() + count, points.begin());
  return count;
}

}  // namespace touchstone
