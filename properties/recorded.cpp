#include "properties/recorded.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "properties/numbers.hpp"
#include "properties/pose_class.hpp"
#include "reference/contact_of.hpp"

namespace touchstone {
namespace {

struct Row {
  Pair pair;
  const char* scene;
  std::uint64_t weight;
  double numbers[20];  ///< in the order of every_number; a plane has the largest number of them
};

/// Frozen, as known failures are: identities draw from them by weight.
const Row rows[] = {
#include "recorded_rows.inc"
};

std::vector<Recorded> recorded_of(Pair pair) {
  std::vector<Recorded> result;
  for (const Row& row : rows) {
    if (row.pair != pair) continue;
    Numbers numbers;
    numbers.pair = pair;
    numbers.sizes.resize(size_count(pair));
    const double* number = row.numbers;
    for (double* each : every_number(numbers)) *each = *number++;
    result.push_back({row.scene, row.weight, configuration_of(numbers)});
  }
  return result;
}

std::uint64_t total_weight(const std::vector<Recorded>& all) {
  return std::accumulate(all.begin(), all.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const Recorded& r) { return sum + r.weight; });
}

struct FailedRow {
  Pair pair;
  std::vector<double> numbers;  ///< in the order of every_number
};

/// Failures of our own routines, then those of engines in known_failures.jsonl. Frozen: the hostile
/// class chooses from them by number.
const FailedRow failed_rows[] = {
    // A zero normal at a tilt of 1e-14.
    {Pair::capsule,
     {0x1p-2, 5, 0x1.1745d1745d174p-2, -0x1.ac37dac37dac4p-2, 0x1.bed61bed61bfp-6,
      0x1.041c6a547a96ep+1, -0x1.78c73ac4b8bf4p+1, -0x1.1fa452869f12cp-7, -0x1.847b2902f586dp+1,
      0x1p-2, 5, 0, 0, 0, 2, -3, 0, -3}},
    // A missed contact of the rims of perpendicular cylinders.
    {Pair::cylinder,
     {1, 2, -0x1.eb851eb851eb8p-2, -0x1.b0a3d70a3d70ap+1, 0x1.547ae147ae148p+1, 1,
      0x1.0000005e7d418p+0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0}},
    // Contact points none of which has the depth.
    {Pair::box,
     {0x1.97c35abda3eebp-1, 0x1.93973dd550fddp-1, -0x1.81d3ed9e3d37ap-3, 0x1.da6972f3aa68cp-1,
      -0x1.68700f31523a4p-1, 1, 0x1.11baa155417aap-47, -0x1.0bb9b6876a42ap-48,
      0x1.b171ba7780121p-19, 0x1.2867f0a3b4efbp-2, 0x1.2867f0a3b4efbp-2, 0x1.5939751ff6014p-4,
      0x0.0000000000001p-1022, 0, 0, 1, 0, 0, 0}},
#include "known_failures_rows.inc"
};

Numbers numbers_of_row(const FailedRow& row) {
  Numbers result;
  result.pair = row.pair;
  result.sizes.resize(size_count(row.pair));
  std::size_t i = 0;
  for (double* number : every_number(result)) *number = row.numbers[i++];
  return result;
}

/// Without the configurations that an earlier row of the pair has: several laws may fail at one.
std::vector<Numbers> distinct_rows(Pair pair) {
  std::vector<const FailedRow*> distinct;
  for (const FailedRow& row : failed_rows) {
    const bool repeated = std::any_of(distinct.begin(), distinct.end(), [&](const FailedRow* r) {
      return r->numbers == row.numbers;
    });
    if (row.pair == pair && !repeated) distinct.push_back(&row);
  }
  std::vector<Numbers> result;
  for (const FailedRow* row : distinct) result.push_back(numbers_of_row(*row));
  return result;
}

}  // namespace

const std::vector<Recorded>& recorded(Pair pair) {
  static const auto all = [] {
    std::array<std::vector<Recorded>, std::size(all_pairs)> result;
    for (const Pair p : all_pairs) result[static_cast<std::size_t>(p)] = recorded_of(p);
    return result;
  }();
  return all[static_cast<std::size_t>(pair)];
}

std::vector<RecordedShare> recorded_shares() {
  std::vector<RecordedShare> result;
  for (const Pair pair : all_pairs) {
    std::map<std::pair<std::string_view, std::optional<int>>, std::uint64_t> weights;
    for (const Recorded& r : recorded(pair)) {
      const NearestArrangement nearest = nearest_arrangement(r.configuration);
      weights[{nearest.name, nearest.tilt}] += r.weight;
    }
    const double total = static_cast<double>(total_weight(recorded(pair)));
    const auto first = static_cast<std::ptrdiff_t>(result.size());
    for (const auto& [key, weight] : weights) {
      result.push_back({pair, {key.first, key.second}, static_cast<double>(weight) / total});
    }
    std::stable_sort(
        result.begin() + first, result.end(),
        [](const RecordedShare& x, const RecordedShare& y) { return x.share > y.share; });
  }
  return result;
}

