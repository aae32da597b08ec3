#include "properties/motions/motion.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <vector>

#include "properties/draw.hpp"
#include "properties/identity.hpp"
#include "properties/moves.hpp"
#include "properties/named.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

constexpr std::array<double, 17> powers = {1,     1e-1,  1e-2,  1e-3,  1e-4,  1e-5,
                                           1e-6,  1e-7,  1e-8,  1e-9,  1e-10, 1e-11,
                                           1e-12, 1e-13, 1e-14, 1e-15, 1e-16};

/// Separates these draws from those of identities.
constexpr std::uint64_t stream = 0x706572747572622eU;

}  // namespace

Decade Decade::parse(const char* field, std::string_view text) {
  for (int exponent = max; exponent >= min; --exponent) {
    if (text == Decade(exponent).name()) return Decade(exponent);
  }
  throw InvalidInput(field, in_quotes(text), "must be one of 1e-1, 1e-2, … 1e-16");
}

double Decade::value() const { return powers[static_cast<std::size_t>(-exponent_)]; }

std::string to_string(const Perturbation& p) {
  return p.amplitude.name() + "/" + std::to_string(p.seed) + "/" + std::to_string(p.number);
}

Perturbation parse_perturbation(std::string_view text) {
  const std::size_t first = text.find('/');
  const std::size_t second = first == text.npos ? first : text.find('/', first + 1);
  if (second == text.npos) {
    throw InvalidInput("perturbation", in_quotes(text),
                       "must read amplitude/seed/number, as in 1e-8/1/4");
  }
  return {Decade::parse("perturbation.amplitude", text.substr(0, first)),
          parse_number("perturbation.seed", text.substr(first + 1, second - first - 1)),
          parse_number("perturbation.number", text.substr(second + 1))};
}

Configuration moved(const Configuration& c, const Vec3& turn, const Vec3& by) {
  const Vec3& p = c.pose_a.position();
  const Eigen::Quaterniond small(1, turn.x() / 2, turn.y() / 2, turn.z() / 2);
  const bool turns = turn.x() != 0 || turn.y() != 0 || turn.z() != 0;
  const Eigen::Quaterniond& q = c.pose_a.orientation();
  return {c.a,
          Pose(Vec3(p.x() + by.x(), p.y() + by.y(), p.z() + by.z()), turns ? product(small, q) : q),
          c.b, c.pose_b};
}

Configuration perturbed(const Configuration& c, const Perturbation& p) {
  // One stream for each amplitude, so that every amplitude has its own direction.
  const auto exponent = static_cast<std::uint64_t>(-p.amplitude.exponent());
  Draw draw(rc::Random(rc::Random::Key{p.seed, p.number, stream, exponent}));
  const Vec3 direction = draw.direction(), axis = draw.direction();
  const double angle = p.number % 3 == 0 ? 0 : p.amplitude.value();
  const double length = p.number % 3 == 1 ? 0 : p.amplitude.value() * smaller_size(c);
  return moved(c, Vec3(angle * axis.x(), angle * axis.y(), angle * axis.z()),
               Vec3(length * direction.x(), length * direction.y(), length * direction.z()));
}

double largest_displacement(const Configuration& from, const Configuration& to) {
  const Eigen::Quaterniond &p = from.pose_a.orientation(), &q = to.pose_a.orientation();
  // The vector part of q p* is that of (q - p) p*, whose difference loses no digits.
  const Eigen::Quaterniond difference(q.w() - p.w(), q.x() - p.x(), q.y() - p.y(), q.z() - p.z());
  const double half_sine = product(difference, p.conjugate()).vec().norm() / (p.norm() * q.norm());
  const double circumradius = std::hypot(from.a.radius(), from.a.half_length());
  return (to.pose_a.position() - from.pose_a.position()).norm() + 2 * half_sine * circumradius;
}

namespace {

using Quaternion = Eigen::Quaterniond;

// All alignments are exact: integer quaternions, and sizes and depth are powers of two.
constexpr double radius = 0.25, half_length = 0.5;
constexpr double depth = 1.0 / 256;

const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), none(0, 0, 0);

