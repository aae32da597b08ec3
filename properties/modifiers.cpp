#include "properties/modifiers.hpp"

#include <cmath>
#include <fmt/format.h>

#include "properties/moves.hpp"
#include "properties/numbers.hpp"

namespace touchstone {
namespace {

using Quaternion = Eigen::Quaterniond;

constexpr int smallest_tilt = 15;
constexpr std::array<double, smallest_tilt + 1> power_of_ten = {
    1,    1e-1, 1e-2,  1e-3,  1e-4,  1e-5,  1e-6,  1e-7,
    1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14, 1e-15};

/// A tilt of A (radians, to second order) about a random axis perpendicular to its own z. If B's
/// axis lies along A's x, only the y component of that axis tilts the two towards each other: it is
/// at least 0.5.
Quaternion draw_tilt(Draw& draw, double tilt, bool across) {
  for (;;) {
    const Vec3 axis = draw.direction_across(Vec3(0, 0, 1));
    if (across && std::abs(axis.y()) < 0.5) continue;
    return Quaternion(1, tilt / 2 * axis.x(), tilt / 2 * axis.y(), 0);
  }
}

Configuration tilted(Draw& draw, const Configuration& c, int k, bool across) {
  const Quaternion tilt = draw_tilt(draw, power_of_ten[static_cast<std::size_t>(k)], across);
  return {c.a, Pose(c.pose_a.position(), product(c.pose_a.orientation(), tilt)), c.b, c.pose_b};
}

/// Moves a body there and back in steps of its own, few and large or many and small, of which only
/// the rounding is left. A round one may also have turned about its axis, which nobody sees.
Pose moved_there_and_back(Draw& draw, const Pose& pose, bool is_round) {
  Quaternion q = pose.orientation();
  Vec3 x = pose.position();
  if (is_round && draw.coin()) q = normalized(product(q, draw.turn_about_z()));
  const bool is_small = draw.coin();
  const int steps =
      is_small ? static_cast<int>(draw.log_uniform(1, 1000)) : static_cast<int>(draw.integer(1, 4));
  Quaternion turn = draw.orientation();
  if (is_small) {
    constexpr double half_angle = 0.005;
    turn = normalized(
        Quaternion(1, half_angle * turn.x(), half_angle * turn.y(), half_angle * turn.z()));
  }
  const double way_in_all = draw.uniform(0, 3);
  const Vec3 step = way_in_all / steps * draw.direction();
  for (const double side : {1.0, -1.0}) {
    const Quaternion by(turn.w(), side * turn.x(), side * turn.y(), side * turn.z());
    for (int i = 0; i < steps; ++i) {
      q = normalized(product(by, q));
      x += side * step;
    }
  }
  return {x, q};
}

Configuration worn(Draw& draw, const Configuration& c) {
  const Pose a = moved_there_and_back(draw, c.pose_a, is_round(c.a));
  return {c.a, a, c.b, moved_there_and_back(draw, c.pose_b, is_round(c.b))};
}

/// Turns and moves both bodies as one; their orientations are of unit length afterwards, as those
/// of moving bodies are.
Configuration turned(Draw& draw, const Configuration& c) {
  const Quaternion by = draw.orientation();
  const Vec3 shift{draw.uniform(-1, 1), draw.uniform(-1, 1), draw.uniform(-1, 1)};
  const auto moved = [&](const Pose& pose) {
    return Pose(rotated(by, pose.position()) + shift, normalized(product(by, pose.orientation())));
  };
  return {c.a, moved(c.pose_a), c.b, moved(c.pose_b)};
}

Configuration not_quite_unit(Draw& draw, const Configuration& c) {
  const auto stretched = [&](const Pose& pose) {
    const double sign = draw.sign();
    const double factor = 1 + sign * draw.log_uniform(1e-16, 1e-7);
    const Quaternion& q = pose.orientation();
    return Pose(pose.position(),
                Quaternion(factor * q.w(), factor * q.x(), factor * q.y(), factor * q.z()));
  };
  const Pose a = stretched(c.pose_a);
  return {c.a, a, c.b, stretched(c.pose_b)};
}

}  // namespace

const std::vector<Modifier>& all_modifiers() {
  static const std::vector<Modifier> all = [] {
    const auto value = [](auto v) { return static_cast<int>(v); };
    std::vector<Modifier> m = {
        {ModifierKind::clearance, value(Clearance::shallow), "shallow",
         "The overlap is 1e-6 to 5% of the smaller size, as of resting contacts."},
        {ModifierKind::clearance, value(Clearance::apart), "apart",
         "The clearance is 1e-6 to 1 of the smaller size: a contact query must say no, a distance "
         "query how far."},
        {ModifierKind::clearance, value(Clearance::touching), "touching",
         "The clearance is zero: to the last bit where the arrangement is exact, else as nearly as "
         "doubles can say."},
        {ModifierKind::clearance, value(Clearance::deep), "deep",
         "The overlap is of the order of the smaller size: many directions compete to be the way "
         "out."},
        {ModifierKind::proportions, value(Proportions::needle), "needle",
         "A is a needle, 1000 times longer than wide."},
        {ModifierKind::proportions, value(Proportions::coin), "coin",
         "A is a coin, 1000 times wider than thick."},
        {ModifierKind::proportions, value(Proportions::plate), "plate",
         "The box or hull is a plate of 1000:1000:1 or a bar of 1000:1:1."},
        {ModifierKind::proportions, value(Proportions::uneven), "uneven",
         "One body is 100 to 1000 times smaller than otherwise."},
        {ModifierKind::proportions, value(Proportions::needles), "needles",
         "Both bodies are needles, 1000 times longer than wide: where they cross hangs on the last "
         "digits of their axes.",
         2},
        {ModifierKind::hull, value(HullForm::regular), "regular",
         "The hull is one of the five regular solids.", 3},
        {ModifierKind::hull, value(HullForm::of_box), "of-box",
         "The hull is that of a box's corners: the answer is the box's.", 3},
        {ModifierKind::hull, value(HullForm::of_prism), "of-prism",
         "The hull is a regular prism of 3 to 16 sides, as engines make of a cylinder.", 3},
        {ModifierKind::hull, value(HullForm::triangle), "triangle",
         "The hull is a triangle, as floors are made of: it has no inside, two normals and three "
         "edges.",
         3},
        {ModifierKind::hull, value(HullForm::wedge), "wedge",
         "The hull is a wedge whose faces enclose 1e-1 to 1e-6 rad: normals on both sides of its "
         "edge are nearly opposite.",
         3},
        {ModifierKind::hull, value(HullForm::nearly_coplanar), "nearly-coplanar",
         "Faces of the hull lie in one plane, and vertices in one place, but for 1e-3 to 1e-15: "
         "edges that hardly are some.",
         3},
    };
    for (int k = 1; k <= smallest_tilt; ++k) {
      m.push_back({ModifierKind::tilt, k, fmt::format("tilted-1e-{}", k),
                   fmt::format("A is tilted by 1e-{} rad about its centre.", k)});
    }
    m.push_back({ModifierKind::frame, value(Frame::aligned), "aligned",
                 "The arrangement lies along the world's own axes."});
    m.push_back({ModifierKind::frame, value(Frame::turned), "turned",
                 "Both bodies are turned and moved as one, by any rotation: what was exact is so "
                 "but for rounding."});
    m.push_back({ModifierKind::frame, value(Frame::worn), "worn",
                 "Both bodies are turned as one, and then each is moved there and back in steps of "
                 "its own, as a simulation leaves it: what was exact is so but for the rounding of "
                 "both.",
                 2});
    m.push_back(
        {ModifierKind::scale, value(Scale::tiny), "tiny",
         "All lengths are times 1e-6 (2^-20 where the arrangement is exact): absolute tolerances "
         "show."});
    m.push_back(
        {ModifierKind::scale, value(Scale::huge), "huge",
         "All lengths are times 1e6 (2^20 where the arrangement is exact): absolute tolerances "
         "show."});
    m.push_back(
        {ModifierKind::unit, 1, "not-quite-unit",
         "The quaternions' lengths are off by 1e-16 to 1e-7, as an integrator leaves them."});
    m.push_back({ModifierKind::distance, 1, "far",
                 "Both bodies are a million metres away: positions must be subtracted before "
                 "anything else."});
    return m;
  }();
  return all;
}

std::vector<const Modifier*> Modifiers::list() const {
  std::vector<const Modifier*> result;
  for (const Modifier& m : all_modifiers()) {
    if (has(m)) result.push_back(&m);
  }
  return result;
}

int Modifiers::count() const {
  int n = 0;
  for (const int value : values_) n += value != 0;
  return n;
}

double draw_shallow(Draw& draw, double size) { return -size * draw.log_uniform(1e-6, 0.05); }

double draw_apart(Draw& draw, double size) { return size * draw.log_uniform(1e-6, 1); }

double draw_clearance(Draw& draw, Clearance clearance, double size) {
  switch (clearance) {
    case Clearance::shallow:
      return draw_shallow(draw, size);
    case Clearance::apart:
      return draw_apart(draw, size);
    case Clearance::touching:
      return 0;
    default:
      return draw.integer(0, 3) == 0 ? draw_apart(draw, size) : draw_shallow(draw, size);
  }
}

Forms forms(Proportions proportions) {
  switch (proportions) {
    case Proportions::needle:
      return {Form::needle, Form::usual};
    case Proportions::coin:
      return {Form::coin, Form::usual};
    case Proportions::needles:
      return {Form::needle, Form::needle};
    case Proportions::usual:
    case Proportions::plate:
    case Proportions::uneven:
      break;
  }
  return {Form::usual, Form::usual};
}

std::array<bool, 3> draw_thin_extents(Draw& draw) {
  const bool plate = draw.coin();
  std::array<bool, 3> is_thin{!plate, !plate, !plate};
  is_thin[static_cast<std::size_t>(draw.integer(0, 2))] = plate;
  return is_thin;
}

std::int64_t draw_uneven_ratio(Draw& draw) { return draw.integer(100, 1000); }

Configuration modified(Draw& draw, const Configuration& made, const Modifiers& modifiers,
                       const Finish& finish) {
  Configuration c = made;
  if (const int k = modifiers[ModifierKind::tilt]) c = tilted(draw, c, k, finish.across);
  const bool is_worn = modifiers.frame() == Frame::worn;
  if (is_worn || modifiers.frame() == Frame::turned) c = turned(draw, c);
  if (is_worn) c = worn(draw, c);
  if (modifiers.scale() != Scale::usual) {
    const bool tiny = modifiers.scale() == Scale::tiny;
    c = scaled(c, finish.is_exact ? (tiny ? 0x1p-20 : 0x1p20) : (tiny ? 1e-6 : 1e6));
  }
  if (modifiers[ModifierKind::unit]) c = not_quite_unit(draw, c);
  if (modifiers[ModifierKind::distance]) c = translated(c, 1e6 * draw.direction());
  return c;
}

}  // namespace touchstone
