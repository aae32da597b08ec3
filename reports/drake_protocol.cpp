// The shapes, points and poses on which Drake publishes its errors.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "reports/make_report.hpp"

namespace touchstone {
namespace {

constexpr double depth = 2e-3;  // metres; Drake's kDistance, in which its sizes are given

/// A point of a surface with an outward normal there, in the body's frame.
struct Site {
  std::string name;
  Vec3 point, normal;
  double room;  ///< how far another body may sink in there before another way out is shorter
};

std::vector<Site> sites(const Cylinder& c) {
  const double r = c.radius(), h = c.half_length(), from_edge = 1.01 * depth;
  const Vec3 z = Vec3::UnitZ(), side = Vec3(-1.5, 3, 0).normalized();
  return {{"cap", Vec3(1.3, -0.25, 0).normalized() * (r - from_edge) + z * h, z, from_edge},
          {"edge", Vec3(1, 1.5, 0).normalized() * r + z * h, Vec3(1, 1.5, 1).normalized(), 0},
          {"side", side * r - z * (h - from_edge), side, r}};
}

std::vector<Site> sites(const Plane&) {
  return {{"plane", Vec3(0.3, 0.7, 0), Vec3::UnitZ(), std::numeric_limits<double>::infinity()}};
}

std::vector<Site> sites(const Sphere& s) {
  const Vec3 one = Vec3(-1, 1, 1.5).normalized(), other = Vec3(1, -2, 0.3).normalized();
  return {{"sphere", one * s.radius(), one, s.radius()},
          {"sphere's other side", other * s.radius(), other, s.radius()}};
}

std::vector<Site> sites(const Capsule& c) {
  const double angle = 6 * std::numbers::pi / 7;
  const Vec3 side(std::cos(angle), std::sin(angle), 0), end = Vec3(2, 0.3, 1.1).normalized();
  return {{"capsule side", c.radius() * side + Vec3(0, 0, 0.6 * c.half_length()), side, c.radius()},
          {"capsule end", c.radius() * end + Vec3(0, 0, c.half_length()), end, c.radius()}};
}

std::vector<Site> sites(const Box& b) {
  const Vec3& h = b.half_extents();
  const double from_edge = 1.01 * std::max(0.25 * h.minCoeff(), depth);
  return {{"box vertex", h.cwiseProduct(Vec3(1, -1, 1)), Vec3(0.5, -2, 1).normalized(), 0},
          {"box edge", h.cwiseProduct(Vec3(1, -1, 0.75)), Vec3(2, -2, 0).normalized(), 0},
          {"box face", Vec3(from_edge, from_edge, 0) - h, -Vec3::UnitZ(), from_edge}};
}

struct World {
  const char* name;
  Eigen::Quaterniond rotation;
  Vec3 translation;
};

/// Near the origin and some metres away.
std::vector<World> worlds() {
  const auto turn = [](double angle, const Vec3& axis) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis.normalized()));
  };
  return {{"near", turn(5 * std::numbers::pi / 9, Vec3(-1, -1, 1)), Vec3(-0.2, 0.15, -0.3)},
          {"far", turn(22 * std::numbers::pi / 9, Vec3(-1, 1, -1)), Vec3(-10, 20.2, -12.3)}};
}

/// The second body, in the frame of the first: site on site, `depth` deep, normals opposite.
Pose placed(const Site& first, const Site& second) {
  const auto r = turn_between(second.normal, -first.normal);
  return Pose(first.point - depth * first.normal - r * second.point, r);
}

/// The second shape of a pair, and the errors that Drake publishes.
struct PublishedPair {
  Pair pair;
  Shape shape;
  std::vector<Site> sites;
  std::optional<double> penetration, signed_distance;
};

template <class Other>
PublishedPair row(Pair pair, const Other& shape, std::optional<double> penetration,
                  std::optional<double> signed_distance) {
  return {pair, shape, sites(shape), penetration, signed_distance};
}

