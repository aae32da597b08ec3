#include "deepest_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace touchstone {
namespace {

/// d − σ n is a point of the sum of segments and discs: where a segment or disc is not across n,
/// its share is its end or rim point that is farthest along n; where it is, any share does that
/// makes up the rest.
class Shares {
 public:
  /// A segment or disc is taken to lie across n when the sine of its tilt is below `flat`.
  Shares(const ReducedPair& pair, const BestNormal& best, double flat)
      : pair_(pair), rest_(pair.d - (best.gap + pair.inflation) * best.normal) {
    const Vec3& n = best.normal;
    for (int i = 0; i < pair.segment_count; ++i) {
      const auto& s = pair.segments[i];
      const double along = s.axis.dot(n);
      if (std::abs(along) <= flat) {
        free_segment_[free_segments_++] = i;
      } else {
        set(segment_[i], std::copysign(s.half_length, along) * s.axis);
      }
    }
    for (int j = 0; j < pair.disc_count; ++j) {
      const auto& disc = pair.discs[j];
      const Vec3 across = disc.axis.cross(n).cross(disc.axis);
      const double length = across.norm();
      if (length <= flat) {
        free_disc_[free_discs_++] = j;
      } else {
        set(disc_[j], (disc.radius / length) * across);
      }
    }
    fill();
  }

  /// What no share makes up, metres.
  double remainder() const { return rest_.norm(); }

  Vec3 of_a() const { return -(segment_[0] + disc_[0]); }
  Vec3 of_b() const {
    Vec3 sum = disc_[1];
    for (int i = 1; i < pair_.segment_count; ++i) sum += segment_[i];
    return sum;
  }

 private:
  void set(Vec3& share, const Vec3& value) {
    rest_ += share - value;
    share = value;
  }

  /// Segments first, A's before B's, then B's disc and A's: each share takes what it can. That is
  /// exact but for segments which cross each other, whose shares depend on one another.
  void fill() {
    const bool crosses = free_discs_ == 0 && ((free_segments_ == 2 && cross_segment()) ||
                                              (free_segments_ == 3 && cross_rectangle()));
    constexpr int rounds = 3;
    for (int round = 0; round < rounds && remainder() > 1e-16 * pair_.size(); ++round) {
      // A's segment keeps its crossing until B's have taken theirs.
      for (int i = crosses && round == 0 ? 1 : 0; i < free_segments_; ++i) {
        project_segment(free_segment_[i]);
      }
      for (int j = free_discs_ - 1; j >= 0; --j) project_disc(free_disc_[j]);
    }
  }

  void project_segment(int i) { set_segment(i, (rest_ + segment_[i]).dot(pair_.segments[i].axis)); }

  void project_disc(int j) {
    const auto& disc = pair_.discs[j];
    Vec3 share = rest_ + disc_[j];
    share -= share.dot(disc.axis) * disc.axis;
    const double length = share.norm();
    set(disc_[j], length > disc.radius ? Vec3((disc.radius / length) * share) : share);
  }

  void set_segment(int i, double share) {
    const auto& s = pair_.segments[i];
    set(segment_[i], std::clamp(share, -s.half_length, s.half_length) * s.axis);
  }

  bool cross_segment() {
    const Vec3& s = pair_.segments[free_segment_[0]].axis;
    const Vec3& t = pair_.segments[free_segment_[1]].axis;
    const Vec3 normal = s.cross(t);
    const double squared = normal.squaredNorm();
    constexpr double parallel = 1e-24;
    if (squared <= parallel) return false;
    set_segment(free_segment_[0], rest_.cross(t).dot(normal) / squared);
    return true;
  }

  /// A's axis over a face of a box: the middle of what the face's two slabs leave of it.
  bool cross_rectangle() {
    const auto& s = pair_.segments[free_segment_[0]];
    double lo = -s.half_length, hi = s.half_length;
    for (int i = 1; i < 3; ++i) {
      const auto& side = pair_.segments[free_segment_[i]];
      const double slope = s.axis.dot(side.axis), middle = rest_.dot(side.axis);
      if (std::abs(slope) < 1e-12) continue;
      const double x = (middle - side.half_length) / slope;
      const double y = (middle + side.half_length) / slope;
      lo = std::max(lo, std::min(x, y));
      hi = std::min(hi, std::max(x, y));
    }
    set_segment(free_segment_[0], (lo + hi) / 2);
    return true;
  }

  const ReducedPair& pair_;
  Vec3 rest_;
  std::array<Vec3, ReducedPair::max_segments> segment_ = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero(),
                                                          Vec3::Zero()};
  std::array<Vec3, ReducedPair::max_discs> disc_ = {Vec3::Zero(), Vec3::Zero()};
  std::array<int, ReducedPair::max_segments> free_segment_;
  std::array<int, ReducedPair::max_discs> free_disc_;
  int free_segments_ = 0, free_discs_ = 0;
};

}  // namespace

Contact with_deepest_point(const ReducedPair& pair, const Vec3& centre_b, const BestNormal& best,
                           double contact_threshold) {
  Contact contact;
  contact.normal = best.normal;
  contact.signed_distance = best.gap;
  if (best.gap > contact_threshold) return contact;

  // Rounding of the normal hides which features are exactly across it: the fewest that make up the
  // whole are taken.
  double smallest_remainder = std::numeric_limits<double>::infinity();
  Vec3 halfway = Vec3::Zero();
  for (const double flat : {1e-12, 1e-9, 1e-7, 1e-5, 1e-3}) {
    const Shares shares(pair, best, flat);
    if (shares.remainder() < smallest_remainder) {
      smallest_remainder = shares.remainder();
      halfway = (shares.of_b() + pair.inflation * best.normal + pair.d + shares.of_a()) / 2;
    }
    if (smallest_remainder <= 1e-13 * pair.size()) break;
  }
  contact.add_point(centre_b + halfway, -best.gap);
  return contact;
}

}  // namespace touchstone
