#include "lens.hpp"

#include <algorithm>
#include <cmath>

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

}  // namespace touchstone