/// From RobotLocomotion/drake, geometry/query_object.h: table 1 (ComputePointPairPenetration) and
/// table 3 (ComputeSignedDistancePairwiseClosestPoints, which refuses half-spaces), of double.
const std::vector<PublishedPair>& published_pairs() {
  static const std::vector<PublishedPair> pairs = {
      row(Pair::plane, Plane(Vec3::UnitZ(), 0), 4e-15, std::nullopt),
      row(Pair::sphere, Sphere(100 * depth), 5e-15, 5e-15),
      row(Pair::capsule, Capsule(100 * depth, 51 * depth / 2), 4e-5, 1e-5),
      row(Pair::cylinder, Cylinder(19 * depth, 100 * depth / 2), 2e-3, 2e-5),
      row(Pair::box, Box(Vec3(37, 100, 43) * depth / 2), 1e-3, 6e-6)};
  return pairs;
}

const PublishedPair* find_published(Pair pair) {
  const auto& pairs = published_pairs();
  const auto found =
      std::find_if(pairs.begin(), pairs.end(), [&](const auto& p) { return p.pair == pair; });
  return found == pairs.end() ? nullptr : &*found;
}

/// Adds what a candidate makes of a configuration.
void add(DrakeProtocol::Result& result, std::size_t configuration, const oracle::Truth& truth,
         const Answer& answer, const Score& score) {
  ++result.count;
  ++result.outcomes[score.outcome];
  // A missed contact is as wrong as the bodies are deep.
  const bool is_missed = score.outcome == Outcome::missed;
  if (!score.depth_error && !is_missed) return;
  const double answered = is_missed ? 0 : answer.signed_distance;
  const double error = std::abs(answered - truth.signed_distance.midpoint());
  if (result.worst && error <= *result.max_error) return;
  result.max_error = error;
  result.worst = configuration;
}

}  // namespace

std::vector<DrakeCase> drake_cases(Pair pair) {
  const PublishedPair* const second = find_published(pair);
  if (!second) return {};
  const Cylinder cylinder(100 * depth, 71 * depth / 2);
  // Drake names the pairs with a box or a capsule the other way round.
  const bool cylinder_first = pair != Pair::box && pair != Pair::capsule;
  std::vector<DrakeCase> result;
  for (const World& world : worlds()) {
    for (const Site& on_cylinder : sites(cylinder)) {
      for (const Site& on_other : second->sites) {
        if (std::max(on_cylinder.room, on_other.room) < depth) continue;
        const Pose first(world.translation, world.rotation);
        const Pose relative =
            cylinder_first ? placed(on_cylinder, on_other) : placed(on_other, on_cylinder);
        const Pose then(world.translation + world.rotation * relative.position(),
                        world.rotation * relative.orientation());
        const Pose &a = cylinder_first ? first : then, &b = cylinder_first ? then : first;
        const std::string name =
            "cylinder " + on_cylinder.name + " against " + on_other.name + ", " + world.name;
        result.push_back({name, {cylinder, a, second->shape, b}});
        if (pair != Pair::cylinder) continue;
        result.push_back(
            {name + ", exchanged", {std::get<Cylinder>(second->shape), b, cylinder, a}});
      }
    }
  }
  return result;
}

DrakeProtocol drake_protocol(const Campaign& campaign, std::vector<CandidateProcess>& candidates) {
  DrakeProtocol protocol{depth, {}, {}};
  for (const Pair pair : campaign.pairs) {
    const PublishedPair* const known = find_published(pair);
    if (!known) continue;
    protocol.pairs.push_back(
        {pair_name(pair), known->penetration, known->signed_distance, drake_cases(pair)});
    std::vector<Configuration> configurations;
    for (const DrakeCase& c : protocol.pairs.back().configurations) {
      configurations.push_back(c.configuration);
    }
    std::vector<DrakeProtocol::Result> results;
    for (const Candidate* c : campaign.candidates) {
      results.push_back({pair_name(pair), c->name, 0, {}, {}, {}});
    }
    std::size_t i = 0;
    score_configurations(configurations, pointers(candidates), campaign.bar, truth_width,
                         [&](const ScoredConfiguration& scored) {
                           for (std::size_t k = 0; k < results.size(); ++k) {
                             add(results[k], i, scored.truth, scored.answers[k], scored.scores[k]);
                           }
                           ++i;
                         });
    protocol.results.insert(protocol.results.end(), results.begin(), results.end());
  }
  return protocol;
}

}  // namespace touchstone
