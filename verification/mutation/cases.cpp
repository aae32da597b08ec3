#include "verification/mutation/cases.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "oracle/patch/contact_patch.hpp"
#include "oracle/truth.hpp"
#include "properties/files/bytes.hpp"
#include "properties/identity.hpp"
#include "properties/numbers.hpp"
#include "reference/random_hulls_test.hpp"
#include "reference/support.hpp"

namespace touchstone::mutation {
namespace {

Numbers3 numbers(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

RawConfiguration raw(const Configuration& configuration) {
  const touchstone::Numbers n = numbers_of(configuration);
  RawConfiguration r;
  r.pair = static_cast<double>(n.pair);
  std::copy(n.sizes.begin(), n.sizes.end(), r.sizes.begin());
  r.position_a = numbers(n.position_a), r.position_b = numbers(n.position_b);
  const auto wxyz = [](const Eigen::Quaterniond& q) {
    return Numbers4{q.w(), q.x(), q.y(), q.z()};
  };
  r.orientation_a = wxyz(n.orientation_a), r.orientation_b = wxyz(n.orientation_b);
  r.normal = numbers(n.normal);
  r.displacement = n.displacement;
  if (const auto* hull = std::get_if<Convex>(&configuration.b)) {
    for (const Vec3& v : hull->vertices()) r.vertices.push_back(numbers(v));
    for (const Convex::Face& face : hull->faces()) r.faces.push_back(face.vertices);
  }
  return r;
}

namespace {

void add_patch(Case& result, const oracle::ContactPatch& patch, const Vec3& n, double leans) {
  KnownPatch known{numbers(n), leans, {}};
  const std::vector<Vec3> outline = patch.outline();
  constexpr std::size_t enough = 32;
  const std::size_t step = leans != 0 ? 1 + outline.size() / enough : 1;
  for (std::size_t i = 0; i < outline.size(); i += step) {
    known.outline.push_back(numbers(outline[i]));
  }
  result.patches.push_back(std::move(known));
}

/// What the manifold's points are to hold of bodies that lean: what lies well within its slack
/// (reference/manifold.hpp).
void add_leaning_patch(Case& result, const Configuration& c, const Vec3& n) {
  const double size_a = largest_half_extent(c.a), size_b = largest_half_extent(c.b);
  const double smaller = size_b > 0 ? std::min(size_a, size_b) : size_a;  // a plane has no size
  const double room =
      leaning_threshold * smaller_size(c) - static_cast<double>(result.signed_distance);
  const double slack = std::min(1e-3 * smaller, room);
  if (!(slack > 1e-6 * smaller)) return;
  const oracle::ContactPatch patch = oracle::contact_patch(c, n, slack / 8);
  if (patch.perimeter() < 0.1 * smaller_size(c)) return;
  add_patch(result, patch, n, 1);
}

Case make_case(const std::string& identity, const Configuration& c) {
  using oracle::ContactPatch;
  Case result{identity, raw(c), 0, {}, {}};
  const oracle::Truth truth = oracle::truth(c);
  const mpq_class middle = (truth.signed_distance.lo + truth.signed_distance.hi) / 2;
  const double high = middle.get_d();
  const mpq_class rest = middle - high;
  result.signed_distance = static_cast<long double>(high) + rest.get_d();
  constexpr std::size_t max_normals = 4;
  for (const oracle::OptimalNormal& normal : truth.normals) {
    if (result.normals.size() == max_normals) break;
    result.normals.push_back(numbers(normal.n));
    const ContactPatch patch = oracle::contact_patch(c, normal);
    if (patch.kind() != ContactPatch::Kind::point) {
      add_patch(result, patch, normal.n, 0);
    } else if (truth.ties == oracle::Ties::unique) {
      add_leaning_patch(result, c, normal.n);
    }
  }
  return result;
}

Case make_case(const Identity& id) { return make_case(to_string(id), make_configuration(id)); }

/// Hulls of all kinds in turn, every second configuration shallow or all but touching.
Configuration with_any_hull(std::uint64_t index) {
  touchstone::Random random(index);
  const Configuration c = with_hull(hull_kinds[index % std::size(hull_kinds)], random);
  if (random.toss()) return c;
  return moved_to_depth(c, random.power_of_ten(-12, -1) * smaller_size(c));
}
std::string name_of_hull(std::uint64_t index) {
  return "hull/" + std::string(hull_kind_names[index % std::size(hull_kinds)]) + '/' +
         std::to_string(index);
}

std::FILE* opened(const std::string& file, const char* mode) {
  std::FILE* f = std::fopen(file.c_str(), mode);
  if (!f) throw std::runtime_error("cannot open " + file);
  return f;
}

void write(std::FILE* file, const Case& c) {
  const std::string bytes = to_bytes(to_bytes(c));  // with their number before them
  std::fwrite(bytes.data(), bytes.size(), 1, file);
}

constexpr std::uint64_t seed = case_seed;

}  // namespace

void write_cases(const std::string& file, const std::string& net, std::uint64_t count) {
  std::FILE* f = opened(file, "wb");
  for (std::uint64_t i = 0; i < count; ++i) {
    for (const Pair pair : all_pairs) {
      if (pair == Pair::convex) continue;  // a raw configuration has sizes, no vertices
      if (net == "hostile") {
        const bool has_search = pair != Pair::plane && pair != Pair::sphere;
        if (has_search || i % 8 == 0) write(f, make_case({pair, "hostile", seed, i}));
        continue;
      }
      for (const std::string& name : pose_classes(pair)) {
        write(f, make_case({pair, name, seed, i}));
      }
    }
  }
  for (std::uint64_t i = 0; net == "hostile" && i < count; ++i) {
    write(f, make_case(name_of_hull(i), with_any_hull(i)));
  }
  if (std::fclose(f) != 0) throw std::runtime_error("cannot write " + file);
}

CaseReader::CaseReader(const std::string& file) : file_(opened(file, "rb")) {}

bool CaseReader::next(Case& c) {
  std::size_t size = 0;
  if (std::fread(&size, sizeof size, 1, file_) != 1) return false;
  std::string bytes(size, '\0');
  if (std::fread(bytes.data(), size, 1, file_) != 1) {
    throw std::runtime_error("the file of truths ends early: make it again");
  }
  c = from_bytes<Case>(bytes);
  return true;
}

// Configurations in which only the agreement of the routines with each other is judged.

namespace {

class Drawn : public Random {
 public:
  using Random::Random;

  bool coin() { return uniform(0, 1) < 0.5; }
  double small_or_none() { return coin() ? 0 : power_of_ten(-16, -1); }
};

/// Two cylinders whose rims meet along a chosen normal at a chosen depth, so that they are mostly
/// deepest there. Angles and ratios are log-uniform, because searches fail where one is small.
class MeetingRims : Drawn {
 public:
  using Drawn::Drawn;

  Configuration make() {
    const double r1 = power_of_ten(-3, 1), r2 = coin() ? r1 : r1 * power_of_ten(0, 2);
    const double h1 = r1 * power_of_ten(-8, 1), h2 = r2 * power_of_ten(-8, 1);
    const double tilt = coin() ? power_of_ten(-9, 0) : std::numbers::pi / 2 - small_or_none();
    const Vec3 u1(1, 0, 0), u2(std::cos(tilt), std::sin(tilt), 0);
    const Vec3 n = normal(tilt);
    const Vec3 across1 = n - n.dot(u1) * u1, across2 = n - n.dot(u2) * u2;
    // Deeper than this the sum of the rims is less round than the sphere about the origin.
    const double max_depth = std::min(r1 / across1.norm(), r2 / across2.norm());
    const double part = coin() ? power_of_ten(-8, 0) : 1 - power_of_ten(-8, 0);
    const double gap = uniform(0, 1) < 0.1 ? r1 * power_of_ten(-9, 0) : -part * max_depth;
    const Vec3 d = gap * n + r1 * across1.normalized() + r2 * across2.normalized() +
                   std::copysign(h1, n.dot(u1)) * u1 + std::copysign(h2, n.dot(u2)) * u2;
    const auto along = [](const Vec3& axis) { return turn_between(Vec3::UnitZ(), axis); };
    const Eigen::Quaterniond turned = turn();
    return {Cylinder(r1, h1), Pose(turned * d, turned * along(u1)), Cylinder(r2, h2),
            Pose(Vec3::Zero(), turned * along(u2))};
  }

 private:
  /// Near an axis, across both within the angle between them, or anywhere.
  Vec3 normal(double tilt) {
    const double kind = uniform(0, 3);
    const double about = coin() ? uniform(0, 6.3) : small_or_none();
    if (kind < 1) {
      const double from = power_of_ten(-9, 0);
      return {std::cos(from), std::sin(from) * std::sin(about), std::sin(from) * std::cos(about)};
    }
    if (kind < 2) {
      const double along = tilt * uniform(-1, 1);
      const double across = coin() ? uniform(-1, 1) : small_or_none();
      return Vec3(along, across, 1 - std::abs(across)).normalized();
    }
    return Vec3(uniform(-1, 1), uniform(-1, 1), uniform(0, 1)).normalized();
  }
};

/// Overlapping bodies of which two smooth normals have the same depth, but for a part of it: where
/// one is wrongly taken for proven, the other may have a better one beside it. Smooth are the
/// normals of caps and faces, and those at which a side crosses a side or an edge.
class TiedNormals : Drawn {
 public:
  using Drawn::Drawn;

  Configuration make(Pair pair) {
    const Eigen::Quaterniond turn_b = turn();
    const bool nearly_aligned = coin();
    const Eigen::Quaterniond lean(Eigen::AngleAxisd(power_of_ten(-4, 0), turn() * Vec3::UnitX()));
    Configuration c{Cylinder(size(), size()),
                    Pose(Vec3::Zero(), nearly_aligned ? lean * turn_b : turn()), shape(pair),
                    Pose(Vec3::Zero(), turn_b)};
    const std::vector<Vec3> normals = smooth_normals(pair, c);
    const Vec3 n1 = any(normals);
    Vec3 n2 = any(normals);
    for (int i = 0; i < 4 && std::abs(n1.dot(n2)) > almost_parallel; ++i) n2 = any(normals);
    const double width1 = -gap(c, n1), width2 = -gap(c, n2);
    const double part = coin() ? uniform(0, 1) : power_of_ten(-3, 0);
    const double depth1 = part * std::min(width1, width2);
    const double depth2 = depth1 * (1 + (coin() ? 1 : -1) * power_of_ten(-6, -1));
    c.pose_a =
        Pose(displacement(c, n1, width1 - depth1, n2, width2 - depth2), c.pose_a.orientation());
    return c;
  }

 private:
  static constexpr double almost_parallel = 0.9999;

  double size() { return power_of_ten(-1.5, 0.5); }
  Shape shape(Pair pair) {
    if (pair == Pair::capsule) return Capsule(size(), size());
    if (pair == Pair::cylinder) return Cylinder(size(), size());
    const double x = size(), y = size();
    return Box(Vec3(x, y, coin() ? x : size()));
  }
  const Vec3& any(const std::vector<Vec3>& all) {
    return all[static_cast<std::size_t>(uniform(0, static_cast<double>(all.size())))];
  }

  static std::vector<Vec3> smooth_normals(Pair pair, const Configuration& c) {
    const Vec3 u = c.pose_a.rotation().col(2);
    std::vector<Vec3> all{u, -u};
    for (int i = 0; i < 3; ++i) {
      const Vec3 axis = c.pose_b.rotation().col(i);
      if (pair != Pair::box && i < 2) continue;
      const Vec3 across = u.cross(axis);
      constexpr double parallel = 1e-6;
      for (const double sign : {1.0, -1.0}) {
        if (pair != Pair::capsule) all.push_back(sign * axis);
        if (across.norm() > parallel) all.push_back(sign * across.normalized());
      }
    }
    return all;
  }

  /// A vector with these products with two normals, arbitrary otherwise.
  Vec3 displacement(const Configuration& c, const Vec3& n1, double along1, const Vec3& n2,
                    double along2) {
    const double cosine = n1.dot(n2), squared_sine = 1 - cosine * cosine;
    const auto within = [&](const Vec3& n) { return uniform(-1, 1) * -gap(c, n); };
    if (std::abs(cosine) > almost_parallel) {  // opposite: the centres lie level
      const Vec3 aside = n1.unitOrthogonal(), other = n1.cross(aside);
      const double level = (along1 - along2) / 2 * power_of_ten(-6, -1);
      return level * n1 + within(aside) * aside + within(other) * other;
    }
    const Vec3 across = n1.cross(n2).normalized();
    return (along1 - cosine * along2) / squared_sine * n1 +
           (along2 - cosine * along1) / squared_sine * n2 + within(across) * across;
  }
};

/// Centres so far apart that their difference overflows, and sizes so large that bodies may overlap
/// all the same.
void move_to_the_limit(RawConfiguration& c) {
  constexpr double max_length = std::numeric_limits<double>::max();
  double largest = 0;
  for (const double x : c.sizes) largest = std::max(largest, x);
  if (!(largest > 0)) return;
  for (double& x : c.sizes) {
    if (x > 0) x = std::clamp(x / largest * max_length, 1.0, max_length);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const double side = std::copysign(1, c.position_a[i]);
    const double part = std::abs(std::remainder(c.position_a[i], 1));
    c.position_a[i] = side * (0.5 + part) * max_length;
    c.position_b[i] = -side * (0.5 + part / 2) * max_length;
  }
}

}  // namespace

Case without_truth(int pair, std::uint64_t index) {
  constexpr int cylinders = 3, hulls = 5;
  if (pair == hulls) {
    constexpr std::uint64_t others = 1 << 24;  // than those that are asked with their truths
    return {name_of_hull(others + index), raw(with_any_hull(others + index)), 0, {}, {}};
  }
  if (pair == cylinders && index % 4 == 0) {
    return {"rims/" + std::to_string(index), raw(MeetingRims(index).make()), 0, {}, {}};
  }
  if (index % 4 == 2) {
    const Pair tied = static_cast<Pair>(pair);
    return {"tied/" + std::string(pair_name(tied)) + "/" + std::to_string(index),
            raw(TiedNormals(index).make(tied)),
            0,
            {},
            {}};
  }
  const Identity id{static_cast<Pair>(pair), "hostile", case_seed + 1, index};
  Case result{to_string(id), raw(make_configuration(id)), 0, {}, {}};
  if (index % 64 == 1) {
    move_to_the_limit(result.raw);
    result.identity += "/limit";
  }
  return result;
}

}  // namespace touchstone::mutation
