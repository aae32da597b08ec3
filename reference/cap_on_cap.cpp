#include "cap_on_cap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace touchstone {

// A disc is held by three points, and one of which the other cap leaves a lens by four. Of nearly
// coaxial caps rounding says where the line of centres runs, so the four wait until it is clear.
CapOnCap::CapOnCap(const Circle& c1, const Circle& c2, const Vec2& anchor)
    : circle1_(c1), circle2_(c2), anchor_(anchor) {
  const double r1 = c1.radius, r2 = c2.radius, smaller = std::min(r1, r2);
  const Vec2 between = c2.centre - c1.centre;
  apart_ = between.norm();
  towards_ = apart_ > 0 ? Vec2(between / apart_) : Vec2(1, 0);
  missing_ = (apart_ - std::abs(r1 - r2)) / smaller;
  over_ = {(missing_ - clear) / handed_over};
  // The middle of circle 1 or circle 2, or of what they share on the line of centres.
  const double lo = std::max(-r1, apart_ - r2), hi = std::min(r1, apart_ + r2);
  radius_ = (hi - lo) / 2;
  along_ = (lo + hi) / 2;
  middle_ = c1.centre + along_ * towards_;
  circle1_.centre -= middle_;
  circle2_.centre -= middle_;
  if (!over_.has_begun()) return;
  // Where the common chord crosses the line of centres, and half its length.
  chord_ = (apart_ + (r1 - r2) * (r1 + r2) / apart_) / 2;
  const double half = std::sqrt(std::max(0.0, (r1 - chord_) * (r1 + chord_)));
  const Vec2 foot = (chord_ - along_) * towards_, aside = half * turned_left(towards_);
  left_ = foot + aside;
  right_ = foot - aside;
}

Vec2 CapOnCap::nearest() const {
  const double part = circle1_.radius / (circle1_.radius + circle2_.radius);
  return circle1_.centre + part * (circle2_.centre - circle1_.centre);
}

Vec2 CapOnCap::farthest(const Vec2& unit, double) const {
  if (!over_.has_begun()) return radius_ * unit;
  const auto is_in = [](const Circle& c, const Vec2& p) {
    return (p - c.centre).squaredNorm() <= c.radius * c.radius;
  };
  Vec2 top1 = circle1_.centre + circle1_.radius * unit;
  if (is_in(circle2_, top1)) return top1;
  Vec2 top2 = circle2_.centre + circle2_.radius * unit;
  if (is_in(circle1_, top2)) return top2;
  return unit.dot(left_) > unit.dot(right_) ? left_ : right_;
}

int CapOnCap::spread_lens(std::array<Vec2, max_points>& points) const {
  const double r1 = circle1_.radius, r2 = circle2_.radius;
  const double rise1 = r1 - chord_, rise2 = chord_ - (apart_ - r2);
  const Vec2 end1 = (r1 - along_) * towards_, end2 = (apart_ - r2 - along_) * towards_;
  // Of arcs that stand out alike, and until the disc's points are gone, their middles and the
  // lens's widest places; else two points of each arc.
  const Vec2 aside = turned_left(towards_);
  const Vec2 widest = chord_ <= 0        ? Vec2(circle1_.centre + r1 * aside)
                      : chord_ >= apart_ ? Vec2(circle2_.centre + r2 * aside)
                                         : left_;
  const double half = aside.dot(widest);
  constexpr double are_alike = 0.45, has_left = clear + 2 * handed_over;
  const double lower = std::min(rise1, rise2), higher = std::max(rise1, rise2);
  if (lower >= are_alike * higher || !over_.is_over()) {
    points[0] = end1, points[1] = widest, points[2] = end2, points[3] = widest - 2 * half * aside;
    return 4;
  }
  const double alike = lower / higher;
  const double uneven = ramp(alike, are_alike, 0.43) * ramp(missing_, has_left, 0.02);
  const bool first_is_flatter = rise1 < rise2;
  const Circle& round = first_is_flatter ? circle2_ : circle1_;
  const Circle& flat = first_is_flatter ? circle1_ : circle2_;
  const Vec2 out = first_is_flatter ? Vec2(-towards_) : towards_;
  const auto on = [](const Circle& c, const Vec2& direction) -> Vec2 {
    return c.centre + c.radius * direction.normalized();
  };
  const auto mirrored = [&](const Vec2& p) -> Vec2 {
    const Vec2 arm = p - round.centre;
    return round.centre + 2 * arm.dot(out) * out - arm;
  };
  const Vec2 corner = (left_ - round.centre) / round.radius;
  // In front near a third of the round arc's half; behind near the corner or, where the round
  // circle is nearly whole, on that one.
  constexpr double diagonal = 0.7071067811865476, third = 1.7, of_whole = 0.9;
  const double along = corner.dot(out);
  Vec2 front, rear;
  if (along < -diagonal) {
    front = out + of_whole * aside;
    rear = on(round, aside - out);
  } else {
    const double whole = ramp(along, -0.3, -diagonal);
    front = corner + (third + whole * (diagonal / of_whole + diagonal - third)) * out;
    const Vec2 on_flat = on(flat, 3 * (left_ - flat.centre) / flat.radius - out);
    rear = left_ + ramp(alike, 0.172, 0.25) * (on_flat - left_);
  }
  front = on(round, out + uneven * (front.normalized() - out));
  rear = widest + uneven * (rear - widest);
  points[0] = front, points[1] = rear, points[2] = mirrored(rear), points[3] = mirrored(front);
  if (uneven == 1) return 4;
  const Vec2& flat_end = first_is_flatter ? end1 : end2;
  points[4] = flat_end + uneven * ((rear + points[2]) / 2 - flat_end);
  return 5;
}

int CapOnCap::spread(const Vec2&, const Vec2& deepest, double clearness,
                     std::array<Vec2, max_points>& points) const {
  int count = 0;
  if (over_.has_begun()) count = spread_lens(points);
  if (!over_.is_over()) {
    // The lens's points set out from the disc's, which then follow them: whatever of them is cut
    // off, none comes or goes anywhere else.
    const int lens = count;
    const double set_out = ramp(over_.progress, 0, 1), follow = ramp(over_.progress, 1, 2);
    const auto arms = three_arms(radius_, anchor_.normalized());
    for (int i = 0; i < lens; ++i) points[i] = arms[i % 3] + set_out * (points[i] - arms[i % 3]);
    for (int i = 0; i < 3; ++i) {
      points[count] = arms[i];
      if (lens > 0) points[count] += follow * (points[i] - arms[i]);
      ++count;
    }
  }
  if (clearness > 0) points[count++] = clearness * deepest;
  return count;
}

void CapOnCap::cut_off(const Vec2& up, double height, std::array<Vec2, max_points>& points,
                       int count) const {
  const Vec2 along = turned_left(up);
  double lo = -std::numeric_limits<double>::infinity(), hi = -lo;
  for (const Circle& c : {circle1_, circle2_}) {
    const double above = height - up.dot(c.centre), foot = along.dot(c.centre);
    const double half = std::sqrt(std::max(0.0, (c.radius - above) * (c.radius + above)));
    lo = std::max(lo, foot - half);
    hi = std::min(hi, foot + half);
  }
  for (int i = 0; i < count; ++i) {
    if (up.dot(points[i]) > height) {
      points[i] = height * up + within(along.dot(points[i]), lo, hi) * along;
    }
  }
}

}  // namespace touchstone
