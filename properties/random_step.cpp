#include "properties/random_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "properties/moves.hpp"
#include "properties/numbers.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

constexpr double min_magnitude = 0x1p-57;

/// The same orientation with unit length, however long the quaternion is.
Eigen::Quaterniond unit(const Eigen::Quaterniond& q) {
  const double largest =
      std::max({std::abs(q.w()), std::abs(q.x()), std::abs(q.y()), std::abs(q.z())});
  return normalized(
      Eigen::Quaterniond(q.w() / largest, q.x() / largest, q.y() / largest, q.z() / largest));
}

Eigen::Quaterniond inverse(const Eigen::Quaterniond& q) {
  return Eigen::Quaterniond(q.w(), -q.x(), -q.y(), -q.z());
}

/// The numbers of a configuration, while they are changed.
class Changing {
 public:
  Changing(const Configuration& c, double magnitude, Draw& draw)
      : n_(numbers_of(c)), magnitude_(magnitude), draw_(draw) {}

  void step() {
    switch (draw_.integer(0, 8)) {
      case 0:
      case 1:
        return shift();
      case 2:
      case 3:
        return turn();
      case 4:
        return resize();
      case 5:
        return resize_together();
      case 6:
        return align();
      case 7:
        return place();
      default:
        return round();
    }
  }

  /// Throws InvalidInput where a number has left its range.
  Configuration result(double min_size, double max_size) {
    for (double& size : n_.sizes) size = std::clamp(size, min_size, max_size);
    return configuration_of(n_);
  }

 private:
  double size() { return draw_.any_of(n_.sizes); }

  Vec3 axis_a() const { return axes(unit(n_.orientation_a)).z; }
  Vec3 axis_b() {
    const Axes b = axes(unit(n_.orientation_b));
    if (n_.pair == Pair::plane) return rotated(unit(n_.orientation_b), normalized(n_.normal));
    if (n_.pair != Pair::box) return b.z;
    const Vec3 all[] = {b.x, b.y, b.z};
    return draw_.any_of(all);
  }

  /// The direction of v; a random one where it has none.
  Vec3 direction_of(const Vec3& v) {
    constexpr double vanishing = 1e-250, overflowing = 1e250;
    const double squared = dot(v, v);
    return squared > vanishing && squared < overflowing ? normalized(v) : draw_.direction();
  }

  /// One along which cases are decided, or any.
  Vec3 direction() {
    const Vec3 world[] = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
    Vec3 a = axis_a(), b = axis_b();
    const Vec3 way = n_.position_a - n_.position_b;
    switch (draw_.integer(0, 6)) {
      case 0:
        return a;
      case 1:
        return b;
      case 2:
        return direction_of(cross(a, b));
      case 3:
        return direction_of(way - dot(way, a) * a);
      case 4:
        return direction_of(way - dot(way, b) * b);
      case 5:
        return draw_.any_of(world);
      default:
        return draw_.direction();
    }
  }

  void shift() {
    const double length = draw_.sign() * magnitude_ * size();
    n_.position_a += length * direction();
  }

  /// Turns a body about its own centre, an end of A's axis, or the other one's centre.
  void turn() {
    const bool of_a = draw_.coin();
    Vec3& position = of_a ? n_.position_a : n_.position_b;
    Eigen::Quaterniond& orientation = of_a ? n_.orientation_a : n_.orientation_b;
    const Vec3 about = direction();
    const double half = draw_.sign() * magnitude_ / 2;
    const Eigen::Quaterniond by =
        normalized(Eigen::Quaterniond(1, half * about.x(), half * about.y(), half * about.z()));
    const Vec3 end = n_.position_a + (draw_.sign() * n_.sizes[1]) * axis_a();
    const Vec3 pivots[] = {position, end, of_a ? n_.position_b : n_.position_a};
    const Vec3 pivot = draw_.any_of(pivots);
    orientation = product(by, orientation);
    position = pivot + rotated(by, position - pivot);
  }

  void resize() { draw_.any_of(n_.sizes) *= 1 + draw_.sign() * magnitude_ / 2; }

  /// Moves A by what one of its sizes grows, so that what touches on one side goes on to.
  void resize_together() {
    const int which = draw_.coin() ? 1 : 0;
    const double growth = draw_.sign() * magnitude_ / 2 * n_.sizes[which];
    n_.sizes[which] += growth;
    const Vec3 a = axis_a(), b = axis_b();
    const Vec3 along = which == 1 ? a : direction_of(b - dot(b, a) * a);
    n_.position_a += draw_.sign() * growth * along;
  }