std::optional<Arrangement> recorded_arrangement(Pair pair) {
  if (recorded(pair).empty()) return std::nullopt;
  const auto generate = [&all = recorded(pair), total = total_weight(recorded(pair))](
                            Draw& draw, const Modifiers&) {
    auto left = static_cast<std::uint64_t>(draw.integer(0, static_cast<std::int64_t>(total) - 1));
    for (const Recorded& r : all) {
      if (left < r.weight) return r.configuration;
      left -= r.weight;
    }
    return all.back().configuration;  // not reached: the weights add up to the total
  };
  return Arrangement{
      "recorded",
      "As it occurred near contact in the scenes that come with Touchstone, as often "
      "as it occurred.",
      Arrangement::Orientations::recorded,
      {},
      generate};
}

const std::vector<Numbers>& known_failures(Pair pair) {
  static const auto all = [] {
    std::array<std::vector<Numbers>, std::size(all_pairs)> result;
    for (const Pair p : all_pairs) result[static_cast<std::size_t>(p)] = distinct_rows(p);
    return result;
  }();
  return all[static_cast<std::size_t>(pair)];
}

namespace {

/// Largest tilt, rad, with which bodies still count as lying in an aligned arrangement.
constexpr double max_tilt = 0.1;
/// Likewise where no cap, side or face says that they are meant to be aligned: at random, axes are
/// perpendicular within this angle in 1% of all cases.
constexpr double max_chance = 0.01;
/// Largest angle, rad, that is rounding: the normal of a contact inside a cap is the cap's own.
constexpr double rounding = 1e-6;
/// Largest offset of centres, as a share of the smaller size, that counts as centred.
constexpr double centred = 0.01;

// Angles of unit vectors, accurate where they are small.

/// Between the lines along both.
double from_parallel(const Vec3& u, const Vec3& v) {
  return std::atan2(u.cross(v).norm(), std::abs(u.dot(v)));
}
double from_perpendicular(const Vec3& u, const Vec3& v) {
  return std::atan2(std::abs(u.dot(v)), u.cross(v).norm());
}

NearestArrangement tilted(std::string_view name, double tilt) {
  const double decade = tilt > 0 ? std::round(-std::log10(tilt)) : NearestArrangement::exact;
  return {name, std::min(static_cast<int>(decade), NearestArrangement::exact)};
}

NearestArrangement of_features(std::string_view name) { return {name, std::nullopt}; }

/// How a body's axis lies to the normal, and so which of its features faces the other body: a cap
/// or round end, the side, or a rim.
enum class Facing { cap, side, rim };

Facing facing(const Vec3& axis, const Vec3& normal, double max_angle) {
  if (from_parallel(axis, normal) <= max_angle) return Facing::cap;
  return from_perpendicular(axis, normal) <= max_angle ? Facing::side : Facing::rim;
}

/// A configuration as this file sees it.
struct View {
  Vec3 axis_A, normal, offset;  ///< offset of A's centre from B's
  double size;                  ///< the smaller one
  Facing near_A, exact_A;       ///< within `max_tilt`, and but for rounding

