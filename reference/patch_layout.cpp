#include "patch_layout.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace touchstone {
namespace {

/// The same point twice would tell a solver that the body stands more firmly there.
constexpr double same = 1e-6;

}  // namespace

PatchLayout::Couple PatchLayout::nearest_two() const {
  Couple nearest{0, 0};
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < count; ++i) {
    for (int k = i + 1; k < count; ++k) {
      const double squared = (points[i] - points[k]).squaredNorm();
      if (squared < least) least = squared, nearest = {i, k};
    }
  }
  return nearest;
}

void PatchLayout::remove(int i) {
  std::copy(points.begin() + i + 1, points.begin() + count, points.begin() + i);
  --count;
  if (deepest_ > i) --deepest_;
}

void PatchLayout::add_deepest(const Vec2& deepest, double weight) {
  Vec2 sum = Vec2::Zero();
  double nearest_squared = std::numeric_limits<double>::infinity();
  for (int i = 0; i < count; ++i) {
    sum += points[i];
    const double squared = (points[i] - deepest).squaredNorm();
    if (squared < nearest_squared) nearest_squared = squared, deepest_ = i;
  }
  const Vec2 middle = sum / count;
  if (!(nearest_squared > same * same * (middle - deepest).squaredNorm())) return;
  deepest_ = count;
  add(middle + weight * (deepest - middle));
}

void PatchLayout::cut_off(const Vec2& slope, double bound) {
  std::array<double, capacity> above;
  int kept = 0;
  for (int i = 0; i < count; ++i) {
    above[i] = slope.dot(points[i]) - bound;
    kept += !(above[i] > 0);
  }
  if (kept == count || kept == 0) return;
  const Vec2 across = turned_left(slope);
  Vec2 first = Vec2::Zero(), last = first;
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (int i = 0; i < count; ++i) {
    for (int k = 0; k < count; ++k) {
      if (above[i] > 0 || !(above[k] > 0)) continue;
      const Vec2 p = points[i] + above[i] / (above[i] - above[k]) * (points[k] - points[i]);
      const double along = across.dot(p);
      if (along < least) least = along, first = p;
      if (along > most) most = along, last = p;
    }
  }
  for (int i = count - 1; i >= 0; --i) {
    if (above[i] > 0) remove(i);
  }
  add_apart(first);
  add_apart(last);
}

void PatchLayout::remove_within() {
  // The hull's lower and upper chain, of points from left to right (A. M. Andrew, 1979).
  std::array<int, capacity> order{}, chain{};
  for (int i = 0; i < count; ++i) order[i] = i;
  std::sort(order.begin(), order.begin() + count, [&](int i, int k) {
    return std::make_pair(points[i].x(), points[i].y()) <
           std::make_pair(points[k].x(), points[k].y());
  });
  std::array<bool, capacity> is_corner{};
  for (const double side : {1.0, -1.0}) {
    int length = 0;
    for (int k = 0; k < count; ++k) {
      const Vec2& p = points[order[k]];
      while (length > 1) {
        const Vec2 &last = points[chain[length - 1]], before = points[chain[length - 2]];
        if (side * cross2(last - before, p - last) > 0) break;
        --length;
      }
      chain[length++] = order[k];
    }
    for (int k = 0; k < length; ++k) is_corner[chain[k]] = true;
  }
  for (int i = count - 1; i >= 0 && count > Contact::max_points; --i) {
    if (!is_corner[i]) remove(i);
  }
}

void PatchLayout::reduce() {
  if (count > Contact::max_points) remove_within();
  while (count > Contact::max_points) {
    const auto [first, second] = nearest_two();
    if (first != deepest_ && second != deepest_) {
      points[first] = (points[first] + points[second]) / 2;
    }
    remove(second == deepest_ ? first : second);
  }
}

void PatchLayout::add_apart(const Vec2& p) {
  for (int i = 0; i < count; ++i) {
    if ((points[i] - p).squaredNorm() <= same * same * size * size) return;
  }
  add(p);
}

}  // namespace touchstone
