#include "simulation/scenes/pair_kind.hpp"

#include <fmt/format.h>
#include <set>

namespace touchstone {
namespace {

struct Text {
  std::string operator()(const Cylinder& s) const {
    return fmt::format("cylinder ⌀{:g}×{:g}", 2 * s.radius(), 2 * s.half_length());
  }
  std::string operator()(const Capsule& s) const {
    return fmt::format("capsule ⌀{:g}×{:g}", 2 * s.radius(), 2 * (s.half_length() + s.radius()));
  }
  std::string operator()(const Sphere& s) const {
    return fmt::format("sphere ⌀{:g}", 2 * s.radius());
  }
  std::string operator()(const Box& s) const {
    const Vec3 side = 2 * s.half_extents();
    return fmt::format("box {:g}×{:g}×{:g}", side.x(), side.y(), side.z());
  }
  std::string operator()(const Plane&) const { return "plane"; }
};

}  // namespace

std::string shape_text(const Shape& shape) { return std::visit(Text{}, shape); }

PairKinds::PairKinds(const Scene& scene, const Trajectory& run) {
  for (const Body& body : scene.bodies) shapes_.push_back(shape_text(body.shape));
  std::vector<std::set<std::pair<int, int>>> pairs;
  for (const Asked& asked : run.asked) {
    int kind = of(asked.a, asked.b);
    if (kind < 0) {
      kind = static_cast<int>(kinds_.size());
      index_[{shapes_[asked.a], shapes_[asked.b]}] = kind;
      kinds_.push_back({shapes_[asked.a] + " on " + shapes_[asked.b],
                        scene.bodies[asked.a].name + " and " + scene.bodies[asked.b].name,
                        pair_of(run.configuration(scene, asked)),
                        {}});
      pairs.emplace_back();
    }
    kinds_[kind].asked.push_back(asked);
    pairs[kind].insert({asked.a, asked.b});
  }
  for (std::size_t i = 0; i < kinds_.size(); ++i) {
    if (pairs[i].size() > 1) {
      kinds_[i].bodies = fmt::format("{} pairs, as {}", pairs[i].size(), kinds_[i].bodies);
    }
  }
}

int PairKinds::of(int a, int b) const {
  for (const auto& [first, second] : {std::pair(a, b), std::pair(b, a)}) {
    const auto found = index_.find({shapes_[first], shapes_[second]});
    if (found != index_.end()) return found->second;
  }
  return -1;
}

}  // namespace touchstone