Cylinder can() { return Cylinder(radius, half_length); }
Pose at(double px, double py, double pz, const Quaternion& q) { return Pose({px, py, pz}, q); }
Plane ground() { return Plane(z, 0); }

CriticalPose::Change tilt(const char* what, const Vec3& about) { return {what, about, none}; }
CriticalPose::Change offset(const char* what, const Vec3& along) { return {what, none, along}; }

std::vector<CriticalPose> make_critical_poses() {
  // Of a triangle 3-4-5: cos = 0.6, sin = 0.8.
  const Quaternion leaning(2, 0, 1, 0), leaning_back(2, 0, -1, 0);
  const Vec3 outward(0.6, 0, 0.8), along_edge_up(0.8, 0, -0.6);
  const double reach = radius - depth;
  return {
      {"lying",
       "A cylinder lies on a plane: a line of contact.",
       {can(), at(0, 0, radius - depth, along_x), ground(), Pose()},
       tilt("tilt of the axis out of the plane", y),
       tilt("turn on the plane", z)},
      {"standing",
       "A cylinder stands on a plane: a disc of contact.",
       {can(), at(0, 0, half_length - depth, upright), ground(), Pose()},
       tilt("tilt about x", x),
       tilt("tilt about y", y)},
      {"parallel-sides",
       "Two cylinders lie side by side, the axes parallel: a line of contact.",
       {can(), at(0.125, 0, 2 * radius - depth, along_x), can(), at(0, 0, 0, along_x)},
       tilt("tilt in the plane of the axes", y),
       tilt("turn across it", z)},
      {"cap-on-cap",
       "Equal cylinders on top of each other, the axes in line: a full disc of contact.",
       {can(), at(0, 0, 2 * half_length - depth, upright), can(), Pose()},
       tilt("tilt about x", x),
       offset("offset along x", x)},
      {"t",
       "A cylinder's cap stands across another one's side at a right angle: a line of contact.",
       {can(), at(0, 0, half_length + radius - depth, upright), can(), at(0, 0, 0, along_x)},
       tilt("tilt about y, along the other's axis", y),
       tilt("tilt about x, around the other's side", x)},
      {"x",
       "The sides of two cylinders cross at a right angle: a point of contact.",
       {can(), at(0, 0, 2 * radius - depth, along_y), can(), at(0, 0, 0, along_x)},
       tilt("turn away from the right angle", z),
       tilt("tilt about x", x)},
      {"rim-on-rim",
       "Two leaning cylinders meet at their rims, whose tangents there are parallel; two normals "
       "tie.",
       {can(), at(0, 0, 1 - depth, leaning), can(), at(0, 0, 0, leaning_back)},
       offset("offset along x, across the rims", x),
       tilt("turn of the tangents about z", z)},
      {"edge-on-side",
       "A box's edge lies along a cylinder's side, parallel to its axis: a line of contact.",
       {can(), at(0.5 + reach * outward.x(), 0.125, 0.5 + reach * outward.z(), along_y),
        Box({0.5, 0.5, 0.5}), Pose()},
       tilt("tilt out of the tangent plane", along_edge_up),
       tilt("turn in the tangent plane", outward)},
      {"cap-on-box-corner",
       "A cylinder stands on a box's corner, its axis through it: a quarter disc of contact.",
       {can(), at(0.5, 0.5, 0.5 + half_length - depth, upright), Box({0.5, 0.5, 0.5}), Pose()},
       tilt("tilt about x", x),
       tilt("tilt about y", y)},
  };
}

}  // namespace

const std::vector<CriticalPose>& critical_poses() {
  static const std::vector<CriticalPose> poses = make_critical_poses();
  return poses;
}

const CriticalPose& find_critical_pose(std::string_view name) {
  return named(critical_poses(), name, "map.pose");
}