  void align() {
    const Eigen::Quaterniond along[] = {upright, along_x, along_y};
    switch (draw_.integer(0, 5)) {
      case 0:
        draw_.any_of(n_.sizes) = size();
        return;
      case 5:
        return turn_to_align();
      case 1:
        n_.orientation_a = product(n_.orientation_b, draw_.any_of(along));
        return;
      case 2:
        (draw_.coin() ? n_.orientation_a : n_.orientation_b) = draw_.any_of(along);
        return;
      case 3: {  // into B's frame
        const Eigen::Quaterniond back = inverse(unit(n_.orientation_b));
        n_.position_a = rotated(back, n_.position_a - n_.position_b);
        n_.orientation_a = product(back, unit(n_.orientation_a));
        n_.orientation_b = Eigen::Quaterniond(1, 0, 0, 0);
        n_.position_b.setZero();
        return;
      }
      default:
        n_.position_a -= n_.position_b;
        n_.position_b.setZero();
    }
  }

  /// Turns A until its axis is parallel or perpendicular to one of B's, but for rounding.
  void turn_to_align() {
    const Vec3 a = axis_a(), b = axis_b();
    const Vec3 to = draw_.coin() ? b : direction_of(a - dot(a, b) * b);
    const double along = dot(a, to);
    const Vec3 across = (along < 0 ? -1 : 1) * cross(a, to);
    const Eigen::Quaterniond by =
        normalized(Eigen::Quaterniond(1 + std::abs(along), across.x(), across.y(), across.z()));
    n_.orientation_a = product(by, n_.orientation_a);
  }

  /// Makes an offset between the centres, along an axis of a body or across it, a sum or difference
  /// of sizes.
  void place() {
    const Eigen::Quaterniond frame = unit(draw_.coin() ? n_.orientation_a : n_.orientation_b);
    const std::int64_t sign = draw_.integer(-1, 1);
    const double first = size(), second = size();
    const double offset = first + static_cast<double>(sign) * second;
    Vec3 local = rotated(inverse(frame), n_.position_a - n_.position_b);
    if (draw_.coin()) {
      local[draw_.integer(0, 2)] = draw_.sign() * offset;
    } else if (const double across = std::sqrt(local.x() * local.x() + local.y() * local.y());
               across > 0) {
      local.x() *= offset / across;
      local.y() *= offset / across;
    }
    n_.position_a = n_.position_b + rotated(frame, local);
  }

  /// What leaves the geometry as it is, but for rounding.
  void round() {
    const auto all = every_number(n_);
    switch (draw_.integer(0, 3)) {
      case 0:
        return turn_both(n_, draw_.orientation());
      case 1: {
        const Eigen::Quaterniond forth = draw_.orientation();
        turn_both(n_, forth);
        return turn_both(n_, inverse(forth));
      }
      case 2: {
        double& x = *draw_.any_of(all);
        const double to = draw_.sign() * std::numeric_limits<double>::infinity();
        for (std::int64_t i = draw_.integer(1, 4); i > 0; --i) x = std::nextafter(x, to);
        return;
      }
      default:
        double* const coordinates[] = {
            &n_.position_a.x(),    &n_.position_a.y(),    &n_.position_a.z(),
            &n_.position_b.x(),    &n_.position_b.y(),    &n_.position_b.z(),
            &n_.orientation_a.x(), &n_.orientation_a.y(), &n_.orientation_a.z(),
            &n_.orientation_b.x(), &n_.orientation_b.y(), &n_.orientation_b.z()};
        *draw_.any_of(coordinates) = 0;
    }
  }

  Numbers n_;
  double magnitude_;
  Draw& draw_;
};

}  // namespace

RandomStep::RandomStep(const Configuration& start, Draw& draw) : draw_(draw) {
  const auto sizes = numbers_of(start).sizes;
  const auto [min, max] = std::minmax_element(sizes.begin(), sizes.end());
  min_size_ = *min / 2;
  max_size_ = 2 * *max;
}

Neighbour RandomStep::from(const Configuration& configuration, double likely) {
  constexpr int max_steps = 3, tries = 8;
  for (int i = 0; i < tries; ++i) {
    const bool is_near = likely > 0 && draw_.coin();
    const double magnitude = is_near
                                 ? draw_.log_uniform(std::max(likely / 8, min_magnitude),
                                                     std::clamp(likely * 8, 2 * min_magnitude, 1.0))
                                 : draw_.log_uniform(min_magnitude, 1);
    Changing changing(configuration, magnitude, draw_);
    for (std::int64_t k = draw_.integer(1, max_steps); k > 0; --k) changing.step();
    try {
      return {changing.result(min_size_, max_size_), magnitude};
    } catch (const InvalidInput&) {
      // Rounding may leave the range of valid numbers: try another step.
    }
  }
  return {configuration, min_magnitude};
}

}  // namespace touchstone
