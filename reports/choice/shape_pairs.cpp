#include <algorithm>
#include <limits>

#include "candidates/host/progress.hpp"
#include "properties/features.hpp"
#include "reference/invalid_input.hpp"
#include "reports/choice/choice.hpp"
#include "simulation/scenes/choose.hpp"

namespace touchstone {
namespace {

/// Sampled depths, as shares of the smaller size; up to a multiple of the depth limit if that is
/// more, so that models that miss such contacts fail.
constexpr double min_depth = 1e-4, max_depth = 0.05, max_of_limit = 4;

/// Two shapes and the number of such pairs in the file.
struct ShapePair {
  Cylinder a;
  Shape b;
  std::string name, example;
  int count = 1;
};

/// A shape with the link that it is part of.
struct Part {
  const LinkShape* shape;
  int link;
};

bool can_touch(const RobotFile& file, const Part& x, const Part& y) {
  if (x.link == y.link || (file.links[x.link].fixed && file.links[y.link].fixed)) return false;
  const auto are_these = [&](int link, int other) {
    return (link == x.link && other == y.link) || (link == y.link && other == x.link);
  };
  return x.shape->mask.touches(y.shape->mask) &&
         std::ranges::none_of(file.apart,
                              [&](const auto& a) { return are_these(a.first, a.second); }) &&
         std::ranges::none_of(file.joints, [&](const LinkJoint& joint) {
           return are_these(joint.child, joint.parent);
         });
}

std::vector<ShapePair> shape_pairs(const RobotFile& file) {
  std::vector<Part> parts;
  for (std::size_t l = 0; l < file.links.size(); ++l) {
    for (const LinkShape& s : file.links[l].shapes) parts.push_back({&s, static_cast<int>(l)});
  }
  std::vector<ShapePair> result;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (std::size_t j = i + 1; j < parts.size(); ++j) {
      if (!can_touch(file, parts[i], parts[j])) continue;
      const LinkShape *a = parts[i].shape, *b = parts[j].shape;
      if (!std::holds_alternative<Cylinder>(a->shape)) std::swap(a, b);
      if (!std::holds_alternative<Cylinder>(a->shape)) continue;
      std::string first = shape_text(a->shape), second = shape_text(b->shape);
      if (std::holds_alternative<Cylinder>(b->shape) && second < first) {
        std::swap(a, b);
        std::swap(first, second);
      }
      const std::string name = first + " on " + second;
      const auto known = std::find_if(result.begin(), result.end(),
                                      [&](const ShapePair& p) { return p.name == name; });
      if (known != result.end()) {
        ++known->count;
        continue;
      }
      result.push_back({std::get<Cylinder>(a->shape), b->shape, name, a->name + " and " + b->name});
    }
  }
  return result;
}

std::vector<Configuration> sample(const ShapePair& shapes, std::uint64_t number,
                                  const PairNeeds& needs) {
  Draw draw(rc::Random({needs.seed, number, 0, 0}));
  const Pair pair = pair_of({shapes.a, {}, shapes.b, {}});
  std::vector<Configuration> result;
  for (std::uint64_t i = 0; i < needs.count; ++i) {
    const Bodies bodies{shapes.a, draw.orientation(), shapes.b, draw.orientation()};
    const FeaturePair features = draw_feature_pair(draw, pair);
    const double size = smaller_size(bodies);
    const double max = std::min(size, std::max(max_depth * size, max_of_limit * needs.depth));
    const double depth = draw.log_uniform(min_depth * size, max);
    result.push_back(meet(draw, bodies, features.on_a, features.on_b, -depth));
  }
  return result;
}

bool serves(const ReplayScore& r, const PairNeeds& needs) {
  return r.nanoseconds && r.depth_error <= needs.depth && r.normal_angle <= needs.angle;
}

/// The candidates that can be timed, the cheapest first.
std::vector<PairCandidate> ranked(const std::vector<ReplayScore>& scores,
                                  const std::vector<const Candidate*>& candidates,
                                  const std::vector<Configuration>& sampled,
                                  const PairNeeds& needs) {
  std::vector<PairCandidate> result;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    const ReplayScore& s = scores[c];
    if (!s.nanoseconds) continue;
    result.push_back({candidates[c]->name, s, serves(s, needs), {}});
    if (result.back().serves) continue;
    const bool deep = !(s.depth_error <= needs.depth);
    result.back().worst = sampled[deep ? s.worst_depth : s.worst_angle];
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const PairCandidate& x, const PairCandidate& y) {
                     return *x.score.nanoseconds < *y.score.nanoseconds;
                   });
  return result;
}

std::optional<std::size_t> chosen_of(const std::vector<PairCandidate>& candidates) {
  std::optional<std::size_t> exact;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (candidates[i].name == "reference" && candidates[i].serves) exact = i;
  }
  const double limit = exact ? cheaper_share * *candidates[*exact].score.nanoseconds
                             : std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (candidates[i].serves && *candidates[i].score.nanoseconds < limit) return i;
  }
  return exact;
}

}  // namespace

bool PairsChoice::all_served() const {
  return std::all_of(pairs.begin(), pairs.end(), [](const PairChoice& p) { return p.chosen; });
}

PairsChoice choose_for_pairs(const RobotFile& file, const PairNeeds& needs,
                             const std::vector<const Candidate*>& given, const Limits& limits) {
  const auto pairs = shape_pairs(file);
  if (pairs.empty()) {
    throw InvalidInput("scene", '"' + file.name + '"',
                       "must hold a cylinder and another collision shape that it can touch: of "
                       "another link without a joint between them");
  }
  const auto candidates = exact_first(given);
  auto processes = start(candidates, simulation_threshold, limits);
  Progress progress("pairs of shapes", pairs.size());
  std::size_t shapes = 0;
  for (const Link& link : file.links) shapes += link.shapes.size();
  PairsChoice result{file.name, shapes, file.ignored, needs, {}};
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const ShapePair& pair = pairs[i];
    const auto sampled = sample(pair, i, needs);
    auto all = ranked(replay(sampled, processes), candidates, sampled, needs);
    const auto chosen = chosen_of(all);
    result.pairs.push_back({pair.name, pair.example, pair.count, std::move(all), chosen});
    progress.update(i + 1);
  }
  return result;
}

}  // namespace touchstone