Configuration map_pixel(const CriticalPose& pose, Decade zoom, int column, int row) {
  const double u = zoom.value() * (static_cast<double>(column) / map_reach);
  const double v = zoom.value() * (static_cast<double>(row) / map_reach);
  const double size = smaller_size(pose.configuration);
  const auto sum = [](double s, const Vec3& a, double t, const Vec3& b) {
    return Vec3(s * a.x() + t * b.x(), s * a.y() + t * b.y(), s * a.z() + t * b.z());
  };
  return moved(pose.configuration, sum(u, pose.across.turn, v, pose.up.turn),
               sum(size * u, pose.across.move, size * v, pose.up.move));
}

namespace {

Box table() { return Box({2, 2, 0.5}); }
Box block() { return Box({0.5, 1, 0.5}); }
Pose below() { return Pose({0, 0, -0.5}, upright); }  // the pose of a table with its top at z = 0

/// The angle 2 arctan(t).
struct HalfTangent {
  double t;
  double cosine() const { return (1 - t * t) / (1 + t * t); }
  double sine() const { return 2 * t / (1 + t * t); }
  Quaternion about_x() const { return Quaternion(1, t, 0, 0); }
  Quaternion about_y() const { return Quaternion(1, 0, t, 0); }
  Quaternion about_z() const { return Quaternion(1, 0, 0, t); }
};

/// Standing at time -0.8, lying at 0.8, on its rim in between, always at the same depth.
Pose tilting(double time) {
  const HalfTangent angle{(time + 0.8) / 1.6};
  const double height = half_length * std::abs(angle.cosine()) + radius * std::abs(angle.sine());
  return Pose({0, 0, height - depth}, angle.about_y());
}

/// Lying along x, turned by `turn` in the world.
Pose lying(const Quaternion& turn) { return Pose({0, 0, radius - depth}, product(turn, along_x)); }

/// Rolls along the top of a block to its edge at time 0, then around the edge by 90°.
Pose rolling_over_edge(double time) {
  const double reach = radius - depth;
  if (time <= 0) return Pose({0.5 + 0.5 * time, 0.125, 0.5 + reach}, along_y);
  const HalfTangent angle{time};
  return Pose({0.5 + reach * angle.sine(), 0.125, 0.5 + reach * angle.cosine()}, along_y);
}

/// A cylinder along x above B, which lies along x, with the sides in contact.
Configuration crossing(const Shape& b, const Quaternion& turn) {
  return {can(), Pose({0.125, 0, 2 * radius - depth}, product(turn, along_x)), b,
          Pose({0, 0, 0}, along_x)};
}

/// A sphere of the can's radius moves from the middle of the cap over the rim, at time 0, and down
/// the side. The moving body is A, the can.
Configuration round_rim(double time) {
  const double reach = radius - depth;
  double px = radius, pz = half_length;
  if (time < -0.25) {
    px = radius * (1 + (time + 0.25) / 0.75);
    pz += reach;
  } else if (time > 0.25) {
    px += reach;
    pz = half_length * (1 - (time - 0.25) / 0.75);
  } else {
    const HalfTangent angle{(time + 0.25) / 0.5};
    px += reach * angle.sine();
    pz += reach * angle.cosine();
  }
  return {can(), Pose({-px, 0, -pz}, upright), Sphere(radius), Pose()};
}

std::vector<Motion> make_motions() {
  return {
      {"tilt-on-plane", "Standing on a plane, over its rim, to lying on it.",
       [](double t) -> Configuration {
         return {can(), tilting(t), ground(), Pose()};
       }},
      {"tilt-on-box", "The same on the face of a box.",
       [](double t) -> Configuration {
         return {can(), tilting(t), table(), below()};
       }},
      {"roll-on-plane", "Lying on a plane, turned about its own axis: nothing changes.",
       [](double t) -> Configuration {
         return {can(), lying(HalfTangent{t}.about_x()), ground(), Pose()};
       }},
      {"roll-on-box", "The same on the face of a box.",
       [](double t) -> Configuration {
         return {can(), lying(HalfTangent{t}.about_x()), table(), below()};
       }},
      {"yaw-on-box", "Lying on a box, turned about the vertical.",
       [](double t) -> Configuration {
         return {can(), lying(HalfTangent{t}.about_z()), table(), below()};
       }},
      {"spin-on-box", "Standing on a box, turned about its own axis: nothing changes.",
       [](double t) -> Configuration {
         return {can(), Pose({0, 0, half_length - depth}, HalfTangent{t}.about_z()), table(),
                 below()};
       }},
      {"roll-over-edge", "Lying on a box parallel to its edge, over the edge and around it.",
       [](double t) -> Configuration {
         return {can(), rolling_over_edge(t), block(), Pose()};
       }},
      {"slide-off-box", "Standing on a box, off its edge, until nothing is left.",
       [](double t) -> Configuration {
         return {can(), Pose({0.5 + radius * t, 0, 0.5 + half_length - depth}, upright), block(),
                 Pose()};
       }},
      {"slide-over-cap",
       "A cap slides over another cap of the same size, through the axes in line.",
       [](double t) -> Configuration {
         return {can(), Pose({2 * radius * t, 0, 2 * half_length - depth}, upright), can(), Pose()};
       }},
      {"turn-through-parallel", "Side on side, turned through parallel axes.",
       [](double t) { return crossing(can(), HalfTangent{0.125 * t}.about_z()); }},
      {"tilt-through-parallel", "Side on side, tilted through parallel axes.",
       [](double t) { return crossing(can(), HalfTangent{0.03125 * t}.about_y()); }},
      {"turn-on-capsule", "Side on a capsule's side, turned through parallel axes.",
       [](double t) {
         return crossing(Capsule(radius, half_length), HalfTangent{0.125 * t}.about_z());
       }},
      {"sphere-round-rim", "A sphere rolls from the cap over the rim to the side.", round_rim},
  };
}

}  // namespace

