#include "properties/casts.hpp"

#include <algorithm>
#include <iterator>

#include "oracle/truth.hpp"
#include "properties/draw.hpp"
#include "properties/moves.hpp"
#include "properties/named.hpp"
#include "properties/stable_hash.hpp"

namespace touchstone {
namespace {

/// A starts the part `gone` of the sweep before the pose.
CastQuestion through(const Configuration& pose, double gone, const Vec3& sweep) {
  return {with_a_moved(pose, -gone * sweep), sweep};
}
/// One that does not lead away along the normal.
Vec3 direction_against(Draw& draw, const Vec3& normal) {
  const Vec3 way = draw.direction();
  return dot(way, normal) > 0 ? Vec3(-way) : way;
}

/// Gaps before A moves, lengths of sweeps, and offsets from a touch, all in larger sizes.
constexpr double min_gap = 1e-2, max_gap = 10;
constexpr double min_near = 1e-12, max_near = 1e-3, min_far = 1e2, max_far = 1e6;
constexpr double min_length = 1e-6, max_length = 1e6;
constexpr double min_offset = 1e-17, max_offset = 1e-3;

CastQuestion move_head_on(Draw& draw, const Configuration& pose, const Vec3& n, double distance) {
  const double gap = larger_size(pose) * draw.log_uniform(min_gap, max_gap);
  const Vec3 sweep = -gap * draw.uniform(0.5, 2) * n;
  return {with_a_moved(pose, (gap - distance) * n), sweep};
}
CastQuestion move_near(Draw& draw, const Configuration& pose, const Vec3& n, double distance) {
  const double size = larger_size(pose), gap = size * draw.log_uniform(min_near, max_near);
  const double length = size * draw.log_uniform(min_length, max_length);
  return {with_a_moved(pose, (gap - distance) * n), length * direction_against(draw, n)};
}
CastQuestion move_far(Draw& draw, const Configuration& pose, const Vec3& n, double) {
  const double length = larger_size(pose) * draw.log_uniform(min_far, max_far);
  const double gone = draw.uniform(0.5, 1.2);
  return through(pose, gone, length * direction_against(draw, n));
}
CastQuestion move_askew(Draw& draw, const Configuration& pose, const Vec3&, double) {
  const double length = larger_size(pose) * draw.log_uniform(min_gap, max_gap);
  const double gone = draw.uniform(0, 1.2);
  return through(pose, gone, length * draw.direction());
}
CastQuestion move_grazing(Draw& draw, const Configuration& pose, const Vec3& n, double distance) {
  const double size = larger_size(pose);
  const double offset = size * draw.sign() * draw.log_uniform(min_offset, max_offset);
  const double length = size * draw.log_uniform(min_gap, max_gap), gone = draw.uniform(0, 1.2);
  return through(with_a_moved(pose, (offset - distance) * n), gone,
                 length * draw.direction_across(n));
}
CastQuestion move_sliding(Draw& draw, const Configuration& pose, const Vec3&, double) {
  const double length = larger_size(pose) * draw.log_uniform(min_gap, max_gap);
  const double gone = draw.uniform(0, 1.2);
  const Vec3 axis = normalized(axes(normalized(pose.pose_a.orientation())).z);
  return through(pose, gone, draw.sign() * length * axis);
}
CastQuestion move_passing(Draw& draw, const Configuration& pose, const Vec3& n, double distance) {
  const double size = larger_size(pose);
  const double offset = size * draw.log_uniform(max_offset, 1);
  const double length = size * draw.log_uniform(min_gap, max_gap), gone = draw.uniform(0, 1.2);
  return through(with_a_moved(pose, (offset - distance) * n), gone,
                 length * draw.direction_across(n));
}
CastQuestion move_placed(Draw& draw, const Configuration& pose, const Vec3&, double) {
  const double length = larger_size(pose) * draw.log_uniform(min_length, max_length);
  return {pose, length * draw.direction()};
}

constexpr CastMotion motions_of_casts[] = {
    {"head-on", "A comes against the pose's normal from 0.01 to 10 sizes away, and may stop short.",
     move_head_on},
    {"near", "A starts 1e-12 to 1e-3 of the size away and moves by 1e-6 to 1e6 sizes towards B.",
     move_near},
    {"far", "A comes from 50 to 1e6 sizes away, in any direction, and meets the pose on its way.",
     move_far},
    {"askew", "A moves by 0.01 to 10 sizes in any direction, and meets the pose on its way.",
     move_askew},
    {"grazing",
     "A moves across the pose's normal, within 1e-17 to 1e-3 of the size of a touch on either "
     "side.",
     move_grazing},
    {"sliding", "A moves along its own axis, and meets the pose on its way: an end, or a side.",
     move_sliding},
    {"passing", "A moves across the pose's normal, 0.001 to 1 of the size beyond it: a miss.",
     move_passing},
    {"placed",
     "A starts in the pose itself, be it apart, touching or inside, and moves by 1e-6 to 1e6 sizes "
     "in any direction.",
     move_placed}};

std::string_view pair_part(std::string_view text) { return text.substr(0, text.find('/')); }

}  // namespace

std::span<const CastMotion> cast_motions() { return motions_of_casts; }

const CastMotion& find_cast_motion(std::string_view name) {
  return named(cast_motions(), name, "identity.motion");
}

std::string to_string(const CastIdentity& identity) {
  return to_string(identity.pose) + "/" + identity.motion->name;
}

bool is_cast_identity(std::string_view text) {
  const auto is_first = [&](Pair pair) { return pair_part(text) == pair_name(pair); };
  return std::ranges::count(text, '/') == 4 && std::ranges::any_of(all_pairs, is_first);
}

CastIdentity parse_cast_identity(std::string_view text) {
  const std::size_t last = text.rfind('/');
  return {parse_identity(text.substr(0, last)), &find_cast_motion(text.substr(last + 1))};
}

CastQuestion make_cast(const CastIdentity& identity) {
  const Identity& pose = identity.pose;
  const Configuration c = make_configuration(pose);
  const oracle::Truth truth = oracle::truth(c);
  const std::string stream = std::string(pair_name(pose.pose_class.pair)) + "/" +
                             pose.pose_class.name() + "/" + identity.motion->name;
  Draw draw(rc::Random(rc::Random::Key{pose.seed, pose.index, stable_hash(stream), 0}));
  return identity.motion->put_upon(draw, c, truth.normals.front().n,
                                   truth.signed_distance.midpoint());
}

Subject subject(const CastIdentity& identity) {
  const CastQuestion cast = make_cast(identity);
  return {to_string(identity),
          identity.pose.pose_class.description() + " Moving: " + identity.motion->description,
          cast.configuration,
          {},
          Sweep(cast.sweep)};
}

}  // namespace touchstone
