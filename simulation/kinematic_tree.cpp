#include "simulation/kinematic_tree.hpp"

#include <numeric>

namespace touchstone {
namespace {

constexpr int world = -1;

/// A hinge or slider between two assemblies, or one and the world, which stands for what is fixed.
struct Edge {
  int joint, a, b;
};

std::vector<Edge> edges(const Scene& scene, const std::vector<Assembly>& assemblies) {
  std::vector<int> of(scene.bodies.size());
  for (std::size_t i = 0; i < assemblies.size(); ++i) {
    for (const int b : assemblies[i].bodies)
      of[b] = assemblies[i].fixed ? world : static_cast<int>(i);
  }
  const auto is_free = [&](int i) { return i != world && assemblies[i].is_free(); };
  std::vector<Edge> result;
  for (std::size_t j = 0; j < scene.joints.size(); ++j) {
    const Joint& joint = scene.joints[j];
    const int a = of[joint.a], b = joint.b == world_body ? world : of[joint.b];
    if (joint.kind == JointKind::fixed || a == b || (!is_free(a) && !is_free(b))) continue;
    result.push_back({static_cast<int>(j), a, b});
  }
  return result;
}

}  // namespace

std::vector<Hanging> kinematic_tree(const Scene& scene, const std::vector<Assembly>& assemblies) {
  const std::vector<Edge> all = edges(scene, assemblies);
  std::vector<Hanging> tree(assemblies.size());
  std::vector<bool> is_placed(assemblies.size());
  const auto hang = [&](int child, int parent, int joint) {
    tree[child].joint = joint;
    tree[child].parent = parent;
    if (parent != world) tree[parent].children.push_back(child);
    is_placed[child] = true;
  };
  // Everything that hangs on what is placed, the world first.
  const auto grow = [&] {
    for (bool is_growing = true; is_growing;) {
      is_growing = false;
      for (const Edge& e : all) {
        const bool has_a = e.a == world || is_placed[e.a], has_b = e.b == world || is_placed[e.b];
        if (has_a == has_b) continue;
        has_a ? hang(e.b, e.a, e.joint) : hang(e.a, e.b, e.joint);
        is_growing = true;
      }
    }
  };
  std::vector<bool> is_first(assemblies.size());
  for (const Edge& e : all) {
    if (e.a != world) is_first[e.a] = true;
  }
  for (std::size_t i = 0; i < assemblies.size(); ++i) is_placed[i] = !assemblies[i].is_free();
  grow();
  for (const bool takes_any : {false, true}) {
    for (std::size_t i = 0; i < assemblies.size(); ++i) {
      if (is_placed[i] || (is_first[i] && !takes_any)) continue;
      is_placed[i] = true;
      grow();
    }
  }
  return tree;
}

std::optional<int> loop_closing_joint(const Scene& scene) {
  const std::vector<Assembly> all = assemblies(scene);
  const int held = static_cast<int>(all.size());
  std::vector<int> group(all.size() + 1);
  std::iota(group.begin(), group.end(), 0);
  const auto root = [&](int i) {
    if (i == world || !all[i].is_free()) i = held;
    while (group[i] != i) i = group[i];
    return i;
  };
  for (const Edge& e : edges(scene, all)) {
    const int a = root(e.a), b = root(e.b);
    if (a == b) return e.joint;
    group[b == held ? a : b] = b == held ? b : a;
  }
  return {};
}

}  // namespace touchstone