const std::vector<Motion>& motions() {
  static const std::vector<Motion> all = make_motions();
  return all;
}

const Motion& find_motion(std::string_view name) {
  return named(motions(), name, "sequence.motion");
}

Configuration pose_at(const Motion& motion, int step, int steps) {
  return motion.at(static_cast<double>(2 * step - steps) / steps);
}

namespace {

constexpr int max_steps = 1 << 20;

int number(const char* field, std::string_view text, int min, int max) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < min || value > max) {
    throw InvalidInput(field, fmt::format("\"{}\"", text),
                       fmt::format("must be a whole number from {} to {}", min, max));
  }
  return value;
}

void require_count(const char* field, const std::string& text,
                   const std::vector<std::string_view>& parts, std::size_t count,
                   const char* remedy) {
  if (parts.size() != count) throw InvalidInput(field, '"' + text + '"', remedy);
}

}  // namespace

std::string perturbed_name(const std::string& base, const Perturbation& perturbation) {
  return base + "@" + to_string(perturbation);
}

std::optional<Subject> named_configuration(const std::string& text) {
  const auto parts = split(text, '/');
  if (parts[0] == "map") {
    require_count("map", text, parts, 5,
                  "must read map/pose/zoom/column/row, as in map/standing/1e-12/-3/16");
    const CriticalPose& pose = find_critical_pose(parts[1]);
    return Subject{text, pose.description,
                   map_pixel(pose, Decade::parse("map.zoom", parts[2]),
                             number("map.column", parts[3], -map_reach, map_reach),
                             number("map.row", parts[4], -map_reach, map_reach))};
  }
  if (parts[0] == "sequence") {
    require_count("sequence", text, parts, 4,
                  "must read sequence/motion/step/steps, as in sequence/roll-over-edge/113/200");
    const Motion& motion = find_motion(parts[1]);
    const int steps = number("sequence.steps", parts[3], 1, max_steps);
    const int step = number("sequence.step", parts[2], 0, steps);
    return Subject{text, motion.description, pose_at(motion, step, steps)};
  }
  return std::nullopt;
}

}  // namespace touchstone