  bool is_centred(const Vec3& axis) const { return offset.cross(axis).norm() <= centred * size; }
};

NearestArrangement on_plane(const View& v) {
  if (v.near_A == Facing::cap) return tilted("standing", from_parallel(v.axis_A, v.normal));
  if (v.near_A == Facing::side) return tilted("lying", from_perpendicular(v.axis_A, v.normal));
  return of_features("general");
}

NearestArrangement on_sphere(const View& v) {
  if (v.exact_A == Facing::side) return of_features("side");
  if (v.exact_A == Facing::rim) return of_features("rim");
  return of_features(v.is_centred(v.axis_A) ? "cap-on-axis" : "cap");
}

/// "parallel" or "perpendicular" if the axes nearly are; otherwise the features.
NearestArrangement nearest_askew(double parallel, double perpendicular, std::string_view features) {
  if (parallel <= max_chance) return tilted("parallel", parallel);
  if (perpendicular <= max_chance) return tilted("perpendicular", perpendicular);
  return of_features(features);
}

std::string_view capsule_features(Facing a, bool side_B) {
  switch (a) {
    case Facing::cap:
      return "cap-end";
    case Facing::side:
      return side_B ? "side-side" : "side-end";
    case Facing::rim:
      break;
  }
  return side_B ? "rim-side" : "rim-end";
}

std::string_view cylinder_features(Facing a, Facing b) {
  if (a == Facing::cap || b == Facing::cap) return "rim-face";
  if (a == Facing::side && b == Facing::side) return "side-side";
  return a == Facing::side || b == Facing::side ? "rim-side" : "rim-rim";
}

NearestArrangement on_axis(const View& v, const Vec3& axis_B, bool is_capsule) {
  const double parallel = from_parallel(v.axis_A, axis_B);
  const double perpendicular = from_perpendicular(v.axis_A, axis_B);
  const Facing a = v.near_A, b = facing(axis_B, v.normal, max_tilt);
  if (a == Facing::cap && b == Facing::cap) {
    if (v.is_centred(v.axis_A)) {
      return tilted(is_capsule ? "cap-on-end-centred" : "cap-on-cap-centred", parallel);
    }
    return tilted(is_capsule ? "cap-on-end-offset" : "cap-on-cap-offset", parallel);
  }
  if (a == Facing::cap && b == Facing::side) return tilted("cap-on-side", perpendicular);
  if (a == Facing::side && b == Facing::cap) return tilted("perpendicular-t", perpendicular);
  if (a == Facing::side && b == Facing::side) {
    if (parallel <= max_tilt) return tilted("parallel-side", parallel);
    if (perpendicular <= max_tilt) return tilted("perpendicular-x", perpendicular);
  }
  const Facing exact_B = facing(axis_B, v.normal, rounding);
  return nearest_askew(parallel, perpendicular,
                       is_capsule ? capsule_features(v.exact_A, exact_B == Facing::side)
                                  : cylinder_features(v.exact_A, exact_B));
}

/// `components`: how many of the normal's in the box's frame are not zero: one on a face, two on an
/// edge, three on a vertex.
std::string_view box_features(Facing a, Eigen::Index components) {
  constexpr std::array<std::array<const char*, 3>, 3> names = {
      {{"cap-on-face-offset", "side-on-face", "rim-face"},
       {"edge-cap", "edge-side", "edge-rim"},
       {"vertex-cap", "vertex-side", "vertex-rim"}}};
  return names[static_cast<std::size_t>(components - 1)][static_cast<std::size_t>(a)];
}

NearestArrangement on_box(const View& v, const Eigen::Matrix3d& axes_B) {
  const Vec3 local = (axes_B.transpose() * v.normal).cwiseAbs();
  Eigen::Index along, across;
  local.maxCoeff(&along);
  local.minCoeff(&across);
  const Vec3 face = axes_B.col(along), edge = axes_B.col(across);
  if (from_parallel(face, v.normal) <= max_tilt) {
    if (v.near_A == Facing::cap) {
      return tilted(v.is_centred(face) ? "cap-on-face-centred" : "cap-on-face-offset",
                    from_parallel(v.axis_A, face));
    }
    if (v.near_A == Facing::side) {
      return tilted("side-on-face", from_perpendicular(v.axis_A, face));
    }
  } else if (from_perpendicular(edge, v.normal) <= max_tilt) {
    const double parallel = from_parallel(v.axis_A, edge);
    const double perpendicular = from_perpendicular(v.axis_A, edge);
    if (v.near_A == Facing::cap) return tilted("edge-cap", perpendicular);
    if (v.near_A == Facing::side && parallel <= max_tilt) return tilted("parallel", parallel);
    if (v.near_A == Facing::side && perpendicular <= max_tilt) {
      return tilted("perpendicular-x", perpendicular);
    }
  }
  const Eigen::Index components = (local.array() > rounding).count();
  const std::string_view features = box_features(v.exact_A, components);
  if (components != 2) return of_features(features);
  return nearest_askew(from_parallel(v.axis_A, edge), from_perpendicular(v.axis_A, edge), features);
}

}  // namespace

NearestArrangement nearest_arrangement(const Configuration& c) {
  const Vec3 axis_A = c.pose_a.axis(), normal = signed_distance(c).normal;
  const View view{axis_A,
                  normal,
                  c.pose_a.position() - c.pose_b.position(),
                  smaller_size(c),
                  facing(axis_A, normal, max_tilt),
                  facing(axis_A, normal, rounding)};
  switch (pair_of(c)) {
    case Pair::plane:
      return on_plane(view);
    case Pair::sphere:
      return on_sphere(view);
    case Pair::capsule:
      return on_axis(view, c.pose_b.axis(), true);
    case Pair::cylinder:
      return on_axis(view, c.pose_b.axis(), false);
    case Pair::convex:
      return of_features("general");
    case Pair::box:
      break;
  }
  return on_box(view, c.pose_b.rotation());
}

}  // namespace touchstone
