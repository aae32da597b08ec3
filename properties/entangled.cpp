// Bodies that overlap arbitrarily, where proofs that end a search early have to hold.
#include <algorithm>

#include "properties/features.hpp"
#include "properties/pose_class.hpp"

namespace touchstone {
namespace {

using Quaternion = Eigen::Quaterniond;

/// A rotation away from an alignment by up to half a radian, about an axis near or far from those
/// of B.
Quaternion draw_clear_tilt(Draw& draw) {
  const Quaternion bases[] = {Quaternion(1, 0, 0, 0), Quaternion(1, 1, 0, 0)};
  const Quaternion quarters[] = {Quaternion(1, 0, 0, 0), Quaternion(1, 0, 0, 1)};
  const double half_angle = draw.sign() * draw.log_uniform(1e-7, 0.5) / 2;
  Quaternion heading = draw.turn_about_z();
  if (draw.coin()) {
    const double off = draw.log_uniform(1e-6, 0.5);
    heading = product(draw.any_of(quarters), Quaternion(1, 0, 0, off));
  }
  return product(product(heading, draw.any_of(bases)), Quaternion(1, half_angle, 0, 0));
}

/// Three coordinates in B's frame, each uniform within the bodies' reach, or near a coincidence of
/// their sizes.
Vec3 draw_offset_within(Draw& draw, const std::vector<double>& sizes) {
  const double reach = *std::max_element(sizes.begin(), sizes.end());
  const double part = draw.coin() ? 2 : draw.log_uniform(0.02, 2);
  Vec3 offset = Vec3::Zero();
  const bool coincides = draw.one_in(3);
  for (int i = 0; i < 3; ++i) {
    offset[i] = reach * part * draw.uniform(-1, 1);
    if (coincides && draw.coin()) {
      const double one = draw.any_of(sizes), other = draw.any_of(sizes);
      const double sum = draw.sign() * (one + draw.sign() * other);
      offset[i] = sum + draw.sign() * one * draw.log_uniform(1e-6, 0.5);
    }
  }
  return offset;
}

/// Parallel axes, caps that overlap by little, axes 1e-7 to 0.1 of a radius apart: here contact
/// points change from one layout to another.
void put_caps_together(Draw& draw, Numbers& n) {
  if (draw.coin()) n.sizes[2] = n.sizes[0];
  const double across = n.sizes[0] * draw.log_uniform(1e-7, 0.1);
  const double along = n.sizes[1] + n.sizes[3] - draw_shallow(draw, n.sizes[0]);
  n.orientation_a = n.orientation_b = Quaternion(1, 0, 0, 0);
  n.position_a = n.position_b + Vec3(across, 0, draw.sign() * along);
}

/// Parallel axes with nearly equal depths along and across B's axis: rounding, or a tilt, decides
/// which is smaller.
void make_depths_alike(Draw& draw, Numbers& n) {
  const double across = n.sizes[0] * draw.uniform(0, 2);
  const double depth = n.sizes[0] + n.sizes[2] - across;
  const double half_b = n.sizes.back();  // a box's along z; a capsule's end is a radius farther out
  const double cap_b = n.pair == Pair::capsule ? half_b + n.sizes[2] : half_b;
  const double along =
      n.sizes[1] + cap_b - depth + draw.sign() * n.sizes[0] * draw.log_uniform(1e-6, 0.1);
  n.position_a = n.position_b + across * draw.direction_across(Vec3(0, 0, 1));
  n.position_a.z() += draw.sign() * along;
}

/// Sides that cross close to the end of one of them, nearly at a right angle.
void cross_at_an_end(Draw& draw, Numbers& n) {
  const double quarter = draw.uniform(0.1, 1), lean = draw.log_uniform(1e-7, 1e-2);
  n.orientation_a = product(Quaternion(1, quarter, 0, 0), Quaternion(1, 0, draw.sign() * lean, 0));
  const Vec3 axis = rotated(n.orientation_a, Vec3(0, 0, 1));
  const double on_a = n.sizes[1] * (1 + draw.sign() * draw.log_uniform(1e-7, 1e-2));
  const double on_b = n.sizes[3] * draw.uniform(-1, 1);
  const double across = n.sizes[0] + n.sizes[2] - draw_shallow(draw, n.sizes[0]);
  n.position_a = n.position_b + Vec3(across, 0, on_b) - draw.sign() * on_a * axis;
}

}  // namespace

Numbers draw_entangled(Draw& draw, Pair pair) {
  Numbers n;
  n.pair = pair;
  n.sizes.resize(size_count(pair));
  for (double& size : n.sizes) size = draw.log_uniform(0.05, 2);
  if (pair == Pair::plane) {
    n.normal = Vec3(0, 0, 1);
    n.displacement = draw.uniform(-1, 1);
  }
  n.orientation_a = draw.one_in(4) ? draw.orientation() : draw_clear_tilt(draw);
  n.position_a = draw_offset_within(draw, n.sizes);
  if (pair != Pair::plane && draw.one_in(4)) make_depths_alike(draw, n);
  const bool has_sides = pair == Pair::capsule || pair == Pair::cylinder;
  if (has_sides && draw.one_in(4)) cross_at_an_end(draw, n);
  if (pair == Pair::cylinder && draw.one_in(4)) put_caps_together(draw, n);
  if (draw.one_in(4)) scale_both(n, static_cast<int>(draw.integer(-12, 12)));
  return n;
}

}  // namespace touchstone
