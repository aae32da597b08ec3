#include "arc_polygon.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lens.hpp"

namespace touchstone {
namespace {

constexpr double quarter = std::numbers::pi / 2;

/// Is x, on the circle about `centre`, on the arc from p to q of at most half a turn?
bool on_arc(const Vec2& centre, const Vec2& p, const Vec2& q, const Vec2& x) {
  const Vec2 to_x = x - centre;
  return cross2(p - centre, to_x) >= 0 && cross2(to_x, q - centre) >= 0;
}

}  // namespace

ArcPolygon::ArcPolygon(const Circle& circle) {
  circles_[0] = circle;
  const double r = circle.radius;
  for (const Vec2& arm : {Vec2(r, 0), Vec2(0, r), Vec2(-r, 0), Vec2(0, -r)}) {
    add(circle.centre + arm, 0, false);
  }
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

}  // namespace touchstone
