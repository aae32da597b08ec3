#include "cap_on_face.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "disc_layout.hpp"
#include "manifold.hpp"

namespace touchstone {
namespace {

/// While an edge cuts off no more than this part of the radius, the three points of a whole cap are
/// handed over.
constexpr double handed_over = 0.01;
/// From this part of the way on the ends to which the body leans are there.
constexpr double has_begun = 0.1;
/// The ends of an edge that takes this part of the patch's width have grown out of one point.
constexpr double long_edge = 0.15;
/// From so many radii before all four edges cut on, the points beside the deepest place move there.
constexpr double makes_room = 0.05;
/// An edge that cuts off no more than this part of the radius has hardly two ends: where one of
/// them moves, the other one comes along.
constexpr double has_ends = 0.01;

}  // namespace

CapOnFace::CapOnFace(const Circle& cap, const Strip& first, const Strip& second)
    : radius_(cap.radius) {
  const double turn = cross2(first.across, second.across), side = std::copysign(1, turn);
  const Vec2 n0 = first.across, n1 = side * second.across;
  sine_ = std::abs(turn);
  cosine_ = n0.dot(n1);
  outward_ = {n0, n1, -n0, -n1};
  const Vec2 dual0 = turned_left(n1) / -sine_, dual1 = turned_left(n0) / sine_;
  dual_ = {dual0, dual1, -dual0, -dual1};
  const double offset0 = n0.dot(cap.centre) - first.middle;
  const double offset1 = side * (second.across.dot(cap.centre) - second.middle);
  const double distance[4] = {first.half_width - offset0, second.half_width - offset1,
                              first.half_width + offset0, second.half_width + offset1};
  max_cut_ = -std::numeric_limits<double>::infinity();
  min_cut_ = -max_cut_;
  for (int i = 0; i < 4; ++i) {
    Side& s = sides_[i];
    const double d = distance[i], least = -distance[before(i)], most = distance[next(i)];
    s.distance = d;
    // Where the circle is highest of all, and that of the part between the sides beside it.
    s.lo = s.hi = within(slant(i) * radius_, least, most);
    empty_ = empty_ || std::abs(s.lo) > radius_;
    s.top = circle_at(i, s.lo);
    s.height = std::min(s.top, d);
    const double cut = (s.top - d) / radius_;
    max_cut_ = std::max(max_cut_, cut);
    min_cut_ = std::min(min_cut_, cut);
    if (cut > 0) {
      const double half = sine_ * std::sqrt(std::max(0.0, (radius_ - d) * (radius_ + d)));
      s.lo = within(slant(i) * d - half, least, most);
      s.hi = within(slant(i) * d + half, s.lo, most);
    }
  }
  empty_ =
      empty_ || sides_[0].height + sides_[2].height < 0 || sides_[1].height + sides_[3].height < 0;
}

double CapOnFace::circle_at(int i, double lateral) const {
  return slant(i) * lateral +
         sine_ * std::sqrt(std::max(0.0, (radius_ - lateral) * (radius_ + lateral)));
}

Vec2 CapOnFace::nearest() const {
  const double x = within(0, -sides_[2].distance, sides_[0].distance);
  const double y = within(0, -sides_[3].distance, sides_[1].distance);
  return x != 0 && y != 0 ? place(0, x, y) : Vec2(x * outward_[0] + y * outward_[1]);
}

Vec2 CapOnFace::farthest(const Vec2& unit, double straight) const {
  Vec2 arm = radius_ * unit;
  const double x = outward_[0].dot(arm), y = outward_[1].dot(arm);
  if (x <= sides_[0].distance && y <= sides_[1].distance && -x <= sides_[2].distance &&
      -y <= sides_[3].distance) {
    return arm;
  }
  Vec2 farthest = Vec2::Zero();
  double most = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < 4; ++i) {
    const Side& s = sides_[i];
    const double sine = cross2(outward_[i], unit);
    if (s.top > s.distance && std::abs(sine) < straight && unit.dot(outward_[i]) > 0) {
      // At the end beside an arc no later than the arc goes on from there.
      const double half = (s.hi - s.lo) / 2, gain = std::max(radius_, half / straight);
      return place(i, s.height, within((s.lo + s.hi) / 2 + gain * sine, s.lo, s.hi));
    }
    for (const double lateral : {s.lo, s.hi}) {
      const Vec2 p = place(i, s.height, lateral);
      const double far = unit.dot(p);
      if (far > most) most = far, farthest = p;
    }
  }
  return farthest;
}

/// The patch's highest place above its own middle, seen along the side; in the larger half of a cap
/// farther out, where the points of two sides are one that the arc between them needs.
Vec2 CapOnFace::middle_of(int i) const {
  constexpr double farther = 0.6, diagonal = 0.7071067811865476;
  const double after = sides_[next(i)].height, behind = -sides_[before(i)].height;
  const double has_middle = ramp(std::min(after, -behind), -0.1 * radius_, 0);
  const double lateral = within((1 + farther * has_middle) * (after + behind) / 2,
                                -diagonal * radius_, diagonal * radius_);
  const double in_patch = within(lateral, behind, after);
  return place(i, std::min(sides_[i].distance, circle_at(i, in_patch)), in_patch);
}

