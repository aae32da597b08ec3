#include "arc_polygon.hpp"

#include <algorithm>
#include <cmath>

namespace touchstone {
namespace {

/// Is x, on the circle about `centre`, on the arc counter-clockwise from p to q?
bool on_arc(const Vec2& centre, const Vec2& p, const Vec2& q, const Vec2& x) {
  const Vec2 to_p = p - centre, to_q = q - centre, to_x = x - centre;
  const bool after_p = cross2(to_p, to_x) >= 0, before_q = cross2(to_x, to_q) >= 0;
  const double cross = cross2(to_p, to_q), dot = to_p.dot(to_q);
  constexpr double hair = 1e-7;  // as in angle_between
  const bool beyond_half_a_turn = cross < 0 && (dot < 0 || cross < -hair * dot);
  return beyond_half_a_turn ? after_p || before_q : after_p && before_q;
}

}  // namespace

ArcPolygon::ArcPolygon(const Lens& lens) : circles_{lens.circle1, lens.circle2} {
  add(lens.right, 0);
  add(lens.left, 1);
}

void ArcPolygon::clip(const Vec2& normal, double bound) {
  // Of a circle, how far along the normal the line is, and where the circle leaves and returns.
  struct Crossing {
    double cosine;
    Vec2 leaves, returns;
  };
  const auto crossing = [&](const Circle& circle) -> Crossing {
    const double cosine = (bound - normal.dot(circle.centre)) / circle.radius;
    const double sine = std::sqrt(std::max(0.0, (1 - cosine) * (1 + cosine)));
    const Vec2 middle = circle.centre + circle.radius * cosine * normal;
    const Vec2 aside = circle.radius * sine * turned_left(normal);
    return {cosine, middle - aside, middle + aside};
  };
  constexpr double sliver = 1e-12;

  if (is_disc_) {
    const Crossing at = crossing(circles_[0]);
    if (at.cosine >= 1 - sliver) return;
    is_disc_ = false;
    if (at.cosine <= -1) return;
    add(at.leaves, straight);
    add(at.returns, 0);
    return;
  }
  const ArcPolygon before = *this;
  count_ = 0;
  for (int i = 0; i < before.count_; ++i) {
    const Vertex& vertex = before.vertices_[i];
    const Vec2 &p = vertex.at, &q = before.vertices_[before.next(i)].at;
    const double p_beyond = normal.dot(p) - bound, q_beyond = normal.dot(q) - bound;
    const bool p_stays = p_beyond <= 0, q_stays = q_beyond <= 0;
    if (count_ + 3 > max_vertices) return;  // cannot happen for the cuts of a patch
    if (p_stays) add(p, vertex.circle);
    if (vertex.circle == straight) {
      if (p_stays != q_stays) add(p + p_beyond / (p_beyond - q_beyond) * (q - p), straight);
      continue;
    }
    const Crossing at = crossing(circles_[vertex.circle]);
    if (at.cosine >= 1 - sliver) {
      if (!p_stays) add(p, vertex.circle);
      continue;
    }
    if (at.cosine <= -1) continue;
    const auto& [centre, radius] = circles_[vertex.circle];
    if (p_stays && !q_stays) {
      add(at.leaves, straight);
    } else if (!p_stays && q_stays) {
      add(at.returns, vertex.circle);
    } else if (on_arc(centre, p, q, centre + (p_stays ? radius : -radius) * normal)) {
      // The arc passes the place that is the farthest along the normal, or the least far. (Where
      // the line meets an end of the arc, rounding may put a crossing beyond it.)
      if (p_stays) {
        add(on_arc(centre, p, q, at.leaves) ? at.leaves : p, straight);
        add(on_arc(centre, p, q, at.returns) ? at.returns : q, vertex.circle);
      } else {
        add(on_arc(centre, p, q, at.returns) ? at.returns : p, vertex.circle);
        add(on_arc(centre, p, q, at.leaves) ? at.leaves : q, straight);
      }
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
    if (on_arc(centre, vertex.at, vertices_[next(i)].at, top)) offer(top);
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
    if (!on_arc(centre, vertex.at, vertices_[next(i)].at, top)) continue;
    std::copy_backward(vertices_.begin() + i + 1, vertices_.begin() + count_,
                       vertices_.begin() + count_ + 1);
    vertices_[i + 1] = {top, vertices_[i].circle};
    ++count_;
    return;
  }
}

}  // namespace touchstone