int CapOnFace::spread(const Vec2& towards, const Vec2& deepest, double clearness,
                      std::array<Vec2, max_points>& points) const {
  const double room = ramp(min_cut_, -makes_room, 0), soon = std::min(2 * clearness, 1.0);
  const double cut_off = ramp(max_cut_, unseen_part, handed_over);
  const double progress = std::max(cut_off, soon * room);
  int count = 0;
  double radius = radius_;  // of a whole cap; an edge that hardly cuts narrows it
  for (const Side& s : sides_) radius = std::min(radius, s.distance);
  const auto arms = three_arms(radius, outward_[0]);
  if (progress == 0) {
    for (const Vec2& arm : arms) points[count++] = arm;
    if (clearness > 0) points[count++] = std::max(0.0, 2 * clearness - 1) * deepest;
    return count;
  }

  const double begun = soon * ramp(progress, 0, has_begun);
  int first[4], last[4];  // point of each side
  for (int i = 0; i < 4; ++i) {
    const Side& s = sides_[i];
    const double cut = (s.top - s.distance) / radius_;
    const Vec2 old = i == 2 ? (arms[1] + arms[2]) / 2 : arms[i == 3 ? 2 : i];
    // The ends to which the body leans are there before the others.
    const double faces = begun > 0 ? begun * ramp(towards.dot(outward_[i]), 0.5, 0.65) : 0;
    const double width = sides_[next(i)].height + sides_[before(i)].height;
    const double length = s.hi - s.lo, part = length / (long_edge * width);
    const double grown = std::max(part < 1 ? part * part : 1, faces);
    const double arrived = std::max(progress, faces);
    const Vec2 middle = grown < 1 ? middle_of(i) : Vec2(0, 0);
    const auto add_at = [&](double lateral) {
      const Vec2 p = middle + grown * (place(i, s.height, lateral) - middle);
      points[count++] = old + arrived * (p - old);
    };
    first[i] = count;
    add_at(s.lo);
    if (cut > 0) add_at(s.hi);
    last[i] = count - 1;
  }
  if (const double weight = clearness * room; weight > 0) {
    for (int i = 0; i < 4; ++i) {
      const Vec2 &p = points[last[i]], &q = points[first[next(i)]];
      const double after_p = cross2(p, towards), before_q = cross2(towards, q);
      if (!(after_p > 0 && before_q > 0 && cross2(p, q) > 0)) continue;
      const Vec2 from = p.normalized(), to = q.normalized(), between = (from + to).normalized();
      const Vec2 mirrored = 2 * towards.dot(between) * between - towards;
      const bool is_nearer_p = towards.dot(from) > towards.dot(to);
      const Vec2 &for_p = is_nearer_p ? towards : mirrored,
                 &for_q = is_nearer_p ? mirrored : towards;
      const auto move = [&](int side, int end, int other, const Vec2& way) {
        const Vec2 before = points[end];
        points[end] = before.norm() * (before.normalized() + weight * way).normalized();
        const double cut = (sides_[side].top - sides_[side].distance) / radius_;
        if (other != end) points[other] += ramp(cut, has_ends, 0) * (points[end] - before);
      };
      move(i, last[i], first[i], for_p - from);
      move(next(i), first[next(i)], last[next(i)], for_q - to);
      break;
    }
  }
  if (clearness > 0 && room < 1) {
    Vec2 middle = Vec2::Zero();
    for (int i = 0; i < 4; ++i) middle += progress / 8 * (points[first[i]] + points[last[i]]);
    points[count++] = middle + std::max(0.0, 2 * clearness - 1) * (deepest - middle);
  }
  return count;
}

void CapOnFace::cut_off(const Vec2& up, double height, std::array<Vec2, max_points>& points,
                        int count) const {
  const Vec2 along = turned_left(up);
  const double half = std::sqrt(std::max(0.0, (radius_ - height) * (radius_ + height)));
  double lo = -half, hi = half;
  // Where a line runs along an edge rounding would say where they cross.
  constexpr double parallel = 1e-9;
  for (int i = 0; i < 4; ++i) {
    const double rises = outward_[i].dot(along);
    const double left = sides_[i].distance - height * outward_[i].dot(up);
    if (rises > parallel) hi = std::min(hi, left / rises);
    if (rises < -parallel) lo = std::max(lo, left / rises);
  }
  for (int i = 0; i < count; ++i) {
    if (up.dot(points[i]) > height) {
      points[i] = height * up + within(along.dot(points[i]), lo, hi) * along;
    }
  }
}

}  // namespace touchstone
